"""Sweeps: what combinations there are, what is made of their figures, and that a second call runs nothing twice."""

import csv
import json
import unittest

from fakes import FakeTest

from launcher.common import Refusal
from launcher.study import sweep


WATER = sweep.Medium(density=2.0, viscosity=0.5, direction="x")


def row(figures, **values):
    return sweep.Row(sweep.Point({key.replace("__", "."): value for key, value in values.items()}), "completed", figures)


def flow(u, permeability, beta):
    return {"superficial_velocity_x": u,
            "pressure_gradient": -(WATER.viscosity / permeability * u + WATER.density * beta * u * u)}


class Axes(unittest.TestCase):
    def test_commas_in_brackets_and_quotes_belong_to_a_value(self):
        axis, = sweep.parse(["fluid.pressure_drop=[1,0],[2, 0],['a,b',0]"])
        self.assertEqual(axis.values, ["[1,0]", "[2, 0]", "['a,b',0]"])

    def test_every_combination_has_a_folder_of_its_own(self):
        points = sweep.points(sweep.parse(["grains.0.seed=1,2,3", "time.step=1e-3,2e-3"]))
        self.assertEqual(len({point.name for point in points}), 6)
        self.assertEqual(points[1].overrides, ["grains.0.seed=1", "time.step=2e-3"])
        self.assertEqual(points[1].name, "seed_1_step_2e-3")

    def test_what_is_no_axis_is_refused(self):
        for words, what in ((["seed"], "key=a,b,c is required"), (["seed="], "key=a,b,c is required"),
                            (["a=1", "a=2"], "every key must come once"), (["a=1,1"], "must differ")):
            with self.assertRaises(Refusal) as refused:
                sweep.points(sweep.parse(words))
            self.assertIn(what, str(refused.exception))


class Fits(unittest.TestCase):
    def test_the_law_that_made_the_figures_is_found(self):
        rows = [row(flow(u, 3e-3, 7.0), fluid__pressure_drop=str(u)) for u in (0.1, 0.4, 1.5)]
        fit, = sweep.fits(rows, WATER)
        self.assertAlmostEqual(fit.permeability, 3e-3, 12)
        self.assertAlmostEqual(fit.inertia, 7.0, 9)
        self.assertLess(fit.misfit, 1e-12)

    def test_each_packing_has_its_own(self):
        rows = [row(flow(u, k, 0), grains__0__seed=seed, fluid__superficial_velocity=str(u))
                for seed, k in (("1", 1e-3), ("2", 2e-3)) for u in (0.1, 0.2, 0.3)]
        self.assertEqual([(fit.of, round(fit.permeability, 9)) for fit in sweep.fits(rows, WATER)],
                         [({"grains.0.seed": "1"}, 1e-3), ({"grains.0.seed": "2"}, 2e-3)])

    def test_equal_flows_are_refused(self):
        rows = [row(flow(0.1, 1e-3, 0), fluid__pressure_drop=str(k)) for k in range(3)]
        with self.assertRaises(Refusal):
            list(sweep.fits(rows, WATER))


class Running(FakeTest):
    def test_what_is_complete_is_not_run_again(self):
        status, out, _ = self.fpi("sweep", "drop.toml", "a=1,2", "--out", "s")
        self.assertEqual(status, 0)
        self.assertIn("[2/2] a=2", out)
        with (self.folder / "s" / "sweep.csv").open() as file:
            self.assertEqual([(one["a"], one["status"]) for one in csv.DictReader(file)], [("1", "completed"), ("2", "completed")])
        for name in ("a_1", "a_2"):
            (self.folder / "s" / name / "scene.toml").write_text((self.folder / "drop.toml").read_text())
        summary = self.folder / "s" / "a_1" / "summary.json"
        changed = json.loads(summary.read_text()) | {"probes": {"mark": 5}}
        summary.write_text(json.dumps(changed))
        status, out, _ = self.fpi("sweep", "drop.toml", "a=1,2,3", "--out", "s")
        self.assertEqual(status, 0)
        self.assertIn("mark", out)

    def test_a_run_that_fails_is_in_the_table_and_in_the_status(self):
        status, out, _ = self.fpi("sweep", "drop.toml", "a=1", "--out", "s", fluid="die")
        self.assertEqual(status, 1)
        self.assertIn("failed", out)

    def test_the_reason_of_a_failure_is_told_once_whatever_is_asked_for(self):
        for mode in ("--quiet", "--json"):
            status, out, err = self.fpi("sweep", "drop.toml", "a=1,2", "--out", "s", mode, fluid="die")
            self.assertEqual(status, 1)
            if mode == "--json":
                self.assertEqual([one["reason"] for one in json.loads(out)["runs"]], 2 * ["exited fluid -9"])
                self.assertEqual(err, "")
            else:
                self.assertEqual((out, err), ("", "fpi: a=1: exited fluid -9\nfpi: a=2: exited fluid -9\n"))

    def test_a_folder_that_no_run_made_is_left_alone(self):
        precious = self.folder / "s" / "a_1" / "precious"
        precious.parent.mkdir(parents=True)
        precious.write_text("")
        status, _, err = self.fpi("sweep", "drop.toml", "a=1", "--out", "s")
        self.assertEqual(status, 1)
        self.assertIn("holds something else", err)
        self.assertTrue(precious.exists())


if __name__ == "__main__":
    unittest.main()
