// An angle bracket: two plates, two gussets, countersunk holes and a slot. Millimetres.

width = 50;
base = 46;               // length of the plate that lies
back = 40;               // height of the plate that stands
thickness = 5;
gusset = [4, 22];        // thickness, legs
screw = 5.2;             // diameter
sink = 10.4;             // of a countersunk head
slot = 14;               // length
through = 1;             // how far a cutter stands out of what it cuts
$fn = 64;

// A triangular prism in the corner of the plates.
module gusset() {
    w = gusset[0];
    l = gusset[1];
    polyhedron(
        points = [[0, 0, 0], [0, l, 0], [0, 0, l], [w, 0, 0], [w, l, 0], [w, 0, l]],
        faces = [[0, 1, 2], [5, 4, 3], [0, 3, 4, 1], [1, 4, 5, 2], [2, 5, 3, 0]]);
}

module sunk_hole() {
    translate([0, 0, -through]) cylinder(h = thickness + 2 * through, d = screw);
    translate([0, 0, thickness - (sink - screw) / 2])
        cylinder(h = (sink - screw) / 2 + 0.01, d1 = screw, d2 = sink + 0.02);
}

// Its inside towards the default view.
rotate([0, 0, 180]) difference() {
    union() {
        cube([width, base, thickness]);
        cube([width, thickness, back]);
        for (x = [0, width - gusset[0]]) translate([x, thickness, thickness]) gusset();
    }
    color("SteelBlue") {
        for (x = [1, 3]) translate([x * width / 4, base * 0.7, 0]) sunk_hole();
        // A slot: two holes, and what is between.
        translate([width / 2, 0, back * 0.65]) rotate([-90, 0, 0]) translate([0, 0, -through]) {
            for (side = [-1, 1]) translate([side * slot / 2, 0, 0])
                cylinder(h = thickness + 2 * through, d = screw);
            translate([-slot / 2, -screw / 2, 0]) cube([slot, screw, thickness + 2 * through]);
        }
    }
}
