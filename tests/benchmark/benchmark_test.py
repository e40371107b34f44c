"""Tests of measure.py and report.py, with small designs and with programs that draw wrong pictures.

  benchmark_test.py SCADRAY JUDGE
"""

import itertools
import json
import os
import pathlib
import runpy
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
    import report
    from measuring import Settings, WrongAnswer, in_turn, read_exr, read_png, run, summary
    import error
except ModuleNotFoundError as missing:
    print(f"skipped: {missing} (tests/benchmark/packages)")
    sys.exit(0)

HERE = pathlib.Path(__file__).resolve().parent
SCADRAY, JUDGE = (os.path.abspath(program) for program in sys.argv[1:3])


class Benchmark(unittest.TestCase):
    def setUp(self):
        self.keeper = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.keeper.name)
        self.results = self.folder / "results.json"

    def tearDown(self):
        self.keeper.cleanup()

    def measure(self, *options):
        return subprocess.run([sys.executable, "-B", HERE / "measure.py", "--quick", "--output", self.results,
                               "--folder", self.folder / "work", "--scadray", SCADRAY, "--judge", JUDGE, *options],
                              capture_output=True, text=True)

    def program(self, body):
        path = self.folder / "program"
        path.write_text(f"#!/bin/sh\n[ \"$1\" = --version ] && exit\n{body}\n")
        path.chmod(0o700)
        return path

    def draw(self, name, text, *options):
        (self.folder / "x.scad").write_text(text)
        self.assertEqual(run([SCADRAY, "-q", "-o", self.folder / name, "--renderer=cpu", *options,
                              self.folder / "x.scad"]).status, 0)
        return self.folder / name


class Measuring(Benchmark):
    def test_processes(self):
        ended = run(["sh", "-c", "echo out; echo err >&2; exit 3"])
        self.assertEqual((ended.status, ended.timed_out, ended.output), (3, False, "out\nerr\n"))
        late = run(["sh", "-c", "sleep 60 & wait"], limit_s=0.2)
        self.assertTrue(late.timed_out and late.status != 0 and 200 <= late.wall_ms < 20_000)
        busy = run([sys.executable, "-c", "b = bytearray(300_000_000); sum(range(10**6))"])
        self.assertTrue(busy.peak_bytes > 3e8 and 1 < busy.cpu_ms)

    def test_summaries(self):
        self.assertEqual(summary([4, 1, 3, 2, 5]), {"median": 3, "least": 1, "quartiles": [2, 4], "count": 5})
        self.assertEqual(summary([7]), {"median": 7, "least": 7, "quartiles": [7, 7], "count": 1})

    def test_works_are_measured_in_turn_after_a_round_to_warm_up(self):
        calls = []
        works = [lambda i=i: calls.append(i) or 10 + i for i in range(2)]
        times = in_turn(works, Settings("", "", self.folder), 3, 9, 0)
        self.assertEqual(calls, [0, 1] * 4)
        self.assertEqual([(one["median"], one["count"]) for one in times], [(10, 3), (11, 3)])
        self.assertEqual(in_turn(works, Settings("", "", self.folder), 3, 9, 100)[0]["count"], 5)

    def test_pictures(self):
        text = "translate([0, 0, -1]) cube(1); sphere(2);"
        options = ["--imgsize=40,30", "--camera=0,0,0,0,0,0,20"]
        nodes, depth = read_exr(self.draw("x.exr", text, *options))
        picture = read_png(self.draw("x.png", text, *options))
        self.assertEqual((picture.shape, nodes.shape, depth.shape), ((30, 40, 3), (1200,), (1200,)))
        middle = 15 * 40 + 20
        self.assertAlmostEqual(depth[middle], 18, delta=0.1)
        self.assertEqual((nodes[middle], nodes[0]), (1, 2**32 - 1))
        self.assertTrue(((nodes != 2**32 - 1) == (picture != picture[0, 0]).any(axis=2).ravel()).all())

    def test_errors_of_a_picture(self):
        subject = error.Subject.__new__(error.Subject)
        miss, far = 2**32 - 1, numpy.inf
        subject.size, subject.exact = 10, (numpy.array([1, 2, 2, miss]), numpy.array([5.0, 5, 5, far]))
        subject.plain = subject.antialiased = numpy.zeros((2, 2, 3), numpy.int16)
        drawn = subject.plain.copy()
        drawn[0, 0] = [24, 0, 0]
        drawn[1, 1] = [0, 25, 0]
        hits = numpy.array([1, 1, miss, miss]), numpy.array([5.0, 6, far, far])
        errors = subject.errors(hits, drawn)
        self.assertEqual([errors[key] for key in ("wrong", "silhouette", "colour_wrong")], [2, 1, 1])
        self.assertAlmostEqual(errors["depth_worst"], 0.1)
        self.assertAlmostEqual(errors["depth_mean"], 0.05)
        self.assertAlmostEqual(errors["colour_rms"], ((24**2 + 25**2) / 12)**0.5)


class WrongPrograms(Benchmark):
    """Programs in scadray's place."""

    def expect_no_times(self, body, why, section="growth"):
        result = self.measure("--section", section, "--scadray", self.program(body))
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("measure: wrong answer: ", result.stderr)
        self.assertIn(why, result.stderr)
        self.assertFalse(self.results.exists() and "wall_ms" in self.results.read_text())

    def test_one_that_fails(self):
        self.expect_no_times("echo out of paint; exit 1", "out of paint")

    def test_one_that_draws_nothing(self):
        self.expect_no_times(f"""case "$*" in *.png*) away=--camera=1e6,1e6,0,0,0,0,1 ;; esac
            exec '{SCADRAY}' $away "$@\"""", "an empty picture")

    def test_one_whose_pictures_depend_on_the_technique(self):
        self.expect_no_times(f"""case "$*" in *cells*) turn=--camera=0,0,0,9,0,0,99 ;; esac
            exec '{SCADRAY}' $turn "$@\"""", "another picture with --technique=cells")

    def test_a_judge_that_finds_wrong_pixels(self):
        judge = self.program('echo \'{"double": {"wrong": 7}}\'')
        with self.assertRaisesRegex(WrongAnswer, "differs from exact rays in 7 pixels"):
            error.Subject("r9", Settings(SCADRAY, str(judge), self.folder))
        result = self.measure("--section", "real", "--judge", str(judge))
        self.assertEqual(result.returncode, 1)
        self.assertIn("differs from exact rays in 7 pixels", result.stderr)


class SlowSearch(Benchmark):
    def test_what_is_found_is_drawn(self):
        found = self.folder / "found"
        search = [HERE / "slow_search", found, "--program", SCADRAY, "--designs", "90", "--seconds", "1000"]
        self.assertEqual(run(search).status, 0)
        table = (found / "found.txt").read_text().splitlines()
        designs = list(found.glob("*.csg"))
        self.assertTrue(table[0].startswith("# seed 1: 90 designs"))
        self.assertGreater(len(designs), 20)
        self.assertEqual(len(table), 2 + len(designs))
        for path in designs:
            self.assertEqual(run([SCADRAY, "-q", "-o", self.folder / "x.csg", path]).status, 0, path)
        self.assertEqual(run(search).status, 1)  # the folder is not empty

    def test_changes_keep_blocks_balanced(self):
        search = runpy.run_path(str(HERE / "slow_search"), run_name="slow_search")
        lines = search["lines_of"](search["FAMILIES"]["holes"](9))
        kinds = set()
        for _ in range(500):
            changed = search["mutated"](lines, lines)
            depths = list(itertools.accumulate(line.endswith("{") - (line == "}") for line in changed))
            self.assertTrue(not depths or (min(depths) >= 0 and depths[-1] == 0), changed)
            kinds.add(len(changed))
        self.assertGreater(len(kinds), 20)


class Results(Benchmark):
    def test_the_report_reads_what_is_measured(self):
        sections = ["real", "growth", "stability", "frames", "models", "studio"]
        result = self.measure(*(word for section in sections for word in ("--section", section)))
        self.assertEqual(result.returncode, 0, result.stderr)
        results = json.loads(self.results.read_text())
        for curve in results["sections"]["stability"]["curves"]:
            self.assertEqual(curve["rows"][0]["double"]["wrong"], 0)
        for design in results["sections"]["real"]["designs"]:
            self.assertLessEqual(design.get("facets_off", 0), 32, design["design"])
        models, studio = (results["sections"][name] for name in ("models", "studio"))
        self.assertGreater(models["kernel"][0]["triangles"], 10_000)
        self.assertEqual([row["tolerance_mm"] for row in models["tolerances"]], [1, 0.1])
        self.assertLess(studio["designs"][0]["rests"][1]["mean_error"], studio["at_most"][1])
        text = report.report_text(results, self.folder)
        for heading in ("Designs that people draw", "How it grows", "What cannot be seen", "Pixels and threads",
                        "Numerical stability", "Meshes and their files", "The studio's light"):
            self.assertIn(f"\n## {heading}\n", text)
        for plot in ("real", "growth", "frames", "stability_angle"):
            self.assertIn(f"({plot}.svg)", text)
            self.assertTrue((self.folder / f"{plot}.svg").exists())
        first = (self.folder / "growth.svg").read_bytes()
        report.report_text(results, self.folder)
        self.assertEqual(first, (self.folder / "growth.svg").read_bytes())

    def test_other_sections_are_kept_if_they_are_of_this_machine(self):
        self.assertEqual(self.measure("--section", "stability").returncode, 0)
        for processor, kept in (("", True), ("Abacus", False)):
            before = json.loads(self.results.read_text())
            before["sections"]["paper"] = {"commit": "0123456789", "date": "2026-01-02T03:04Z"}
            before["machine"]["processor"] = processor or before["machine"]["processor"]
            self.results.write_text(json.dumps(before))
            self.assertEqual(self.measure("--section", "stability").returncode, 0)
            after = json.loads(self.results.read_text())
            self.assertEqual(after["sections"].get("paper"), before["sections"]["paper"] if kept else None)
            self.assertEqual(report.section_text(after["sections"]["stability"], after), "")
        self.assertIn("2026-01-02 at commit 0123456789", report.section_text(before["sections"]["paper"], after))

    def test_the_panel_is_told_of(self):
        one = {"median": 41, "least": 40, "quartiles": [40, 43], "count": 20}
        section = {"edits": [{"design": "30 lines", "light": "flat", "edit_ms": one, "at_most": 50}], "left_out": [],
                   "turns": [{"design": "CS1000", "frames_per_second": 42.5, "width_px": 513, "gap_ms": one, "at_least": 30}]}
        text = report.write_panel(section, self.folder)
        self.assertIn("| 30 lines | flat | 41 (40–43) | at most 50 |", text)
        self.assertIn("| CS1000 | 42.5 | at least 30 | 513 | 41 (40–43) |", text)
        self.assertEqual(report.write_panel({"edits": [], "turns": [], "left_out": []}, self.folder), "")

    def test_numbers(self):
        for value, text in ((0, "0"), (0.04123, "0.0412"), (8.129, "8.13"), (9.996, "10.0"), (345.4, "345"),
                            (4.32e6, "4,320,000"), (2.1e-13, "2.1e-13"), (3e-5, "3e-5"), (None, "–"),
                            (-1234.5, "-1,230")):
            self.assertEqual(report.number(value), text)
        self.assertEqual([report.size(value) for value in (12, 999_600, 1.72e9)], ["12 bytes", "1.00 MB", "1.72 GB"])

    def test_readmes_part_is_replaced(self):
        text = f"before\n{report.BEGIN}\nold\n{report.END}\nafter\n"
        self.assertEqual(report.with_part(text, "new\n"), text.replace("old", "new"))
        for broken in (text + text, "none", text.replace(report.END, "")):
            with self.assertRaises(SystemExit):
                report.with_part(broken, "new\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
