"""The end of a run: a short table from its summary.json, and the names of the files it left."""

import json
from pathlib import Path

from launcher.common import Refusal

COUNTS = ("unknowns", "newton_iterations", "factorisations", "solves")
MOST_BODIES = 5
FILES = {
    "scene.toml": "the scene as run, every default filled in",
    "summary.json": "the figures of this table and more",
    "history.csv": "forces, positions and sub-iterations of every step",
    "fields.xdmf": "velocity and pressure, for ParaView",
    "fields.h5": "the same in HDF5",
    "bodies.h5": "positions, velocities, forces of the bodies",
    "interface.h5": "tractions on the bodies",
    "checkpoint.h5": "where `./fpi resume` continues",
    "coupler.log": "what the coupler did",
    "fluid_server.log": "what the fluid did",
    "dem_server.log": "what the grains did",
    "fluid_server.out": "what the program printed outside its log",
    "dem_server.out": "what the program printed outside its log",
}


def summary_of(run: Path) -> dict | None:
    """The summary of a run, or None where the coupler did not come to write one."""
    path = run / "summary.json"
    if not path.exists():
        return None
    try:
        return json.loads(path.read_text())
    except json.JSONDecodeError as error:
        raise Refusal(f"{path} must be JSON; it cannot be read: {error}") from error


def rows(summary: dict) -> list[tuple[str, str]]:
    """What is worth a line at the end of a run. Figures of a participant that was lost are null: left out."""
    iterations, seconds = summary["sub_iterations"], summary["wall_seconds"]
    lines = [("status", summary["status"] + (f": {summary['reason']}" if summary["reason"] else "")),
             ("steps", f"{summary['steps']}")]
    if iterations["max"]:
        lines.append(("sub-iterations", f"mean {iterations['mean']:.3g}, most {iterations['max']}"))
    if summary["unknowns"]:
        counts = [f"{summary[key]} {key.replace('_', ' ')}" for key in COUNTS if summary[key] is not None]
        lines.append(("fluid", ", ".join(counts)))
    for body in summary["bodies"][:MOST_BODIES]:
        lines.append((body["name"], f"at {vector(body['position'])} m, velocity {vector(body['velocity'])} m/s"))
    if len(summary["bodies"]) > MOST_BODIES:
        lines.append(("…", f"{len(summary['bodies']) - MOST_BODIES} more bodies"))
    for group in ("coefficients", "probes"):
        lines += [(name, f"{value:.8g}") for name, value in summary[group].items() if value is not None]
    parts = sorted(((value, key) for key, value in seconds.items() if key != "total" and value), reverse=True)[:4]
    spent = ", ".join(f"{key} {value:.1f}" for value, key in parts)
    lines.append(("wall time", f"{seconds['total']:.1f} s" + (f" ({spent})" if spent else "")))
    return lines


def vector(values) -> str:
    return "(" + ", ".join(f"{value:.4g}" for value in values) + ")"


def show(run: Path, summary: dict) -> None:
    print()
    for name, text in rows(summary):
        print(f"  {name:16s} {text}")
    print(f"\n  in {run}:")
    for name, text in FILES.items():
        if (run / name).exists():
            print(f"  {name:16s} {text}")
