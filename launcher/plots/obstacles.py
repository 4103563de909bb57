"""What the flow goes around: bodies, and the fitted boundaries that are not merely sides of the domain."""

from dataclasses import dataclass

import numpy as np

from launcher.plots import results


@dataclass
class Obstacle:
    name: str
    lower: np.ndarray  # (2) [m]
    upper: np.ndarray  # (2) [m]

    @property
    def size(self) -> np.ndarray:
        return self.upper - self.lower


def find(fields: results.Fields, bodies: results.Bodies | None, curves: dict[str, results.Curve],
         time: float) -> list[Obstacle]:
    """Bodies at a time, then boundaries, each with the box around it."""
    found = []
    if bodies is not None:
        found += [Obstacle(bodies.names[i], outline.min(axis=0), outline.max(axis=0))
                  for i, outline in bodies.outlines(time).items()]
    return found + [Obstacle(name, curve.points.min(axis=0), curve.points.max(axis=0))
                    for name, curve in curves.items() if stands_in_the_flow(curve, fields)]


def stands_in_the_flow(curve: results.Curve, fields: results.Fields) -> bool:
    """Whether a part of it, and not only a side of the domain's box, lies away from that box."""
    lower, upper = fields.points.min(axis=0), fields.points.max(axis=0)
    near = 1e-6 * (upper - lower).max()
    return bool(((curve.points > lower + near) & (curve.points < upper - near)).all(axis=1).any())


def close_up(obstacle: Obstacle, fields: results.Fields, flow: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Corners of a region with the obstacle and some of its wake; of a long one, with its upstream end. `flow` is the
    mean velocity."""
    along = int(abs(flow[1]) > abs(flow[0]))  # 0: the flow goes along x
    downstream = 1 if flow[along] >= 0 else -1
    across = max(obstacle.size[1 - along], 1e-12)
    front = (obstacle.lower if downstream > 0 else obstacle.upper)[along]
    length = min(obstacle.size[along], 3 * across)
    lower, upper = obstacle.lower - 0.9 * across, obstacle.upper + 0.9 * across
    ends = front - 1.2 * downstream * across, front + downstream * (length + 4 * across)
    lower[along], upper[along] = min(ends), max(ends)
    return np.maximum(lower, fields.points.min(axis=0)), np.minimum(upper, fields.points.max(axis=0))
