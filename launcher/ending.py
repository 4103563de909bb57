"""How `./fpi` ends: with a status, and where that is not 0 with the cause, said once: as the one JSON document on
standard output where `--json` asks for it, else in a line on standard error. Never with a traceback."""

import json
import math
import os
import signal
import sys
from collections.abc import Callable

from launcher.common import Refusal, explain

STOPS = (signal.SIGINT, signal.SIGTERM)
UNREAD = 128 + signal.SIGPIPE  # the status, as a shell has it, where nobody reads what is printed
STOPPED = "stopped by the user"


def end(words: list[str], carry_out: Callable[[list[str]], int]) -> int:
    """Carries out the words of the command line; returns the exit status."""
    as_json = "--json" in words
    listen(as_json)
    told = False
    try:
        status = carry_out(words)
    except SystemExit as leaving:  # of -h
        status = leaving.code or 0
    except (Exception, KeyboardInterrupt) as error:
        if os.environ.get("FPI_TRACEBACK"):
            raise
        refusal = refusal_of(error)
        status, told = refusal.status, tell(refusal, as_json)
    hold_stops()
    return delivered(status, told)


def listen(as_json: bool) -> None:
    """Ctrl-C and SIGTERM end this process at once, wherever it is: an exception could be lost on its way, or come to a
    library that prints it. What it started ends with it (see processes); a run handles them itself."""
    ours = os.getpid()

    def stop(number, _frame):
        status = 128 + number
        if os.getpid() == ours:  # else a child that has not become its program yet
            text = document_of({"status": "failed", "reason": STOPPED}) if as_json else f"fpi: {STOPPED}"
            write_all(1 if as_json else 2, text + "\n")
        os._exit(status)

    for number in STOPS:
        signal.signal(number, stop)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, STOPS)  # held since before python started: see fpi


def hold_stops() -> None:
    """From here on nothing comes between what is printed and the end, which is near."""
    signal.pthread_sigmask(signal.SIG_BLOCK, STOPS)


def refusal_of(error: BaseException) -> Refusal:
    """What to tell the user of an error."""
    match error:
        case Refusal():
            return error
        case KeyboardInterrupt():
            return Refusal(STOPPED, 128 + signal.SIGINT)
        case BrokenPipeError():
            return Refusal("", UNREAD)
        case OSError():
            return Refusal(explain(error))
        case MemoryError():
            return Refusal("more memory is required than there is")
        case ImportError():
            return Refusal(f"Python must import {error.name or 'a module'} and cannot: {error}; `./fpi build` installs "
                           "the packages that fpi needs")
    place = error.__traceback__
    while place.tb_next is not None:
        place = place.tb_next
    return Refusal(f"the launcher has a fault, please report it: {type(error).__name__}: {error} "
                   f"({place.tb_frame.f_code.co_filename}:{place.tb_lineno}); FPI_TRACEBACK=1 shows how it came there")


def tell(refusal: Refusal, as_json: bool) -> bool:
    """False where it cannot be told."""
    if not as_json:
        write_all(2, f"fpi: {refusal}\n" if str(refusal) else "")
        return True
    try:
        document({"status": "failed", "reason": str(refusal)})
    except OSError:
        return False
    return True


def document(content) -> None:
    """Prints the one JSON document of a command; nothing comes after it."""
    hold_stops()
    sys.stdout.write(document_of(content) + "\n")


def document_of(content) -> str:
    return json.dumps(as_json_has_it(content), indent=2, allow_nan=False)


def as_json_has_it(value):
    """JSON has neither infinite numbers nor text that is not UTF-8, as names of files may be."""
    if isinstance(value, dict):
        return {as_json_has_it(key): as_json_has_it(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [as_json_has_it(entry) for entry in value]
    if isinstance(value, str):
        return value.encode("utf-8", "surrogateescape").decode("utf-8", "replace")
    return None if isinstance(value, float) and not math.isfinite(value) else value


def write_all(descriptor: int, text: str) -> None:
    """Writes past the streams of Python, which a handler of signals may find in the midst of a write."""
    data = text.encode("utf-8", "surrogateescape")
    try:
        while data:
            data = data[os.write(descriptor, data):]
    except OSError:
        pass  # nobody is there to be told


def delivered(status: int, told: bool) -> int:
    """The status, or that of an output which cannot be written, which is told where no other failure was."""
    try:
        sys.stdout.flush()
        return status
    except OSError as error:
        refusal = refusal_of(error)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # where Python writes what is left
    if not told:
        tell(refusal, as_json=False)
    return status or refusal.status


def open_streams() -> None:
    """Standard streams that the caller has closed are nowhere: else the first file that is opened takes their place."""
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    sys.stdin, sys.stdout, sys.stderr = sys.stdin or open(0), sys.stdout or open(1, "w"), sys.stderr or open(2, "w")
    sys.stdout.reconfigure(line_buffering=True)  # progress must show in a pipe or a log, too
