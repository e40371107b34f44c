// Boxes in nested frames that are thirds apart: 0.333333 and 0.333333 is not 0.666667.
module third() translate([1/3, 1/3, 1/3]) children();
difference() {
  union() {
    translate([2/3, 2/3, 2/3]) cube([4, 4, 2]);
    third() third() translate([4, 0, 0]) cube([2, 4, 2]);
    third() third() translate([0, 0, 2]) cube([6, 4, 1]);
  }
  third() third() translate([1, 1, 0]) cube([1, 1, 3]);
  translate([2/3, 2/3, 2/3]) translate([3, 1, 0]) cube([2, 2, 1]);
  third() translate([1/3, 1/3, 1/3]) translate([5, 2, 0]) cylinder(h = 3, r = 0.5);
}
