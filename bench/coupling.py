#!/usr/bin/python3
"""What it takes to couple free bodies to the fluid: sub-iterations, solves, factors, time and error of each acceleration
and response on the same scenes, and the cost of a coupled step over one with given motion. Nothing is asserted here."""

import csv
import json
import shutil
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from bench import coupling_results
from bench.arguments import bench_parser, read_arguments
from bench.measure import fastest_rows, measure
from bench.results import write_json
from bench.tools import ROOT

ROUNDS = 3  # of the runs whose cost is compared
SCENES = ROOT / "bench" / "scenes"
LEFT_OUT = 5  # steps that start without history
METHODS = [("fluid", "iqn-ils"), ("analytic", "iqn-ils"), ("analytic", "iqn-imvj"), ("analytic", "aitken"),
           ("analytic", "constant"), ("none", "iqn-ils"), ("none", "iqn-imvj"), ("none", "aitken"), ("none", "constant")]
EXACT = ["coupling.relative_tolerance=1e-9", "fluid.newton.relative_tolerance=1e-11"]


@dataclass
class Case:
    """Bodies of one density, in steps in which they come to move by 0.4 h or a little less."""
    scene: str
    group: str  # what holds the bodies, and the columns of their motion
    columns: str
    cell: float  # h [m]
    density_ratio: float
    speed: float  # towards the end [m/s]
    asked: float  # mean sub-iterations

    @property
    def step(self) -> float:
        return 0.4 * self.cell / self.speed

    def sets(self, steps: int) -> list[str]:
        return [f"{self.group}.density={1000 * self.density_ratio}", f"time.step={self.step!r}",
                f"time.end={steps * self.step!r}", "time.max_halvings=0"]


def one_disc(density_ratio: float, speed: float, asked: float) -> Case:
    return Case(str(SCENES / "one_disc.toml"), "bodies.0", "disc", 3.125e-4, density_ratio, speed, asked)


def twenty_discs(density_ratio: float, speed: float, asked: float) -> Case:
    return Case(str(SCENES / "twenty_discs.toml"), "grains.0", "discs", 4.17e-4, density_ratio, speed, asked)


CASES = {
    "one": [one_disc(2.65, 0.10, 2.1), one_disc(1.25, 0.05, 2.1), one_disc(1.01, 0.004, 2.1), one_disc(0.5, 0.07, 2.5),
            one_disc(0.1, 0.1, 2.5), one_disc(0.01, 0.1, 3), one_disc(0, 0.1, 3)],
    "twenty": [twenty_discs(1.25, 0.03, 2.5), twenty_discs(0.1, 0.06, 3), twenty_discs(0, 0.06, 3.5)],
}
STEPS = {"one": 30, "twenty": 20}
QUICK = {"one": (1.25, 0.1, 0), "twenty": (0.1,)}


def run(case: Case, sets: list[str], folder: Path) -> tuple[dict, list[dict]]:
    """Summary, with the processor's "seconds" a step, and history of a run, whose status may be failed."""
    out = folder / "run"
    shutil.rmtree(out, ignore_errors=True)
    command = [str(ROOT / "fpi"), "run", case.scene, "--out", str(out), "--json", *(w for s in sets for w in ("--set", s))]
    measured = measure(command, may_fail=True)
    summary = json.loads(measured.output)
    summary["seconds"] = measured.processor_seconds / max(1, summary["steps"])
    with (out / "history.csv").open(newline="") as text:
        return summary, [{name: float(value) for name, value in row.items()} for row in csv.DictReader(text)]


def velocities(case: Case, history: list[dict]) -> list[tuple[float, float]]:
    return [(row[f"{case.columns}.vx"], row[f"{case.columns}.vy"]) for row in history]


def largest(vectors: list[tuple[float, float]]) -> float:
    return max((x * x + y * y) ** 0.5 for x, y in vectors)


def compare(case: Case, steps: int, folder: Path) -> list[dict]:
    """A row a method; errors are those of the velocity (of twenty discs: their mean) against a small tolerance's."""
    _, history = run(case, case.sets(steps) + EXACT, folder)
    exact = velocities(case, history)
    rows = []
    for response, acceleration in METHODS:
        summary, history = run(case, [*case.sets(steps), f'coupling.response="{response}"',
                                      f'coupling.acceleration="{acceleration}"'], folder)
        row = {"density_ratio": case.density_ratio, "response": response, "acceleration": acceleration,
               "asked": case.asked, "status": summary["status"]}
        if summary["status"] == "completed":
            counts, found = [line["sub_iterations"] for line in history], velocities(case, history)
            error = largest([(a - c, b - d) for (a, b), (c, d) in zip(found, exact)]) / largest(exact)
            row |= {"mean": sum(counts[LEFT_OUT:]) / len(counts[LEFT_OUT:]), "most": max(counts), "first": counts[0],
                    "solves": summary["solves"] / len(counts), "factorisations": summary["factorisations"] / len(counts),
                    "seconds": summary["seconds"], "error": error,
                    "shift": largest(found) * case.step / case.cell}
        rows.append(row)
    return rows


def over_prescribed(case: Case, steps: int, folder: Path) -> dict:
    """Seconds of a coupled step over those of one in which the bodies are moved alike by formulas."""
    _, history = run(case, case.sets(steps), folder)
    x, y = velocities(case, history)[-1]
    given = [f'{case.group}.motion="prescribed"',
             f'{case.group}.prescribed_velocity=["{x!r}*t/{steps * case.step!r}", "{y!r}*t/{steps * case.step!r}"]']

    def row(sets: list[str]) -> dict:
        summary, _ = run(case, case.sets(steps) + sets, folder)
        return {"seconds": summary["seconds"], "factorisations": summary["factorisations"] / summary["steps"]}

    coupled, prescribed = fastest_rows(ROUNDS, float("inf"), ([], given), row)
    return {"coupled": coupled, "prescribed": prescribed, "ratio": coupled["seconds"] / prescribed["seconds"]}


def main() -> None:
    parser = bench_parser(__doc__, CASES, "some density ratios, half the steps")
    arguments = read_arguments(parser, CASES)
    names = arguments.cases or list(CASES)

    results: dict = {}
    with tempfile.TemporaryDirectory() as name:
        for key in names:
            count = STEPS[key] // 2 if arguments.quick else STEPS[key]
            cases = [case for case in CASES[key] if not arguments.quick or case.density_ratio in QUICK[key]]
            rows = [row for case in cases for row in compare(case, count, Path(name))]
            results[key] = {"methods": rows, "cost": over_prescribed(cases[0], count, Path(name))}
            print(coupling_results.table(key, results[key]), flush=True)
            write_json(results, arguments.out / "coupling.json")
            coupling_results.draw(results, arguments.out / "coupling.png")
    print(f"{arguments.out}/coupling.json, coupling.png")


if __name__ == "__main__":
    main()
