"""What the tests of the scenes of configs/ share: a scene run as a user runs it, and the reading of its results."""

import csv
import json
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class SceneCase(unittest.TestCase):
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

    def at(self, time: float, column: str) -> float:
        """A column of the history at a time, linear between steps."""
        history = self.history()
        step = next(i for i, t in enumerate(history["time"]) if t >= time * (1 - 1e-9))
        before, after = history["time"][step - 1], history["time"][step]
        weight = (time - before) / (after - before)
        return (1 - weight) * history[column][step - 1] + weight * history[column][step]

    def last_bodies(self) -> dict[str, dict]:
        """Position, velocity [m, m/s] and radius [m] of every body at the end."""
        import h5py

        with h5py.File(self.run_folder / "bodies.h5") as file:
            columns = (file["name"].asstr()[:], file["position"][-1], file["velocity"][-1], file["radius"][:])
        return {name: {"position": x, "velocity": v, "radius": r} for name, x, v, r in zip(*columns)}

    def assert_near(self, value: float, expected: float, relative: float):
        self.assertLessEqual(abs(value - expected), relative * abs(expected), f"{value} against {expected}")
