"""Runs `./fpi` with the real programs, for the tests beside this file, which are about how it ends."""

import json
import os
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PATIENCE = 90  # [s] until what does not end counts as hanging

DRY = """
title = "a ball falls"
gravity = [0, 0, -9.81]
time = {step = 1e-3, end = 5e-3}
[[bodies]]
name = "ball"
shape = "sphere"
radius = 0.01
density = 1000
position = [0, 0, 1]
"""

# A free disc in fluid: three programs, for as long as a test wants.
COUPLED = """
title = "a disc settles in a small box"
gravity = [0.0, -9.81]
[time]
step = 1e-5
end = 10
[output]
checkpoint_every = 5
[fluid]
density = 1000.0
kinematic_viscosity = 1e-5
mesh = {lower = [0.0, 0.0], upper = [0.01, 0.02], cells_x = 28, cells_y = 56}
boundaries = {left.type = "no_slip", right.type = "no_slip", bottom.type = "no_slip", top.type = "no_slip"}
[[bodies]]
name = "disc"
radius = 1.25e-3
density = 1250.0
position = [0.005, 0.015]
"""


class Ended:
    """Status as a shell has it, and what was printed."""

    def __init__(self, status: int, out: bytes, err: bytes):
        self.status = status if status >= 0 else 128 - status
        self.out, self.err = out.decode(errors="replace"), err.decode(errors="replace")

    @property
    def said(self) -> str:
        return self.out + self.err


class FpiCase(unittest.TestCase):
    """A test with a folder and a user's settings of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "dry.toml").write_text(DRY)
        (self.folder / "coupled.toml").write_text(COUPLED)

    def start(self, words, environment=None, cwd=None, **streams) -> subprocess.Popen:
        streams = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | streams
        process = subprocess.Popen([str(ROOT / "fpi"), *words], cwd=cwd or self.folder,
                                   env=os.environ | {"XDG_CONFIG_HOME": str(self.folder / "config")} | (environment or {}),
                                   **streams)
        self.addCleanup(self.end, process)
        return process

    def fpi(self, *words, **options) -> Ended:
        return self.ended(self.start(words, **options))

    def ended(self, process: subprocess.Popen) -> Ended:
        try:
            out, err = process.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            out, err = process.communicate()
            self.fail(f"no end of {process.args}; it printed {out} {err}")
        return Ended(process.returncode, out or b"", err or b"")

    def end(self, process: subprocess.Popen) -> None:
        if process.poll() is None:
            process.kill()
        process.communicate()

    def wait_for(self, condition):
        """What the condition returns, once it is true."""
        deadline = time.monotonic() + PATIENCE
        while not (found := condition()):
            self.assertLess(time.monotonic(), deadline, "what the test waits for never came")
            time.sleep(0.02)
        return found

    def assert_failed(self, ended: Ended, cause: str, mode: str = "", status: int = 1) -> None:
        """The cause is said once, in JSON mode within the one document of standard output; never a traceback."""
        self.assertEqual(ended.status, status, ended.said)
        self.assertNotIn("Traceback", ended.said)
        self.assertNotIn("fault, please report", ended.said)
        self.assertNotIn("\x1b", ended.said, "no commands for the terminal from outside")
        said = ended.said
        if mode == "--json":
            document = json.loads(ended.out)
            self.assertEqual(document["status"], "failed")
            self.assertNotIn(cause, ended.err)
            said = document["reason"]
        elif mode == "--quiet":
            self.assertEqual(ended.out, "")
        self.assertEqual(said.count(cause), 1, f"{cause!r} must be said once: {ended.said}")


def children(pid: int) -> dict[str, int]:
    """The programs that a process has started, by name."""
    found = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            name, _, rest = stat.read_text().partition(" (")[2].rpartition(") ")
        except OSError:
            continue
        if int(rest.split()[1]) == pid and rest.split()[0] not in "ZX":
            found[name] = int(stat.parent.name)
    return found


def is_root_with_mounts() -> bool:
    probe = ["unshare", "-m", "mount", "-t", "tmpfs", "-o", "size=64k", "none", "/mnt"]
    return os.geteuid() == 0 and subprocess.run(probe, capture_output=True, check=False).returncode == 0
