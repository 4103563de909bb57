"""LAMMPS, LIGGGHTS and Yade on a packing: their input, the command, and where each says how long its steps took. Material
and step are those of our driver, bench/grains.cpp; the grains' state at the end is written as the packing was."""

import json
import math
import re
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from bench.packings import DENSITY, POISSON_RATIO, SHEAR_MODULUS, YOUNGS_MODULUS, Packing, ours, read
from bench.tools import PEERS

FRICTION = 0.5
NORMAL = 4 * SHEAR_MODULUS / (3 * (1 - POISSON_RATIO))
TANGENTIAL = 4 * SHEAR_MODULUS / (2 - POISSON_RATIO)
# gran/hertz/history knows no restitution: this damping [1/(m s)] gives 0.5 to the smallest grains at 0.1 m/s.
LAMMPS_DAMPING = 3.46e8


@dataclass
class Job:
    """Steps of a packing that a program is to take; restitution is 0.5, or 1 of a bare impact."""
    packing: Packing
    steps: int
    step: float  # [s]
    restitution: float
    end: Path  # of the grains' state at the end

    def path(self, suffix: str) -> Path:
        return self.end.with_suffix(suffix)


@dataclass
class Program:
    name: str
    command: Callable[[Job], list[str]]
    seconds: Callable[[str], float]  # of the steps alone, from what it printed
    state: Callable[[Job], list[tuple]]  # x, y, z, radius, vx, vy, vz of each grain at the end


def programs(driver: Path) -> list[Program]:
    """Ours, and those of the peers that are installed."""
    def our_command(job: Job) -> list[str]:
        return [*ours(driver, job.packing, job.steps, job.step), "--restitution", str(job.restitution),
                "--out", str(job.end)]

    peers = {"lmp": Program("LAMMPS gran/hertz/history", lammps, loop_seconds, dumped_state),
             "liggghts": Program("LIGGGHTS", liggghts, loop_seconds, dumped_state),
             "yade": Program("Yade", yade, said_seconds, lambda job: read(job.end))}
    return [Program("fpi", our_command, said_seconds, lambda job: read(job.end)),
            *(peer for word, peer in peers.items() if shutil.which(word))]


def said_seconds(output: str) -> float:
    return json.loads(output.strip().splitlines()[-1])["seconds"]


def loop_seconds(output: str) -> float:
    return float(re.findall(r"Loop time of ([0-9.e+-]+)", output)[0])


def dumped_state(job: Job) -> list[tuple]:
    lines = job.path(".dump").read_text(encoding="ascii").splitlines()
    return [tuple(map(float, line.split()[1:])) for line in lines[lines.index(next(
        line for line in lines if line.startswith("ITEM: ATOMS"))) + 1:]]


def write_atoms(job: Job) -> Path:
    """The packing as LAMMPS and LIGGGHTS read it, in a box that nothing leaves."""
    rows = read(job.packing.file)
    room = max(abs(value) for row in rows for value in row[:3]) + 0.01
    sides = []
    for axis, low, high in zip("xyz", job.packing.bounds[::2], job.packing.bounds[1::2]):
        if job.packing.discs and axis == "z":
            low, high = -1e-3, 1e-3
        sides.append(f"{max(low, -room)!r} {min(high, room)!r} {axis}lo {axis}hi")
    atoms = [f"{i} 1 {2 * row[3]!r} {DENSITY} {row[0]!r} {row[1]!r} {row[2]!r}" for i, row in enumerate(rows, 1)]
    velocities = [f"{i} {row[4]!r} {row[5]!r} {row[6]!r} 0 0 0" for i, row in enumerate(rows, 1)]
    job.path(".data").write_text("\n".join(["grains", "", f"{len(rows)} atoms", "1 atom types", "", *sides, "", "Atoms", "",
                                            *atoms, "", "Velocities", "", *velocities, ""]), encoding="ascii")
    return job.path(".data")


def walls(job: Job, style: Callable[[str, float, float], str]) -> list[str]:
    """A line for each finite bound."""
    return [style(axis, bound, side) for axis, *bounds in zip("xyz", job.packing.bounds[::2], job.packing.bounds[1::2])
            for side, bound in enumerate(bounds) if math.isfinite(bound)]


def script(job: Job, atom_style: str, velocities: str, laws: list[str], wall_lines: list[str]) -> Path:
    """An input of LAMMPS or LIGGGHTS."""
    packing = job.packing
    flat = ["fix flat all enforce2d"] if packing.discs else []
    lines = ["units si", f"dimension {2 if packing.discs else 3}", f"atom_style {atom_style}", "atom_modify map array",
             f"boundary f f {'p' if packing.discs else 'f'}", "newton off", velocities,
             f"read_data {write_atoms(job)}", "neighbor 1.2e-4 bin", "neigh_modify delay 0 every 1 check yes", *laws,
             f"fix weight all gravity {packing.gravity} vector {'0 -1 0' if packing.discs else '0 0 -1'}",
             "fix motion all nve/sphere", *flat, *wall_lines, f"timestep {job.step!r}", "thermo 100000000",
             f"run {job.steps}", f"dump end all custom 1 {job.path('.dump')} id x y z radius vx vy vz",
             'dump_modify end sort id format ' + ("" if atom_style == "granular" else "line ")
             + '"%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g"', "run 0"]
    job.path(".in").write_text("\n".join(lines) + "\n", encoding="ascii")
    return job.path(".in")


def lammps(job: Job) -> list[str]:
    damping = LAMMPS_DAMPING if job.restitution < 1 else 0
    law = f"{NORMAL!r} {TANGENTIAL!r} {damping!r} NULL {FRICTION} {int(damping > 0)}"

    def wall(axis: str, bound: float, side: int) -> str:
        place = f"NULL {bound!r}" if side else f"{bound!r} NULL"
        return f"fix {axis}{side} all wall/gran hertz/history {law} {axis}plane {place}"

    laws = [f"pair_style gran/hertz/history {law}", "pair_coeff * *"]
    return ["lmp", "-log", "none", "-in", str(script(job, "sphere", "comm_modify vel yes", laws, walls(job, wall)))]


def liggghts(job: Job) -> list[str]:
    def wall(axis: str, bound: float, side: int) -> str:
        return f"fix {axis}{side} all wall/gran model hertz tangential history primitive type 1 {axis}plane {bound!r}"

    laws = [f"fix young all property/global youngsModulus peratomtype {YOUNGS_MODULUS!r}",
            f"fix poisson all property/global poissonsRatio peratomtype {POISSON_RATIO!r}",
            f"fix bounce all property/global coefficientRestitution peratomtypepair 1 {job.restitution!r}",
            f"fix rub all property/global coefficientFriction peratomtypepair 1 {FRICTION!r}",
            "pair_style gran model hertz tangential history", "pair_coeff * *"]
    # It writes its log where it is started.
    return ["env", "-C", str(job.end.parent), "liggghts", "-log", "none", "-in",
            str(script(job, "granular", "communicate single vel yes", laws, walls(job, wall)))]


def yade(job: Job) -> list[str]:
    packing = job.packing
    task = {"packing": str(packing.file), "bounds": [None if math.isinf(b) else b for b in packing.bounds],
            "discs": packing.discs, "gravity": packing.gravity, "steps": job.steps, "step": job.step,
            "density": DENSITY, "young": YOUNGS_MODULUS, "poisson": POISSON_RATIO, "friction": FRICTION,
            "restitution": job.restitution, "end": str(job.end)}
    job.path(".json").write_text(json.dumps(task), encoding="ascii")
    return ["yade", "-n", "-x", "-j1", str(PEERS / "grains_yade.py"), str(job.path(".json"))]
