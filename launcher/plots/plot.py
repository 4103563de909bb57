"""Pictures of a run: maps, streamlines, surface of the pressure, tractions, profiles, trajectories, history."""

import subprocess
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of the backend)

from launcher.plots import charts, granular, maps, movie, obstacles, percolation, results, streams, surface, tractions  # noqa: E402
from launcher.run import report  # noqa: E402
from launcher.common import Refusal, naming, require_plain  # noqa: E402
from launcher.processes import describe  # noqa: E402

STYLE = {"figure.dpi": 110, "savefig.dpi": 110, "font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
         "axes.grid": False, "legend.frameon": False, "figure.constrained_layout.use": True}


def draw(run: Path, moving: bool = False) -> list[Path]:
    """Draws what the run has into RUN/plots, and a movie of it where asked for; returns the pictures."""
    if not run.is_dir():
        raise Refusal(f"a run folder is required; there is no {run}")
    folder = run / "plots"
    for place in (run, folder):
        if place.is_dir():
            require_plain(place)
    scene, fields, bodies = results.read_scene(run), results.read_fields(run), results.read_bodies(run)
    on_bodies, history = results.read_tractions(run, bodies), results.read_history(run)
    time, boundaries = results.read_curves(run, "boundaries.h5", "traction")
    _, profiles = results.read_curves(run, "profiles.h5", "value")
    pictures = []

    def save(figure, name):
        folder.mkdir(exist_ok=True)
        pictures.append(folder / name)
        with naming(pictures[-1]):
            figure.savefig(pictures[-1])
        plt.close(figure)

    with plt.rc_context(STYLE):
        if fields is not None and len(fields) > 0:
            save(maps.speeds(fields, bodies, scene), "speed.png")
            save(maps.pressures(fields, bodies, scene), "pressure.png")
            save(surface.pressure(fields, scene), "pressure_surface.png")
            save(streams.whole(fields, bodies, scene), "streamlines.png")
            found = obstacles.find(fields, bodies, boundaries, fields.time(len(fields) - 1))
            if found and len(found) <= charts.MOST_NAMES:
                save(streams.close_ups(fields, bodies, found, scene), "close_up.png")
        figure = tractions.on_obstacles(on_bodies, boundaries, fields, bodies, scene,
                                         on_bodies.time if on_bodies else time)
        if figure is not None:
            save(figure, "traction.png")
        if boundaries and fields is not None and len(fields) > 0:
            save(tractions.on_sides(boundaries, fields, bodies, scene, time), "boundary_traction.png")
        if profiles:
            save(charts.profiles(profiles, results.read_profile_quantities(run),
                                 (report.summary_of(run) or {}).get("profiles", {})), "profiles.png")
        many = bodies is not None and len(bodies.names) > charts.MOST_NAMES
        if many and fields is None:
            save(granular.snapshots(bodies, scene), "grains.png")
        if bodies is not None and len(bodies.time) > 1 and not many:
            save(charts.trajectories(bodies, scene), "trajectories.png")
        flow = percolation.figure(run, scene)
        if flow is not None:
            save(flow, "percolation.png")
        if moving:
            pictures.append(draw_movie(fields, bodies, scene, folder))
        panels = charts.panels(history)
        if panels and len(history.get("time", [])) > 1:
            save(charts.curves(history, panels), "history.png")
    if fields is not None:
        fields.file.close()
    if not pictures:
        raise Refusal(f"{run} holds no results to draw (fields.h5, bodies.h5, interface.h5, history.csv)")
    return pictures


def draw_movie(fields: results.Fields | None, bodies: results.Bodies | None, scene: results.Scene, folder: Path) -> Path:
    if bodies is None or len(bodies.time) < 2:
        raise Refusal("a movie needs bodies at two times or more in bodies.h5: set output.interval in the scene and run again")
    folder.mkdir(exist_ok=True)
    try:
        with naming(folder):
            return movie.make(fields, bodies, scene, folder)
    except subprocess.CalledProcessError as error:
        raise Refusal(f"ffmpeg must make the movie in {folder}; it ended with {describe(error.returncode)}: {error.stderr}") from error
