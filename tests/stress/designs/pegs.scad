// A seventh of a turn per peg; the pegs are flush with the disc above and stand out below.
difference() {
  rotate([0, 65, 0]) union() {
    for (i = [0:6]) rotate([0, 0, i * 360 / 7]) translate([8, 0, -3]) cylinder(h = 8, r = 1.5);
    cylinder(h = 5, r = 10);
  }
  rotate([0, 65, 0]) for (i = [0:6]) rotate([0, 0, (i + 0.5) * 360 / 7]) translate([6, 0, 1])
    cylinder(h = 4, r = 1);
}
