"""Reading results and drawing them, on a run folder made by hand."""

import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from launcher.common import Refusal
from launcher.plots import charts, maps, obstacles, plot, results

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
        for name in ("rotation", "velocity", "spin", "force", "torque"):
            file[name] = np.zeros((2, 1, 3))
    with h5py.File(run / "interface.h5", "w") as file:
        for i, size in enumerate((2.0, 1.0)):
            group = file.create_group(f"steps/{i:06d}")
            group.attrs["time"] = 0.1 * (i + 1)
            group["body"], group["middle"] = np.zeros(2, int), np.array([[0.5, 0.8], [0.5, 0.4]])
            group["traction"] = size * np.eye(2)
    write_curves(run / "boundaries.h5", "traction", lines=np.array([[0, 1, 4]]), values=np.ones((len(POINTS), 2)))
    write_curves(run / "profiles.h5", "value", lines=None, values=POINTS[:, 0])
    (run / "history.csv").write_text("time,step,sub_iterations,residual_velocity,residual_force,newton_iterations,"
                                     "disc.fx,disc.fy,drag,front\n0.1,1,3,1e-6,1e-7,4,1,2,5.5,0.1\n"
                                     "0.2,2,2,1e-6,0,4,1,2,5.6,0.2\n")


def write_curves(path: Path, quantity: str, lines, values) -> None:
    """One curve, "wall", through all points, at two times."""
    with h5py.File(path, "w") as file:
        for i in range(2):
            group = file.create_group(f"steps/{i:06d}")
            group.attrs["time"] = 0.1 * (i + 1)
            group["wall/points"] = np.hstack([POINTS, np.zeros((len(POINTS), 1))])
            group[f"wall/{quantity}"] = (i + 1) * values
            if lines is not None:
                group["wall/lines"] = lines


class Plot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.run_folder = Path(folder.name)

    def test_everything_that_is_there_is_drawn(self):
        write_run(self.run_folder)
        pictures = plot.draw(self.run_folder)
        self.assertEqual([path.name for path in pictures],
                         ["speed.png", "pressure.png", "pressure_surface.png", "streamlines.png", "close_up.png",
                          "traction.png", "boundary_traction.png", "profiles.png", "trajectories.png", "history.png"])
        for path in pictures:
            self.assertEqual(path.read_bytes()[:4], b"\x89PNG", path)

    def test_what_is_absent_is_left_out(self):
        write_run(self.run_folder)
        for name in ("fields.h5", "interface.h5", "bodies.h5", "boundaries.h5", "profiles.h5"):
            (self.run_folder / name).unlink()
        self.assertEqual([path.name for path in plot.draw(self.run_folder)], ["history.png"])

    def test_what_percolates_has_its_picture(self):
        (self.run_folder / "sections.csv").write_text("x,porosity,pressure,superficial_velocity\n0.5,1,2,0.1\n1.5,0.6,1,0.1\n")
        (self.run_folder / "velocities.csv").write_text("from,to,share\n-0.1,0,0.2\n0,0.3,0.8\n")
        (self.run_folder / "grains.csv").write_text("body,x,y,radius,drag,lift,torque\n0,1,0.5,0.2,3,0,0\n")
        self.assertEqual([path.name for path in plot.draw(self.run_folder)], ["percolation.png"])

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
        shown = maps.visible(fields, fields.snapshot(2)).get_masked_triangles()
        self.assertEqual(len(shown), 4)
        fields.file.close()

    def test_arrows_stand_in_the_moving_fluid_outside_bodies(self):
        write_run(self.run_folder)
        fields, bodies = results.read_fields(self.run_folder), results.read_bodies(self.run_folder)
        at, velocity, spacing = maps.sampled_velocity(fields, fields.snapshot(2), bodies)
        np.testing.assert_allclose(velocity, 2 * at, atol=1e-12)
        self.assertTrue((np.linalg.norm(at - [0.5, 0.5], axis=1) > 0.2).all())
        self.assertTrue((at[:, 1] <= at[:, 0] + 1e-12).all(), "the upper triangle is inactive")
        self.assertGreater(len(at), 60)
        self.assertAlmostEqual(spacing, 1 / np.sqrt(maps.ARROWS))
        fields.file.close()

    def test_the_mean_is_that_of_the_visible_area(self):
        write_run(self.run_folder)
        fields = results.read_fields(self.run_folder)
        triangles = maps.visible(fields, fields.snapshot(2))
        self.assertAlmostEqual(maps.mean(triangles, POINTS[:, 0]), 2 / 3)  # centroid of the lower triangle
        fields.file.close()

    def test_singular_corners_do_not_take_the_colours(self):
        self.assertLessEqual(maps.limits(np.array([*np.linspace(0, 1, 101), 1e6]), 1.0)[1], 1.0)

    def test_the_scene_tells_how_to_draw(self):
        self.assertEqual(results.read_scene(self.run_folder), results.Scene())
        path = self.run_folder / "scene.toml"
        path.write_text('gravity = [0, -9.81]\ntime.steady = true\n[fluid.mesh]\nlower = [0, 0]\nupper = [2, 1]\n'
                        '[fluid.boundaries]\nleft.type = "velocity"\n')
        scene = results.read_scene(self.run_folder)
        self.assertEqual(scene, results.Scene(steady=True, heavy=True, closed=True, box=([0, 0], [2, 1]),
                                              folder=self.run_folder))
        self.assertEqual(scene.when(0.0), "steady")
        path.write_text('gravity = [0, 0]\n[fluid.boundaries]\nleft.type = "traction"\n')
        self.assertEqual(results.read_scene(self.run_folder), results.Scene(folder=self.run_folder))

    def test_panels_without_a_value_are_left_out(self):
        zero, one = np.zeros(2), np.ones(2)
        history = {"time": one, "a.fx": zero, "a.fy": one, "lift": zero, "b.drag": one, "c.drag": one, "front": np.full(2, np.nan),
                   "sub_iterations": one, "newton_iterations": zero, "residual_velocity": zero,
                   "energy.kinetic": one, "energy.loads": zero}
        self.assertEqual(charts.panels(history), [("drag coefficient", ["b.drag", "c.drag"], False), ("force [N]", ["a.fy"], False),
                                                  ("energy [J]", ["energy.kinetic"], False),
                                                  ("iterations a step", ["sub_iterations"], False)])

    def test_damaged_files_are_refused_with_a_sentence(self):
        write_run(self.run_folder)
        # in the reverse of the order they are read in, so that each is the first to be found damaged
        for name, damage in (("profiles.h5", b"x"), ("boundaries.h5", b"x"), ("history.csv", b""), ("history.csv", b"time,x\n0.1,oops\n"), ("history.csv", b"\xff\x00"),
                             ("interface.h5", b"x"), ("bodies.h5", b"x"), ("fields.h5", b"x"), ("scene.toml", b"= 1")):
            (self.run_folder / name).write_bytes(damage)
            with self.assertRaises(Refusal) as refused:
                plot.draw(self.run_folder)
            self.assertIn(f"{name} must hold what a run writes", str(refused.exception))

    def test_a_half_written_line_of_the_history_is_left_out(self):
        write_run(self.run_folder)
        with (self.run_folder / "history.csv").open("a") as file:
            file.write("0.3,3,2,1e-6,0,4,1,2,5.6,0.2")  # whole but for its end, or so it looks
        np.testing.assert_array_equal(results.read_history(self.run_folder)["time"], [0.1, 0.2])

    def test_tractions_are_the_strongest_of_bodies_that_moved_and_else_the_last(self):
        write_run(self.run_folder)
        bodies = results.read_bodies(self.run_folder)
        self.assertEqual(results.read_tractions(self.run_folder, bodies).time, 0.1)
        bodies.position[0] = bodies.position[1]
        self.assertEqual(results.read_tractions(self.run_folder, bodies).time, 0.2)

    def test_the_last_curves_are_read(self):
        write_run(self.run_folder)
        time, curves = results.read_curves(self.run_folder, "boundaries.h5", "traction")
        self.assertEqual(time, 0.2)
        np.testing.assert_array_equal(curves["wall"].points, POINTS)
        np.testing.assert_array_equal(curves["wall"].values, 2 * np.ones((len(POINTS), 2)))
        self.assertEqual(results.read_curves(self.run_folder, "none.h5", "value"), (0.0, {}))
        self.assertAlmostEqual(results.largest_tractions(self.run_folder, 0.0)["wall"], np.sqrt(8))
        self.assertEqual(results.largest_tractions(self.run_folder, 0.3), {})

    def test_outlines_turn_with_their_bodies(self):
        square = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]], float)
        bodies = results.Bodies(["blade", "disc"], np.array([0, 0.5]), np.array([0.0, 1.0]),
                                np.array([2 * [[0, 0, 0]], 2 * [[2, 3, 0]]], float), np.zeros((2, 2, 3)),
                                np.array([[0, 0], [np.pi / 4, 1]]), [square, None])
        blade, disc = bodies.outlines(1.0).values()
        np.testing.assert_allclose(blade[0], [2, 3 + np.sqrt(2)])
        np.testing.assert_allclose(np.linalg.norm(disc - [2, 3], axis=1), 0.5)

    def test_a_body_is_seen_wherever_it_reaches_into_a_periodic_box(self):
        at = np.array([[[0.5, 2.95, 0], [0.5, -0.5, 0]]])  # across the upper plane after two rounds; beyond the lower one
        bodies = results.Bodies(["across", "beyond"], np.array([0.1, 0.1]), np.array([0.0]), at, np.zeros_like(at), np.zeros((1, 2)),
                                periodic={1: (0.0, 1.0)})
        centres = sorted(tuple(outline.mean(axis=0).round(9)) for outline in bodies.images(0.0))
        self.assertEqual(centres, [(0.5, -0.05), (0.5, 0.5), (0.5, 0.95)])

    def test_a_body_that_left_has_no_outline(self):
        nowhere = np.full(3, np.nan)
        bodies = results.Bodies(["gone", "there"], np.array([0.1, 0.5]), np.array([0.0]),
                                np.array([[nowhere, [2, 3, 0]]]), np.array([[nowhere, nowhere]]), np.zeros((1, 2)))
        self.assertEqual(list(bodies.outlines(0.0)), [1])

    def test_what_stands_in_the_flow_is_not_a_side_of_the_domain(self):
        write_run(self.run_folder)
        fields = results.read_fields(self.run_folder)
        side = results.Curve(np.array([[0, 0], [0.5, 0], [1, 0]], float), np.empty((0, 3), int), np.zeros((3, 2)))
        hole = results.Curve(np.array([[0.4, 0.4], [0.6, 0.4], [0.5, 0.6]]), np.empty((0, 3), int), np.zeros((3, 2)))
        found = obstacles.find(fields, None, {"side": side, "hole": hole}, 0.0)
        self.assertEqual([one.name for one in found], ["hole"])
        lower, upper = obstacles.close_up(found[0], fields, np.array([-1.0, 0.1]))
        np.testing.assert_allclose(lower, [0, 0.22], atol=1e-12)
        np.testing.assert_allclose(upper, [0.84, 0.78])
        fields.file.close()


if __name__ == "__main__":
    unittest.main()
