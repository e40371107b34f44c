// The paper's CSn and CCn: a cylinder minus n spheres, or n cones, on its surface.
//
// A design of its own for any n up to 1,000,000, for example
//   openscad -D n=100000 -o /tmp/cs100000.csg cut_cylinder.scad
// and the base of cs100.scad and its kin, which include it and set n and cutter.

n = 1000;            // how many
cutter = "sphere";   // or "cone"
seed = 1;            // of the random numbers

radius = 10;
height = 20;
$fn = 48;

// Spheres: half of each lies outside, their areas on the surface add up to a constant.
sphere_radius = 20 / sqrt(n);

// Cones: the apex inwards, two thirds of the height inside.
cone_radius = 26 / sqrt(n);
cone_height = 4 * cone_radius;
cone_inside = 2 / 3;
max_tilt_deg = 40;

// Random numbers in [0, 1), one list for each quantity that is drawn.
where = rands(0, 1, n, seed);
along = rands(0, 1, n, seed + 1);
turn = rands(0, 360, n, seed + 2);
tilt_deg = rands(0, max_tilt_deg, n, seed + 3);
tilt_turn = rands(0, 360, n, seed + 4);

// Shares of the surface's area.
wall_area = 2 * radius * height;
cap_area = radius * radius;
wall_share = wall_area / (wall_area + 2 * cap_area);
top_share = cap_area / (wall_area + 2 * cap_area);

// OpenSCAD 2021.01 refuses ranges of 10,000 numbers and more.
chunk = 1000;

// Puts the children on the surface at the i-th random point, +z pointing outwards.
module on_surface(i) {
    if (where[i] < wall_share)
        rotate([0, 0, turn[i]]) translate([radius, 0, (along[i] - 0.5) * height])
            rotate([0, 90, 0]) children();
    else if (where[i] < wall_share + top_share)
        rotate([0, 0, turn[i]]) translate([radius * sqrt(along[i]), 0, height / 2]) children();
    else
        rotate([0, 0, turn[i]]) translate([radius * sqrt(along[i]), 0, -height / 2])
            rotate([180, 0, 0]) children();
}

module cut(i) {
    if (cutter == "sphere")
        on_surface(i) sphere(r = sphere_radius);
    else
        on_surface(i) rotate([0, 0, tilt_turn[i]]) rotate([0, tilt_deg[i], 0])
            translate([0, 0, -cone_inside * cone_height])
                cylinder(h = cone_height, r1 = 0, r2 = cone_radius);
}

difference() {
    cylinder(h = height, r = radius, center = true);
    for (first = [0 : chunk : n - 1])
        for (i = [first : min(first + chunk, n) - 1])
            cut(i);
}
