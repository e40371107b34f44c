// A cable along a curve, and a handle: chains of hulls of balls and of discs.
steps = 120;
$fn = 32;

function at(t) = [40 * cos(360 * t) + 8 * cos(1080 * t), 40 * sin(360 * t), 14 * sin(720 * t)];

for (i = [0 : steps - 1]) hull() {
  translate(at(i / steps)) sphere(2 + sin(i * 15) / 2);
  translate(at((i + 1) / steps)) sphere(2 + sin((i + 1) * 15) / 2);
}
for (side = [-1, 1]) translate([0, 12 * side, -18]) for (i = [0 : 9]) hull() for (j = [i, i + 1])
  translate([6 * (j - 5), 4 * sin(36 * j), 0]) cylinder(r = 3, h = 4);
