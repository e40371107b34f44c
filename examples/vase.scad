// A vase: a profile that is revolved.
wall = 1.6;
height = 90;

function radius(z) = 22 + 9 * sin(z * 3.6 + 20) + z / 12;

rotate_extrude($fn = 120)
  polygon(concat(
    [[0, 0]],
    [for (z = [0 : 2 : height]) [radius(z), z]],
    [for (z = [height : -2 : 2 * wall]) [radius(z) - wall, z]],
    [[0, 2 * wall]]));
