"""`./fpi sweep`: a scene at every combination of some values, a run folder each, and a table of what came out."""

import contextlib
import csv
import io
import itertools
import json
import math
import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from launcher.common import Refusal, naming, read_text, replace_text
from launcher.run import report

GROUPS = ("drives", "coefficients", "probes", "percolation")  # of summary.json, whose figures get a column
LEADING = ("permeability", "superficial_velocity_x", "superficial_velocity_y", "pressure_gradient", "tortuosity")  # most wanted first


@dataclass
class Axis:
    """A key of the scene and the values it takes, as text."""
    key: str
    values: list[str]


@dataclass
class Point:
    """One value of each key."""
    values: dict[str, str]

    @property
    def overrides(self) -> list[str]:
        return [f"{key}={value}" for key, value in self.values.items()]

    @property
    def name(self) -> str:
        """A folder that the same values always have."""
        return "_".join(re.sub(r"[^A-Za-z0-9.+-]+", "_", f"{key.split('.')[-1]}_{value}").strip("_")
                        for key, value in self.values.items())


def parse(words: list[str]) -> list[Axis]:
    """`key=a,b,c` each; commas inside brackets or quotes belong to a value."""
    axes = []
    for word in words:
        key, equals, text = word.partition("=")
        values = [value for value in split(text) if value]
        if not (key and equals and values):
            raise Refusal(f"key=a,b,c is required; got {word!r}: name a key of the scene and its values")
        axes.append(Axis(key, values))
    twice = {axis.key for axis in axes if sum(other.key == axis.key for other in axes) > 1}
    if twice:
        raise Refusal(f"every key must come once; {', '.join(sorted(twice))} does not: put its values behind one")
    return axes


def split(text: str) -> list[str]:
    parts, depth, quote = [""], 0, ""
    for letter in text:
        quote = ("" if letter == quote else quote or letter) if letter in "\"'" else quote
        depth += 0 if quote else (letter in "[{") - (letter in "]}")
        if letter == "," and depth == 0 and not quote:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]


def points(axes: list[Axis]) -> list[Point]:
    all_points = [Point(dict(zip((axis.key for axis in axes), values)))
                  for values in itertools.product(*(axis.values for axis in axes))]
    names = [point.name for point in all_points]
    for point in all_points:
        if names.count(point.name) > 1:
            raise Refusal(f"values must differ in letters or digits, by which folders are named; more than one is {point.name}")
    return all_points


def state_of(folder: Path, fingerprint_of, wanted: int) -> str:
    """What is there of a point: "done", "begun" with a checkpoint, or "new"."""
    if not (folder / "scene.toml").is_file():
        if folder.exists() and not (folder.is_dir() and (run_began_in(folder) or not any(folder.iterdir()))):
            raise Refusal(f"a folder for a run is required; {folder} holds something else: give --out another folder")
        return "new"
    if fingerprint_of(folder / "scene.toml") != wanted:
        raise Refusal(f"{folder} holds a run of another scene: give --out another folder, or remove it")
    try:
        status = json.loads(read_text(folder / "summary.json"))["status"]
    except (OSError, ValueError, KeyError, TypeError, Refusal):
        status = ""
    if status == "completed":
        return "done"
    return "begun" if report.has_checkpoint(folder) else "new"


def run_began_in(folder: Path) -> bool:
    return any((folder / name).exists() for name in ("coupler.log", "summary.json"))


def figures(summary: dict) -> dict[str, float]:
    """The numbers of a summary that make a column."""
    found = {name: value for group in GROUPS for name, value in summary.get(group, {}).items()}
    found["balance"] = summary.get("force_balance", {}).get("rest")
    found["unknowns"] = summary.get("unknowns")
    found["seconds"] = summary.get("wall_seconds", {}).get("total")
    return {name: value for name, value in found.items() if value is not None}


@dataclass
class Row:
    point: Point
    status: str
    figures: dict[str, float]
    reason: str = ""  # of a failure


def columns(rows: list[Row]) -> list[str]:
    return list(dict.fromkeys(name for row in rows for name in row.figures))


def write(path: Path, rows: list[Row]) -> None:
    names, text = columns(rows), io.StringIO()
    writer = csv.writer(text)
    writer.writerow([*rows[0].point.values, "status", *names])
    for row in rows:
        writer.writerow([*row.point.values.values(), row.status, *(row.figures.get(name, "") for name in names)])
    replace_text(path, text.getvalue())


def table(rows: list[Row]) -> str:
    """The swept values and what is wanted most, for the terminal."""
    names = columns(rows)
    shown = [name for name in names if name in LEADING] or [name for name in names if name not in ("balance", "unknowns", "seconds")]
    head = [*rows[0].point.values, *shown[:6], "balance", "seconds"]
    lines = [head] + [[*row.point.values.values(), *(number(row.figures.get(name)) for name in head[len(row.point.values):])]
                      if row.status == "completed" else [*row.point.values.values(), row.status] for row in rows]
    widths = [max(len(line[k]) for line in lines if k < len(line)) for k in range(len(head))]
    return "\n".join("  ".join(cell.rjust(width) for cell, width in zip(line, widths)) for line in lines)


def number(value: float | None) -> str:
    return "-" if value is None else f"{value:.5g}"


# ---- Darcy and Forchheimer ---------------------------------------------------------------------------------------

DRIVES = ("pressure_drop", "superficial_velocity", "traction", "flow_rate", "velocity")


@dataclass
class Medium:
    """What flows, and along which axis."""
    density: float    # ρ [kg/m³]
    viscosity: float  # μ [Pa s]
    direction: str


def medium(scene: Path) -> Medium:
    fluid = tomllib.loads(read_text(scene))
    direction = fluid.get("percolation", {}).get("direction", "x")
    fluid = fluid["fluid"]
    return Medium(fluid["density"], fluid.get("dynamic_viscosity") or fluid["kinematic_viscosity"] * fluid["density"], direction)


@dataclass
class Fit:
    """−∇p = μ/k U + ρβ U²."""
    of: dict[str, str]     # the values that its points share
    permeability: float    # k [m²]
    inertia: float         # β [1/m]
    misfit: float          # root of the mean square of what is left, over −∇p


def is_drive(key: str) -> bool:
    return any(part.startswith(DRIVES) for part in key.split("."))


def fits(rows: list[Row], of: Medium) -> Iterator[Fit]:
    """One for each set of the other values, where the drive takes three values or more."""
    velocity = f"superficial_velocity_{of.direction}"
    groups: dict[tuple, list[Row]] = {}
    for row in rows:
        if {velocity, "pressure_gradient"} <= row.figures.keys():
            groups.setdefault(tuple((k, v) for k, v in row.point.values.items() if not is_drive(k)), []).append(row)
    for shared, members in groups.items():
        flow = [(row.figures[velocity], -row.figures["pressure_gradient"]) for row in members]
        if len(flow) < 3:
            continue
        a, b = least_squares([(u / g, u * abs(u) / g) for u, g in flow])
        misfit = math.sqrt(sum((a * u / g + b * u * abs(u) / g - 1) ** 2 for u, g in flow) / len(flow))
        yield Fit(dict(shared), of.viscosity / a, b / of.density, misfit)


def least_squares(terms: list[tuple[float, float]]) -> tuple[float, float]:
    """a, b with a s + b t nearest to 1."""
    ss, st, tt = (sum(one[i] * one[j] for one in terms) for i, j in ((0, 0), (0, 1), (1, 1)))
    s, t = (sum(one[i] for one in terms) for i in (0, 1))
    determinant = ss * tt - st * st
    if determinant <= 1e-12 * ss * tt:
        raise Refusal("flows of different rates are required for Darcy's and Forchheimer's law; all are the same")
    return (s * tt - t * st) / determinant, (t * ss - s * st) / determinant


def describe(fit: Fit) -> str:
    shared = "".join(f"{key} = {value}: " for key, value in fit.of.items())
    return (f"{shared}-grad p = mu/k U + rho beta U^2 with k = {fit.permeability:.6g} m^2, beta = {fit.inertia:.6g} 1/m; "
            f"what is left is {fit.misfit:.2g} of -grad p")


def draw_fits(path: Path, rows: list[Row], found: list[Fit], of: Medium) -> None:
    """The pressure gradient over the velocity, with the laws that fit it."""
    velocity = f"superficial_velocity_{of.direction}"
    flow = [(row.figures[velocity], -row.figures["pressure_gradient"]) for row in rows if velocity in row.figures]
    with chart(path) as axis:
        axis.plot(*zip(*flow), "o", markersize=4)
        for fit in found:
            u = [max(one[0] for one in flow) * k / 100 for k in range(101)]
            axis.plot(u, [of.viscosity / fit.permeability * one + of.density * fit.inertia * one**2 for one in u], linewidth=1,
                      label=f"k = {fit.permeability:.3g} m², β = {fit.inertia:.3g} 1/m")
        axis.set(xlabel="superficial velocity [m/s]", ylabel="−∇p [Pa/m]")
        axis.legend(fontsize=8)


def draw(path: Path, rows: list[Row]) -> None:
    """What is wanted most over the values of the first key, a line for each set of the others."""
    wanted = next((name for name in LEADING if name in columns(rows)), columns(rows)[0])
    key = next(iter(rows[0].point.values))
    with chart(path) as axis:
        lines: dict[str, list[Row]] = {}
        for row in rows:
            lines.setdefault(", ".join(f"{k} = {v}" for k, v in row.point.values.items() if k != key), []).append(row)
        for label, members in lines.items():
            axis.plot([row.point.values[key] for row in members], [row.figures.get(wanted, math.nan) for row in members],
                      "o-", markersize=4, label=label)
        axis.set(xlabel=key, ylabel=wanted.replace("_", " "))
        if len(lines) > 1:
            axis.legend(fontsize=8)


@contextlib.contextmanager
def chart(path: Path):
    """A pair of axes that is written to `path`."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axis = plt.subplots(figsize=(5.2, 3.8), layout="constrained")
    yield axis
    axis.grid(alpha=0.3)
    with naming(path):
        figure.savefig(path, dpi=150)
    plt.close(figure)
