// The cap of a bottle, turned upside down: a grip that twists, and a thread within it.
height = 14;
wall = 2;
inner = 15;
pitch = 4;
turns = 2;

module grip() {
  linear_extrude(height = height, twist = 30, $fn = 96)
    difference() {
      circle(inner + wall + 0.8);
      for (i = [0 : 35]) rotate(10 * i) translate([inner + wall + 1.2, 0]) circle(1, $fn = 48);
    }
}

// The outline of one layer of a thread: a circle that is moved off the axis.
module thread(depth, height) {
  linear_extrude(height = height, twist = -360 * height / pitch, slices = 40 * height / pitch)
    translate([depth, 0]) circle(inner - depth, $fn = 90);
}

difference() {
  grip();
  translate([0, 0, wall]) thread(0.8, turns * pitch);
  translate([0, 0, wall + turns * pitch]) cylinder(r = inner + 0.2, h = height, $fn = 90);
}
