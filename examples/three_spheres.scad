// The paper's figure 2: where three spheres intersect, a point protrudes that lies on all three
// surfaces. However small a cell around it is, it meets three primitives.

radius = 10;
offset = 4;   // of each centre from the axis
$fn = 96;

// Turned so that the point faces OpenSCAD's default camera, a little from the side.
rotate([30, 0, 25]) intersection() {
    color("Goldenrod") rotate([0, 0, 90]) translate([offset, 0, 0]) sphere(r = radius);
    color("SteelBlue") rotate([0, 0, 210]) translate([offset, 0, 0]) sphere(r = radius);
    color("IndianRed") rotate([0, 0, 330]) translate([offset, 0, 0]) sphere(r = radius);
}
