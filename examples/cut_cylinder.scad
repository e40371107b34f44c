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

// Random numbers in [0, 1), five for each cutter, all from one list.
draws = 5;
drawn = rands(0, 1, draws * n, seed);
function draw(i, which) = drawn[draws * i + which];
function along(i) = draw(i, 1);
function turn_deg(i) = 360 * draw(i, 2);
function tilt_deg(i) = max_tilt_deg * draw(i, 3);
function tilt_turn_deg(i) = 360 * draw(i, 4);

// Shares of the surface's area.
wall_area = 2 * radius * height;
cap_area = radius * radius;
wall_share = wall_area / (wall_area + 2 * cap_area);
top_share = cap_area / (wall_area + 2 * cap_area);

// OpenSCAD 2021.01 refuses ranges of 10,000 numbers and more.
chunk = 1000;

// The i-th point, uniformly by area, and the surface's outward normal there.
function is_wall(i) = draw(i, 0) < wall_share;
function is_top(i) = draw(i, 0) < wall_share + top_share;
function round_z(a) = [cos(a), sin(a), 0];
function point(i) =
    is_wall(i) ? [radius * cos(turn_deg(i)), radius * sin(turn_deg(i)), (along(i) - 0.5) * height]
               : radius * sqrt(along(i)) * round_z(turn_deg(i)) + normal(i) * height / 2;
function normal(i) = is_wall(i) ? round_z(turn_deg(i)) : [0, 0, is_top(i) ? 1 : -1];

// A unit vector across the normal, and the normal tilted towards a random side.
function across(i) =
    is_wall(i) ? cos(tilt_turn_deg(i)) * round_z(turn_deg(i) + 90) + [0, 0, sin(tilt_turn_deg(i))]
               : round_z(tilt_turn_deg(i));
function tilted(i) = cos(tilt_deg(i)) * normal(i) + sin(tilt_deg(i)) * across(i);

difference() {
    cylinder(h = height, r = radius, center = true);
    for (first = [0 : chunk : n - 1])
        for (i = [first : min(first + chunk, n) - 1])
            if (cutter == "sphere")
                translate(point(i)) sphere(r = sphere_radius);
            else
                translate(point(i) - cone_inside * cone_height * tilted(i))
                    rotate([0, acos(tilted(i).z), atan2(tilted(i).y, tilted(i).x)])
                        cylinder(h = cone_height, r1 = 0, r2 = cone_radius);
}
