// Balls in sockets of their own radius, about one centre but in other frames; a lid on a cone.
rotate([31, 41, 59]) {
  difference() {
    cylinder(h = 10, r = 12, center = true);
    for (a = [0:120:240]) rotate(a) translate([6, 0, 5]) sphere(r = 3);
    translate([0, 0, -5]) cylinder(h = 5, r1 = 4, r2 = 0);
  }
  rotate(120) translate([6, 0, 5]) rotate([70, 20, 10]) sphere(r = 3);
  translate([0, 0, -5]) rotate(33) cylinder(h = 2, r1 = 4, r2 = 2.4);
}
