"""One program on one core: how long it takes from start to end, and how much memory its largest process needs."""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass

ONE_THREAD = {name: "1" for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")}


@dataclass
class Measured:
    seconds: float
    processor_seconds: float  # which other work on the machine hardly changes
    megabytes: float
    output: str


def fastest_rows(rounds: int, patience: float, runners: Iterable, row_of: Callable) -> list[dict]:
    """The fastest row of each of the runners, which take turns for some rounds; one that took more than `patience`
    seconds is not repeated. row_of(runner) runs it and returns its row, with its "seconds"."""
    fastest: dict[int, dict] = {}
    for _ in range(rounds):
        for number, runner in enumerate(runners):
            before = fastest.get(number)
            if before and before["seconds"] > patience:
                continue
            row = row_of(runner)
            if before is None or row["seconds"] < before["seconds"]:
                fastest[number] = row
    return list(fastest.values())


def measure(command: list[str], may_fail: bool = False) -> Measured:
    """Runs the command to its end on one core; ends the bench where it fails, unless it may."""
    if shutil.which("taskset"):
        command = ["taskset", "-c", str(max(os.sched_getaffinity(0))), *command]
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as errors:
        start = time.monotonic()
        process = subprocess.Popen(command, stdout=out, stderr=errors, env=os.environ | ONE_THREAD)
        _, status, usage = os.wait4(process.pid, 0)  # its memory counts the programs it started, too
        seconds = time.monotonic() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        errors.seek(0)
        output = out.read()
        if process.returncode != 0 and not may_fail:
            sys.exit(f"bench: `{' '.join(command)}` ended with status {process.returncode}:\n"
                     f"{output[-1000:]}{errors.read()[-1000:]}")
    return Measured(seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, output)
