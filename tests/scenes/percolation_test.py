#!/usr/bin/python3
"""Scenes of flow through grains, fixed and moving, against the values that each of them cites."""

import csv
import math
import statistics
import unittest

from scene_case import SceneCase


class Scenes(SceneCase):
    def test_percolation_packing(self):
        grains = self.run_scene("percolation_packing")["grains"][0]
        self.assertEqual(grains["count"], 200)
        self.assertLess(grains["kinetic_energy"], 1e-9)

    def test_percolation_bed(self):
        """Fluidised, the bed's buoyant weight is what the flow exerts on the sole, whatever the flow."""
        self.run_scene("percolation_bed", "time.end=0.46", "output.fields=false")
        with (self.run_folder / "final_bodies.csv").open(newline="") as file:
            radii = [float(row["radius"]) for row in csv.DictReader(file)]
        weight = sum(math.pi * radius**2 * 1e-3 * (1500 - 0.64 * 1000) * 9.81 for radius in radii)
        history = self.history()
        carried = [-force for time, force in zip(history["time"], history["bottom.fy"]) if time > 0.4]
        self.assert_near(statistics.fmean(carried), weight, 1e-2)

    def test_percolation_slot(self):
        summary = self.run_scene("percolation_slot", "time.end=0.7", "output.fields=false")
        with (self.run_folder / "left_bodies.csv").open(newline="") as file:
            left = list(csv.DictReader(file))
        (outlet,) = summary["outlets"]
        self.assertGreaterEqual(outlet["count"], 5)
        self.assertEqual(outlet["count"], len(left))
        self.assertEqual(outlet["count"] + summary["grains"][2]["count"], 36)
        self.assertEqual(outlet["mass"], sum((float(row["mass"]) for row in left), 0.0))

    def test_percolation_square_array(self):
        summary = self.run_scene("percolation_square_array")
        self.assert_near(1 / summary["probes"]["superficial_velocity"], 51.53, 1e-3)  # Sangani & Acrivos
        self.assert_near(summary["bodies"][0]["force"][0], 1, 1e-10)
        self.assertEqual(summary["boundaries"], [])
        self.assertLess(summary["force_balance"]["rest"], 1e-8)

    def test_percolation_random(self):
        summary = self.run_scene("percolation_random", "fluid.mesh.elements_per_diameter=6")
        self.assert_near(summary["percolation"]["superficial_velocity_x"], 2.913e-5, 2e-3)  # our finest meshes, docs/percolation.md
        self.assertLess(summary["force_balance"]["rest"], 1e-8)
        for name, columns in (("sections", "x,porosity,pressure,superficial_velocity"), ("velocities", "from,to,share"),
                              ("grains", "body,x,y,radius,drag,lift,torque")):
            lines = (self.run_folder / f"{name}.csv").read_text().splitlines()
            self.assertEqual(lines[0], columns)
            self.assertGreater(len(lines), 20)

    def test_percolation_cell(self):
        found = self.run_scene("percolation_cell", "fluid.mesh.elements_per_diameter=4")["percolation"]
        xx, xy, yx, yy = (found[f"permeability_{ij}"] for ij in ("xx", "xy", "yx", "yy"))
        self.assert_near(found["superficial_velocity_x"], 1, 1e-10)
        self.assertAlmostEqual(xy / xx, yx / xx, 10)
        self.assert_near(found["permeability"], xx - xy * yx / yy, 1e-9)  # nothing passes across


if __name__ == "__main__":
    unittest.main()
