#!/usr/bin/python3
"""Sub-steps of grains a second, memory, and accuracy against step size of our DEM beside LAMMPS, LIGGGHTS and Yade where
they are installed. All read the same packings, one core each, taking turns so that noise hits all alike; nothing is
asserted here."""

import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from bench import grain_results
from bench.arguments import bench_parser, read_arguments
from bench.grain_peers import Job, Program, programs
from bench.impacts import accuracy
from bench.measure import fastest_rows, measure
from bench.packings import STEP, Packing, gas, mirrored, settled
from bench.results import write_json
from bench.tools import ROOT

GRAIN_STEPS = 1e7  # of a run
SLOW = 10  # seconds from which a run is not repeated
BUILD = ROOT / "build" / "release"


@dataclass
class Case:
    count: int
    packing: Callable[[Path, Path], Packing]  # from a folder and our driver


def dense(count: int, discs: bool = False) -> Case:
    return Case(count, lambda folder, driver: settled(count, discs, folder, driver))


def ten_dense(folder: Path, driver: Path) -> Packing:
    return mirrored(settled(10000, False, folder, driver), 5, 2, folder)


def loose(count: int) -> Case:
    return Case(count, lambda folder, driver: gas(count, folder))


CASES = {"dense 1k": dense(1000), "dense 10k": dense(10000), "dense 100k": Case(100000, ten_dense),
         "gas 10k": loose(10000), "gas 100k": loose(100000), "discs 2.5k": dense(2500, discs=True)}


def make_driver() -> Path:
    subprocess.run(["ninja", "-C", str(BUILD), "grains_bench"], check=True, stdout=subprocess.DEVNULL)
    return BUILD / "bin" / "grains_bench"


def compare(packing: Packing, runners: list[Program], folder: Path, rounds: int, grain_steps: float) -> list[dict]:
    """Each program's fastest run of some rounds."""
    steps = max(20, round(grain_steps / packing.count))

    def row(program: Program) -> dict:
        measured = measure(program.command(Job(packing, steps, STEP, 0.5, folder / "end.csv")))
        seconds = program.seconds(measured.output)
        return {"program": program.name, "grains": packing.count, "steps": steps, "seconds": seconds,
                "megabytes": measured.megabytes, "million_steps_per_second": packing.count * steps / seconds / 1e6}

    return fastest_rows(rounds, SLOW, runners, row)


def main() -> None:
    parser = bench_parser(__doc__, CASES, "one round of a tenth of the steps, up to 10 000 grains")
    parser.add_argument("--rounds", type=int, default=3, metavar="N", help="of which the fastest run counts")
    parser.add_argument("--driver", type=Path, help="a build of grains_bench (default: made here)")
    arguments = read_arguments(parser, CASES)
    names = arguments.cases or [name for name, case in CASES.items() if not arguments.quick or case.count <= 10000]

    driver = arguments.driver or make_driver()
    runners = programs(driver)
    results: dict = {"throughput": {}, "impacts": []}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for case in names:
            packing = CASES[case].packing(folder, driver)
            rounds, grain_steps = (1, GRAIN_STEPS / 10) if arguments.quick else (arguments.rounds, GRAIN_STEPS)
            rows = results["throughput"][case] = compare(packing, runners, folder, rounds, grain_steps)
            print(grain_results.throughput_table(case, rows), flush=True)
            write_json(results, arguments.out / "grains.json")
        for program in runners:
            results["impacts"] += accuracy(program, folder)
    print(grain_results.impact_table(results["impacts"]))
    write_json(results, arguments.out / "grains.json")
    grain_results.draw(results, arguments.out / "grains.png")
    print(f"{arguments.out}/grains.json, grains.png")


if __name__ == "__main__":
    main()
