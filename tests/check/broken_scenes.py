"""Small scenes that are good, and two hundred ways to break them: each a scene, overrides and lines taken out."""

from dataclasses import dataclass, field
from pathlib import Path

CHANNEL = """
title = "a stream past a cylinder and a plate"
[time]
step = 0.01
end = 0.01
[output]
fields = false
[fluid]
density = 1.0
kinematic_viscosity = 0.01
[fluid.mesh]
lower = [0, 0]
upper = [2, 1]
cells_x = 24
cells_y = 12
[fluid.boundaries]
left = {type = "velocity", velocity = ["4*y*(1-y)", 0]}
right.type = "traction"
bottom.type = "no_slip"
top.type = "no_slip"
[[bodies]]
name = "cylinder"
radius = 0.2
position = [0.6, 0.5]
motion = "fixed"
[[bodies]]
name = "plate"
shape = "polygon"
vertices = [-0.05, -0.2, 0.05, -0.2, 0.05, 0.2, -0.05, 0.2]
position = [1.3, 0.5]
motion = "prescribed"
prescribed_velocity = ["0.1", "0"]
[[coefficients]]
name = "c"
on = "cylinder"
velocity = 1
length = 0.4
[[probes]]
name = "behind"
point = [0.9, 0.5]
[[profiles]]
name = "middle"
quantity = "speed"
from = [0, 0.5]
to = [2, 0.5]
"""

SETTLING = """
title = "a disc between walls in a closed box"
gravity = [0, -9.81]
[time]
step = 0.002
end = 0.002
[output]
fields = false
[fluid]
density = 1000.0
kinematic_viscosity = 1e-5
[fluid.mesh]
lower = [0, 0]
upper = [0.01, 0.02]
cell_size = 1e-3
elements_per_diameter = 6
[fluid.boundaries]
left.type = "no_slip"
right.type = "no_slip"
bottom.type = "no_slip"
top.type = "no_slip"
[[bodies]]
name = "disc"
radius = 1.25e-3
density = 1250.0
position = [0.005, 0.015]
material = "glass"
[[bodies]]
name = "post"
radius = 1e-3
position = [0.005, 0.005]
motion = "fixed"
[[materials]]
name = "glass"
youngs_modulus = 1e7
[[walls]]
name = "floor"
point = [0, 0]
normal = [0, 1]
[[outlets]]
name = "side"
lower = [0.009, 0]
upper = [0.02, 0.02]
[[probes]]
name = "corner"
point = [0.001, 0.001]
"""

PERIODIC = """
title = "a flow through an array of cylinders"
[time]
steady = true
[output]
fields = false
[periodic]
x = [0, 1]
y = [0, 1]
[fluid]
density = 1.0
dynamic_viscosity = 1.0
convection = false
pressure_drop = ["1", "0"]
[fluid.mesh]
lower = [0, 0]
upper = [1, 1]
cells_x = 12
cells_y = 12
[[bodies]]
name = "cylinder"
radius = 0.3
position = [0.5, 0.5]
motion = "fixed"
[[probes]]
name = "mean"
quantity = "superficial_velocity_x"
"""

GRAINS = """
title = "spheres from a table above a floor of triangles"
gravity = [0, 0, -9.81]
[time]
step = 0.001
end = 0.001
[[grains]]
name = "balls"
shape = "sphere"
generator = "csv"
file = "balls.csv"
density = 2500
[[materials]]
name = "glass"
youngs_modulus = 1e7
[[walls]]
name = "floor"
shape = "mesh"
file = "floor.stl"
"""

FITTED = """
title = "a square of two triangles from a mesh file"
[time]
step = 0.1
end = 0.1
[output]
fields = false
[fluid]
density = 1.0
dynamic_viscosity = 1.0
[fluid.mesh]
file = "square.msh"
[fluid.boundaries]
lid = {type = "velocity", velocity = ["1", 0]}
walls.type = "no_slip"
[[probes]]
name = "middle"
point = [0.5, 0.5]
"""

BALLS = "x,y,z,radius\n0.02,0.02,0.03,0.005\n0.05,0.02,0.03,0.005\n"
FLOOR = """solid floor
facet normal 0 0 1
outer loop
vertex -1 -1 0
vertex 1 -1 0
vertex 0 1 0
endloop
endfacet
endsolid floor
"""
SQUARE = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 "walls"
1 2 "lid"
2 3 "fluid"
$EndPhysicalNames
$Nodes
9
1 0 0 0
2 0.5 0 0
3 1 0 0
4 0 0.5 0
5 0.5 0.5 0
6 1 0.5 0
7 0 1 0
8 0.5 1 0
9 1 1 0
$EndNodes
$Elements
16
1 1 2 1 1 1 2
2 1 2 1 1 2 3
3 1 2 1 1 3 6
4 1 2 1 1 6 9
5 1 2 2 2 9 8
6 1 2 2 2 8 7
7 1 2 1 1 7 4
8 1 2 1 1 4 1
9 2 2 3 3 1 2 5
10 2 2 3 3 1 5 4
11 2 2 3 3 2 3 6
12 2 2 3 3 2 6 5
13 2 2 3 3 4 5 8
14 2 2 3 3 4 8 7
15 2 2 3 3 5 6 9
16 2 2 3 3 5 9 8
$EndElements
"""

GOOD = {"channel": CHANNEL, "settling": SETTLING, "periodic": PERIODIC, "grains": GRAINS, "fitted": FITTED}
FILES = {"balls.csv": BALLS, "floor.stl": FLOOR, "square.msh": SQUARE}


@dataclass
class Case:
    """A scene and what is done to it."""

    name: str
    base: str
    overrides: list[str] = field(default_factory=list)
    replaced: tuple[str, str] = ("", "")  # text of the scene
    files: dict[str, str | None] = field(default_factory=dict)  # other contents, or None: it is missing

    def write(self, folder: Path) -> Path:
        for name, content in (FILES | self.files).items():
            path = folder / name
            path.unlink(missing_ok=True)
            if content is not None:
                path.write_text(content)
        text, (old, new) = GOOD[self.base], self.replaced
        assert old in text, self.name
        scene = folder / "scene.toml"
        scene.write_text(text.replace(old, new, 1) if old else text)
        return scene


NUMBERS = {  # key: values out of its range or of another type
    "channel": {
        "time.step": ("-1", "0", "nan", '"fast"', "[1]", "true"),
        "time.end": ("-1", "0", "inf"),
        "fluid.density": ("0", "-1", "nan", '"water"', "1e999"),
        "fluid.kinematic_viscosity": ("0", "-0.01", "inf"),
        "fluid.newmark_gamma": ("0.4", "1.5"),
        "fluid.mesh.cells_x": ("0", "-3", "2.5", "1000001"),
        "fluid.mesh.upper": ("[2]", "[-1, 1]", "[0, 0]", "[nan, 1]", "[1, 2, 3]"),
        "fluid.newton.relative_tolerance": ("-1", '"small"'),
        "fluid.newton.max_iterations": ("0", "1.5"),
        "fluid.embedding.arc_ratio": ("0", "-1"),
        "bodies.0.radius": ("0", "-0.2", "1e307", "1e308", "nan", "100"),
        "bodies.0.position": ("[9, 9]", "[0.6]", "[nan, 0]", "[1e300, 0]", '"middle"'),
        "bodies.1.vertices": ("[0, 0, 1]", "[0, 0, 1, 1]", "[0, 0, 0, 0, 0, 0]", "[0, 0, 1, 1, 0, 1, 1, 0]"),
        "bodies.1.position": ("[5, 5]", "[-1, 0.5]"),
        "coefficients.0.velocity": ("0", "-1"),
        "coefficients.0.length": ("0",),
        "probes.0.point": ("[3, 0.5]", "[0.9]", "[]", "[0.9, -0.1]", "[1e300, 0]"),
        "probes.0.minus": ("[3, 0.5]", "[1]"),
        "profiles.0.from": ("[-1, 0.5]", "[0]"),
        "profiles.0.to": ("[2.5, 0.5]", "[0, 0.5]"),
        "output.interval": ("-1", '"often"'),
        "output.measure_from": ("5",),
        "thickness": ("0", "-1"),
    },
    "settling": {
        "gravity": ("[0]", "[0, -9.81, 0, 0]", '"down"'),
        "bodies.0.radius": ("0", "0.02", "0.0051", "1e307"),
        "bodies.0.density": ("-1",),
        "bodies.0.position": ("[0.005, 0.03]", "[0.005, 0.006]", "[-0.001, 0.01]", "[0.5, 0.5]"),
        "bodies.1.position": ("[0.5, 0.5]", "[0.005, 0.014]"),
        "materials.0.youngs_modulus": ("0", "-1"),
        "walls.0.normal": ("[0, 0]", "[0, 1, 0]", "[]"),
        "walls.0.point": ("[0]", "[]"),
        "outlets.0.lower": ("[0.03, 0]", "[0]"),
        "probes.0.point": ("[0.02, 0.02]",),
        "fluid.mesh.cell_size": ("-1", "0"),
        "fluid.mesh.free_bodies_box": ("[0, 0]", "[0.01, 0, 0, 0.02]"),
        "coupling.relative_tolerance": ("-1",),
        "coupling.participant_timeout": ("-1",),
        "hydraulic_radius_ratio": ("0", "1.5"),
        "time.max_halvings": ("-1", "31"),
        "time.min_step": ("1", "-1"),
    },
    "periodic": {
        "periodic.x": ("[0]", "[1, 0]", "[0, 2]", "[0.1, 1]"),
        "periodic.y": ("[0, nan]",),
        "fluid.mesh.cells_y": ("0",),
        "bodies.0.radius": ("0.8", "-1"),
        "bodies.0.position": ("[0.5, 0.5, 0.5]",),
    },
    "grains": {
        "grains.0.density": ("0", "-2"),
        "walls.0.scale": ("0", "-1"),
        "gravity": ("[0, -9.81]",),
        "dem.steps_per_contact": ("0", "-5"),
        "dem.stretch": ("0",),
    },
    "fitted": {
        "fluid.dynamic_viscosity": ("0", "-1"),
        "probes.0.point": ("[1.5, 0.5]", "[0.5, -0.01]"),
        "time.step": ("0",),
    },
}

TEXTS = {  # formulas, words and names
    "channel": {
        "fluid.boundaries.left.velocity": ('["4*z", 0]', '["0,5", 0]', '["1/0", 0]', '["sqrt(-1)", 0]', '["1/t", 0]', '["4*y*(1-y)"]', '"1"'),
        "fluid.boundaries.left.type": ('"inflow"', '"no_slip"', "3"),
        "fluid.boundaries.right.type": ('"slip"', '"no_slip"'),
        "fluid.boundaries.right.traction": ('["1/0", 0]', '["log(-1)", 0]', '["p", 0]'),
        "fluid.boundaries.middle.type": ('"no_slip"',),
        "fluid.body_force": ('["1/0", 0]', '["sqrt(-1-x)", 0]', '["1"]', '["gravity", 0]'),
        "fluid.initial_velocity": ('["1/x", 0]', '["t/t", 0]', '["u", 0]'),
        "fluid.pressure_drop": ('["1", 0]',),
        "fluid.superficial_velocity": ('["1", 0]', '["1"]'),
        "fluid.linear_solver": ('"pardiso"',),
        "fluid.viscous_form": ('"full"',),
        "bodies.0.shape": ('"square"', '"sphere"'),
        "bodies.0.motion": ('"still"',),
        "bodies.1.prescribed_velocity": ('["0.1"]', '["v", 0]', '["1/0", 0]', '["1/t", 0]'),
        "bodies.1.name": ('"cylinder"', '"a b"', '""', '"left"'),
        "coefficients.0.on": ('"cylindre"', '"right"'),
        "probes.0.quantity": ('"temperature"', '"superficial_velocity_x"'),
        "probes.0.name": ('"drag"', '"time"', '"a/b"'),
        "profiles.0.quantity": ('"vorticity"',),
        "fluid.densty": ("2",),
        "fluid.mesh.refinement": ("[]",),
        "colour": ('"red"',),
        "periodic.x": ("[0, 2]",),
        "time.steady": ('"yes"',),
    },
    "settling": {
        "bodies.0.material": ('"glas"',),
        "walls.0.material": ('"steel"',),
        "walls.0.shape": ('"mesh"', '"circle"'),
        "walls.0.velocity": ('["a", 0]', "[1]"),
        "bodies.0.shape": ('"sphere"', '"polygon"'),
        "coupling.response": ('"none so far"',),
        "coupling.acceleration": ('"newton"',),
        "dem.contact": ('"linear"', '"stiff"'),
        "time.steady": ("true",),
    },
    "periodic": {
        "fluid.pressure_drop": ('["1/0", 0]', '["x+", 0]'),
        "fluid.superficial_velocity": ('["1", 0]', '["1"]'),
        "fluid.boundaries.left.type": ('"no_slip"',),
    },
    "grains": {
        "grains.0.generator": ('"honeycomb"', '"random"'),
        "grains.0.file": ('"missing.csv"', '"."', '"floor.stl"'),
        "walls.0.file": ('"missing.stl"', '"balls.csv"', '""'),
        "grains.0.shape": ('"disc"',),
        "materials.0.name": ('""',),
    },
    "fitted": {
        "fluid.mesh.file": ('"missing.msh"', '"floor.stl"', '""', '"/"'),
        "fluid.boundaries.lidd.type": ('"no_slip"',),
        "fluid.boundaries.lid.velocity": ('["x", "y"]', '["0", "1"]'),
        "fluid.mesh.elements_per_diameter": ("8",),
    },
}

TAKEN_OUT = {  # lines without which the scene is not whole
    "channel": ("step = 0.01\n", "end = 0.01\n", "density = 1.0\n", "kinematic_viscosity = 0.01\n", "lower = [0, 0]\n", "upper = [2, 1]\n",
                "cells_x = 24\n", 'right.type = "traction"\n', 'bottom.type = "no_slip"\n', "radius = 0.2\n", 'name = "plate"\n',
                'prescribed_velocity = ["0.1", "0"]\n', 'on = "cylinder"\n', "point = [0.9, 0.5]\n", 'quantity = "speed"\n', "to = [2, 0.5]\n",
                "[fluid.mesh]\n", "[time]\n"),
    "settling": ('[[materials]]\nname = "glass"\nyoungs_modulus = 1e7\n', "radius = 1.25e-3\n", "density = 1250.0\nposition = [0.005, 0.015]\n",
                 "normal = [0, 1]\n", 'left.type = "no_slip"\n', "lower = [0.009, 0]\n", "cell_size = 1e-3\n"),
    "periodic": ("lower = [0, 0]\n", "x = [0, 1]\n", '[[bodies]]\nname = "cylinder"\nradius = 0.3\nposition = [0.5, 0.5]\nmotion = "fixed"\n'),
    "grains": ('file = "balls.csv"\n', 'file = "floor.stl"\n', "density = 2500\n", '[[materials]]\nname = "glass"\nyoungs_modulus = 1e7\n'),
    "fitted": ('file = "square.msh"\n', 'walls.type = "no_slip"\n', "dynamic_viscosity = 1.0\n"),
}

BROKEN_FILES = (
    ("grains", "balls.csv", None), ("grains", "balls.csv", ""), ("grains", "balls.csv", "x,y,z\n0,0,0\n"),
    ("grains", "balls.csv", "x,y,z,radius\n0,0,a,1\n"), ("grains", "balls.csv", "x,y,z,radius\n0,0,1,-1\n"),
    ("grains", "balls.csv", "x,y,z,radius\n0,0,1\n"), ("grains", "balls.csv", "x;y;z;radius\n0;0;1;0.1\n"),
    ("grains", "balls.csv", "x,y,z,radius\n0,0,1,0.1\n0,0,1.1,0.1\n"), ("grains", "balls.csv", "x,y,z,radius\n"),
    ("grains", "floor.stl", None), ("grains", "floor.stl", ""), ("grains", "floor.stl", "solid floor\nendsolid floor\n"),
    ("grains", "floor.stl", FLOOR.replace("vertex 1 -1 0", "vertex 1 nan 0")), ("grains", "floor.stl", FLOOR[:100]),
    ("fitted", "square.msh", None), ("fitted", "square.msh", ""), ("fitted", "square.msh", SQUARE[:200]),
    ("fitted", "square.msh", SQUARE.replace("2.2 0 8", "5.0 0 8")), ("fitted", "square.msh", SQUARE.replace('"lid"', '"cover"')),
    ("fitted", "square.msh", SQUARE.replace("2 0.5 0 0", "2 0.5 0 nan")), ("fitted", "square.msh", SQUARE.replace("16 2 2 3 3 5 9 8", "16 2 2 3 3 5 9 80")),
    ("fitted", "square.msh", SQUARE.replace("5 0.5 0.5 0", "5 0.5 0.5 0.2")), ("fitted", "square.msh", SQUARE.replace("5 0.5 0.5 0", "5 1.5 0.5 0")),
)

OTHERS = (
    Case("not TOML", "channel", replaced=("[time]", "[time")),
    Case("a closed channel with an inflow", "channel", ["fluid.boundaries.right.type=no_slip"]),
    Case("more goes in than out", "channel", ["fluid.boundaries.right={type = \"velocity\", velocity = [\"3.9*y*(1-y)\", 0]}"]),
    Case("a cylinder closes the channel", "channel", ["bodies.0.radius=0.55", "fluid.boundaries.right.flow_rate=1"]),
    Case("the fluid is all covered", "channel", ["bodies.0.radius=5"]),
    Case("two bodies in one place", "channel", replaced=("[[coefficients]]", '[[bodies]]\nname = "twin"\nradius = 0.2\nposition = [0.6, 0.5]\nmotion = "fixed"\n[[coefficients]]')),
    Case("a free polygon", "settling", replaced=("[[materials]]", '[[bodies]]\nname = "wedge"\nshape = "polygon"\nvertices = [0, 0, 1e-3, 0, 0, 1e-3]\ndensity = 2000\nposition = [0.008, 0.015]\n[[materials]]')),
    Case("nothing holds a steady flow", "periodic", ["bodies.0.radius=0.3"], replaced=('[[bodies]]\nname = "cylinder"\nradius = 0.3\nposition = [0.5, 0.5]\nmotion = "fixed"\n', "[[bodies]]\nname = \"cylinder\"\nradius = 0.3\nposition = [0.5, 0.5]\nmotion = \"free\"\n")),
    Case("two drives", "periodic", ["fluid.superficial_velocity=[\"1\", \"0\"]"]),
    Case("a wall of a plane in a periodic box", "settling", ["periodic.x=[0, 0.01]"]),
    Case("a scene without a fluid and without free bodies", "channel", replaced=("[fluid]", "[liquid]")),
    Case("a table where a number should be", "fitted", ["fluid.density={a = 1}"]),
    Case("a list entry that is not there", "fitted", ["probes.3.point=[0, 0]"]),
    Case("an override without a value", "fitted", ["fluid.density"]),
)


def cases() -> list[Case]:
    """All, in a fixed order."""
    out = [Case(f"{base}: {key} = {value}", base, [f"{key}={value}"])
           for table in (NUMBERS, TEXTS) for base, keys in table.items() for key, values in keys.items() for value in values]
    out += [Case(f"{base} without {line.splitlines()[0]}", base, replaced=(line, "")) for base, lines in TAKEN_OUT.items() for line in lines]
    out += [Case(f"{base}: {name} number {number}", base, files={name: content}) for number, (base, name, content) in enumerate(BROKEN_FILES)]
    return out + list(OTHERS)
