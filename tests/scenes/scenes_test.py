#!/usr/bin/python3
"""The scenes of configs/, run as a user runs them, against the values that each of them cites."""

import csv
import json
import math
import shutil
import statistics
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

DRAG, LIFT, PRESSURE = 5.57953523384, 0.010618948146, 0.11752016697  # Schäfer & Turek, case 2D-1

FIRST_HALF_SECOND = "time.step=0.025", "time.end=0.5", "output.measure_from=0", "output.fields=false"
TORQUE = -4 * math.pi / 3  # on the inner cylinder, 4πμΩ r1² r2²/(r2² - r1²)


def dot(a: list[float], b: list[float]) -> float:
    return sum(x * y for x, y in zip(a, b))


class Scenes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.run_folder = Path(folder.name) / "run"

    def run_scene(self, name: str, *overrides: str) -> dict:
        """Runs a scene to its end; returns its summary."""
        sets = [word for override in overrides for word in ("--set", override)]
        command = [str(ROOT / "fpi"), "run", name, "--out", str(self.run_folder), "--json", *sets]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def run_again(self, name: str, *overrides: str) -> dict:
        shutil.rmtree(self.run_folder)
        return self.run_scene(name, *overrides)

    def history(self) -> dict[str, list[float]]:
        with (self.run_folder / "history.csv").open(newline="") as file:
            header, *rows = csv.reader(file)
        return {name: [float(row[i]) for row in rows] for i, name in enumerate(header)}

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

    def assert_near(self, value: float, expected: float, relative: float):
        self.assertLessEqual(abs(value - expected), relative * abs(expected), f"{value} against {expected}")

    def test_cavity(self):
        probes = self.run_scene("cavity")["probes"]
        self.assert_near(probes["centre_u"], -0.20519, 1e-4)
        self.assert_near(probes["centre_v"], 6.37e-4, 5e-3)
        self.assert_near(probes["corner_pressure"], 345, 1e-2)

    def test_cylinder_steady(self):
        summary = self.run_scene("cylinder_steady")
        self.assertLess(summary["unknowns"], 20_000)
        self.assert_near(summary["coefficients"]["drag"], DRAG, 1e-4)
        self.assertLess(abs(summary["coefficients"]["lift"] - LIFT), 2e-4)
        self.assert_near(summary["probes"]["pressure_difference"], PRESSURE, 1.5e-2)
        self.assertFalse((self.run_folder / "dem_server.log").exists(), "nothing moves: no dem_server")

    def test_cylinder_fitted(self):
        summary = self.run_scene("cylinder_fitted")
        self.assertLess(summary["unknowns"], 9_000)
        self.assert_near(summary["coefficients"]["drag"], DRAG, 1e-4)
        self.assertLess(abs(summary["coefficients"]["lift"] - LIFT), 2e-4)
        self.assert_near(summary["probes"]["pressure_difference"], PRESSURE, 1e-3)

    def test_step_channel_fitted(self):
        """No reference is at hand: 3.5125, 3.5325 and 3.5392 on meshes of size 1, 0.5 and 0.3, extrapolated."""
        coefficients = self.run_scene("step_channel_fitted")["coefficients"]
        self.assert_near(coefficients["drag"], 3.55, 1.5e-2)

    def test_cylinder_shedding_starts(self):
        """Half a second of rising inflow in both meshes: the same drag, without ringing from step to step."""
        drag = []
        for scene in ("cylinder_shedding_fitted", "cylinder_shedding"):
            self.run_scene(scene, *FIRST_HALF_SECOND)
            drag.append(self.history()["drag"])
            self.assertLess(max(abs(a - 2 * b + c) for a, b, c in zip(drag[-1][3:], drag[-1][4:], drag[-1][5:])), 0.1)
            shutil.rmtree(self.run_folder)
        self.assert_near(drag[0][-1], drag[1][-1], 1e-2)

    def test_cylinder_shedding_fitted(self):
        self.assert_sheds("cylinder_shedding_fitted")

    def test_cylinder_shedding(self):
        self.assert_sheds("cylinder_shedding")

    def assert_sheds(self, scene: str):
        """Five settled periods or more against FeatFlow's finest series."""
        signals = self.run_scene(scene, "output.fields=false")["signals"]
        drag, lift = signals["drag"], signals["lift"]
        self.assertTrue(lift["settled"])
        self.assert_near(drag["max"], 3.227393, 1e-3)
        self.assert_near(drag["min"], 3.164263, 1e-3)
        self.assert_near(lift["max"] - lift["min"], 2.007871, 2e-3)
        self.assert_near(lift["strouhal"], 0.301841, 3e-3)

    def test_cylinder_pulse(self):
        """On a finer mesh with half the step: the scene's own give drag, but lift to a fifth only."""
        mesh = self.run_folder.parent / "cylinder.msh"
        subprocess.run([str(ROOT / "fpi"), "mesh", "cylinder", "--size", "0.6", "--out", str(mesh)], check=True)
        summary = self.run_scene("cylinder_pulse", f"fluid.mesh.file={mesh}", "time.step=0.005", "output.fields=false")
        drag, lift = summary["signals"]["drag"], summary["signals"]["lift"]
        self.assert_near(drag["max"], 2.950921575, 1e-3)
        self.assert_near(drag["max_time"], 3.93625, 3e-3)
        self.assert_near(lift["max"], 0.47795, 5e-3)
        self.assert_near(lift["max_time"], 5.693125, 3e-3)
        self.assert_near(summary["probes"]["pressure_difference"], -0.1116, 1e-2)

    def test_cylinder_pulse_embedded(self):
        summary = self.run_scene("cylinder_pulse_embedded", "output.fields=false")
        drag, lift = summary["signals"]["drag"], summary["signals"]["lift"]
        self.assert_near(drag["max"], 2.950921575, 1e-3)
        self.assert_near(drag["max_time"], 3.93625, 3e-3)
        self.assert_near(lift["max"], 0.47795, 1.5e-2)
        self.assert_near(lift["max_time"], 5.693125, 3e-3)

    def test_two_cylinders_start(self):
        """Half a second of rising inflow: both meshes agree, and the second cylinder, in the lee, drags less."""
        drag = []
        for scene in ("two_cylinders_fitted", "two_cylinders"):
            self.run_scene(scene, *FIRST_HALF_SECOND)
            drag.append([self.history()[f"{name}.drag"][-1] for name in ("first", "second")])
            shutil.rmtree(self.run_folder)
        for fitted, embedded in zip(*drag):
            self.assert_near(fitted, embedded, 1e-2)
        self.assertLess(drag[0][1], drag[0][0])

    def test_cavity_100(self):
        self.assert_cavity("cavity_100", -0.2140417, 0.1795728, -0.2538030, 3e-4)

    def test_cavity_1000(self):
        self.assert_cavity("cavity_1000", -0.3885698, 0.3769447, -0.5270771, 1e-4)

    def assert_cavity(self, scene: str, u_min: float, v_max: float, v_min: float, absolute: float):
        profiles = self.run_scene(scene)["profiles"]
        found = profiles["upright"]["min"], profiles["level"]["max"], profiles["level"]["min"]
        for value, expected in zip(found, (u_min, v_max, v_min)):
            self.assertLess(abs(value - expected), absolute)

    def test_kovasznay(self):
        errors = self.run_scene("kovasznay")["errors"]
        finer = self.run_again("kovasznay", "fluid.mesh.cells_x=48", "fluid.mesh.cells_y=32")["errors"]
        self.assertGreater(errors["velocity_l2"] / finer["velocity_l2"], 2**2.8)
        self.assertGreater(errors["velocity_h1"] / finer["velocity_h1"], 2**1.8)
        self.assertGreater(errors["pressure_l2"] / finer["pressure_l2"], 2**1.8)

    def test_taylor_green(self):
        errors = self.run_scene("taylor_green", "fluid.mesh.cells_x=16", "fluid.mesh.cells_y=16")["errors"]
        finer = self.run_again("taylor_green")["errors"]
        self.assertGreater(errors["velocity_l2"] / finer["velocity_l2"], 2**2.7)
        self.assertGreater(errors["pressure_l2"] / finer["pressure_l2"], 2**1.7)

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

    def test_taylor_couette(self):
        summary = self.run_scene("taylor_couette")
        self.assert_near(summary["bodies"][0]["torque"][2], TORQUE, 1e-4)
        self.assertLess(summary["errors"]["velocity_l2"], 1e-4)

    def test_taylor_couette_refined(self):
        """Small triangles around the disc only: the torque as exact as asked of small ones everywhere, at half the cost."""
        everywhere = self.run_scene("taylor_couette")["unknowns"]
        summary = self.run_again("taylor_couette", "fluid.mesh.cells_x=8", "fluid.mesh.cells_y=8",
                                 "fluid.mesh.elements_per_diameter=16")
        self.assertLess(summary["unknowns"], 0.55 * everywhere)
        self.assert_near(summary["bodies"][0]["torque"][2], TORQUE, 1e-4)

    def test_taylor_couette_fitted(self):
        summary = self.run_scene("taylor_couette_fitted")
        inner = next(one for one in summary["boundaries"] if one["name"] == "inner")
        self.assert_near(inner["torque"][2], TORQUE, 1e-4)
        self.assertLess(summary["errors"]["velocity_l2"], 1e-4)

    def second_half_mean(self, column: str) -> float:
        values = self.history()[column]
        half = values[len(values) // 2:]
        return sum(half) / len(half)

    def test_step_embedded(self):
        """Against a mesh that fits the step."""
        self.assert_near(self.run_scene("step_embedded")["coefficients"]["drag"], 3.55, 5e-3)

    def test_rotating_blade(self):
        self.run_scene("rotating_blade")
        self.assert_near(self.second_half_mean("blade.fx"), 0.665, 3e-2)
        self.assert_near(self.second_half_mean("blade.torque"), -0.0232, 3e-2)

    def test_drill(self):
        self.run_scene("drill")
        self.assert_near(self.second_half_mean("drill.fy"), 0.732, 2e-2)
        self.assert_near(self.second_half_mean("drill.torque"), -0.0203, 2e-2)

    def noise(self, columns: tuple[str, ...], start: float) -> float:
        """The largest distance of the force from the cubic through its two neighbours on both sides, over the largest."""
        history = self.history()
        first = next(i for i, t in enumerate(history["time"]) if t >= start)
        force = [[history[name][i] for name in columns] for i in range(first, len(history["time"]))]
        jumps = [math.dist([0] * len(columns), [e - (4 * (d + f) - c - g) / 6 for c, d, e, f, g in zip(*five)])
                 for five in zip(force, force[1:], force[2:], force[3:], force[4:])]
        return max(jumps) / max(math.hypot(*one) for one in force)

    def test_oscillating_cylinder(self):
        """The last of three periods, by Morison's formula; the box is smaller than the experiment's."""
        self.run_scene("oscillating_cylinder", "output.fields=false")
        history, omega = self.history(), 2 * math.pi * 0.2
        last = [i for i, t in enumerate(history["time"]) if t > 10]
        force = [history["cylinder.fx"][i] for i in last]
        drag = [-0.5 * abs(history["cylinder.vx"][i]) * history["cylinder.vx"][i] for i in last]
        inertia = [0.25 * math.pi * omega * math.cos(omega * history["time"][i]) for i in last]
        # Over a period the two shapes are orthogonal, so that each has its own least squares.
        cd = dot(drag, force) / dot(drag, drag)
        ci = dot(inertia, force) / dot(inertia, inertia)
        self.assert_near(cd, 2.09, 5e-2)
        self.assert_near(ci, 1.45, 5e-2)

    def test_swinging_cylinder(self):
        self.run_scene("swinging_cylinder", "output.fields=false")
        self.assertLess(self.noise(("cylinder.fx", "cylinder.fy"), 2), 5e-2)

    def test_dry_grains(self):
        bodies = {body["name"]: body for body in self.run_scene("dry_grains")["bodies"]}
        self.assertFalse((self.run_folder / "fluid_server.log").exists(), "dry: no fluid_server")
        for body in bodies.values():
            self.assertLess(max(map(abs, body["velocity"])), 1e-6, body["name"])
        overlap = {name: 0.01 - bodies[name]["position"][1] for name in ("a", "b", "e")}
        resting = [gap for gap in overlap.values() if gap > 0]
        self.assertTrue(resting, "at least one of the discs of radius 0.01 m lies on the floor")
        self.assertLess(max(resting), 0.01 * 0.01)

    def last_bodies(self) -> dict[str, dict]:
        """Position, velocity [m, m/s] and radius [m] of every body at the end."""
        import h5py

        with h5py.File(self.run_folder / "bodies.h5") as file:
            columns = (file["name"].asstr()[:], file["position"][-1], file["velocity"][-1], file["radius"][:])
        return {name: {"position": x, "velocity": v, "radius": r} for name, x, v, r in zip(*columns)}

    def test_newtons_cradle(self):
        self.run_scene("newtons_cradle")
        speed = {name: body["velocity"][0] for name, body in self.last_bodies().items()}
        for name in ("first_apart", "apart.0", "apart.1", "apart.2"):
            self.assertLess(abs(speed[name]), 1e-4, name)
        self.assert_near(speed["apart.3"], 1, 1e-4)
        chain = [speed["first_touching"], *(speed[f"touching.{i}"] for i in range(4))]
        for found, expected in zip(chain, (-0.07109, -0.03027, -0.01446, 0.12704, 0.98878)):
            self.assertLess(abs(found - expected), 5e-4)
        self.assert_near(sum(chain), 1, 1e-12)

    def test_oblique_impacts(self):
        found = {body["name"]: body for body in self.run_scene("oblique_impacts")["bodies"]}
        # The row of 10 degrees, 0.687 and 213 rad/s, is missed: docs/grains.md.
        table = {5: (0.948, 19), 20: (0.616, 511), 30: (0.684, 617), 40: (0.781, 545),
                 50: (0.845, 457), 60: (0.893, 357), 80: (0.966, 126)}
        for angle, (tangential, spin) in table.items():
            body, incoming = found[f"at_{angle}"], 3.9 * math.sin(math.radians(angle))
            self.assert_near(body["velocity"][0] / incoming, tangential, 0.02)
            self.assertLess(abs(body["spin"][1] - spin), max(5, 0.02 * spin), angle)
            self.assert_near(body["velocity"][2], 0.98 * 3.9 * math.cos(math.radians(angle)), 1e-3)

    def run_out(self, *overrides: str) -> float:
        """Of a collapsed column over its width: as far as 97 % of its grains lie. The farthest ones roll off by themselves,
        and where the first gap of the front opens is chance: over seeds it varies by a tenth, this by a twentieth."""
        summary = self.run_scene("column_collapse", *overrides)
        self.assertLess(abs(summary["grains"][0]["velocity"][1]), 1e-3, "the heap falls no more; some grains still roll")
        ends = sorted(body["position"][0] + body["radius"] for name, body in self.last_bodies().items()
                      if name.startswith("sand"))
        return (ends[int(0.97 * len(ends))] - 0.06) / 0.06

    def test_column_collapse(self):
        low = self.run_out("grains.0.upper.1=0.04")
        shutil.rmtree(self.run_folder)
        high = self.run_out()
        self.assertGreater(high, 1.2 * 1.03, "sand, which rolls less, goes less far")
        self.assertLess(high, 3.2 * 1.03)
        self.assert_near(high / low, 0.07 / 0.04, 0.2)

    def slope(self) -> float:
        """Angle [degrees] of the surface of what stayed on the ledge."""
        tops: dict[int, float] = {}
        for name, body in self.last_bodies().items():
            x, y = body["position"][:2]
            if name.startswith("sand") and y > 0 and 0.01 < x < 0.08:
                strip = int(x / 0.005)
                tops[strip] = max(tops.get(strip, 0), y)
        mean, height = sum(tops) / len(tops), sum(tops.values()) / len(tops)
        rise = sum((s - mean) * (y - height) for s, y in tops.items()) / sum((s - mean)**2 for s in tops)
        return -math.degrees(math.atan(rise / 0.005))

    def test_angle_of_repose(self):
        summary = self.run_scene("angle_of_repose")
        self.assertLess(summary["grains"][1]["kinetic_energy"], 1e-9)
        rolling = self.slope()
        self.run_again("angle_of_repose", "materials.0.rolling_friction=0")
        self.assertTrue(15 < rolling < 35, rolling)
        self.assertLess(self.slope(), rolling - 2)

    def masses_below(self, height: float) -> tuple[list[float], list[float]]:
        """Times, and the mass [kg] of discs below a height then."""
        import h5py

        with h5py.File(self.run_folder / "bodies.h5") as file:
            mass = 2500 * 0.01 * math.pi * file["radius"][:] ** 2
            return list(file["time"][:]), list((file["position"][:, :, 1] < height) @ mass)

    def test_hopper(self):
        self.run_scene("hopper")
        time, out = self.masses_below(0)
        start, end = (next(i for i, mass in enumerate(out) if mass > share * 0.15) for share in (0.2, 0.6))
        rate = (out[end] - out[start]) / (time[end] - time[start])
        self.assert_near(rate, 0.75 * 0.83 * 2500 * 0.01 * math.sqrt(9.81) * 0.03**1.5, 0.25)

    def test_rotating_drum(self):
        """The angle of the line from the axis to the centre of mass, which is that of the surface."""
        import h5py

        self.run_scene("rotating_drum")
        with h5py.File(self.run_folder / "bodies.h5") as file:
            late = file["time"][:] > 1
            mass, places = file["radius"][:] ** 2, file["position"][:][late]
            self.assertLess(float(((places**2).sum(axis=2) ** 0.5 + file["radius"][:]).max()), 0.0603, "all in the drum")
            centres = [sum(mass[:, None] * at[:, :2]) / sum(mass) for at in places]
        angles = [math.degrees(math.atan2(-x, -y)) for x, y in centres]
        self.assertTrue(20 < sum(angles) / len(angles) < 38, sum(angles) / len(angles))
        self.assertLess(max(angles), 45)

    def test_settling_disc_starts(self):
        """A coarse mesh and the first twenty steps: straight down, slower than added mass alone would let it fall."""
        summary = self.run_scene("settling_disc", "fluid.mesh.cell_size=6.25e-4", "time.end=0.03")
        disc = summary["bodies"][0]
        inviscid = 9.81 * (1250 - 1000) / (1250 + 1000) * 0.03
        self.assertLess(-inviscid, disc["velocity"][1])
        self.assertLess(disc["velocity"][1], -0.4 * inviscid)
        self.assertLess(abs(disc["position"][0] - 0.01), 1e-6)

    def at(self, time: float, column: str) -> float:
        """A column of the history at a time, linear between steps."""
        history = self.history()
        step = next(i for i, t in enumerate(history["time"]) if t >= time * (1 - 1e-9))
        before, after = history["time"][step - 1], history["time"][step]
        weight = (time - before) / (after - before)
        return (1 - weight) * history[column][step - 1] + weight * history[column][step]

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
