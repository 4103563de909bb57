"""Maps of the plane: speed with arrows, pressure."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.patches import Polygon
from matplotlib.path import Path
from matplotlib.tri import LinearTriInterpolator, Triangulation

from launcher.plots import results

MOST_SNAPSHOTS = 4
ARROWS = 250  # in a map, about
SMALLEST_ARROW = 0.08  # of the largest; a shorter one is only a dot


def speeds(fields: results.Fields, bodies: results.Bodies | None, scene: results.Scene):
    """The speed, with arrows of the velocity over it."""

    def add_arrows(axis, shot, high):
        at, velocity, spacing = sampled_velocity(fields, shot, bodies)
        axis.quiver(*at.T, *velocity.T, color="white", alpha=0.8, angles="xy", scale_units="xy",
                    scale=max(high, 1e-300) / (1.6 * spacing), width=0.09 * spacing, units="xy", headwidth=3.5)

    return snapshots(fields, bodies, scene, lambda shot: shot.speed, "speed [m/s]", colours="viridis", tail=0.1, decorate=add_arrows)


def pressures(fields: results.Fields, bodies: results.Bodies | None, scene: results.Scene):
    """The pressure; colours leave out its extreme hundredths, which corners would take for themselves."""

    def pressure(shot):
        return shown_pressure(fields, shot, scene)

    return snapshots(fields, bodies, scene, pressure, scene.pressure_label, colours="RdBu_r", tail=1.0)


def shown_pressure(fields: results.Fields, shot: results.Snapshot, scene: results.Scene) -> np.ndarray:
    """The pressure, less its mean where only differences of it matter."""
    return shot.pressure - (mean(visible(fields, shot), shot.pressure) if scene.closed else 0.0)


def visible(fields: results.Fields, snapshot: results.Snapshot) -> Triangulation:
    """The triangles outside bodies."""
    return Triangulation(*fields.points.T, fields.triangles, mask=np.repeat(~snapshot.active, 4))


def mean(triangles: Triangulation, values: np.ndarray) -> float:
    """The mean over the area of what is visible."""
    shown = triangles.get_masked_triangles()
    x, y = triangles.x[shown], triangles.y[shown]
    area = np.abs((x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0]))
    return float(np.average(values[shown].mean(axis=1), weights=area)) if area.sum() > 0 else 0.0


def sampled_velocity(fields: results.Fields, shot: results.Snapshot, bodies: results.Bodies | None):
    """Points of a regular grid in the fluid where it moves, the velocities there, and the spacing [m]."""
    lower, upper = fields.points.min(axis=0), fields.points.max(axis=0)
    spacing = np.sqrt(np.prod(upper - lower) / ARROWS)
    counts = np.maximum(np.rint((upper - lower) / spacing), 1).astype(int)
    grid = np.meshgrid(*(low + (high - low) * (np.arange(n) + 0.5) / n for low, high, n in zip(lower, upper, counts)))
    at = np.stack([axis.ravel() for axis in grid], axis=1)
    triangles = visible(fields, shot)
    velocity = np.ma.stack([LinearTriInterpolator(triangles, part)(*at.T) for part in shot.velocity.T], axis=1)
    shown = ~np.ma.getmaskarray(velocity).any(axis=1)
    if bodies is not None:
        for outline in bodies.images(shot.time):
            shown &= ~Path(outline).contains_points(at)
    size = np.linalg.norm(velocity.filled(0.0), axis=1)
    shown &= size > SMALLEST_ARROW * size.max(initial=0.0)
    return at[shown], velocity.data[shown], spacing


def limits(values: np.ndarray, tail: float) -> tuple[float, float]:
    """Range of colours: all but `tail` per cent at either end, symmetric where signs mix."""
    low, high = np.percentile(values, [tail, 100 - tail])
    if low < 0 < high:
        low, high = -max(-low, high), max(-low, high)
    return (low, high) if high > low else (low - 1, high + 1)


def snapshots(fields, bodies, scene, quantity, label, colours, tail, decorate=None):
    """One quantity at up to four times (not the start, if there are more), side by side in a tall domain and stacked in
    a wide one."""
    chosen = np.unique(np.linspace(0, len(fields) - 1, MOST_SNAPSHOTS + 1).round().astype(int))[-MOST_SNAPSHOTS:]
    shots = [fields.snapshot(index) for index in chosen]
    values = [quantity(shot) for shot in shots]
    shown = [value[np.unique(fields.triangles[np.repeat(shot.active, 4)])] for value, shot in zip(values, shots)]
    low, high = limits(np.concatenate(shown), tail)
    width, height = np.ptp(fields.points, axis=0)
    wide = width > height
    scale = (8.0 if wide else 6.5) / max(width, height)
    rows, columns = (len(shots), 1) if wide else (1, len(shots))
    size = (columns * (width * scale + 0.9) + 0.8, rows * (height * scale + 0.8))
    figure, axes = plt.subplots(rows, columns, figsize=size, squeeze=False, sharex=True, sharey=True)
    for axis, shot, value in zip(axes.flat, shots, values):
        image = panel(axis, fields, shot, value, bodies, scene, cmap=colours, vmin=low, vmax=high)
        if decorate is not None:
            decorate(axis, shot, high)
    figure.colorbar(image, ax=axes, label=label, shrink=0.8, pad=0.02, extend="both" if tail >= 1 else "neither")
    return figure


def panel(axis, fields, shot, value, bodies, scene, **colours):
    """One quantity at one time with the bodies in it, as far as the mesh goes."""
    image = axis.tripcolor(visible(fields, shot), value, shading="gouraud", **colours)
    if bodies is not None:
        add_bodies(axis, bodies, shot.time)
    (left, bottom), (right, top) = fields.points.min(axis=0), fields.points.max(axis=0)
    axis.set(xlim=(left, right), ylim=(bottom, top))
    finish_map(axis, scene.when(shot.time), shared=True)
    return image


def add_bodies(axis, bodies: results.Bodies, time: float) -> None:
    outlines = [Polygon(outline) for outline in bodies.images(time)]
    axis.add_collection(PatchCollection(outlines, facecolor="0.88", edgecolor="0.15", linewidth=0.8, zorder=3))


def finish_map(axis, title: str, shared: bool = False) -> None:
    """Aspect, title and labels; of axes that share their limits only the outer ones have labels."""
    axis.set_aspect("equal")
    axis.set(title=title, xlabel="x [m]", ylabel="y [m]")
    if shared:
        axis.label_outer()
