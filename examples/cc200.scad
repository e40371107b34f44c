// The paper's CC200: a cylinder minus 200 cones that bite through its surface.
include <cut_cylinder.scad>
n = 200;
cutter = "cone";
