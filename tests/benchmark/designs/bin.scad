// A bin for a grid of 42 mm, as the generators of such bins write it.
cells = [2, 1];
height = 42;
divisions = 3;
$fn = 40;
unit = 42;

module profile_of(size, r) hull() for (x = [-1, 1], y = [-1, 1])
  translate([x * (size.x / 2 - r), y * (size.y / 2 - r)]) circle(r);

module foot() {
  hull() {
    linear_extrude(0.01) profile_of([35.6, 35.6], 0.8);
    translate([0, 0, 0.8]) linear_extrude(0.01) profile_of([37.2, 37.2], 1.6);
  }
  translate([0, 0, 0.8]) linear_extrude(1.8) profile_of([37.2, 37.2], 1.6);
  hull() {
    translate([0, 0, 2.6]) linear_extrude(0.01) profile_of([37.2, 37.2], 1.6);
    translate([0, 0, 4.74]) linear_extrude(0.01) profile_of([41.5, 41.5], 3.75);
  }
}

difference() {
  union() {
    for (i = [0 : cells.x - 1], j = [0 : cells.y - 1])
      translate([(i - (cells.x - 1) / 2) * unit, (j - (cells.y - 1) / 2) * unit, 0]) difference() {
        foot();
        for (x = [-13, 13], y = [-13, 13]) translate([x, y, -0.1]) {
          cylinder(d = 6.5, h = 2.4);
          cylinder(d = 3, h = 6);
        }
      }
    translate([0, 0, 4.74]) linear_extrude(height - 4.74) profile_of(unit * cells - [0.5, 0.5], 3.75);
  }
  width = (unit * cells.x - 3.1) / divisions - 1.2;
  for (i = [0 : divisions - 1]) translate([(i - (divisions - 1) / 2) * (width + 1.2), 0, 0]) hull() {
    for (x = [-1, 1], y = [-1, 1]) translate([x * (width / 2 - 3), y * (unit * cells.y / 2 - 4.3), 0]) {
      translate([0, 0, 10]) sphere(3);
      translate([0, 0, height + 1]) cylinder(r = 3, h = 1);
    }
  }
}
