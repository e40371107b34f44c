"""The section "error": how long a user waits for a picture of a .scad, and how wrong it is, by scadray and by what
else draws the same design.

{"picture": {"width_px", "height_px", "pixels"},
 "measures": {KEY: what it counts}, for the keys of "error",
 "scenes": [{"design", "primitives", "hits", "check": {"pixels", "undecided", "position_worst"}: scadray's picture
     against rays in exact arithmetic; undecided are pixels at which no double can be held to them,
   "points": [{"series", "setting": a series' points rise in quality, "is_scadray", "time_ms": summary of whole
       processes, from the file to the picture, "trace_ms": only where the program says it,
     "error_by": "pixels": its own; "facets": exact pixels of its facets (colours its own),
     "error": {KEY: a number, or null where it cannot be had}}],
   "levels": [{"series", "setting", "measure", "error", "time_ms": what a peer reaches, "scadray",
     "scadray_setting", "scadray_error", "scadray_ms": scadray's quickest point of at most that error, "ratio"}]}],
 "ratios": [{"what", "design", "time_ms", "scadray_ms", "ratio", "at_least"}],
 "left_out": ["what: why"]}
"""

import dataclasses
import json
import re
import shutil
import types

import numpy

from designs import design
from display import Display
from measuring import (MISS, SIZE, LeftOut, WrongAnswer, differing, in_turn, picture_command, read_exr, read_png, run,
                       run_right, say, summary)

MEASURES = {
    "wrong": "pixels whose centre shows another primitive than it ought to, or a hit for a miss",
    "silhouette": "pixels whose centre shows a hit for a miss, or a miss for a hit",
    "depth_worst": "furthest along the view axis, as a share of the model's diagonal, of the pixels that are hits in "
                   "both pictures",
    "depth_mean": "the same, on the average",
    "colour_wrong": "pixels with a channel more than 24 of 255 from the exact picture's",
    "colour_rms": "root of the mean square of all channels, in levels of 255, against the exact picture antialiased "
                  "by 64 rays a pixel",
}
# Bars for scadray's whole process: series, setting, design, by the trace alone, times as fast.
BARS = [("OpenSCAD preview", "$fn=48", "cs1000", False, 200), ("OpenSCAD preview", "$fn=48", "cc1000", False, 50),
        ("POV-Ray", "", "cs1000", True, 25)]
DESIGNS = ["r9", "cs1000", "cc1000", "flange", "knob", "bracket"]  # those of bars come first
FRAGMENTS = [12, 48, 192]
SUPERSAMPLING = 8
SLOW_MS, VERY_SLOW_MS = 1000, 3000  # slower work is run by itself, three times; very slow work once
GROWTH = 12  # with four times the fragments, an exact solid takes about this many times as long
# The share of the pixels in which OpenSCAD's picture of its facets may differ from the exact one of the same facets:
# if more differ, the camera or the colours are different.
MOST_DIFFERING = 0.02


@dataclasses.dataclass
class Candidate:
    """A program with one setting, to be measured and judged."""
    series: str
    setting: str
    command: list
    judge: object  # returns the errors of what the last run has made
    is_scadray: bool = False
    is_answer: bool = False  # it draws the design itself: what others reach is compared with it
    error_by: str = "pixels"
    fragments: int = 0  # $fn; 0: the design's own surfaces
    makes_solid: bool = False  # its time grows with primitives and fragments until it does not end
    environment: dict = dataclasses.field(default_factory=dict)


class Subject:
    """A design seen by OpenSCAD's default camera, with its exact picture."""

    def __init__(self, name, settings):
        self.name, self.settings, self.path = name, settings, design(name, settings)
        prefix = self.file("")
        facts = json.loads(run_right([settings.judge, self.path, prefix, *SIZE], limit_s=3600).output)
        if facts["double"]["wrong"]:
            raise WrongAnswer(f"{name}: the CPU tracer differs from exact rays in {facts['double']['wrong']} pixels")
        self.primitives, self.size, self.hits = facts["primitives"], facts["size"], facts["hits"]
        self.check = {"pixels": facts["pixels"], "undecided": facts["double"]["undecided"],
                      "position_worst": facts["double"]["worst_error"]}
        self.camera = ["--camera=" + ",".join(f"{x:.17g}" for x in facts["camera"])]
        self.exact, self.traced = self.read_hits(".exact"), self.read_hits(".traced")
        self.plain, self.antialiased = self.pictures()
        self.rendered, self.rendered_antialiased = self.pictures("--render")
        self.facets = {}

    def file(self, suffix):
        return self.settings.work / (self.name + suffix)

    def read_hits(self, suffix):
        data = self.file(suffix).read_bytes()
        count = len(data) // 12
        return numpy.frombuffer(data, "<u4", count), numpy.frombuffer(data, "<f8", offset=4 * count)

    def draw(self, *options, suffix=".png", **how):
        out = self.file(suffix)
        run_right(picture_command(self.settings, self.path, out, *self.camera, *options, **how))
        return read_exr(out) if suffix == ".exr" else read_png(out)

    def pictures(self, *options):
        """Returns the exact picture, and the one antialiased by SUPERSAMPLING² rays a pixel."""
        n = SUPERSAMPLING
        large = self.draw(*options, size=(n * SIZE[0], n * SIZE[1]))
        mean = large.reshape(SIZE[1], n, SIZE[0], n, 3).mean(axis=(1, 3))
        return self.draw(*options), numpy.floor(mean + 0.5).astype(int)

    def faceted(self, fragments):
        """Returns hits and pictures of the facets that OpenSCAD makes with one $fn for all of the design."""
        if fragments not in self.facets:
            options = ["--facets=all", f"-D$fn={fragments}"]
            self.facets[fragments] = types.SimpleNamespace(
                hits=self.draw(*options, suffix=".exr"), plain=self.draw(*options),
                rendered=self.draw(*options, "--render"))
        return self.facets[fragments]

    def errors(self, hits, picture, antialiased=False, rendered=False):
        """Compares a picture, and the nodes and distances that it shows, with the exact ones."""
        seen, exact = hits[0] != MISS, self.exact[0] != MISS
        both = seen & exact
        off = abs(hits[1][both] - self.exact[1][both]) / self.size if len(hits) > 1 else numpy.empty(0)
        smooth = self.rendered_antialiased if rendered else self.antialiased
        return {"wrong": int((hits[0] != self.exact[0]).sum()),
                "silhouette": int((seen != exact).sum()),
                "depth_worst": float(off.max()) if len(off) else None,
                "depth_mean": float(off.mean()) if len(off) else None,
                # The edges of an antialiased picture are meant to be mixed.
                "colour_wrong": None if antialiased else differing(picture, self.rendered if rendered else self.plain),
                "colour_rms": float(numpy.sqrt(((picture - smooth).astype(float) ** 2).mean()))}


# --- Candidates, in each series from the quick to the slow ---


def scadray_candidates(subject):
    picture = subject.file(".scadray.png")

    def of(series, setting, *options, renderer="cpu", antialiased=False):
        def judge():
            # An EXR's distances are floats, as OpenGL's are.
            hits = subject.draw(*options, suffix=".exr", renderer=renderer) if renderer == "gl" else subject.traced
            return subject.errors(hits, read_png(picture), antialiased)
        command = picture_command(subject.settings, subject.path, picture, *subject.camera, *options, renderer=renderer)
        return Candidate(series, setting, command, judge, is_scadray=True, is_answer=True)

    def faceted(fragments):
        def judge():
            facets, drawn = subject.faceted(fragments), read_png(picture)
            if (drawn != facets.plain).any():
                raise WrongAnswer(f"{subject.name}: two pictures of the same facets differ")
            return subject.errors(facets.hits, drawn)
        return Candidate("scadray --facets=all", f"$fn={fragments}", picture_command(
            subject.settings, subject.path, picture, *subject.camera, "--facets=all", f"-D$fn={fragments}"), judge,
            is_scadray=True, error_by="facets", fragments=fragments)

    quick = subject.settings.quick
    yield of("scadray CPU", "")
    for samples in (4, 16, 64):
        yield of("scadray CPU, antialiased", f"{samples} samples", f"--samples={samples}", antialiased=True)
    yield of("scadray GL tiles", "", "--technique=tiles", renderer="gl")
    for px in [1] if quick else [4, 1, 0.25]:
        yield of("scadray GL cells, K = 2", f"{px} px", "--technique=cells", "--leaf-primitives=2",
                 f"--threshold={px}", renderer="gl")
    for fragments in fragment_counts(quick):
        yield faceted(fragments)


def fragment_counts(quick):
    return [12, 48] if quick else FRAGMENTS


def openscad_candidates(subject, display):
    picture = subject.file(".openscad.png")
    for rendered in (False, True):
        for fragments in fragment_counts(subject.settings.quick):
            def judge(rendered=rendered, fragments=fragments):
                facets, drawn = subject.faceted(fragments), read_png(picture)
                other = differing(drawn, facets.rendered if rendered else facets.plain)
                if other > MOST_DIFFERING * SIZE[0] * SIZE[1]:
                    raise WrongAnswer(f"{subject.name}: OpenSCAD's picture differs from that of its facets, "
                                      f"{fragments} a circle, in {other} pixels")
                return subject.errors(facets.hits, drawn, rendered=rendered)
            yield Candidate("OpenSCAD render" if rendered else "OpenSCAD preview", f"$fn={fragments}",
                            ["openscad", *(["--render"] if rendered else []), "-q", "-o", picture,
                             f"--imgsize={SIZE[0]},{SIZE[1]}", *subject.camera, f"-D$fn={fragments}", subject.path],
                            judge, error_by="facets", fragments=fragments, makes_solid=rendered,
                            environment={"DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1"})


def povray_candidates(subject):
    def command(scene, picture, *options):
        # Quality 3 has neither shadows nor reflections. Shades are written without gamma.
        return ["povray", f"+I{subject.file(scene)}", f"+O{subject.file(picture)}", "+FN8", "-D", "+Q3",
                "File_Gamma=1.0", f"+W{SIZE[0]}", f"+H{SIZE[1]}", f"+WT{subject.settings.threads}", *options]

    def hits():
        """Returns the nodes that a picture of the primitives in colours of their own shows."""
        if run(command(".id.pov", ".id.png", "-A"), subject.settings.peer_limit_s).status != 0:
            raise WrongAnswer(f"{subject.name}: povray draws no primitives")
        index = read_png(subject.file(".id.png")).reshape(-1, 3) @ [0x10000, 0x100, 1]
        nodes = numpy.append(numpy.frombuffer(subject.file(".nodes").read_bytes(), "<u4"), MISS)
        return [nodes[index - 1]]  # of index 0: the last, a miss

    for setting, options in {"": ["-A"], "+A0.3 +R2": ["+A0.3", "+AM1", "+R2"],
                             "+A0.1 +R4": ["+A0.1", "+AM1", "+R4"]}.items():
        def judge(setting=setting):
            return subject.errors(hits(), read_png(subject.file(".povray.png")), antialiased=bool(setting))
        yield Candidate("POV-Ray, antialiased" if setting else "POV-Ray", setting,
                        command(".pov", ".povray.png", *options), judge)


# --- Their times ---


class Scene:
    """Measures the candidates of a design."""

    def __init__(self, subject, too_hard, left_out):
        self.subject, self.settings, self.left_out = subject, subject.settings, left_out
        self.too_hard = too_hard  # by series: the primitives of a design whose coarsest solid took too long
        self.limits = {}  # by series: the fragments from which on it takes too long, and why
        self.points = []

    def bar_of(self, candidate):
        return next((bar for bar in BARS if bar[:3] == (candidate.series, candidate.setting, self.subject.name)), None)

    def run(self, point):
        candidate = point.candidate
        if candidate.series.startswith("OpenSCAD"):
            self.subject.file(".openscad.png").unlink(missing_ok=True)  # it exits with 0 even if it writes nothing
        result = run(candidate.command, self.settings.peer_limit_s, **candidate.environment)
        trace = re.search(r"Trace Time:.*\(([\d.]+) seconds\)", result.output)
        if trace:
            point.traces.append(1000 * float(trace[1]))
        return result

    def add(self, candidate):
        name = ", ".join(filter(None, [candidate.series, candidate.setting, self.subject.name]))
        fragments, why = self.limits.get(candidate.series, (None, None))
        if self.subject.primitives >= self.too_hard.get(candidate.series, 2**32):
            fragments, why = 0, "harder than a design that took too long"
        if why and candidate.fragments >= fragments:
            return self.left_out.add(name, why)
        point = types.SimpleNamespace(candidate=candidate, traces=[], times=[])
        first = self.run(point)
        say(f"{name}: {'too long' if first.timed_out else f'{first.wall_ms:.0f} ms'}")
        if first.timed_out:
            why = f"more than {self.settings.peer_limit_s:g} s"
            self.limits[candidate.series] = candidate.fragments, why
            if candidate.makes_solid and candidate.fragments == FRAGMENTS[0]:
                self.too_hard[candidate.series] = self.subject.primitives
            return self.left_out.add(name, why)
        if first.status != 0:
            return self.left_out.add(name, first.output[-200:])
        if candidate.makes_solid and GROWTH * first.wall_ms > 1000 * self.settings.peer_limit_s:
            self.limits[candidate.series] = candidate.fragments + 1, "would take too long, by the time before it"
        point.errors = candidate.judge()
        repeated = candidate.is_scadray or first.wall_ms <= VERY_SLOW_MS or self.bar_of(candidate)
        if first.wall_ms > SLOW_MS:
            point.times = [first.wall_ms] + [self.run(point).wall_ms for _ in range(2) if repeated]
            if max(point.times[1:], default=SLOW_MS + 1) <= SLOW_MS:
                point.times = []  # only its first run was slow, by compiling a shader, for example
        self.points.append(point)

    def finish(self):
        quick = [point for point in self.points if not point.times]
        for point in quick:
            point.traces.clear()
        works = [lambda point=point: self.run(point).wall_ms for point in quick]
        times = in_turn(works, self.settings, 3, 9, 300 * len(works)) if works else []
        for point, time_ms in zip(quick, times):
            point.time_ms = time_ms
        for point in self.points:
            if point.times:
                point.time_ms = summary(point.times)

    def results(self):
        points = []
        for point in self.points:
            candidate = point.candidate
            points.append({"series": candidate.series, "setting": candidate.setting,
                           "is_scadray": candidate.is_scadray, "time_ms": point.time_ms,
                           "error_by": candidate.error_by, "error": point.errors})
            if point.traces:
                points[-1]["trace_ms"] = summary(point.traces)
        return {"design": self.subject.name, "primitives": self.subject.primitives, "hits": self.subject.hits,
                "check": self.subject.check, "points": points, "levels": list(self.levels())}

    def levels(self):
        """For each error that a peer reaches, scadray's quickest point with at most that error."""
        for peer in self.points:
            if peer.candidate.is_scadray:
                continue
            for measure, error in peer.errors.items():
                if error is None:
                    continue
                level = {"series": peer.candidate.series, "setting": peer.candidate.setting, "measure": measure,
                         "error": error, "time_ms": peer.time_ms["median"]}
                ours = [point for point in self.points if point.candidate.is_answer and
                        point.errors[measure] is not None and point.errors[measure] <= error]
                if ours:
                    best = min(ours, key=lambda point: point.time_ms["median"])
                    ms = best.time_ms["median"]
                    level.update(scadray=best.candidate.series, scadray_setting=best.candidate.setting,
                                 scadray_error=best.errors[measure], scadray_ms=ms, ratio=level["time_ms"] / ms)
                yield level

    def ratios(self):
        scadray_ms = self.points[0].time_ms["median"]
        for point in self.points:
            bar = self.bar_of(point.candidate)
            if bar:
                series, setting, name, by_trace, at_least = bar
                ms = summary(point.traces)["median"] if by_trace else point.time_ms["median"]
                what = ", ".join(filter(None, [series, setting, "the trace alone" if by_trace else ""]))
                yield {"what": what, "design": name, "time_ms": ms, "scadray_ms": scadray_ms, "ratio": ms / scadray_ms,
                       "at_least": at_least}


def measure(settings):
    left_out, too_hard = LeftOut(), {}
    result = {"picture": {"width_px": SIZE[0], "height_px": SIZE[1], "pixels": SIZE[0] * SIZE[1]},
              "measures": MEASURES, "scenes": [], "ratios": [], "left_out": left_out}
    with Display() as display:
        has_openscad = display.name and shutil.which("openscad")
        if not has_openscad:
            left_out.add("OpenSCAD", "openscad and Xvfb are not both there")
        if not shutil.which("povray"):
            left_out.add("POV-Ray", "there is no povray")
        for name in ["r9", "cs100"] if settings.quick else DESIGNS:
            say(name)
            subject = Subject(name, settings)
            scene = Scene(subject, too_hard, left_out)
            candidates = [scadray_candidates(subject)]
            if shutil.which("povray"):
                candidates.append(povray_candidates(subject))
            if has_openscad:
                candidates.append(openscad_candidates(subject, display.name))
            for some in candidates:
                for candidate in some:
                    scene.add(candidate)
            scene.finish()
            result["scenes"].append(scene.results())
            result["ratios"] += scene.ratios()
            settings.keep(result)
    return result
