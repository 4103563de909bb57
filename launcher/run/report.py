"""The end of a run: a short table from its summary.json, and the names of the files it left."""

import json
from pathlib import Path

from launcher.common import Refusal, read_text

MOST_LOADS = 6  # bodies, and boundaries, that have a line each
WORTH_A_WORD = 0.01  # leak of outlines over the flow
FILES = {
    "scene.toml": "the scene as run, every default filled in",
    "summary.json": "the figures of this table and more",
    "history.csv": "forces, positions and sub-iterations of every step",
    "extrema.csv": "extrema, means and frequencies of coefficients and probes",
    "fields.xdmf": "velocity and pressure, for ParaView",
    "fields.h5": "the same in HDF5",
    "bodies.h5": "positions, velocities, forces of the bodies",
    "final_bodies.csv": "where the free bodies are at the end",
    "left_bodies.csv": "the bodies that left: when, where, how fast",
    "interface.h5": "tractions on the bodies",
    "boundaries.h5": "tractions on the fitted boundaries",
    "profiles.h5": "quantities along segments",
    "sections.csv": "means over slabs across the flow",
    "velocities.csv": "how the fluid's velocities are distributed",
    "grains.csv": "drag, lift and torque of every body",
    "checkpoint.bin": "where `./fpi resume` continues",
    "checkpoint.previous.bin": "the checkpoint before it, should it be damaged",
    "coupler.log": "what the coupler did",
    "fluid_server.log": "what the fluid did",
    "dem_server.log": "what the grains did",
    "fluid_server.out": "what the program printed outside its log",
    "dem_server.out": "what the program printed outside its log",
}


def has_checkpoint(run: Path) -> bool:
    return any(run.glob("checkpoint*.bin"))


def summary_of(run: Path) -> dict | None:
    """The summary of a run, or None where the coupler did not come to write one."""
    path = run / "summary.json"
    if not path.exists():
        return None
    try:
        summary = json.loads(read_text(path))
        return {"reason": "", **summary, "status": summary["status"]}
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise Refusal(f"{path} must be JSON with a status; it cannot be read: {error}") from error


def coupling(figures: dict) -> list[tuple[str, str]]:
    """What the coupling had to do besides, where there was anything, and how long each program was waited for."""
    lines = []
    counts = {"rejected steps": figures.get("rejected_steps"), "repeated steps": figures.get("repeated_steps"),
              "cuts anew": figures.get("recuts"), **{f"stalls: {remedy.replace('_', ' ')}": count
                                                     for remedy, count in figures.get("stalls", {}).items()}}
    if any(counts.values()):
        lines.append(("again", ", ".join(f"{name} {count}" for name, count in counts.items() if count)))
    worst = figures.get("worst_body", {})
    if worst.get("name"):
        lines.append(("worst body", f"{worst['name']}, in {worst['steps']} steps"))
    if figures.get("waited_for"):
        lines.append(("waited for", ", ".join(f"{role} {seconds:.3g} s" for role, seconds in figures["waited_for"].items())))
    return lines


def rows(summary: dict) -> list[tuple[str, str]]:
    """What is worth a line at the end of a run. Figures of a participant that was lost are null: left out."""
    iterations = summary["sub_iterations"]
    lines = [("status", summary["status"] + (f": {summary['reason']}" if summary["reason"] else "")),
             ("steps", f"{summary['steps']}")]
    if not summary["steps"]:
        return lines + costs(summary)  # where the bodies start is no result
    if iterations["max"]:
        lines.append(("sub-iterations", f"mean {iterations['mean']:.3g}, most {iterations['max']}"))
    lines += coupling(summary.get("coupling", {}))
    for body in summary["bodies"][:MOST_LOADS]:
        lines.append((body["name"], f"at {vector(body['position'])} m, velocity {vector(body['velocity'])} m/s, "
                                    + load(body)))
    if len(summary["bodies"]) > MOST_LOADS:
        lines.append(("…", f"{len(summary['bodies']) - MOST_LOADS} more bodies"))
    lines += [(one["name"], f"{one['count']} grains around {vector(one['position'])} m, mean velocity "
                            f"{vector(one['velocity'])} m/s, kinetic energy {one['kinetic_energy']:.4g} J"
                            if one["count"] else "no grain is left")
              for one in summary.get("grains", [])]
    if summary.get("onset"):
        onset = summary["onset"]
        lines.append(("onset of motion", f"{onset['body']} at t = {onset['time']:.5g} s, " + ", ".join(
            f"{name} {value:.5g}" for name, value in onset["drives"].items() if value is not None)))
    lines += [(f"left {one['name']}", f"{one['count']} bodies of {one['mass']:.6g} kg with a momentum of "
                                      f"{vector(one['momentum'])} kg m/s")
              for one in summary.get("outlets", [])]
    lines += [(one["name"], load(one)) for one in summary.get("boundaries", [])[:MOST_LOADS] if None not in one["force"]]
    for group in ("drives", "percolation", "coefficients", "probes"):
        lines += [(name, f"{value:.8g}") for name, value in summary.get(group, {}).items() if value is not None]
    lines += [(f"{name}(t)", signal(one)) for name, one in summary.get("signals", {}).items()]
    lines += [(name, f"{one['min']:.7g} at {vector(one['min_at'])} m to {one['max']:.7g} at {vector(one['max_at'])} m")
              for name, one in summary.get("profiles", {}).items() if one["min"] is not None]
    if summary.get("force_balance"):
        lines.append(("force balance", f"the forces on the fluid add up to {summary['force_balance']['rest']:.1e} of the largest"))
    if words := leak(summary.get("volume_balance") or {}):
        lines.append(("fluid's volume", words))
    if summary.get("errors"):
        lines.append(("errors", ", ".join(f"{name.replace('_', ' ')} {value:.3e}"
                                          for name, value in summary["errors"].items())))
    for role, counts in summary.get("counts", {}).items():
        if counts:
            lines.append((role, ", ".join(f"{value:g} {name.replace('_', ' ')}" for name, value in counts.items())))
    return lines + costs(summary)


def leak(balance: dict[str, float]) -> str:
    """What outlines leak of the flow through the sides, and what to do where that is much; empty without either."""
    flow = max((abs(value) for name, value in balance.items() if name.startswith("boundary:")), default=0)
    if flow == 0 or "leak" not in balance:
        return ""
    share = abs(balance["leak"]) / flow
    text = f"outlines leak {share:.2%} of the flow through the sides"
    return text if share < WORTH_A_WORD else text + ": smaller triangles leak less, or a smaller fluid.embedding.arc_ratio, not below 0.9"


def costs(summary: dict) -> list[tuple[str, str]]:
    """Wall time, of a step and by part, the largest first; peak memory by program."""
    seconds, memory = summary["wall_seconds"], summary.get("peak_memory_bytes", {})
    parts = sorted(((value, key) for key, value in seconds.items() if key != "total" and value), reverse=True)
    spent = ", ".join(f"{key} {value:.2g}" for value, key in parts)
    steps = summary["steps"] - summary.get("steps_before", 0)
    total = f"{seconds['total']:.1f} s" + (f", {seconds['total'] / steps:.2g} s a step" if steps > 1 else "")
    lines = [("wall time", total + (f" ({spent})" if spent else ""))]
    peaks = ", ".join(f"{program} {size / 2**20:.0f} MB" for program, size in memory.items() if size)
    return lines + ([("peak memory", peaks)] if peaks else [])


def load(one: dict) -> str:
    """Force and torque of a body or a boundary in the plane."""
    return f"force {vector(one['force'][:2])} N, torque {one['torque'][2]:.4g} N m"


def signal(one: dict) -> str:
    """Extrema, mean and oscillation of a coefficient or a probe."""
    text = f"{one['min']:.7g} to {one['max']:.7g}, mean {one['mean']:.7g}"
    if "frequency" in one:
        text += f", {one['frequency']:.5g} Hz over {one['periods']} periods" + ("" if one["settled"] else " (not settled)")
    return text + (f", St {one['strouhal']:.5g}" if "strouhal" in one else "")


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
