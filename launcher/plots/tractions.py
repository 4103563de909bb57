"""Traction vectors of the fluid: on bodies and obstacles side by side at one scale, and on the sides of the domain."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap

from launcher.plots import maps, obstacles, results

MOST_PANELS = 6
PALE = ListedColormap(0.5 + 0.5 * np.array(plt.get_cmap("viridis").colors))
ARROWS = 70  # on one outline, about


def on_obstacles(tractions: results.Tractions | None, curves: dict[str, results.Curve],
                 fields: results.Fields | None, bodies: results.Bodies | None, scene: results.Scene, time: float):
    """A panel each, arrows at one scale for all, so that sizes can be compared; None where nothing is an obstacle."""
    panels = []
    if tractions is not None and bodies is not None:
        panels += [(bodies.names[i], tractions.at[tractions.body == i], tractions.traction[tractions.body == i], outline)
                   for i, outline in bodies.outlines(tractions.time).items()]
    if fields is not None:
        panels += [(name, curve.points, curve.values, curve.points) for name, curve in curves.items()
                   if obstacles.stands_in_the_flow(curve, fields)]
    panels = [panel for panel in panels if len(panel[1])][:MOST_PANELS]
    if not panels:
        return None
    largest = max(np.linalg.norm(traction, axis=1).max() for _, _, traction, _ in panels)
    radius = max(0.5 * np.ptp(outline, axis=0).min() for _, _, _, outline in panels)
    boxes = [box(at, traction, outline, radius / max(largest, 1e-300)) for _, at, traction, outline in panels]
    size = np.max([upper - lower for lower, upper in boxes], axis=0)
    scale = min(10.5 / (len(panels) * size[0]), 4.8 / size[1])
    figure, axes = plt.subplots(1, len(panels), squeeze=False,
                                figsize=(len(panels) * (size[0] * scale + 1.1), size[1] * scale + 1.0))
    shot = fields.nearest(time) if fields else None
    for axis, (name, at, traction, _), (lower, upper) in zip(axes.flat, panels, boxes):
        background(axis, fields, shot, bodies)
        arrows(axis, at, traction, radius / max(largest, 1e-300), 0.022 * radius)
        axis.set_facecolor("0.88")
        middle = (lower + upper) / 2
        axis.set_xlim(middle[0] - size[0] / 2, middle[0] + size[0] / 2)
        axis.set_ylim(middle[1] - size[1] / 2, middle[1] + size[1] / 2)
        maps.finish_map(axis, f"{name}: up to {np.linalg.norm(traction, axis=1).max():.3g} Pa")
        axis.locator_params(nbins=5)
    figure.suptitle(f"traction of the fluid, {scene.when(time)}", fontsize=10)
    return figure


def on_sides(curves: dict[str, results.Curve], fields: results.Fields, bodies: results.Bodies | None,
             scene: results.Scene, time: float):
    """Along every fitted boundary, over the speed; what is far above the rest, as at singular corners, is cut."""
    lower, upper = fields.points.min(axis=0), fields.points.max(axis=0)
    longest = 0.16 * min(upper - lower)
    limit = usual_largest(curves.values())
    width, height = upper - lower + 2 * longest
    scale = (9.5 if width > height else 6.0) / max(width, height)
    figure, axis = plt.subplots(figsize=(width * scale + 1.6, height * scale + 0.9))
    shot = fields.nearest(time) if fields else None
    image = background(axis, fields, shot, bodies)
    figure.colorbar(image, ax=axis, label="speed [m/s]", shrink=0.85, pad=0.02)
    for curve in curves.values():
        size = np.linalg.norm(curve.values, axis=1, keepdims=True)
        arrows(axis, curve.points, curve.values * np.minimum(1, limit / np.maximum(size, 1e-300)), longest / limit,
               0.03 * longest)
        for line in curve.lines[:, [0, 2, 1]]:
            axis.plot(*curve.points[line].T, color="0.2", linewidth=0.8, zorder=3)
    axis.set_xlim(lower[0] - longest, upper[0] + longest)
    axis.set_ylim(lower[1] - longest, upper[1] + longest)
    maps.finish_map(axis, f"traction of the fluid on boundaries, {scene.when(time)} "
                          f"(arrow as long as the bar: {limit:.3g} Pa)")
    axis.plot([lower[0], lower[0] + longest], 2 * [lower[1] - 0.8 * longest], color="crimson", linewidth=2)
    return figure


def usual_largest(curves) -> float:
    """The size [Pa] that tractions stay below on nine tenths of the length."""
    size = np.concatenate([np.linalg.norm(curve.values[curve.lines[:, 2]], axis=1) for curve in curves])
    length = np.concatenate([np.linalg.norm(np.subtract(*(curve.points[curve.lines[:, k]] for k in (0, 1))), axis=1)
                             for curve in curves])
    order = np.argsort(size)
    share = np.cumsum(length[order]) / length.sum()
    return max(float(size[order][np.searchsorted(share, 0.9)]), 1e-300)


def box(at, traction, outline, scale):
    """Corners around an outline and the arrows on it."""
    ends = np.concatenate([outline, at, at + scale * traction])
    margin = 0.15 * np.ptp(outline, axis=0).min()
    return ends.min(axis=0) - margin, ends.max(axis=0) + margin


def background(axis, fields, shot, bodies):
    """The speed, pale, under the arrows."""
    image = None
    if shot is not None:
        speed = shot.speed
        image = axis.tripcolor(maps.visible(fields, shot), speed, shading="gouraud", cmap=PALE,
                               vmin=0, vmax=max(speed.max(), 1e-300), rasterized=True)
    if bodies is not None and shot is not None:
        maps.add_bodies(axis, bodies, shot.time)
    return image


def arrows(axis, at, traction, scale, width):
    """From each point, thinned out to about ARROWS."""
    shown = thinned(at)
    axis.quiver(*at[shown].T, *(scale * traction[shown]).T, color="crimson", angles="xy", scale_units="xy", scale=1,
                width=width, units="xy", zorder=4, headwidth=4, headlength=5)


def thinned(at: np.ndarray) -> list[int]:
    """Points that keep a distance, such that about ARROWS of them surround their box."""
    distance = 2 * np.ptp(at, axis=0).sum() / ARROWS
    kept: list[int] = []
    for i, point in enumerate(at):
        if not kept or np.linalg.norm(at[kept] - point, axis=1).min() >= distance:
            kept.append(i)
    return kept
