// Every construct of the language, as a start for damaged designs.
include <nosuch.scad>
use <nosuch.scad>
a = [1, 2, [3, "text\n\u00e9", undef], true]; b = let(x = 2) x ^ 3 % 5 - -a[0] / 2;
c = [for (i = [0:2:10]) if (i > 2) each [i, -i] else i, for (i = 0; i < 3; i = i + 1) i, each "ab"];
f = function(x, y = 2) x == y ? x * y : !x || y && x >= 1;
function g(n) = n < 1 ? 0 : 1 + g(n - 1);
function t(n, s = 0) = n <= 0 ? s : t(n - 1, s + n);
module m(size = 1, $fn = 8) { echo(size, $children, $parent_modules, parent_module(0)); children();
  for (i = [0:$children - 1]) children(i); children([0, 1]); }
$fa = 6; $vpt = [1, 2, 3]; $vpd = 100;
echo(a = a, b, c, f(1), g(30), t(1000), str(f, [0:1], 1e-7, 1e100), version());
assert(len(a) == 4, "four"); assert(g(2) == 2) cube(1);
m(3) { cube([1, 2, 3], center = true); sphere(d = 2, $fn = 5); if (a[0] > 0) circle(1); else square([1, 2]); }
translate([1, 2]) rotate([10, 20, 30]) rotate(30, [1, 1, 0]) scale(2) mirror([1, 0, 0])
  multmatrix([[1, 2, 3, 4], [0, 1]]) color("red", 0.5) #cylinder(h = 2, r1 = 1, d2 = 3);
%linear_extrude(5, twist = 30, slices = 3, scale = [1, 2]) offset(r = 1) polygon([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]);
rotate_extrude(angle = 90) translate([2, 0]) text("Az", font = "x:style=Bold", halign = "center");
difference() { hull() { cube(1); sphere(1); } minkowski(2) { cube(1); sphere(1); } }
intersection_for(i = [1:3]) render(2) resize([1, 2, 3], auto = true) projection(cut = true) cube(i);
import("no.stl"); surface(file = "no.png", invert = true); polyhedron(points = [[0, 0, 0]], faces = [[0, 1, 2]]);
let (z = 3) assign(y = z) for (p = [[1, 2], [3, 4]], q = "ab") echo(p, q, search("a", "banana"), lookup(2, [[1, 2], [3, 4]]));
echo(min(1, 2), max([3, 4]), norm([3, 4]), cross([1, 0, 0], [0, 1, 0]), rands(0, 1, 3, 42), chr([65, 66]), ord("a"));
echo(concat([1], 2), sin(30), atan2(1, 2), pow(2, 3), is_undef(nosuch), [1, 2] * [3, 4], [[1, 2], [3, 4]] * [1, 2], a.x, -[1]);
*cube(9); !union() { cube(1); }
