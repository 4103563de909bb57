"""The page of the paper's figures: values and pictures of runs put into its template."""

import json
import os
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from PIL import Image

from launcher.common import Refusal
from launcher.study import paper

SUMMARY = {"coefficients": {"drag": 5.57953, "second.lift": 0.25}, "boundaries": [{"name": "step", "force": [1.5, 2, 0]}]}


class Paper(unittest.TestCase):
    def test_values_are_put_in_by_key_number_and_name(self):
        text = "cd {a:coefficients/drag:.3f}, {a:coefficients/second.lift}, F {a:boundaries/step/force/0:g} {not one}"
        self.assertEqual(paper.fill(text, {"a": SUMMARY}), "cd 5.580, 0.25, F 1.5 {not one}")

    def test_a_value_that_is_not_there_is_refused_by_name(self):
        with self.assertRaises(Refusal) as refused:
            paper.fill("{a:boundaries/wall/force}", {"a": SUMMARY})
        self.assertIn("boundaries/wall/force", str(refused.exception))

    def test_pictures_are_made_small(self):
        noise = np.random.default_rng(1).integers(0, 255, (240, 240, 3), dtype=np.uint8)
        with tempfile.TemporaryDirectory() as folder:
            source, target = Path(folder) / "a.png", Path(folder) / "b" / "a.png"
            Image.fromarray(noise).save(source)
            paper.compress(source, target)
            self.assertLessEqual(target.stat().st_size, paper.LARGEST)

    def test_small_pictures_keep_all_their_colours(self):
        shades = np.arange(3 * 80 * 80, dtype=np.uint32).astype(np.uint8).reshape(80, 80, 3)
        with tempfile.TemporaryDirectory() as folder:
            source, target = Path(folder) / "a.png", Path(folder) / "b.png"
            Image.fromarray(shades).save(source)
            paper.compress(source, target)
            with Image.open(target) as copy:
                np.testing.assert_array_equal(np.asarray(copy.convert("RGB")), shades)


class Runs(unittest.TestCase):
    """A completed run, whose fingerprint is the text of its scene."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.configs, self.run_folder, self.bin = (Path(folder.name) / name for name in ("configs", "run", "bin"))
        for path in (self.configs, self.run_folder, self.bin):
            path.mkdir()
        (self.bin / "coupler").touch()
        os.utime(self.bin / "coupler", (1, 1))
        for path in (self.configs, self.run_folder):
            (path / "scene.toml").write_text("as shipped")
        self.end("completed")
        self.enterContext(mock.patch.dict(os.environ, {"FPI_BIN": str(self.bin)}))
        self.enterContext(mock.patch.object(
            paper.run, "plan", lambda scene, overrides: {"scene_fingerprint": hash(scene.read_text())}))

    def end(self, status: str) -> None:
        (self.run_folder / "summary.json").write_text(json.dumps({"status": status}))

    def assert_up_to_date(self, expected: bool):
        self.assertEqual(paper.is_up_to_date(self.run_folder, self.configs / "scene.toml"), expected)

    def test_a_run_of_the_same_is_kept(self):
        self.assert_up_to_date(True)

    def test_a_run_of_another_scene_is_not(self):
        (self.configs / "scene.toml").write_text("changed since")
        self.assert_up_to_date(False)

    def test_a_run_of_older_programs_is_not(self):
        os.utime(self.bin / "coupler")
        os.utime(self.run_folder / "scene.toml", (2, 2))
        self.assert_up_to_date(False)

    def test_a_run_that_did_not_reach_its_end_is_not(self):
        self.end("failed")
        self.assert_up_to_date(False)
        (self.run_folder / "summary.json").unlink()
        self.assert_up_to_date(False)


if __name__ == "__main__":
    unittest.main()
