"""Pictures of a run: speed and pressure at some times, tractions on the bodies, trajectories, history."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of the backend)

from launcher import charts, maps, results  # noqa: E402
from launcher.common import Refusal  # noqa: E402

STYLE = {"figure.dpi": 110, "savefig.dpi": 110, "font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
         "axes.grid": False, "legend.frameon": False, "figure.constrained_layout.use": True}


def draw(run: Path) -> list[Path]:
    """Draws what the run has into RUN/plots and returns the pictures."""
    if not run.is_dir():
        raise Refusal(f"a run folder is required; there is no {run}")
    folder = run / "plots"
    scene, fields, bodies = results.read_scene(run), results.read_fields(run), results.read_bodies(run)
    tractions, history = results.read_strongest_tractions(run), results.read_history(run)
    pictures = []

    def save(figure, name):
        folder.mkdir(exist_ok=True)
        pictures.append(folder / name)
        figure.savefig(pictures[-1])
        plt.close(figure)

    with plt.rc_context(STYLE):
        if fields is not None and len(fields) > 0:
            save(maps.speeds(fields, bodies, scene), "speed.png")
            save(maps.pressures(fields, bodies, scene), "pressure.png")
        if tractions is not None and bodies is not None:
            save(maps.traction_vectors(tractions, bodies, fields, scene), "traction.png")
        if bodies is not None and len(bodies.time) > 1:
            save(charts.trajectories(bodies, scene), "trajectories.png")
        panels = charts.panels(history)
        if panels and len(history.get("time", [])) > 1:
            save(charts.curves(history, panels), "history.png")
    if fields is not None:
        fields.file.close()
    if not pictures:
        raise Refusal(f"{run} holds no results to draw (fields.h5, bodies.h5, interface.h5, history.csv)")
    return pictures
