// Panels for a laser cutter, with fingers: a drawing.
size = [100, 60, 40];
thick = 3;
finger = 10;
kerf = 0.15;
gap = 5;

module fingers(length, is_out) {
  count = floor(length / finger / 2) * 2 + 1;
  step = length / count;
  for (i = [0 : count - 1]) if ((i % 2 == 0) == is_out)
    translate([i * step - kerf / 2, -kerf / 2]) square([step + kerf, thick + kerf]);
}

module panel(w, h, is_out) {
  difference() {
    square([w, h]);
    fingers(w, is_out);
    translate([0, h]) mirror([0, 1]) fingers(w, is_out);
    translate([thick, 0]) rotate(90) fingers(h, !is_out);
    translate([w, 0]) rotate(90) fingers(h, !is_out);
  }
}

difference() {
  panel(size.x, size.y, true);
  for (i = [0 : 8], j = [0 : 4]) translate([20 + 7 * i + (j % 2) * 3.5, 18 + 6 * j]) circle(d = 4, $fn = 6);
}
translate([0, size.y + gap]) difference() {
  panel(size.x, size.z, false);
  translate([size.x / 2, size.z / 2]) text("laser", size = 12, halign = "center", valign = "center");
}
translate([size.x + gap, 0]) panel(size.y, size.z, true);
translate([size.x + gap, size.z + gap]) difference() {
  panel(size.y, size.z, true);
  translate([size.y / 2, size.z / 2]) offset(2) square([20, 10], center = true);
}
