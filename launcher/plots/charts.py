"""Charts over time: where the bodies went and what the history holds."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle, Rectangle
from matplotlib.ticker import MaxNLocator

from launcher.plots import results

MOST_NAMES = 12  # that a legend or a panel has room for


def trajectories(bodies: results.Bodies, scene: results.Scene):
    """Paths in the plane with the discs at start and end, heights and speeds over time."""
    figure, (path, height, fast) = plt.subplots(1, 3, figsize=(11, 4.5))
    for i, name in enumerate(bodies.names):
        x, y = bodies.position[:, i, 0], bodies.position[:, i, 1]
        line, = path.plot(x, y)
        for k, style in ((0, "--"), (-1, "-")):
            path.add_patch(Circle((x[k], y[k]), bodies.radius[i], fill=False, edgecolor=line.get_color(),
                                  linestyle=style))
        height.plot(bodies.time, y, label=name)
        fast.plot(bodies.time, np.linalg.norm(bodies.velocity[:, i], axis=1))
    if scene.box is not None:
        lower, upper = map(np.array, scene.box)
        path.add_patch(Rectangle(lower, *(upper - lower), fill=False, edgecolor="0.4", linewidth=1))
    path.set_aspect("equal")
    path.autoscale_view()
    path.xaxis.set_major_locator(MaxNLocator(3))
    path.set_title("dashed: start, solid: end", fontsize=8)
    for axis, labels in ((path, ("x [m]", "y [m]")), (height, ("t [s]", "y of the centre [m]")),
                         (fast, ("t [s]", "speed [m/s]"))):
        axis.set(xlabel=labels[0], ylabel=labels[1])
        axis.grid(alpha=0.3)
    if len(bodies.names) <= MOST_NAMES:
        height.legend(fontsize=8)
    return figure


def profiles(curves: dict[str, results.Curve], quantities: dict[str, str], extrema: dict[str, dict]):
    """Quantities along segments; `extrema` as in summary.json."""
    figure, axes = plt.subplots(1, len(curves), figsize=(4.6 * len(curves), 3.8), squeeze=False)
    for axis, (name, curve) in zip(axes.flat, curves.items()):
        along = int(np.ptp(curve.points[:, 1]) > np.ptp(curve.points[:, 0]))
        axis.plot(curve.points[:, along], curve.values, linewidth=1.2)
        found = extrema.get(name, {})
        for kind, mark in (("min", "v"), ("max", "^")):
            if found.get(kind) is not None:
                place = found[f"{kind}_at"][along]
                axis.plot(place, found[kind], mark, color="0.2", markersize=5,
                          label=f"{found[kind]:.5g} at {'xy'[along]} = {place:.4g} m")
        quantity = quantities.get(name, "value")
        unit = {"pressure": " [Pa]", "value": ""}.get(quantity, " [m/s]")
        other = curve.points[:, 1 - along]
        where = f" ({'yx'[along]} = {other[0]:.4g} m)" if np.ptp(other) == 0 else ""
        axis.set(xlabel=f"{'xy'[along]} [m]", ylabel=quantity.replace("_", " ") + unit, title=name + where)
        axis.grid(alpha=0.3)
        if found:
            axis.legend(fontsize=8)
    return figure


def panels(history: dict[str, np.ndarray]) -> list[tuple[str, list[str], bool]]:
    """Label, columns and whether logarithmic: forces, energies, coefficients, probes, iterations, residuals; columns without
    a value other than zero are left out."""
    own = {"time", "step", "sub_iterations", "residual_velocity", "residual_force", "newton_iterations", "columns_kept",
           "columns_dropped", "displacement", "miss", "recuts"}
    forces = [name for name in history if name.endswith((".fx", ".fy"))]
    coefficients = [[name for name in history if name.split(".")[-1] == kind] for kind in ("drag", "lift")]
    others = [name for name in history if name not in own and "." not in name and name not in sum(coefficients, [])]
    wanted = [(f"{names[0].split('.')[-1]} coefficient", names, False) for names in coefficients if names]
    wanted += [("force [N]", forces, False)]
    wanted += [("energy [J]", [name for name in history if name.startswith("energy.")], False)]
    wanted += [(name, [name], False) for name in others]
    wanted += [("iterations a step", ["sub_iterations", "newton_iterations"], False),
               ("columns a step", ["columns_kept", "columns_dropped"], False),
               ("elements a step", ["displacement", "miss"], False), ("cuts anew a step", ["recuts"], False),
               ("relative change", ["residual_velocity", "residual_force"], True)]
    telling = [(label, [name for name in names if name in history and np.nan_to_num(history[name]).any()][:MOST_NAMES],
                logarithmic) for label, names, logarithmic in wanted]
    return [panel for panel in telling if panel[1]]


def curves(history: dict[str, np.ndarray], shown: list[tuple[str, list[str], bool]]):
    """The panels of the history, one below the other."""
    figure, axes = plt.subplots(len(shown), 1, figsize=(8, 2.3 * len(shown)), sharex=True, squeeze=False)
    for axis, (label, names, logarithmic) in zip(axes.flat, shown):
        for name in names:
            values = history[name]
            values = np.where(values > 0, values, np.nan) if logarithmic else values
            axis.plot(history["time"], values, label=name.replace("_", " "), linewidth=1.1)
        if logarithmic:
            axis.set_yscale("log")
        elif (limits := past_the_start(history, names)) is not None:
            axis.set_ylim(*limits)
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    axes[-1, 0].set_xlabel("t [s]")
    return figure


def past_the_start(history: dict[str, np.ndarray], names: list[str]) -> tuple[float, float] | None:
    """Limits that leave out the first twentieth of the run, where a sudden start would hide all that follows; None
    where it would not."""
    late = history["time"] > 0.05 * history["time"][-1]
    values, settled = (np.concatenate([history[name][chosen] for name in names]) for chosen in (slice(None), late))
    if not np.isfinite(settled).any():
        return None
    low, high = np.nanmin(settled), np.nanmax(settled)
    margin = 0.1 * (high - low)
    hidden = margin > 0 and np.nanmax(values) - np.nanmin(values) > 3 * (high - low)
    return (low - margin, high + margin) if hidden else None
