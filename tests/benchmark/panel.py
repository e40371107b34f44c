"""The section "panel": the preview in Chromium, by tests/panel/measure.ts.

{"edits": [{"design", "light": "studio" or "flat", "edit_ms": summary, from a save on the disk to the full frame on the
     canvas, "at_most"}],
 "turns": [{"design", "frames_per_second", "width_px", "gap_ms": summary, "at_least"}], "left_out"}
"""

import json

from measuring import ROOT, LeftOut, run, say, summary

BARS_MS = {"30 lines": 50, "2,000 primitives": 70}
LEAST_FRAMES_PER_SECOND = 30
SKIPPED = 77


def measure(settings):
    left_out, edits, turns = LeftOut(), [], []
    result = {"edits": edits, "turns": turns, "left_out": left_out}
    if settings.quick:  # the panel's tests see that it works
        return result
    say("panel")
    answer = run([ROOT / "tests/panel/run", settings.scadray, settings.work / "panel", "measure"], 900)
    if answer.status != 0:
        left_out.add("the panel", answer.output if answer.status == SKIPPED else answer.output[-200:])
        return result
    for line in answer.output.splitlines():
        if not line.startswith("{"):
            continue
        facts = json.loads(line)
        if "edit_ms" in facts:
            edits.append(facts | {"edit_ms": summary(facts["edit_ms"]), "at_most": BARS_MS[facts["design"]]})
        else:
            turns.append(facts | {"gap_ms": summary(facts["gap_ms"]), "at_least": LEAST_FRAMES_PER_SECOND})
    return result
