// Sleeves that fill the holes they are put in, wall on wall, each turned about its own axis.
module bore(a) { rotate([0, 0, 9 * a]) translate([10, 0, 0]) rotate([0, 90, 9 * a]) children(); }
rotate([17, 33, 51]) {
  difference() {
    rotate([0, 0, 13]) cylinder(h = 12, r = 14, center = true);
    for (a = [0:4]) bore(8 * a) cylinder(h = 20, r = 2.5, center = true);
  }
  for (a = [0:4]) bore(8 * a) rotate([0, 0, 31 * a]) difference() {
    cylinder(h = 8, r = 2.5, center = true);
    cylinder(h = 8, r = 1.5, center = true);
  }
}
