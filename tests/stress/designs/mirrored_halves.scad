// A housing and its mirror image, touching in their common face, with bolts through both.
module half() {
  difference() {
    cylinder(h = 5, r = 10);
    translate([0, 0, 2]) cylinder(h = 3, r = 8);
    for (a = [20:90:290]) rotate(a) translate([9, 0, 0]) cylinder(h = 5, r = 0.6);
  }
}
rotate([40, 0, 25]) {
  half();
  mirror([0, 0, 1]) half();
  for (a = [20:180:200]) rotate(a) translate([9, 0, -5]) cylinder(h = 10, r = 0.6);
}
