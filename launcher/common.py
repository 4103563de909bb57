"""What every part of the launcher shares: where things are, and the one way to refuse a request."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


class Refusal(Exception):
    """A request that cannot be carried out; the text says what was required, what came and what to do."""


def programs(preset: str = "release") -> Path:
    """The folder of the built programs; the variable FPI_BIN names another, e.g. one built with sanitizers."""
    return Path(os.environ.get("FPI_BIN") or ROOT / "build" / preset / "bin")


def program(name: str) -> Path:
    path = programs() / name
    if not os.access(path, os.X_OK):
        raise Refusal(f"the program {path} is required and not there: run `./fpi build`")
    return path
