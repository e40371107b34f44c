// A gearbox as it is assembled, with see-through covers and screws.
explode = 12;
$fn = 40;

module screw(l) {
  color("silver") {
    cylinder(d = 3, h = l);
    translate([0, 0, l]) difference() {
      cylinder(d1 = 5.5, d2 = 5, h = 2.5);
      translate([0, 0, 1]) cylinder(d = 2.8, h = 2, $fn = 6);
    }
  }
}

module wheel(teeth, h, c) color(c) difference() {
  union() {
    cylinder(r = teeth / 2 - 0.6, h = h);
    for (i = [0 : teeth - 1]) rotate(360 * i / teeth) translate([teeth / 2 - 1, -0.7, 0]) cube([1.8, 1.4, h]);
  }
  translate([0, 0, -1]) cylinder(d = 5, h = h + 2);
  for (i = [0 : 4]) rotate(72 * i) translate([teeth / 3.4, 0, -1]) cylinder(d = teeth / 5, h = h + 2);
}

module plate() difference() {
  hull() for (x = [-28, 28], y = [-18, 18]) translate([x, y, 0]) cylinder(r = 4, h = 3);
  for (x = [-12, 14]) translate([x, 0, -1]) cylinder(d = 5.4, h = 5);
  for (x = [-28, 28], y = [-18, 18]) translate([x, y, -1]) cylinder(d = 3.2, h = 5);
}

color("SteelBlue") plate();
translate([-12, 0, 4 + explode]) wheel(30, 5, "Gold");
translate([14, 0, 4 + explode]) wheel(20, 8, "Tomato");
for (x = [-12, 14]) translate([x, 0, -2]) color("dimgray") cylinder(d = 5, h = 30);
color("LightBlue", 0.4) translate([0, 0, 14 + 2 * explode]) plate();
for (x = [-28, 28], y = [-18, 18]) translate([x, y, 16 + 3 * explode]) screw(16);
%translate([0, 0, -6]) cube([90, 60, 1], center = true);
