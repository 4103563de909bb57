"""Head-on impacts of two equal spheres without damping: the contact time and the restitution that a program finds
beside those of Hertz, t_c = 2.8683 (m*²/(R* E*² v))^(1/5) and 1."""

import math
from collections.abc import Iterator
from pathlib import Path

from bench.grain_peers import Job, Program
from bench.measure import measure
from bench.packings import DENSITY, POISSON_RATIO, RADII, YOUNGS_MODULUS, Packing, write

RADIUS, SPEED = RADII[0], 0.1  # [m], [m/s] of each
STEPS_PER_CONTACT = (20, 50, 100)
PAIRS = 16  # each starts a contact in another part of a step

MASS = 4 / 3 * math.pi * RADIUS**3 * DENSITY / 2
MODULUS = YOUNGS_MODULUS / (2 * (1 - POISSON_RATIO**2))
COEFFICIENT = 4 / 5 * math.sqrt(math.pi) * math.gamma(0.4) / math.gamma(0.9) * (15 / 16)**0.4  # 2.8683
CONTACT_TIME = COEFFICIENT * (MASS**2 / (RADIUS / 2 * MODULUS**2 * 2 * SPEED))**0.2


def gaps(step: float) -> Iterator[float]:
    """Of each pair at the start [m]."""
    return (2 * SPEED * step * (2 + (k + 0.5) / PAIRS) for k in range(PAIRS))


def impact_packing(step: float, folder: Path) -> Packing:
    rows = []
    for k, gap in enumerate(gaps(step)):
        for side in (-1, 1):
            rows.append((side * (RADIUS + gap / 2), 6 * RADIUS * (k + 1), 0, RADIUS, -side * SPEED, 0, 0))
    file = folder / "impacts.csv"
    write(file, rows)
    return Packing(file, len(rows), [-math.inf, math.inf] * 3, gravity=0)


def accuracy(program: Program, folder: Path) -> list[dict]:
    """The largest errors over the pairs, a row for each size of step."""
    rows = []
    for per_contact in STEPS_PER_CONTACT:
        step = CONTACT_TIME / per_contact
        steps = 2 * per_contact
        job = Job(impact_packing(step, folder), steps, step, 1.0, folder / "end.csv")
        measure(program.command(job))
        state = program.state(job)
        time_errors, bounces = [], []
        for gap, left, right in zip(gaps(step), state[::2], state[1::2]):
            apart = right[4] - left[4]  # [m/s]
            distance = math.dist(left[:3], right[:3]) - 2 * RADIUS
            contact = steps * step - gap / (2 * SPEED) - distance / apart
            time_errors.append(abs(contact / CONTACT_TIME - 1))
            bounces.append(abs(apart / (2 * SPEED) - 1))
        rows.append({"program": program.name, "steps_per_contact": per_contact, "contact_time": max(time_errors),
                     "restitution": max(bounces)})
    return rows
