// A vase of 200 slices of 200 points.
waves = 9;
height = 120;
points = 200;

function outline(r) = [for (i = [0 : points - 1]) let (a = 360 * i / points) (r + 3 * sin(waves * a)) * [cos(a), sin(a)]];

difference() {
  linear_extrude(height, twist = 90, scale = 1.4, slices = 200, convexity = 10) polygon(outline(30));
  translate([0, 0, 2]) linear_extrude(height, twist = 90, scale = 1.4, slices = 200, convexity = 10) polygon(outline(28));
}
