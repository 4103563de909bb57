"""The programs that are compared: how each is told to run a case on a mesh, and where it says what it found."""

import csv
import importlib.util
import json
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PEERS = ROOT / "bench" / "peers"
PARTS = ("mesh", "assembly", "factor", "solve", "output")


@dataclass
class Found:
    """What a run found: unknowns, values by name, and seconds by part where it tells."""
    unknowns: int
    values: dict[str, float]
    parts: dict[str, float] = field(default_factory=dict)


@dataclass
class Run:
    tool: str  # as in the table and the picture
    size: str  # of the mesh
    command: list[str]
    read: Callable[[str], Found]  # of what the command printed


def fpi(tool: str, size: str, scene: str, folder: Path, sets: list[str], values: Callable[[dict, Path], dict]) -> Run:
    """`./fpi run SCENE` with some keys replaced; `values` reads the summary and the run folder."""
    out = folder / f"{tool}-{size}".replace(" ", "_").replace("/", "_")
    command = [str(ROOT / "fpi"), "run", scene, "--out", str(out), "--json", *(w for s in sets for w in ("--set", s))]

    def read(text: str) -> Found:
        summary = json.loads(text)
        parts = {part: summary["wall_seconds"][part] for part in PARTS}
        found = Found(summary["unknowns"], values(summary, out), parts)
        shutil.rmtree(out)
        return found

    return Run(tool, size, command, read)


def history(folder: Path, *columns: str) -> list[list[float]]:
    """Columns of a run's history.csv, a list a step."""
    with (folder / "history.csv").open(newline="") as file:
        return [[float(row[name]) for name in columns] for row in csv.DictReader(file)]


def peer(tool: str, size: str, command: list[str], values: Callable[[dict], dict]) -> Run:
    """A script of bench/peers; its last line of output is JSON."""

    def read(text: str) -> Found:
        result = json.loads(text.strip().splitlines()[-1])
        return Found(result["unknowns"], values(result))

    return Run(tool, size, command, read)


def freefem(size: str, script: str, arguments: list, values: Callable[[dict], dict]) -> list[Run]:
    """No run where FreeFem++ is not installed."""
    if shutil.which("FreeFem++") is None:
        return []
    command = ["FreeFem++", "-nw", "-v", "0", str(PEERS / script), *map(str, arguments)]
    return [peer("FreeFem++", size, command, values)]


def dolfinx(size: str, script: str, arguments: list, values: Callable[[dict], dict]) -> list[Run]:
    """No run where dolfinx is not installed."""
    if importlib.util.find_spec("dolfinx") is None:
        return []
    return [peer("dolfinx", size, [sys.executable, str(PEERS / script), *map(str, arguments)], values)]


def gmsh_mesh(name: str, size: float, order: int, folder: Path) -> Path:
    """The mesh of configs/flow/NAME.geo with all sizes scaled, its edges straight (order 1) or curved (2)."""
    mesh = folder / f"{name}-{size:g}-{order}.msh"
    if not mesh.exists():
        command = ["gmsh", "-2", "-order", str(order), "-format", "msh22", "-setnumber", "size", f"{size:g}",
                   str(ROOT / "configs" / "flow" / f"{name}.geo"), "-o", str(mesh)]
        subprocess.run(command, check=True, capture_output=True)
    return mesh
