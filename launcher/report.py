"""The end of a run: a short table from its summary.json, and the names of the files it left."""

import json
from pathlib import Path

from launcher.common import Refusal

FILES = {
    "scene.toml": "the scene as run, every default filled in",
    "summary.json": "the figures of this table and more",
    "history.csv": "forces, positions and sub-iterations of every step",
    "fields.xdmf": "velocity and pressure, for ParaView",
    "fields.h5": "the same in HDF5",
    "bodies.xdmf": "bodies over time, for ParaView",
    "bodies.h5": "positions, velocities, forces of the bodies",
    "interface.xdmf": "tractions on the bodies, for ParaView",
    "interface.h5": "tractions on the bodies",
    "checkpoint.h5": "where `./fpi resume` continues",
    "coupler.log": "what each program did",
    "fluid_server.log": "",
    "dem_server.log": "",
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
    """What is worth a line at the end of a run."""
    iterations = summary.get("sub_iterations") or {}
    seconds = summary.get("wall_seconds") or {}
    lines = [("status", summary["status"] + (f": {summary['reason']}" if summary.get("reason") else ""))]
    lines.append(("steps", f"{summary.get('steps', 0)}"))
    if iterations.get("max"):
        lines.append(("sub-iterations", f"mean {iterations['mean']:.3g}, most {iterations['max']:g}"))
    if summary.get("unknowns"):
        lines.append(("fluid", f"{summary['unknowns']:g} unknowns, {summary.get('newton_iterations', 0):g} Newton "
                      f"iterations, {summary.get('factorisations', 0):g} factorisations, "
                      f"{summary.get('solves', 0):g} solves"))
    for body in (summary.get("bodies") or [])[:5]:
        lines.append((body["name"], f"at {vector(body['position'])} m, velocity {vector(body['velocity'])} m/s"))
    for name, value in (summary.get("coefficients") or {}).items():
        lines.append((name, f"{value:.8g}"))
    for name, value in (summary.get("probes") or {}).items():
        lines.append((name, f"{value:.8g}"))
    parts = sorted(((value, key) for key, value in seconds.items() if key != "total"), reverse=True)[:4]
    lines.append(("wall time", f"{seconds.get('total', 0):.1f} s (" +
                  ", ".join(f"{key} {value:.1f}" for value, key in parts) + ")"))
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
