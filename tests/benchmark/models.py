"""The section "models": meshes that scadray makes, and the files that it writes of them.

{"kernel": [{"scene", "title", "triangles_in", "triangles", "median_ms", "cpu_ms", "volume_error": as a share}]: by
     mesh_benchmark, from operands in memory to a closed mesh, whose volume is right,
 "formats": [{"suffix", "bytes", "time_ms": summary of whole processes}], "formats_of": the design,
 "tolerances": [{"tolerance_mm", "triangles", "time_ms", "corners_off_mm", "faces_off_mm": furthest of corners, and of
     edges' and faces' middles, from the exact surface}],
 "left_out"}
"""

import json
import pathlib

import numpy

from designs import design, written
from measuring import LeftOut, WrongAnswer, in_turn, run, run_right, say

KERNEL = {
    "balls_25k": "two balls of 12,000 triangles, one minus the other", "balls_250k": "the same of 125,000",
    "CS100": "a cylinder minus 100 balls, 48 fragments", "CS1000": "the same minus 1,000",
    "flush_cubes_160": "about 160 flush cubes",
    "sickle_1e-3": "a ball minus itself, moved by 1e-3 of its size", "sickle_1e-6": "the same by 1e-6",
    "sickle_1e-9": "the same by 1e-9", "sickle_1e-12": "the same by 1e-12",
    "separate_cubes_1000": "1,000 separate cubes", "separate_cubes_10000": "10,000 separate cubes",
    "separate_cubes_100000": "100,000 separate cubes", "separate_cubes_1000000": "a million separate cubes"}
BALL_MM, HOLE_MM = 10, 4
ROUNDING_MM = 2e-6  # of an STL's floats
ROUND = f"difference() {{ sphere({BALL_MM}); cylinder(30, r = {HOLE_MM}, center = true); }}\n"


def kernel(settings, left_out):
    program = pathlib.Path(settings.judge).with_name("mesh_benchmark")
    if not program.exists():
        left_out.add("the kernel", "mesh_benchmark is not built")
        return
    for scene, title in settings.some(list(KERNEL.items()), quick=1):
        say(f"models: {scene}")
        answer = run([program, f"--benchmark_filter=^{scene}/threads=2/", "--benchmark_format=json",
                      f"--benchmark_min_time={0.1 if settings.quick else 1}"], 600)
        if answer.status != 0:
            raise WrongAnswer(f"{scene}: {'too long' if answer.timed_out else answer.output}")
        # Google Benchmark writes the machine's state before its JSON.
        facts = json.loads(answer.output[answer.output.index("{\n"):])["benchmarks"][0]
        yield {"scene": scene, "title": title, "triangles_in": facts["in"], "triangles": facts["out"],
               **{key: facts[key] for key in ("median_ms", "cpu_ms", "volume_error")}}


def model_command(settings, path, out, *options):
    return [settings.scadray, "-q", f"--threads={settings.threads}", *options, "-o", out, path]


def formats(settings, path):
    say("models: formats")
    outs = {suffix: settings.work / f"model{suffix}" for suffix in (".stl", ".off", ".obj", ".3mf", ".amf")}
    times = in_turn([lambda out=out: run_right(model_command(settings, path, out)).wall_ms for out in outs.values()],
                    settings, 5, 15)
    for (suffix, out), time_ms in zip(outs.items(), times):
        yield {"suffix": suffix, "bytes": out.stat().st_size, "time_ms": time_ms}


def triangles_of(path):
    """Returns the corners of a binary STL's triangles (count × 3 × 3, mm)."""
    data = path.read_bytes()
    facets = numpy.frombuffer(data, [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")],
                              int.from_bytes(data[80:84], "little"), 84)
    return facets["corners"].astype(float)


def off_surface_mm(points):
    """How far each of the points is from the pierced ball's surface."""
    across = numpy.hypot(points[:, 0], points[:, 1])
    ball = abs(numpy.hypot(across, points[:, 2]) - BALL_MM)
    return numpy.minimum(ball, abs(across - HOLE_MM))


def tolerances(settings):
    path, out = written(settings, "round.scad", ROUND), settings.work / "round.stl"
    for tolerance in settings.some([1, 0.1, 0.01, 0.001, 0.0001], quick=2):
        say(f"models: tolerance {tolerance}")
        command = model_command(settings, path, out, f"--tolerance={tolerance}")
        time_ms, = in_turn([lambda command=command: run_right(command).wall_ms], settings, 3, 9)
        corners = triangles_of(out)
        middles = numpy.concatenate([corners.mean(axis=1), *((corners[:, i] + corners[:, i - 1]) / 2 for i in range(3))])
        faces = float(off_surface_mm(middles).max())
        if not faces <= tolerance + ROUNDING_MM:
            raise WrongAnswer(f"--tolerance={tolerance}: a face is {faces} from the surface")
        yield {"tolerance_mm": tolerance, "triangles": len(corners), "time_ms": time_ms,
               "corners_off_mm": float(off_surface_mm(corners.reshape(-1, 3)).max()), "faces_off_mm": faces}


def measure(settings):
    left_out, name = LeftOut(), "r9" if settings.quick else "cs100"
    left_out.add("the kernel, CS10000", "takes minutes, its judge included")
    return {"kernel": list(kernel(settings, left_out)), "formats_of": name,
            "formats": list(formats(settings, design(name, settings))), "tolerances": list(tolerances(settings)),
            "left_out": left_out}
