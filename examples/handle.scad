// A handle: hulls of neighbouring balls along a curve, between two feet.
$fn = 48;
steps = 24;

function place(t) = [50 * cos(t), 0, 34 * sin(t)];
function thickness(t) = 4 + 2.5 * sin(t);

module link(t) translate(place(t)) sphere(thickness(t));

module foot()
  difference() {
    hull() {
      cylinder(r = 9, h = 3);
      translate([0, 0, 8])
        sphere(5);
    }
    for (y = [-6.5, 6.5])
      translate([0, y, -1])
        cylinder(r = 1.2, h = 20);
  }

for (i = [0 : steps - 1])
  hull() {
    link(180 * i / steps);
    link(180 * (i + 1) / steps);
  }
for (x = [-50, 50])
  translate([x, 0, -6])
    foot();
