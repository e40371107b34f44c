// How people use libraries of attachments: parts that are placed on the sides of others.
use <attachments_library.scad>

$fn = 36;
block([60, 40, 10]) {
  on_side("top") tube(20, 14, 15) on_side("top") ball(8);
  for (s = ["left", "right"]) on_side(s) block([20, 20, 6], r = 2) on_side("top") rod(6, 12);
  on_side("front") cut() rod(8, 10);
  on_side("back") rounded_block([30, 8, 6], 1.5);
  on_side("bottom") grid(4, 3, 10) rod(4, 6);
}
translate([90, 0, 0]) row(6, 14) rounded_block([10, 30, 4 + 2 * $index], 1.5) on_side("top") ball(3);
