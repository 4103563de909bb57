"""What every part of the launcher shares: where things are, the one way to refuse a request, and files that are read or
written with a sentence where that fails."""

import contextlib
import errno
import os
import stat
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VERSION = ROOT / "VERSION"
IS_INSTALLED = not (ROOT / "CMakeLists.txt").exists()  # rather than a clone, in which programs are built
# Of processors of the level x86-64-v3; virtual machines may hide abm (lzcnt), which all that have BMI and AVX2 have.
V3_FLAGS = {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe", "xsave"}
FAILED, MISUSED = 1, 2  # exit statuses: the request failed, the command line is wrong


class Refusal(Exception):
    """A request that cannot be carried out; the text says what was required, what came and what to do, `status` is what
    `./fpi` ends with."""

    def __init__(self, text: str, status: int = FAILED):
        super().__init__(text)
        self.status = status


def programs(preset: str = "release") -> Path:
    """The folder of the programs; the variable FPI_BIN names another, e.g. one built with sanitizers."""
    return Path(os.environ.get("FPI_BIN") or (installed_programs() if IS_INSTALLED else ROOT / "build" / preset / "bin"))


def installed_programs() -> Path:
    """The best of the installed builds that this machine's processor can run."""
    with contextlib.suppress(OSError, StopIteration):
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as lines:
            flags = set(next(line for line in lines if line.startswith("flags")).split())
        if flags >= V3_FLAGS and (ROOT / "bin-v3").is_dir():
            return ROOT / "bin-v3"
    return ROOT / "bin"


def program(name: str) -> Path:
    path = programs() / name
    if not (path.is_file() and os.access(path, os.X_OK)):
        named = os.environ.get("FPI_BIN")
        raise Refusal(f"the program {path} is required and not there: "
                      + ("FPI_BIN must name the folder of the programs" if named else "run `./fpi build`"))
    return path


def printable(text: str) -> str:
    """Text from outside without what a terminal takes for commands."""
    return "".join(one if one.isprintable() or one in "\n\t" else ascii(one)[1:-1] for one in text)


# ---- files -------------------------------------------------------------------------------------------------------

KINDS = {stat.S_IFDIR: "a folder", stat.S_IFCHR: "a device", stat.S_IFBLK: "a device", stat.S_IFIFO: "a pipe",
         stat.S_IFSOCK: "a socket"}
REMEDIES = {errno.ENOSPC: "free some space", errno.EDQUOT: "free some space", errno.EROFS: "take another place",
            errno.EACCES: "change the permissions, or take another place",
            errno.EPERM: "change the permissions, or take another place",
            errno.EEXIST: "a folder is required there, move away what has its name",
            errno.ENOTDIR: "a folder is required where a file is, move the file away",
            errno.EISDIR: "a file is required there, move the folder away", errno.ELOOP: "links must not lead in circles",
            errno.ENAMETOOLONG: "take a shorter name", errno.ENOEXEC: "a program for this machine is required",
            errno.ENOENT: "the name, or what a link points to, must be there"}


def explain(error: OSError) -> str:
    """What the system says of a file, with what to do."""
    place = "the output" if error.filename is None else os.fsdecode(error.filename)
    remedy = REMEDIES.get(error.errno)
    return f"{place} cannot be used: {error.strerror or error}" + (f": {remedy}" if remedy else "")


@contextlib.contextmanager
def naming(path: Path):
    """Names the file in what the system says inside the block, which it does not where a disk is full."""
    try:
        yield
    except OSError as error:
        error.filename = error.filename or str(path)
        raise


def require_regular(path: Path) -> None:
    """Refuses what may block its reader or never end: a folder, a device, a pipe, a socket."""
    kind = stat.S_IFMT(path.stat().st_mode)
    if kind != stat.S_IFREG:
        raise Refusal(f"a regular file is required; {path} is {KINDS.get(kind, 'something else')}")


def require_plain(folder: Path) -> None:
    """Refuses a folder with something in it that may block the programs that read or write there."""
    for path in folder.iterdir():
        if not path.is_dir():
            require_regular(path)


def read_text(path: Path) -> str:
    require_regular(path)
    return path.read_text(encoding="utf-8", errors="replace")


def replace_text(path: Path, text: str) -> None:
    """Writes a file that is there as a whole or not at all."""
    temporary = path.with_name(path.name + ".new")
    with naming(path):
        temporary.write_text(text, encoding="utf-8")
        temporary.replace(path)
