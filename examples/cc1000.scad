// The paper's CC1000: a cylinder minus 1000 cones that bite through its surface.
include <cut_cylinder.scad>
n = 1000;
cutter = "cone";
