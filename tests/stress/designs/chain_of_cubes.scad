// Turned frames in each other; in each a box stands on the one before, bored from below.
module level(n) {
  difference() {
    translate([-1 - n, -1 - n, 0]) cube([2 + 2 * n, 2 + 2 * n, 2]);
    translate([-n / 2, -n / 2, 0]) cube([n, n, 2]);
  }
  if (n > 1) translate([0, 0, 2]) rotate([0, 0, 23.7]) rotate([13, 7, 0]) level(n - 1);
}
rotate([5, 15, 25]) level(6);
