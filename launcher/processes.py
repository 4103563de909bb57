"""Child processes that never outlive the launcher: each in a process group of its own, told to end when the
launcher dies, and ended for certain when a run is over."""

import os
import shlex
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

from launcher.common import Refusal, printable

PR_SET_PDEATHSIG = 1


def hook(ends_itself: bool) -> Callable[[], None] | None:
    """What a child calls before it becomes its program. One that ends by itself, at once or with its standard input, needs
    nothing, and starts 10 ms sooner."""
    return None if ends_itself else ends_with_the_launcher()


def ends_with_the_launcher() -> Callable[[], None]:
    """A function for a child to call before it becomes its program."""
    import ctypes

    libc = ctypes.CDLL(None, use_errno=True)
    return lambda: libc.prctl(PR_SET_PDEATHSIG, signal.SIGTERM)


def ended(command: list[str], ends_itself: bool = False, **options) -> subprocess.CompletedProcess:
    """Runs a program to its end, or ours. What it prints is captured as text, whatever its bytes, unless `options` say
    otherwise."""
    options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | options
    return subprocess.run(command, encoding="utf-8", errors="replace", check=False, preexec_fn=hook(ends_itself), **options)


def answer(command: list[str]) -> str:
    """What a program prints that answers and ends; refuses in its own words where it ends with another status than 0."""
    done = ended(command, ends_itself=True)
    if done.returncode != 0:
        words = done.stderr.strip().removeprefix(f"{os.path.basename(command[0])}: ")
        raise Refusal(printable(words) or f"`{shlex.join(command)}` ended with {describe(done.returncode)}")
    return done.stdout


class Child:
    """A started program. Ctrl-C of the terminal does not reach it: it has its own process group."""

    def __init__(self, name: str, command: list[str], stdin=subprocess.DEVNULL, stdout=None, stderr=None,
                 environment: dict[str, str] | None = None, ends_itself: bool = False):
        self.name = name
        self.process = subprocess.Popen(command, stdin=stdin, stdout=stdout, stderr=stderr, process_group=0,
                                        env=os.environ | (environment or {}), preexec_fn=hook(ends_itself))

    @property
    def status(self) -> int | None:
        """Exit status, minus the number of the signal that ended it, or None while it runs."""
        return self.process.poll()

    @property
    def is_stopped(self) -> bool:
        """True while the program is there and stands still: by SIGSTOP, Ctrl-Z of a terminal, or a debugger."""
        try:
            state = Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
        except OSError:
            return False
        return state in "Tt"

    def signal(self, number: signal.Signals) -> None:
        """Signals the whole group, and so what the program itself has started."""
        try:
            os.killpg(self.process.pid, number)
        except ProcessLookupError:
            pass

    def wait(self, seconds: float) -> bool:
        try:
            self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            return False
        return True


def describe(status: int) -> str:
    """"status 1", or "signal 9 (SIGKILL)" for a program that a signal ended."""
    if status >= 0:
        return f"status {status}"
    try:
        return f"signal {-status} ({signal.Signals(-status).name})"
    except ValueError:
        return f"signal {-status}"


def end_all(children: list[Child], patience: float) -> None:
    """Waits `patience` seconds in all for them to end by themselves, then terminates, then kills."""
    deadline = time.monotonic() + patience
    for child in children:
        child.wait(max(0.0, deadline - time.monotonic()))
    for number, grace in ((signal.SIGTERM, 2.0), (signal.SIGKILL, 2.0)):
        running = [child for child in children if child.status is None]
        for child in running:
            child.signal(number)
        deadline = time.monotonic() + grace
        for child in running:
            child.wait(max(0.0, deadline - time.monotonic()))

