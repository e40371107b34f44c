// A plate of cubes and its cutters, each in another chain of rotations for the same frame: all that
// is flush is so in the design only, not in the file's six digits.
a = [17.12345678, 23.23456789, 41.3456789];
module once() rotate(a) children();
module twice() rotate([0, 0, a.z]) rotate([a.x, a.y, 0]) children();
module thrice() rotate([0, 0, a.z]) rotate([0, a.y, 0]) rotate([a.x, 0, 0]) children();
difference() {
  union() {
    once() cube([20, 20, 2]);
    twice() translate([20, 0, 0]) cube([10, 20, 2]);
    thrice() translate([3, 3, 2]) cube([3, 3, 5]);
  }
  thrice() translate([10, 3, 0]) cube([5, 5, 2]);
  thrice() translate([4, 4, 2]) cube([1, 1, 5]);
  thrice() translate([25, 10, 0]) cylinder(h = 2, d = 7);
  twice() translate([10, 14, 0]) cylinder(h = 2, d = 7, $fn = 6);
}
