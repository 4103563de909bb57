"""Movies of runs made by hand: of grains, and of a flow around its bodies."""

import shutil
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import granular_test
import numpy as np
import plot_test

from launcher.common import Refusal
from launcher.plots import movie, plot, results


class Movie(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.run_folder = Path(folder.name)

    def test_it_is_a_gif_where_ffmpeg_is_missing(self):
        granular_test.write_run(self.run_folder, times=3)
        with mock.patch("shutil.which", return_value=None):
            path = plot.draw(self.run_folder, moving=True)[-1]
        self.assertEqual(path.name, "grains.gif")
        self.assertEqual(path.read_bytes()[:4], b"GIF8")

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_it_is_an_mp4_where_there_is_ffmpeg(self):
        granular_test.write_run(self.run_folder, times=3)
        path = movie.make(None, results.read_bodies(self.run_folder), results.read_scene(self.run_folder), self.run_folder)
        self.assertEqual(path.name, "grains.mp4")
        self.assertEqual(path.read_bytes()[4:8], b"ftyp")

    def test_of_one_time_it_is_refused(self):
        granular_test.write_run(self.run_folder, times=1)
        with self.assertRaises(Refusal):
            plot.draw(self.run_folder, moving=True)

    def test_a_flow_is_shown_by_the_speed_of_the_fluid_under_the_bodies(self):
        plot_test.write_run(self.run_folder)
        fields, bodies = results.read_fields(self.run_folder), results.read_bodies(self.run_folder)
        figure, times, show = movie.of_flow(fields, bodies, results.read_scene(self.run_folder))
        np.testing.assert_allclose(times, [0, 0.1, 0.2])
        for time in times:
            (speed,) = show(time)
            np.testing.assert_allclose(speed.get_array(), 10 * time * np.linalg.norm(plot_test.POINTS, axis=1))
            self.assertEqual(len(figure.axes[0].collections), 2, "the map of the frame and the bodies, none of the last frame")
        fields.file.close()

    def test_a_flow_that_was_written_at_its_ends_only_leaves_the_grains(self):
        plot_test.write_run(self.run_folder)
        fields, bodies = results.read_fields(self.run_folder), results.read_bodies(self.run_folder)
        fields.steps = fields.steps[::2]
        with mock.patch.object(movie, "of_flow", side_effect=AssertionError):
            movie.make(fields, bodies, results.read_scene(self.run_folder), self.run_folder)
        fields.file.close()


if __name__ == "__main__":
    unittest.main()
