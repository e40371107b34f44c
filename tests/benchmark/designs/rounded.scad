// Rounded by minkowski(): a case, and a frame that is not convex.
$fn = 24;

difference() {
  minkowski() {
    cube([60, 40, 20], center = true);
    sphere(4);
  }
  translate([0, 0, 6]) minkowski() {
    cube([56, 36, 20], center = true);
    cylinder(r = 3, h = 2);
  }
}
translate([80, 0, 0]) minkowski() {
  difference() {
    cube([40, 40, 6], center = true);
    cube([28, 28, 10], center = true);
  }
  sphere(2, $fn = 12);
}
