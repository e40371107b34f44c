// A rounded enclosure: shells that are Minkowski sums, standoffs, vents, and a lip for the lid.
// The room inside, in mm.
inner = [64, 42, 22];  // [20:120]
wall = 2;              // [1:0.5:5]
corner = 5;            // [1:0.5:10]

$fn = 60;

// A box of that size with rounded edges, whose corner before rounding is at the origin.
module rounded(size, radius)
  translate([radius, radius, radius])
    minkowski() {
      cube([for (side = size) side - 2 * radius]);
      sphere(radius);
    }

// A post that widens towards the floor.
module standoff()
  difference() {
    hull() {
      cylinder(r = 4, h = 0.5);
      cylinder(r = 2.5, h = 6);
    }
    translate([0, 0, 1])
      cylinder(r = 1.1, h = 6);
  }

module slot(length)
  hull()
    for (y = [0, length])
      translate([0, y, 0])
        cylinder(r = 1, h = 3 * wall, center = true);

difference() {
  rounded(inner + [2 * wall, 2 * wall, 2 * wall + 8], corner);
  translate([wall, wall, wall])
    rounded(inner + [0, 0, 20], corner - wall);
  translate([-1, -1, inner[2] + wall])
    cube([100, 100, 40]);
  for (x = [14 : 5 : 54])
    translate([x, 13, wall / 2])
      slot(20);
}
for (x = [10, inner[0] + 2 * wall - 10], y = [10, inner[1] + 2 * wall - 10])
  translate([x, y, wall - 0.2])
    standoff();
