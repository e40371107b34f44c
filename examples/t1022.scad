// A round temple of exactly 1,022 primitives, after Bramante's Tempietto: steps, a ring of fluted
// columns, an entablature with dentils, a balustrade, a cella with doors and niches, a drum with
// windows and half columns, a ribbed dome with a lantern. Metres.
//
// Parts that stand on one another overlap by `sunk`, so that no faces coincide.

$fn = 48;
sunk = 0.05;

steps = 5;               // steps: 5
step = [0.3, 0.55];      // rise, tread
floor_z = steps * step[0];

columns = 24;            // of 22 primitives: 528
column_circle = 12;
flutes = 16;
shaft = [0.7, 0.58, 6];  // radius below, above; height
base_z = 0.62;           // from the floor to the shaft
capital_z = base_z + shaft[2];
column_z = capital_z + 0.95;

entablature_z = floor_z + column_z;   // entablature and roof: 8
dentils = 96;                         // 96
terrace_z = entablature_z + 2.3;
balusters = 72;                       // of 2: 144
pedestals = 12;                       // of 3: 36; with the rings 40

cella = 8;               // cella: 2, doors 4 of 3, niches 8 of 4: 46
doors = 4;
wall = 0.9;

drum_z = terrace_z + 4.6;             // drum and cornice: 5; with windows and half columns 101
windows = 12;                         // of 2: 24
half_columns = 24;                    // of 3: 72

dome = 7.6;              // dome: 4; with the ribs 16
ribs = 12;               // discs, of which each shows as two ribs: 12
lantern_z = drum_z + 8.35;
lantern_columns = 10;    // of 3: 30; with its ring, roof, ball and cross 38

stone = "Wheat";
pale = "AntiqueWhite";
dark = "Tan";

module around(count, radius, half_step = false) {
    for (i = [0 : count - 1])
        rotate([0, 0, 360 * (i + (half_step ? 0.5 : 0)) / count]) translate([radius, 0, 0])
            children();
}

// From z to z + height, and `sunk` into what is below.
module tier(z, height, radius, top_radius) {
    translate([0, 0, z - sunk])
        cylinder(h = height + sunk, r1 = radius, r2 = is_undef(top_radius) ? radius : top_radius);
}

module ball(z, radius, height) {
    translate([0, 0, z]) scale([radius, radius, height]) sphere(r = 1);
}

// What a door, a niche or a window takes: round in plan, with half a ball above.
module opening(z, height, radius) {
    translate([0, 0, z]) cylinder(h = height, r = radius);
    ball(z + height, radius, radius);
}

module stairs() {
    for (i = [0 : steps - 1])
        tier(i * step[0], step[0], column_circle + 1.6 + (steps - 1 - i) * step[1]);
}

module column() {
    tier(0, 0.35, 1);
    ball(0.47, 0.93, 0.2);
    difference() {
        tier(base_z, shaft[2], shaft[0], shaft[1]);
        // Each flute follows the shaft's taper.
        for (i = [0 : flutes - 1])
            rotate([0, 0, 360 * (i + 0.5) / flutes]) translate([shaft[0], 0, base_z + 0.3])
                rotate([0, -atan2(shaft[0] - shaft[1], shaft[2]), 0])
                    cylinder(h = shaft[2] - 0.7, r = 0.09);
    }
    ball(capital_z, shaft[1] + 0.1, 0.09);
    tier(capital_z + 0.1, 0.5, shaft[1], 0.95);
    tier(capital_z + 0.6, 0.35, 1.02);
}

module entablature() {
    difference() {
        union() {
            tier(0, 0.5, column_circle + 0.78);
            tier(0.5, 0.4, column_circle + 0.88);
            tier(0.9, 0.65, column_circle + 0.72);
            tier(1.55, 0.35, column_circle + 0.8, column_circle + 1.3);
            tier(1.9, 0.4, column_circle + 1.45);
        }
        // Open below, over the walk between the columns and the cella.
        translate([0, 0, -1]) cylinder(h = 2.5, r = column_circle - 0.78);
        translate([0, 0, -2]) cylinder(h = 9, r = cella - wall / 2);
    }
    // Where the ambulatory's ceiling' ring meets the cella's wall.
    tier(0, 0.3, cella + 0.25);
}

module dentil() {
    translate([0, 0, 1.42]) rotate([0, 90, 0]) cylinder(h = 0.4, r = 0.13);
}

module ring(z, height, radius, width) {
    difference() {
        tier(z, height, radius + width / 2);
        tier(z - 1, height + 2, radius - width / 2);
    }
}

module balustrade() {
    ring(0, 0.2, column_circle + 0.8, 0.7);
    ring(1.15, 0.2, column_circle + 0.8, 0.6);
    around(balusters, column_circle + 0.8, true) {
        ball(0.5, 0.19, 0.35);
        tier(0.7, 0.5, 0.09, 0.14);
    }
    around(pedestals, column_circle + 0.8) {
        tier(0.02, 1.48, 0.42);
        tier(1.5, 0.25, 0.2, 0.34);
        ball(2, 0.36, 0.4);
    }
}

module cella_wall() {
    difference() {
        tier(0, entablature_z - floor_z + 1, cella);
        translate([0, 0, -1]) cylinder(h = 20, r = cella - wall);
        for (side = [0 : doors - 1]) rotate([0, 0, 90 * side - 90]) {
            translate([cella - wall / 2, 0, 0]) opening(0.02, 3.4, 1.25);
            // A round window over each door.
            translate([cella - 2 * wall, 0, 6]) rotate([0, 90, 0]) cylinder(h = 3, r = 0.7);
        }
        for (side = [0 : doors - 1], turn = [-30, 30]) rotate([0, 0, 90 * side + turn - 45])
            translate([cella + 0.25, 0, 0]) opening(1.2, 2.8, 0.85);
    }
    // An urn with its lid in every niche.
    for (side = [0 : doors - 1], turn = [-30, 30])
        rotate([0, 0, 90 * side + turn - 45]) translate([cella - 0.05, 0, 1.2]) {
            tier(0, 1.3, 0.18, 0.42);
            ball(1.25, 0.36, 0.3);
        }
}

module upper_drum() {
    difference() {
        tier(0, drum_z - terrace_z, cella - 0.1);
        translate([0, 0, -2]) cylinder(h = 12, r = cella - wall);
        around(windows, cella - wall / 2) opening(1.6, 1.6, 0.62);
    }
    around(half_columns, cella - 0.1, true) {
        tier(0, 0.4, 0.36);
        tier(0.4, 3.6, 0.27, 0.24);
        tier(4, 0.35, 0.24, 0.38);
    }
    difference() {
        union() {
            tier(4.35, 0.3, cella + 0.3);
            tier(4.65, 0.3, cella + 0.5, cella + 0.75);
        }
        translate([0, 0, 3]) cylinder(h = 3, r = cella - wall + 0.1);
    }
}

module dome() {
    difference() {
        union() {
            scale([1, 1, 1.08]) sphere(r = dome, $fn = 96);
            // Thin discs through the axis: their rims are the ribs.
            for (i = [0 : ribs - 1])
                rotate([0, 0, 180 * (i + 0.25) / ribs])
                    scale([1, 0.04, 1.08]) sphere(r = dome + 0.16, $fn = 96);
        }
        scale([1, 1, 1.08]) sphere(r = dome - 0.5, $fn = 96);
        translate([0, 0, -2 * dome]) cylinder(h = 2 * dome, r = 2 * dome);
        cylinder(h = 2 * dome, r = 0.9);
    }
}

module lantern() {
    ring(-0.6, 0.9, 1.2, 1);
    around(lantern_columns, 1.25) {
        tier(0.3, 0.15, 0.2);
        tier(0.45, 1.6, 0.14, 0.12);
        tier(2.05, 0.15, 0.12, 0.2);
    }
    tier(2.2, 0.25, 1.6, 1.75);
    ball(2.4, 1.4, 1.2);
    tier(3.5, 0.5, 0.2, 0.12);
    ball(4.15, 0.32, 0.32);
    tier(4.45, 1.5, 0.07);
    translate([-0.45, 0, 5.4]) rotate([0, 90, 0]) cylinder(h = 0.9, r = 0.065);
}

color(dark) stairs();
color(pale) translate([0, 0, floor_z]) around(columns, column_circle) column();
color(stone) translate([0, 0, entablature_z]) entablature();
color(pale) translate([0, 0, entablature_z]) around(dentils, column_circle + 0.6) dentil();
color(pale) translate([0, 0, terrace_z]) balustrade();
color(stone) translate([0, 0, floor_z]) cella_wall();
color(stone) translate([0, 0, terrace_z]) upper_drum();
color("SteelBlue") translate([0, 0, drum_z + 0.3]) dome();
color(pale) translate([0, 0, lantern_z + 0.1]) lantern();
