"""A run in motion: the speed of the fluid around its bodies where it was written on the way, else its grains coloured
by their speed."""

import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import animation

from launcher.plots import granular, maps, results

MOST_FRAMES = 300
FRAMES_A_SECOND = 25


def make(fields: results.Fields | None, bodies: results.Bodies, scene: results.Scene, folder: Path) -> Path:
    """All written times, or every so many of them, as MP4 where ffmpeg is installed, else as GIF."""
    with_flow = fields is not None and len(fields) > 2  # the start and the end are always there
    figure, moments, show = of_flow(fields, bodies, scene) if with_flow else of_grains(bodies, scene)
    has_ffmpeg = shutil.which("ffmpeg") is not None
    writer = (animation.FFMpegWriter if has_ffmpeg else animation.PillowWriter)(fps=FRAMES_A_SECOND)
    path = folder / ("grains.mp4" if has_ffmpeg else "grains.gif")
    chosen = moments[::1 + (len(moments) - 1) // MOST_FRAMES]
    animation.FuncAnimation(figure, show, frames=chosen).save(path, writer=writer)
    plt.close(figure)
    return path


def of_flow(fields: results.Fields, bodies: results.Bodies, scene: results.Scene):
    """The figure, the written times [s], and what draws one of them."""
    figure, axis = subplots(np.ptp(fields.points, axis=0))
    fastest = max(np.percentile(fields.snapshot(index).speed, 99.9) for index in range(len(fields)))

    def show(time):
        shot = fields.nearest(time)
        axis.clear()
        return [maps.panel(axis, fields, shot, shot.speed, bodies, scene, cmap="viridis", vmin=0, vmax=max(fastest, 1e-12))]

    figure.colorbar(show(0.0)[0], ax=axis, label="speed of the fluid [m/s]", shrink=0.8, extend="max")
    return figure, fields.times(), show


def of_grains(bodies: results.Bodies, scene: results.Scene):
    """The figure, the indices of the written times, and what draws one of them."""
    view = granular.View(bodies, scene)
    figure, axis = subplots(view.size)
    grains = view.draw(axis, 0)
    figure.colorbar(grains, ax=axis, label="speed [m/s]", shrink=0.8, extend="max")

    def show(index):
        grains.set_offsets(view.places(index))
        grains.set_array(view.speed[index, view.order])
        axis.set_title(scene.when(bodies.time[index]))
        return [grains]

    return figure, range(len(bodies.time)), show


def subplots(size: np.ndarray):
    width, height = size * 7.0 / max(size)
    return plt.subplots(figsize=(width + 2, height + 1))
