"""Many grains: snapshots coloured by speed with the walls around them, and the same as a movie."""

import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import animation
from matplotlib.collections import EllipseCollection

from launcher import results

MOST_SNAPSHOTS = 4
MOST_FRAMES = 300
FRAMES_A_SECOND = 25


class View:
    """The plane that grains are seen in: x and y of discs; of spheres x and the axis that gravity acts along."""

    def __init__(self, bodies: results.Bodies, scene: results.Scene):
        self.axes = (0, scene.upwards)
        depth = 3 - sum(self.axes)
        self.order = np.argsort(-bodies.position[0, :, depth] if depth == 1 else bodies.position[0, :, depth], kind="stable")
        self.bodies, self.scene = bodies, scene
        self.speed = np.linalg.norm(bodies.velocity, axis=2)
        self.fastest = max(float(np.percentile(self.speed, 99.5)), 1e-12)
        # Few that flew far must not make all others small.
        seen = bodies.position[:, :, self.axes].reshape(-1, 2)
        margin = 2 * bodies.radius.max()
        self.lower, self.upper = np.percentile(seen, 0.5, axis=0) - margin, np.percentile(seen, 99.5, axis=0) + margin

    @property
    def size(self) -> np.ndarray:
        return self.upper - self.lower

    def draw(self, axis, index: int) -> EllipseCollection:
        diameters = 2 * self.bodies.radius[self.order]
        grains = EllipseCollection(diameters, diameters, np.zeros(len(diameters)), units="xy",
                                   offsets=self.places(index), offset_transform=axis.transData, cmap="viridis",
                                   linewidth=0)
        grains.set_clim(0, self.fastest)
        grains.set_array(self.speed[index, self.order])
        axis.add_collection(grains)
        for start, end in self.walls():
            axis.plot(*zip(start, end), color="0.2", linewidth=1.2, scalex=False, scaley=False)
        axis.set(xlim=(self.lower[0], self.upper[0]), ylim=(self.lower[1], self.upper[1]), aspect="equal",
                 xlabel="x [m]", ylabel=f"{'xyz'[self.axes[1]]} [m]", title=self.scene.when(self.bodies.time[index]))
        return grains

    def places(self, index: int) -> np.ndarray:
        return self.bodies.position[index][self.order][:, self.axes]

    def walls(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """Where planes that are seen edge on cross the picture: two points each."""
        lines, reach = [], float(np.linalg.norm(self.size))
        for wall in self.scene.walls:
            if wall.get("shape", "plane") != "plane":
                continue
            normal, point = (np.array([*wall[key], 0.0])[list(self.axes)] for key in ("normal", "point"))
            if np.linalg.norm(normal) < 0.99 * np.linalg.norm(wall["normal"]):
                continue
            along = np.array([-normal[1], normal[0]]) / np.linalg.norm(normal)
            nearest = point + along * np.dot((self.lower + self.upper) / 2 - point, along)
            lines.append((nearest - reach * along, nearest + reach * along))
        return lines


def snapshots(bodies: results.Bodies, scene: results.Scene):
    """Up to four times: stacked where grains spread out, side by side where they stand tall, else two by two."""
    view = View(bodies, scene)
    chosen = np.unique(np.linspace(0, len(bodies.time) - 1, MOST_SNAPSHOTS).round().astype(int))
    aspect = view.size[0] / view.size[1]
    columns = min(len(chosen), 1 if aspect > 2.5 else len(chosen) if aspect < 0.5 else 2)
    rows = -(-len(chosen) // columns)
    width, height = view.size * (8.0 if columns == 1 else 5.5) / max(view.size)
    figure, axes = plt.subplots(rows, columns, figsize=(columns * (width + 0.9) + 0.8, rows * (height + 0.8)),
                                squeeze=False, sharex=True, sharey=True)
    for axis in axes.flat[len(chosen):]:
        axis.remove()
    for axis, index in zip(axes.flat, chosen):
        grains = view.draw(axis, index)
        axis.label_outer()
    figure.colorbar(grains, ax=axes, label="speed [m/s]", shrink=0.8, pad=0.02, extend="max")
    return figure


def movie(bodies: results.Bodies, scene: results.Scene, folder: Path) -> Path:
    """All written times, or every so many of them, as MP4 where ffmpeg is installed, else as GIF."""
    view = View(bodies, scene)
    chosen = range(0, len(bodies.time), 1 + (len(bodies.time) - 1) // MOST_FRAMES)
    width, height = view.size * 7.0 / max(view.size)
    figure, axis = plt.subplots(figsize=(width + 2, height + 1))
    grains = view.draw(axis, 0)
    figure.colorbar(grains, ax=axis, label="speed [m/s]", shrink=0.8, extend="max")

    def show(index):
        grains.set_offsets(view.places(index))
        grains.set_array(view.speed[index, view.order])
        axis.set_title(scene.when(bodies.time[index]))

    has_ffmpeg = shutil.which("ffmpeg") is not None
    writer = (animation.FFMpegWriter if has_ffmpeg else animation.PillowWriter)(fps=FRAMES_A_SECOND)
    path = folder / ("grains.mp4" if has_ffmpeg else "grains.gif")
    animation.FuncAnimation(figure, show, frames=chosen).save(path, writer=writer)
    plt.close(figure)
    return path
