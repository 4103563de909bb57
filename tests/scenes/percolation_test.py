#!/usr/bin/python3
"""Scenes of flow through grains, fixed and moving, against the values that each of them cites."""

import csv
import math
import statistics
import unittest

from scene_case import SceneCase


class Scenes(SceneCase):
    def test_percolation_packing(self):
        distributor, grains = self.run_scene("percolation_packing")["grains"]
        self.assertEqual((distributor["count"], grains["count"]), (12, 200))
        self.assertLess(grains["kinetic_energy"], 1e-9)

    def test_percolation_bed(self):
        """Fluidised, the bed's buoyant weight is what the flow exerts on the sole, whatever the flow."""
        self.run_scene("percolation_bed", "time.end=0.46", "output.fields=false")
        history = self.history()
        carried = [-force for time, force in zip(history["time"], history["bottom.fy"]) if time > 0.4]
        self.assert_near(statistics.fmean(carried), self.buoyant_weight(), 1e-2)

    def buoyant_weight(self) -> float:
        """Of discs of which the fluid sees 0.8 of the radius [N]."""
        return sum(math.pi * row["radius"] ** 2 * 1e-3 * (1500 - 0.64 * 1000) * 9.81 for row in self.rows("final_bodies.csv"))

    def test_percolation_bed_200(self):
        """From fluidisation on the pressure drop, less that of the distributor, is the bed's buoyant weight."""
        import h5py

        summary = self.run_scene("percolation_bed_200", "time.end=0.7", "output.fields=false")
        self.assertLess(summary["sub_iterations"]["mean"], 2.5)
        self.assertEqual(summary["coupling"]["rejected_steps"], 0)
        drops = []
        with h5py.File(self.run_folder / "bodies.h5") as file:
            distributor = [name.startswith("distributor") for name in file["name"].asstr()[:]]
            buoyancy = 12 * math.pi * (0.8 * 0.4e-3) ** 2 * 1e-3 * 1000 * 9.81
            for time, force in zip(file["time"][:], file["force"][:]):
                if time > 0.5:
                    drops.append(-self.at(time, "bottom.fy") - (force[distributor, 1].sum() - buoyancy))
        for drop in drops:
            self.assert_near(drop, self.buoyant_weight(), 1e-2)

    def rows(self, name: str) -> list[dict[str, float]]:
        with (self.run_folder / name).open(newline="") as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]

    def assert_nothing_is_lost(self, outlet: dict, start: list[dict[str, float]]):
        """Discs that left and discs that are there are those of the start, in number and mass, to the bit."""
        left, there = self.rows("left_bodies.csv"), self.rows("final_bodies.csv")
        self.assertEqual(sorted(row["radius"] for row in left + there), sorted(row["radius"] for row in start))
        for row in left:
            self.assertEqual(row["mass"], 1500 * (math.pi * row["radius"] * row["radius"] * 1e-3))
        self.assertEqual(outlet["count"], len(left))
        self.assertEqual(outlet["mass"], sum((row["mass"] for row in left), 0.0))

    def flow_through(self, x: float) -> float:
        """What passes an upright line of nodes at the end [m²/s]: Simpson's rule is exact for quadratic elements."""
        import h5py

        with h5py.File(self.run_folder / "fields.h5") as file:
            last = file["steps"][sorted(file["steps"])[-1]]
            line = sorted((y, u) for (at, y), u in zip(file["mesh/points"][:, :2], last["velocity"][:, 0]) if abs(at - x) < 1e-9)
        y, u = zip(*line)
        return sum((y[i + 2] - y[i]) / 6 * (u[i] + 4 * u[i + 1] + u[i + 2]) for i in range(0, len(y) - 2, 2))

    def test_percolation_constriction(self):
        """With friction an arch holds what is left at rest and the pressure up; without, none forms and the pressure is low."""
        summary = self.run_scene("percolation_constriction")
        self.assert_near(self.flow_through(4e-3), 8e-3 * 9e-3, 1e-2)
        start = self.rows("inputs/percolation_constriction_packing.csv")
        self.assert_nothing_is_lost(summary["outlets"][0], start)
        held, clogged = summary["grains"][0], self.history()
        self.assertGreaterEqual(held["count"], 40)
        # At rest but for those that have room to turn in the flow that is left.
        self.assertLess(held["kinetic_energy"], 1e-5 * max(clogged["grain.kinetic_energy"]))
        self.assertEqual(clogged["right.count"][-1], self.at(0.52, "right.count"))

        summary = self.run_again("percolation_constriction", "output.fields=false", "materials.0.friction=0", "time.end=1.2")
        self.assert_nothing_is_lost(summary["outlets"][0], start)
        self.assertGreaterEqual(summary["outlets"][0]["count"], 35)
        self.assertGreater(summary["grains"][0]["velocity"][0], 1e-3, "the others are on their way")
        self.assertGreater(-clogged["left.fx"][-1], 5 * max(-force for force in self.history()["left.fx"][-20:]))

    def test_percolation_piping(self):
        """Grains leave one by one, those near the exit first, and what is left resists the flow less."""
        summary = self.run_scene("percolation_piping", "output.fields=false")
        start, left = self.rows("inputs/percolation_piping_packing.csv"), self.rows("left_bodies.csv")
        self.assert_nothing_is_lost(summary["outlets"][0], start)
        self.assertGreaterEqual(len(left), 8)
        weir = summary["grains"][0]["count"]
        place = [start[int(row["body"]) - weir]["x"] for row in left]
        self.assertGreater(statistics.fmean(place[:4]), statistics.fmean(place[4:]) + 1e-3)
        first = start[int(summary["onset"]["body"].removeprefix("grain."))]
        self.assertGreater(first["x"], 0.009, "the first to move is at the exit")

        def resistance(time: float) -> float:
            return -self.at(time, "left.fx") / time  # the flow rises in proportion to time

        self.assertLess(resistance(0.8), resistance(summary["onset"]["time"]) / 3)

    def test_percolation_filtration(self):
        """What is wider than the throats stays, what is narrower passes, and the pressure rises."""
        summary = self.run_scene("percolation_filtration", "time.end=1", "output.fields=false")
        _, coarse, fine = summary["grains"]
        self.assertGreaterEqual(summary["outlets"][0]["count"], 2)
        self.assertEqual(summary["outlets"][0]["count"] + fine["count"], 12)
        self.assertEqual(coarse["count"], 2)
        self.assertLess(coarse["kinetic_energy"], 1e-14)
        self.assertGreater(-statistics.fmean(self.history()["left.fx"][-50:]), -1.3 * self.at(0.16, "left.fx"))

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
