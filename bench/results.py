"""How the results of the bench are shown: a table a case, JSON, and a picture of error against run time."""

import json
from pathlib import Path

from bench.tools import PARTS


def table(case, rows: list[dict]) -> str:
    names = list(case.references)
    lines = [f"{case.title}: error of each quantity ("
             + ", ".join(f"{name} {kind}" for name, (_, kind) in case.references.items()) + ")",
             f"{'program':26s}{'mesh':20s}{'unknowns':>9s}{'wall s':>9s}{'MB':>7s}"
             + "".join(f"{name:>10s}" for name in names) + "".join(f"{part:>10s}" for part in PARTS)]
    for row in rows:
        errors = "".join(f"{row['errors'][name]:10.1e}" if name in row["errors"] else f"{'-':>10s}" for name in names)
        parts = "".join(f"{row['parts'][part]:10.2f}" for part in PARTS if row["parts"])
        lines.append(f"{row['tool']:26s}{row['size']:20s}{row['unknowns']:9d}{row['seconds']:9.2f}{row['megabytes']:7.0f}"
                     + errors + parts)
    return "\n".join(lines)


def write_json(results: dict[str, list[dict]], path: Path) -> None:
    path.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")


def draw(cases: dict, results: dict[str, list[dict]], path: Path) -> None:
    """The first quantity of each case: error against wall time, a line a program."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, len(results), figsize=(6 * len(results), 5), squeeze=False)
    for axis, (key, rows) in zip(axes[0], results.items()):
        quantity = next(iter(cases[key].references))
        for tool in dict.fromkeys(row["tool"] for row in rows):
            points = [(row["seconds"], row["errors"][quantity]) for row in rows
                      if row["tool"] == tool and quantity in row["errors"]]
            if points:
                axis.loglog(*zip(*points), marker="o", label=tool)
        axis.set(title=cases[key].title, xlabel="wall time of the whole program [s]", ylabel=f"error of {quantity}")
        axis.grid(which="both", alpha=0.3)
        axis.legend(fontsize="small")
    figure.tight_layout()
    figure.savefig(path, dpi=130)
