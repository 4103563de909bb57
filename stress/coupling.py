#!/usr/bin/python3
"""Random cases of bodies that move freely in a fluid, each a scene of a few steps through the real programs; one JSON
line a case. `./fpi stress coupling` starts a process a case. Lengths are diameters, speeds the speed that drag allows."""

import argparse
import csv
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
from launcher.common import programs  # noqa: E402

PATIENCE = 300  # seconds after which a case hangs
FASTEST = 20  # a speed that nothing here can reach
DEEPEST = 0.05  # overlap, of bodies a thousandth soft, that only a missed contact reaches
AREA = 90  # largest of a box


@dataclass
class Family:
    title: str
    share: float  # of all cases
    bodies: tuple[int, int]
    gaps: tuple[float, float]
    driven: bool = False  # by a lid, too


FAMILIES = {
    "one": Family("a body by itself, walls at any distance", 0.25, (1, 1), (1e-3, 2)),
    "group": Family("up to 20 bodies, gaps up to 2 d", 0.35, (2, 20), (1e-2, 2)),
    "touch": Family("bodies that touch at the start, or all but", 0.2, (2, 20), (0, 1e-2)),
    "lid": Family("bodies carried along by a lid that starts at once", 0.2, (1, 12), (1e-3, 1), driven=True),
}


class Draw(random.Random):
    """Random numbers that a seed and a name determine."""

    def over_decades(self, low: float, high: float) -> float:
        return low * (high / low) ** self.random()

    def gap(self, low: float, high: float) -> float:
        """As many in each decade down to a thousandth; a third are the lowest."""
        return low if self.random() < 1 / 3 else self.over_decades(max(low, 1e-3), high)

    def density_ratio(self) -> float:
        return 0.0 if self.random() < 0.15 else 1.0 if self.random() < 0.1 else self.over_decades(0.01, 10)


@dataclass
class Disc:
    x: float
    y: float
    radius: float

    def gap(self, other: "Disc") -> float:
        return math.hypot(self.x - other.x, self.y - other.y) - self.radius - other.radius


def cluster(draw: Draw, count: int, gap: float) -> list[Disc]:
    """Discs each `gap` away from one of the others and no nearer to any."""
    discs = [Disc(0, 0, 0.5)]
    while len(discs) < count:
        near, angle, radius = draw.choice(discs), draw.uniform(0, 2 * math.pi), draw.uniform(0.3, 0.5)
        reach = near.radius + radius + gap
        new = Disc(near.x + reach * math.cos(angle), near.y + reach * math.sin(angle), radius)
        if all(new.gap(other) >= gap - 1e-9 for other in discs):
            discs.append(new)
    return discs


def box_around(discs: list[Disc], margins: list[float]) -> tuple[float, float]:
    """Moves the discs so that the box [0, width] x [0, height] leaves the margins left, below, right and above."""
    left, low = min(d.x - d.radius for d in discs), min(d.y - d.radius for d in discs)
    right, high = max(d.x + d.radius for d in discs), max(d.y + d.radius for d in discs)
    for disc in discs:
        disc.x += margins[0] - left
        disc.y += margins[1] - low
    return right - left + margins[0] + margins[2], high - low + margins[1] + margins[3]


def room(draw: Draw, family: Family) -> list[float]:
    """On two opposite sides; one of them leaves the fluid a way."""
    sides = [draw.gap(0.01 if family.driven else 0, 2), draw.gap(0.05, 2)]
    draw.shuffle(sides)
    return sides


def case(name: str, seed: int, quick: bool) -> tuple[dict, dict]:
    """The parameters of a case, and its scene."""
    family, draw = FAMILIES[name.split("-")[0]], Draw(f"{seed} {name}")
    ratio, reynolds = draw.density_ratio(), draw.over_decades(0.01, 500)
    courant = draw.over_decades(0.005, 0.5)
    finest = draw.uniform(4, 5) if quick else draw.uniform(5, 8)
    width = height = math.inf
    while width * height > AREA:
        gap = draw.gap(*family.gaps)
        discs = cluster(draw, draw.randint(*family.bodies), gap)
        (left, right), (below, above) = (room(draw, family) for _ in range(2))
        margins = [left, below, right, above]
        width, height = box_around(discs, margins)
    steps, step = 4 if quick else 8, courant / finest
    # Drag at the speed 1 carries the weight: (r - 1) g π/4 = cd/2.
    weight = (2 + 24 / reynolds) / math.pi
    gravity = weight / max(abs(ratio - 1), 0.05)
    falls = draw.uniform(0, 2 * math.pi)
    parameters = {"bodies": len(discs), "density_ratio": ratio, "reynolds": reynolds, "courant": courant, "gap": gap,
                  "wall_gap": min(margins), "elements_per_diameter": finest}
    lid = [f"16*(x/{width!r}*(1-x/{width!r}))^2", "0"] if family.driven else ["0", "0"]
    scene = {
        "gravity": [gravity * math.cos(falls), gravity * math.sin(falls)],
        "time": {"step": step, "end": steps * step},
        "fluid": {"density": 1, "kinematic_viscosity": 1 / reynolds},
        "fluid.mesh": {"lower": [0, 0], "upper": [width, height], "cells_x": math.ceil(width * finest),
                       "cells_y": math.ceil(height * finest)},
        "fluid.newton": {"relative_tolerance": 1e-6},
        **{f"fluid.boundaries.{side}": {"type": "no_slip"} for side in ("left", "right", "bottom")},
        "fluid.boundaries.top": {"type": "velocity", "velocity": lid},
        "output": {"fields": False},
        "materials": [{"name": "stuff", "youngs_modulus": 1e4 * (1 + weight * (1 + ratio)), "restitution": 0.5}],
        "walls": [{"name": side, "point": point, "normal": normal} for side, point, normal in
                  (("left", [0, 0], [1, 0]), ("bottom", [0, 0], [0, 1]),
                   ("right", [width, height], [-1, 0]), ("top", [width, height], [0, -1]))],
        "bodies": [{"name": f"disc{i}", "radius": d.radius, "density": ratio, "position": [d.x, d.y]}
                   for i, d in enumerate(discs)],
    }
    return parameters, scene


def toml(scene: dict) -> str:
    """Plain values first, then tables, then lists of tables; JSON's values are TOML's."""
    def lines(table: dict) -> list[str]:
        return [f"{key} = {json.dumps(value)}" for key, value in table.items()]

    out = lines({key: value for key, value in scene.items() if not tables_of(value)})
    for key, value in scene.items():
        for table in tables_of(value):
            out += ["", f"[[{key}]]" if isinstance(value, list) else f"[{key}]", *lines(table)]
    return "\n".join(out) + "\n"


def tables_of(value) -> list[dict]:
    if isinstance(value, dict):
        return [value]
    return value if isinstance(value, list) and value and isinstance(value[0], dict) else []


def problem(summary: dict, history: list[dict], scene: dict) -> str:
    """What is wrong with a run that came to its end, or ""."""
    for row in history:
        for name, value in row.items():
            if not math.isfinite(float(value)):
                return f"{name} is {value} at t = {row['time']} s"
            if name.endswith((".vx", ".vy")) and abs(float(value)) > FASTEST:
                return f"{name} is {value} m/s at t = {row['time']} s"
    upper = scene["fluid.mesh"]["upper"]
    discs = [Disc(*body["position"][:2], given["radius"]) for body, given in zip(summary["bodies"], scene["bodies"])]
    for i, disc in enumerate(discs):
        gaps = [disc.gap(other) for other in discs[:i]]
        gaps += [near - disc.radius for near in (disc.x, disc.y, upper[0] - disc.x, upper[1] - disc.y)]
        if min(gaps) < -DEEPEST:
            return f"disc{i} overlaps by {-min(gaps):.3g} d at the end"
    return ""


def run(scene: dict, folder: Path) -> dict:
    """How the programs did on a scene."""
    (folder / "case.toml").write_text(toml(scene))
    command = [str(ROOT / "fpi"), "run", str(folder / "case.toml"), "--out", str(folder / "run"), "--json", "--jobs", "1"]
    environment = os.environ | {"FPI_BIN": str(programs())}
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment) as process:
        try:
            out, err = process.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            process.terminate()  # the launcher takes its programs with it
            process.communicate()
            return {"failure": f"no end after {PATIENCE} s"}
    try:
        summary = json.loads(out)
    except json.JSONDecodeError:
        return {"failure": f"no summary: {(out + err).strip()}"}
    if "steps" not in summary:
        return {"failure": summary["reason"]}
    log = (folder / "run" / "coupler.log").read_text()
    found = {"rejected": len(re.findall(r"step \d+ to t = .* rejected", log)),
             "factorisations": (summary["factorisations"] or 0) / max(1, summary["steps"])}
    with (folder / "run" / "history.csv").open(newline="") as text:
        history = list(csv.DictReader(text))
    if history:
        found["sub_iterations"] = sum(float(row["sub_iterations"]) for row in history) / len(history)
    if summary["status"] != "completed":
        return found | {"failure": summary["reason"]}
    return found | {"failure": problem(summary, history, scene)}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", nargs="?", metavar="CASE", help="as --list names them")
    parser.add_argument("--list", type=int, metavar="N", help="about N cases, their names and what they are about")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--quick", action="store_true", help="coarser meshes and fewer steps")
    parser.add_argument("--scene", action="store_true", help="print the scene of the case and do not run it")
    arguments = parser.parse_args()
    if arguments.list:
        for name, family in FAMILIES.items():
            for number in range(max(1, round(family.share * arguments.list))):
                print(f"{name}-{number}\t{family.title}")
        return
    if not re.fullmatch(rf"({'|'.join(FAMILIES)})-\d+", arguments.case or ""):
        parser.error(f"a case named as --list does is required; got {arguments.case}")
    parameters, scene = case(arguments.case, arguments.seed, arguments.quick)
    if arguments.scene:
        print(toml(scene), end="")
        return
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        found = run(scene, Path(folder))
    print(json.dumps({"case": arguments.case, "refused": False, **found, "seconds": time.monotonic() - start,
                      "parameters": parameters}))


if __name__ == "__main__":
    main()
