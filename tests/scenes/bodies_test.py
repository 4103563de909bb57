#!/usr/bin/python3
"""Scenes of free bodies in a fluid, against the values that each of them cites."""

import math
import unittest

from scene_case import SceneCase


class Scenes(SceneCase):
    def test_settling_disc_starts(self):
        """A coarse mesh and the first twenty steps: straight down, slower than added mass alone would let it fall."""
        summary = self.run_scene("settling_disc", "fluid.mesh.cell_size=6.25e-4", "time.end=0.03")
        disc = summary["bodies"][0]
        inviscid = 9.81 * (1250 - 1000) / (1250 + 1000) * 0.03
        self.assertLess(-inviscid, disc["velocity"][1])
        self.assertLess(disc["velocity"][1], -0.4 * inviscid)
        self.assertLess(abs(disc["position"][0] - 0.01), 1e-6)

    def test_settling_disc(self):
        """The whole fall: plateau speed, heights of references, rest on the floor."""
        self.run_scene("settling_disc")
        history, d, u = self.history(), 0.0025, 0.09814
        self.assert_near(max(-v for v in history["disc.vy"]), 0.05585, 0.01)
        for after, expected in ((5, 14.52), (10, 11.94), (20, 6.32), (25, 3.48)):
            self.assertLess(abs(self.at(after * d / u, "disc.y") / d - expected), 0.05, f"at t u_ref/d = {after}")
        self.assertGreater(min(history["disc.y"]), d / 2 - 0.01 * d)
        self.assertLess(abs(history["disc.vy"][-1]), 2e-2 * 0.0559, "all but at rest: the film under it drains slowly")

    def test_free_rotation(self):
        disc = self.run_scene("free_rotation")["bodies"][0]
        self.assert_near(disc["spin"][2], -0.5, 1e-3)
        self.assertLess(max(map(abs, disc["position"])), 1e-4)

    def test_massless_disc(self):
        """A thousand steps straight up, each of them one exchange."""
        summary, d = self.run_scene("massless_disc", "output.fields=false"), 0.0025
        self.assertEqual(summary["steps"], 1000)
        self.assertEqual(summary["sub_iterations"], {"mean": 1, "max": 1})
        history = self.history()
        self.assertGreater(min(history["disc.vy"]), 0)
        self.assertLess(max(abs(x - 0.0075) for x in history["disc.x"]), 0.01 * d)
        self.assertGreater(history["disc.y"][-1], 0.0035 + 5 * d)

    def test_couette_migration(self):
        self.run_scene("couette_migration", "output.fields=false")
        for time, height in ((10, 0.2963), (20, 0.3485), (40, 0.4234), (60, 0.4643), (100, 0.4908)):
            self.assertLess(abs(self.at(time, "disc.y") - height), 0.01, f"at t = {time}")

    def test_poiseuille_migration(self):
        self.run_scene("poiseuille_migration", "output.fields=false")
        self.assertLess(abs(self.at(600, "disc.y") - 0.2723), 0.005)
        self.assertLess(abs(self.at(600, "disc.y") - self.at(500, "disc.y")), 1e-3, "it stays there")

    def test_drafting_kissing(self):
        """The later distances and the peak speed of the reference are missed: docs/coupling.md."""
        self.run_scene("drafting_kissing", "output.fields=false")

        def apart(time: float) -> float:
            return math.hypot(*(self.at(time, f"trailing.{axis}") - self.at(time, f"leading.{axis}") for axis in "xy")) / 0.0025

        self.assertLess(abs(apart(0.05) - 2.02), 0.05)
        self.assertLess(apart(0.16), apart(0.12), "the one in the lee catches up")
        self.assertGreater(self.at(0.16, "leading.vy"), 1.2 * self.at(0.16, "trailing.vy"), "and falls faster")


if __name__ == "__main__":
    unittest.main()
