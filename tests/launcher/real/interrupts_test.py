"""Ctrl-C and kills: whenever they come, the launcher ends with the status that a shell expects and says why, and nothing
that it started goes on."""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
import unittest

from fpi_case import ROOT, Ended, FpiCase, children

STOPPED = 128 + signal.SIGINT


class Kills(FpiCase):
    def kill(self, name: str, *words: str) -> Ended:
        """A run of three programs of which one is killed."""
        process = self.start(["run", "coupled.toml", "--out", "r", *words])
        pids = self.wait_for(lambda: (found := children(process.pid)).keys() >= {"coupler", "fluid_server", "dem_server"} and found)
        self.wait_for((self.folder / "r" / "history.csv").exists)
        os.kill(pids[name], signal.SIGKILL)
        ended = self.ended(process)
        for pid in pids.values():
            self.assertFalse(os.path.exists(f"/proc/{pid}/exe"), f"{pids} must have ended")
        return ended

    def test_whichever_program_is_killed_is_named_once(self):
        for name, cause in (("coupler", "coupler was killed by signal 9"), ("fluid_server", "fluid"), ("dem_server", "dem")):
            with self.subTest(name=name):
                self.assert_killed(self.kill(name, "--quiet"), cause, "--quiet", name)
                self.assert_killed(self.kill(name, "--json"), cause, "--json", name)

    def assert_killed(self, ended: Ended, cause: str, mode: str, name: str) -> None:
        self.assertEqual(ended.status, 1)
        said = json.loads(ended.out)["reason"] if mode == "--json" else ended.err
        self.assertRegex(said, r"signal 9|SIGKILL|status -9", said)
        self.assertIn(cause, said)
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertEqual(ended.err if mode == "--json" else ended.out, "")
        shutil.rmtree(self.folder / "r")


class CtrlC(FpiCase):
    def interrupted(self, words: list[str], delay: float, number=signal.SIGINT) -> Ended:
        process = self.start(words)
        time.sleep(delay)
        process.send_signal(number)
        return self.ended(process)

    def assert_stopped(self, ended: Ended, status: int = STOPPED) -> None:
        self.assertEqual(ended.status, status, ended.said)
        for word in ("Traceback", "Error", "Exception"):
            self.assertNotIn(word, ended.said)

    def test_a_run_is_stopped_at_any_moment(self):
        moments = random.Random(1)
        for delay in sorted(moments.uniform(0, 1.5) for _ in range(10)):
            for mode in ("--quiet", "--json"):
                with self.subTest(delay=delay, mode=mode):
                    ended = self.interrupted(["run", "coupled.toml", mode, "--out", f"{delay}{mode}"], delay)
                    self.assert_stopped(ended)
                    if ended.said or delay > 0.2:  # before, the shell that starts Python may be what ends
                        said = json.loads(ended.out)["reason"] if mode == "--json" else ended.err
                        self.assertEqual(said.count("stopped by the user"), 1, said)

    def test_what_only_prints_or_draws_is_stopped_at_any_moment(self):
        done = self.fpi("run", "dry.toml", "--quiet", "--out", "done")
        self.assertEqual(done.status, 0, done.said)
        for words in (["list"], ["check", "dry.toml"], ["plot", "done"]):
            for delay in (0.0, 0.01, 0.02, 0.03, 0.05, 0.08, 0.12, 0.2, 0.4, 0.8):
                with self.subTest(words=words, delay=delay):
                    ended = self.interrupted(words, delay)
                    if ended.status != 0:  # it came too late
                        self.assert_stopped(ended)

    def test_the_end_by_another_program_is_told_alike(self):
        self.assert_stopped(self.interrupted(["run", "coupled.toml", "--quiet"], 1.0, signal.SIGTERM), 128 + signal.SIGTERM)

    def test_a_sweep_ends_with_its_run(self):
        process = self.start(["sweep", "coupled.toml", "time.end=1,2,3", "--quiet", "--out", "s"])
        self.wait_for((self.folder / "s" / "end_1" / "history.csv").exists)
        process.send_signal(signal.SIGINT)
        ended = self.ended(process)
        self.assert_stopped(ended)
        self.assertIn("stopped by the user", ended.err)
        self.assertFalse((self.folder / "s" / "end_2").exists())

    def test_a_program_of_the_build_ends_with_the_launcher(self):
        script = ("import sys; from pathlib import Path; sys.path.insert(0, sys.argv[1]); from launcher import ending; from launcher.setup import build; "
                  "ending.end([], lambda words: build.follow(['sleep', '600'], Path('log'), 'building', True))")
        process = subprocess.Popen([sys.executable, "-I", "-c", script, str(ROOT)], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        self.addCleanup(self.end, process)
        sleeper = self.wait_for(lambda: children(process.pid).get("sleep"))
        process.send_signal(signal.SIGINT)
        ended = self.ended(process)
        self.assert_stopped(ended)
        self.assertEqual(ended.said, "fpi: stopped by the user\n")
        self.wait_for(lambda: not os.path.exists(f"/proc/{sleeper}/exe"))


if __name__ == "__main__":
    unittest.main()
