// A lampshade: a dodecahedron hollowed by a ball that breaks through its faces, a frame of its edges.
// It stands on a face. Millimetres.

cube_edge = 100;         // of the cube whose corners are among the dodecahedron's
hollow = 76;             // the ball's radius
$fn = 64;

phi = (1 + sqrt(5)) / 2;
signs = [-1, 1];

// The corners of a cube of edge 2, and of three rectangles through its middle.
points = [
    for (x = signs, y = signs, z = signs) [x, y, z],
    for (a = signs, b = signs) [0, a / phi, b * phi],
    for (a = signs, b = signs) [a / phi, b * phi, 0],
    for (a = signs, b = signs) [a * phi, 0, b / phi]
];
// Clockwise seen from outside.
faces = [
    [4, 8, 0, 12, 14], [14, 12, 1, 9, 5], [15, 13, 2, 10, 6],
    [7, 11, 3, 13, 15], [1, 12, 0, 16, 17], [17, 16, 2, 13, 3],
    [19, 18, 4, 14, 5], [7, 15, 6, 18, 19], [2, 16, 0, 8, 10],
    [11, 9, 1, 17, 3], [10, 8, 4, 18, 6], [7, 19, 5, 9, 11]
];

// [1, 0, phi] is the normal of a face.
rotate([0, -atan(1 / phi), 0]) difference() {
    color("Gold") polyhedron(points * cube_edge / 2, faces);
    color("SteelBlue") sphere(r = hollow);
}
