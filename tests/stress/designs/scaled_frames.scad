// The same faces from scaled frames: what is scaled by 2.5 is flush with what is not.
rotate([25, 35, 45]) difference() {
  scale(2.5) cylinder(h = 2, r = 4);
  translate([0, 0, 1]) cylinder(h = 4, r = 7);
  rotate([0, 0, 19]) scale([2.5, 2.5, 2.5]) translate([3.2, 0, 0]) cylinder(h = 2, r = 0.4);
}
