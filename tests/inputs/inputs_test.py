#!/usr/bin/python3
"""Meshes, STL files, tables and scenes as other programs write them: each is read as what it is, or refused with a
sentence that names it. `inputs_test.py Inputs.NAME` runs one test, as CTest does."""

import json
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MESHES = ROOT / "tests" / "fuzz" / "corpus" / "gmsh"

# The exact solution: both walls together are drawn with a force of μ |u'| 2 L = 1.6 N.
CHANNEL = """
[time]
steady = true
[fluid]
density = 1
dynamic_viscosity = 0.1
viscous_form = "gradient"
[fluid.mesh]
file = "channel.msh"
[fluid.boundaries]
{walls}
left = {{type = "velocity", velocity = ["{inflow}", 0]}}
right = {{type = "traction"}}
"""
ONE_WALL = 'walls = {type = "no_slip"}'

GRAIN = """
gravity = {gravity}
[time]
step = 1e-3
end = {end}
[[bodies]]
name = "ball"
shape = "sphere"
radius = 0.01
density = 2500
position = {position}
velocity = {velocity}
[[materials]]
name = "m"
youngs_modulus = 1e7
restitution = 1
[[walls]]
name = "wall"
{wall}
"""

TABLE = """
gravity = [0, -9.81]
[time]
step = 1e-3
end = 2e-3
[[grains]]
name = "g"
generator = "csv"
file = "grains.csv"
density = 2500
[[materials]]
name = "m"
youngs_modulus = 1e7
"""

PERIODIC = """
[time]
steady = true
[periodic]
x = [0, 1]
y = [0, 1]
[fluid]
density = 1
dynamic_viscosity = 1
pressure_drop = [1, 0]
[fluid.mesh]
upper = [1, 1]
cells_x = 4
cells_y = 4
"""


def channel_mesh(groups: dict[str, list[int]], names: list[tuple[int, str]], rise: float = 0, copies: int = 1) -> str:
    """A channel of 2 m by 1 m in Gmsh's format 2.2. `groups`: numbers of the groups of each side, as which Gmsh writes
    its lines; `rise`: of z along x; `copies`: how often each triangle is written."""
    nx, ny = 8, 4

    def node(i, j):
        return 1 + i + (nx + 1) * j

    nodes = [f"{node(i, j)} {2 * i / nx} {j / ny} {rise * i / nx}" for j in range(ny + 1) for i in range(nx + 1)]
    sides = {"bottom": [(node(i, 0), node(i + 1, 0)) for i in range(nx)],
             "top": [(node(i + 1, ny), node(i, ny)) for i in range(nx)],
             "left": [(node(0, j + 1), node(0, j)) for j in range(ny)],
             "right": [(node(nx, j), node(nx, j + 1)) for j in range(ny)]}
    elements = [f"1 2 {group} 1 {a} {b}" for side, lines in sides.items() for group in groups[side] for a, b in lines]
    for copy in range(copies):
        for i in range(nx):
            for j in range(ny):
                a, b, c, d = node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)
                elements += [f"2 2 {50 + copy} 1 {a} {b} {c}", f"2 2 {50 + copy} 1 {a} {c} {d}"]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    lines += [f'1 {tag} "{name}"' for tag, name in names]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(nodes)), *nodes, "$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{number} {element}" for number, element in enumerate(elements, 1)] + ["$EndElements", ""]
    return "\n".join(lines)


NAMES = [(1, "bottom"), (2, "right"), (3, "top"), (4, "left")]
SIDES = {"bottom": [1], "right": [2], "top": [3], "left": [4]}


def square(x: float) -> list[tuple[tuple[float, float, float], ...]]:
    """Two triangles of a square of 2 m at x, across the x axis."""
    return [((x, -1, -1), (x, 1, -1), (x, 1, 1)), ((x, -1, -1), (x, 1, 1), (x, -1, 1))]


def stl_text(triangles) -> bytes:
    lines = ["solid wall"]
    for triangle in triangles:
        lines += ["facet normal 1 0 0", "outer loop", *(f"vertex {x!r} {y!r} {z!r}" for x, y, z in triangle), "endloop", "endfacet"]
    return "\n".join([*lines, "endsolid wall", ""]).encode()


def stl_bytes(triangles) -> bytes:
    rows = [struct.pack("<12fH", 1, 0, 0, *(c for corner in triangle for c in corner), 0) for triangle in triangles]
    return b"solid by another program".ljust(80) + struct.pack("<I", len(rows)) + b"".join(rows)


class Inputs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.runs = 0

    def write(self, name: str, content: str | bytes) -> None:
        (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())

    def fpi(self, command: str, *options: str) -> subprocess.CompletedProcess:
        done = subprocess.run([str(ROOT / "fpi"), command, "scene.toml", *options], capture_output=True, cwd=self.folder,
                              encoding="utf-8", check=False)
        self.assertNotIn("Traceback", done.stderr)
        return done

    def run_scene(self, scene: str | bytes, done_well: bool = True) -> dict:
        """Runs a scene; its summary, or that of its failure."""
        self.write("scene.toml", scene)
        self.runs += 1
        done = self.fpi("run", "--json", "--out", f"run-{self.runs}")
        self.assertEqual(done.returncode == 0, done_well, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def reason(self, scene: str | bytes) -> str:
        """Why a scene is refused."""
        return self.run_scene(scene, done_well=False)["reason"]

    def force(self, scene: str, boundary: str) -> list[float]:
        return next(b["force"] for b in self.run_scene(scene)["boundaries"] if b["name"] == boundary)

    def assert_vector(self, vector, expected, tolerance):
        for value, wanted in zip(vector, expected, strict=True):
            self.assertAlmostEqual(value, wanted, delta=tolerance)

    def channel(self, walls: str = 'top = {type = "no_slip"}\nbottom = {type = "no_slip"}', inflow="4*y*(1-y)") -> str:
        return CHANNEL.format(walls=walls, inflow=inflow)

    def test_walls_in_two_groups_of_one_name_have_the_force_of_both(self):
        self.write("channel.msh", channel_mesh(SIDES, [(1, "walls"), (3, "walls"), (2, "right"), (4, "left")]))
        self.assert_vector(self.force(self.channel(ONE_WALL), "walls"), (1.6, 0, 0), 1e-9)

    def test_an_edge_in_two_groups_has_the_condition_that_the_scene_gives(self):
        names = [*NAMES, (5, "walls")]
        self.write("channel.msh", channel_mesh(SIDES | {"bottom": [1, 5], "top": [3, 5]}, names))
        self.assert_vector(self.force(self.channel(ONE_WALL), "walls"), (1.6, 0, 0), 1e-9)
        self.assert_vector(self.force(self.channel(), "top"), (0.8, 1.6, 0), 1e-9)
        both = self.reason(self.channel('top.type = "no_slip"\nbottom.type = "no_slip"\nwalls.type = "slip"'))
        self.assertRegex(both, r'channel\.msh: .*in the groups "(top|bottom)" and "walls"')

    def test_a_mesh_written_once_for_each_group_is_the_mesh(self):
        self.write("channel.msh", channel_mesh(SIDES, NAMES, copies=2))
        self.assert_vector(self.force(self.channel(), "top"), (0.8, 1.6, 0), 1e-9)

    def test_an_inclined_mesh_is_refused_with_a_word_on_z(self):
        self.write("channel.msh", channel_mesh(SIDES, NAMES, rise=1.5))
        self.assertIn("channel.msh: a mesh in a plane of constant z is required", self.reason(self.channel()))

    def test_a_partitioned_mesh_is_read(self):
        self.write("channel.msh", (MESHES / "partitioned.msh").read_bytes())
        self.assert_vector(self.force(self.channel(ONE_WALL), "walls"), (1.6, 0, 0), 1e-9)

    def bounce(self, wall: str, at: float) -> list[float]:
        """Where a sphere is that hits a wall at x = `at` after 0.04 s."""
        scene = GRAIN.format(gravity=[0, 0, 0], end=0.1, position=[at - 0.05, 0.1, 0.2], velocity=[1, 0, 0], wall=wall)
        return self.run_scene(scene)["bodies"][0]["position"]

    def test_a_wall_far_from_the_origin_is_where_its_text_says(self):
        at = 500000.013  # 13 mm from the next number in single precision
        self.write("wall.stl", stl_text(square(at)))
        plane = self.bounce(f"point = [{at}, 0, 0]\nnormal = [-1, 0, 0]", at)
        self.assert_vector(self.bounce('shape = "mesh"\nfile = "wall.stl"', at), plane, 1e-5)

    def test_binary_and_text_files_of_one_wall_stop_a_grain_alike(self):
        plane = self.bounce("point = [0.5, 0, 0]\nnormal = [-1, 0, 0]", 0.5)
        text, binary = stl_text(square(0.5)), stl_bytes(square(0.5))
        for content in (text, text.upper(), text.replace(b"\n", b"\r\n"), binary, binary + b"a tail of some bytes"):
            with self.subTest(content=content[:20]):
                self.write("wall.stl", content)
                self.assert_vector(self.bounce('shape = "mesh"\nfile = "wall.stl"', 0.5), plane, 1e-9)

    def test_tables_of_spreadsheets_are_read_or_get_a_hint(self):
        rows = "x,y,radius\n0.02,0.02,0.01\n0.05,0.03,0.012\n"
        self.write("grains.csv", rows)
        plain = self.run_scene(TABLE)["grains"]
        for content in ("\ufeff" + rows, rows.replace("0.0", "+0.0"), rows.replace("\n", "\r\n"), rows.replace("\n", "\r")):
            with self.subTest(content=content):
                self.write("grains.csv", content)
                self.assertEqual(self.run_scene(TABLE)["grains"], plain)
        for content, hint in ((rows.replace(",", ";"), "got semicolons"), (rows.replace(",", "\t"), "got tabs"),
                              (rows.replace("0.0", "0,0"), "decimals take a point"),
                              (rows.encode("utf-16"), "got UTF-16")):
            with self.subTest(content=content):
                self.write("grains.csv", content)
                self.assertRegex(self.reason(TABLE), f"grains.csv:[12].*{hint}")

    def test_a_scene_that_is_not_utf8_is_refused_with_a_sentence(self):
        self.write("grains.csv", "x,y,radius\n0.02,0.02,0.01\n")
        for encoding, word in (("latin-1", "the byte 0xF6"), ("utf-16", "UTF-16")):
            with self.subTest(encoding=encoding):
                self.assertRegex(self.reason(("# Größe\n" + TABLE).encode(encoding)),
                                 f"scene.toml:1: text in UTF-8 is required; got {word}")
                checked = self.fpi("check")
                self.assertEqual(checked.returncode, 1)
                self.assertIn(f"got {word}", checked.stdout)

    def test_a_periodic_rectangle_without_a_corner_is_refused_with_a_sentence(self):
        self.write("scene.toml", PERIODIC)
        checked = self.fpi("check")
        self.assertEqual(checked.returncode, 1)
        self.assertRegex(checked.stdout, r"scene\.toml:\d+: fluid\.mesh\.lower must name a mesh, or else lower = \[x, y\]")

    def test_a_formula_that_is_not_finite_is_named_with_its_key_and_place(self):
        self.write("channel.msh", channel_mesh(SIDES, NAMES))
        self.assertIn('fluid.boundaries.left.velocity.0: the formula "1/(y-0.5)" must be finite; got inf at x = 0 m, '
                      "y = 0.5 m, t = 0 s", self.reason(self.channel(inflow="1/(y-0.5)")))


if __name__ == "__main__":
    unittest.main()
