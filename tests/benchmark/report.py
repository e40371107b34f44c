"""Turns the results of measure.py into the report, its plots, and the benchmarks' part of the repository's README.md;
tests/benchmark/run calls it. Each chapter says nothing where its section is missing."""

import argparse
import collections
import json
import math
import pathlib
import re
import sys
import textwrap

import matplotlib

matplotlib.use("svg")
# The same results give the same bytes, and texts stay texts.
matplotlib.rcParams.update({"svg.hashsalt": "scadray", "svg.fonttype": "none", "font.size": 9, "axes.grid": True,
                            "grid.alpha": 0.3, "legend.fontsize": 8})
# Okabe and Ito's, which all eyes can tell apart.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8c564b"]
MARKS = "os^vD<>pPXh*"
from matplotlib import pyplot  # noqa: E402

BEGIN, END = "<!-- benchmarks: written by tests/benchmark/run -->", "<!-- end of benchmarks -->"
LINK = "tests/benchmark/results"  # the report's folder, as README.md links to it


# --- Words and numbers ---


def number(value):
    """Three significant digits, with commas between thousands, and all digits of an integer; below 0.0001 an exponent;
    a dash for nothing."""
    if value is None or not math.isfinite(value):
        return "–"
    if value == round(value):
        return f"{value:,.0f}"
    if abs(value) < 1e-4:
        return re.sub(r"(\.0)?e-0?", "e-", f"{value:.1e}")
    value = float(f"{value:.2e}")  # the rounded number decides: 9.996 becomes 10.0
    return f"{value:,.{max(0, 2 - math.floor(math.log10(abs(value))))}f}"


def size(value):
    if value is None:
        return "–"
    for unit in ("bytes", "kB", "MB", "GB"):
        if value < 999.5 or unit == "GB":
            return f"{number(value)} {unit}"
        value /= 1000


def spread(summary):
    """Median and quartiles: "8.13 (8.01–8.4)"."""
    low, high = summary["quartiles"]
    return f"{number(summary['median'])} ({number(low)}–{number(high)})"


def median(summary):
    return number(summary["median"])


def title(design):
    return design.upper() if re.search(r"\d", design) else design


def reached(value, at_least):
    return f"{number(at_least)}: {'reached' if value >= at_least else 'missed'}"


def paragraph(text):
    return "\n" + textwrap.fill(" ".join(text.split()), 118, break_long_words=False, break_on_hyphens=False) + "\n"


def table(head, rows):
    rows = [["" if cell is None else str(cell) for cell in row] for row in rows]
    if not rows:
        return ""
    return "\n" + "".join("| " + " | ".join(row) + " |\n" for row in [head, ["---"] * len(head), *rows])


def folded(summary, text):
    return f"\n<details><summary>{summary}</summary>\n{text}\n</details>\n"


# --- Plots ---


class Panel:
    """Curves over an axis, both logarithmic unless told."""

    def __init__(self, title, x, y, log_x=True, log_y=True, zero=None):
        self.title, self.x, self.y, self.log_x, self.log_y = title, x, y, log_x, log_y
        self.zero = zero  # where a logarithmic y shows 0
        self.curves = collections.defaultdict(list)  # by name: (x, y or a summary of it)
        self.guides = set()

    def add(self, name, x, y):
        """Adds a point; nothing for None, or where a logarithmic axis has no place for it."""
        value = y["median"] if isinstance(y, dict) else y
        if value == 0 and self.zero is not None:
            y = value = self.zero
        if x is None or value is None or (self.log_x and x <= 0) or (self.log_y and value <= 0):
            return
        self.curves[name].append((x, y))

    def guide(self, name, x, y):
        self.add(name, x, y)
        self.guides.add(name)


def figure(folder, name, alternative, panels):
    """Draws panels side by side, in which curves of one name look the same, with a common legend."""
    panels = [panel for panel in panels if set(panel.curves) - panel.guides]
    if not panels:
        return ""
    names = list(dict.fromkeys(curve for panel in panels for curve in panel.curves if curve not in panel.guides))
    drawn, axes = pyplot.subplots(1, len(panels), figsize=(0.8 + 4.6 * len(panels), 4), squeeze=False)
    handles = {}
    for panel, axis in zip(panels, axes[0]):
        axis.set(title=panel.title, xlabel=panel.x, ylabel=panel.y)
        if panel.log_x:
            axis.set_xscale("log")
        if panel.log_y:
            axis.set_yscale("log")
        for curve, points in panel.curves.items():
            xs = [x for x, _ in points]
            ys = [y["median"] if isinstance(y, dict) else y for _, y in points]
            if curve in panel.guides:
                handles[curve] = axis.plot(xs, ys, "--", color="0.6", zorder=1)[0]
                continue
            ends = [y["quartiles"] if isinstance(y, dict) else (y, y) for _, y in points]
            errors = [[y - low for y, (low, _) in zip(ys, ends)], [high - y for y, (_, high) in zip(ys, ends)]]
            look = names.index(curve)
            handles[curve] = axis.errorbar(xs, ys, errors, marker=MARKS[look % len(MARKS)], ms=4, lw=1.2,
                                           color=COLOURS[look % len(COLOURS)])
        if panel.zero is not None:
            axis.axhline(panel.zero, color="0.6", lw=0.8)
            axis.annotate("0", (0, panel.zero), xycoords=("axes fraction", "data"), xytext=(3, 2),
                          textcoords="offset points", color="0.4")
    columns = min(len(handles), 4 if len(panels) > 1 else 2)
    rows = math.ceil(len(handles) / columns)
    drawn.legend(handles.values(), handles.keys(), loc="lower center", ncol=columns, frameon=False)
    drawn.tight_layout(rect=(0, 0.02 + 0.05 * rows, 1, 1))
    drawn.savefig(folder / f"{name}.svg", metadata={"Date": None})
    pyplot.close(drawn)
    return f"\n![{alternative}]({name}.svg)\n"


# --- Chapters: each takes a section and the folder of the plots ---


def ratio_rows(section, *more):
    return [[title(ratio["design"]), ratio["what"], number(ratio["time_ms"]), number(ratio["scadray_ms"]),
             number(ratio["ratio"]), *(cell(ratio) for cell in more)] for ratio in section["ratios"]]


def zero_place(scenes, key, unit):
    """Where errors of 0 are drawn: half a decade or more below the least error."""
    errors = [point["error"][key] / unit for scene in scenes for point in scene["points"] if point["error"][key]]
    return 10 ** math.floor(math.log10(min(errors) / 3)) if errors else 1e-6


def least_ahead(scenes):
    """For each peer the level at which scadray is least ahead."""
    levels = collections.defaultdict(list)
    for scene in scenes:
        for level in scene["levels"]:
            levels[level["series"]].append((level.get("ratio", 0), title(scene["design"]), level))
    for peer, all_of_it in levels.items():
        ratio, design, level = min(all_of_it, key=lambda one: one[0])
        ours = ", ".join(filter(None, [level.get("scadray", "none"), level.get("scadray_setting")]))
        yield [peer, len(all_of_it), design, level["setting"], level["measure"], number(level["error"]),
               number(level["time_ms"]), ours, number(level.get("scadray_error")), number(level.get("scadray_ms")),
               number(ratio)]


TIMES = {"picture_ms": "picture", "save_ms": "save", "model_ms": "model", "preview_ms": "2021.01: preview",
         "render_ms": "model", "manifold_ms": "2025.07: model"}


def real_ratio_rows(section):
    return [[ratio["what"], ratio["count"], number(ratio["median"]),
             reached(ratio["median"], ratio["at_least"]) if ratio["at_least"] else "",
             f"{number(ratio['least'])} ({ratio['of']})", reached(ratio["least"], 1)] for ratio in section["ratios"]]


REAL_RATIOS = ["scadray against", "designs", "times as fast, median", "wanted", "least", "wanted"]


def share(check):
    return f"{number(100 - 100 * check['undecided'] / check['pixels'])}%" if check else "–"


def write_real(section, folder):
    text = "\n## Designs that people draw\n" + paragraph("""Medians in ms: whole processes from the text to the picture at
        640×480 and to the model (an STL, or an SVG of a drawing), by scadray and by OpenSCAD 2021.01; of scadray's
        window, from a save that changes a small part to the screen; and of OpenSCAD 2025.07.18's model by Manifold,
        which is one thread of WebAssembly without the start of its process. *Exact* is the share of the smooth picture's
        pixels that rays in exact arithmetic confirm (the others they leave undecided); *facets* counts those that
        OpenSCAD's comparison leaves between its preview and scadray's picture of the same facets (32 pass; there are thousands where its preview has holes, since the design names no convexity); *preview off* those of its preview that are visibly
        different from the exact picture.""")
    text += table(REAL_RATIOS, real_ratio_rows(section))
    panel = Panel("From the text to the picture", "OpenSCAD 2021.01's preview, ms", "scadray, ms")
    rows = []
    for design in section["designs"]:
        if design["preview_ms"]:
            panel.add(design["kind"], design["preview_ms"]["median"], design["picture_ms"])
        rows.append([design["design"], design["kind"], number(design["primitives"]),
                     *(median(design[key]) if design.get(key) else "–" for key in TIMES),
                     share(design["check"]), number(design.get("facets_off")),
                     number(design.get("peer_off"))])
    text += figure(folder, "real", "scadray's time over that of OpenSCAD's preview", [panel])
    return text + table(["design", "kind", "primitives", *TIMES.values(), "exact", "facets", "preview off"], rows)


def real_summary(section):
    """The section's table for README.md."""
    return paragraph(f"""{len(section['designs'])} designs of the kinds that people publish, from the text to the
        picture or the model.""") + table(REAL_RATIOS, real_ratio_rows(section))


def write_error(section, folder):
    scenes, picture = section["scenes"], section["picture"]
    text = "\n## Time against error\n" + paragraph(f"""From file to picture, whole processes,
        {picture['width_px']}×{picture['height_px']}, against the exact picture: scadray, and what else draws the same
        designs. To the left and further down is better; the lowest line is no error at all.""") + "\n"
    for key, sentence in section["measures"].items():
        text += f"- *{key.replace('_', ' ')}*: {sentence}\n"
    text += table(["design", "against", "its ms", "scadray's ms", "times as fast", "wanted"],
                  ratio_rows(section, lambda ratio: reached(ratio["ratio"], ratio["at_least"])))
    text += paragraph("""Each error that a peer reaches, against scadray's quickest picture with at most that error:
        where scadray is least ahead of each peer.""")
    text += table(["peer", "errors reached", "scene", "setting", "measure", "its error", "its ms", "scadray",
                   "its error", "its ms", "times as fast"], least_ahead(scenes))
    plotted = [("wrong", "wrong pixels", "share of the picture", picture["pixels"]),
               ("depth_mean", "mean error of depth", "share of the model's size", 1)]
    for scene in scenes:
        name = title(scene["design"])
        panels = []
        for key, what, axis, unit in plotted:
            panels.append(Panel(f"{name}: {what}", "time from file to picture, in ms", axis,
                                zero=zero_place(scenes, key, unit)))
            for point in scene["points"]:
                error = point["error"][key]
                panels[-1].add(point["series"], point["time_ms"]["median"], None if error is None else error / unit)
        text += f"\n### {name}\n" + figure(folder, f"error_{scene['design']}",
                                           f"{name}: error over the time from file to picture", panels)
        keys = ["wrong", "silhouette", "depth_worst", "depth_mean", "colour_wrong", "colour_rms"]
        text += folded(f"{name}, all figures", table(
            ["program", "setting", "ms", *(key.replace("_", " ") for key in keys)],
            [[point["series"], point["setting"], spread(point["time_ms"]),
              *(number(point["error"][key]) for key in keys)] for point in scene["points"]]))
    return text


def error_summary(section):
    """The section's table, and the plot of one design, for README.md."""
    text, picture = "", section["picture"]
    if section["ratios"]:
        text += paragraph(f"""From file to picture at {picture['width_px']}×{picture['height_px']} pixels: medians of
            whole processes, but where the table says otherwise. scadray draws on the CPU here.""")
        text += table(["design", "against", "its ms", "scadray's ms", "times as fast"], ratio_rows(section))
    if any(scene["design"] == "cs1000" for scene in section["scenes"]):
        text += paragraph("""How far each program's picture is off, over the time that it takes: to the left and
            further down is better, and the lowest line is no error at all.""")
        text += f"\n![CS1000: error over the time from file to picture]({LINK}/error_cs1000.svg)\n"
    return text


def write_growth(section, folder):
    stages = ["export", "read", "parse", "import", "prepare", "render", "encode"]
    text = "\n## How it grows\n" + paragraph(f"""Whole processes from a file to its PNG at 640×480, by the CPU. A
        process that draws nothing (`scadray --version`) takes {spread(section['start_ms'])} ms. The table has the
        largest design of each kind, in ms. Brackets say how the time grew from the size before, as an exponent of n (n
        log n has 1.06 to 1.2). Stages are by `--stats`, which counts while it renders.""")
    rows = []
    walls = Panel("From file to PNG", "n", "time in ms")
    renders = Panel("of it rendering", "n", "time in ms")
    parts = Panel("CSn: what takes the time", "spheres", "time in ms")
    memory = Panel("Peak memory", "n", "memory in MB")
    for family in section["families"]:
        for row in family["rows"]:
            walls.add(family["title"], row["n"], row["wall_ms"])
            renders.add(family["title"], row["n"], row["stages_ms"]["render"])
            memory.add(family["title"], row["n"], row["peak_bytes"] and row["peak_bytes"] / 1e6)
            if family["name"] == "cs":
                for stage in stages:
                    parts.add(stage, row["n"], row["stages_ms"][stage])
        last, grown = family["rows"][-1], family["exponents"]

        def cell(time_ms, key):
            return median(time_ms) + (f" ({number(grown[key])})" if grown.get(key) is not None else "")
        rows.append([family["title"], f"{last['n']:,} {family['counts']}", size(last["file_bytes"]),
                     cell(last["wall_ms"], "wall"), median(last["cpu_ms"]), size(last["peak_bytes"]),
                     *(cell(last["stages_ms"][stage], stage) for stage in stages)])
    text += table(["design", "n", "file", "all", "processor", "peak memory", *stages], rows)
    text += figure(folder, "growth", "Time from file to PNG over n", [walls, renders])
    text += figure(folder, "growth_parts", "Stages and memory over n", [parts, memory])
    if section["unseen"]:
        ratios = [scene["ratio"] for scene in section["unseen"]]
        text += "\n## What cannot be seen\n" + paragraph(f"""{number(section['unseen_count'])} primitives that do not
            change the picture join 1,000 that are seen: a frame by tiles takes {number(min(ratios))} to
            {number(max(ratios))} times as long.""")
        text += table(["what joins", "ms alone", "ms with it", "ratio"],
                      [[scene["scene"], spread(scene["alone_ms"]), spread(scene["grown_ms"]), number(scene["ratio"])]
                       for scene in section["unseen"]])
    return text


def write_frames(section, folder):
    text = "\n## Pixels and threads\n" + paragraph("""Frames from memory, on the CPU (`scadray bench`): *first* with
        nothing prepared, *steady* while a camera turns.""")
    techniques = ("tiles", "cells")
    kinds = [(technique, kind) for technique in techniques for kind in ("first", "steady")]
    panels = [Panel(f"By {technique}, steady", "megapixels", "time of a frame in ms") for technique in techniques]
    rows = []
    for design in section["pixels"]:
        for row in design["rows"]:
            megapixels = row["width_px"] * row["height_px"] / 1e6
            for panel, technique in zip(panels, techniques):
                panel.add(title(design["design"]), megapixels, row[technique]["steady"])
            rows.append([title(design["design"]), f"{row['width_px']}×{row['height_px']}", 2,
                         *(spread(row[technique][kind]) for technique, kind in kinds)])
    for design in section["threads"]:
        for row in design["rows"]:
            rows.append([title(design["design"]), f"{design['width_px']}×{design['height_px']}", row["threads"],
                         *(spread(row[technique][kind]) for technique, kind in kinds)])
    text += figure(folder, "frames", "Time of a frame over its pixels", panels)
    head = ["design", "picture", "threads", *(f"{technique}, {kind}, ms" for technique, kind in kinds)]
    return text + table(head, rows)


def write_stability(section, folder):
    precisions = {"double": "CPU, double", "float": "OpenGL, float"}
    pixels = section["width_px"] * section["height_px"]
    gl = f" and by OpenGL in float ({section['gl']})" if "gl" in section else ""
    text = "\n## Numerical stability\n" + paragraph(f"""Scenes that become harder are drawn by the CPU in double{gl} and
        compared with rays in exact arithmetic, {section['width_px']}×{section['height_px']} pixels each. A pixel is
        wrong if it shows a hit for a miss, another primitive, or a place more than
        {number(section['tolerances']['double'])} of the model's size away (in float
        {number(section['tolerances']['float'])}). It is undecided, and not counted as wrong, if an exact ray 1e-12 of
        the size beside it sees something else.""")
    rows, figures = [], ""
    for curve in section["curves"]:
        wrong = Panel(f"{curve['title'][0].upper()}{curve['title'][1:]}: wrong", curve["parameter"],
                      "share of the picture", zero=1e-5)
        place = Panel("Error of position", curve["parameter"], "share of the model's size", zero=1e-20)
        for precision, name in precisions.items():
            with_it = [row for row in curve["rows"] if precision in row]
            for row in with_it:
                errors = row[precision]
                wrong.add(name, row["value"], errors["wrong"] / pixels)
                place.add(f"{name}, median", row["value"], errors["median_error"])
                place.add(f"{name}, worst", row["value"], errors["worst_error"])
                place.guide(f"what rounding does in {precision}", row["value"], errors["rounding"] or None)
            if with_it:
                rows.append([curve["title"], curve["parameter"], precision, number(sum(row["hits"] for row in with_it)),
                             *(number(sum(row[precision][key] for row in with_it)) for key in ("wrong", "undecided")),
                             number(max(row[precision]["worst_error"] or 0 for row in with_it))])
        figures += figure(folder, f"stability_{curve['name']}",
                          f"Errors of {curve['title']} over the {curve['parameter']}", [wrong, place])
    return text + table(["scene", "over", "precision", "hits", "wrong", "undecided", "worst position"], rows) + figures


def write_models(section, folder):
    text = "\n## Meshes and their files\n"
    if section["kernel"]:
        text += paragraph("""From operands in memory to a closed mesh, by two threads. *Volume* is the error of the mesh's
            volume as a share, which is checked before the time is taken.""")
        text += table(["scene", "triangles before", "after", "ms", "processor", "volume"],
                      [[row["title"], number(row["triangles_in"]), number(row["triangles"]), number(row["median_ms"]),
                        number(row["cpu_ms"]), number(row["volume_error"])] for row in section["kernel"]])
    text += paragraph(f"{title(section['formats_of'])} from its text to a file, whole processes:")
    text += table(["file", "size", "ms"],
                  [[row["suffix"], size(row["bytes"]), spread(row["time_ms"])] for row in section["formats"]])
    text += paragraph("""A pierced ball of 20 mm with `--tolerance`, which says how far faces may be from the exact
        surface; corners lie on it, and an STL rounds them to floats.""")
    return text + table(["tolerance, mm", "triangles", "faces off, mm", "corners off, mm", "ms"],
                        [[number(row["tolerance_mm"]), number(row["triangles"]), number(row["faces_off_mm"]),
                          number(row["corners_off_mm"]), spread(row["time_ms"])] for row in section["tolerances"]])


def write_studio(section, folder):
    text = "\n## The studio's light\n" + paragraph(f"""The window's pictures, {section['width_px']}×{section['height_px']}
        pixels of four rays each, from the prepared solid: *flat* has no shadows, the *first rest* has light by few
        directions, the *last* by more. Errors are means over pixels in levels of 255, against
        {number(section['directions'])} directions of the sky and as many of the key light.""")
    head = ["design", "flat, ms"]
    for rest, at_most in zip(("first rest", "last"), section["at_most"]):
        head += [f"{rest}, ms", f"error ({at_most} wanted)", "worst"]
    return text + table(head, [
        [title(design["design"]), spread(design["shaded_ms"])] +
        [cell for rest in design["rests"]
         for cell in (spread(rest["ms"]), number(rest["mean_error"]), number(rest["worst_error"]))]
        for design in section["designs"]])


def write_panel(section, folder):
    if not section["edits"]:
        return ""
    text = "\n## The preview in a browser\n" + paragraph("""Chromium's panel of 800×600 pixels on the same two cores: from
        a save on the disk to the full frame on the canvas, and while the mouse turns the design.""")
    text += table(["design", "light", "ms", "wanted"],
                  [[row["design"], row["light"], spread(row["edit_ms"]), f"at most {row['at_most']}"]
                   for row in section["edits"]])
    return text + table(["design", "frames a second", "wanted", "pixels wide", "between frames, ms"],
                        [[row["design"], number(row["frames_per_second"]), f"at least {row['at_least']}",
                          row["width_px"], spread(row["gap_ms"])] for row in section["turns"]])


def write_opengl(section, folder):
    frames = section["frames"]
    if not frames:
        return "\n## OpenGL\n"
    text = "\n## OpenGL\n" + paragraph(f"""Frames from memory to memory by `{section['renderer']}` (`scadray bench`).
        *First* is a picture with nothing prepared, and *shaders* how much of it compiling them takes; *steady* is a
        frame of a turning camera. Wrong pixels are those that differ from the CPU's, of those that show the
        design.""")
    panels = {}
    for frame in frames:
        panel = panels.setdefault(frame["technique"], Panel(f"By {frame['technique']}, steady", "megapixels",
                                                            "time of a frame in ms"))
        panel.add(title(frame["design"]), frame["width_px"] * frame["height_px"] / 1e6, frame["steady"])
    text += figure(folder, "opengl", "Time of a frame by OpenGL over its pixels", panels.values())
    return text + table(
        ["design", "picture", "by", "first, ms", "shaders", "steady, ms", "frames/s", "wrong pixels"],
        [[title(frame["design"]), f"{frame['width_px']}×{frame['height_px']}", frame["technique"],
          spread(frame["first"]), median(frame["first_shaders"]), spread(frame["steady"]),
          number(1000 / frame["steady"]["median"]), f"{number(frame['wrong_pixels'])} of {number(frame['hits'])}"]
         for frame in frames])


RENDERERS = {"gl": "OpenGL", "cpu": "CPU"}


def rule_title(rule):
    threshold = f", {number(rule['threshold_px'])} px" if rule["threshold_px"] else ""
    return f"K = {rule['leaf_primitives']}{threshold}"


def write_paper(section, folder):
    text = "\n## The paper's measurements\n" + paragraph("""The paper is Romeiro, Velho, de Figueiredo,
        "Hardware-assisted Rendering of CSG Models". Its table 1, 640×480, in ms: S subdivides, T_S traverses and passes
        the parameters, T_R traverses and renders, S_R renders while subdividing. The paper's rule is at most 2
        primitives in a cell and a threshold of 1 pixel. C1 is the paper's Pentium-M of 1.4 GHz with a GeForce FX
        Go5200, C2 its Athlon 64 3800+ with a GeForce 6800 GT.""")
    text += paragraph(f"OpenGL here is `{section['opengl']}`.") if section["opengl"] else ""
    rows = []
    for design in section["table"]:
        paper = design["paper"]
        for machine in ("C1", "C2"):
            rows.append([title(design["design"]), f"paper, {machine}", *map(number, paper[machine].values()), "", "",
                         number(paper["draw_calls"]) if "draw_calls" in paper else "", ""])
        for rule in design["rules"]:
            gl = rule.get("gl")
            rows.append([title(design["design"]), f"here, {rule_title(rule)}", median(rule["S"]),
                         *(median(gl[key]) if gl else "–" for key in ("T_S", "T_R", "S_R")),
                         median(rule["cpu"]["T_R"]), number(rule["leaves"]),
                         *(number(gl[key]) if gl else "–" for key in ("draw_calls", "wrong_pixels"))])
    text += table(["design", "measured", "S", "T_S", "T_R", "S_R", "T_R by the CPU", "leaf cells", "draw calls",
                   "wrong pixels, OpenGL"], rows)

    growth = section["growth"]
    panel = Panel("Figure 14: CC100 to CC1000", "cones", "T_R in ms")
    sentences = []
    for i, rule in enumerate(growth["points"][0]["rules"]):
        for key, name in RENDERERS.items():
            for point in growth["points"]:
                panel.add(f"{name}, {rule_title(rule)}", point["cones"], point["rules"][i].get(key, {}).get("T_R"))
            exponent = growth["exponents"][i][f"{key}_T_R"]
            if exponent is not None:
                sentences.append(f"n^{number(exponent)} by {name} with {rule_title(rule)}")
    for cones, ms in growth["paper_c1_t_r"]:
        panel.add("paper, C1", cones, ms)
    if sentences:
        text += paragraph(f"From {number(growth['points'][0]['cones'])} to {number(growth['points'][-1]['cones'])} "
                          f"cones (figure 14) T_R grows as {'; '.join(sentences)}.")
    text += figure(folder, "paper_growth", "Figure 14: T_R over the number of cones", [panel])

    text += paragraph("""What T_R depends on. Over the threshold (figure 3; K = 2) and K (no threshold): times, and the
        wrong pixels that dropped cells cost, as a share of those that show the design. Over the area (section 4.1): the
        same cells cover fewer pixels as the camera goes back. Over depth: copies of the design stand behind it on the
        same pixels.""")
    for key, parameter, axis in (("threshold", "threshold_px", "threshold in pixels"),
                                 ("leaf_primitives", "leaf_primitives", "K, primitives in a cell")):
        sweep = section[key]
        times = Panel(title(sweep["design"]) + ": times", axis, "ms")
        wrong = Panel("Wrong pixels", axis, "share", zero=1e-6)
        for rule in sweep["rules"]:
            times.add("S", rule[parameter], rule["S"])
            for renderer, name in RENDERERS.items():
                if renderer in rule:
                    times.add(f"T_R, {name}", rule[parameter], rule[renderer]["T_R"])
                    wrong.add(f"T_R, {name}", rule[parameter], rule[renderer]["wrong_pixels"] / sweep["hits"])
        text += figure(folder, f"paper_{key}", f"Times and wrong pixels over the {axis}", [times, wrong])
    panels = []
    for key, parameter, axis in (("area", "hits", "pixels that show it"),
                                 ("depth", "copies", "copies behind each other")):
        if key not in section:  # it was ended before
            continue
        panels.append(Panel(f"{title(section[key]['design'])}: {key}", axis, "T_R in ms", log_x=False, log_y=False))
        for point in section[key]["points"]:
            for renderer, name in RENDERERS.items():
                panels[-1].add(f"T_R, {name}", point[parameter], point["rule"].get(renderer, {}).get("T_R"))
    return text + figure(folder, "paper_dependence", "T_R over area and depth complexity", panels)


CHAPTERS = {"real": write_real, "error": write_error, "growth": write_growth, "frames": write_frames,
            "stability": write_stability, "models": write_models, "studio": write_studio, "panel": write_panel,
            "opengl": write_opengl, "paper": write_paper}


# --- The report, and README.md's part ---


def machine_text(machine):
    versions = ", ".join(f"{name} {version}" for name, version in machine["versions"].items())
    return paragraph(f"""Measured {machine['date'][:10]} at commit {machine['commit']} on {machine['cores']} cores of:
        {machine['processor']} ({machine['instruction_set']}), {size(machine['memory_bytes'])} of memory,
        {machine['system']}, {machine['compiler']}; {versions}.""")


def section_text(section, results):
    """Says of which commit a section is, if it was not measured with the last."""
    if section["commit"] == results["machine"]["commit"]:
        return ""
    return paragraph(f"This section was measured {section['date'][:10]} at commit {section['commit']}.")


def report_text(results, folder):
    text = "# Benchmarks\n" + paragraph("""[`tests/benchmark/run`](../run) wrote this file, its plots and
        [results.json](results.json); nothing in them is written by hand. It installs what it needs on a Debian 12,
        builds, holds every picture against its truth before it takes a time, and measures. Times are medians; the
        quartiles stand in brackets, and as bars in the plots. What bounds each stage, and what was tried, is in
        [NOTES.md](../NOTES.md).""") + machine_text(results["machine"])
    for name, write in CHAPTERS.items():
        section = results["sections"].get(name)
        if section:
            text += write(section, folder) + section_text(section, results)
            if section.get("left_out"):
                text += "\nLeft out:\n\n" + "".join(f"- {reason}\n" for reason in section["left_out"])
    return text


def with_part(text, part):
    """Replaces what stands between the two marks, each of which must be there once."""
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f"report: error: README.md must have the lines {BEGIN} and {END} once each")
    before, _, rest = text.partition(BEGIN)
    return before + BEGIN + "\n" + part + END + rest.partition(END)[2]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=pathlib.Path, required=True, help="what measure.py has written")
    parser.add_argument("--report", type=pathlib.Path, required=True,
                        help="the folder of the report and its plots; other plots are removed from it")
    parser.add_argument("--summary", type=pathlib.Path, required=True, help="README.md, or a copy of it")
    options = parser.parse_args()
    results, readme = json.loads(options.results.read_text()), options.summary.read_text()
    for plot in options.report.glob("*.svg"):
        plot.unlink()
    text = report_text(results, options.report)
    sections = results["sections"]
    parts = [write(sections[name]) + section_text(sections[name], results)
             for name, write in {"real": real_summary, "error": error_summary}.items() if name in sections]
    readme = with_part(readme, machine_text(results["machine"]) + "".join(parts))
    (options.report / "README.md").write_text(text)
    options.summary.write_text(readme)


if __name__ == "__main__":
    main()
