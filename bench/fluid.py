#!/usr/bin/python3
"""Run time against error of fluid_server on the benchmark flows, beside FreeFem++ and dolfinx where they are installed.
Whole programs on one core, taking turns so that noise hits all alike; nothing is asserted here."""

import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from bench.cases import CASES
from bench.measure import fastest_rows, measure
from bench.results import draw, table, write_json
from bench.tools import ROOT, Run

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
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"of {', '.join(CASES)}; all where none is named")
    parser.add_argument("--quick", action="store_true", help="the coarsest mesh of each program")
    parser.add_argument("--rungs", type=int, default=9, metavar="N", help="the N coarsest meshes of each program")
    parser.add_argument("--out", type=Path, default=ROOT / "runs" / "bench", metavar="DIR", help="for JSON and picture")
    arguments = parser.parse_args()
    names = arguments.cases or list(CASES)
    if unknown := set(names) - set(CASES):
        parser.error(f"a case of {', '.join(CASES)} is required; got {', '.join(unknown)}")
    arguments.out.mkdir(parents=True, exist_ok=True)

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
