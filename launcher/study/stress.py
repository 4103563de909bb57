"""`./fpi stress`: random cases of bodies embedded in the fluid or coupled to it, a process each so that none takes
others with it, and a table of how they went."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path

from launcher.common import ROOT, Refusal, program, replace_text
from launcher.processes import answer, describe, ended
from launcher.setup import build

LONGEST = 900  # seconds after which a case counts as hanging


@dataclass
class Subject:
    """What is tried, by a program that lists cases by name and runs one, and what is measured of each."""
    command: Callable[[], list[str]]
    cases: int
    quick_cases: int
    quantities: tuple[str, ...]  # the larger the worse


SUBJECTS = {
    "interface": Subject(lambda: [str(program("interface_stress"))], 260, 20, ("error", "noise", "condition")),
    "coupling": Subject(lambda: [sys.executable, "-I", str(ROOT / "stress" / "coupling.py")], 240, 12,
                        ("sub_iterations", "rejected", "factorisations", "seconds")),
}


@dataclass
class Sweep:
    name: str
    seed: int = 1
    cases: int | None = None
    only: str | None = None  # one case by its name
    quick: bool = False

    @property
    def subject(self) -> Subject:
        return SUBJECTS[self.name]

    def options(self) -> list[str]:
        return ["--seed", str(self.seed), *(["--quick"] if self.quick else [])]

    def titles(self) -> dict[str, str]:
        """What each family of cases is about."""
        return {name.split("-")[0]: title for name, title in self.listed()}

    def names(self) -> list[str]:
        return [self.only] if self.only else [name for name, _ in self.listed()]

    def listed(self) -> list[tuple[str, str]]:
        cases = self.cases or (self.subject.quick_cases if self.quick else self.subject.cases)
        listing = answer([*self.subject.command(), "--list", str(cases)])
        return [tuple(line.split("\t")) for line in listing.splitlines()]

    def run_case(self, name: str) -> dict:
        """What the case says of itself, or how its process ended."""
        command = [*self.subject.command(), *self.options(), name]
        one_thread = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
        try:
            done = ended(command, timeout=LONGEST, env=one_thread)
        except subprocess.TimeoutExpired:
            return {"case": name, "failure": f"no end after {LONGEST} s", "refused": False, "parameters": {}}
        if done.returncode == 2:
            raise Refusal(done.stderr.strip())
        if done.returncode != 0 or not done.stdout.strip():
            how = f"its process ended with {describe(done.returncode)} {done.stderr.strip()}".strip()
            return {"case": name, "failure": how, "refused": False, "parameters": {}}
        return json.loads(done.stdout.splitlines()[-1])

    def run(self, jobs: int | None, quiet: bool) -> list[dict]:
        """All cases, several at a time, in the order of their names' list."""
        names, found = self.names(), {}
        counter = build.Counter("stress", quiet)
        with ThreadPoolExecutor(jobs or os.cpu_count()) as pool:
            running = {pool.submit(self.run_case, name): name for name in names}
            try:
                for done in as_completed(running):
                    found[running[done]] = done.result()
                    counter.see(f"[{len(found)}/{len(names)}]")
            finally:
                pool.shutdown(cancel_futures=True)
                counter.close()
        return [found[name] for name in names]

    def repeat(self, name: str) -> str:
        return " ".join([f"./fpi stress {self.name}", *self.options(), "--only", name])


def table(sweep: Sweep, results: list[dict]) -> str:
    """A line a family: how many survived, and the worst of what its cases measured, with the case."""
    quantities = sweep.subject.quantities
    lines = [f"{'family':9s}{'cases':>6s}{'good':>6s}{'refused':>8s}{'failed':>7s}  "
             + "".join(f"{'worst ' + name.replace('_', '-'):24s}" for name in quantities)]
    for family, title in sweep.titles().items():
        rows = [row for row in results if row["case"].split("-")[0] == family]
        if not rows:
            continue
        refused = sum(row["refused"] for row in rows)
        failed = sum(bool(row["failure"]) for row in rows) - refused
        lines.append(f"{family:9s}{len(rows):6d}{len(rows) - refused - failed:6d}{refused:8d}{failed:7d}  "
                     + "".join(f"{worst(rows, name):24s}" for name in quantities) + title)
    return "\n".join(lines)


def worst(rows: list[dict], quantity: str) -> str:
    rows = [row for row in rows if quantity in row]
    if not rows:
        return "-"
    row = max(rows, key=lambda one: one[quantity])
    return f"{row[quantity]:.3g} ({row['case']})"


def failures(sweep: Sweep, results: list[dict]) -> str:
    """Each case that did not survive, why, and the command that repeats it."""
    return "\n".join(f"{row['case']} {'refused' if row['refused'] else 'failed'}: {row['failure']}\n"
                     f"  {sweep.repeat(row['case'])}" for row in results if row["failure"])


def write(path: Path, sweep: Sweep, results: list[dict]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    replace_text(path, json.dumps({"subject": sweep.name, "seed": sweep.seed, "quick": sweep.quick, "cases": results}, indent=1) + "\n")
