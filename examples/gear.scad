// A gear with rounded teeth, spokes and a keyed bore.
teeth = 24;
module_size = 2;
thickness = 8;

outer = module_size * (teeth + 2) / 2;
root = module_size * (teeth - 2.5) / 2;

module tooth() {
  pitch = 360 / teeth;
  hull() {
    translate([root - 1, -module_size * 0.9]) square([0.1, module_size * 1.8]);
    for (side = [-1, 1]) translate([outer - 0.6, side * module_size * 0.4]) circle(0.6);
  }
}

module window() {
  offset(r = 2) offset(delta = -2)
    intersection() {
      difference() { circle(root - 4); circle(11); }
      polygon([[0, 0], [root, -root * tan(27)], [root, root * tan(27)]]);
    }
}

linear_extrude(height = thickness)
  difference() {
    union() {
      circle(root);
      for (i = [0 : teeth - 1]) rotate(i * 360 / teeth) tooth();
    }
    for (i = [0 : 4]) rotate(i * 72) window();
    circle(5);
    translate([0, -1]) square([6.5, 2]);
  }
linear_extrude(height = thickness + 4)
  difference() {
    circle(9);
    circle(5);
    translate([0, -1]) square([6.5, 2]);
  }
