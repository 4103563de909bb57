"""The page of the paper's figures: values and pictures of runs put into its template."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
from PIL import Image

from launcher import paper
from launcher.common import Refusal

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
        noise = np.random.default_rng(1).integers(0, 255, (420, 420, 3), dtype=np.uint8)
        with tempfile.TemporaryDirectory() as folder:
            source, target = Path(folder) / "a.png", Path(folder) / "b" / "a.png"
            Image.fromarray(noise).save(source)
            paper.compress(source, target)
            self.assertLessEqual(target.stat().st_size, paper.LARGEST)


if __name__ == "__main__":
    unittest.main()
