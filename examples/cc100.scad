// The paper's CC100: a cylinder minus 100 cones that bite through its surface.
include <cut_cylinder.scad>
n = 100;
cutter = "cone";
