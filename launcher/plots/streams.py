"""Streamlines over the speed: of the whole domain, and close up behind what stands in the flow."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.tri import LinearTriInterpolator

from launcher.plots import maps, obstacles, results

GRID = 160  # points along the longer side of a region
MOST_CLOSE_UPS = 4


def whole(fields: results.Fields, bodies: results.Bodies | None, scene: results.Scene):
    """The last speed with streamlines."""
    shot = fields.snapshot(len(fields) - 1)
    lower, upper = fields.points.min(axis=0), fields.points.max(axis=0)
    width, height = upper - lower
    scale = (9.0 if width > height else 6.0) / max(width, height)
    figure, axis = plt.subplots(figsize=(width * scale + 1.6, height * scale + 0.9))
    image = region(axis, fields, shot, bodies, lower, upper)
    figure.colorbar(image, ax=axis, label="speed [m/s]", shrink=0.85, pad=0.02)
    maps.finish_map(axis, f"streamlines, {scene.when(shot.time)}")
    return figure


def close_ups(fields: results.Fields, bodies: results.Bodies | None, found: list[obstacles.Obstacle],
              scene: results.Scene):
    """The last flow around each obstacle, one below the other."""
    shot, found = fields.snapshot(len(fields) - 1), found[:MOST_CLOSE_UPS]
    flow = shot.velocity.mean(axis=0)
    boxes = [obstacles.close_up(obstacle, fields, flow) for obstacle in found]
    heights = [7.0 * (upper - lower)[1] / (upper - lower)[0] for lower, upper in boxes]
    figure, axes = plt.subplots(len(found), 1, figsize=(8.4, sum(heights) + 0.8 * len(found)), squeeze=False,
                                height_ratios=heights)
    for axis, obstacle, (lower, upper) in zip(axes.flat, found, boxes):
        image = region(axis, fields, shot, bodies, lower, upper)
        figure.colorbar(image, ax=axis, label="speed [m/s]", shrink=0.9, pad=0.02)
        maps.finish_map(axis, f"{obstacle.name}, {scene.when(shot.time)}")
    return figure


def region(axis, fields, shot, bodies, lower, upper):
    """Speed and streamlines between two corners; returns the coloured image."""
    triangles, speed = maps.visible(fields, shot), shot.speed
    inside = ((fields.points >= lower) & (fields.points <= upper)).all(axis=1)
    image = axis.tripcolor(triangles, speed, shading="gouraud", cmap="viridis", vmin=0,
                           vmax=max(speed[inside].max(initial=0.0), 1e-300), rasterized=True)
    size = upper - lower
    counts = np.maximum(np.rint(GRID * size / size.max()), 24).astype(int)
    inset = 1e-4 * size.max()  # a grid point on the boundary itself may fall outside by round-off
    x, y = (np.linspace(low + inset, high - inset, n) for low, high, n in zip(lower, upper, counts))
    at = np.meshgrid(x, y)
    u, v = (LinearTriInterpolator(triangles, part)(*at) for part in shot.velocity.T)
    if np.ma.count(u) and speed.max() > 0:
        density = np.maximum(1.5 * size / size.max(), 0.45)
        axis.streamplot(x, y, u, v, color=(1, 1, 1, 0.75), linewidth=0.6, arrowsize=0.6, density=tuple(density),
                        broken_streamlines=True)
    if bodies is not None:
        maps.add_bodies(axis, bodies, shot.time)
    axis.set_xlim(lower[0], upper[0])
    axis.set_ylim(lower[1], upper[1])
    return image
