"""The section "studio": the light of the window's pictures, by benchmark_light.

{"width_px", "height_px", "directions": of the sky and of the key light that give the exact picture,
 "designs": [{"design", "pixels": judged, "shaded_ms": summary of a flat picture from the prepared solid,
   "rests": [{"directions", "ms": summary, "mean_error", "worst_error": in levels of 255}]: the first that has light,
     and the last}], "at_most": [the first rest's bar for the mean error, the last's], "left_out"}
"""

import json
import pathlib

from designs import OWN, design, triangles, written
from measuring import LeftOut, WrongAnswer, run, say, summary

AT_MOST = [2, 1]
DESIGNS = ["flange", "cs1000", "t1022", "enclosure", "belt_pulley", "mould"]


def measure(settings):
    left_out = LeftOut()
    result = {"width_px": 640, "height_px": 480, "directions": 4096, "designs": [], "at_most": AT_MOST, "left_out": left_out}
    program = pathlib.Path(settings.judge).with_name("benchmark_light")
    if not program.exists():
        left_out.add("the studio's light", "benchmark_light is not built")
        return result
    mesh = triangles(settings, "triangles", 100_000)
    paths = {name: design(name, settings) for name in DESIGNS}
    paths["a mesh of 100,000 triangles"] = written(settings, "studio_mesh.scad", f'import("{mesh}");\n')
    paths["attachments"] = OWN / "attachments.scad"
    for name, path in settings.some(list(paths.items())):
        say(f"studio: {name}")
        answer = run([program, path, 1 if settings.quick else 7], 900)
        if answer.status != 0:
            raise WrongAnswer(answer.output)
        facts = json.loads(answer.output)
        result["designs"].append({
            "design": name, "pixels": facts["pixels"], "shaded_ms": summary(facts["shaded_ms"]),
            "rests": [rest | {"ms": summary(rest["ms"])} for rest in facts["rests"]]})
        settings.keep(result)
    return result
