// A bolt whose thread is a polyhedron(): a triangle that is swept along a helix, and sunk into the core.
pitch = 2;
length = 16;
radius = 5;
depth = 1.2;
steps_per_turn = 30;
$fn = 64;

module thread() {
  turns = length / pitch - 1;
  steps = steps_per_turn * turns;
  core = radius - depth - 0.2;
  // The groove runs out at both ends.
  function reach(i) = depth * min(1, i / steps_per_turn, (steps - i) / steps_per_turn);
  function corner(angle, r, z) = [r * cos(angle), r * sin(angle), z];
  points = [
    for (i = [0:steps], k = [0:2])
      corner(360 * i / steps_per_turn,
             core + (k == 1 ? 0.2 + reach(i) : 0),
             pitch * (i / steps_per_turn + 0.05 + 0.45 * k))
  ];
  sides = [
    for (i = [0:steps - 1], k = [0:2])
      let (next = (k + 1) % 3)
      [3 * i + k, 3 * i + next, 3 * i + 3 + next, 3 * i + 3 + k]
  ];
  last = 3 * steps;
  polyhedron(points, concat([[2, 1, 0]], sides, [[last, last + 1, last + 2]]), convexity = 10);
}

translate([0, 0, 6]) {
  cylinder(h = length, r = radius - depth);
  thread();
}
intersection() {
  cylinder(h = 6, r = 8, $fn = 6);
  translate([0, 0, -3]) cylinder(h = 20, r1 = 14, r2 = 0);
  translate([0, 0, 9]) mirror([0, 0, 1]) cylinder(h = 20, r1 = 14, r2 = 0);
}
