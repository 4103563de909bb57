"""Maps of the plane: speed with arrows, pressure, tractions on the bodies."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.patches import Circle
from matplotlib.tri import LinearTriInterpolator, Triangulation

from launcher import results

MOST_SNAPSHOTS = 4
ARROWS = 250  # in a map, about
SMALLEST_ARROW = 0.08  # of the largest; a shorter one is only a dot


def speeds(fields: results.Fields, bodies: results.Bodies | None, scene: results.Scene):
    """The speed, with arrows of the velocity over it."""

    def add_arrows(axis, shot, high):
        at, velocity, spacing = sampled_velocity(fields, shot, bodies)
        axis.quiver(*at.T, *velocity.T, color="white", alpha=0.8, angles="xy", scale_units="xy",
                    scale=max(high, 1e-300) / (1.6 * spacing), width=0.09 * spacing, units="xy", headwidth=3.5)

    def speed(shot):
        return np.linalg.norm(shot.velocity, axis=1)

    return snapshots(fields, bodies, scene, speed, "speed [m/s]", colours="viridis", tail=0.1, decorate=add_arrows)


def pressures(fields: results.Fields, bodies: results.Bodies | None, scene: results.Scene):
    """The pressure; colours leave out its extreme hundredths, which corners would take for themselves."""

    def pressure(shot):
        return shot.pressure - (mean(visible(fields, shot), shot.pressure) if scene.closed else 0.0)

    label = "reduced pressure [Pa]" if scene.heavy else "pressure [Pa]"
    return snapshots(fields, bodies, scene, pressure, label, colours="RdBu_r", tail=1.0)


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
        for centre, radius in zip(bodies.at(shot.time), bodies.radius):
            shown &= np.linalg.norm(at - centre[:2], axis=1) > radius
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
        image = axis.tripcolor(visible(fields, shot), value, shading="gouraud", cmap=colours, vmin=low, vmax=high)
        if decorate is not None:
            decorate(axis, shot, high)
        if bodies is not None:
            add_discs(axis, bodies.at(shot.time)[:, :2], bodies.radius)
        axis.autoscale(tight=True)
        finish_map(axis, scene.when(shot.time))
    figure.colorbar(image, ax=axes, label=label, shrink=0.8, pad=0.02, extend="both" if tail >= 1 else "neither")
    return figure


def add_discs(axis, centres: np.ndarray, radii: np.ndarray) -> None:
    circles = [Circle(centre, radius) for centre, radius in zip(centres, radii)]
    axis.add_collection(PatchCollection(circles, facecolor="0.88", edgecolor="0.15", linewidth=0.8, zorder=3))


def finish_map(axis, title: str) -> None:
    axis.set_aspect("equal")
    axis.set_title(title)
    axis.set_xlabel("x [m]")
    axis.label_outer()
    if axis.get_subplotspec().is_first_col():
        axis.set_ylabel("y [m]")


def traction_vectors(tractions: results.Tractions, bodies: results.Bodies, fields: results.Fields | None,
                     scene: results.Scene):
    """The force density of the fluid on the bodies, over the speed around them."""
    figure, axis = plt.subplots(figsize=(6.5, 6))
    radius = bodies.radius[tractions.body]
    normal = np.stack([np.cos(tractions.angle), np.sin(tractions.angle)], axis=1)
    at = tractions.centre[tractions.body] + radius[:, None] * normal
    if fields is not None and len(fields) > 0:
        index = int(np.argmin([abs(fields.time(i) - tractions.time) for i in range(len(fields))]))
        shot = fields.snapshot(index)
        value = np.linalg.norm(shot.velocity, axis=1)
        image = axis.tripcolor(visible(fields, shot), value, shading="gouraud", cmap="viridis",
                               vmin=0, vmax=max(value.max(), 1e-300))
        figure.colorbar(image, ax=axis, label="speed [m/s]", shrink=0.8)
    add_discs(axis, tractions.centre, bodies.radius)
    largest = max(np.linalg.norm(tractions.traction, axis=1).max(), 1e-300)
    axis.quiver(*at.T, *tractions.traction.T, color="crimson", angles="xy", zorder=4,
                scale=largest / bodies.radius.max(), scale_units="xy", width=0.004)
    margin = 2.5 * bodies.radius.max()
    axis.set_xlim(at[:, 0].min() - margin, at[:, 0].max() + margin)
    axis.set_ylim(at[:, 1].min() - margin, at[:, 1].max() + margin)
    finish_map(axis, f"traction of the fluid on the bodies, {scene.when(tractions.time)}\n"
                     f"(longest arrow: {largest:.3g} Pa)")
    axis.spines[:].set_visible(True)
    return figure
