// A clamp for a cable, with two M4 screws: one nut drops into a hexagonal trap, the other slides in
// from the side. Millimetres.

block = [44, 18, 14];
cable = 9;               // diameter
screw = 4.3;             // the hole's diameter
nut = [7.2, 3.4];        // across the flats, height
screws = 15;             // from the middle
through = 1;             // how far a cutter stands out of what it cuts

// A hexagon's radius is that to its corners.
module nut(height) {
    cylinder(h = height, d = nut[0] / cos(30), $fn = 6);
}

module hole() {
    translate([0, 0, -through]) cylinder(h = block[2] + 2 * through, d = screw, $fn = 64);
}

difference() {
    translate([-block[0] / 2, -block[1] / 2, 0]) cube(block);
    // The cable's channel, half of it in this part.
    translate([0, 0, block[2]]) rotate([90, 0, 0])
        cylinder(h = block[1] + 2 * through, d = cable, center = true, $fn = 96);
    for (side = [-1, 1]) translate([side * screws, 0, 0]) hole();
    color("Tomato") translate([-screws, 0, block[2] - nut[1]]) nut(nut[1] + through);
    color("SteelBlue") translate([screws, 0, 4]) {
        rotate([0, 0, 30]) nut(nut[1]);
        translate([0, -nut[0] / 2, 0]) cube([block[0], nut[0], nut[1]]);
    }
}
