"""The sections "paper" and "opengl", which `scadray bench` measures: it compares its pictures before it takes times.

"paper", Romeiro, Velho, de Figueiredo, "Hardware-assisted Rendering of CSG Models":
{"opengl": "gl: " and GL_RENDERER, "" without, "left_out",
 "table": [{"design", "primitives", "pixels", "hits", "paper": {"C1": {"S", "T_S", "T_R", "S_R"}, "C2": …,
   "draw_calls"}, "rules": [RULE by scadray's rule, RULE by the paper's]}],     table 1
 "growth": {"paper_c1_t_r": [[cones, ms]], "points": [{"design", "cones", "rules"}],
   "exponents": [{"S", "gl_T_R", "cpu_T_R"} of the rules in their order]},      figure 14
 "threshold": {"design", "hits", "rules": with K = 2 by the threshold},         figure 3
 "leaf_primitives": {"design", "hits", "rules": without a threshold by K},
 "area", "depth": {"design", "points": [{"hits", "distance" or "copies", "rule": RULE}]}}   section 4.1
RULE is what `scadray bench --json` says of a rule (frontend/bench/README.md).
"opengl": {"renderer", "left_out", "frames": [{"design", "primitives", "width_px", "height_px", "hits", and of a
  frame of `scadray bench --json`: "technique", "first", "first_shaders", "steady", "wrong_pixels"}]}
"""

import math

import numpy

from designs import cut_cylinder, design, written
from measuring import LeftOut, WrongAnswer, bench, say

# The paper's times in ms at 640x480 with a threshold of 1 pixel, on its two machines: C1, a Pentium-M of 1.4 GHz with
# a GeForce FX Go5200; C2, an Athlon 64 3800+ with a GeForce 6800 GT. By design: C1, C2, draw calls.
TABLE = {
    "cs1000": ((1739, 964, 10776, 11243), (856, 505, 2086, 2314), 85306),
    "cc1000": ((3705, 1265, 34975, 35233), (2658, 626, 4324, 4820), 103250),
    "r9": ((29, 19, 1626, 1677), (20, 11, 78, 80), 2068),
    "t1022": ((220, 86, 2464, 2466), (162, 44, 319, 324), None),
}
GROWTH = [[500, 16046], [1000, 34975]]  # cones, T_R on C1: what figure 14 names


def exponent(points, rule, *keys):
    """Returns b of time ~ cones^b, by least squares of the logarithms; None without times."""
    times = []
    for point in points:
        value = point["rules"][rule]
        for key in keys:
            value = value.get(key)
            if value is None:
                return None
        times.append(math.log(value["median"]))
    return float(numpy.polyfit([math.log(point["cones"]) for point in points], times, 1)[0]) if len(times) > 1 else None


def measure_paper(settings):
    result = {"opengl": "", "left_out": LeftOut()}

    def measured(name, *options, path=None):
        say(f"paper: {name} {' '.join(options)}")
        facts = bench(settings, path or design(name, settings), *options)
        if facts["left_out"] and not result["left_out"]:
            result["left_out"].add("times by OpenGL", facts["left_out"][0])
        for frame in facts["frames"]:
            if frame["renderer"].startswith("gl"):
                result["opengl"] = frame["renderer"]
        return {"design": name, **{key: facts[key] for key in ("primitives", "pixels", "hits", "rules")}}

    result["table"] = []
    for name, (c1, c2, draw_calls) in TABLE.items():
        if settings.quick and name != "r9":
            continue
        row = measured(name)
        row["paper"] = {machine: dict(zip(("S", "T_S", "T_R", "S_R"), times))
                        for machine, times in (("C1", c1), ("C2", c2))}
        row["paper"].update({"draw_calls": draw_calls} if draw_calls else {})
        result["table"].append(row)
    points = [{**measured(f"cc{cones}"), "cones": cones} for cones in settings.some([100, 200, 500, 1000], 2)]
    result["growth"] = {"paper_c1_t_r": GROWTH, "points": points, "exponents": [
        {"S": exponent(points, rule, "S"), "gl_T_R": exponent(points, rule, "gl", "T_R"),
         "cpu_T_R": exponent(points, rule, "cpu", "T_R")} for rule in range(2)]}
    settings.keep(result)

    name = "cs100" if settings.quick else "cs1000"
    for key, rules in (("threshold", [["--leaf-primitives=2", f"--threshold={px}"] for px in (4, 2, 1, 0.5, 0.25)]),
                       ("leaf_primitives", [[f"--leaf-primitives={k}"] for k in (16, 8, 4, 3, 2)])):
        rows = [measured(name, *rule) for rule in settings.some(rules, 2)]
        result[key] = {"design": name, "hits": rows[0]["hits"], "rules": [row["rules"][0] for row in rows]}
        settings.keep(result)

    # The camera goes back, so that the same cells cover fewer pixels.
    points = []
    for distance in settings.some([1, 1.6, 2.8, 5.6], 2):
        row = measured(name, f"--camera=0,0,0,55,0,25,{77 * distance}", "--leaf-primitives=8")
        points.append({"hits": row["hits"], "distance": distance, "rule": row["rules"][0]})
    result["area"] = {"design": name, "points": points}
    # The design is repeated behind itself, without perspective, so that the same pixels are covered.
    points, one = [], cut_cylinder(settings, "cs", 100).read_text()
    down, turn = math.radians(55), math.radians(25)
    x, y, z = 40 * math.sin(down) * math.sin(turn), -40 * math.sin(down) * math.cos(turn), 40 * math.cos(down)
    for copies in settings.some([1, 2, 4, 8, 16], 2):
        # By 40 along the view axis of the camera below.
        text = "".join(f"multmatrix([[1,0,0,{-x * i}],[0,1,0,{-y * i}],[0,0,1,{-z * i}],[0,0,0,1]]) {{\n{one}}}\n"
                       for i in range(copies))
        path = written(settings, "copies.csg", text)
        row = measured("cs100", "--projection=o", "--camera=0,0,0,55,0,25,77", "--leaf-primitives=8", path=path)
        points.append({"hits": row["hits"], "copies": copies, "rule": row["rules"][0]})
    result["depth"] = {"design": "cs100", "points": points}
    return result


def is_software(renderer):
    """Whether OpenGL's renderer, as it names itself, is one of Mesa's that draw by the processor."""
    return any(name in renderer for name in ("llvmpipe", "softpipe"))


def measure_opengl(settings):
    result = {"renderer": "", "frames": [], "left_out": LeftOut()}
    for name in settings.some(["r9", "cs1000", "cc1000", "t1022", "cs10000"]):
        for width, height in settings.some([(640, 480), (1920, 1080), (3840, 2160)]):
            # A processor in a GPU's place takes minutes for what is large, which nobody would draw by it.
            if is_software(result["renderer"]) and (width > 640 or name == "cs10000"):
                continue
            say(f"opengl: {name}, {width}x{height}")
            try:
                facts = bench(settings, design(name, settings), "--renderer=gl", "--leaf-primitives=8",
                              f"--imgsize={width},{height}")
            except WrongAnswer as failure:
                if result["frames"] or "pixels show" in str(failure):
                    raise
                result["left_out"].add("OpenGL", str(failure))
                return result
            for frame in facts["frames"]:
                result["renderer"] = frame["renderer"]
                result["frames"].append({"design": name, "width_px": width, "height_px": height,
                                         "primitives": facts["primitives"], "hits": facts["hits"], **{key: frame[key]
                                         for key in ("technique", "first", "first_shaders", "steady", "wrong_pixels")}})
        settings.keep(result)
    return result
