"""The results of a run as arrays: mesh and fields, bodies over time, tractions on the bodies, the history; and what
of its scene decides how they are drawn."""

import contextlib
import csv
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from launcher.common import Refusal, require_regular


@dataclass
class Scene:
    """What the pictures need of scene.toml."""

    steady: bool = False
    heavy: bool = False  # there is gravity, so the pressure is the reduced one
    closed: bool = False  # no boundary gives the pressure a level
    box: tuple[list[float], list[float]] | None = None  # corners of a rectangular mesh [m]
    upwards: int = 1  # axis along which gravity acts
    walls: list[dict] = field(default_factory=list)  # as in the scene
    folder: Path = Path()  # with the files that the scene names

    @property
    def pressure_label(self) -> str:
        return "reduced pressure [Pa]" if self.heavy else "pressure [Pa]"

    def when(self, time: float) -> str:
        return "steady" if self.steady else f"t = {time:.4g} s"


@dataclass
class Snapshot:
    """Fields at one time; `active` is false in the cells inside bodies."""

    time: float
    velocity: np.ndarray  # (points, 2) [m/s]
    pressure: np.ndarray  # (points) [Pa]
    active: np.ndarray  # (cells)

    @property
    def speed(self) -> np.ndarray:
        """(points) [m/s]"""
        return np.linalg.norm(self.velocity, axis=1)


@dataclass
class Tractions:
    """The force density that the fluid exerts on each arc of each body at one time."""

    time: float
    body: np.ndarray  # (arcs)
    at: np.ndarray  # (arcs, 2), middle of each [m]
    traction: np.ndarray  # (arcs, 2) [Pa]


@dataclass
class Curve:
    """Values along a fitted boundary or a profile."""

    points: np.ndarray  # (points, 2) [m]
    lines: np.ndarray  # (lines, 3): both ends, then the middle; none of a profile, whose points are in order
    values: np.ndarray  # (points, components) or (points)


@dataclass
class Bodies:
    names: list[str]
    radius: np.ndarray  # (bodies) [m]
    time: np.ndarray  # (times) [s]
    position: np.ndarray  # (times, bodies, 3) [m]
    velocity: np.ndarray  # (times, bodies, 3) [m/s]
    angle: np.ndarray  # (times, bodies) about z [rad]
    vertices: list[np.ndarray | None] = field(default_factory=list)  # of polygons: (corners, 2) from the position [m]
    periodic: dict[int, tuple[float, float]] = field(default_factory=dict)  # by axis: lower and upper plane [m]

    def outlines(self, time: float) -> dict[int, np.ndarray]:
        """Points around each body that is there at the written time nearest to `time`."""
        index = np.argmin(np.abs(self.time - time))
        found = {}
        for i, radius in enumerate(self.radius):
            polygon = self.vertices[i] if i < len(self.vertices) else None
            if polygon is None:
                turn = np.linspace(0, 2 * np.pi, 73)[:-1]
                polygon = radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
            cosine, sine = np.cos(self.angle[index, i]), np.sin(self.angle[index, i])
            if np.isnan(self.position[index, i, 0]):
                continue  # it left
            found[i] = self.position[index, i, :2] + polygon @ np.array([[cosine, sine], [-sine, cosine]])
        return found

    def images(self, time: float) -> list[np.ndarray]:
        """The outlines, in a periodic box wherever they reach into it."""
        found = list(self.outlines(time).values())
        for axis, (lower, upper) in self.periodic.items():
            shift = (upper - lower) * np.eye(2)[axis]
            home = [one - shift * np.floor((one[:, axis].mean() - lower) / (upper - lower)) for one in found]
            found = [one + times * shift for one in home for times in (-1, 0, 1)
                     if (one + times * shift)[:, axis].max() > lower and (one + times * shift)[:, axis].min() < upper]
        return found

    def at(self, time: float) -> np.ndarray:
        """Positions at the written time nearest to `time`."""
        return self.position[np.argmin(np.abs(self.time - time))]


class Fields:
    """fields.h5: opened once, snapshots read one by one."""

    def __init__(self, path: Path):
        self.path = path
        self.file = h5py.File(path, "r")
        self.points = self.file["mesh/points"][:]
        cells = self.file["mesh/cells"][:]
        # a quadratic triangle (corners, then the middles of sides 01, 12, 20) is drawn as four linear ones
        self.triangles = cells[:, [0, 3, 5, 3, 1, 4, 5, 4, 2, 3, 4, 5]].reshape(-1, 3)
        self.steps = sorted(self.file["steps"])

    def __len__(self) -> int:
        return len(self.steps)

    def time(self, index: int) -> float:
        with reading(self.path):
            return float(self.file["steps"][self.steps[index]].attrs["time"])

    def times(self) -> np.ndarray:
        """Of the snapshots [s]"""
        return np.array([self.time(index) for index in range(len(self))])

    def snapshot(self, index: int) -> Snapshot:
        with reading(self.path):
            group = self.file["steps"][self.steps[index]]
            return Snapshot(self.time(index), group["velocity"][:], group["pressure"][:], group["active"][:] > 0)

    def nearest(self, time: float) -> Snapshot:
        return self.snapshot(int(np.argmin(np.abs(self.times() - time))))


@contextlib.contextmanager
def reading(path: Path):
    """Turns what a damaged file raises into a sentence."""
    try:
        require_regular(path)
        yield
    except (OSError, LookupError, ValueError, TypeError, AttributeError, RuntimeError, csv.Error) as error:
        raise Refusal(f"{path} must hold what a run writes, and cannot be read: {error}. "
                      "Move it away to draw what else there is") from error


def read_scene(run: Path) -> Scene:
    scene = scene_of(run)
    if not scene:
        return Scene()
    with reading(run / "scene.toml"):
        fluid = scene.get("fluid", {})
        boundaries, mesh = fluid.get("boundaries", {}).values(), fluid.get("mesh", {})
        gravity = np.abs(scene.get("gravity", [0, 0]))
        return Scene(upwards=int(np.argmax(gravity)) if gravity[1:].any() else 1, walls=scene.get("walls", []), folder=run,
                     steady=scene.get("time", {}).get("steady", False), heavy=any(scene.get("gravity", [])),
                     closed=all(boundary.get("type") != "traction" for boundary in boundaries),
                     box=(mesh["lower"], mesh["upper"]) if mesh.get("lower") and mesh.get("upper") else None)


def read_fields(run: Path) -> Fields | None:
    path = run / "fields.h5"
    if not path.exists():
        return None
    with reading(path):
        return Fields(path)


def scene_of(run: Path) -> dict:
    """scene.toml; empty where there is none."""
    path = run / "scene.toml"
    if not path.exists():
        return {}
    with reading(path), path.open("rb") as file:
        return tomllib.load(file)


def polygons(scene: dict) -> list[np.ndarray | None]:
    """The vertices of each body of the scene, None of a disc."""
    return [np.reshape(body["vertices"], (-1, 2)) if body.get("vertices") else None for body in scene.get("bodies", [])]


def read_bodies(run: Path) -> Bodies | None:
    path, scene = run / "bodies.h5", scene_of(run)
    if not path.exists():
        return None
    with reading(path), h5py.File(path, "r") as file:
        if "time" not in file or len(file["time"]) == 0:
            return None
        names = [name.decode() if isinstance(name, bytes) else str(name) for name in file["name"][:]]
        return Bodies(names, file["radius"][:], file["time"][:], file["position"][:], file["velocity"][:],
                      file["rotation"][:, :, 2], polygons(scene),
                      {axis: tuple(planes) for axis, name in enumerate("xy") if (planes := scene.get("periodic", {}).get(name))})


def read_curves(run: Path, name: str, quantity: str) -> tuple[float, dict[str, Curve]]:
    """The last curves of a file by name, and their time; none where there is no such file."""
    path = run / name
    if not path.exists():
        return 0.0, {}
    with reading(path), h5py.File(path, "r") as file:
        steps = file.get("steps", {})
        if not steps:
            return 0.0, {}
        last = steps[sorted(steps)[-1]]
        return float(last.attrs["time"]), {
            curve: Curve(group["points"][:, :2], group["lines"][:] if "lines" in group else np.empty((0, 3), int),
                         group[quantity][:])
            for curve, group in last.items()}


def largest_tractions(run: Path, since: float) -> dict[str, float]:
    """The largest traction [Pa] on each fitted boundary at the written times from `since` [s] on."""
    path, largest = run / "boundaries.h5", {}
    if not path.exists():
        return largest
    with reading(path), h5py.File(path, "r") as file:
        for step in file.get("steps", {}).values():
            if step.attrs["time"] >= since:
                for name, group in step.items():
                    size = float(np.linalg.norm(group["traction"][:], axis=1).max())
                    largest[name] = max(size, largest.get(name, 0.0))
    return largest


def read_tractions(run: Path, bodies: Bodies | None) -> Tractions | None:
    """The last tractions on bodies; of bodies that moved those of the written time where they are largest, since at
    the end a settled body has hardly any."""
    path = run / "interface.h5"
    if bodies is None or not path.exists():
        return None
    with reading(path), h5py.File(path, "r") as file:
        groups = [group for group in file.get("steps", {}).values() if len(group["traction"]) > 0]
        if not groups:
            return None
        moved = (bodies.position != bodies.position[0]).any()
        group = max(groups, key=lambda one: np.linalg.norm(one["traction"][:], axis=1).mean()) if moved else groups[-1]
        return Tractions(float(group.attrs["time"]), group["body"][:], group["middle"][:], group["traction"][:])


def read_profile_quantities(run: Path) -> dict[str, str]:
    """What each profile of the scene shows."""
    scene = scene_of(run)
    if not scene:
        return {}
    with reading(run / "scene.toml"):
        return {profile["name"]: profile["quantity"] for profile in scene.get("profiles", [])}


def read_history(run: Path) -> dict[str, np.ndarray]:
    """history.csv by column; empty where there is none."""
    path = run / "history.csv"
    if not path.exists():
        return {}
    with reading(path):
        whole_lines = path.read_text().rpartition("\n")[0]  # a run under way, or one that was killed, may leave half a line
        header, *rows = csv.reader(whole_lines.splitlines())
        values = np.array([[float(cell) for cell in row] for row in rows])
        return dict(zip(header, values.reshape(-1, len(header)).T))
