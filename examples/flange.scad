// A welding neck flange for a pipe, DN 50: eight bolts, a raised face with sealing grooves, a
// tapered hub. Millimetres.

bore = 54.5;
pipe = 60.3;             // the neck's outer diameter where the pipe is welded on
flange = [165, 20];      // outer diameter, thickness
face = [102, 2];         // the raised face
hub = 78;                // the hub's diameter where it meets the flange
neck = [45, 12];         // height of the tapered part, of the straight one
bolts = 8;
bolt_circle = 125;
bolt_hole = 18;
spot_face = [32, 1.5];   // where the nuts sit
grooves = [72, 80, 88];  // diameters
groove_depth = 0.8;
through = 1;             // how far a cutter stands out of what it cuts
$fn = 96;

module body() {
    cylinder(h = flange[1], d = flange[0]);
    // Sunk into the flange, so that no faces coincide.
    translate([0, 0, -face[1]]) cylinder(h = face[1] + through, d = face[0]);
    translate([0, 0, flange[1] - through])
        cylinder(h = neck[0] - flange[1] + through, d1 = hub, d2 = pipe);
    translate([0, 0, neck[0] - through]) cylinder(h = neck[1] + through, d = pipe);
}

module bolt_hole() {
    translate([0, 0, -through]) cylinder(h = flange[1] + 2 * through, d = bolt_hole);
    translate([0, 0, flange[1] - spot_face[1]]) cylinder(h = 10, d = spot_face[0]);
}

// A ring-shaped groove in the raised face.
module groove(diameter) {
    difference() {
        translate([0, 0, -face[1] - through])
            cylinder(h = groove_depth + through, d = diameter + 1.5);
        translate([0, 0, -face[1] - 2 * through])
            cylinder(h = groove_depth + 3 * through, d = diameter - 1.5);
    }
}

difference() {
    color("Silver") body();
    color("LightSlateGray") {
        translate([0, 0, -face[1] - through])
            cylinder(h = face[1] + neck[0] + neck[1] + 2 * through, d = bore);
        // The weld's bevel at the neck: what is outside of a cone goes.
        difference() {
            translate([0, 0, neck[0] + neck[1] - 4]) cylinder(h = 10, d = pipe + 10);
            translate([0, 0, neck[0] + neck[1] - 6])
                cylinder(h = 14, d1 = pipe + 4, d2 = pipe - 13);
        }
        for (i = [0 : bolts - 1])
            rotate([0, 0, 360 * (i + 0.5) / bolts]) translate([bolt_circle / 2, 0, 0]) bolt_hole();
    }
    color("DimGray") for (d = grooves) groove(d);
}
