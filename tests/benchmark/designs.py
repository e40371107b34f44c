"""The designs that are measured: examples, and made ones of any size."""

import math
import pathlib

import numpy

from measuring import EXAMPLES, ROOT, run_right


def design(name, settings):
    """Returns the .scad of an example, or of csN or ccN for any N up to 1,000,000: a cylinder minus N spheres or
    cones."""
    path = EXAMPLES / f"{name}.scad"
    if path.exists():
        return path
    cutter = {"cs": "sphere", "cc": "cone"}[name[:2]]
    return written(settings, f"{name}.scad", f"""include <{EXAMPLES / "cut_cylinder.scad"}>
n = {int(name[2:])};
cutter = "{cutter}";
""")


def written(settings, name, text):
    path = settings.work / name
    path.write_text(text)
    return path


# --- Designs of the kinds that people publish: ours, and those of Debian's package openscad ---

OPENSCAD = pathlib.Path("/usr/share/openscad/examples")
OWN = ROOT / "tests/benchmark/designs"
REAL = [(folder / f"{name}.scad", kind) for kind, folder, names in [
    ("box", OWN, "snap_box bin rounded"), ("box", EXAMPLES, "box enclosure shell"),
    ("thread", OWN, "thread"), ("thread", EXAMPLES, "bolt cap nut_trap"),
    ("gear", OWN, "gears"), ("gear", EXAMPLES, "gear pulley belt_pulley"),
    ("vase", OWN, "twisted_vase"), ("vase", EXAMPLES, "vase"), ("vase", OPENSCAD / "Basics", "rotate_extrude"),
    ("text", OWN, "dice"), ("text", EXAMPLES, "sign"), ("text", OPENSCAD / "Basics", "LetterBlock text_on_cube"),
    ("hulls", OWN, "hull_chain"), ("hulls", EXAMPLES, "handle knob"), ("hulls", OPENSCAD / "Old", "example006"),
    ("import", EXAMPLES, "stamp mould"), ("import", OPENSCAD / "Old", "example007 example010 example016"),
    ("Customizer", OPENSCAD / "Parametric", "candleStand sign"),
    ("library", OWN, "attachments"), ("library", EXAMPLES, "flange bracket"),
    ("extrusion", OPENSCAD / "Basics", "linear_extrude"), ("extrusion", OWN, "honeycomb"),
    ("extrusion", OPENSCAD / "Old", "example020"), ("projection", OPENSCAD / "Advanced", "GEB"),
    ("drawing", OWN, "laser_box"), ("assembly", OWN, "assembly"), ("assembly", OPENSCAD / "Old", "example017"),
    ("recursion", OPENSCAD / "Advanced", "module_recursion"), ("recursion", OPENSCAD / "Old", "example024"),
] for name in names.split()]


# --- Families that grow. Each makes the file of n of what it counts ---

# OpenSCAD 2021.01 takes no ranges of 10,000 numbers and more.
EACH = "for (first = [0 : 1000 : n - 1]) for (i = [first : min(first + 1000, n) - 1]) "
IN_A_CUBE = """side = ceil(pow(n, 1 / 3) - 1e-6);
function at(i) = [i % side, floor(i / side) % side, floor(i / side / side)];
"""


def scad(text):
    return lambda settings, name, n: written(settings, f"{name}{n}.scad", f"n = {n};\n{text}\n")


def cut_cylinder(settings, name, n):
    """A .csg, since evaluating a million of them says little about drawing."""
    csg = settings.work / f"{name}{n}.csg"
    run_right([settings.scadray, "-q", "-o", csg, design(f"{name}{n}", settings)], limit_s=1800)
    return csg


def deep(settings, name, n):
    """A .csg: spheres subtracted and added in turn, each from and to all before it."""
    text = "sphere(r = 10);"
    parts, heads = [text], []
    for i in range(1, n):
        heads.append("union() {" if (n - i) % 2 else "difference() {")
        turn, height = 2.4 * i, 20 * i / n - 10
        level = math.sqrt(max(0, 100 - height * height))
        parts.append(f"multmatrix([[1,0,0,{level * math.cos(turn):.9g}],[0,1,0,{level * math.sin(turn):.9g}],"
                     f"[0,0,1,{height:.9g}],[0,0,0,1]]) sphere(r = {20 / math.sqrt(n):.9g});}}")
    return written(settings, f"{name}{n}.csg", "\n".join(heads + parts) + "\n")


def letters(settings, name, n):
    words = "".join("abcdefghij klmnopqrst uvwxyz"[i % 28] for i in range(n))
    width = math.ceil(2 * math.sqrt(n))
    return written(settings, f"{name}{n}.scad", "".join(
        f'translate([0, {-14 * (i // width)}, 0]) linear_extrude(2) text("{words[i:i + width]}");\n'
        for i in range(0, n, width)))


def triangles(settings, name, n):
    """A bumpy torus in a binary STL."""
    rows = max(3, round(math.sqrt(n / 8)))
    columns = 4 * rows
    tube, turn = numpy.meshgrid(numpy.arange(rows + 1) % rows * 2 * numpy.pi / rows,
                                numpy.arange(columns + 1) % columns * 2 * numpy.pi / columns, indexing="ij")
    thick = 3 + 0.3 * numpy.sin(5 * tube) * numpy.cos(8 * turn)
    across = 10 + thick * numpy.cos(tube)
    p = numpy.stack([across * numpy.cos(turn), across * numpy.sin(turn), thick * numpy.sin(tube)], axis=-1)
    a, b, c, d = p[:-1, :-1], p[:-1, 1:], p[1:, 1:], p[1:, :-1]
    corners = numpy.stack([a, b, c, a, c, d], axis=2).reshape(-1, 3, 3)
    facets = numpy.zeros(len(corners), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    facets["corners"] = corners
    path = settings.work / f"{name}{n}.stl"
    path.write_bytes(bytes(80) + len(facets).to_bytes(4, "little") + facets.tobytes())
    return path


# By name: a title, what n counts, and the maker. Beyond `MOST` a family's time says nothing new.
FAMILIES = {
    "cs": ("a cylinder minus spheres, a .csg", "spheres", cut_cylinder),
    "cc": ("a cylinder minus cones, a .csg", "cones", cut_cylinder),
    "parts": ("pierced balls side by side", "balls", scad(
        IN_A_CUBE + EACH + "translate(at(i)) difference() { sphere(0.4); cylinder(1, r = 0.2, center = true); }")),
    "deep": ("spheres subtracted and added in turn, a .csg", "spheres", deep),
    "nodes": ("modules with children, evaluated", "calls", scad(
        IN_A_CUBE + "module put(p) translate(p) children();\n" + EACH + "put(at(i)) cube(0.8);")),
    "hulls": ("hulls of two balls", "hulls", scad(
        IN_A_CUBE + EACH + "translate(at(i)) hull() { sphere(0.2); translate([0.5, 0.1, 0.2]) sphere(0.3); }")),
    "letters": ("extruded text", "letters", letters),
    "triangles": ("a bumpy torus, an STL", "triangles", triangles),
    "equal": ("equal cubes in one place", "cubes", scad(EACH + "cube(10);")),
    "flush": ("flush plates that overlap", "plates", scad(EACH + "translate([i % 37, i % 41, 0]) cube([60, 60, 5]);")),
    "pockets": ("pockets as deep as their plate's steps", "pockets", scad(
        "side = ceil(sqrt(n));\ndifference() { translate([-1, -1, 0]) cube([side + 2, side + 2, 3]);\n" + EACH +
        "translate([i % side, floor(i / side), 1 + i % 2]) cube([0.6, 0.6, 2]); }")),
}
MOST = {"deep": 10_000, "letters": 100_000, "hulls": 100_000, "equal": 10_000, "flush": 10_000, "pockets": 100_000}


# --- 1,000 primitives that are seen, and more that the picture does not show ---

# From above, so that turning the camera about z, as `scadray bench` does, turns the picture about its middle.
CAMERA = [0, 0, 0, 0, 0, 0, 90]
TAN = math.tan(math.radians(22.5 / 2))  # half of the picture's height, at a distance of 1
ASPECT = 4 / 3
CORNER = math.hypot(1, ASPECT)  # from the picture's middle, in half heights
BODY = 10  # the radius, and half of the height, of a cylinder


def on_screen(across, upwards, depth):
    """Places at `across` and `upwards` half heights of the picture from its middle; `depth` in distances of the
    body's middle."""
    depth = CAMERA[6] * depth
    return numpy.stack(numpy.broadcast_arrays(TAN * depth * across, TAN * depth * upwards, CAMERA[6] - depth), axis=-1)


def balls(places, radii):
    radii = numpy.broadcast_to(radii, len(places))
    return "".join(f"multmatrix([[1,0,0,{x:.9g}],[0,1,0,{y:.9g}],[0,0,1,{z:.9g}],[0,0,0,1]]) sphere($fn=0,r={r:.9g});\n"
                   for (x, y, z), r in zip(places, radii))


def body(inside="", wall=False):
    """A cylinder, or a plate that fills the picture, with 999 holes that are seen, and more of what is subtracted."""
    random = numpy.random.default_rng(2)
    turn, far = random.uniform(0, 2 * math.pi, 999), numpy.sqrt(random.uniform(0, 1, 999)) * (30 if wall else BODY)
    top, radius = (1, 40) if wall else (BODY, BODY)
    holes = numpy.stack([far * numpy.cos(turn), far * numpy.sin(turn), numpy.full(999, top)], axis=-1)
    return (f"difference() {{\ncylinder($fn=0,h={2 * top},r1={radius},r2={radius},center=true);\n"
            f"{balls(holes, 0.447)}{inside}}}\n")


def unseen_scenes(n):
    """Yields each scene's name, the text of its file alone, and with n primitives that cannot be seen."""
    made = numpy.random.default_rng(1)

    def uniform(low, high):
        return made.uniform(low, high, n)
    radii, turn = uniform(0.02, 0.12), uniform(0, 2 * math.pi)
    aside = uniform(1.1 * CORNER, 4)
    off_screen = on_screen(aside * numpy.cos(turn), aside * numpy.sin(turn), uniform(0.2, 2))
    in_shadow = on_screen(0, 0, uniform(1.3, 2)) + numpy.column_stack([made.uniform(-6, 6, (n, 2)), numpy.zeros(n)])
    behind = on_screen(uniform(-ASPECT, ASPECT), uniform(-1, 1), uniform(1.1, 1.5))
    far = 9 * numpy.sqrt(uniform(0, 1))
    in_core = numpy.stack([far * numpy.cos(turn), far * numpy.sin(turn), uniform(-9, 9)], axis=-1)
    before = on_screen(uniform(-ASPECT, ASPECT), uniform(-1, 1), uniform(0.5, 0.8))
    left, right = (on_screen(numpy.array([x]), 0, 0.6) for x in (-0.3, 0.7))
    in_left = left + in_core * 0.3
    alone, wall = body(), body(wall=True)
    yield "off the screen", alone, alone + balls(off_screen, radii)
    yield "behind a body", alone, alone + balls(in_shadow, radii)
    yield "behind a wall", wall, wall + balls(behind, radii)
    yield "voids in a body", alone, body(balls(in_core, radii))
    yield "within a body", alone, alone + balls(in_core, radii)
    yield "subtracted from nothing", alone, body(balls(before, radii))
    yield ("intersected with what is beside", alone,
           alone + f"intersection() {{ union() {{\n{balls(in_left, radii)}}}\n{balls(right, 4)}}}\n")
