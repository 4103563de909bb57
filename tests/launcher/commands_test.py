"""The words of `./fpi`, set-up and build, without running a scene."""

import io
import json
import os
import re
import subprocess
import sys
import shutil
import tempfile
import time
import unittest
from contextlib import redirect_stdout
from pathlib import Path
from unittest import mock

from fakes import FakeTest

from launcher import cli, common, processes, scenes
from launcher.run import report, run
from launcher.setup import build, mesh, packages


class Words(FakeTest):
    def test_wrong_words_have_status_2_and_a_sentence(self):
        for words, what in ((["fly"], "invalid choice"), (["run"], "SCENE"), ([], "COMMAND"),
                            (["run", "drop.toml", "--jobs", "0"], "at least 1"),
                            (["build", "--preset", "fast"], "invalid choice")):
            status, _, err = self.fpi(*words)
            self.assertEqual(status, 2, words)
            self.assertIn(what, err)

    def test_an_unknown_scene_names_those_that_there_are(self):
        status, _, err = self.fpi("check", "no_such_scene")
        self.assertEqual(status, 1)
        self.assertIn("there is no no_such_scene", err)
        self.assertIn("settling_disc", err)

    def test_check_gives_the_word_of_the_coupler(self):
        self.assertEqual(self.fpi("check", "drop.toml"), (0, "drop.toml: ok\n", ""))

    def test_check_of_a_scene_that_would_be_refused_has_status_1_and_the_findings_on_standard_output(self):
        (self.folder / "broken.toml").write_text("broken")
        self.assertEqual(self.fpi("check", "broken.toml"), (1, "broken.toml: 1 errors\n", ""))
        status, out, err = self.fpi("check", "broken.toml", "--json")
        self.assertEqual((status, json.loads(out)["status"], err), (1, "refused", ""))

    def test_a_check_that_takes_long_says_so_unless_a_script_reads(self):
        for quiet, expected in ((False, "checking drop.toml: 20 s so far"), (True, None)):
            check = run.Check(Path("drop.toml"), self.folder, [], quiet)
            said = []
            check.display.warn = said.append
            check.begun, check.said = time.monotonic() - 20, time.monotonic() - 11
            check.tell_of_time()
            check.tell_of_time()
            self.assertEqual(said, [expected] if expected else [])

    def test_list_has_every_scene_with_its_title(self):
        status, out, _ = self.fpi("list")
        self.assertEqual(status, 0)
        listed = [line.split() for line in out.splitlines() if line.startswith("  ")]
        self.assertEqual(sorted(words[0] for words in listed), [path.stem for path in scenes.shipped(".toml")])
        for words in listed:
            self.assertGreater(len(words), 3, words)

    def test_a_shipped_scene_is_found_by_its_name_whatever_its_folder(self):
        for path in scenes.shipped(".toml"):
            self.assertEqual((scenes.find(path.stem), scenes.find(path.name)), (path, path))

    def test_the_readme_tells_of_every_scene(self):
        table = (common.ROOT / "README.md").read_text().split("\n## Scenes\n")[1].split("\n## ")[0]
        told = [name for row in re.findall(r"^\| (`.*?) \|", table, re.M) for name in re.findall(r"`(\w+)`", row)]
        self.assertEqual(sorted(told), [path.stem for path in scenes.shipped(".toml")])

    def test_mesh_without_gmsh_says_what_to_install(self):
        with mock.patch.object(mesh.shutil, "which", lambda name: None):
            with self.assertRaises(common.Refusal) as refused:
                mesh.make("cylinder")
        self.assertIn("apt-get install -y gmsh", str(refused.exception))

    def test_mesh_of_an_unknown_geometry_names_those_that_there_are(self):
        status, _, err = self.fpi("mesh", "no_such_geometry")
        self.assertEqual(status, 1)
        self.assertIn("there is no no_such_geometry", err)
        self.assertIn("cylinder, cylinder_shedding, step_channel", err)

    @unittest.skipUnless(shutil.which("gmsh"), "gmsh is not installed")
    def test_mesh_is_of_second_order_and_finer_for_a_smaller_size(self):
        with tempfile.TemporaryDirectory() as folder:
            sizes = []
            for size in ("4", "2"):
                file = Path(folder) / "ring.msh"
                status, out, err = self.fpi("mesh", "taylor_couette", "--size", size, "--out", str(file))
                self.assertEqual((status, out), (0, f"{file}\n"), err)
                sizes.append(len(file.read_text()))
                self.assertRegex(file.read_text(), r"\n2 \d+ 9 \d+\n")  # a block of six-node triangles
            self.assertGreater(sizes[1], 2 * sizes[0])


class Report(unittest.TestCase):
    SUMMARY = {"status": "completed", "reason": "", "steps": 7, "sub_iterations": {"mean": 1, "max": 1}, "bodies": [],
               "boundaries": [{"name": "wall", "force": [1.0, -2.5, 0], "torque": [0, 0, 0.5], "centre": [0, 0, 0]},
                              {"name": "lid", "force": [None, None, 0], "torque": [0, 0, None], "centre": [0, 0, 0]}],
               "coefficients": {"drag": 5.5}, "probes": {"front": None},
               "signals": {"lift": {"min": -1.0, "max": 1.0, "mean": 0.0, "frequency": 3.0, "periods": 4, "settled": False,
                                    "peak_spread": 0.1, "strouhal": 0.3}},
               "profiles": {"u": {"min": -0.25, "min_at": [0.5, 0.125], "max": 1, "max_at": [0.5, 1]}},
               "errors": {"velocity_l2": 1e-5}, "counts": {"fluid": {"new_count": 3.0}},
               "wall_seconds": {"total": 2.0, "factor": 1.5, "solve": None},
               "peak_memory_bytes": {"coupler": 2**21, "dem_server": 0}}

    def test_every_measurement_has_a_line(self):
        rows = dict(report.rows(self.SUMMARY))
        self.assertEqual(rows["wall"], "force (1, -2.5) N, torque 0.5 N m")
        self.assertNotIn("lid", rows)
        self.assertEqual(rows["lift(t)"], "-1 to 1, mean 0, 3 Hz over 4 periods (not settled), St 0.3")
        self.assertEqual(rows["u"], "-0.25 at (0.5, 0.125) m to 1 at (0.5, 1) m")
        self.assertEqual(rows["errors"], "velocity l2 1.000e-05")
        self.assertEqual(rows["fluid"], "3 new count")
        self.assertEqual(rows["wall time"], "2.0 s, 0.29 s a step (factor 1.5)")
        self.assertEqual(rows["peak memory"], "coupler 2 MB")

    def test_a_leak_of_outlines_is_told_with_what_helps_where_it_is_large(self):
        def words(leak: float) -> str:
            balance = {"boundary:left": 2.0, "boundary:right": -2.0 - leak, "bodies": 0.0, "leak": leak, "rest": 0.0}
            return dict(report.rows(self.SUMMARY | {"volume_balance": balance}))["fluid's volume"]

        self.assertEqual(words(-0.001), "outlines leak 0.05% of the flow through the sides")
        self.assertRegex(words(-0.5), r"leak 25.00% .*: smaller triangles .* fluid.embedding.arc_ratio")
        closed = {"boundary:wall": 0.0, "bodies": 1e-20, "leak": 1e-20, "rest": 0.0}
        for balance in ({}, closed, {"boundary:left": 1.0, "boundary:right": -1.0}):
            self.assertNotIn("fluid's volume", dict(report.rows(self.SUMMARY | {"volume_balance": balance})))


class SetUp(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.status = Path(folder.name) / "status"
        self.status.touch()
        self.enterContext(mock.patch.object(packages, "STATUS", self.status))
        self.enterContext(mock.patch.object(packages, "MEMORY", Path(folder.name) / "build" / "packages"))

    def test_dpkg_is_asked_once_and_knows_what_is_there(self):
        self.assertEqual(packages.installed(["dpkg", "no-such-package"]), {"dpkg"})

    def test_nothing_missing_says_nothing(self):
        with mock.patch.object(packages, "installed", lambda names: set(names)):
            packages.ensure(say=self.fail)

    def test_dpkg_is_asked_again_only_when_a_package_or_the_list_changes(self):
        asked = []

        def installed(names):
            asked.append(len(names))
            return set(names)

        with mock.patch.object(packages, "installed", installed):
            for _ in range(3):
                packages.ensure(say=self.fail)
            self.assertEqual(len(asked), 1)
            os.utime(self.status, (1, 1))
            packages.ensure(say=self.fail)
            self.assertEqual(len(asked), 2)
            with mock.patch.dict(packages.NEEDED, {"gmsh": "meshes"}):
                packages.ensure(say=self.fail)
            self.assertEqual(len(asked), 3)

    def test_without_root_the_exact_command_is_given(self):
        said = []
        with mock.patch.object(packages, "installed", lambda names: set(names) - {"cmake", "libhdf5-dev"}), \
             mock.patch.object(packages.os, "geteuid", lambda: 1000):
            with self.assertRaises(common.Refusal) as refused:
                packages.ensure(say=said.append)
        self.assertIn("sudo apt-get update && sudo apt-get install -y --no-install-recommends cmake libhdf5-dev",
                      str(refused.exception))
        self.assertIn("results on disk", "\n".join(said))

    def test_as_root_the_lists_are_updated_first(self):
        ran, there = [], set(packages.NEEDED) - {"cmake"}

        def apt(command):
            ran.append(command[1])
            there.add("cmake")

        with mock.patch.object(packages, "installed", lambda names: there), \
             mock.patch.object(packages.os, "geteuid", lambda: 0), mock.patch.object(packages, "run_apt", apt):
            packages.ensure(say=lambda text: None)
        self.assertEqual(ran, ["update", "install"])

    def test_apt_that_fails_is_quoted(self):
        with self.assertRaises(common.Refusal) as refused:
            packages.run_apt(["sh", "-c", "echo no network; exit 100"])
        self.assertIn("status 100", str(refused.exception))
        self.assertIn("no network", str(refused.exception))


class Start(unittest.TestCase):
    """What stands before every run."""

    def test_a_run_imports_nothing_that_it_does_not_need(self):
        heavy = {"rich", "h5py", "numpy", "matplotlib", "PIL", "tomllib", "dataclasses", "launcher.setup.packages"}
        script = ("import sys; sys.path.insert(0, sys.argv[1]); from launcher import cli; "
                  "cli.parser().parse_args(['run', 'cavity', '--json']); print(*sys.modules)")
        done = subprocess.run([sys.executable, "-I", "-c", script, str(common.ROOT)], capture_output=True, text=True,
                              check=True)
        self.assertEqual(heavy & set(done.stdout.split()), set())

    def test_a_bare_machine_without_root_is_told_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "id").write_text("#!/bin/sh\necho 1000\n")
            (Path(folder) / "id").chmod(0o755)
            for python in (f"{folder}/none", f"{folder}/id"):  # there is none, or one without a library
                starter = (common.ROOT / "fpi").read_text().replace("python=/usr/bin/python3\n", f"python={python}\n")
                (Path(folder) / "fpi").write_text(starter)
                done = subprocess.run(["sh", f"{folder}/fpi", "list"], capture_output=True, text=True, check=False,
                                      env=os.environ | {"PATH": f"{folder}:{os.environ['PATH']}"})
                self.assertEqual(done.returncode, 1)
                self.assertIn(f"fpi: {python} (3.11 or newer", done.stderr)
                self.assertIn("apt-get install -y --no-install-recommends python3", done.stderr)


class Build(unittest.TestCase):
    def test_a_failure_is_shown_from_its_first_line_and_kept_in_the_log(self):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder) / "build.log"
            log.touch()
            with self.assertRaises(common.Refusal) as refused:
                build.follow(["sh", "-c", "echo noise; echo 'FAILED: a.o'; echo a.cpp:1: error; exit 1"], log, "building",
                             quiet=True)
            self.assertTrue(str(refused.exception).startswith("FAILED: a.o\na.cpp:1: error"))
            self.assertIn("noise", log.read_text())

    def test_a_run_needs_the_programs_only_and_the_tests_need_all(self):
        for words, targets in ((["build"], build.PROGRAMS), (["build", "--all"], build.EVERYTHING), (["test"], build.EVERYTHING)):
            with mock.patch.object(build, "build") as built, mock.patch.object(build, "test", return_value=0), \
                 mock.patch.object(cli, "ensure_packages"):
                cli.carry_out(words)
            self.assertEqual(built.call_args.kwargs["targets"], targets)
        with mock.patch.object(build, "build") as built, mock.patch.object(cli, "ensure_packages"), \
             mock.patch.object(cli, "programs", return_value=Path("/nowhere")), mock.patch.dict(os.environ):
            os.environ.pop("FPI_BIN", None)
            cli.ensure_programs(True)
        self.assertEqual(built.call_args.kwargs["targets"], build.PROGRAMS)

    def test_a_build_is_configured_again_after_a_change_of_the_presets(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(build, "ROOT", Path(folder)):
            presets, stamp = Path(folder) / "CMakePresets.json", Path(folder) / build.CONFIGURED
            presets.touch()
            self.assertFalse(build.is_configured(Path(folder)))
            for path in (stamp, Path(folder) / "build.ninja"):
                path.touch()
            self.assertTrue(build.is_configured(Path(folder)))
            os.utime(stamp, (1, 1))
            self.assertFalse(build.is_configured(Path(folder)))

    def test_a_build_says_how_long_it_will_take_and_where_its_log_is(self):
        printed = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, redirect_stdout(printed):
            log = Path(folder) / "build.log"
            build.follow(["printf", "[1/1200] a\n"], log, "building", quiet=False, cores=2)
        minutes = build.SECONDS_A_STEP * 10
        self.assertIn(f"building: 1200 steps, about {minutes} min on 2 cores; log: {log}", printed.getvalue())

    def test_progress_is_a_line_a_quarter_where_there_is_no_terminal(self):
        printed = io.StringIO()
        with redirect_stdout(printed):
            counter = build.Counter("building", quiet=False)
            for i in range(1, 101):
                counter.see(f"[{i}/100] Building")
            counter.close()
        self.assertEqual(printed.getvalue().splitlines(), [f"building: {i} of 100" for i in (25, 50, 75, 100)])


class Version(FakeTest):
    def test_the_launcher_says_it(self):
        version = common.VERSION.read_text().strip()
        done = subprocess.run([common.ROOT / "fpi", "--version"], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, f"fpi {version}\n")

    def test_the_citation_has_it(self):
        self.assertIn(f"\nversion: {common.VERSION.read_text().strip()}\n", (common.ROOT / "CITATION.cff").read_text())


class Installed(unittest.TestCase):
    """An installation has no sources, and programs for two kinds of processors."""

    def test_it_takes_the_best_programs_that_the_processor_can_run(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(common, "ROOT", Path(folder)), \
             mock.patch.object(common, "IS_INSTALLED", True), mock.patch.dict(os.environ):
            os.environ.pop("FPI_BIN", None)
            self.assertEqual(common.programs(), Path(folder) / "bin")
            (Path(folder) / "bin-v3").mkdir()
            for flags, name in ((common.V3_FLAGS, "bin-v3"), (common.V3_FLAGS - {"fma"}, "bin")):
                text = "processor : 0\nflags : " + " ".join(flags) + "\n"
                with mock.patch("builtins.open", mock.mock_open(read_data=text)):
                    self.assertEqual(common.programs(), Path(folder) / name)

    def test_it_refuses_to_build_with_a_sentence(self):
        with mock.patch.object(build, "IS_INSTALLED", True), self.assertRaises(common.Refusal) as refused:
            build.build()
        self.assertIn("clone", str(refused.exception))


class Parts(unittest.TestCase):
    def test_lines_are_cut_whatever_the_chunks(self):
        heard = []
        lines = run.Lines(heard.append)
        for chunk in (b"add", b"ress x\npro", b"gress y\n", b"end", b""):
            lines.take(chunk)
        self.assertEqual(heard, ["address x", "progress y", "end"])

    def test_a_wildcard_address_is_reached_by_a_host(self):
        for everywhere in ("0.0.0.0", "[::]", "*"):
            self.assertEqual(run.reachable(f"tcp://{everywhere}:5555", "127.0.0.1"), "tcp://127.0.0.1:5555")
        self.assertEqual(run.reachable("tcp://10.0.0.5:5555", "127.0.0.1"), "tcp://10.0.0.5:5555")

    def test_dense_kernels_get_one_thread_and_assembly_all_cores_unless_the_user_says_otherwise(self):
        one = run.Run(run.Request(Path("a.toml"), Path("r")), {}, None)
        three = run.Run(run.Request(Path("a.toml"), Path("r"), threads=3), {}, None)
        with mock.patch.dict(run.os.environ, {}, clear=True):
            self.assertEqual(one.environment(), {"OPENBLAS_NUM_THREADS": "1"})
            self.assertEqual(three.environment(), {"OMP_NUM_THREADS": "3", "OPENBLAS_NUM_THREADS": "3"})

    def test_an_exit_is_described_by_status_or_signal(self):
        self.assertEqual(processes.describe(3), "status 3")
        self.assertEqual(processes.describe(-9), "signal 9 (SIGKILL)")


if __name__ == "__main__":
    unittest.main()
