"""Set-up: which Debian packages are needed and why, which are missing, and how they get installed."""

import contextlib
import os
import shutil
import subprocess
from pathlib import Path

from launcher.common import IS_INSTALLED, ROOT, Refusal, read_text
from launcher.processes import ended

BUILD = {
    "g++": "compiles the programs (C++20)",
    "cmake": "configures the build",
    "dpkg-dev": "finds what a package of the programs depends on",
    "ninja-build": "runs the build on all cores",
    "pkg-config": "finds the libraries below",
    "libeigen3-dev": "dense and sparse matrices",
    "libsuitesparse-dev": "UMFPACK, the sparse direct solver",
    "libmumps-seq-dev": "MUMPS, the faster one of the two direct solvers",
    "libmetis-dev": "METIS, the order in which unknowns are eliminated",
    "libopenblas-dev": "the dense kernels under UMFPACK",
    "libzmq3-dev": "messages between the programs",
    "cppzmq-dev": "the same in C++",
    "libflatbuffers-dev": "encoding of the messages",
    "flatbuffers-compiler": "compiles the message schema",
    "libhdf5-dev": "results on disk",
    "libfmt-dev": "text formatting",
    "libspdlog-dev": "logs",
    "libcli11-dev": "command lines of the programs",
    "libtoml11-dev": "scene files",
    "nlohmann-json3-dev": "summaries as JSON",
    "libmuparser-dev": "formulas in scene files",
    "libgtest-dev": "the tests",
}
RUN = {
    "python3-rich": "progress bar and tables",
    "python3-h5py": "reads results for the pictures",
    "python3-matplotlib": "draws the pictures",
}
LINT = {
    "git": "names the files of the project",
    "clang-format": "the format of the sources in C++",
    "pyflakes3": "faults in the sources in Python",
}
NEEDED = RUN if IS_INSTALLED else BUILD | RUN
STATUS = Path("/var/lib/dpkg/status")  # changes with every package
MEMORY = ROOT / "build" / "packages"  # what the last good answer of dpkg rested on


def installed(names) -> set[str]:
    """Those of `names` that dpkg knows as installed, in one call."""
    query = ["dpkg-query", "--show", "--showformat", "${db:Status-Abbrev} ${binary:Package}\n", *names]
    lines = ended(query).stdout.splitlines()
    return {line[3:].strip().split(":")[0] for line in lines if line.startswith("ii")}


def missing(needed: dict[str, str] = NEEDED) -> list[str]:
    if shutil.which("dpkg-query") is None:
        raise Refusal(
            "set-up knows Debian 12 (dpkg, apt); this system has no dpkg-query. Install what corresponds to: "
            + ", ".join(needed)
        )
    there = installed(needed)
    return [name for name in needed if name not in there]


def grounds() -> str:
    """What the answer of dpkg rests on: the state of the system and the names it is asked for."""
    return "\n".join([str(STATUS.stat().st_mtime_ns) if STATUS.exists() else "", *NEEDED])


def remembered() -> str | None:
    with contextlib.suppress(OSError, Refusal):
        return read_text(MEMORY)
    return None


def remember() -> None:
    with contextlib.suppress(OSError):  # where nothing can be written dpkg is asked each time
        MEMORY.parent.mkdir(exist_ok=True)
        MEMORY.write_text(grounds())


def ensure(say=print) -> None:
    """Installs what is missing; silent where nothing is, and dpkg is not asked again until a package or the list
    changes. Without root it prints the command and refuses."""
    if remembered() == grounds():
        return
    install(NEEDED, say)
    remember()


def install(needed: dict[str, str], say=print) -> None:
    """Installs those of `needed` that are missing."""
    names = missing(needed)
    if not names:
        return
    say("These Debian packages are missing:")
    for name in names:
        say(f"  {name:22s} {needed[name]}")
    command = ["apt-get", "install", "-y", "--no-install-recommends", *names]
    if os.geteuid() != 0:
        raise Refusal("only root can install them. Run this, then try again:\n  sudo apt-get update && sudo "
                      + " ".join(command))
    say("Installing them with apt-get.")
    run_apt(["apt-get", "update"])
    run_apt(command)
    still = missing(needed)
    if still:
        raise Refusal(f"apt-get ended well but these packages are still missing: {', '.join(still)}")


def run_apt(command: list[str]) -> None:
    """Runs apt quietly; its words appear only where it fails. It outlives the launcher: what it unpacks it sets up."""
    environment = os.environ | {"DEBIAN_FRONTEND": "noninteractive"}
    try:
        done = subprocess.run(command, env=environment, capture_output=True, encoding="utf-8", errors="replace", check=False)
    except FileNotFoundError as error:
        raise Refusal(f"set-up needs the program {command[0]}; this system has none") from error
    if done.returncode != 0:
        raise Refusal(f"`{' '.join(command)}` must succeed; it ended with status {done.returncode}:\n"
                      f"{done.stdout[-2000:]}{done.stderr[-2000:]}")
