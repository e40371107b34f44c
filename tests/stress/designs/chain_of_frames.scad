// Eight turned frames in each other; in each a disc stands on the one before, bored from below.
module level(n) {
  difference() {
    cylinder(h = 2, r = 1 + n);
    cylinder(h = 2, r = n / 2);
  }
  if (n > 1) translate([0, 0, 2]) rotate([0, 0, 23.7]) rotate([13, 7, 0]) level(n - 1);
}
rotate([5, 15, 25]) level(8);
