"""One run: asks the coupler which programs the scene needs, starts them, tells the coupler when one of them ends,
and leaves nothing running behind."""

import contextlib
import json
import os
import re
import selectors
import shlex
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from launcher.common import Refusal, explain, printable, program
from launcher.ending import STOPPED, STOPS
from launcher.processes import Child, answer, describe, end_all
from launcher.run import trust
from launcher.run.display import Display
from launcher.run.report import has_checkpoint

OURS = {"fluid": "fluid_server", "dem": "dem_server"}
PATIENCE = 3.0  # [s] for participants after the goodbye
NOT_STARTED = 127  # the shell's status for a program that cannot be started
INTERRUPT_PATIENCE = 15.0  # [s] for the coupler to close its files after Ctrl-C
LOGGED = re.compile(r"\S+ \S+ coupler \w+: ")  # a line of its log
COMPLAINT = re.compile(r"(?:\S+ \S+ coupler error|coupler): (.*)")


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
    return answer([str(program("coupler")), question, str(scene), *set_options(overrides)])


def set_options(overrides: list[str]) -> list[str]:
    return [word for override in overrides for word in ("--set", override)]


def new_folder(out: Path | None, scene: Path) -> Path:
    """Makes the run folder: `out`, which must be new or empty, or the first free runs/NAME, runs/NAME-2, …"""
    if out is not None:
        if out.exists() and (not out.is_dir() or any(out.iterdir())):
            raise Refusal(f"--out must name a new or empty folder; {out} holds something: choose another or remove it")
        out.mkdir(parents=True, exist_ok=True)
        return out
    runs = Path("runs")
    runs.mkdir(exist_ok=True)
    number = 1
    while True:
        folder = runs / (scene.stem if number == 1 else f"{scene.stem}-{number}")
        try:
            folder.mkdir()
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
        self.complaints: list[str] = []  # errors of the coupler, in its words
        self.not_started: list[str] = []
        self.stopped_by: int | None = None  # number of the first signal
        self.stopped: list[Child] = []  # those that the user was told of
        self.token_file = ""  # of the run, from the coupler; empty where there are keys
        self.interrupted_at: float | None = None
        self.stopped_at_once = False

    def execute(self) -> int:
        """Runs to the end and returns the coupler's exit status, or that of an interruption."""
        with interruptions_call(self.interrupt):
            self.coupler = Child("coupler", self.coupler_command(), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, ends_itself=True)
            try:
                self.watch()
            finally:
                end_all([self.coupler, *self.participants], PATIENCE)
                self.remove_empty_outputs()
        if self.stopped_by is not None:
            return 128 + self.stopped_by
        status = self.coupler.status
        return 1 if status is None or status < 0 else status

    def outcome(self, summary: dict | None) -> dict:
        """The summary of the run as far as it is of this one, with a status and a reason in any case."""
        status, said = self.coupler.status, "; ".join(self.complaints)
        if sudden := self.sudden_end():
            return {**(summary or {}), "status": "failed", "reason": f"{said}; {sudden}" if said else sudden}
        if summary is None or said and printable(summary["reason"].strip()) not in self.complaints:
            how = said or f"coupler ended with {describe(status)} before it had results; see {self.request.folder}/*.log"
            return {"status": "failed", "reason": how + self.details()}
        if status != 0 and summary["status"] == "completed":
            return {**summary, "status": "failed", "reason": f"coupler ended with {describe(status)}"}
        return {**summary, "reason": summary["reason"] + self.details()}

    def details(self) -> str:
        """What the coupler cannot know of its failure."""
        return "".join(f" ({text})" for text in self.not_started)

    def sudden_end(self) -> str:
        """How the run ended where the coupler could not say it itself; empty where it could."""
        status = self.coupler.status
        if status is None or status >= 0:
            return ""
        words = f"coupler was killed by {describe(status)}"
        if self.stopped_by is not None:
            words = STOPPED + (" at once" if self.stopped_at_once else "" if status == -self.stopped_by else f"; {words}")
        if has_checkpoint(self.request.folder):
            words += f"; `./fpi resume {self.request.folder}` continues from the last checkpoint"
        return words

    def coupler_command(self) -> list[str]:
        request = self.request
        command = [str(program("coupler")), "--out", str(request.folder), "--watch-stdin"]
        command += ["--resume"] if request.resume else ["--scene", str(request.scene)]
        command += set_options(request.overrides)
        if request.listen:
            command += ["--listen", request.listen]
        if request.keys:
            command += ["--keys", str(request.keys)]
        return command

    def watch(self) -> None:
        """Follows the coupler's words until it has ended."""
        with selectors.DefaultSelector() as selector:
            selector.register(self.coupler.process.stdout, selectors.EVENT_READ, Lines(self.hear))
            selector.register(self.coupler.process.stderr, selectors.EVENT_READ, Lines(self.hear_error))
            while selector.get_map():
                for key, _ in selector.select(timeout=0.1):
                    data = os.read(key.fd, 65536)
                    key.data.take(data)
                    if not data:
                        selector.unregister(key.fileobj)
                self.tell_of_exits()
                self.pass_interruption_on()
                self.tell_of_stops()
                self.tell_of_time()
                if self.interrupted_at and time.monotonic() - self.interrupted_at > INTERRUPT_PATIENCE:
                    self.display.warn("the coupler does not end; it is terminated")
                    return

    def hear(self, line: str) -> None:
        """A line of the coupler's standard output: its token file and address, progress, or words for the user."""
        word, _, rest = line.partition(" ")
        if word == "token":
            self.token_file = rest
        elif word == "address":
            self.start_participants(rest.strip())
        elif word == "progress":
            self.display.progress(json.loads(rest))
        elif line:
            self.display.say(printable(line))

    def hear_error(self, line: str) -> None:
        """A line of the coupler's standard error. Its errors are kept for the end, where they are told once."""
        logged = LOGGED.match(line)
        if complaint := COMPLAINT.match(line):
            self.complaints.append(printable(complaint[1]))
        elif self.complaints and not logged:
            self.complaints[-1] += "\n" + printable(line)
        elif line:
            self.display.warn(printable(line))

    def start_participants(self, address: str) -> None:
        for participant in self.plan["participants"]:
            role = participant["role"]
            words = trust.words(role, participant["command"])
            options = ["--scene", str(self.plan["scene_fingerprint"])]
            if self.request.keys:
                options += ["--keys", str(self.request.keys)]
            elif self.token_file:
                options += ["--token", self.token_file]
            if participant["external"]:
                command = [*(words or [OURS[role]]), "--connect", reachable(address, "HOST"), *options]
                self.display.say(f"Waiting for the {role} program; start it with: {shlex.join(command)}")
                continue
            words = [*(words or [str(program(OURS[role]))]), "--connect", reachable(address, "127.0.0.1")]
            log = self.request.folder / f"{OURS[role]}.log"
            try:
                with self.output_path(role).open("wb") as output:
                    self.participants.append(Child(role, [*words, *options, "--log", str(log)], stdout=output,
                                                   stderr=subprocess.STDOUT, environment=self.environment()))
            except OSError as error:
                self.not_started.append(f"the {role} program could not be started: {explain(error)}")
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
            with contextlib.suppress(OSError):
                if path.stat().st_size == 0:
                    path.unlink()

    def tell_of_exits(self) -> None:
        for participant in self.participants:
            if participant.status is not None and participant.name not in self.told:
                self.tell(participant.name, participant.status)

    def tell_of_stops(self) -> None:
        """Names programs that stand still, once each time: the run waits for them, or gives them up."""
        for child in [self.coupler, *self.participants]:
            if child.is_stopped == (child in self.stopped):
                continue
            if child.is_stopped:
                self.stopped.append(child)
                self.display.warn(f"{child.name} is stopped (process {child.process.pid}); it goes on after: kill -CONT {child.process.pid}")
            else:
                self.stopped.remove(child)
                if child.status is None:
                    self.display.warn(f"{child.name} goes on")

    def tell_of_time(self) -> None:
        """For what has no progress of its own."""

    def tell(self, role: str, status: int) -> None:
        """Tells the coupler that a participant is gone; it decides what that means. A signal counts negative."""
        self.told.add(role)
        with contextlib.suppress(OSError):
            self.coupler.process.stdin.write(f"exited {role} {status}\n".encode())
            self.coupler.process.stdin.flush()

    def interrupt(self, number: int, _frame) -> None:
        """The first Ctrl-C ends the run in good order, see below; the second ends everything here and now."""
        if self.stopped_by is None:
            self.stopped_by = number
            return
        self.stopped_at_once = True
        for child in [self.coupler, *self.participants]:
            if child is not None and child.status is None:
                child.signal(signal.SIGKILL)

    def pass_interruption_on(self) -> None:
        """Asks the coupler, once, to end the run. Not done by the handler of the signal, which may come within a print, or
        before the coupler is there."""
        if self.stopped_by is None or self.interrupted_at is not None:
            return
        self.interrupted_at = time.monotonic()
        self.display.say("Ending the run: files are closed, all programs are told. (Ctrl-C again: at once.)")
        self.coupler.signal(signal.Signals(self.stopped_by))


class Check(Run):
    """A run's set-up without a step: what of the scene would refuse it, and what is doubtful."""

    SAID_EVERY = 10.0  # [s]; meshes of millions of cells take half a minute

    def __init__(self, scene: Path, folder: Path, overrides: list[str], quiet: bool):
        super().__init__(Request(scene, folder, overrides), {"participants": []}, Display())
        self.report: dict | None = None
        self.begun = self.said = time.monotonic()
        self.quiet = quiet

    def tell_of_time(self) -> None:
        now = time.monotonic()
        if not self.quiet and now - self.said >= self.SAID_EVERY:
            self.said = now
            self.display.warn(f"checking {self.request.scene}: {now - self.begun:.0f} s so far")

    def coupler_command(self) -> list[str]:
        return [str(program("coupler")), "--check", str(self.request.scene), "--out", str(self.request.folder),
                "--json", "--watch-stdin",
                *set_options(self.request.overrides)]

    def hear(self, line: str) -> None:
        """What the coupler wants started, and in the end its report."""
        word, _, rest = line.partition(" ")
        if word == "plan":
            self.plan = json.loads(rest)
        elif word == "report":
            self.report = json.loads(rest)
        else:
            super().hear(line)


def check(scene: Path, overrides: list[str], quiet: bool = False) -> dict:
    """The coupler's report on a scene. Says how long it takes where that is long, unless `quiet`. Refuses where the check
    did not come to its end; leaves nothing behind."""
    with tempfile.TemporaryDirectory(prefix="fpi-check-") as folder:
        the_check = Check(scene, Path(folder), overrides, quiet)
        status = the_check.execute()
    if status >= 128:
        raise Refusal(STOPPED, status)
    if the_check.report is None:
        raise Refusal(the_check.outcome(None)["reason"])
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
            self.take_line(line.decode(errors="surrogateescape"))  # a token file may be called anything


@contextlib.contextmanager
def interruptions_call(handler):
    """SIGINT and SIGTERM call `handler` inside the block."""
    before = {number: signal.signal(number, handler) for number in STOPS}
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
