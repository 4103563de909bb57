"""Pictures of many grains, from a run folder made by hand."""

import struct
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from launcher.plots import granular, plot, results, stl

COUNT = 20
SCENE = '''gravity = [0, 0, -9.81]
[[walls]]
name = "floor"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 2]
[[walls]]
name = "front"
shape = "plane"
point = [0, 0, 0]
normal = [0, 1, 0]
'''


def write_run(run: Path, times: int) -> None:
    """Spheres in a row that rise, the last fastest."""
    (run / "scene.toml").write_text(SCENE)
    with h5py.File(run / "bodies.h5", "w") as file:
        file["name"], file["radius"] = [f"sand.{i}" for i in range(COUNT)], np.full(COUNT, 0.1)
        file["time"] = 0.1 * np.arange(times)
        place = np.zeros((times, COUNT, 3))
        place[:, :, 0] = np.arange(COUNT)
        place[:, :, 1] = np.arange(COUNT)[::-1]
        place[:, :, 2] = np.arange(times)[:, None]
        file["position"] = place
        file["velocity"] = place
        for name in ("rotation", "spin", "force", "torque"):
            file[name] = np.zeros((times, COUNT, 3))


class Granular(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.run_folder = Path(folder.name)

    def test_many_grains_are_drawn_coloured_instead_of_their_paths(self):
        write_run(self.run_folder, times=3)
        self.assertEqual([path.name for path in plot.draw(self.run_folder)], ["grains.png"])

    def test_grains_that_left_are_not_drawn_and_spoil_no_scale(self):
        write_run(self.run_folder, times=3)
        with h5py.File(self.run_folder / "bodies.h5", "r+") as file:
            for name in ("position", "velocity"):
                file[name][1:, 4] = np.nan
        bodies, scene = results.read_bodies(self.run_folder), results.read_scene(self.run_folder)
        view = granular.View(bodies, scene)
        self.assertTrue(np.isfinite([view.fastest, *view.lower, *view.upper]).all())
        self.assertEqual(np.ma.count_masked(view.places(0)), 0)
        self.assertEqual(np.ma.count_masked(view.places(2)[:, 0]), 1)
        self.assertEqual([path.name for path in plot.draw(self.run_folder)], ["grains.png"])

    def test_spheres_are_seen_from_the_side_nearest_on_top(self):
        write_run(self.run_folder, times=1)
        view = granular.View(results.read_bodies(self.run_folder), results.read_scene(self.run_folder))
        self.assertEqual(view.axes, (0, 2))
        self.assertEqual(list(view.order), list(range(COUNT)), "from the largest y to the smallest")

    def test_only_walls_seen_edge_on_are_lines(self):
        write_run(self.run_folder, times=1)
        view = granular.View(results.read_bodies(self.run_folder), results.read_scene(self.run_folder))
        floor, front = (view.lines(wall) for wall in view.scene.walls)
        self.assertEqual(front, [])
        start, end = floor[0]
        self.assertEqual((start[1], end[1]), (0, 0))
        self.assertLess(min(start[0], end[0]), 0)
        self.assertGreater(max(start[0], end[0]), COUNT - 1)

    def test_round_walls_polylines_and_triangles_are_lines_too(self):
        write_run(self.run_folder, times=1)
        (self.run_folder / "a.stl").write_text("solid\nvertex 0 0 1\nvertex 2 0 1\nvertex 0 2 3\nendsolid\n")
        view = granular.View(results.read_bodies(self.run_folder), results.read_scene(self.run_folder))
        arc = view.lines({"shape": "arc", "centre": [1, 0], "radius": 2, "start": 0, "end": np.pi / 2})[0]
        np.testing.assert_allclose(arc[[0, -1]], [[3, 0], [1, 2]], atol=1e-15)
        square = view.lines({"shape": "polyline", "vertices": [0, 0, 1, 0, 1, 1], "closed": True})[0]
        np.testing.assert_array_equal(square, [[0, 0], [1, 0], [1, 1], [0, 0]])
        triangle = view.lines({"shape": "mesh", "file": "a.stl", "scale": 0.5})[0]
        np.testing.assert_array_equal(triangle, [[0, 0.5], [1, 0.5], [0, 1.5], [0, 0.5]])

    def test_triangles_of_text_and_of_binary_files_are_the_same(self):
        corners = [[[0, 0, 0.5], [1, 0, 0.5], [1, 1, 0.5]], [[0, 0, 0.5], [1, 1, 0.5], [0, 1, 0.5]]]
        text = "".join(f"vertex {x} {y} {z}\n" for triangle in corners for x, y, z in triangle)
        binary = b"solid".ljust(80) + struct.pack("<I", 2)
        binary += b"".join(struct.pack("<12fH", 0, 0, 1, *np.ravel(triangle), 0) for triangle in corners)
        path = self.run_folder / "a.stl"
        for content in (f"solid\n{text}endsolid\n".encode(), f"solid\n{text}endsolid\n".upper().encode(), binary,
                        binary + b"a tail of bytes", binary.replace(b"solid", bytes(5)) + b"a tail of bytes"):
            path.write_bytes(content)
            np.testing.assert_array_equal(stl.read(path), corners)


if __name__ == "__main__":
    unittest.main()
