// Holes and plugs whose faces lie in the plate's faces, by ways of their own through nested frames.
module plate() { rotate([30, 0, 15]) cylinder(h = 6, r = 12); }
module hole() {
  rotate([30, 0, 0]) rotate([0, 0, 15]) translate([4, 0, 6]) rotate([180, 0, 40])
    cylinder(h = 6, r = 3);
}
module plug() {
  rotate([30, 0, 15]) rotate([0, 0, 120]) translate([-4, 5, 0]) rotate([0, 0, -77])
    cylinder(h = 6, r = 2);
}
difference() {
  plate();
  hole();
  plug();
}
plug();
