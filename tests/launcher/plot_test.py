"""Reading results and drawing them, on a run folder made by hand."""

import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from launcher import plot, results
from launcher.common import Refusal

POINTS = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0], [1, 0.5], [0.5, 0.5], [0.5, 1], [0, 0.5]], float)
CELLS = np.array([[0, 1, 2, 4, 5, 6], [0, 2, 3, 6, 7, 8]], np.uint32)


def write_run(run: Path) -> None:
    """Two triangles, three times, a disc that falls."""
    with h5py.File(run / "fields.h5", "w") as file:
        file["mesh/points"], file["mesh/cells"] = POINTS, CELLS
        for i in range(3):
            group = file.create_group(f"steps/{i:06d}")
            group.attrs["time"] = 0.1 * i
            group["velocity"], group["pressure"] = i * POINTS, POINTS[:, 0] - 0.5
            group["active"] = np.array([1.0, 0.0])
    with h5py.File(run / "bodies.h5", "w") as file:
        file["name"], file["radius"] = ["disc"], np.array([0.2])
        file["time"] = np.array([0.1, 0.2])
        file["position"] = np.array([[[0.5, 0.6, 0]], [[0.5, 0.5, 0]]])
        for name in ("velocity", "spin", "force", "torque"):
            file[name] = np.zeros((2, 1, 3))
    with h5py.File(run / "interface.h5", "w") as file:
        for i, size in enumerate((2.0, 1.0)):
            group = file.create_group(f"steps/{i:06d}")
            group.attrs["time"] = 0.1 * (i + 1)
            group["body"], group["start"] = np.zeros(2, int), np.array([0, np.pi])
            group["end"], group["traction"] = np.array([np.pi, 2 * np.pi]), size * np.eye(2)
            group["centre"] = np.array([[0.5, 0.6]])
    (run / "history.csv").write_text("time,step,sub_iterations,residual_velocity,residual_force,newton_iterations,"
                                     "disc.fx,disc.fy,drag,front\n0.1,1,3,1e-6,1e-7,4,1,2,5.5,0.1\n"
                                     "0.2,2,2,1e-6,0,4,1,2,5.6,0.2\n")


class Plot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.run_folder = Path(folder.name)

    def test_everything_that_is_there_is_drawn(self):
        write_run(self.run_folder)
        pictures = plot.draw(self.run_folder)
        self.assertEqual([path.name for path in pictures],
                         ["speed.png", "pressure.png", "traction.png", "trajectories.png", "history.png"])
        for path in pictures:
            self.assertEqual(path.read_bytes()[:4], b"\x89PNG", path)

    def test_what_is_absent_is_left_out(self):
        write_run(self.run_folder)
        for name in ("fields.h5", "interface.h5", "bodies.h5"):
            (self.run_folder / name).unlink()
        self.assertEqual([path.name for path in plot.draw(self.run_folder)], ["history.png"])

    def test_an_empty_or_missing_folder_is_refused(self):
        for folder, word in ((self.run_folder, "no results to draw"), (self.run_folder / "none", "there is no")):
            with self.assertRaises(Refusal) as refused:
                plot.draw(folder)
            self.assertIn(word, str(refused.exception))

    def test_quadratic_triangles_become_four_that_cover_them(self):
        write_run(self.run_folder)
        fields = results.read_fields(self.run_folder)
        corners = fields.points[fields.triangles]
        a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        np.testing.assert_allclose(0.5 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), np.full(8, 1 / 8))
        fields.file.close()

    def test_cells_inside_bodies_are_hidden(self):
        write_run(self.run_folder)
        fields = results.read_fields(self.run_folder)
        shown = plot.visible(fields, fields.snapshot(2)).get_masked_triangles()
        self.assertEqual(len(shown), 4)
        fields.file.close()

    def test_the_strongest_tractions_are_chosen(self):
        write_run(self.run_folder)
        self.assertEqual(results.read_strongest_tractions(self.run_folder).time, 0.1)


if __name__ == "__main__":
    unittest.main()
