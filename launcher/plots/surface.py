"""The pressure as a surface over the plane, as which singular corners stand out."""

import matplotlib.pyplot as plt
import numpy as np

from launcher.plots import maps, results


def pressure(fields: results.Fields, scene: results.Scene):
    """The last pressure; in a closed domain less its mean."""
    shot = fields.snapshot(len(fields) - 1)
    triangles = maps.visible(fields, shot)
    value = maps.shown_pressure(fields, shot, scene)
    # Corner points are the pressure's own; values between them lie on straight lines.
    figure = plt.figure(figsize=(7.5, 5.6))
    axis = figure.add_subplot(projection="3d", computed_zorder=False)
    surface = axis.plot_trisurf(triangles, value, cmap="viridis", linewidth=0, antialiased=False, rasterized=True)
    width, height = np.ptp(fields.points, axis=0)
    longest = max(width, height)
    axis.set_box_aspect((max(width / longest, 0.3), max(height / longest, 0.3), 0.6))
    axis.view_init(elev=28, azim=-118)
    axis.set(xlabel="x [m]", ylabel="y [m]", zlabel="p [Pa]", title=f"{scene.pressure_label}, {scene.when(shot.time)}")
    figure.colorbar(surface, ax=axis, shrink=0.55, pad=0.1, label=scene.pressure_label)
    return figure
