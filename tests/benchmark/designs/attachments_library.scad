// Parts that carry their size to their children in special variables.
function turn_of(side) = side == "top" ? [0, 0, 0] : side == "bottom" ? [180, 0, 0] : side == "left" ? [0, -90, 0]
  : side == "right" ? [0, 90, 0] : side == "front" ? [90, 0, 0] : assert(side == "back", side) [-90, 0, 0];
function reach_of(side, size) = (side == "top" || side == "bottom" ? size.z
  : side == "left" || side == "right" ? size.x : size.y) / 2;

module placed(size) {
  $size = size;
  translate([0, 0, is_undef($inside) ? 0 : size.z / 2]) {
    children(0);
    children(1);
  }
}

module on_side(side) {
  size = $size;
  rotate(turn_of(side)) translate([0, 0, reach_of(side, size)]) {
    $inside = true;
    children();
  }
}

module block(size, r = 0) placed(size) {
  if (r > 0) linear_extrude(size.z, center = true) offset(r) square([size.x - 2 * r, size.y - 2 * r], center = true);
  else cube(size, center = true);
  children();
}

module rounded_block(size, r) placed(size) {
  hull() for (x = [-1, 1], y = [-1, 1], z = [-1, 1])
    translate([x * (size.x / 2 - r), y * (size.y / 2 - r), z * (size.z / 2 - r)]) sphere(r);
  children();
}

module tube(od, id, h) placed([od, od, h]) {
  difference() {
    cylinder(d = od, h = h, center = true);
    cylinder(d = id, h = h + 1, center = true);
  }
  children();
}

module rod(d, h) placed([d, d, h]) {
  cylinder(d = d, h = h, center = true);
  children();
}

module ball(r) placed([2 * r, 2 * r, 2 * r]) {
  sphere(r);
  children();
}

module cut() translate([0, 0, -5]) color("orange") children();

module grid(nx, ny, step) for (i = [0 : nx - 1], j = [0 : ny - 1])
  translate([(i - (nx - 1) / 2) * step, (j - (ny - 1) / 2) * step, 0]) children();

module row(n, step) for ($index = [0 : n - 1]) translate([$index * step, 0, 0]) children();
