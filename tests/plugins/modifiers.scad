// # and % in a difference and beside it.
difference() {
  cube(20, center = true);
  #translate([0, 0, 10]) sphere(8, $fn = 24);
  cylinder(h = 50, r = 4, center = true, $fn = 20);
}
%translate([20, 0, 0]) cube(10);
#translate([0, -25, 0]) cube(8);
%translate([-24, 0, 0]) rotate([0, 30, 0]) cylinder(h = 15, r1 = 6, r2 = 2);
