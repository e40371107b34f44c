// The paper's CS10000: a cylinder minus 10000 spheres on its surface.
include <cut_cylinder.scad>
n = 10000;
cutter = "sphere";
