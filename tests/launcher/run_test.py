"""How a run is started, watched and ended."""

import json
import os
import shutil
import signal
import unittest
from unittest import mock

from fakes import COUPLER, FakeTest, runs


class Running(FakeTest):
    def test_a_completed_run_has_status_0_and_names_its_files(self):
        status, out, err = self.fpi("run", "drop.toml")
        self.assertEqual((status, err), (0, ""))
        self.assertIn("step 1 of 3", out)
        self.assertIn("completed", out)
        self.assertIn("summary.json", out)

    def test_participants_get_address_token_log_and_fingerprint(self):
        self.fpi("run", "drop.toml", "--out", "r")
        self.assertEqual((self.folder / "pid.words").read_text(),
                         "--connect tcp://127.0.0.1:5999 --scene 7 --token r/.token --log r/fluid_server.log")

    def test_the_coupler_gets_overrides_address_and_keys(self):
        _, out, _ = self.fpi("run", "drop.toml", "--out", "r", "--set", "a.b=1", "--set", "c=2", "--listen",
                             "tcp://0.0.0.0:5999", "--keys", "k")
        self.assertIn("--out r --watch-stdin --scene drop.toml --set a.b=1 --set c=2 --listen tcp://0.0.0.0:5999 "
                      "--keys k", out)

    def test_an_error_of_the_coupler_is_told_once_and_its_warnings_at_once(self):
        self.program("coupler", COUPLER.replace('note(1, "the run is', """
print("2026-01-01 00:00:00.000 coupler warning: mind", file=sys.stderr)
print("2026-01-01 00:00:00.000 coupler error: out of\\nluck", file=sys.stderr)
end(1, "out of\\nluck")
note(1, "the run is"""))
        self.assertEqual(self.fpi("run", "drop.toml", "--quiet"),
                         (1, "", "2026-01-01 00:00:00.000 coupler warning: mind\nfpi: out of\nluck\n"))
        status, out, err = self.fpi("run", "drop.toml", "--json")
        self.assertEqual((status, json.loads(out)["reason"], err.count("luck")), (1, "out of\nluck", 0))
        status, out, err = self.fpi("run", "drop.toml")
        self.assertEqual((status, (out + err).count("luck")), (1, 1))

    def test_a_refused_resume_is_told_without_the_figures_of_the_run_before(self):
        (self.folder / "old").mkdir()
        (self.folder / "old" / "scene.toml").write_text((self.folder / "drop.toml").read_text())
        self.assertEqual(self.fpi("resume", "old", "--quiet")[0], 0)
        refusal = "2026-01-01 00:00:00.000 coupler error: nothing to resume"
        self.program("coupler", COUPLER.replace('note(1, "the run is', f'sys.exit("{refusal}")\nnote(1, "the run is'))
        self.assertEqual(self.fpi("resume", "old"), (1, mock.ANY, "fpi: nothing to resume\n"))
        status, out, _ = self.fpi("resume", "old", "--json")
        self.assertEqual(json.loads(out), {"run": "old", "status": "failed", "reason": "nothing to resume"})

    def test_a_vanished_participant_is_told_to_the_coupler_with_its_signal(self):
        status, out, _ = self.fpi("run", "drop.toml", fluid="die")
        self.assertEqual(status, 1)
        self.assertIn("failed: exited fluid -9", out)

    def test_a_program_that_cannot_be_started_is_told_too(self):
        self.scene('[{"role": "fluid", "command": "no-such-program --fast", "external": false}]')
        status, out, err = self.fpi("run", "drop.toml", "--trust")
        self.assertEqual((status, err), (1, ""))
        self.assertIn("failed: exited fluid 127 (the fluid program could not be started: no-such-program", out)

    def test_another_program_takes_the_role_that_the_scene_gives_it(self):
        self.scene(f'[{{"role": "fluid", "command": "{self.bin}/fluid_server --fast", "external": false}}]')
        status, _, _ = self.fpi("run", "drop.toml", "--trust")
        self.assertEqual(status, 0)
        self.assertTrue((self.folder / "pid.words").read_text().startswith("--fast --connect"))

    def test_an_external_program_is_not_started_but_its_whole_command_is_shown(self):
        for command, words, expected in (
                ("", [], "fluid_server --connect tcp://127.0.0.1:5999 --scene 7 --token r/.token"),
                ("my_solver --fast", [], "my_solver --fast --connect tcp://127.0.0.1:5999 --scene 7 --token r/.token"),
                ("", ["--listen", "tcp://0.0.0.0:5555", "--keys", "k"],
                 "fluid_server --connect tcp://HOST:5555 --scene 7 --keys k"),
                ("", ["--listen", "tcp://*:5555"], "fluid_server --connect tcp://HOST:5555 --scene 7 --token r/.token")):
            self.scene(json.dumps([{"role": "fluid", "command": command, "external": True}]))
            shutil.rmtree(self.folder / "r", ignore_errors=True)
            process = self.start("run", "drop.toml", "--out", "r", *words)
            lines = [process.stdout.readline() for _ in range(3)]
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
            self.assertEqual(lines[2], f"Waiting for the fluid program; start it with: {expected}\n")
        self.assertFalse((self.folder / "pid").exists())

    def test_quiet_prints_nothing_and_json_the_summary_only(self):
        self.assertEqual(self.fpi("run", "drop.toml", "--quiet"), (0, "", ""))
        status, out, _ = self.fpi("run", "drop.toml", "--json", "--out", "r")
        self.assertEqual((status, json.loads(out)["status"], json.loads(out)["run"]), (0, "completed", "r"))

    def test_a_scene_that_is_refused_makes_no_folder(self):
        self.scene("broken")
        status, _, err = self.fpi("run", "drop.toml")
        self.assertEqual(status, 1)
        self.assertIn('the key "broken" is not known', err)
        self.assertFalse((self.folder / "runs").exists())

    def test_a_refused_scene_is_one_json_object_too(self):
        self.scene("broken")
        status, out, _ = self.fpi("run", "drop.toml", "--json")
        self.assertEqual(status, 1)
        self.assertEqual(json.loads(out), {"status": "failed", "reason": 'drop.toml:1: the key "broken" is not known'})


class Stages(FakeTest):
    def run_with(self, ready: bool, **options) -> tuple[int, str]:
        (self.folder / "packing.toml").write_text((self.folder / "drop.toml").read_text())
        stage = {"scene": "packing.toml", "folder": "runs/stages/packing", "ready": ready}
        with mock.patch.dict(os.environ, {"FAKE_STAGES": json.dumps([stage])}):
            status, out, _ = self.fpi("run", "drop.toml", "--json", "--out", "r", **options)
        return status, out

    def test_a_scene_that_is_needed_first_is_run_into_its_own_folder(self):
        status, out = self.run_with(ready=False)
        self.assertEqual((status, json.loads(out)["run"]), (0, "r"))
        self.assertTrue((self.folder / "runs/stages/packing/summary.json").exists())
        self.assertIn("--scene 8 ", (self.folder / "pid.words").read_text(), "planned anew with what the stage ended with")

    def test_a_stage_that_is_ready_is_not_run_again(self):
        self.assertEqual(self.run_with(ready=True)[0], 0)
        self.assertFalse((self.folder / "runs/stages").exists())

    def test_a_stage_that_fails_ends_it_all_with_its_reason(self):
        status, out = self.run_with(ready=False, fluid="die")
        self.assertEqual((status, json.loads(out)["run"]), (1, "runs/stages/packing"))
        self.assertIn("exited fluid -9", json.loads(out)["reason"])
        self.assertFalse((self.folder / "r").exists())


class Folders(FakeTest):
    def test_a_second_run_takes_the_next_number(self):
        for _ in range(3):
            self.fpi("run", "drop.toml", "--quiet")
        self.assertEqual(sorted(path.name for path in (self.folder / "runs").iterdir()), ["drop", "drop-2", "drop-3"])

    def test_results_are_never_overwritten(self):
        (self.folder / "old").mkdir()
        (self.folder / "old" / "summary.json").write_text("precious")
        status, _, err = self.fpi("run", "drop.toml", "--out", "old")
        self.assertEqual(status, 1)
        self.assertIn("--out must name a new or empty folder", err)
        self.assertEqual((self.folder / "old" / "summary.json").read_text(), "precious")

    def test_resume_continues_in_the_same_folder(self):
        (self.folder / "old").mkdir()
        (self.folder / "old" / "scene.toml").write_text((self.folder / "drop.toml").read_text())
        status, out, _ = self.fpi("resume", "old")
        self.assertEqual(status, 0)
        self.assertIn("--out old --watch-stdin --resume\n", out)
        _, out, _ = self.fpi("resume", "old", "--set", "time.end=2")
        self.assertIn("--out old --watch-stdin --resume --set time.end=2\n", out)

    def test_resume_needs_a_run_folder(self):
        status, _, err = self.fpi("resume", ".")
        self.assertEqual(status, 1)
        self.assertIn("scene.toml is required", err)


class Ending(FakeTest):
    def test_ctrl_c_ends_the_coupler_and_it_ends_the_others(self):
        process = self.start("run", "drop.toml", "--out", "r", fluid="hang")
        pid = self.fluid_pid()
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertEqual(json.loads((self.folder / "r" / "summary.json").read_text())["reason"], "interrupted")
        self.assertFalse(runs(pid))

    def test_a_second_ctrl_c_ends_everything_at_once_and_says_so(self):
        process = self.start("run", "drop.toml", fluid="hang", coupler="hang")
        pid = self.fluid_pid()
        process.send_signal(signal.SIGINT)
        while "Ctrl-C again" not in process.stdout.readline():
            pass
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=10)
        self.assertEqual(process.returncode, 130)
        self.assertIn("failed: stopped by the user at once\n", out)
        self.assertFalse(runs(pid))

    def test_a_killed_coupler_is_named_with_its_signal(self):
        status, out, _ = self.fpi("run", "drop.toml", coupler="die")
        self.assertEqual(status, 1)
        self.assertIn("failed: coupler was killed by signal 9 (SIGKILL)\n", out)

    def test_a_killed_coupler_is_named_in_quiet_and_in_json_once(self):
        reason = "coupler was killed by signal 9 (SIGKILL)"
        self.assertEqual(self.fpi("run", "drop.toml", "--quiet", coupler="die"), (1, "", f"fpi: {reason}\n"))
        status, out, err = self.fpi("run", "drop.toml", "--json", coupler="die")
        self.assertEqual((status, json.loads(out)["reason"], err), (1, reason, ""))

    def test_after_a_kill_the_word_that_continues_from_the_checkpoint_is_given(self):
        status, out, _ = self.fpi("run", "drop.toml", "--json", "--out", "r", coupler="die with checkpoint")
        self.assertEqual((status, json.loads(out)["reason"]),
                         (1, "coupler was killed by signal 9 (SIGKILL); `./fpi resume r` continues from the last "
                             "checkpoint"))

    def test_a_program_that_stands_still_is_named_and_so_is_that_it_goes_on(self):
        process = self.start("run", "drop.toml", "--quiet", fluid="hang")
        pid = self.fluid_pid()
        os.kill(pid, signal.SIGSTOP)
        self.assertEqual(process.stderr.readline(),
                         f"fluid is stopped (process {pid}); it goes on after: kill -CONT {pid}\n")
        os.kill(pid, signal.SIGCONT)
        self.assertEqual(process.stderr.readline(), "fluid goes on\n")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.communicate(timeout=60)[1], "fpi: interrupted\n")

    def test_nothing_outlives_a_killed_launcher(self):
        process = self.start("run", "drop.toml", fluid="hang")
        pid = self.fluid_pid()
        os.kill(process.pid, signal.SIGKILL)
        process.communicate(timeout=60)
        self.wait_for(lambda: not runs(pid))


if __name__ == "__main__":
    unittest.main()
