"""Pictures of a run: speed and pressure at some times, tractions on the bodies, trajectories, history."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of the backend)
import numpy as np  # noqa: E402
from matplotlib.collections import PatchCollection  # noqa: E402
from matplotlib.patches import Circle  # noqa: E402
from matplotlib.tri import Triangulation  # noqa: E402

from launcher import results  # noqa: E402
from launcher.common import Refusal  # noqa: E402

STYLE = {"figure.dpi": 130, "savefig.dpi": 130, "font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
         "axes.grid": False, "legend.frameon": False, "figure.constrained_layout.use": True}
MOST_SNAPSHOTS = 4


def draw(run: Path) -> list[Path]:
    """Draws what the run has into RUN/plots and returns the pictures."""
    if not run.is_dir():
        raise Refusal(f"a run folder is required; there is no {run}")
    folder = run / "plots"
    fields, bodies = results.read_fields(run), results.read_bodies(run)
    tractions, history = results.read_strongest_tractions(run), results.read_history(run)
    pictures = []

    def save(figure, name):
        folder.mkdir(exist_ok=True)
        pictures.append(folder / name)
        figure.savefig(pictures[-1])
        plt.close(figure)

    with plt.rc_context(STYLE):
        if fields is not None and len(fields) > 0:
            save(snapshots(fields, bodies, speed, "speed [m/s]", "viridis"), "speed.png")
            save(snapshots(fields, bodies, pressure, "pressure [Pa]", "RdBu_r"), "pressure.png")
        if tractions is not None and bodies is not None:
            save(traction_vectors(tractions, bodies, fields), "traction.png")
        if bodies is not None and len(bodies.time) > 1:
            save(trajectories(bodies), "trajectories.png")
        if len(history.get("time", [])) > 1:
            save(curves(history), "history.png")
    if fields is not None:
        fields.file.close()
    if not pictures:
        raise Refusal(f"{run} holds no results to draw (fields.h5, bodies.h5, interface.h5, history.csv)")
    return pictures


def speed(snapshot: results.Snapshot) -> np.ndarray:
    return np.linalg.norm(snapshot.velocity, axis=1)


def pressure(snapshot: results.Snapshot) -> np.ndarray:
    return snapshot.pressure


def visible(fields: results.Fields, snapshot: results.Snapshot) -> Triangulation:
    """The triangles outside bodies."""
    return Triangulation(*fields.points.T, fields.triangles, mask=np.repeat(~snapshot.active, 4))


def limits(values: list[np.ndarray]) -> tuple[float, float]:
    """Range of colours: all but the extreme thousandths (corner singularities), symmetric where signs mix."""
    low, high = np.percentile(np.concatenate(values), [0.1, 99.9])
    if low < 0 < high:
        low, high = -max(-low, high), max(-low, high)
    return (low, high) if high > low else (low - 1, high + 1)


def snapshots(fields: results.Fields, bodies: results.Bodies | None, quantity, label: str, colours: str):
    """One quantity at up to four times (not the start, if there are more), side by side in a tall domain and stacked in a wide one."""
    chosen = np.unique(np.linspace(0, len(fields) - 1, MOST_SNAPSHOTS + 1).round().astype(int))[-MOST_SNAPSHOTS:]
    shots = [fields.snapshot(index) for index in chosen]
    values = [quantity(shot) for shot in shots]
    shown = [value[np.unique(fields.triangles[np.repeat(shot.active, 4)])] for value, shot in zip(values, shots)]
    low, high = limits(shown)
    width, height = np.ptp(fields.points, axis=0)
    wide = width > height
    scale = (8.0 if wide else 6.5) / max(width, height)
    rows, columns = (len(shots), 1) if wide else (1, len(shots))
    size = (columns * (width * scale + 0.9) + 0.8, rows * (height * scale + 0.8))
    figure, axes = plt.subplots(rows, columns, figsize=size, squeeze=False, sharex=True, sharey=True)
    for axis, shot, value in zip(axes.flat, shots, values):
        image = axis.tripcolor(visible(fields, shot), value, shading="gouraud", cmap=colours, vmin=low, vmax=high)
        add_bodies(axis, bodies, shot.time)
        axis.autoscale(tight=True)
        finish_map(axis, f"t = {shot.time:.4g} s" if len(shots) > 1 else "")
    figure.colorbar(image, ax=axes, label=label, shrink=0.8, pad=0.02)
    return figure


def add_bodies(axis, bodies: results.Bodies | None, time: float) -> None:
    if bodies is None:
        return
    circles = [Circle(centre[:2], radius) for centre, radius in zip(bodies.at(time), bodies.radius)]
    axis.add_collection(PatchCollection(circles, facecolor="0.85", edgecolor="0.15", linewidth=0.8, zorder=3))


def finish_map(axis, title: str) -> None:
    axis.set_aspect("equal")
    axis.set_title(title)
    axis.set_xlabel("x [m]")
    axis.label_outer()
    if axis.get_subplotspec().is_first_col():
        axis.set_ylabel("y [m]")


def traction_vectors(tractions: results.Tractions, bodies: results.Bodies, fields: results.Fields | None):
    """The force density of the fluid on the bodies, over the speed around them."""
    figure, axis = plt.subplots(figsize=(6.5, 6))
    radius = bodies.radius[tractions.body]
    normal = np.stack([np.cos(tractions.angle), np.sin(tractions.angle)], axis=1)
    at = tractions.centre[tractions.body] + radius[:, None] * normal
    if fields is not None and len(fields) > 0:
        index = int(np.argmin([abs(fields.time(i) - tractions.time) for i in range(len(fields))]))
        shot = fields.snapshot(index)
        value = speed(shot)
        image = axis.tripcolor(visible(fields, shot), value, shading="gouraud", cmap="viridis",
                               vmin=0, vmax=max(value.max(), 1e-300))
        figure.colorbar(image, ax=axis, label="speed [m/s]", shrink=0.8)
    circles = [Circle(centre, r) for centre, r in zip(tractions.centre, bodies.radius)]
    axis.add_collection(PatchCollection(circles, facecolor="0.92", edgecolor="0.15", linewidth=0.8, zorder=3))
    size = np.linalg.norm(tractions.traction, axis=1)
    largest = max(size.max(), 1e-300)
    arrows = axis.quiver(*at.T, *tractions.traction.T, color="crimson", angles="xy", zorder=4,
                         scale=largest / bodies.radius.max(), scale_units="xy", width=0.004)
    axis.quiverkey(arrows, 0.8, 0.04, largest, f"{largest:.3g} Pa", labelpos="E", color="crimson", labelcolor="white", zorder=5)
    margin = 2.5 * bodies.radius.max()
    axis.set_xlim(at[:, 0].min() - margin, at[:, 0].max() + margin)
    axis.set_ylim(at[:, 1].min() - margin, at[:, 1].max() + margin)
    finish_map(axis, f"traction of the fluid on the bodies, t = {tractions.time:.4g} s")
    axis.spines[:].set_visible(True)
    return figure


def trajectories(bodies: results.Bodies):
    """Paths in the plane, heights and speeds over time."""
    figure, (path, height, fast) = plt.subplots(1, 3, figsize=(11, 4))
    for i, name in enumerate(bodies.names):
        x, y = bodies.position[:, i, 0], bodies.position[:, i, 1]
        path.plot(x, y, label=name)
        height.plot(bodies.time, y)
        fast.plot(bodies.time, np.linalg.norm(bodies.velocity[:, i], axis=1))
    reach = bodies.radius.max()
    path.set_xlim(bodies.position[..., 0].min() - 2 * reach, bodies.position[..., 0].max() + 2 * reach)
    path.set_aspect("equal", adjustable="datalim")
    for axis, labels in ((path, ("x [m]", "y [m]")), (height, ("t [s]", "y of the centre [m]")),
                         (fast, ("t [s]", "speed [m/s]"))):
        axis.set(xlabel=labels[0], ylabel=labels[1])
        axis.grid(alpha=0.3)
    if len(bodies.names) <= 12:
        path.legend(fontsize=8)
    return figure


def curves(history: dict[str, np.ndarray]):
    """What the history holds besides positions: forces, coefficients, probes, iterations, residuals."""
    own = {"time", "step", "sub_iterations", "residual_velocity", "residual_force", "newton_iterations"}
    forces = [name for name in history if name.endswith((".fx", ".fy"))]
    others = [name for name in history if name not in own and "." not in name]
    panels = [("force on the bodies [N]", forces[:12], False)] if forces else []
    panels += [("coefficients" if name in ("drag", "lift") else name, [name], False) for name in others]
    panels += [("iterations a step", ["sub_iterations", "newton_iterations"], False),
               ("relative change", ["residual_velocity", "residual_force"], True)]
    figure, axes = plt.subplots(len(panels), 1, figsize=(8, 2.3 * len(panels)), sharex=True, squeeze=False)
    for axis, (label, names, logarithmic) in zip(axes.flat, panels):
        for name in names:
            values = history[name]
            values = np.where(values > 0, values, np.nan) if logarithmic else values
            axis.plot(history["time"], values, label=name.replace("_", " "), linewidth=1.1)
        if logarithmic and any((history[name] > 0).any() for name in names):
            axis.set_yscale("log")
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    axes[-1, 0].set_xlabel("t [s]")
    return figure
