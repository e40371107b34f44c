"""Runs programs, takes their times, and reads their pictures, for the sections of measure.py."""

import dataclasses
import json
import os
import pathlib
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time

import numpy
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
SIZE = (640, 480)
MISS = 2**32 - 1  # a pixel's node where nothing is hit


class WrongAnswer(Exception):
    """A picture is wrong: none of its times may be reported."""


# Designs are compared with the installed openscad's.
os.environ.setdefault("SCADRAY_LANGUAGE", "2021.01")


@dataclasses.dataclass
class Settings:
    scadray: str
    judge: str
    work: pathlib.Path  # for designs and pictures; kept from run to run
    peer_limit_s: float = 15  # a picture for which a peer takes longer is left out, with all harder ones
    most: int = 1_000_000  # the largest size of a growing design
    quick: bool = False  # measure a few of each kind, to see that all works
    threads: int = 2
    keep: object = lambda result: None  # takes a section's results so far, so that an early end loses only the rest

    def some(self, values, quick=1):
        return values[:quick] if self.quick else values


def say(line):
    print(line, file=sys.stderr, flush=True)


class LeftOut(list):
    """Lines "what: why" of what the machine does not have, and what takes too long."""

    def add(self, what, why):
        self.append(f"{what}: {why.strip().splitlines()[0] if why.strip() else 'it failed'}")
        say("left out: " + self[-1])


# --- Processes and their times ---


@dataclasses.dataclass
class Process:
    status: int  # negative: ended by a signal
    timed_out: bool
    wall_ms: float  # from before its start to its end
    cpu_ms: float  # of all its threads, and of the children that it waited for
    peak_bytes: int  # None where this program holds more
    output: str  # stdout and stderr


def run(command, limit_s=300, **environment):
    """Runs a program to its end, or kills it and its children at the limit."""
    with tempfile.TemporaryFile() as output:
        # A child's peak counts this program's own until it becomes another program. 5 forgets what was held before.
        pathlib.Path("/proc/self/clear_refs").write_text("5")
        start = time.perf_counter()
        process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=output,
                                   stderr=subprocess.STDOUT, start_new_session=True,
                                   env={**os.environ, **environment})
        timer = threading.Timer(limit_s, os.killpg, (process.pid, signal.SIGKILL))
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        wall_s = time.perf_counter() - start
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        own = int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()
        return Process(process.returncode, wall_s >= limit_s, 1e3 * wall_s, 1e3 * (usage.ru_utime + usage.ru_stime),
                       1024 * usage.ru_maxrss if 1024 * usage.ru_maxrss > 1.1 * own else None,
                       output.read().decode(errors="replace"))


def run_right(command, **options):
    """Runs a program of ours, whose failure is a wrong answer."""
    result = run(command, **options)
    if result.status != 0:
        raise WrongAnswer(f"{' '.join(map(str, command))}: {'too long' if result.timed_out else result.output}")
    return result


def summary(values):
    """The median, least value and quartiles: every time in the results is one of these, in ms."""
    values = sorted(values)
    quartiles = statistics.quantiles(values, n=4, method="inclusive") if len(values) > 1 else values * 3
    return {"median": statistics.median(values), "least": values[0], "quartiles": [quartiles[0], quartiles[2]],
            "count": len(values)}


def in_turn(works, settings, least=5, most=50, long_enough_ms=2000):
    """Measures works, which return their ms, one of each a round, so that other load affects all alike. A first
    round warms up. Returns the summaries; stops once there are `most` rounds, or `least` that took long enough."""
    if settings.quick:
        least, most, long_enough_ms = 1, 2, 0
    for work in works:
        work()
    times = [[] for _ in works]
    while len(times[0]) < least or (len(times[0]) < most and sum(map(sum, times)) < long_enough_ms):
        for work, all_ms in zip(works, times):
            all_ms.append(work())
    return [summary(all_ms) for all_ms in times]


# --- scadray ---


def picture_command(settings, design, picture, *options, size=SIZE, renderer="cpu"):
    # --render would take the design for its value if it stood before it.
    return [settings.scadray, "-q", "-o", picture, *options, f"--imgsize={size[0]},{size[1]}", f"--renderer={renderer}",
            f"--threads={settings.threads}", design]


def stats_of(settings, design, *options):
    """Draws a design and returns its --stats."""
    stats = settings.work / "stats.json"
    run_right(picture_command(settings, design, settings.work / "stats.png", f"--stats={stats}", *options))
    return json.loads(stats.read_text())


def bench(settings, design, *options, threads=None):
    """Returns what `scadray bench` says of a design, which it measures only if its pictures agree."""
    result = run([settings.scadray, "bench", "-q", "--json", f"--threads={threads or settings.threads}",
                  *(["--repeat=1", "--time=0"] if settings.quick else ["--repeat=3", "--time=0.3"]), *options, design],
                 limit_s=3600)
    if result.status != 0:
        raise WrongAnswer(f"{design}: {result.output}")
    return json.loads(result.output)["files"][0]


# --- Pictures ---


def read_png(path):
    """Returns rows of pixels of three channels in 0…255."""
    with Image.open(path) as picture:
        return numpy.asarray(picture.convert("RGB"), dtype=numpy.int16)


def read_exr(path):
    """Returns the node and the distance along the view axis of each pixel of a picture that scadray has written:
    without compression, each row after its own place, with its channels one after the other by their names."""
    data = pathlib.Path(path).read_bytes()
    names, at = [], 8
    while data[at]:
        name, kind, rest = data[at:at + 200].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        count = int.from_bytes(data[at:at + 4], "little")
        value = data[at + 4:at + 4 + count]
        if name == b"channels":
            while value[0]:
                name, value = value.split(b"\0", 1)
                names.append(name)
                value = value[16:]
        elif name == b"dataWindow":
            left, top, right, bottom = numpy.frombuffer(value, "<i4")
        at += 4 + count
    width, height = right - left + 1, bottom - top + 1
    rows = numpy.frombuffer(data, "<u4", offset=at + 1 + 8 * height).reshape(height, 2 + len(names) * width)
    channels = rows[:, 2:].reshape(height, len(names), width)
    return channels[:, names.index(b"id")].ravel(), channels[:, names.index(b"Z")].copy().view("<f4").ravel()


def is_blank(picture):
    return bool((picture == picture[0, 0]).all())


VISIBLE = 24  # a channel that is further off than this is visibly wrong; tests/plugins has the same


def differing(a, b):
    """How many pixels are visibly different."""
    if a.shape != b.shape:
        raise WrongAnswer("pictures of different sizes")
    return int((abs(a - b).max(axis=2) > VISIBLE).sum())


def require_same_by_techniques(settings, design, techniques=("tiles", "cells")):
    """Compares two ways to draw a design, which share no more than a ray's evaluation, with the default one, and
    checks that anything is seen."""
    picture = settings.work / "checked.png"
    run_right(picture_command(settings, design, picture))
    usual = read_png(picture)
    if usual.shape != (SIZE[1], SIZE[0], 3) or is_blank(usual):
        raise WrongAnswer(f"{design}: an empty picture")
    for technique in techniques:
        run_right(picture_command(settings, design, picture, f"--technique={technique}"))
        if (read_png(picture) != usual).any():
            raise WrongAnswer(f"{design}: another picture with --technique={technique}")
    return usual
