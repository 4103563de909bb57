"""The results of a run as arrays: mesh and fields, bodies over time, tractions on the bodies, the history; and what
of its scene decides how they are drawn."""

import contextlib
import csv
import tomllib
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from launcher.common import Refusal


@dataclass
class Scene:
    """What the pictures need of scene.toml."""

    steady: bool = False
    heavy: bool = False  # there is gravity, so the pressure is the reduced one
    closed: bool = False  # no boundary gives the pressure a level
    box: tuple[list[float], list[float]] | None = None  # corners of a rectangular mesh [m]

    def when(self, time: float) -> str:
        return "steady" if self.steady else f"t = {time:.4g} s"


@dataclass
class Snapshot:
    """Fields at one time; `active` is false in the cells inside bodies."""

    time: float
    velocity: np.ndarray  # (points, 2) [m/s]
    pressure: np.ndarray  # (points) [Pa]
    active: np.ndarray  # (cells)


@dataclass
class Tractions:
    """The force density that the fluid exerts on each arc of each body at one time."""

    time: float
    body: np.ndarray  # (arcs)
    angle: np.ndarray  # (arcs), of the middle [rad]
    traction: np.ndarray  # (arcs, 2) [Pa]
    centre: np.ndarray  # (bodies, 2) [m]


@dataclass
class Bodies:
    names: list[str]
    radius: np.ndarray  # (bodies) [m]
    time: np.ndarray  # (times) [s]
    position: np.ndarray  # (times, bodies, 3) [m]
    velocity: np.ndarray  # (times, bodies, 3) [m/s]

    def at(self, time: float) -> np.ndarray:
        """Positions at the written time nearest to `time`."""
        return self.position[np.argmin(np.abs(self.time - time))]


class Fields:
    """fields.h5: opened once, snapshots read one by one."""

    def __init__(self, path: Path):
        self.file = h5py.File(path, "r")
        self.points = self.file["mesh/points"][:]
        cells = self.file["mesh/cells"][:]
        # a quadratic triangle (corners, then the middles of sides 01, 12, 20) is drawn as four linear ones
        self.triangles = cells[:, [0, 3, 5, 3, 1, 4, 5, 4, 2, 3, 4, 5]].reshape(-1, 3)
        self.steps = sorted(self.file["steps"])

    def __len__(self) -> int:
        return len(self.steps)

    def time(self, index: int) -> float:
        return float(self.file["steps"][self.steps[index]].attrs["time"])

    def snapshot(self, index: int) -> Snapshot:
        group = self.file["steps"][self.steps[index]]
        return Snapshot(self.time(index), group["velocity"][:], group["pressure"][:], group["active"][:] > 0)


@contextlib.contextmanager
def reading(path: Path):
    """Turns what a damaged file raises into a sentence."""
    try:
        yield
    except (OSError, KeyError, ValueError, csv.Error) as error:
        raise Refusal(f"{path} must hold what a run writes, and cannot be read: {error}. "
                      "Move it away to draw what else there is") from error


def read_scene(run: Path) -> Scene:
    path = run / "scene.toml"
    if not path.exists():
        return Scene()
    with reading(path), path.open("rb") as file:
        scene = tomllib.load(file)
    fluid = scene.get("fluid", {})
    boundaries, mesh = fluid.get("boundaries", {}).values(), fluid.get("mesh", {})
    return Scene(steady=scene.get("time", {}).get("steady", False), heavy=any(scene.get("gravity", [])),
                 closed=all(boundary.get("type") != "traction" for boundary in boundaries),
                 box=(mesh["lower"], mesh["upper"]) if mesh.get("lower") and mesh.get("upper") else None)


def read_fields(run: Path) -> Fields | None:
    path = run / "fields.h5"
    if not path.exists():
        return None
    with reading(path):
        return Fields(path)


def read_bodies(run: Path) -> Bodies | None:
    path = run / "bodies.h5"
    if not path.exists():
        return None
    with reading(path), h5py.File(path, "r") as file:
        if "time" not in file or len(file["time"]) == 0:
            return None
        names = [name.decode() if isinstance(name, bytes) else str(name) for name in file["name"][:]]
        return Bodies(names, file["radius"][:], file["time"][:], file["position"][:], file["velocity"][:])


def read_strongest_tractions(run: Path) -> Tractions | None:
    """The tractions at the written time where they are largest: at the end a settled body has hardly any."""
    path = run / "interface.h5"
    if not path.exists():
        return None
    with reading(path), h5py.File(path, "r") as file:
        groups = [group for group in file.get("steps", {}).values() if len(group["traction"]) > 0]
        if not groups:
            return None
        group = max(groups, key=lambda one: np.linalg.norm(one["traction"][:], axis=1).mean())
        return Tractions(float(group.attrs["time"]), group["body"][:], (group["start"][:] + group["end"][:]) / 2,
                         group["traction"][:], group["centre"][:])


def read_history(run: Path) -> dict[str, np.ndarray]:
    """history.csv by column; empty where there is none."""
    path = run / "history.csv"
    if not path.exists():
        return {}
    with reading(path), path.open(newline="") as file:
        header, *rows = csv.reader(file)
        # a run that was killed may leave half a line
        values = np.array([[float(cell) for cell in row] for row in rows if len(row) == len(header)])
        return dict(zip(header, values.reshape(-1, len(header)).T))
