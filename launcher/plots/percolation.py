"""What a scene with [percolation] found: pressure and porosity along the flow, the distribution of velocities, drag by grain."""

import csv
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.patches import Circle

from launcher.plots import results


def read_table(run: Path, name: str) -> dict[str, np.ndarray] | None:
    path = run / f"{name}.csv"
    if not path.exists():
        return None
    with results.reading(path), path.open(newline="") as file:
        rows = list(csv.DictReader(file))
        return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]} if rows else None


def figure(run: Path, scene: results.Scene):
    """Three panels, or None where the run has no such tables."""
    sections, velocities, grains = (read_table(run, name) for name in ("sections", "velocities", "grains"))
    if sections is None or velocities is None:
        return None
    whole, (along, speeds, drags) = plt.subplots(1, 3, figsize=(13, 3.8))
    place = next(iter(sections))
    along.plot(sections[place], sections["pressure"], "o-", markersize=3, label="mean pressure")
    along.set(xlabel=f"{place} [m]", ylabel=f"{scene.pressure_label}, mean of the section")
    porosity = along.twinx()
    porosity.plot(sections[place], sections["porosity"], color="0.6", linewidth=1)
    porosity.set(ylabel="porosity (grey)", ylim=(0, 1.05))
    width = velocities["to"] - velocities["from"]
    speeds.bar(velocities["from"], velocities["share"] / width, width, align="edge")
    speeds.set(xlabel=f"velocity along {place} [m/s]", ylabel="share of the fluid per velocity [s/m]")
    speeds.set_yscale("log")
    if grains is not None:
        discs = [Circle(centre, radius) for *centre, radius in zip(grains["x"], grains["y"], grains["radius"])]
        patches = PatchCollection(discs, cmap="viridis")
        patches.set_array(grains["drag"])
        drags.add_collection(patches)
        drags.set(aspect="equal", xlabel="x [m]", ylabel="y [m]")
        drags.autoscale_view()
        whole.colorbar(patches, ax=drags, label="drag [N]")
    for axis in (along, speeds):
        axis.grid(alpha=0.3)
    return whole
