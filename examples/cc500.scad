// The paper's CC500: a cylinder minus 500 cones that bite through its surface.
include <cut_cylinder.scad>
n = 500;
cutter = "cone";
