"""Many grains: snapshots coloured by speed with the walls around them."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection

from launcher.plots import results, stl

MOST_SNAPSHOTS = 4


class View:
    """The plane that grains are seen in: x and y of discs; of spheres x and the axis that gravity acts along."""

    def __init__(self, bodies: results.Bodies, scene: results.Scene):
        self.axes = (0, scene.upwards)
        depth = 3 - sum(self.axes)
        self.order = np.argsort(-bodies.position[0, :, depth] if depth == 1 else bodies.position[0, :, depth], kind="stable")
        self.bodies, self.scene = bodies, scene
        self.speed = np.linalg.norm(bodies.velocity, axis=2)
        self.fastest = max(float(np.nanpercentile(self.speed, 99.5)), 1e-12)  # NaN: left
        # Few that flew far must not make all others small.
        seen = bodies.position[:, :, self.axes].reshape(-1, 2)
        margin = 2 * bodies.radius.max()
        self.lower, self.upper = np.nanpercentile(seen, 0.5, axis=0) - margin, np.nanpercentile(seen, 99.5, axis=0) + margin
        for line in (line for wall in scene.walls if wall["shape"] in ("polyline", "arc") for line in self.lines(wall)):
            self.lower, self.upper = np.minimum(self.lower, line.min(axis=0)), np.maximum(self.upper, line.max(axis=0))

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
        for wall in self.scene.walls:
            thin = wall["shape"] == "mesh"
            lines = LineCollection(self.lines(wall), color="0.2", linewidth=0.3 if thin else 1.2,
                                   linestyle="dashed" if moves(wall) else "solid")
            axis.add_collection(lines, autolim=False)
        axis.set(xlim=(self.lower[0], self.upper[0]), ylim=(self.lower[1], self.upper[1]), aspect="equal",
                 xlabel="x [m]", ylabel=f"{'xyz'[self.axes[1]]} [m]", title=self.scene.when(self.bodies.time[index]))
        return grains

    def places(self, index: int) -> np.ma.MaskedArray:
        """Of the grains that did not leave."""
        return np.ma.masked_invalid(self.bodies.position[index][self.order][:, self.axes])

    def lines(self, wall: dict) -> list[np.ndarray]:
        """What is seen of a wall, each line (points, 2); where it was at the start, if it moves."""
        shape = wall["shape"]
        if shape == "plane":
            return self.plane(wall)
        if shape == "mesh":
            corners = wall["scale"] * stl.read(self.scene.folder / wall["file"])[:, [0, 1, 2, 0]]
            return list(corners[:, :, self.axes])
        if shape == "arc":
            angles = np.linspace(wall["start"], wall["end"], 181)
            return [np.array(wall["centre"]) + wall["radius"] * np.stack([np.cos(angles), np.sin(angles)], axis=1)]
        vertices = np.reshape(wall["vertices"], (-1, 2))
        return [np.vstack([vertices, vertices[:1]]) if wall["closed"] else vertices]

    def plane(self, wall: dict) -> list[np.ndarray]:
        """Where a plane that is seen edge on crosses the picture."""
        normal, point = (np.array([*wall[key], 0.0])[list(self.axes)] for key in ("normal", "point"))
        if np.linalg.norm(normal) < 0.99 * np.linalg.norm(wall["normal"]):
            return []
        along = np.array([-normal[1], normal[0]]) / np.linalg.norm(normal)
        nearest = point + along * np.dot((self.lower + self.upper) / 2 - point, along)
        reach = float(np.linalg.norm(self.size))
        return [np.array([nearest - reach * along, nearest + reach * along])]


def moves(wall: dict) -> bool:
    """Whether it leaves its place: a whole circle that turns does not."""
    circle = wall["shape"] == "arc" and wall["end"] - wall["start"] > 6.28
    return any(v != "0" for v in wall.get("velocity", [])) or (not circle and any(s != "0" for s in wall.get("spin", [])))


def snapshots(bodies: results.Bodies, scene: results.Scene):
    """Up to four times: stacked where grains spread out, side by side where they stand tall, else two by two."""
    view = View(bodies, scene)
    chosen = np.unique(np.linspace(0, len(bodies.time) - 1, MOST_SNAPSHOTS).round().astype(int))
    aspect = view.size[0] / view.size[1]
    columns = min(len(chosen), 1 if aspect > 2.5 else len(chosen) if aspect < 0.5 else 2)
    rows = -(-len(chosen) // columns)
    width, height = view.size * (8.0 if columns == 1 else 5.5) / max(view.size)
    figure, axes = plt.subplots(rows, columns, figsize=(columns * (width + 0.9) + 0.8, rows * (height + 1.0)),
                                squeeze=False, sharex=True, sharey=True)
    for axis in axes.flat[len(chosen):]:
        axis.remove()
    for axis, index in zip(axes.flat, chosen):
        grains = view.draw(axis, index)
        axis.label_outer()
    figure.colorbar(grains, ax=axes, label="speed [m/s]", shrink=0.8, pad=0.02, extend="max")
    return figure
