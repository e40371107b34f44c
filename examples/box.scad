// A box for electronics, to be printed: rounded corners, posts for screws, slots for air.
size = [80, 50];
height = 28;
wall = 2;
radius = 6;

module outline(inset = 0) {
  offset(r = radius - inset) square(size - 2 * [radius, radius], center = true);
}

module posts(r) {
  for (x = [-1, 1], y = [-1, 1])
    translate([x * (size[0] / 2 - 7), y * (size[1] / 2 - 7)]) circle(r, $fn = 48);
}

difference() {
  union() {
    linear_extrude(height = wall) outline();
    linear_extrude(height = height) difference() { outline(); outline(wall); }
    linear_extrude(height = height - 3) intersection() { posts(4); outline(); }
  }
  translate([0, 0, wall]) linear_extrude(height = height) posts(1.4);
  // air
  for (i = [-4 : 4])
    translate([i * 6, 0, -1]) linear_extrude(height = wall + 2)
      hull() for (y = [-10, 10]) translate([0, y]) circle(1.5, $fn = 48);
  // a connector
  translate([0, -size[1] / 2, height / 2]) rotate([90, 0, 0])
    linear_extrude(height = 4 * wall, center = true)
      offset(r = 1, $fn = 48) square([10, 5], center = true);
}
