// A shelf bracket whose plates are honeycombs.
cell = 8;
wall = 1.6;
size = [120, 80];

module honeycomb(size) intersection() {
  square(size);
  for (i = [0 : ceil(size.x / cell)], j = [0 : ceil(size.y / cell / 0.866)])
    translate([(i + (j % 2) / 2) * cell, j * cell * 0.866]) rotate(30) circle(d = (cell - wall) / 0.866, $fn = 6);
}

module plate(size, h) linear_extrude(h) difference() {
  offset(4, $fn = 40) offset(-4) square(size);
  translate([6, 6]) honeycomb(size - [12, 12]);
}

plate(size, 4);
translate([0, 4, 0]) rotate([90, 0, 0]) plate([size.x, 60], 4);
for (x = [10, size.x / 2, size.x - 10]) translate([x - 2, 4, 4]) rotate([90, 0, 90]) linear_extrude(4)
  difference() {
    polygon([[0, 0], [60, 0], [0, 45]]);
    offset(-8) polygon([[0, 0], [60, 0], [0, 45]]);
  }
