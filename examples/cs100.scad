// The paper's CS100: a cylinder minus 100 spheres on its surface.
include <cut_cylinder.scad>
n = 100;
cutter = "sphere";
