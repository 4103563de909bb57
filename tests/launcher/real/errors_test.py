"""What users do wrong, and what comes in their way: each is told once, by a sentence, whatever was asked for."""

import os
import shutil
import socket
import subprocess
import unittest
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from fpi_case import DRY, ROOT, FpiCase, is_root_with_mounts

WALL = '[[materials]]\nname = "glass"\nyoungs_modulus = 1e6\n[[walls]]\nname = "cup"\nshape = "mesh"\nfile = "{}"\n'
TABLE = '[[materials]]\nname = "glass"\nyoungs_modulus = 1e6\n[[grains]]\nname = "grain"\ngenerator = "csv"\nshape = "sphere"\ndensity = 1000\nfile = "{}"\n'
MESH = """
time = {{step = 0.1, end = 1}}
[fluid]
density = 1
dynamic_viscosity = 1
mesh = {{file = "{}"}}
boundaries = {{wall.type = "no_slip"}}
"""
CHANNEL = """
time = {step = 0.1, end = 1}
[fluid]
density = 1
dynamic_viscosity = 1
mesh = {lower = [0, 0], upper = [1, 1], cell_size = 0.5}
boundaries = {left.type = "no_slip", right.type = "no_slip", bottom.type = "no_slip", top.type = "no_slip"}
"""


@dataclass
class Mistake:
    """What is done, what must be said of it, and the status."""
    name: str
    words: list
    cause: str
    prepare: Callable[[Path], object] = lambda folder: None
    status: int = 1
    environment: dict | None = None


def write(name: str, text: str | bytes):
    def prepare(folder: Path):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    return prepare


def all_of(*steps):
    return lambda folder: [step(folder) for step in steps]


def link(name: str, target: str):
    return lambda folder: (folder / name).symlink_to(target)


def folder(name: str):
    return lambda place: (place / name).mkdir(parents=True)


def pipe(name: str):
    def prepare(place: Path):
        (place / name).parent.mkdir(parents=True, exist_ok=True)
        os.mkfifo(place / name)
    return prepare


def unix_socket(name: str):
    def prepare(place: Path):
        with socket.socket(socket.AF_UNIX) as one:
            one.bind(str(place / name))
    return prepare


def dry_run(place: Path):
    """A run that reached its end."""
    done = subprocess.run([ROOT / "fpi", "run", "dry.toml", "--quiet", "--out", "done"], cwd=place, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr


def with_command(command: str):
    return write("c.toml", CHANNEL.replace("[fluid]", f"[fluid]\ncommand = {command!r}"))


MODES = ("", "--quiet", "--json")
RUNS = [  # of what takes --quiet and --json
    Mistake("no such scene", ["run", "nope"], "there is no nope"),
    Mistake("a folder as scene", ["run", "f"], "f is a folder", folder("f")),
    Mistake("a pipe as scene", ["run", "p.toml"], "p.toml is a pipe", pipe("p.toml")),
    Mistake("a device as scene", ["run", "/dev/zero"], "/dev/zero is a device"),
    Mistake("a socket as scene", ["run", "s.toml"], "s.toml is a socket", unix_socket("s.toml")),
    Mistake("a link to nothing as scene", ["run", "l.toml"], "l.toml is a link to nothing", link("l.toml", "gone.toml")),
    Mistake("a link to itself as scene", ["run", "l.toml"], "l.toml is a link to nothing", link("l.toml", "l.toml")),
    Mistake("a file of the system without size", ["run", "/proc/cpuinfo"], "/proc/cpuinfo is empty"),
    Mistake("an empty scene", ["run", "e.toml"], "e.toml is empty", write("e.toml", "")),
    Mistake("a program as scene", ["run", "b.toml"], "is required", lambda place: shutil.copy("/bin/true", place / "b.toml")),
    Mistake("text of another alphabet as scene", ["run", "b.toml"], "is required", write("b.toml", b'title = "caf\xe9"\n' + DRY.encode())),
    Mistake("a scene of zeros", ["run", "b.toml"], "is required", write("b.toml", bytes(1000))),
    Mistake("a name that is too long", ["run", "x" * 5000], "File name too long"),
    Mistake("a name that is no UTF-8", ["run", b"caf\xe9.toml"], "there is no caf"),
    Mistake("an error in a scene with a name that is no UTF-8", ["run", b"caf\xe9.toml"], "flud", lambda place: write(os.fsdecode(b"caf\xe9.toml"), "flud = 1\n" + DRY)(place)),
    Mistake("a misspelt key", ["run", "m.toml"], '"titel"', write("m.toml", DRY.replace("title", "titel"))),
    Mistake("a wrong value", ["run", "dry.toml", "--set", "time.end=zzz"], "must be a finite number"),
    Mistake("half an override", ["run", "dry.toml", "--set", "time.end"], "must be written key=value"),
    Mistake("commands for a terminal", ["run", "dry.toml", "--set", "time.end=\x1b[2J"], "must be a finite number"),
    Mistake("an override of nothing", ["run", "dry.toml", "--set", "time.stop=1"], '"time.stop"'),
    Mistake("a mesh that is not there", ["run", "m.toml"], "No such file", write("m.toml", MESH.format("gone.msh"))),
    Mistake("a pipe as mesh", ["run", "m.toml"], "p.msh is a pipe", all_of(write("m.toml", MESH.format("p.msh")), pipe("p.msh"))),
    Mistake("a device as mesh", ["run", "m.toml"], "/dev/zero is a device", write("m.toml", MESH.format("/dev/zero"))),
    Mistake("an empty mesh", ["run", "m.toml"], "m.msh is empty", all_of(write("m.toml", MESH.format("m.msh")), write("m.msh", ""))),
    Mistake("a mesh that is none", ["run", "m.toml"], "m.msh", all_of(write("m.toml", MESH.format("m.msh")), write("m.msh", "junk\n"))),
    Mistake("a folder as STL", ["run", "w.toml"], "cup.stl is a folder", all_of(write("w.toml", DRY + WALL.format("cup.stl")), folder("cup.stl"))),
    Mistake("a pipe as table", ["run", "t.toml"], "t.csv is a pipe", all_of(write("t.toml", DRY + TABLE.format("t.csv")), pipe("t.csv"))),
    Mistake("results that would be overwritten", ["run", "dry.toml", "--out", "."], "holds something"),
    Mistake("a file as folder of results", ["run", "dry.toml", "--out", "dry.toml"], "holds something"),
    Mistake("a file above the folder of results", ["run", "dry.toml", "--out", "dry.toml/r"], "Not a directory"),
    Mistake("a link to nothing as folder of results", ["run", "dry.toml", "--out", "l"], "l cannot be used", link("l", "gone")),
    Mistake("a file in place of the folder of all runs", ["run", "dry.toml"], "runs cannot be used", write("runs", "")),
    Mistake("a link to nothing in place of it", ["run", "dry.toml"], "runs cannot be used", link("runs", "gone")),
    Mistake("a folder that nobody may write", ["run", "dry.toml", "--out", "/sys/fpi"], "/sys/fpi cannot be used"),
    Mistake("an address that is none", ["run", "dry.toml", "--listen", "nowhere"], "nowhere"),
    Mistake("an open address without keys", ["run", "dry.toml", "--listen", "tcp://0.0.0.0:*"], "0.0.0.0"),
    Mistake("keys that are not there", ["run", "dry.toml", "--keys", "gone"], "fpi keys gone"),
    Mistake("resuming what is no run", ["resume", "."], "there is none in ."),
    Mistake("resuming what is not there", ["resume", "gone"], "there is none in gone"),
    Mistake("resuming what reached its end", ["resume", "done"], "the run reached its end", dry_run),
    Mistake("a pipe among the results", ["resume", "r"], "r/history.csv is a pipe", all_of(write("r/scene.toml", DRY), pipe("r/history.csv"))),
    Mistake("a program of the scene", ["run", "c.toml"], "say --trust", with_command("my_solver --fast")),
    Mistake("a command with half a quote", ["run", "c.toml", "--trust"], "No closing quotation", with_command("my 'solver")),
    Mistake("a program that is not there", ["run", "c.toml", "--trust"], "could not be started", with_command("no-such-program")),
    Mistake("a folder as program", ["run", "c.toml", "--trust"], "could not be started", with_command("/tmp")),
    Mistake("a program that ends at once", ["run", "c.toml", "--trust"], "fluid", with_command("false")),
    Mistake("a sweep over nothing", ["sweep", "dry.toml", "time.end"], "key=a,b,c is required"),
    Mistake("a sweep over a wrong value", ["sweep", "dry.toml", "time.end=zzz"], "must be a finite number"),
    Mistake("a sweep into a file", ["sweep", "dry.toml", "time.end=0.001", "--out", "dry.toml"], "dry.toml"),
    Mistake("a sweep over what is not its own", ["sweep", "dry.toml", "time.end=0.001", "--out", "s"], "holds something else", write("s/end_0.001/precious", "")),
    Mistake("a scene of a stage that is not there", ["run", "g.toml"], "gone.toml", write("g.toml", DRY + TABLE.replace("csv", "scene").format("gone.toml"))),
    Mistake("no scene", ["run"], "SCENE", status=2),
    Mistake("an option that is none", ["run", "dry.toml", "--fast"], "--fast", status=2),
    Mistake("no threads", ["run", "dry.toml", "--jobs", "0"], "at least 1", status=2),
    Mistake("a word that is none", ["fly"], "invalid choice: 'fly'", status=2),
    Mistake("a folder without programs", ["run", "dry.toml"], "FPI_BIN must name", environment={"FPI_BIN": "/var/empty"}),
    Mistake("programs of another kind", ["run", "dry.toml"], "Exec format error", all_of(write("bin/coupler", "\x7fELF junk"), lambda place: (place / "bin/coupler").chmod(0o755)), environment={"FPI_BIN": "bin"}),
    Mistake("programs that crash", ["run", "dry.toml"], "signal 11 (SIGSEGV)", all_of(write("bin/coupler", "#!/bin/sh\nkill -SEGV $$\n"), lambda place: (place / "bin/coupler").chmod(0o755)), environment={"FPI_BIN": "bin"}),
]

OTHERS = [  # of what has neither
    Mistake("checking a pipe", ["check", "p.toml"], "p.toml is a pipe", pipe("p.toml")),
    Mistake("checking a scene with a device as mesh", ["check", "m.toml"], "/dev/zero is a device", write("m.toml", MESH.format("/dev/zero"))),
    Mistake("drawing nothing", ["plot", "gone"], "there is no gone"),
    Mistake("drawing an empty folder", ["plot", "f"], "holds no results", folder("f")),
    Mistake("drawing a file", ["plot", "dry.toml"], "a run folder is required"),
    Mistake("drawing damaged results", ["plot", "done"], "bodies.h5 must hold", all_of(dry_run, write("done/bodies.h5", "junk"))),
    Mistake("drawing a pipe", ["plot", "done"], "bodies.h5 is a pipe", all_of(pipe("done/bodies.h5"))),
    Mistake("drawing an odd scene", ["plot", "done"], "scene.toml must hold", all_of(dry_run, write("done/scene.toml", "fluid = 3\n"))),
    Mistake("a file in place of the folder of pictures", ["plot", "done"], "plots cannot be used", all_of(dry_run, write("done/plots", ""))),
    Mistake("a movie of nothing", ["plot", "f", "--movie"], "a movie needs bodies", folder("f")),
    Mistake("no such geometry", ["mesh", "gone"], "there is no gone"),
    Mistake("a scene as geometry", ["mesh", "cavity.toml"], "a geometry file (.geo) is required"),
    Mistake("a pipe as mesh to be written", ["mesh", "cylinder", "--out", "p.msh"], "p.msh is a pipe", pipe("p.msh")),
    Mistake("a pipe as picture", ["plot", "done"], "speed.png is a pipe", pipe("done/plots/speed.png")),
    Mistake("keys in a folder that cannot be", ["keys", "dry.toml/k"], "Not a directory"),
    Mistake("keys twice", ["keys", "k"], "has coupler.secret already", write("k/coupler.secret", "x")),
    Mistake("a size that is none", ["mesh", "cylinder", "--size", "big"], "a factor from", status=2),
]


class Errors(FpiCase):
    def place(self, mistake: Mistake) -> Path:
        place = self.folder / mistake.name
        place.mkdir()
        (place / "dry.toml").write_text(DRY)
        mistake.prepare(place)
        return place

    def assert_told(self, mistake: Mistake, place: Path, mode: str) -> None:
        environment = {"XDG_CONFIG_HOME": str(place / "config"), **(mistake.environment or {})}
        words = [*mistake.words, *([mode] if mode else [])]
        with self.subTest(mistake=mistake.name, mode=mode):
            self.assert_failed(self.fpi(*words, cwd=place, environment=environment), mistake.cause, mode, mistake.status)

    def try_all(self, mistakes: list[Mistake], modes_of: Callable[[int], tuple[str, ...]]) -> None:
        def try_one(number):
            mistake = mistakes[number]
            place = self.place(mistake)
            for mode in modes_of(number):
                before = set(place.iterdir())
                self.assert_told(mistake, place, mode)
                for new in set(place.iterdir()) - before:
                    shutil.rmtree(new, ignore_errors=True)
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            list(pool.map(try_one, range(len(mistakes))))

    def test_every_mistake_in_a_run_is_told_once(self):
        self.try_all(RUNS, lambda number: (MODES[number % 3],))  # the slow test tries all

    def test_every_mistake_in_a_run_is_told_once_whatever_is_asked_for(self):
        self.try_all(RUNS, lambda number: MODES)

    def test_every_other_mistake_is_told_once(self):
        self.try_all(OTHERS, lambda number: ("",))

    def test_whatever_the_locale_a_scene_with_any_name_is_run(self):
        name = os.fsdecode(b"caf\xe9-\xce\xb1.toml")
        (self.folder / name).write_text(DRY.replace("a ball", "μ: a ball"))
        for locale in ("C", "POSIX", "de_DE.ISO-8859-1", "C.utf8"):
            ended = self.fpi("run", name, "--out", locale, environment={"LC_ALL": locale})
            self.assertEqual((ended.status, ended.err), (0, ""), ended.said)
        self.assertEqual(self.fpi("run", name, "--json", "--out", os.fsdecode(b"r\xe9")).status, 0)

    def test_a_folder_that_is_gone_is_told(self):
        gone = self.folder / "gone"
        gone.mkdir()
        words = ["sh", "-c", f"rmdir {gone}; exec {ROOT}/fpi run {self.folder}/dry.toml --quiet"]
        done = subprocess.run(words, cwd=gone, capture_output=True, text=True, check=False, timeout=60)
        self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
        self.assertIn("runs cannot be used: No such file", done.stderr)

    def test_a_file_without_permission_is_told(self):
        if os.geteuid() == 0 and not os.access(ROOT, os.R_OK):
            self.skipTest("nobody may read the project here")
        shut = self.folder / "shut.toml"
        shut.write_text(DRY)
        shut.chmod(0)
        self.folder.chmod(0o755)
        user = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        if user and subprocess.run(["test", "-x", str(ROOT / "fpi")], check=False, **user).returncode != 0:
            self.skipTest("the user nobody has no way to the project")
        for mode in ("", "--quiet", "--json"):
            self.assert_failed(self.fpi("run", "shut.toml", "--out", "/dev/shm/none", mode or "--trust", **user), "Permission denied", mode)
            self.assert_failed(self.fpi("run", "dry.toml", mode or "--trust", **user), "runs cannot be used: Permission denied", mode)

    @unittest.skipUnless(is_root_with_mounts(), "a small disk must be mounted, which root may")
    def test_a_full_disk_is_told(self):
        script = "mount -t tmpfs -o size=$2k none full; cd full; exec $1 run ../dry.toml --set time.end=2 --out r $3"
        (self.folder / "full").mkdir()
        for size in ("4", "60"):
            for mode in ("--quiet", "--json"):
                with self.subTest(size=size, mode=mode):
                    done = subprocess.run(["unshare", "-m", "sh", "-c", script, "sh", str(ROOT / "fpi"), size, mode or "--trust"],
                                          cwd=self.folder, capture_output=True, text=True, check=False, timeout=90)
                    self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                    self.assertNotIn("Traceback", done.stdout + done.stderr)
                    self.assertRegex(done.stdout + done.stderr, "space|permissions")
                    self.assertNotIn("killed", done.stdout + done.stderr)


class Output(FpiCase):
    def test_a_reader_that_leaves_ends_what_prints_without_a_word(self):
        reading, writing = os.pipe()
        os.close(reading)
        for words in (["list"], ["check", "dry.toml"], ["run", "dry.toml", "--json"]):
            ended = self.fpi(*words, stdout=writing)
            self.assertEqual((ended.status, ended.err), (141, ""), words)
        os.close(writing)

    def test_a_run_goes_on_without_its_reader(self):
        reading, writing = os.pipe()
        os.close(reading)
        self.fpi("run", "dry.toml", "--out", "r", stdout=writing)
        os.close(writing)
        self.assertIn('"status": "completed"', (self.folder / "r" / "summary.json").read_text())

    def test_an_output_that_cannot_be_written_is_told(self):
        with open("/dev/full", "w") as full:
            for words in (["list"], ["run", "dry.toml", "--json"], ["run", "dry.toml"]):
                self.assert_failed(self.fpi(*words, stdout=full), "the output cannot be used: No space left on device")

    def test_closed_streams_do_no_harm(self):
        script = f"exec {ROOT}/fpi run dry.toml --out $1 <&- >&- 2>&-"
        done = subprocess.run(["sh", "-c", script, "sh", "r"], cwd=self.folder, check=False, timeout=60)
        self.assertEqual(done.returncode, 0)
        self.assertIn('"status": "completed"', (self.folder / "r" / "summary.json").read_text())


if __name__ == "__main__":
    unittest.main()
