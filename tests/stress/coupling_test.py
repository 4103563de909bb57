#!/usr/bin/python3
"""The cases of `./fpi stress coupling` themselves, and what counts as a failure of one."""

import tomllib
import unittest

from coupling import Disc, case, problem, toml

NAMES = [f"{family}-{k}" for family in ("one", "group", "touch", "lid") for k in range(25)]


class Cases(unittest.TestCase):
    def setUp(self):
        self.cases = {name: case(name, 1, False) for name in NAMES}

    def test_a_seed_and_a_name_make_a_case(self):
        for name in NAMES[::10]:
            self.assertEqual(self.cases[name], case(name, 1, False))
            self.assertNotEqual(self.cases[name], case(name, 2, False))
        self.assertNotEqual(self.cases["one-1"], self.cases["one-2"])

    def test_together_they_reach_over_the_ranges_asked_for(self):
        for quantity, low, high in (("density_ratio", 0, 8), ("reynolds", 0.02, 300), ("courant", 0.006, 0.4),
                                    ("bodies", 1, 20), ("gap", 0, 1.4), ("wall_gap", 0, 0.05)):
            values = [parameters[quantity] for parameters, _ in self.cases.values()]
            self.assertLessEqual(min(values), low, quantity)
            self.assertGreaterEqual(max(values), high, quantity)

    def test_bodies_start_without_overlap_inside_the_box_with_a_way_for_the_fluid(self):
        for name, (parameters, scene) in self.cases.items():
            discs = [Disc(*body["position"], body["radius"]) for body in scene["bodies"]]
            gaps = [a.gap(b) for i, a in enumerate(discs) for b in discs[:i]]
            self.assertGreaterEqual(min(gaps, default=2), parameters["gap"] - 1e-9, name)
            for axis, side in enumerate(scene["fluid.mesh"]["upper"]):
                reach = [(body["position"][axis], body["radius"]) for body in scene["bodies"]]
                rooms = min(x - r for x, r in reach), side - max(x + r for x, r in reach)
                self.assertGreaterEqual(min(rooms), -1e-9, name)
                self.assertGreaterEqual(max(rooms), 0.05 - 1e-9, name)

    def test_the_scene_is_toml(self):
        for _, scene in self.cases.values():
            self.assertEqual(tomllib.loads(toml(scene))["bodies"], scene["bodies"])

    def test_numbers_that_are_none_impossible_speeds_and_deep_overlaps_are_failures(self):
        _, scene = self.cases["group-0"]
        summary = {"bodies": [{"position": [*body["position"], 0]} for body in scene["bodies"]]}
        good = {"time": "0.1", "disc0.vx": "1"}
        self.assertEqual(problem(summary, [good], scene), "")
        self.assertIn("nan", problem(summary, [good | {"disc0.vx": "nan"}], scene))
        self.assertIn("m/s", problem(summary, [good | {"disc0.vx": "-99"}], scene))
        summary["bodies"][1] = summary["bodies"][0]
        self.assertIn("overlaps", problem(summary, [good], scene))


if __name__ == "__main__":
    unittest.main()
