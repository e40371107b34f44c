// The paper's CS1000: a cylinder minus 1000 spheres on its surface.
include <cut_cylinder.scad>
n = 1000;
cutter = "sphere";
