"""`./fpi lint`: format, faults that tools find, and documents that no longer fit, without building anything."""

import os
import re
import subprocess
import sys
import unicodedata
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

from launcher.common import ROOT, Refusal
from launcher.processes import ended

WIDEST = 120  # columns of a line of text
GENERATED = {"docs/paper.md", "docs/scene_reference.md"}  # a test holds them against what they are made of
ALONE = re.compile(r"\s*`[^`]*`\W*$")  # one piece of code by itself
TOOLS = {"clang-format": "clang-format", "pyflakes3": "pyflakes3", "clang-tidy": "clang-tidy"}  # program: Debian package


def lint(tidy: str | None = None, base: str = "HEAD") -> list[str]:
    """What is wrong, a sentence each. `tidy`: clang-tidy on sources "changed" since `base`, or on "all" (slow)."""
    steps: list[tuple[str, Callable[[], Iterator[str]]]] = [
        ("C++ format", unformatted), ("Python", python_faults), ("line length", long_lines), ("structure and documents", structure_faults)]
    if tidy:
        steps.append(("clang-tidy", lambda: tidy_faults(tracked("*.cpp") if tidy == "all" else changed(base))))
    found = []
    for title, step in steps:
        faults = list(step())
        print(f"{title}: {len(faults) or 'no'} fault{'' if len(faults) == 1 else 's'}", flush=True)
        found += faults
    return found


def tracked(*patterns: str) -> list[str]:
    """Files of the project; without git, as in an unpacked archive, all that are there but results and builds."""
    try:
        return git("ls-files", *patterns)
    except Refusal:
        paths = (path.relative_to(ROOT) for pattern in patterns for path in ROOT.rglob(pattern))
        return sorted(str(path) for path in paths if path.parts[0] not in ("build", "runs"))


def changed(base: str) -> list[str]:
    return [name for name in git("diff", "--name-only", "--diff-filter=d", base) if name.endswith(".cpp")]


def git(*words: str) -> list[str]:
    try:
        done = ended(["git", "-C", str(ROOT), *words])
    except FileNotFoundError as error:
        raise Refusal("what changed is known to git only, and the program git is not there: apt-get install -y git") from error
    if done.returncode != 0:
        raise Refusal(f"`git {words[0]}` must succeed: {done.stderr.strip()}")
    return [line for line in done.stdout.splitlines() if line]


def tool(name: str, *words: str) -> subprocess.CompletedProcess:
    try:
        return ended([name, *words], cwd=ROOT)
    except FileNotFoundError as error:
        raise Refusal(f"{name} is required and not there: apt-get install -y {TOOLS[name]}") from error


def unformatted() -> Iterator[str]:
    done = tool("clang-format", "--dry-run", *tracked("*.cpp", "*.hpp"))
    for name in sorted(set(re.findall(r"^(\S+?):\d+:\d+: warning: code should be clang-formatted", done.stderr, re.M))):
        yield f"{name}: not formatted; run: clang-format -i {name}"


def python_faults() -> Iterator[str]:
    yield from tool("pyflakes3", *tracked("*.py")).stdout.splitlines()


def long_lines() -> Iterator[str]:
    """Of text; tables, pictures, code and addresses cannot be broken."""
    for name in tracked("*.md"):
        is_code = False
        for number, line in enumerate((ROOT / name).read_text().splitlines(), 1):
            is_code ^= line.startswith("```")
            free = is_code or name in GENERATED or line.lstrip().startswith(("|", "![", "http", "<")) or ALONE.match(line)
            if not free and width(line) > WIDEST:
                yield f"{name}:{number}: a line of at most {WIDEST} columns is required; got {width(line)}"


def width(line: str) -> int:
    return sum(not unicodedata.combining(letter) for letter in line)


def structure_faults() -> Iterator[str]:
    """Includes against the architecture, names and links in documents: the tests that need no build."""
    for test in tracked("tests/structure/*_test.py"):
        done = ended([sys.executable, str(ROOT / test)])
        if done.returncode != 0:
            yield f"{test}: {done.stderr.strip().splitlines()[-1]}; run it to see"


def tidy_faults(names: list[str]) -> Iterator[str]:
    """With the compile commands of the build without unity sources, `dev`."""
    database = ROOT / "build" / "dev" / "compile_commands.json"
    if not database.exists():
        raise Refusal("clang-tidy needs the compile commands of build/dev: run `cmake --preset dev` first")
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for done in pool.map(lambda name: tool("clang-tidy", "-p", str(database.parent), "--quiet", name), names):
            yield from (line.removeprefix(f"{ROOT}/") for line in done.stdout.splitlines() if re.search(r": (error|warning): ", line))
