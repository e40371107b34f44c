// A pair of involute gears, and a bevelled one.
module_mm = 2;
pressure = 20;

function involute(base, a) = base * [cos(a) + a * PI / 180 * sin(a), sin(a) - a * PI / 180 * cos(a)];
function turned(p, a) = [p.x * cos(a) - p.y * sin(a), p.x * sin(a) + p.y * cos(a)];

function tooth(n) =
  let (pitch = n * module_mm / 2, base = pitch * cos(pressure), tip = pitch + module_mm,
       last = sqrt(pow(tip / base, 2) - 1) * 180 / PI, at_pitch = tan(pressure) * 180 / PI - pressure,
       half = 90 / n + at_pitch,
       flank = [for (i = [0 : 8]) turned(involute(base, last * i / 8), -half)])
  concat(flank, [for (i = [8 : -1 : 0]) [flank[i].x, -flank[i].y]]);

module gear(n, h, bore, scale = 1, twist = 0) difference() {
  linear_extrude(h, scale = scale, twist = twist, slices = 12, convexity = 10) union() {
    circle(r = n * module_mm / 2 - 1.25 * module_mm, $fn = 4 * n);
    for (i = [0 : n - 1]) rotate(360 * i / n) polygon(concat([[0, 0]], tooth(n)));
  }
  translate([0, 0, -1]) cylinder(d = bore, h = h + 2, $fn = 40);
  for (i = [0 : 5]) rotate(60 * i) translate([n * module_mm / 3.2, 0, -1]) cylinder(d = n * module_mm / 6, h = h + 2, $fn = 30);
}

color("Goldenrod") gear(32, 8, 8);
color("SlateGray") translate([(32 + 18) * module_mm / 2, 0, 0]) rotate(180 / 18) gear(18, 8, 6);
color("IndianRed") translate([0, -60, 0]) gear(24, 14, 6, scale = 0.7, twist = 15);
