"""The section "real": designs of the kinds that people publish, from the text to the picture, to the picture after a
save, and to the STL; by scadray, OpenSCAD 2021.01, and OpenSCAD's snapshot of 2025.07.18 by Manifold.

{"designs": [{"design", "kind", "primitives", "check": {"pixels", "undecided"}: of scadray's smooth picture at half the
     size, in which none is wrong by rays in exact arithmetic, or null where they take too long,
   "facets_off": pixels that OpenSCAD's comparison leaves between its preview and scadray's picture of the same facets
     (thousands where the preview has holes, since the design names no `convexity`),
   "peer_off": pixels of OpenSCAD's preview that are visibly different from the exact picture,
   "picture_ms", "preview_ms", "save_ms", "model_ms", "render_ms", "manifold_ms": summaries, or null where it cannot
     be had; the last two make the model, as model_ms does}],
 "ratios": [{"what", "median", "least", "of": the design of the least, "count", "at_least"}],
 "left_out": ["what: why"]}

All but two are whole processes. save_ms is the window's, from the file's close to the screen, where a small part has
changed, by OpenSCAD's light, as the first picture of a save is in any light. manifold_ms is what OpenSCAD's program
takes within node, as one thread of WebAssembly, without its start.
"""

import json
import shutil
import statistics
import subprocess
import sys
import time

from designs import REAL
from display import Display, Window
from measuring import (ROOT, SIZE, LeftOut, WrongAnswer, differing, in_turn, picture_command, read_png, run, run_right,
                       say, summary)

sys.path.insert(0, str(ROOT / "tests/language_suite/snapshot"))
from snapshot import Snapshot, is_installed  # noqa: E402

MOST_PIXELS = 32  # that OpenSCAD's comparison may leave
SAVES = 11
# What is compared, and how many times as fast it is to be in the median. None may be slower.
BARS = [("OpenSCAD 2021.01's preview", "picture_ms", "preview_ms", 15),
        ("OpenSCAD 2021.01's model", "model_ms", "render_ms", None),
        ("OpenSCAD 2025.07's model, by Manifold, against scadray's picture", "picture_ms", "manifold_ms", 15),
        ("OpenSCAD 2025.07's model, by Manifold", "model_ms", "manifold_ms", None)]


def pixels_left(a, b):
    """Returns how many pixels are left of the difference of two pictures by the comparison of OpenSCAD's tests."""
    result = subprocess.run(["convert", str(a), str(b), "-alpha", "On", "-compose", "difference", "-composite",
                             "-threshold", "10%", "-morphology", "Erode", "Square", "-format", "%[fx:w*h*mean]",
                             "info:"], capture_output=True, text=True)
    if result.returncode != 0:
        raise WrongAnswer(f"pictures that cannot be compared: {a} and {b}: {result.stderr}")
    return int(float(result.stdout))


class Subject:
    def __init__(self, path, kind, settings, display, snapshot, left_out):
        self.path, self.kind, self.settings, self.display = path, kind, settings, display
        self.snapshot, self.left_out = snapshot, left_out
        self.limit_s = settings.peer_limit_s
        self.result = {"design": path.stem, "kind": kind}

    def file(self, suffix):
        return self.settings.work / f"real_{self.path.stem}{suffix}"

    def openscad(self, out):
        """Returns its process; nothing where it makes no file."""
        out.unlink(missing_ok=True)  # it exits with 0 even if it writes nothing
        process = run(["openscad", "-q", "-o", out, f"--imgsize={SIZE[0]},{SIZE[1]}", self.path], self.limit_s,
                      DISPLAY=self.display, LIBGL_ALWAYS_SOFTWARE="1")
        if process.timed_out or process.status != 0 or not out.exists():
            self.left_out.add(f"OpenSCAD 2021.01, {out.suffix}, {self.path.stem}",
                              f"more than {self.limit_s:g} s" if process.timed_out else process.output[-200:])
            return None
        return process

    def peer(self, once):
        """Returns the summary of a peer's times: of one run where it is slow."""
        first = once()
        if first is None:
            return None
        again = 0 if self.settings.quick or first > 1000 else 2
        return summary([first] + [once() or first for _ in range(again)])

    def openscad_ms(self, suffix):
        def once():
            process = self.openscad(self.file(suffix))
            return process and process.wall_ms
        return self.peer(once) if self.display else None

    def manifold_ms(self):
        if not self.snapshot:
            return None
        if "text(" in self.path.read_text():
            self.left_out.add(f"OpenSCAD 2025.07, {self.path.stem}", "its package has no fonts")
            return None
        is_plane = self.result["is_plane"]
        made = "made.svg" if is_plane else "made.off"
        copies = {other.name: str(other) for other in self.path.parent.iterdir() if other.is_file()}

        def once():
            answer = self.snapshot.run([self.path.name, "-o", made, "--backend=Manifold"], made, {}, copies)
            if answer["status"] == 0 and answer["made"]:
                return answer["ms"]
            self.left_out.add(f"OpenSCAD 2025.07, {self.path.stem}", answer["said"][-200:] or str(answer["status"]))
            return None
        return self.peer(once)

    def check(self):
        """Compares scadray's pictures with the exact one, and with OpenSCAD's."""
        judged = run([self.settings.judge, self.path, self.file(""), *(side // 2 for side in SIZE)], self.limit_s)
        facts = None if judged.status else json.loads(judged.output)
        if not facts:
            self.left_out.add(f"exact rays, {self.path.stem}",
                              f"more than {self.limit_s:g} s" if judged.timed_out else judged.output[-200:])
        elif facts["double"]["wrong"]:
            raise WrongAnswer(f"{self.path}: the CPU tracer differs from exact rays in {facts['double']['wrong']} pixels")
        self.result["check"] = facts and {"pixels": facts["pixels"], "undecided": facts["double"]["undecided"]}
        smooth, faceted, peer = (self.file(suffix) for suffix in (".png", ".facets.png", ".peer.png"))
        stats = self.file(".json")
        run_right(picture_command(self.settings, self.path, smooth, f"--stats={stats}"))
        self.result["primitives"] = json.loads(stats.read_text())["primitives"]
        run_right(picture_command(self.settings, self.path, faceted, "--facets=all"))
        if self.display and self.openscad(peer):
            self.result["facets_off"] = pixels_left(peer, faceted)
            self.result["peer_off"] = differing(read_png(peer), read_png(smooth))

    def model(self):
        """The model's file: a drawing where the design is one."""
        for suffix in (".stl", ".svg"):
            process = run([self.settings.scadray, "-q", "-o", self.file(suffix), self.path])
            if process.status == 0:
                self.result["is_plane"] = suffix == ".svg"
                return suffix
        raise WrongAnswer(f"{self.path}: no model: {process.output}")

    def save_ms(self):
        if not self.display:
            return None
        folder = self.settings.work / "real_saves"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.path.parent, folder)
        design, text = folder / self.path.name, self.path.read_text()
        window = Window(self.settings.scadray, design, folder, self.display)
        times = []
        shape = "square" if self.result["is_plane"] else "cube"
        for save in range(2 if self.settings.quick else SAVES):
            time.sleep(0.1)  # until the window rests: nobody saves while the picture before is drawn
            design.write_text(f"{text}\n{shape}({1 + save / 100});\n")
            line = window.next_picture()
            if line.get("error"):
                raise WrongAnswer(f"{self.path}: the window says: {line['error']}")
            times.append(line["save_to_screen_ms"])
        window.close()
        return summary(times)

    def measure(self):
        say(self.path.stem)
        self.check()
        suffix = self.model()
        picture, model = self.file(".png"), self.file(suffix)
        commands = {"picture_ms": picture_command(self.settings, self.path, picture),
                    "model_ms": [self.settings.scadray, "-q", f"--threads={self.settings.threads}", "-o", model, self.path]}
        for key, command in commands.items():  # one after the other, as the peers
            self.result[key], = in_turn([lambda: run_right(command).wall_ms], self.settings, 5, 15, 1000)
        self.result["save_ms"] = self.save_ms()
        self.result["preview_ms"] = self.openscad_ms(".peer.png")
        self.result["render_ms"] = self.openscad_ms(".peer" + suffix)
        self.result["manifold_ms"] = self.manifold_ms()
        return self.result


def ratios(designs):
    for what, ours, theirs, at_least in BARS:
        times = {design["design"]: design[theirs]["median"] / design[ours]["median"] for design in designs
                 if design.get(theirs)}
        if times:
            slowest = min(times, key=times.get)
            yield {"what": what, "median": statistics.median(times.values()), "least": times[slowest], "of": slowest,
                   "count": len(times), "at_least": at_least}


def measure(settings):
    left_out, designs = LeftOut(), []
    snapshot = Snapshot() if is_installed() else None
    if not snapshot:
        left_out.add("OpenSCAD 2025.07", "node or its package is not there")
    with Display() as display:
        name = display.name if shutil.which("openscad") else ""
        if not name:
            left_out.add("OpenSCAD 2021.01", "openscad and Xvfb are not both there")
        for path, kind in settings.some(REAL):
            if not path.exists():
                left_out.add(path.stem, f"{path} is not there")
                continue
            designs.append(Subject(path, kind, settings, name, snapshot, left_out).measure())
            settings.keep({"designs": designs, "ratios": list(ratios(designs)), "left_out": left_out})
    if snapshot:
        snapshot.close()
    return {"designs": designs, "ratios": list(ratios(designs)), "left_out": left_out}
