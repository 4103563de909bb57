"""One run: asks the coupler which programs the scene needs, starts them, tells the coupler when one of them ends,
and leaves nothing running behind."""

import contextlib
import json
import os
import selectors
import shlex
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from launcher.common import Refusal, program
from launcher.display import Display
from launcher.processes import Child, describe, end_all

OURS = {"fluid": "fluid_server", "dem": "dem_server"}
PATIENCE = 3.0  # [s] for participants after the goodbye
NOT_STARTED = 127  # the shell's status for a program that cannot be started
INTERRUPT_PATIENCE = 15.0  # [s] for the coupler to close its files after Ctrl-C


class Request:
    """What is to be run, and where."""

    def __init__(self, scene: Path, folder: Path, overrides: list[str] | None = None, resume: bool = False,
                 listen: str | None = None, keys: Path | None = None, threads: int | None = None):
        self.scene, self.folder, self.overrides, self.resume = scene, folder, overrides or [], resume
        self.listen, self.keys, self.threads = listen, keys, threads


def plan(scene: Path, overrides: list[str]) -> dict:
    """What the coupler says about a scene: title, fingerprint and the participants it needs."""
    text = ask("--plan", scene, overrides)
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise Refusal(f"`coupler --plan` must print JSON; got {text[:200]!r} ({error})") from error


def ask(question: str, scene: Path, overrides: list[str]) -> str:
    """What the coupler answers; refuses with its own words where it does."""
    command = [str(program("coupler")), question, str(scene), *set_options(overrides)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        words = done.stderr.strip().removeprefix("coupler: ")
        raise Refusal(words or f"`{shlex.join(command)}` ended with {describe(done.returncode)}")
    return done.stdout


def set_options(overrides: list[str]) -> list[str]:
    return [word for override in overrides for word in ("--set", override)]


def new_folder(out: Path | None, scene: Path) -> Path:
    """Makes the run folder: `out`, which must be new or empty, or the first free runs/NAME, runs/NAME-2, …"""
    if out is not None:
        if out.exists() and (not out.is_dir() or any(out.iterdir())):
            raise Refusal(f"--out must name a new or empty folder; {out} holds something: choose another or remove it")
        out.mkdir(parents=True, exist_ok=True)
        return out
    number = 1
    while True:
        folder = Path("runs") / (scene.stem if number == 1 else f"{scene.stem}-{number}")
        try:
            folder.mkdir(parents=True)
            return folder
        except FileExistsError:
            number += 1


class Run:
    """The processes of a run and the watch over them."""

    def __init__(self, request: Request, the_plan: dict, display: Display):
        self.request = request
        self.plan = the_plan
        self.display = display
        self.coupler: Child | None = None
        self.participants: list[Child] = []
        self.told: set[str] = set()
        self.interrupted_at: float | None = None
        self.stopped_at_once = False

    def execute(self) -> int:
        """Runs to the end and returns the coupler's exit status, or 130 after an interruption."""
        with interruptions_call(self.interrupt):
            self.coupler = Child("coupler", self.coupler_command(), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE)
            try:
                self.watch()
            finally:
                end_all([self.coupler, *self.participants], PATIENCE)
                self.remove_empty_outputs()
        if self.interrupted_at is not None:
            return 130
        status = self.coupler.status
        return 1 if status is None or status < 0 else status

    def sudden_end(self) -> str:
        """How the run ended where the coupler could not say it itself; empty where it could."""
        status = self.coupler.status
        if status is None or status >= 0:
            return ""
        words = "stopped by the user at once" if self.stopped_at_once else f"coupler was killed by {describe(status)}"
        if (self.request.folder / "checkpoint.h5").exists():
            words += f"; `./fpi resume {self.request.folder}` continues from the last checkpoint"
        return words

    def coupler_command(self) -> list[str]:
        request = self.request
        command = [str(program("coupler")), "--out", str(request.folder), "--watch-stdin"]
        command += ["--resume"] if request.resume else ["--scene", str(request.scene), *set_options(request.overrides)]
        if request.listen:
            command += ["--listen", request.listen]
        if request.keys:
            command += ["--keys", str(request.keys)]
        return command

    def watch(self) -> None:
        """Follows the coupler's words until it has ended."""
        with selectors.DefaultSelector() as selector:
            selector.register(self.coupler.process.stdout, selectors.EVENT_READ, Lines(self.hear))
            selector.register(self.coupler.process.stderr, selectors.EVENT_READ, Lines(self.display.warn))
            while selector.get_map():
                for key, _ in selector.select(timeout=0.1):
                    data = os.read(key.fd, 65536)
                    key.data.take(data)
                    if not data:
                        selector.unregister(key.fileobj)
                self.tell_of_exits()
                if self.interrupted_at and time.monotonic() - self.interrupted_at > INTERRUPT_PATIENCE:
                    self.display.warn("the coupler does not end; it is terminated")
                    return

    def hear(self, line: str) -> None:
        """A line of the coupler's standard output: its address, progress, or words for the user."""
        word, _, rest = line.partition(" ")
        if word == "address":
            self.start_participants(rest.strip())
        elif word == "progress":
            self.display.progress(json.loads(rest))
        elif line:
            self.display.say(line)

    def start_participants(self, address: str) -> None:
        for participant in self.plan["participants"]:
            role = participant["role"]
            words = shlex.split(participant["command"])
            options = ["--scene", str(self.plan["scene_fingerprint"])]
            if self.request.keys:
                options += ["--keys", str(self.request.keys)]
            if participant["external"]:
                command = [*(words or [OURS[role]]), "--connect", reachable(address, "HOST"), *options]
                self.display.say(f"Waiting for the {role} program; start it with: {shlex.join(command)}")
                continue
            words = [*(words or [str(program(OURS[role]))]), "--connect", reachable(address, "127.0.0.1")]
            log = self.request.folder / f"{OURS[role]}.log"
            with self.output_path(role).open("wb") as output:
                try:
                    self.participants.append(Child(role, [*words, *options, "--log", str(log)], stdout=output,
                                                   stderr=subprocess.STDOUT, environment=self.environment()))
                except OSError as error:
                    self.display.warn(f"the {role} program cannot be started: {error}")
                    self.tell(role, NOT_STARTED)

    def environment(self) -> dict[str, str]:
        """Unless asked otherwise elements are assembled on all cores, and dense kernels run on one, as more only get in
        the way of small fronts."""
        if self.request.threads is None:
            return {} if "OPENBLAS_NUM_THREADS" in os.environ else {"OPENBLAS_NUM_THREADS": "1"}
        return {name: str(self.request.threads) for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")}

    def output_path(self, role: str) -> Path:
        """Where a program's words outside its log go: a crash, a sanitizer's report."""
        return self.request.folder / f"{OURS[role]}.out"

    def remove_empty_outputs(self) -> None:
        for participant in self.participants:
            path = self.output_path(participant.name)
            if path.exists() and path.stat().st_size == 0:
                path.unlink()

    def tell_of_exits(self) -> None:
        for participant in self.participants:
            if participant.status is not None and participant.name not in self.told:
                self.tell(participant.name, participant.status)

    def tell(self, role: str, status: int) -> None:
        """Tells the coupler that a participant is gone; it decides what that means. A signal counts negative."""
        self.told.add(role)
        with contextlib.suppress(OSError):
            self.coupler.process.stdin.write(f"exited {role} {status}\n".encode())
            self.coupler.process.stdin.flush()

    def interrupt(self, number: int, _frame) -> None:
        """The first Ctrl-C asks the coupler to end the run in good order, the second ends everything."""
        first = self.interrupted_at is None
        if first:
            self.interrupted_at = time.monotonic()
            self.display.say("Ending the run: files are closed, all programs are told. (Ctrl-C again: at once.)")
        else:  # possibly inside the handling of the first
            self.stopped_at_once = True
        for child in [self.coupler] if first else [self.coupler, *self.participants]:
            if child is not None and child.status is None:
                child.signal(signal.Signals(number) if first else signal.SIGKILL)


class Check(Run):
    """A run's set-up without a step: what of the scene would refuse it, and what is doubtful."""

    def __init__(self, scene: Path, folder: Path, overrides: list[str]):
        super().__init__(Request(scene, folder, overrides), {"participants": []}, Display())
        self.report: dict | None = None
        self.words: list[str] = []
        self.display.warn = self.words.append

    def coupler_command(self) -> list[str]:
        return [str(program("coupler")), "--check", str(self.request.scene), "--json", "--watch-stdin",
                *set_options(self.request.overrides)]

    def hear(self, line: str) -> None:
        """What the coupler wants started, and in the end its report."""
        word, _, rest = line.partition(" ")
        if word == "plan":
            self.plan = json.loads(rest)
        elif word == "address":
            self.start_participants(rest.strip())
        elif word == "report":
            self.report = json.loads(rest)


def check(scene: Path, overrides: list[str]) -> dict:
    """The coupler's report on a scene. Refuses where the check did not come to its end; leaves nothing behind."""
    with tempfile.TemporaryDirectory(prefix="fpi-check-") as folder:
        the_check = Check(scene, Path(folder), overrides)
        status = the_check.execute()
    if status == 130:
        raise KeyboardInterrupt
    if the_check.report is None:
        words = "\n".join(the_check.words).removeprefix("coupler: ")
        raise Refusal(words or the_check.sudden_end() or f"the check of {scene} ended with status {status} and without a report")
    return the_check.report


class Lines:
    """Cuts a stream of bytes into lines."""

    def __init__(self, take_line):
        self.take_line = take_line
        self.rest = b""

    def take(self, data: bytes) -> None:
        """Takes what was read; nothing means the end of the stream."""
        *lines, self.rest = (self.rest + data).split(b"\n")
        if not data and self.rest:
            lines.append(self.rest)
            self.rest = b""
        for line in lines:
            self.take_line(line.decode(errors="replace"))


@contextlib.contextmanager
def interruptions_call(handler):
    """SIGINT and SIGTERM call `handler` inside the block."""
    before = {number: signal.signal(number, handler) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, action in before.items():
            signal.signal(number, action)


def reachable(address: str, host: str) -> str:
    """The bound address as a program connects to it, with `host` in place of "every interface"."""
    for everywhere in ("0.0.0.0", "[::]", "*"):
        address = address.replace(f"//{everywhere}:", f"//{host}:")
    return address
