// A metric thread of 40 turns: a twisted profile, as thread libraries make it.
diameter = 10;
pitch = 1.5;
turns = 40;
$fn = 48;

depth = 0.61 * pitch;

module profile() {
  translate([depth / 2, 0]) circle(d = diameter - depth);
}

difference() {
  linear_extrude(turns * pitch, twist = -360 * turns, slices = 24 * turns, convexity = 10) profile();
  translate([0, 0, turns * pitch - 1]) difference() {
    cylinder(d = 2 * diameter, h = 2);
    cylinder(d1 = diameter, d2 = diameter - 3, h = 1.5);
  }
}
translate([0, 0, -6]) cylinder(d = 18, h = 6, $fn = 6);
