"""Tiny stand-ins for the coupler and the participants, to test how the launcher starts, watches and ends them."""

import os
import stat
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

COUPLER = '''#!/usr/bin/python3
import json, os, signal, sys
words = sys.argv[1:]
if "--plan" in words:
    scene = open(words[words.index("--plan") + 1]).read()
    if "broken" in scene:
        sys.exit("drop.toml:1: the key \\"broken\\" is not known")
    stages = json.loads(os.environ.get("FAKE_STAGES", "[]")) if "drop.toml" in words else []
    print(json.dumps({"title": "a fake", "scene_fingerprint": 7, "participants": json.loads(scene), "stages": stages}))
    sys.exit(0)
if "--check" in words:
    scene = words[words.index("--check") + 1]
    refused = "broken" in open(scene).read()
    print("report " + json.dumps({"status": "refused" if refused else "ok", "stages": [], "findings": [],
                                  "text": [scene + (": 1 errors" if refused else ": ok")]}))
    sys.exit(int(refused))
out = words[words.index("--out") + 1]
def note(status, reason):
    summary = {"status": "failed" if status else "completed", "reason": reason, "steps": 3, "unknowns": None,
               "sub_iterations": {"mean": 2.0, "max": 3}, "wall_seconds": {"total": 1.0, "factor": None},
               "bodies": [], "coefficients": {}, "probes": {}}
    with open(os.path.join(out, "summary.json"), "w") as file:
        json.dump(summary, file)
def end(status, reason):
    note(status, reason)
    sys.exit(status)
what = os.environ.get("FAKE_COUPLER", "")
note(1, "the run is under way, or it ended without a word")
if what.startswith("die"):
    if what == "die with checkpoint":
        open(os.path.join(out, "checkpoint.h5"), "w").close()
    os.kill(os.getpid(), signal.SIGKILL)
signal.signal(signal.SIGINT, signal.SIG_IGN if what == "hang" else lambda *_: end(1, "interrupted"))
print(" ".join(words))
address = words[words.index("--listen") + 1] if "--listen" in words else "tcp://127.0.0.1:5999"
print("address " + address, flush=True)
print('progress {"step": 1, "steps": 3, "time": 0.1, "end": 0.3, "sub_iterations": 2, "text": "step 1 of 3"}', flush=True)
for line in sys.stdin:
    if line.split()[2] != "0":
        end(1, line.strip())
    end(0, "")
'''

FLUID = '''#!/usr/bin/python3
import os, signal, sys, time
open(os.environ["FAKE_PID"], "w").write(str(os.getpid()))
open(os.environ["FAKE_PID"] + ".words", "w").write(" ".join(sys.argv[1:]))
what = os.environ.get("FAKE_FLUID", "end")
if what == "die":
    os.kill(os.getpid(), signal.SIGKILL)
if what == "hang":
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    time.sleep(600)
'''


class FakeTest(unittest.TestCase):
    """A test with a folder of its own, fake programs in it and a launcher that uses them."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.bin = self.folder / "bin"
        self.bin.mkdir()
        self.program("coupler", COUPLER)
        self.program("fluid_server", FLUID)
        self.scene('[{"role": "fluid", "command": "", "external": false}]')

    def program(self, name: str, text: str) -> None:
        path = self.bin / name
        path.write_text(text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)

    def scene(self, participants: str) -> None:
        (self.folder / "drop.toml").write_text(participants)

    def start(self, *words: str, fluid: str = "end", coupler: str = "") -> subprocess.Popen:
        environment = os.environ | {"FPI_BIN": str(self.bin), "FAKE_FLUID": fluid, "FAKE_COUPLER": coupler,
                                    "FAKE_PID": str(self.folder / "pid")}
        return subprocess.Popen([str(ROOT / "fpi"), *words], cwd=self.folder, env=environment,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def fpi(self, *words: str, fluid: str = "end", coupler: str = "") -> tuple[int, str, str]:
        """Status, output and errors of `./fpi WORDS`."""
        process = self.start(*words, fluid=fluid, coupler=coupler)
        out, err = process.communicate(timeout=60)
        return process.returncode, out, err

    def fluid_pid(self) -> int:
        """The process number of the fake fluid, once it runs."""
        path = self.folder / "pid"
        self.wait_for(lambda: path.exists() and path.read_text())
        return int(path.read_text())

    def wait_for(self, condition, seconds: float = 20.0) -> None:
        deadline = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), deadline, "nothing happened")
            time.sleep(0.02)


def runs(pid: int) -> bool:
    """True while process `pid` is there and not merely waiting to be reaped."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except FileNotFoundError:
        return False
    return state not in ("Z", "X")
