#!/usr/bin/python3
"""Three real processes: the coupler, a fluid and dem_server. `coupled_test.py NAME` runs one test, as CTest does."""

import contextlib
import math
import resource
import shutil
import signal
import socket
import stat
import tempfile
import time
import unittest
from pathlib import Path

from harness import BIN, DRUM_SCENE, EXIT_SCENE, SETTLING_SCENE, SOFT_SCENE, CoupledRun, arrays_of, channel_scene, interrupt, run_coupler, toy_scene

FILES = {"scene.toml", "history.csv", "bodies.h5", "interface.h5", "summary.json", "coupler.log"}
KEYS = {"status", "reason", "resolution", "warnings", "steps", "steps_before", "sub_iterations", "newton_iterations", "factorisations", "solves", "unknowns",
        "wall_seconds", "peak_memory_bytes", "bodies", "boundaries", "coefficients", "probes", "signals", "profiles",
        "errors", "counts", "grains", "coupling", "outlets", "onset", "version", "scene_fingerprint", "percolation",
        "force_balance", "volume_balance", "drives"}
SECONDS = {"total", "mesh", "assembly", "factor", "solve", "interface", "dem", "coupling", "output"}


def raise_own_limit(files):
    """Lets this process have so many files open."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, files), hard))


def pause(processes, seconds):
    for process in processes:
        process.send_signal(signal.SIGSTOP)
    time.sleep(seconds)
    for process in processes:
        process.send_signal(signal.SIGCONT)


class Coupled(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="fpi_coupled_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_toy(self, **scene):
        """A whole run of the toy fluid; returns it after its end."""
        with CoupledRun(self.folder, toy_scene(**scene)) as run:
            self.assertEqual(run.wait(), 0, run.log())
        return run

    def test_three_processes_run_to_the_end(self):
        run = self.run_toy()
        self.assertEqual({role: process.returncode for role, process in run.participants.items()},
                         {"fluid": 0, "dem": 0})
        self.assertLessEqual(FILES, {path.name for path in run.out.iterdir()})
        summary = run.summary
        self.assertEqual(set(summary), KEYS)
        self.assertEqual(set(summary["wall_seconds"]), SECONDS)
        self.assertEqual(summary["status"], "completed")
        self.assertEqual(summary["reason"], "")
        self.assertEqual(summary["steps"], 20)
        for program in ("coupler", "fluid_server", "dem_server"):
            self.assertGreater(summary["peak_memory_bytes"][program], 1e6)
        self.assertEqual(run.history[-1]["time"], 0.1)

    def test_a_disc_sinks_at_the_speed_where_drag_carries_its_weight(self):
        history = self.run_toy(end=0.2).history
        ratio = 5  # of the toy's cylinder to the disc
        drag = 4 * math.pi * 10 / (math.log(ratio) - (ratio**2 - 1) / (ratio**2 + 1))
        speed = 100 * math.pi * 0.01**2 * 9.81 / drag
        self.assertAlmostEqual(history[-1]["disc.vy"], -speed, delta=1e-5 * speed)
        self.assertAlmostEqual(history[-1]["disc.fy"], 1100 * math.pi * 0.01**2 * 9.81, delta=1e-3)
        self.assertLess(max(row["sub_iterations"] for row in history), 6)

    def test_a_killed_participant_ends_the_run_with_its_name(self):
        for told in (False, True):
            with self.subTest(told=told), CoupledRun(self.folder, toy_scene(step=1e-5, timeout=1)) as run:
                run.wait_for_step(20)
                run.participants["fluid"].kill()
                if told:
                    run.tell_exit("fluid")
                start = time.monotonic()
                self.assertEqual(run.wait(), 1)
                self.assertLess(time.monotonic() - start, 8)
                summary = run.summary
                self.assertEqual(summary["status"], "failed")
                self.assertIn("fluid", summary["reason"])
                if told:
                    self.assertRegex(summary["reason"], "-9|SIGKILL|signal 9")
                self.assertEqual(run.participants["dem"].returncode, 0)
                self.assertEqual(len(run.history), summary["steps"])
                self.assertIsNone(summary["peak_memory_bytes"]["fluid_server"])

    def test_a_stopped_run_says_where_it_stands_and_keeps_its_results(self):
        with CoupledRun(self.folder, toy_scene(step=1e-5)) as run:
            run.wait_for_step(20)
            interrupt(run.coupler)
            self.assertEqual(run.wait(), 1)
            summary = run.summary
        self.assertEqual(summary["status"], "failed")
        self.assertRegex(summary["reason"], r"stopped by the user.*step \d+.*t = ")
        self.assertEqual(len(run.history), summary["steps"])
        self.assertEqual({p.returncode for p in run.participants.values()}, {0})

    def test_three_folders_with_keys(self):
        keys = self.folder / "keys"
        self.assertEqual(run_coupler("--make-keys", keys).returncode, 0)
        folders = {}
        for role in ("fluid", "dem"):
            folders[role] = self.folder / role
            (folders[role] / "keys").mkdir(parents=True)
            for name in ("participant.secret", "participant.public", "coupler.public"):
                shutil.copy(keys / name, folders[role] / "keys" / name)
        with CoupledRun(self.folder, toy_scene(), extra=["--keys", keys], participant_options=["--keys", "keys"],
                        participant_folders=folders) as run:
            self.assertEqual(run.wait(), 0, run.log())
        self.assertEqual(run.summary["status"], "completed")
        for role, folder in folders.items():
            self.assertEqual({path.name for path in folder.iterdir()}, {"keys", f"{role}.log"})

    def test_the_token_of_a_run_is_private_secret_and_gone_with_it(self):
        with CoupledRun(self.folder, toy_scene()) as run:
            file = Path(run.token_file)
            token = file.read_text().strip()
            self.assertEqual((file, stat.S_IMODE(file.stat().st_mode)), (run.out / ".token", 0o600))
            for process in (run.coupler, *run.participants.values()):
                self.assertNotIn(token, Path(f"/proc/{process.pid}/cmdline").read_text())
            self.assertEqual(run.wait(), 0, run.log())
        self.assertFalse(file.exists())
        for log in (*self.folder.glob("*.log"), *run.out.glob("*.*")):
            self.assertNotIn(token.encode(), log.read_bytes(), log)

    def test_a_thousand_idle_connections_end_no_run(self):
        with contextlib.ExitStack() as strangers:
            raise_own_limit(1200)
            with CoupledRun(self.folder, toy_scene(step=1e-4, end=1, checkpoint_every=200), most_files=256) as run:
                where = ("127.0.0.1", int(run.address.rpartition(":")[2]))
                for _ in range(1000):
                    strangers.enter_context(socket.create_connection(where, timeout=10))
                self.assertEqual(run.wait(), 0, run.log())
        self.assertEqual(run.summary["status"], "completed")
        self.assertEqual(run.log().count(" warning"), 0)

    def test_a_coupler_that_was_stopped_goes_on(self):
        with CoupledRun(self.folder, toy_scene(step=1e-4, end=0.03, timeout=5)) as run:
            run.wait_for_step(20)
            pause([run.coupler], 3)
            self.assertEqual(run.wait(), 0, run.log())

    def test_a_run_that_stood_still_as_a_whole_goes_on(self):
        with CoupledRun(self.folder, toy_scene(step=1e-4, end=0.03, timeout=1)) as run:
            run.wait_for_step(20)
            pause([run.coupler, *run.participants.values()], 3)
            self.assertEqual(run.wait(), 0, run.log())

    def test_participants_wait_for_their_coupler_as_long_as_the_scene_says(self):
        with CoupledRun(self.folder, toy_scene(step=1e-5, timeout=1)) as run:
            run.wait_for_step(20)
            run.coupler.send_signal(signal.SIGSTOP)
            start = time.monotonic()
            self.assertEqual({process.wait(timeout=20) for process in run.participants.values()}, {3})
            self.assertLess(time.monotonic() - start, 6)
        for role in run.participants:
            self.assertIn("the coupler vanished: it gave no sign of life", (self.folder / f"{role}.log").read_text())

    def test_an_open_address_without_keys_is_refused(self):
        with CoupledRun(self.folder, toy_scene(), extra=["--listen", "tcp://0.0.0.0:*"]) as run:
            self.assertEqual(run.wait(), 1)
            self.assertIn("keys", run.summary["reason"])

    def test_a_run_resumed_at_its_checkpoint_has_the_same_history(self):
        run = self.run_toy(checkpoint_every=6)
        history = (run.out / "history.csv").read_bytes()
        run.forget_its_end()
        with CoupledRun(self.folder, None, resume=True) as resumed:
            self.assertEqual(resumed.wait(), 0, resumed.log())
        self.assertIn("resumed after step 18", resumed.log())
        self.assertEqual((run.out / "history.csv").read_bytes(), history)
        self.assertEqual((resumed.summary["steps"], resumed.summary["steps_before"]), (20, 18))

    def test_a_killed_coupler_can_be_resumed_to_the_same_history(self):
        scene = toy_scene(step=1e-4, checkpoint_every=50)
        with CoupledRun(self.folder / "whole", scene) as whole:
            self.assertEqual(whole.wait(), 0, whole.log())
        with CoupledRun(self.folder, scene) as run:
            run.wait_for(lambda: (run.out / "checkpoint.bin").exists())
            run.coupler.kill()
            run.wait()
            self.assertEqual(run.summary["status"], "failed")
        with CoupledRun(self.folder, None, resume=True) as resumed:
            self.assertEqual(resumed.wait(), 0, resumed.log())
        self.assertEqual((run.out / "history.csv").read_bytes(), (whole.out / "history.csv").read_bytes())

    def test_a_stopped_run_resumes_to_the_same_bits_whatever_its_scene_says_of_checkpoints(self):
        scene = toy_scene(step=1e-3)
        with CoupledRun(self.folder / "whole", scene) as whole:
            self.assertEqual(whole.wait(), 0, whole.log())
        with CoupledRun(self.folder, scene) as run:
            run.wait_for_step(60)
            interrupt(run.coupler)
            self.assertEqual(run.wait(), 1)
        self.assertRegex(run.summary["reason"], "stopped by the user .*`./fpi resume .*/run` continues")
        with CoupledRun(self.folder, None, resume=True) as resumed:
            self.assertEqual(resumed.wait(), 0, resumed.log())
        self.assertRegex(resumed.log(), "resumed after step (50|75)")
        self.assertEqual((run.out / "history.csv").read_bytes(), (whole.out / "history.csv").read_bytes())
        self.assertEqual(run.arrays, whole.arrays)

    def test_a_run_stopped_before_its_first_checkpoint_begins_anew(self):
        with CoupledRun(self.folder, toy_scene(step=1e-3)) as run:
            run.wait_for_step(3)
            run.coupler.kill()
            run.wait()
        with CoupledRun(self.folder, None, resume=True) as resumed:
            self.assertEqual(resumed.wait(), 0, resumed.log())
        self.assertIn("the run begins anew", resumed.log())
        self.assertEqual(resumed.summary["steps"], 100)

    def test_a_run_that_died_after_its_last_step_is_completed_with_all_its_figures(self):
        run = self.run_toy(checkpoint_every=6)
        figures = {key: run.summary[key] for key in ("steps", "bodies", "sub_iterations")}
        (run.out / "summary.json").unlink()
        with CoupledRun(self.folder, None, resume=True) as resumed:
            self.assertEqual(resumed.wait(), 0, resumed.log())
        self.assertEqual({key: resumed.summary[key] for key in figures}, figures)

    def test_a_finished_run_is_extended_to_the_bits_of_the_longer_run(self):
        with CoupledRun(self.folder / "whole", toy_scene(end=0.2, checkpoint_every=4)) as whole:
            self.assertEqual(whole.wait(), 0, whole.log())
        run = self.run_toy(end=0.1, checkpoint_every=4)
        with CoupledRun(self.folder, None, resume=True, extra=["--set=time.end=0.2"]) as longer:
            self.assertEqual(longer.wait(), 0, longer.log())
        self.assertEqual((run.out / "history.csv").read_bytes(), (whole.out / "history.csv").read_bytes())
        self.assertEqual(run.arrays, whole.arrays)
        self.assertEqual(run.summary["steps"], 40)
        self.assertEqual((run.out / "scene.toml").read_bytes(), (whole.out / "scene.toml").read_bytes())

    def test_a_damaged_checkpoint_is_replaced_by_the_one_before_with_a_word(self):
        run = self.run_toy(checkpoint_every=6)
        history = (run.out / "history.csv").read_bytes()
        run.forget_its_end()
        shutil.copy(run.out / "checkpoint.bin", run.out / "checkpoint.previous.bin")
        damaged = bytearray((run.out / "checkpoint.bin").read_bytes())
        damaged[len(damaged) // 2] ^= 16
        (run.out / "checkpoint.bin").write_bytes(damaged)
        with CoupledRun(self.folder, None, resume=True) as resumed:
            self.assertEqual(resumed.wait(), 0, resumed.log())
        self.assertRegex(resumed.log(), "checkpoint.bin cannot be used, the checkpoint before it is: .*damaged")
        self.assertEqual((run.out / "history.csv").read_bytes(), history)

    def test_a_table_that_was_edited_before_a_resume_is_refused_by_name(self):
        (self.folder / "places.csv").write_text("x,y,radius\n0.1,0.5,0.02\n0.2,0.8,0.02\n")
        scene = DRUM_SCENE.split("[[grains]]")[0] + """
            [[grains]]
            name = "g"
            generator = "csv"
            file = "places.csv"
            density = 2000
            [[materials]]
            name = "m"
            youngs_modulus = 1e6
            [[walls]]
            name = "floor"
            point = [0, 0]
            normal = [0, 1]
            """
        with CoupledRun(self.folder, scene) as run:
            self.assertEqual(run.wait(), 0, run.log())
        run.forget_its_end()
        table = run.out / "inputs/places.csv"
        as_run = table.read_text()
        table.write_text(as_run.replace("0.02", "0.03"))
        refused = run_coupler("--out", run.out, "--resume")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("places.csv was changed since", refused.stderr)
        table.write_text(as_run)
        with CoupledRun(self.folder, None, resume=True) as resumed:
            self.assertEqual(resumed.wait(), 0, resumed.log())

    def test_a_run_does_not_write_where_it_reads(self):
        (self.folder / "scene.toml").write_text(toy_scene())
        before = (self.folder / "scene.toml").read_bytes()
        refused = run_coupler("--scene", self.folder / "scene.toml", "--out", self.folder)
        self.assertEqual(refused.returncode, 1)
        self.assertRegex(refused.stderr, "scene.toml is in .*: take another folder")
        self.assertEqual((self.folder / "scene.toml").read_bytes(), before)

    def test_every_file_of_a_run_under_way_can_be_read_without_a_lock(self):
        readings = 0
        with CoupledRun(self.folder, SETTLING_SCENE.replace("interval = 0.01", "interval = 0.002")) as run:
            while run.coupler.poll() is None:
                for path in list(run.out.rglob("*.h5")):
                    arrays = arrays_of(path)
                    if path.name == "bodies.h5" and "/time" in arrays:
                        self.assertEqual(len(arrays["/position"]), 3 * len(arrays["/time"]))
                    readings += 1
            self.assertEqual(run.wait(), 0, run.log())
        self.assertGreater(readings, 20)

    def kill_at_writes(self, scene, numbers):
        """A run is killed at each of these writes of its coupler: what it leaves can be read and resumes to the same bits."""
        preloaded = {"LD_PRELOAD": str(BIN / "libkill_at_write.so")}
        with CoupledRun(self.folder / "whole", scene) as whole:
            self.assertEqual(whole.wait(), 0, whole.log())
        for number in numbers:
            with self.subTest(write=number):
                folder = self.folder / str(number)
                with CoupledRun(folder, scene, coupler_environment=preloaded | {"KILL_AT_WRITE": str(number)}) as run:
                    run.coupler.stdout.read()
                    run.coupler.wait()
                    self.assertEqual(run.coupler.returncode, -9, f"it has fewer than {number} writes")
                for path in run.out.rglob("*.h5"):
                    arrays_of(path)
                if not (run.out / "scene.toml").exists():
                    continue  # it had not begun
                with CoupledRun(folder, None, resume=True) as resumed:
                    self.assertEqual(resumed.wait(), 0, resumed.log())
                self.assertEqual((run.out / "history.csv").read_bytes(), (whole.out / "history.csv").read_bytes())
                self.assertEqual(run.arrays, whole.arrays)
                shutil.rmtree(folder)

    def test_kills_at_a_write_leave_files_that_can_be_read_and_go_on_to_the_same_bits(self):
        self.kill_at_writes(SETTLING_SCENE, (50, 200, 350))

    def test_a_hundred_kills_at_a_write_leave_files_that_can_be_read_and_go_on_to_the_same_bits(self):
        self.kill_at_writes(SETTLING_SCENE, range(10, 410, 4))

    def test_a_run_whose_disk_fills_up_is_not_completed(self):
        for number in (60, 150, 250, 330, 390):
            environment = {"LD_PRELOAD": str(BIN / "libkill_at_write.so"), "FAIL_FROM_WRITE": str(number)}
            with self.subTest(write=number), CoupledRun(self.folder / str(number), SETTLING_SCENE,
                                                        coupler_environment=environment) as run:
                self.assertEqual(run.wait(), 1)
                self.assertEqual(run.summary["status"], "failed")

    def test_a_run_under_way_is_left_alone_by_a_second_one(self):
        with CoupledRun(self.folder, toy_scene(step=1e-4, checkpoint_every=50)) as run:
            run.wait_for(lambda: (run.out / "checkpoint.bin").exists())
            for options in (["--resume"], ["--scene", run.out / "scene.toml"]):
                second = run_coupler("--out", run.out, *options)
                self.assertEqual(second.returncode, 1)
                self.assertIn("no run is under way is required", second.stderr)
            self.assertEqual(run.wait(), 0, run.log())
        self.assertEqual(run.summary["status"], "completed")
        self.assertEqual(len(run.history), run.summary["steps"])

    def test_a_refused_resume_leaves_the_summary_as_it_was(self):
        run = self.run_toy(checkpoint_every=6)
        checkpoint, previous = run.out / "checkpoint.bin", run.out / "checkpoint.previous.bin"
        summary = run.out / "summary.json"

        def refuse(sentence, *options):
            before = summary.read_bytes()
            refused = run_coupler("--out", run.out, "--resume", *options)
            self.assertEqual(refused.returncode, 1)
            self.assertIn(sentence, refused.stderr)
            self.assertNotIn("address", refused.stdout)
            self.assertEqual(summary.read_bytes(), before)

        refuse("nothing to resume: the run reached its end")
        refuse("time.end must be later than t = 0.1 s", "--set", "time.end=0.08")
        refuse("got fluid.density: start a new run", "--set", "fluid.density=1001")
        summary.write_text(summary.read_text().replace("completed", "failed"))
        refuse("keys", "--listen", "tcp://0.0.0.0:*")
        scene = run.out / "scene.toml"
        scene.write_text(scene.read_text().replace("1100", "1200"))
        refuse("a checkpoint of this very scene")
        for damaged in (checkpoint, previous):
            damaged.write_bytes(damaged.read_bytes()[:1000])
        refuse("checkpoint.previous.bin")

    def test_a_disc_settles_through_fluid_server_and_resumes_to_the_same_bits(self):
        with CoupledRun(self.folder, SETTLING_SCENE) as run:
            self.assertEqual(run.wait(), 0, run.log())
        summary = run.summary
        self.assertEqual(summary["steps"], 12)
        self.assertLessEqual(summary["sub_iterations"]["mean"], 4.5)  # the plain iteration diverges here
        for count in ("newton_iterations", "factorisations", "solves", "unknowns"):
            self.assertGreater(summary[count], 0, count)
        speeds = [-row["disc.vy"] for row in run.history]
        self.assertEqual(speeds, sorted(speeds))
        self.assertTrue({"fields.h5", "fields.xdmf"} <= {path.name for path in run.out.iterdir()})
        whole = (run.out / "history.csv").read_bytes()
        run.forget_its_end()
        with CoupledRun(self.folder, None, resume=True) as resumed:
            self.assertEqual(resumed.wait(), 0, resumed.log())
        self.assertIn("resumed after step 10", resumed.log())
        self.assertEqual((run.out / "history.csv").read_bytes(), whole)

    def test_discs_that_leave_are_counted_and_the_run_resumes_to_the_same_bits(self):
        with CoupledRun(self.folder, EXIT_SCENE) as run:
            self.assertEqual(run.wait(), 0, run.log())
        left = (run.out / "left_bodies.csv").read_text().splitlines()
        self.assertEqual([line.split(",")[1] for line in left], ["body", "1", "0"])  # the one in front first
        (outlet,) = run.summary["outlets"]
        mass = 1000 * math.pi * 4e-3 ** 2
        self.assertEqual(outlet["count"], 2)
        self.assertAlmostEqual(outlet["mass"] / mass, 2, 12)
        self.assertAlmostEqual(outlet["momentum"][0] / (2 * mass), 0.1, 1)
        self.assertEqual(run.summary["grains"][0]["count"], 0)
        self.assertIsNone(run.summary["grains"][0]["position"][0])
        whole, arrays = {name: (run.out / name).read_bytes() for name in ("history.csv", "left_bodies.csv")}, run.arrays
        run.forget_its_end()
        with CoupledRun(self.folder, None, resume=True) as resumed:
            self.assertEqual(resumed.wait(), 0, resumed.log())
        self.assertIn("resumed after step 16", resumed.log())
        for name, content in whole.items():
            self.assertEqual((run.out / name).read_bytes(), content, name)
        self.assertEqual(run.arrays, arrays)

    def test_a_disc_that_leaves_the_mesh_through_no_outlet_ends_the_run_with_its_name(self):
        with CoupledRun(self.folder, EXIT_SCENE.split("[[outlets]]")[0]) as run:
            self.assertEqual(run.wait(), 1)
        self.assertRegex(run.summary["reason"], r'body "disc.1" must stay in the mesh, or leave through one of \[\[outlets')

    def test_a_disc_that_sinks_through_a_closed_side_of_the_fluid_is_named_with_the_walls_to_add(self):
        scene = SETTLING_SCENE.replace("1250.0", "8000.0").replace("0.015]", "0.002]").replace("0.024", "1.0")
        with CoupledRun(self.folder, scene) as run:
            self.assertEqual(run.wait(), 1)
        self.assertRegex(run.summary["reason"], r'body "disc" reaches out of the mesh at \(0.00\d+, -\S+\) m: stop it with '
                                                r'one of \[\[walls')

    def test_a_soft_floor_is_told_before_the_run_and_ends_it_by_name_when_a_disc_comes_through(self):
        with CoupledRun(self.folder, SOFT_SCENE) as run:
            self.assertEqual(run.wait(), 1)
        self.assertIn("disc sinks by 0.23 of its radius into wall floor under its own weight", run.log())
        self.assertRegex(run.summary["reason"], r"disc and floor overlap by more than a radius: disc would pass through at "
                                                r"\(0, -?\S+, 0\) m, with \S+ m/s. Take a larger youngs_modulus")

    def test_grains_in_a_drum_that_turns_resume_to_the_same_bits(self):
        with CoupledRun(self.folder, DRUM_SCENE) as run:
            self.assertEqual(run.wait(), 0, run.log())
        self.assertGreater(run.history[-1]["disc.y"], -0.06)  # the drum, which rose by 0.04 m, has held and turned them
        self.assertGreater(abs(run.history[-1]["disc.vx"]), 1e-3)
        energy = {name.split(".")[1]: value for name, value in run.history[-1].items() if name.startswith("energy.")}
        supplied = energy["walls"] + energy["loads"] + energy["numerical"]
        self.assertGreater(energy["friction"] + energy["damping"], 0)
        first = {name.split(".")[1]: value for name, value in run.history[0].items() if name.startswith("energy.")}
        self.assertAlmostEqual(sum(energy.values()) - 2 * supplied,
                               sum(first.values()) - 2 * (first["walls"] + first["loads"] + first["numerical"]), 12)
        self.assertEqual(run.summary["counts"]["dem"]["energy.kinetic"], energy["kinetic"])
        whole, arrays = {"history.csv": (run.out / "history.csv").read_bytes()}, run.arrays
        run.forget_its_end()
        with CoupledRun(self.folder, None, resume=True) as resumed:
            self.assertEqual(resumed.wait(), 0, resumed.log())
        self.assertIn("resumed after step 60", resumed.log())
        for name, content in whole.items():
            self.assertEqual((run.out / name).read_bytes(), content, name)
        self.assertEqual(run.arrays, arrays)

    def test_a_run_with_adaptive_steps_resumes_to_the_same_bits(self):
        scene = channel_scene("step = 0.05\nend = 1.26\nrelative_tolerance = 5e-3", length=3, cells_x=18, cells_y=6)
        with CoupledRun(self.folder, scene) as run:
            self.assertEqual(run.wait(), 0, run.log())
        self.assertRegex(run.log(), r"(?s) repeated: with .* checkpoint after")
        whole = (run.out / "history.csv").read_bytes()
        run.forget_its_end()
        with CoupledRun(self.folder, None, resume=True) as resumed:
            self.assertEqual(resumed.wait(), 0, resumed.log())
        self.assertRegex(resumed.log(), r"(?s)resumed after step 22.* repeated: with")
        self.assertEqual((run.out / "history.csv").read_bytes(), whole)

    def test_the_number_of_threads_changes_no_bit(self):
        scene = channel_scene("step = 0.01\nend = 0.03", length=150, cells_x=1001, cells_y=6)  # twelve stripes
        histories = []
        for threads in ("1", "4"):
            with CoupledRun(self.folder / threads, scene, environment={"OMP_NUM_THREADS": threads}) as run:
                self.assertEqual(run.wait(), 0, run.log())
            histories.append((run.out / "history.csv").read_bytes())
        self.assertEqual(len(run.history), 3)
        self.assertEqual(histories[0], histories[1])

    def test_a_scene_that_cannot_be_read_still_has_a_summary(self):
        scene = toy_scene().replace("viscosity", "viskosity")
        (self.folder / "scene.toml").write_text(scene)
        done = run_coupler("--scene", self.folder / "scene.toml", "--out", self.folder / "run")
        self.assertEqual(done.returncode, 1)
        self.assertIn("dynamic_viscosity", (self.folder / "run/summary.json").read_text())
        self.assertNotEqual(run_coupler("--check", self.folder / "scene.toml").returncode, 0)

    def test_wrong_options_are_refused_with_status_two(self):
        for options in ([], ["--scene", "x"], ["--resume"], ["--nonsense"]):
            self.assertEqual(run_coupler(*options).returncode, 2, options)
        self.assertEqual(run_coupler("--version").returncode, 0)


if __name__ == "__main__":
    unittest.main()
