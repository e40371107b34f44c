// Half of a mould: a block that an imported shell and its gate are cut from.
$fn = 64;

difference() {
  translate([-26, -26, -1]) cube([52, 52, 12]);
  translate([0, 0, 11.5]) mirror([0, 0, 1]) import("shell.stl", convexity = 4);
  translate([15, 0, 11]) rotate([0, 90, 0]) cylinder(h = 20, r1 = 1.5, r2 = 3);
  for (x = [-21, 21], y = [-21, 21]) translate([x, y, 7]) cylinder(h = 10, r = 2);
}
