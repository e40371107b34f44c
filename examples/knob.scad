// A control knob for a 6 mm shaft: a skirt, a fluted grip, a domed top, a pointer. Millimetres.

skirt = [34, 4];         // diameter, height
grip = [27, 24, 16];     // diameter below, above; height
flutes = 16;
flute = 4;               // diameter
dome_radius = 25;
shaft = 6.1;
key = 1.6;               // diameter
through = 1;             // how far a cutter stands out of what it cuts
$fn = 96;

height = skirt[1] + grip[2];

module body() {
    color("DimGray") {
        cylinder(h = skirt[1] - 1, d = skirt[0]);
        translate([0, 0, skirt[1] - 1.5]) cylinder(h = 1.5, d1 = skirt[0] + 1, d2 = skirt[0] - 2);
    }
    color("DarkSlateGray") difference() {
        // The grip, its top a part of a large ball.
        intersection() {
            translate([0, 0, skirt[1] - through])
                cylinder(h = grip[2] + through, d1 = grip[0], d2 = grip[1]);
            translate([0, 0, height - dome_radius]) sphere(r = dome_radius);
        }
        for (i = [0 : flutes - 1])
            rotate([0, 0, 360 * (i + 0.5) / flutes]) translate([grip[0] / 2 + 0.7, 0, skirt[1] + 2])
                rotate([0, -4, 0]) {
                    cylinder(h = grip[2], d = flute);
                    sphere(d = flute);
                }
        // The dish on top.
        translate([0, 0, height + 7.2]) sphere(r = 10);
    }
}

difference() {
    body();
    // The pointer: a groove along the dome, painted, and its dot on the skirt.
    color("OrangeRed") {
        translate([5.5, 0, height - 0.6]) rotate([0, 110, 0]) cylinder(h = 10, d = 1.6);
        translate([skirt[0] / 2 - 1.8, 0, skirt[1] - 0.2]) sphere(d = 1.6);
    }
    // The shaft's hole, with two keys' grooves.
    color("Gray") {
        translate([0, 0, -through]) cylinder(h = 13 + through, d = shaft);
        for (side = [-1, 1])
            translate([side * shaft / 2, 0, -2 * through]) cylinder(h = 13 + through, d = key);
        // The recess below, and the set screw through the skirt's side.
        translate([0, 0, -through]) cylinder(h = 2.5 + through, d1 = skirt[0] - 4, d2 = 12);
        translate([0, 0, 8]) rotate([0, -90, 0]) cylinder(h = skirt[0], d = 3);
    }
}
