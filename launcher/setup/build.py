"""Configuring, building and testing: CMake and CTest with one line of progress, and their words on failure."""

import fcntl
import math
import os
import re
import subprocess
import sys
from pathlib import Path

from launcher.common import IS_INSTALLED, ROOT, Refusal, naming
from launcher.processes import ends_with_the_launcher

PRESETS = ("release", "dev", "asan", "tsan")
PROGRAMS = ("coupler", "dem_server", "fluid_server")  # what a run needs
EVERYTHING = ("all",)
CONFIGURED = "fpi.configured"  # changes with each configuration, which CMake's own files need not
SECONDS_A_STEP = 8  # of one core: the mean over the steps of a release build, for the estimate before the first of them ends


def build(preset: str = "release", jobs: int | None = None, quiet: bool = False, targets=PROGRAMS) -> None:
    """Brings `targets` in build/PRESET up to date. A second call finds nothing to do and says nothing."""
    if IS_INSTALLED:
        raise Refusal("building and testing need the sources, of which this is an installation: do it in a clone of fpi")
    folder = ROOT / "build" / preset
    folder.mkdir(parents=True, exist_ok=True)
    log = folder / "build.log"
    with (folder / "fpi.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # a second ./fpi waits for the first, then finds the work done
        log.write_text("")
        if not is_configured(folder):
            follow(["cmake", "--preset", preset], log, f"configuring {preset}", quiet)
            (folder / CONFIGURED).touch()
        cores = jobs or os.cpu_count() or 1
        follow(["ninja", "-C", str(folder), "-j", str(cores), *targets], log, f"building {preset}", quiet, cores)


def is_configured(folder: Path) -> bool:
    """Whether a build has the values of the presets as they are now."""
    stamp, presets = folder / CONFIGURED, ROOT / "CMakePresets.json"
    return (folder / "build.ninja").exists() and stamp.exists() and stamp.stat().st_mtime >= presets.stat().st_mtime


def test(preset: str, everything: bool, jobs: int | None = None, quiet: bool = False) -> int:
    """Runs the fast tests, or all; returns the status of ctest, whose closing lines are printed."""
    folder = ROOT / "build" / preset
    log = folder / "test.log"
    log.write_text("")
    command = ["ctest", "--test-dir", str(folder), "--output-on-failure", "--no-tests=error",
               "--parallel", str(jobs or os.cpu_count() or 1)]
    if not everything:
        command += ["--label-regex", "^fast$"]
    status, lines = stream(command, log, "testing", quiet)
    failed = [i for i, line in enumerate(lines) if "***" in line]
    closing = [i for i, line in enumerate(lines) if "tests passed" in line]
    if status != 0 and failed:
        print("\n".join(lines[failed[0]:closing[0]] if closing else lines[failed[0]:]))
    print("\n".join(lines[closing[0]:] if closing else lines[-20:]))
    return status


def follow(command: list[str], log: Path, title: str, quiet: bool, cores: int | None = None) -> None:
    """Runs a command of the build; where it fails, everything from its first failure on is shown. With the number of cores
    at work it says before the first step how long all will take, and where the log is."""
    announce = (lambda steps: print(forecast(title, steps, cores, log), flush=True)) if cores else None
    status, lines = stream(command, log, title, quiet, announce)
    if status == 0:
        return
    first = next((i for i, line in enumerate(lines) if re.search(r"FAILED|CMake Error", line)), max(0, len(lines) - 40))
    raise Refusal("\n".join(lines[first:]) + f"\n{title} must succeed; `{' '.join(command)}` ended with status "
                  f"{status} (all of its output: {log})")


def forecast(title: str, steps: int, cores: int, log: Path) -> str:
    minutes = math.ceil(steps * SECONDS_A_STEP / cores / 60)
    return f"{title}: {steps} steps, about {minutes} min on {cores} core{'s' if cores > 1 else ''}; log: {log}"


def stream(command: list[str], log: Path, title: str, quiet: bool, announce=None) -> tuple[int, list[str]]:
    """Runs `command`, its output into `log`; returns status and lines. Counts like [12/80] become progress; `announce` is
    called with the number of steps before the first of them ends."""
    lines = []
    counter = Counter(title, quiet, announce)
    try:
        process = subprocess.Popen(command, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   encoding="utf-8", errors="replace", preexec_fn=ends_with_the_launcher())
    except FileNotFoundError as error:
        raise Refusal(f"{title} needs the program {command[0]}: {error}; run `./fpi build`, which installs it") from error
    with process, naming(log), log.open("a", buffering=1, encoding="utf-8") as file:
        for line in process.stdout:
            lines.append(line.rstrip("\n"))
            file.write(line)
            counter.see(line)
    counter.close()
    return process.returncode, lines


class Counter:
    """One line of progress on a terminal, a line each quarter elsewhere; silent while there is nothing to do."""

    STEP = re.compile(r"^\[(\d+)/(\d+)\]|^\s*(\d+)/(\d+) Test ")

    def __init__(self, title: str, quiet: bool, announce=None):
        self.title = title
        self.quiet = quiet
        self.announce = announce
        self.terminal = sys.stdout.isatty()
        self.quarter = 0
        self.shown = False

    def see(self, line: str) -> None:
        match = self.STEP.match(line)
        if match is None or self.quiet:
            return
        done, total = (int(number) for number in match.groups() if number is not None)
        if self.announce:
            self.announce(total)
            self.announce = None
        if self.terminal:
            print(f"\r{self.title}: {done} of {total} ", end="", flush=True)
            self.shown = True
        elif 4 * done // total > self.quarter:
            self.quarter = 4 * done // total
            print(f"{self.title}: {done} of {total}", flush=True)

    def close(self) -> None:
        if self.shown:
            print()
