// A scallop's shell, for mould.scad. openscad -o shell.stl shell.scad has written the file beside it.
ribs = 9;
around = 36;
across = 6;

function rim(a) = 20 * (1 + 0.04 * cos(ribs * 2 * a)) * (1 - 0.25 * abs(a) / 180);
function point(i, k) =
  let (a = 360 * i / around - 180, share = k / across)
  [rim(a) * share * cos(a), rim(a) * share * sin(a), 7 * sqrt(1.02 - share * share)];

points = concat(
  [[0, 0, 7]],
  [for (k = [1:across], i = [0:around - 1]) point(i, k)],
  [for (i = [0:around - 1]) [point(i, across).x, point(i, across).y, -1]]);
function at(k, i) = 1 + (k - 1) * around + i % around;
faces = concat(
  [for (i = [0:around - 1]) [0, at(1, i + 1), at(1, i)]],
  [for (k = [1:across], i = [0:around - 1]) [at(k, i), at(k, i + 1), at(k + 1, i + 1), at(k + 1, i)]],
  [[for (i = [0:around - 1]) at(across + 1, i)]]);

polyhedron(points, faces, convexity = 4);
