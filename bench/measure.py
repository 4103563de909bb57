"""One program on one core: how long it takes from start to end, and how much memory its largest process needs."""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass

ONE_THREAD = {name: "1" for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")}


@dataclass
class Measured:
    seconds: float
    megabytes: float
    output: str


def measure(command: list[str]) -> Measured:
    """Runs the command to its end on one core; ends the bench where it fails."""
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
        if process.returncode != 0:
            sys.exit(f"bench: `{' '.join(command)}` ended with status {process.returncode}:\n"
                     f"{output[-1000:]}{errors.read()[-1000:]}")
    return Measured(seconds, usage.ru_maxrss / 1024, output)
