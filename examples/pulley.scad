// A V-belt pulley with two grooves, lightening holes and a boss with a set screw. Millimetres.

diameter = 100;
width = 34;
bore = 16;
boss = [36, 46];        // diameter, length
rim = 76;               // the web's outer diameter
web = 12;               // the web's thickness
holes = 6;
hole = 17;
hole_circle = 57;
groove_pitch = 15;
groove_depth = 9;
groove_half_width = 5.5; // at the rim
groove_floor = 2;        // half the floor's width
through = 1;             // how far a cutter stands out of what it cuts
$fn = 96;

// What stays of a disc when the belt's groove is turned into it, upper half: a cone.
module groove_flank() {
    rise = groove_half_width - groove_floor;
    cylinder(h = groove_half_width + through * rise / groove_depth,
             r1 = diameter / 2 - groove_depth - groove_depth * groove_floor / rise,
             r2 = diameter / 2 + through);
}

module groove() {
    difference() {
        cylinder(h = 2 * groove_half_width, d = diameter + 4 * through, center = true);
        groove_flank();
        mirror([0, 0, 1]) groove_flank();
        cylinder(h = 4 * groove_half_width, r = diameter / 2 - groove_depth, center = true);
    }
}

// The hollow beside the web, dished towards the middle.
module hollow() {
    difference() {
        translate([0, 0, web / 2]) cylinder(h = width, d1 = rim - 6, d2 = rim + 6);
        translate([0, 0, web / 2 - through]) cylinder(h = width + 2 * through, d1 = boss[0] + 4,
                                                      d2 = boss[0] - 6);
    }
}

difference() {
    union() {
        color("SlateGray") cylinder(h = width, d = diameter, center = true);
        color("DarkGray") cylinder(h = boss[1], d = boss[0] - 4, center = true);
    }
    color("Silver") {
        for (side = [-1, 1]) translate([0, 0, side * groove_pitch / 2]) groove();
    }
    color("LightSlateGray") {
        hollow();
        mirror([0, 0, 1]) hollow();
        for (i = [0 : holes - 1])
            rotate([0, 0, 360 * i / holes]) translate([hole_circle / 2, 0, 0])
                cylinder(h = web + 2 * through, d = hole, center = true);
    }
    color("Gainsboro") {
        cylinder(h = boss[1] + 2 * through, d = bore, center = true);
        for (side = [0, 1]) mirror([0, 0, side]) translate([0, 0, boss[1] / 2 - 1.5])
            cylinder(h = 1.5 + through, d1 = bore, d2 = bore + 3 + 2 * through);
        // The keyway, round as an end mill leaves it, and the set screw over it.
        translate([bore / 2, 0, 0])
            cylinder(h = boss[1] + 4 * through, d = 5, center = true);
        translate([0, 0, boss[1] / 2 - 5.5]) rotate([0, 90, 0]) cylinder(h = boss[0], d = 5);
    }
}
