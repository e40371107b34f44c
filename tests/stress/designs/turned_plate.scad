// A plate in a turned frame, with holes that end flush with both of its faces.
rotate([10, 20, 30]) translate([3, -2, 5]) difference() {
  cylinder(h = 4, r = 20);
  for (i = [0:5]) rotate([0, 0, 60 * i]) translate([12, 0, 0]) cylinder(h = 4, r = 3);
  translate([0, 0, 2]) cylinder(h = 2, r = 6);
}
