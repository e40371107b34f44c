// A bell crank's lever: two bosses, a tapered arm, bored, countersunk and relieved. 9 primitives.

length = 60;          // between the bores' axes
big_radius = 14;
big_height = 18;
big_bore = 7.5;
small_radius = 8;
small_height = 13;
small_bore = 3.5;
countersink = 1.5;
through = 1;          // how far a cutter stands out of what it cuts
$fn = 96;

module countersink(bore, height) {
    translate([0, 0, height / 2 - countersink])
        cylinder(h = countersink + through, r1 = bore, r2 = bore + countersink + through);
}

difference() {
    color("LightSteelBlue") union() {
        cylinder(h = big_height, r = big_radius, center = true);
        translate([length, 0, 0]) cylinder(h = small_height, r = small_radius, center = true);
        // The arm: a cone from axis to axis, flattened.
        scale([1, 1, 0.55]) rotate([0, 90, 0]) cylinder(h = length, r1 = 11, r2 = 6.5);
    }
    // The big bore with its countersink, and the small bore.
    cylinder(h = big_height + 2 * through, r = big_bore, center = true);
    countersink(big_bore, big_height);
    translate([length, 0, 0])
        cylinder(h = small_height + 2 * through, r = small_bore, center = true);
    // Dished on both sides, to save weight.
    color("SlateGray") translate([0.55 * length, 0, 7.2]) scale([14, 5, 5]) sphere(r = 1);
    mirror([0, 0, 1]) color("SlateGray")
        translate([0.55 * length, 0, 7.2]) scale([14, 5, 5]) sphere(r = 1);
    // The oil hole, from behind into the big bore.
    translate([-big_bore / 2, 0, 0]) rotate([0, -90, 0]) cylinder(h = big_radius, r = 1.8);
}
