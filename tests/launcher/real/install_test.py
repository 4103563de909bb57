"""An installation of the real programs, moved to another place after it was made."""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

BUILD = Path(os.environ["FPI_BIN"]).parent
ROOT = Path(__file__).resolve().parents[3]


class Installation(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        subprocess.run(["cmake", "--install", BUILD, "--prefix", self.folder / "made"], check=True, capture_output=True)
        (self.folder / "made").rename(self.folder / "moved")

    def fpi(self, *words) -> str:
        environment = {name: value for name, value in os.environ.items() if name != "FPI_BIN"}
        done = subprocess.run([self.folder / "moved" / "bin" / "fpi", *words], cwd=self.folder, env=environment, text=True,
                              capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_it_runs_a_scene_that_it_brought_along(self):
        self.assertEqual(json.loads(self.fpi("run", "cavity", "--json"))["status"], "completed")

    def test_every_program_says_one_version_and_commit(self):
        version = (ROOT / "VERSION").read_text().strip()
        self.assertEqual(self.fpi("--version"), f"fpi {version}\n")
        said = {}
        for program in ("coupler", "dem_server", "fluid_server"):
            path = self.folder / "moved" / "lib" / "fpi" / "bin" / program
            text = subprocess.run([path, "--version"], text=True, capture_output=True, check=True).stdout
            self.assertRegex(text, rf"^{program} {re.escape(version)}( \([0-9a-f]{{12}}\))?\n$")
            said[program] = text.removeprefix(program)
        self.assertEqual(len(set(said.values())), 1, said)


if __name__ == "__main__":
    unittest.main()
