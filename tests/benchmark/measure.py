"""Measures scadray and its peers; tests/benchmark/run calls it. Writes a results file (JSON), and keeps the file's
other sections, each with its commit and date, if they are of the same machine."""

import argparse
import datetime
import json
import os
import pathlib
import platform
import re
import sys

import error
import growth
import models
import panel
import paper
import real
import studio
from measuring import ROOT, Settings, WrongAnswer, run, say

# Each measures one section, and checks its answers before it takes a time.
SECTIONS = {"real": real.measure, "error": error.measure, "growth": growth.measure_growth, "frames": growth.measure_frames,
            "stability": growth.measure_stability, "models": models.measure, "studio": studio.measure,
            "panel": panel.measure, "opengl": paper.measure_opengl, "paper": paper.measure_paper}


def first_match(pattern, text, otherwise="unknown"):
    match = re.search(pattern, text, re.MULTILINE)
    return match[1] if match else otherwise


def output_of(*command):
    try:
        result = run(command)
    except FileNotFoundError:
        return ""
    return result.output if result.status == 0 else ""


QUICK_PEER_LIMIT_S = 3
FORMAT = 3  # of the results: the report does not understand sections of another one


def commit():
    """Returns the commit, with "+" if anything has changed besides what the report writes."""
    head = output_of("git", "-C", ROOT, "rev-parse", "--short=10", "HEAD").strip()
    changes = output_of("git", "-C", ROOT, "status", "--porcelain", "--untracked-files=no", "--", ":/", ":!/README.md",
                        ":!/tests/benchmark/results")
    return (head or "unknown") + ("+" if changes else "")


def machine(settings):
    """Describes the machine, and what is measured."""
    versions = {"scadray": first_match(r"([\d.]+)", output_of(settings.scadray, "--version"), ""),
                "OpenSCAD": first_match(r"([\d.]+)", output_of("openscad", "--version"), ""),
                "POV-Ray": first_match(r"POV-Ray ([\d.]*\d)", output_of("povray", "--version"), ""),
                "Mesa": output_of("dpkg-query", "-W", "-f=${Version}", "libgl1-mesa-dri")}
    about = pathlib.Path("/proc/cpuinfo").read_text()
    sets = [name for flag, name in (("avx512dq", "AVX-512"), ("avx2", "AVX2"), ("sse4_1", "SSE4")) if flag in about]
    return {"processor": first_match(r"^model name\s*:\s*(.*)", about),
            "instruction_set": (sets + ["baseline"])[0],
            "cores": os.cpu_count(),
            "memory_bytes": os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"),
            "system": first_match(r'^PRETTY_NAME="(.*)"', pathlib.Path("/etc/os-release").read_text()) +
                      ", Linux " + platform.release(),
            "compiler": output_of("c++", "--version").partition("\n")[0],
            "commit": commit(),
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%MZ"),
            "versions": {name: version for name, version in versions.items() if version}}


def sections_kept(path, now):
    try:
        old = json.loads(path.read_text())
    except (OSError, ValueError):
        return {}
    same = all(old.get("machine", {}).get(key) == now[key] for key in ("processor", "cores"))
    return old.get("sections", {}) if same and old.get("format") == FORMAT else {}


def main():
    build = ROOT / "build/release"
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=pathlib.Path, required=True, help="the results file")
    parser.add_argument("--folder", type=pathlib.Path, required=True, help="for designs and pictures; kept")
    parser.add_argument("--section", action="append", choices=SECTIONS,
                        help="only this one, and the others as they were; repeatable")
    parser.add_argument("--scadray", default=str(build / "frontend/scadray"), help="the program that is measured")
    parser.add_argument("--judge", default=str(build / "tests/benchmark/benchmark_judge"))
    parser.add_argument("--peer-limit", type=float, default=15, metavar="S", help="a peer's limit for a picture")
    parser.add_argument("--most", type=int, default=1_000_000, metavar="N", help="to which designs grow")
    parser.add_argument("--threads", type=int, default=2, help="of scadray and POV-Ray")
    parser.add_argument("--quick", action="store_true", help="a few of each kind, to see that all works")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    peer_limit_s = min(options.peer_limit, QUICK_PEER_LIMIT_S) if options.quick else options.peer_limit
    settings = Settings(options.scadray, options.judge, options.folder.resolve(), peer_limit_s, options.most,
                        options.quick, options.threads)
    now = machine(settings)
    kept = sections_kept(options.output, now) if options.section else {}
    for name, measure in SECTIONS.items():
        if options.section and name not in options.section:
            continue
        say(f"== {name}")

        def keep(result, name=name):
            kept[name] = result | {key: now[key] for key in ("commit", "date")}
            fresh = options.output.with_suffix(".new")  # the old file stays until the new one is complete
            fresh.write_text(json.dumps({"format": FORMAT, "machine": now, "sections": kept}, indent=1) + "\n")
            fresh.rename(options.output)
        settings.keep = keep
        keep(measure(settings))
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except WrongAnswer as wrong:
        sys.exit(f"measure: wrong answer: {wrong}: no times")
