"""Packings of grains as CSV, the same for every program: spheres and discs at rest under gravity, and gases."""

import csv
import math
import random
import subprocess
from dataclasses import dataclass
from pathlib import Path

RADII = (0.5e-3, 0.6e-3)  # [m]
DENSITY = 2500
YOUNGS_MODULUS, POISSON_RATIO = 1e7, 0.25
GRAVITY = 9.81
SHEAR_MODULUS = YOUNGS_MODULUS / (2 * (1 + POISSON_RATIO))
LAYERS = 12  # of a settled packing: under more the lowest grains, as soft as these, overlap by above a hundredth
RAYLEIGH = math.pi * RADII[0] * math.sqrt(DENSITY / SHEAR_MODULUS) / (0.1631 * POISSON_RATIO + 0.8766)
STEP = 0.139 * RAYLEIGH  # [s]
COLUMNS = ("x", "y", "z", "radius", "vx", "vy", "vz")


@dataclass
class Packing:
    """Grains in a file, between walls at the finite bounds (x, y, z: lower, upper)."""
    file: Path
    count: int
    bounds: list[float]
    discs: bool = False
    gravity: float = GRAVITY


def write(file: Path, rows: list[tuple]) -> None:
    with file.open("w", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(COLUMNS)
        writer.writerows(rows)


def read(file: Path) -> list[tuple]:
    with file.open(newline="") as text:
        return [tuple(map(float, row.values())) for row in csv.DictReader(text)]


def lattice(count: int, spacing: float, per_side: int, axes: int) -> list[list[float]]:
    """Layers of per_side (by per_side) places, half a spacing away from the walls."""
    places = []
    for i in range(count):
        x, y, z = i % per_side, i // per_side, 0
        if axes == 3:
            y, z = y % per_side, y // per_side
        places.append([(k + 0.5) * spacing for k in (x, y)] + [(z + 0.5) * spacing if axes == 3 else 0.0])
    return places


def gas(count: int, folder: Path) -> Packing:
    """Spheres on a loose lattice, 2 % of the volume, each with a velocity of its own, in a closed box."""
    draw = random.Random(1)
    mean_volume = 4 / 3 * math.pi * sum(RADII) * (RADII[0]**2 + RADII[1]**2) / 4
    spacing = (mean_volume / 0.02)**(1 / 3)
    per_side = math.ceil(count**(1 / 3))
    rows = [(*place, draw.uniform(*RADII), *(draw.gauss(0, 0.1) for _ in range(3)))
            for place in lattice(count, spacing, per_side, 3)]
    file = folder / f"gas-{count}.csv"
    write(file, rows)
    return Packing(file, count, [0, per_side * spacing] * 3, gravity=0)


def settled(count: int, discs: bool, folder: Path, driver: Path) -> Packing:
    """Grains let fall from a lattice with sideways velocities, until they lie at rest: our own DEM moves them."""
    draw = random.Random(1)
    axes, spacing = 2 if discs else 3, 2.02 * RADII[1]
    per_side = math.ceil(count / LAYERS if discs else math.sqrt(count / LAYERS))
    rows = [(*place, draw.uniform(*RADII), draw.gauss(0, 0.1), draw.gauss(0, 0.1) if axes == 3 else 0.0, 0.0)
            for place in lattice(count, spacing, per_side, axes)]
    side, height, far = per_side * spacing, LAYERS * spacing, math.inf
    packing = Packing(folder / f"settled-{axes}-{count}.csv", count,
                      [0, side, 0, far, -far, far] if discs else [0, side, 0, side, 0, far], discs)
    start = folder / "start.csv"
    write(start, rows)
    falling = 3 * math.sqrt(0.6 * height / GRAVITY)  # a third of the height is lost; the rest is for coming to rest
    subprocess.run([*ours(driver, packing, math.ceil(falling / STEP), file=start), "--out", str(packing.file)],
                   check=True, capture_output=True)
    return packing


def mirrored(part: Packing, across: int, deep: int, folder: Path) -> Packing:
    """A settled packing of spheres beside its mirror images, so that what touched a wall touches its own image there."""
    sides = part.bounds[1], part.bounds[3]
    rows = []
    for i in range(across):
        for j in range(deep):
            for x, y, *rest in read(part.file):
                rows.append((*(tile * side + (side - place if tile % 2 else place)
                               for tile, side, place in zip((i, j), sides, (x, y))), rest[0], rest[1], 0, 0, 0))
    packing = Packing(folder / f"mirrored-{len(rows)}.csv", len(rows),
                      [0, across * sides[0], 0, deep * sides[1], *part.bounds[4:]])
    write(packing.file, rows)
    return packing


def ours(driver: Path, packing: Packing, steps: int, step: float = STEP, file: Path | None = None) -> list[str]:
    """The command of our driver."""
    return [str(driver), str(file or packing.file), str(steps), repr(step), "--gravity", str(packing.gravity),
            "--box", ",".join(map(str, packing.bounds)), *(["--discs"] if packing.discs else [])]
