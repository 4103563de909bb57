"""What the user sees of a run: a progress bar where there is a terminal and rich, plain lines elsewhere, nothing
where quiet was asked for (warnings and errors still go to standard error)."""

import sys
import time


class Display:
    """Says nothing but warnings."""

    def say(self, text: str) -> None:
        pass

    def warn(self, text: str) -> None:
        print(text, file=sys.stderr, flush=True)

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
        print(text, flush=True)

    def progress(self, state: dict) -> None:
        now = time.monotonic()
        if now - self.last >= self.INTERVAL:
            self.last = now
            print(sentence(state), flush=True)


class Rich(Display):
    """A bar that fills with the time of the run."""

    def __init__(self):
        from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn
        from rich.progress import TimeRemainingColumn

        self.bar = Progress(TaskProgressColumn(), BarColumn(), TimeElapsedColumn(), TextColumn("left"),
                            TimeRemainingColumn(), TextColumn("{task.description}", markup=False), transient=True)
        self.task = self.bar.add_task("starting", total=1.0)
        self.bar.start()

    def say(self, text: str) -> None:
        self.bar.console.print(text, markup=False, highlight=False)

    def warn(self, text: str) -> None:
        self.say(text)

    def progress(self, state: dict) -> None:
        end = state.get("end") or 0
        fraction = state.get("time", 0) / end if end > 0 else 0
        self.bar.update(self.task, completed=fraction, description=sentence(state))

    def close(self) -> None:
        self.bar.stop()


def sentence(state: dict) -> str:
    """"step 12 of 900, t = 0.012 s, 3 sub-iterations: text"."""
    words = f"step {state.get('step', 0)} of {state.get('steps', 0)}, t = {state.get('time', 0):.4g} s"
    if state.get("sub_iterations"):
        words += f", {state['sub_iterations']} sub-iterations"
    return f"{words}: {state['text']}" if state.get("text") else words


def choose(quiet: bool) -> Display:
    if quiet:
        return Display()
    if sys.stdout.isatty():
        try:
            return Rich()
        except ImportError:
            pass  # set-up installs it; a run must not need it
    return Plain()
