"""The sections "growth", "frames" and "stability".

"growth": whole processes from a file to its PNG, from 10 of something on:
{"start_ms": a process that draws nothing,
 "families": [{"name", "title", "counts", "rows": [{"n", "primitives", "file_bytes", "wall_ms", "cpu_ms",
   "peak_bytes": null where it is less than the measuring program's, "stages_ms": {STAGE: summary}: by --stats, which
   counts while it renders}],
   "exponents": {"wall", STAGE: of the growth to the last row from the one before}}],
 "unseen_count", "unseen": [{"scene", "alone_ms": a frame by tiles of 1,000 primitives that are seen while the camera
   turns, "grown_ms": with that many that are not, "ratio"}],
 "left_out"}
"frames", from memory, by the CPU:
{"pixels": [{"design", "rows": [{"width_px", "height_px", FRAMES}]}],
 "threads": [{"design", "width_px", "height_px", "rows": [{"threads", FRAMES}]}]}
  FRAMES: "tiles", "cells": {"first": a picture with nothing prepared, "steady": a frame of a turning camera}
"stability": scenes that become harder, against exact rays:
{"width_px", "height_px", "gl" (if there is one), "tolerances": {"double", "float"},
 "curves": [{"name", "title": what is drawn, "parameter": what is varied, "rows": [{"value", "hits", "double",
   "float": errors, as in judge.cpp}]}], "left_out"}
"""

import json
import math
import os

from designs import CAMERA, FAMILIES, MOST, design, unseen_scenes, written
from measuring import (LeftOut, WrongAnswer, bench, differing, in_turn, picture_command, read_png,
                       require_same_by_techniques, run, run_right, say, stats_of, summary)

STAGES = ["export", "read", "parse", "import", "prepare", "render", "encode"]
CHECKED = 10_000  # where the cells of larger designs would take minutes, only the picture by tiles is looked at
LONGEST_MS = 20_000  # the next size is left out if it is expected to take longer


def row_of(name, n, make, settings):
    say(f"{name}{n}")
    path = make(settings, name, n)
    require_same_by_techniques(settings, path, ["tiles", "cells"] if n <= CHECKED else ["tiles"])
    runs, stages = [], {stage: [] for stage in STAGES}
    stats = {}

    def whole():
        runs.append(run_right(picture_command(settings, path, settings.work / "growth.png")))
        return runs[-1].wall_ms

    def staged():
        stats.update(stats_of(settings, path))
        for stage in STAGES:
            stages[stage].append(stats["times_ms"][stage])
        return stats["times_ms"]["total"]
    slow = whole() > 2000
    wall_ms, _ = in_turn([whole, staged], settings, *([1, 1] if slow else [5, 20, 2000]))
    peaks = [run.peak_bytes for run in runs if run.peak_bytes]
    return {"n": n, "primitives": stats["primitives"], "file_bytes": path.stat().st_size, "wall_ms": wall_ms,
            "cpu_ms": summary([run.cpu_ms for run in runs[1:]]), "peak_bytes": max(peaks, default=None),
            "stages_ms": {stage: summary(times) for stage, times in stages.items()}}


def exponents(rows):
    """Returns b of time ~ n^b between the last two rows, of all and of each stage; nothing below 0.1 ms."""
    if len(rows) < 2:
        return {}
    before, last = rows[-2:]

    def of(a, b):
        return math.log(b["median"] / a["median"]) / math.log(last["n"] / before["n"]) if a["median"] > 0.1 else None
    return {"wall": of(before["wall_ms"], last["wall_ms"]),
            **{stage: of(before["stages_ms"][stage], last["stages_ms"][stage]) for stage in STAGES}}


def grow(name, settings, left_out):
    title, counts, make = FAMILIES[name]
    rows, n, growth = [], 10, 10
    most = 100 if settings.quick else min(settings.most, MOST.get(name, settings.most))
    while n <= most:
        if rows and growth * rows[-1]["wall_ms"]["median"] > LONGEST_MS:
            left_out.add(f"{title}, from {n:,} on", f"would take longer than {LONGEST_MS // 1000} s")
            break
        rows.append(row_of(name, n, make, settings))
        if len(rows) > 1:
            growth = max(10, rows[-1]["wall_ms"]["median"] / rows[-2]["wall_ms"]["median"])
        n *= 10
    return {"name": name, "title": title, "counts": counts, "rows": rows, "exponents": exponents(rows)}


def unseen(name, alone, grown, settings):
    say(f"unseen: {name}")
    camera = "--camera=" + ",".join(map(str, CAMERA))
    paths = [written(settings, f"unseen_{which}.csg", text) for which, text in (("alone", alone), ("grown", grown))]
    pictures = []
    for path in paths:
        run_right(picture_command(settings, path, settings.work / "unseen.png", camera))
        pictures.append(read_png(settings.work / "unseen.png"))
    # The larger box of the grown design moves the rays' origins, and so their last bits at edges.
    if differing(*pictures) > 10:
        raise WrongAnswer(f"{name}: parts that cannot be seen change {differing(*pictures)} pixels")
    alone_ms, grown_ms = (frames_of(path, settings, camera)["tiles"]["steady"] for path in paths)
    return {"scene": name, "alone_ms": alone_ms, "grown_ms": grown_ms, "ratio": grown_ms["median"] / alone_ms["median"]}


def measure_growth(settings):
    left_out = LeftOut()

    def start():
        return run_right([settings.scadray, "--version"]).wall_ms
    result = {"start_ms": in_turn([start], settings)[0], "families": [], "unseen": [], "left_out": left_out}
    for name in FAMILIES:
        result["families"].append(grow(name, settings, left_out))
        settings.keep(result)
    result["unseen_count"] = 900 if settings.quick else 99_000
    for name, alone, grown in unseen_scenes(result["unseen_count"]):
        result["unseen"].append(unseen(name, alone, grown, settings))
    return result


def frames_of(path, settings, *options, threads=None):
    """Measures by one rule for the cells, since its times are not wanted here."""
    result = bench(settings, path, "--renderer=cpu", "--leaf-primitives=8", *options, threads=threads)
    return {frame["technique"]: {key: frame[key] for key in ("first", "steady")} for frame in result["frames"]}


def measure_frames(settings):
    result = {"pixels": [], "threads": []}
    for name in settings.some(["cs1000", "cs10000", "cc1000"]):
        path = design(name, settings)
        rows = []
        for megapixels in settings.some([0.1, 0.3, 1, 3, 8]):
            unit = round(math.sqrt(megapixels * 1e6 / 12))
            say(f"frames: {name}, {megapixels} megapixels")
            rows.append({"width_px": 4 * unit, "height_px": 3 * unit,
                         **frames_of(path, settings, f"--imgsize={4 * unit},{3 * unit}")})
        result["pixels"].append({"design": name, "rows": rows})
        rows = []
        for threads in settings.some(range(1, os.cpu_count() + 1)):
            say(f"frames: {name}, {threads} threads")
            rows.append({"threads": threads, **frames_of(path, settings, "--imgsize=1920,1080", threads=threads)})
        result["threads"].append({"design": name, "width_px": 1920, "height_px": 1080, "rows": rows})
        settings.keep(result)
    return result


# --- Stability: each curve's parameter, its values, and the .scad, the camera and its zoom for a value ---

STABLE_SIZE = 96, 72
BLOCK = """difference() {
  union() {
    difference() { cylinder(10, r = 8); translate([0, 0, 4]) cylinder(6, r = 5); cylinder(4, r = 2); }
    translate([2, 0, 4]) cylinder(6, r = 2.5);
  }
  for (i = [0 : 11]) translate([8 * cos(30 * i), 8 * sin(30 * i), 0.8 * i]) sphere(1.2);
}"""
PLATE = """union() {
  difference() { translate([0, 0, -2]) cylinder(2, r = 10); holes(); }
  holes();
  translate([-8, 0, 1]) sphere(1);
}
module holes() for (x = [-5, 0, 5]) translate([x, 0, -2]) cylinder(2, r = 1.5);"""


def walls(share):
    wall = f"{12 * share:.17g}"  # 12 is about the model's diagonal
    return f"""difference() {{ sphere(3); sphere(3 - {wall}); translate([-3, 0, -4]) cylinder(8, r = 3); }}
translate([0, 6, 0]) difference() {{ cylinder(4, r = 2); translate([0, 0, {wall}]) cylinder(4, r = 2 - {wall}); }}"""


def mesh_walls(share):
    """A bowl and a cup whose walls are between triangles, which share no plane with others."""
    wall = f"{12 * share:.17g}"
    return f"""{BALL_OF_TRIANGLES}
difference() {{ ball(3); ball(3 - {wall}); translate([-3, 0, -4]) cylinder(8, r = 3); }}
translate([0, 6, 0]) rotate([3, 4, 5]) difference() {{ ball(2.5); translate([0, 0, {wall}]) ball(2.5); }}"""


BALL_OF_TRIANGLES = """function at(r, i, j) = r * [cos(30 * i) * sin(20 * j + 20), sin(30 * i) * sin(20 * j + 20), cos(20 * j + 20)];
module ball(r) polyhedron(
  [for (j = [0 : 7]) for (i = [0 : 11]) at(r, i, j), [0, 0, r], [0, 0, -r]],
  [for (j = [0 : 6]) for (i = [0 : 11]) for (half = [0, 1]) let (k = (i + 1) % 12) half == 0 ?
     [12 * j + i, 12 * j + k, 12 * j + 12 + k] : [12 * j + i, 12 * j + 12 + k, 12 * j + 12 + i],
   for (i = [0 : 11]) [96, (i + 1) % 12, i], for (i = [0 : 11]) [97, 84 + i, 84 + (i + 1) % 12]]);"""


def profile_walls(share):
    wall = f"{12 * share:.17g}"
    return f"""linear_extrude(3) difference() {{ offset(1) square([4, 3]); translate([0, 0.1]) offset(1 - {wall}) square([4, 3]); }}
translate([2, 7, 0]) rotate_extrude() {{ translate([1, 0]) square([{wall}, 3]); translate([2, 0]) circle({wall}); }}"""


def twisted_walls(share):
    wall = f"{12 * share:.17g}"
    return f"""linear_extrude(4, twist = 90, slices = 12) difference() {{ square(4, center = true); square(4 - 2 * {wall}, center = true); }}
translate([0, 6, 0]) linear_extrude(4, scale = [0.5, 0.8], twist = 40, slices = 9)
  for (x = [-1.5 : 1 : 1.5]) translate([x, 0]) square([{wall}, 3], center = true);"""


def powers(first, last, step=1):
    return [10.0**digits for digits in range(first, last + 1, step)]


CURVES = [
    ("distance", "a drilled block from afar", "camera's distance, in sizes of the model", powers(0, 9),
     lambda value: (BLOCK, [0, 0, 5, 55, 0, 25, 60 * value], value)),
    ("thickness", "walls of a bowl and a cup", "thickness, as a share of the model's size", powers(-9, -1),
     lambda value: (walls(value), [0, 3, 1, 55, 0, 25, 36], 1)),
    ("mesh_thickness", "walls between triangles", "thickness, as a share of the model's size", powers(-9, -1),
     lambda value: (mesh_walls(value), [0, 3, 0, 55, 0, 25, 36], 1)),
    ("profile_thickness", "extruded and revolved walls", "thickness, as a share of the model's size", powers(-9, -2),
     lambda value: (profile_walls(value), [1, 4, 1, 55, 0, 25, 40], 1)),
    ("twist_thickness", "twisted walls", "thickness, as a share of the model's size", powers(-9, -2),
     lambda value: (twisted_walls(value), [0, 3, 2, 55, 0, 25, 36], 1)),
    ("scale", "a drilled block, scaled", "scale", powers(-12, 12, 3),
     lambda value: (f"scale({value:g}) {BLOCK}", [0, 0, 5 * value, 55, 0, 25, 60 * value], 1)),
    ("offset", "a drilled block far from the origin", "offset, in sizes of the model", powers(0, 11),
     lambda value: (f"translate({20 * value:g} * [1, -1, 1]) {BLOCK}",
                    [20 * value, -20 * value, 20 * value + 5, 55, 0, 25, 60], 1)),
    # The lower the eye, the less of the plate's breadth is in the picture; its length is always whole.
    ("angle", "a plate with its holes filled flush, grazed", "angle of view, in degrees", powers(-6, 1),
     lambda value: (PLATE, [0, 0, 0, 90 - value, 0, 0, 85], 0.6 / math.sin(math.radians(value)))),
]


def measure_stability(settings):
    left_out = LeftOut()
    result = {"width_px": STABLE_SIZE[0], "height_px": STABLE_SIZE[1], "curves": [], "left_out": left_out}
    for name, title, parameter, values, make in CURVES:
        say(f"stability: {name}")
        rows = []
        for value in settings.some(values):
            text, camera, zoom = make(value)
            path = written(settings, "stability.scad", text + "\n")
            judged = run([settings.judge, path, "-", *STABLE_SIZE, *(f"{x:.17g}" for x in camera + [zoom])], 3600)
            if judged.status != 0:
                raise WrongAnswer(judged.output)
            facts = json.loads(judged.output)
            if "no_gl" in facts and not left_out:
                left_out.add("float", facts["no_gl"])
            result["tolerances"] = facts["tolerances"]
            result.update({"gl": facts["gl"]} if "gl" in facts else {})
            rows.append({"value": value, **{key: facts[key] for key in ("hits", "double", "float") if key in facts}})
        result["curves"].append({"name": name, "title": title, "parameter": parameter, "rows": rows})
    return result
