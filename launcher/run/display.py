"""What the user sees of a run: a progress bar where there is a terminal and rich, plain lines elsewhere, nothing
where quiet was asked for (warnings still go to standard error). A run goes on where nobody reads any more."""

import contextlib
import sys
import time

from launcher.common import printable


class Display:
    """Says nothing but warnings."""

    def say(self, text: str) -> None:
        pass

    def warn(self, text: str) -> None:
        with contextlib.suppress(OSError):
            print(printable(text), file=sys.stderr, flush=True)

    def progress(self, state: dict) -> None:
        pass

    def close(self) -> None:
        pass


class Plain(Display):
    """Lines, progress at most every ten seconds."""

    INTERVAL = 10.0

    def __init__(self):
        self.last = -self.INTERVAL

    def say(self, text: str) -> None:
        with contextlib.suppress(OSError):
            print(printable(text), flush=True)

    def progress(self, state: dict) -> None:
        now = time.monotonic()
        if now - self.last >= self.INTERVAL:
            self.last = now
            self.say(state["text"])


class Rich(Display):
    """A bar that fills with the time of the run."""

    def __init__(self):
        from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

        self.bar = Progress(TaskProgressColumn(), BarColumn(bar_width=16), TimeRemainingColumn(compact=True),
                            TextColumn("{task.description}", markup=False), transient=True)
        self.task = self.bar.add_task("starting", total=1.0)
        self.bar.start()

    def say(self, text: str) -> None:
        self.bar.console.print(printable(text), markup=False, highlight=False)

    def warn(self, text: str) -> None:
        self.say(text)

    def progress(self, state: dict) -> None:
        end = state.get("end") or 0
        fraction = state.get("time", 0) / end if end > 0 else 0
        self.bar.update(self.task, completed=fraction, description=state["text"])

    def close(self) -> None:
        self.bar.stop()


def choose(quiet: bool) -> Display:
    if quiet:
        return Display()
    if sys.stdout.isatty():
        try:
            return Rich()
        except ImportError:
            pass  # set-up installs it; a run must not need it
    return Plain()
