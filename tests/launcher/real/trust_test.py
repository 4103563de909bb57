"""A scene starts programs of its own only where its user trusts it, which is remembered."""

import os
import pty
import stat
import time
import unittest

from fpi_case import COUPLED, FpiCase

BIN = os.environ.get("FPI_BIN", "")


class Trust(FpiCase):
    def setUp(self):
        super().setUp()
        self.solver = self.folder / "solver"
        self.solver.write_text(f'#!/bin/sh\ntouch {self.folder}/started\nexec {BIN}/fluid_server "$@"\n')
        self.solver.chmod(0o755)
        self.write_scene()

    def write_scene(self, command: str | None = None, end: str = "2e-5") -> None:
        scene = COUPLED.replace("end = 10", f"end = {end}").replace("checkpoint_every = 5", "checkpoint_every = 1")
        self.scene = self.folder / "scene.toml"
        self.scene.write_text(scene.replace("[fluid]", f'[fluid]\ncommand = "{command or self.solver}"'))

    def assert_asked(self, *words: str) -> None:
        (self.folder / "started").unlink(missing_ok=True)
        ended = self.fpi(*words, "--quiet")
        self.assertEqual((ended.status, ended.err.count("say --trust")), (1, 1), ended.said)
        self.assertFalse((self.folder / "started").exists())

    def assert_started(self, *words: str) -> None:
        (self.folder / "started").unlink(missing_ok=True)
        ended = self.fpi(*words, "--quiet")
        others = [line for line in ended.said.splitlines() if " coupler warning: " not in line]
        self.assertEqual((ended.status, others), (0, []))
        self.assertTrue((self.folder / "started").exists())

    def test_trust_is_needed_once_for_a_command_and_a_scene(self):
        self.assert_asked("run", "scene.toml")
        self.assertFalse((self.folder / "runs").exists())
        self.assert_started("run", "scene.toml", "--trust")
        self.assert_started("run", "scene.toml")
        self.assertEqual(stat.S_IMODE((self.folder / "config" / "fpi" / "trusted").stat().st_mode), 0o600)
        self.write_scene(end="3e-5")
        self.assert_asked("run", "scene.toml")
        self.write_scene(command=f"{self.solver} --fast")
        self.assert_asked("run", "scene.toml")

    def test_what_is_resumed_may_do_what_was_run(self):
        self.assert_started("run", "scene.toml", "--trust", "--out", "r")
        (self.folder / "r" / "summary.json").unlink()
        self.assert_started("resume", "r")
        (self.folder / "r" / "summary.json").unlink()
        (self.folder / "config" / "fpi" / "trusted").unlink()
        self.assert_asked("resume", "r")

    def test_a_sweep_is_trusted_as_a_whole(self):
        self.assert_asked("sweep", "scene.toml", "time.end=2e-5,3e-5", "--out", "s")
        self.assert_started("sweep", "scene.toml", "time.end=2e-5,3e-5", "--out", "s", "--trust")

    def test_a_command_of_the_command_line_is_the_users_own(self):
        (self.folder / "plain.toml").write_text(COUPLED.replace("end = 10", "end = 2e-5"))
        self.assert_started("run", "plain.toml", "--set", f"fluid.command={self.solver}")

    def test_where_nothing_can_be_remembered_each_run_needs_it(self):
        (self.folder / "config").write_text("")
        self.assert_started("run", "scene.toml", "--trust")
        self.assert_asked("run", "scene.toml")
        (self.folder / "config").unlink()
        (self.folder / "config" / "fpi").mkdir(parents=True)
        os.mkfifo(self.folder / "config" / "fpi" / "trusted")
        self.assert_started("run", "scene.toml", "--trust")

    def answered(self, answer: bytes) -> int:
        ours, theirs = pty.openpty()
        process = self.start(["run", "scene.toml", "--quiet"], stdin=theirs, stderr=theirs)
        os.close(theirs)
        shown = b""
        while b"[y/N]" not in shown:
            shown += os.read(ours, 4096)
        self.assertIn(b"starts programs", shown)
        os.write(ours, answer)
        deadline = time.monotonic() + 60
        while process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.02)
        os.close(ours)
        return process.returncode

    def test_on_a_terminal_the_user_is_asked(self):
        self.assertEqual(self.answered(b"n\n"), 1)
        self.assertFalse((self.folder / "started").exists())
        self.assertEqual(self.answered(b"y\n"), 0)
        self.assertTrue((self.folder / "started").exists())
        self.assert_started("run", "scene.toml")


if __name__ == "__main__":
    unittest.main()
