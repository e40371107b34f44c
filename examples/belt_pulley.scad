// A pulley for a round belt: a revolved groove, a hub, and holes that save weight.
rim = 30;
width = 12;

difference() {
  rotate_extrude($fn = 128)
    difference() {
      union() {
        translate([0, -width / 2]) square([rim, width]);
        translate([0, -width]) square([10, 2 * width]);
      }
      translate([rim + 1, 0]) circle(4.5, $fn = 48);
      for (side = [-1, 1]) translate([18.5, side * width / 2]) circle(4, $fn = 48);
      translate([0, -2 * width]) square([4, 4 * width]);
    }
  for (i = [0 : 5]) rotate(i * 60) translate([18.5, 0, 0]) cylinder(r = 3, h = 2 * width, center = true, $fn = 48);
}
// A guard for the belt, around three quarters of it.
translate([0, 0, width]) rotate_extrude(angle = 270, $fn = 96) translate([24, 0]) circle(2, $fn = 48);
