"""Whether a scene may start programs of its own (`command = …`): its user says so once, for these commands and this scene."""

import contextlib
import json
import os
import shlex
import shutil
import sys
from pathlib import Path

from launcher.common import Refusal, read_text, require_regular


def commands(plan: dict) -> dict[str, str]:
    """By role, what the scene starts in place of our own programs."""
    return {one["role"]: one["command"] for one in plan["participants"] if one["command"].strip() and not one["external"]}


def words(role: str, command: str) -> list[str]:
    """The words of a command, as a shell has them."""
    try:
        return shlex.split(command)
    except ValueError as error:
        raise Refusal(f"{role}.command must be words as a shell takes them; got {command!r}: {error}") from error


def require(scene: Path, plan: dict, trusted: bool, overrides: list[str] = ()) -> None:
    """Asks on a terminal whether the programs of the scene may be started, and refuses elsewhere, unless the user has said
    so before, says so now, or has given the commands himself."""
    started = commands(plan)
    if not started:
        return
    mark = mark_of(started, plan)
    given = {one.partition("=")[0].strip() for one in overrides}
    if mark in remembered():
        return
    if not trusted and not all(f"{role}.command" in given for role in started) and not asked(scene, started):
        raise Refusal(f"{scene} starts programs: {listed(started)}. Where you trust it, say --trust: it is remembered for "
                      "these commands and this scene")
    remember(mark, scene)


def remember_run(scene: Path, plan: dict) -> None:
    """The scene that a run left in its folder may do what that which it was made of may."""
    if started := commands(plan):
        mark = mark_of(started, plan)
        if mark not in remembered():
            remember(mark, scene)


def listed(started: dict[str, str]) -> str:
    return ", ".join(f"`{command}` for {role}" for role, command in started.items())


def asked(scene: Path, started: dict[str, str]) -> bool:
    """The answer of the user; no where there is no terminal."""
    if not (sys.stdin.isatty() and sys.stderr.isatty()):
        return False
    print(f"{scene} starts programs, which can do whatever you can: {listed(started)}.\nMay it? [y/N] ", end="",
          file=sys.stderr, flush=True)
    return sys.stdin.readline().strip().lower() in ("y", "yes")


def mark_of(started: dict[str, str], plan: dict) -> str:
    """Of commands, the files that they name here, and a scene."""
    import hashlib  # loads OpenSSL, which a scene without commands need not wait for

    located = {role: [located_word(word) for word in words(role, command)] for role, command in started.items()}
    return hashlib.sha256(json.dumps([located, plan["scene_fingerprint"]], sort_keys=True).encode()).hexdigest()


def located_word(word: str) -> str:
    found = shutil.which(word) or word
    return os.path.realpath(found) if os.path.exists(found) else word


# ---- what is remembered: a line each of mark and scene -----------------------------------------------------------


def memory() -> Path | None:
    """The file, of the user alone; None for a user without a home."""
    named = os.environ.get("XDG_CONFIG_HOME", "")
    home = Path(named) if os.path.isabs(named) else Path(os.path.expanduser("~/.config"))
    return home / "fpi" / "trusted" if home.is_absolute() else None


def remembered() -> set[str]:
    path = memory()
    with contextlib.suppress(OSError, Refusal):
        return {line.split(" ")[0] for line in read_text(path).splitlines()} if path else set()
    return set()


def remember(mark: str, scene: Path) -> None:
    """Where nothing can be written the user is asked each time."""
    path = memory()
    with contextlib.suppress(OSError, Refusal):
        if path:
            path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            if path.exists():
                require_regular(path)
            with open(path, "a", encoding="utf-8", errors="replace", opener=lambda name, flags: os.open(name, flags, 0o600)) as file:
                file.write(f"{mark} {str(scene.resolve())!r}\n")
