// A stamp: a drawing, mirrored and with walls that lean, on a plate with a turned handle.
$fn = 64;

translate([0, 0, 3]) mirror([1, 0, 0]) linear_extrude(height = 2, scale = 0.97) import("stamp.svg", center = true);
difference() {
  translate([0, 0, -1]) cylinder(h = 4, d = 40);
  // Where the leaf's tip is up.
  translate([0, 20, -2]) cylinder(h = 6, d = 2);
}
translate([0, 0, -25]) rotate_extrude() {
  translate([0, 1]) square([4, 24]);
  difference() {
    translate([0, 4]) circle(d = 16);
    translate([-10, -10]) square([10, 30]);
  }
}
