#!/usr/bin/python3
"""How time and memory of a steady percolation grow with the number of grains: one Stokes flow past 1 to 1024 random
grains at 8 elements a diameter, whole programs on one core, with the exponents. Nothing is asserted here."""

import json
import math
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from bench.arguments import bench_parser, read_arguments
from bench.measure import measure
from bench.tools import fpi

SOLVERS = "mumps", "umfpack"
GRAINS = 1, 9, 36, 100, 324, 1024
QUICK = 100
RADIUS, SOLID_FRACTION, COARSE = 0.05, 0.4, 0.0625  # [m], of the grains' square, [m] of cells away from grains
LARGE = 100  # grains from which on the exponents are fitted: below, boundaries count


def sets(grains: int, solver: str) -> list[str]:
    """`percolation_random` with another number of grains in a square, a radius away from the sides."""
    side = math.sqrt(grains * math.pi * RADIUS**2 / SOLID_FRACTION) * (1 + 1e-9)
    whole = side + 2 * RADIUS
    return [f"fluid.linear_solver=\"{solver}\"", f"fluid.mesh.upper=[{whole},{whole}]",
            *(f"fluid.mesh.cells_{axis}={max(4, round(whole / COARSE))}" for axis in "xy"),
            f"grains.0.lower=[{RADIUS},{RADIUS}]", f"grains.0.upper=[{RADIUS + side},{RADIUS + side}]"]


def row_of(grains: int, solver: str, folder: Path) -> dict:
    def values(summary, _run):
        return {"grains": summary["grains"][0]["count"], "balance": summary["force_balance"]["rest"]}

    run = fpi(solver, str(grains), "percolation_random", folder, sets(grains, solver), values)
    measured = measure(run.command)
    found = run.read(measured.output)
    return {"solver": solver, "unknowns": found.unknowns, "seconds": measured.processor_seconds,
            "megabytes": measured.megabytes, "parts": found.parts} | found.values


def exponent(rows: list[dict], quantity: str) -> float:
    """Of the quantity in the number of grains: least squares of the logarithms."""
    points = [(math.log(row["grains"]), math.log(row[quantity])) for row in rows if row["grains"] >= LARGE]
    if len(points) < 2:
        return math.nan
    x, y = (sum(values) / len(points) for values in zip(*points))
    return sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)


def draw(rows: list[dict], path: Path) -> None:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 2, figsize=(11, 4.5))
    for axis, quantity, label in zip(axes, ("seconds", "megabytes"), ("processor time [s]", "largest process [MB]")):
        for solver in SOLVERS:
            mine = [row for row in rows if row["solver"] == solver]
            if mine:
                power = exponent(mine, quantity)
                axis.loglog([row["grains"] for row in mine], [row[quantity] for row in mine], marker="o",
                            label=solver if math.isnan(power) else f"{solver}: N^{power:.2f} from {LARGE} on")
        axis.set(xlabel="grains N", ylabel=label)
        axis.grid(which="both", alpha=0.3)
        axis.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=130)


def main() -> None:
    arguments = read_arguments(bench_parser(__doc__, SOLVERS, f"at most {QUICK} grains"), SOLVERS)
    folder = arguments.out / "growth"
    folder.mkdir(exist_ok=True)
    rows = []
    print(f"{'solver':9s}{'grains':>7s}{'unknowns':>10s}{'CPU s':>9s}{'factor s':>9s}{'MB':>7s}{'balance':>10s}")
    for solver in arguments.cases or SOLVERS:
        for grains in GRAINS:
            if arguments.quick and grains > QUICK:
                continue
            row = row_of(grains, solver, folder)
            rows.append(row)
            print(f"{solver:9s}{row['grains']:7d}{row['unknowns']:10d}{row['seconds']:9.2f}{row['parts']['factor']:9.2f}"
                  f"{row['megabytes']:7.0f}{row['balance']:10.1e}", flush=True)
        mine = [row for row in rows if row["solver"] == solver]
        print(f"{solver}: time goes with the power {exponent(mine, 'seconds'):.2f} of the number of grains, "
              f"memory with {exponent(mine, 'megabytes'):.2f}, from {LARGE} grains on\n", flush=True)
    shutil.rmtree(folder)
    (arguments.out / "growth.json").write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    draw(rows, arguments.out / "growth.png")
    print(f"in {arguments.out}: growth.json, growth.png")


if __name__ == "__main__":
    main()
