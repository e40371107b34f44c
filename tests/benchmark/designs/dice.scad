// Dice with letters, rounded by an intersection with a ball.
words = ["A", "B", "C", "D", "E", "F"];
turns = [[0, 0, 0], [90, 0, 0], [180, 0, 0], [270, 0, 0], [0, 90, 0], [0, 270, 0]];

module die(size) difference() {
  intersection() {
    cube(size, center = true);
    sphere(size * 0.72, $fn = 80);
  }
  for (i = [0 : 5]) rotate(turns[i]) translate([0, 0, size / 2 - 0.8])
    linear_extrude(1) text(words[i], size = size / 2, halign = "center", valign = "center");
}

for (i = [0 : 2], j = [0 : 1]) translate([26 * i, 26 * j, 0]) rotate([0, 0, 17 * i + 31 * j]) die(20);
