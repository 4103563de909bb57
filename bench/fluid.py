#!/usr/bin/python3
"""Run time against error of fluid_server on the benchmark flows, beside FreeFem++ and dolfinx where they are installed.
Whole programs on one core, taking turns so that noise hits all alike; nothing is asserted here."""

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from bench.arguments import bench_parser, read_arguments
from bench.cases import CASES
from bench.measure import fastest_rows, measure
from bench.results import draw, table, write_json
from bench.tools import Run

ROUNDS = 3
LONG = 20  # seconds from which a run is not repeated


def compare(case, runs: list[Run]) -> list[dict]:
    """Each program's fastest run of some rounds."""

    def row(run: Run) -> dict:
        measured = measure(run.command)
        found = run.read(measured.output)
        return {"tool": run.tool, "size": run.size, "unknowns": found.unknowns, "seconds": measured.seconds,
                "megabytes": measured.megabytes, "values": found.values, "errors": case.errors(found.values),
                "parts": found.parts}

    return fastest_rows(ROUNDS, LONG, runs, row)


def main() -> None:
    parser = bench_parser(__doc__, CASES, "the coarsest mesh of each program")
    parser.add_argument("--rungs", type=int, default=9, metavar="N", help="the N coarsest meshes of each program")
    arguments = read_arguments(parser, CASES)
    names = arguments.cases or list(CASES)

    results = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            case = CASES[name]
            rungs = case.rungs(Path(folder))[:1 if arguments.quick else arguments.rungs]
            results[name] = [row for rung in rungs for row in compare(case, rung)]
            results[name].sort(key=lambda one: one["tool"])
            print(table(case, results[name]), flush=True)
            write_json(results, arguments.out / "fluid.json")
            draw(CASES, results, arguments.out / "fluid.png")
    print(f"{arguments.out}/fluid.json, fluid.png")


if __name__ == "__main__":
    main()
