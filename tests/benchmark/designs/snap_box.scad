/* [Box] */
// inside, in mm
length = 80; // [20 : 200]
width = 50; // [20 : 200]
height = 25; // [10 : 100]
wall = 2; // [1 : 0.4 : 4]
/* [Lid] */
label = "SENSOR";
part = "both"; // [box, lid, both]
/* [Hidden] */
$fn = 32;
radius = 4;

module rounded(size, r) {
  hull() for (x = [r, size.x - r], y = [r, size.y - r]) translate([x, y, 0]) cylinder(r = r, h = size.z);
}

module snap(l) rotate([0, 90, 0]) cylinder(r = 0.8, h = l, center = true);

module box() {
  outer = [length + 2 * wall, width + 2 * wall, height + wall];
  difference() {
    rounded(outer, radius);
    translate([wall, wall, wall]) rounded([length, width, height + 1], radius - wall / 2);
    for (y = [0, outer.y]) translate([outer.x / 2, y == 0 ? wall : y - wall, outer.z - 3]) snap(length / 2);
    for (i = [0 : 7]) translate([outer.x / 4 + i * outer.x / 16, -1, outer.z / 2]) cube([2, wall + 2, height / 4]);
    translate([-1, outer.y / 2, outer.z / 2]) rotate([0, 90, 0]) cylinder(d = 8, h = wall + 2);
  }
  for (x = [8, outer.x - 8], y = [8, outer.y - 8]) translate([x, y, wall]) difference() {
    cylinder(d = 6, h = 6);
    cylinder(d = 2.5, h = 7);
  }
}

module lid() {
  outer = [length + 2 * wall, width + 2 * wall, wall];
  difference() {
    rounded(outer, radius);
    translate([outer.x / 2, outer.y / 2, wall - 0.6])
      linear_extrude(1) text(label, size = width / 5, halign = "center", valign = "center");
  }
  difference() {
    translate([wall + 0.2, wall + 0.2, -4]) rounded([length - 0.4, width - 0.4, 4], radius - wall / 2);
    translate([2 * wall, 2 * wall, -5]) rounded([length - 2 * wall, width - 2 * wall, 6], radius - wall);
  }
  for (y = [wall + 0.2, outer.y - wall - 0.2]) translate([outer.x / 2, y, -3]) snap(length / 2 - 1);
}

if (part != "lid") box();
if (part != "box") translate([0, width + 4 * wall + 10, 0]) lid();
