// color() on operands, on whole operations, and none.
difference() {
  color("SteelBlue") cube([30, 20, 10]);
  color([0.8, 0.2, 0.1]) translate([15, 10, 10]) sphere(7);
  translate([25, 10, -1]) cylinder(h = 20, r = 3);
}
color("Tomato") translate([0, 30, 0]) intersection() {
  cube(16);
  translate([8, 8, 8]) sphere(10);
}
translate([30, 35, 0]) cylinder(h = 12, r1 = 8, r2 = 0);
