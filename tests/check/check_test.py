"""`check` and `run` agree: what passes `check` takes its first step, what does not is refused before it."""

import io
import json
import os
import sys
import tempfile
import unittest
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from broken_scenes import GOOD, Case, cases  # noqa: E402

from launcher import cli, ending  # noqa: E402


def fpi(*words: str) -> tuple[int, dict, str]:
    """Status, JSON and errors of `./fpi WORDS --json`."""
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        status = ending.end([*words, "--json"], cli.carry_out)
    return status, json.loads(out.getvalue() or "null"), err.getvalue()


class Checks(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        before = Path.cwd()
        os.chdir(self.folder)  # what a check leaves behind is seen here
        self.addCleanup(os.chdir, before)
        self.runs = 0

    def check(self, case: Case) -> tuple[int, dict, str]:
        scene = case.write(self.folder)
        before = sorted(self.folder.iterdir())
        answer = fpi("check", str(scene), *self.options(case))
        self.assertEqual(sorted(self.folder.iterdir()), before, "a check leaves nothing behind")
        return answer

    def run_one_step(self, case: Case) -> int:
        """Steps that a run takes; its scene ends after one."""
        self.runs += 1
        _, summary, _ = fpi("run", str(case.write(self.folder)), "--out", str(self.folder / "runs" / str(self.runs)), *self.options(case))
        return (summary or {}).get("steps", 0)

    @staticmethod
    def options(case: Case) -> list[str]:
        return [word for override in case.overrides for word in ("--set", override)]

    def check_agrees_with_run(self, some: list[Case]):
        for case in some:
            with self.subTest(case.name):
                status, report, err = self.check(case)
                steps = self.run_one_step(case)
                self.assertEqual(status == 0, steps > 0, f"{report}\n{err}")
                if status != 0 and report is not None and report.get("findings"):
                    self.assertTrue(any(one["severity"] == "error" and one["text"] for one in report["findings"]))

    def test_good_scenes_pass_and_run(self):
        for base in GOOD:
            status, report, err = self.check(Case(base, base))
            self.assertEqual((status, report["status"], err), (0, "ok", ""), report)
            self.assertEqual([one for one in report["findings"] if one["severity"] == "error"], [])
        self.check_agrees_with_run([Case(base, base) for base in GOOD])

    def test_some_broken_scenes_are_refused_by_check_as_by_run(self):
        self.check_agrees_with_run(cases()[::15])

    def test_two_hundred_broken_scenes_are_refused_by_check_as_by_run(self):
        self.assertGreaterEqual(len(cases()), 200)
        self.check_agrees_with_run(cases())

    def test_everything_is_told_at_once_by_line(self):
        case = Case("many", "channel", replaced=("position = [1.3, 0.5]", "position = [7, 7]"),
                    overrides=[])
        scene = case.write(self.folder)
        text = scene.read_text().replace("point = [0.9, 0.5]", "point = [9, 9]").replace("to = [2, 0.5]", "to = [3, 0.5]")
        scene.write_text(text.replace("[output]", "[output]\ncolour = 1"))
        status, report, _ = fpi("check", str(scene))
        self.assertEqual(status, 1)
        found = [(one["key"], one["line"]) for one in report["findings"] if one["severity"] == "error"]
        self.assertEqual([key for key, _ in found], ["output.colour", "bodies.1.position", "probes.0.point", "profiles.0.to"])
        lines = scene.read_text().splitlines()
        self.assertEqual([line for _, line in found], [1 + next(i for i, text in enumerate(lines) if text.startswith(start)) for start in
                                                       ("colour", "position = [7", "point = [9", "to = [3")])

    def test_every_value_of_a_scene_is_judged_in_one_reading(self):
        status, report, _ = self.check(Case("many", "channel", ["fluid.density=-1", "bodies.0.radius=0", "coefficients.0.on=nobody"]))
        self.assertEqual(status, 1)
        self.assertEqual({one["key"] for one in report["findings"]}, {"fluid.density", "bodies.0.radius", "coefficients.0.on"})

    def test_a_probe_in_a_body_and_a_coarse_body_are_warned_of_and_pass(self):
        status, report, _ = self.check(Case("doubtful", "channel", ["probes.0.point=[0.6, 0.5]", "bodies.0.radius=0.1"]))
        self.assertEqual(status, 0, report)
        texts = {one["key"]: one["text"] for one in report["findings"]}
        self.assertIn('lies in the body "cylinder"', texts["probes.0.point"])
        self.assertRegex(texts["bodies.0.radius"], r'the diameter of the body "cylinder" spans \S+ elements, below 6')

    def test_half_a_per_cent_more_in_than_out_is_warned_of_with_the_numbers(self):
        case = Case("half", "channel", ['fluid.boundaries.right={type = "velocity", velocity = ["3.98*y*(1-y)", 0]}', "bodies.1.prescribed_velocity=[0, 0]"])
        status, report, _ = self.check(case)
        self.assertEqual(status, 0, report)
        warning = next(one["text"] for one in report["findings"] if "no boundary is open" in one["text"])
        self.assertIn("0.666667 m²/s enter and 0.663333 m²/s leave", warning)
        out = self.folder / "half"
        fpi("run", str(case.write(self.folder)), "--out", str(out), *self.options(case))
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(sum("no boundary is open" in line for line in summary["warnings"]), 1, summary["warnings"])

    def test_a_fast_flow_without_convection_is_warned_of(self):
        status, report, _ = self.check(Case("creeping", "channel", ["fluid.convection=false"]))
        self.assertEqual(status, 0, report)
        self.assertTrue(any("convection is left out" in one["text"] for one in report["findings"]), report)

    def test_figures_of_the_resolution_are_there_before_the_run_and_after_it(self):
        case = Case("figures", "channel", [])
        _, report, _ = self.check(case)
        names = {"expected_unknowns", "expected_memory_bytes", "elements_per_diameter", "coarsest_body", "speed", "reynolds",
                 "cell_reynolds", "courant", "viscous_number", "time_step"}
        self.assertLessEqual(names, set(report["resolution"]))
        self.assertAlmostEqual(report["resolution"]["speed"], 1.0, places=9)
        self.assertAlmostEqual(report["resolution"]["reynolds"], 40.0, places=6)
        out = self.folder / "figures"
        _, summary, _ = fpi("run", str(case.write(self.folder)), "--out", str(out))
        self.assertLessEqual(names, set(summary["resolution"]))
        self.assertGreater(summary["resolution"]["speed"], 1.0)


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # the launcher leaves pipes of ended programs to the end of its process
