// A house sign: raised letters, a number cut right through, and screws.
name = "Rose Cottage";
number = "27";
size = [150, 62];
thickness = 4;

module plate(grow) {
  offset(r = 8 + grow, $fn = 96) square(size - [16, 16], center = true);
}

module screw_hole() {
  translate([0, 0, -1]) cylinder(h = thickness + 2, d = 4, $fn = 48);
  translate([0, 0, thickness - 2]) cylinder(h = 2.1, d1 = 4, d2 = 8.2, $fn = 48);
}

difference() {
  color("SteelBlue") linear_extrude(thickness) plate(0);
  color("White") translate([0, 0, thickness - 1]) linear_extrude(2, convexity = 4)
    difference() {
      plate(-2.5);
      plate(-4);
    }
  color("White") translate([0, -17, -1]) linear_extrude(thickness + 2, convexity = 6)
    text(number, size = 18, halign = "center", valign = "center", spacing = 1.1);
  for (x = [-1, 1]) translate([x * 62, -17, 0]) screw_hole();
}

color("White") translate([0, 12, thickness]) linear_extrude(1.5, convexity = 6)
  text(name, size = 15, halign = "center", valign = "center");
