"""Runs the coupler and its participants as separate processes, for the tests beside this file."""

import csv
import json
import os
import signal
import subprocess
import time
from pathlib import Path

import h5py

BIN = Path(os.environ["FPI_BIN"])
PATIENCE = 60  # s until a run that does not end counts as hanging

TOY_SCENE = """
title = "a disc sinks in a very viscous fluid"
gravity = [0.0, -9.81]
[time]
step = {step}
end = {end}
[coupling]
participant_timeout = {timeout}
[output]
interval = {interval}
checkpoint_every = {checkpoint_every}
[fluid]
density = 1000.0
dynamic_viscosity = 10.0
command = "{command}"
mesh = {{lower = [0.0, 0.0], upper = [0.1, 0.4], cells_x = 10, cells_y = 40}}
boundaries = {{left.type = "slip", right.type = "slip", bottom.type = "slip", top.type = "slip"}}
[[bodies]]
name = "disc"
radius = 0.01
density = 1100.0
position = [0.05, 0.3]
"""


def toy_scene(step=0.005, end=0.1, timeout=5, interval=0.05, checkpoint_every=0):
    return TOY_SCENE.format(step=step, end=end, timeout=timeout, interval=interval, checkpoint_every=checkpoint_every,
                            command=BIN / "toy_stokes_fluid")


SETTLING_SCENE = """
title = "a disc settles in a small box, on a coarse mesh"
gravity = [0.0, -9.81]
[time]
step = 2e-3
end = 0.024
[output]
interval = 0.01
checkpoint_every = 5
[fluid]
density = 1000.0
kinematic_viscosity = 1e-5
mesh = {lower = [0.0, 0.0], upper = [0.01, 0.02], cells_x = 16, cells_y = 32}
boundaries = {left.type = "no_slip", right.type = "no_slip", bottom.type = "no_slip", top.type = "no_slip"}
[[bodies]]
name = "disc"
radius = 1.25e-3
density = 1250.0
position = [0.005, 0.015]
"""


DRUM_SCENE = """
title = "discs in a drum that turns and rises, on a shaker"
gravity = [0, -9.81]
thickness = 0.01
[time]
step = 5e-3
end = 0.4
[output]
interval = 0.1
checkpoint_every = 30
[dem]
energy = true
[[grains]]
name = "disc"
generator = "random"
lower = [-0.03, -0.04]
upper = [0.03, 0.02]
solid_fraction = 0.5
radius_range = [0.004, 0.006]
density = 2500
[[materials]]
name = "glass"
youngs_modulus = 1e6
friction = 0.5
rolling_friction = 0.1
[[walls]]
name = "drum"
shape = "arc"
centre = [0, 0]
radius = 0.06
spin = [-6]
velocity = ["0.2*cos(20*t)", 0.1]
[[walls]]
name = "paddle"
shape = "polyline"
centre = [0, 0]
vertices = [-0.06, 0, -0.05, 0]
spin = ["-6"]
velocity = ["0.2*cos(20*t)", 0.1]
"""


SOFT_SCENE = """
title = "a disc falls on a floor that is too soft for it"
gravity = [0, -9.81]
[time]
step = 1e-3
end = 0.8
[[bodies]]
name = "disc"
radius = 0.01
density = 2500
position = [0, 1.01]
[[materials]]
name = "jelly"
youngs_modulus = 1e6
[[walls]]
name = "floor"
shape = "polyline"
vertices = [-1, 0, 1, 0]
"""


EXIT_SCENE = """
title = "two discs, one behind the other, are carried out of a channel"
[time]
step = 0.02
end = 0.6
[output]
interval = 0.1
checkpoint_every = 16
[fluid]
density = 1000.0
kinematic_viscosity = 1e-4
mesh = {lower = [0.0, 0.0], upper = [0.03, 0.02], cells_x = 24, cells_y = 16}
[fluid.boundaries]
left = {type = "velocity", velocity = ["1000*y*(0.02-y)", 0]}
right.type = "traction"
bottom.type = "no_slip"
top.type = "no_slip"
[[grains]]
name = "disc"
generator = "square"
lower = [0.005, 0.005]
upper = [0.025, 0.015]
radius = 4e-3
gap = 1e-3
density = 1000.0
[[materials]]
name = "plastic"
youngs_modulus = 1e6
[[outlets]]
name = "right"
lower = [0.03, -1.0]
upper = [1.0, 1.0]
"""


CHANNEL_SCENE = """
title = "a pulse of inflow past a held disc, on a coarse mesh"
[time]
{time}
[output]
checkpoint_every = 22
[fluid]
density = 1.0
kinematic_viscosity = 0.02
mesh = {{lower = [0.0, 0.0], upper = [{length}, 1.0], cells_x = {cells_x}, cells_y = {cells_y}}}
[fluid.boundaries]
bottom.type = "no_slip"
top.type = "no_slip"
left = {{type = "velocity", velocity = ["y*(1-y)*(1 + 8*exp(-((t-1)/0.1)^2))", 0]}}
right.type = "traction"
[[bodies]]
name = "disc"
radius = 0.2
motion = "fixed"
position = [1.0, 0.5]
"""


def channel_scene(time, length, cells_x, cells_y):
    return CHANNEL_SCENE.format(time=time, length=length, cells_x=cells_x, cells_y=cells_y)


class CoupledRun:
    """A coupler and the participants that its plan asks for, each a process in a folder of its own."""

    def __init__(self, folder, scene, extra=(), resume=False, participant_options=(), participant_folders=None,
                 environment=None, coupler_environment=None, most_files=None):
        self.folder = Path(folder)
        self.folder.mkdir(exist_ok=True)
        self.out = self.folder / "run"
        self.participants = {}
        scene_file = self.out / "scene.toml" if resume else self.folder / "scene.toml"
        if not resume:
            scene_file.write_text(scene)
        overrides = [word for word in extra if str(word).startswith("--set=")]
        plan = json.loads(run_coupler("--plan", scene_file, *overrides).stdout)
        command = [BIN / "coupler", "--out", self.out, "--watch-stdin", *extra]
        command += ["--resume"] if resume else ["--scene", scene_file]
        if most_files:  # as where a shell's soft limit is low
            command = ["/bin/sh", "-c", f'ulimit -Sn {most_files}; exec "$@"', "sh", *command]
        self.coupler = start(command, self.folder, coupler_environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        said = self.hear_until_address()
        if "address" not in said:
            return
        self.address, self.token_file = said["address"], said.get("token", "")
        token = ["--token", self.token_file] if self.token_file else []
        for participant in plan["participants"]:
            role = participant["role"]
            program = participant["command"] or {"fluid": BIN / "fluid_server", "dem": BIN / "dem_server"}[role]
            folder = (participant_folders or {}).get(role, self.folder)
            self.participants[role] = start(
                [program, "--connect", self.address, *token, "--scene", plan["scene_fingerprint"], "--log", f"{role}.log",
                 *participant_options], folder, environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)

    def hear_until_address(self):
        """What the coupler says by first word, up to its address."""
        said = {}
        for line in self.coupler.stdout:
            word, _, rest = line.strip().partition(" ")
            said[word] = rest
            if word == "address":
                break
        return said

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in [self.coupler, *self.participants.values()]:
            if process.poll() is None:
                process.kill()
            process.communicate()

    def wait(self):
        """Waits for all to end; returns the coupler's exit status. Its standard input stays open: the launcher lives."""
        self.coupler.stdout.read()
        self.coupler.wait(timeout=PATIENCE)
        for process in self.participants.values():
            process.wait(timeout=PATIENCE)
        return self.coupler.returncode

    def wait_for(self, condition):
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline and self.coupler.poll() is None, "what the test waits for never came"
            time.sleep(0.01)

    def wait_for_step(self, step):
        """Reads progress up to a step."""
        for line in self.coupler.stdout:
            if line.startswith("progress") and json.loads(line.removeprefix("progress"))["step"] >= step:
                return
        raise AssertionError(f"the run ended before step {step}")

    def tell_exit(self, role):
        """Does what the launcher does when a process of its own ends."""
        self.coupler.stdin.write(f"exited {role} {self.participants[role].wait(timeout=PATIENCE)}\n")
        self.coupler.stdin.flush()

    def forget_its_end(self):
        """Leaves the folder as a coupler that died after its last checkpoint but that of the end would."""
        (self.out / "summary.json").unlink()
        (self.out / "checkpoint.previous.bin").rename(self.out / "checkpoint.bin")

    @property
    def summary(self):
        return json.loads((self.out / "summary.json").read_text())

    @property
    def history(self):
        with (self.out / "history.csv").open() as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]

    @property
    def arrays(self):
        """All arrays of all HDF5 files, by file and name, as bytes."""
        return {f"{path.name}:{name}": values for path in sorted(self.out.glob("*.h5")) for name, values in arrays_of(path).items()}

    def log(self):
        return (self.out / "coupler.log").read_text()


def arrays_of(path):
    """Whatever can be read of an HDF5 file."""
    found = {}

    def collect(group, prefix):
        for name in group:  # follows links, as visititems does not
            value = group[name]
            if isinstance(value, h5py.Group):
                found[f"{prefix}{name}.time"] = value.attrs.get("time")
                collect(value, f"{prefix}{name}/")
            else:
                found[prefix + name] = value[()].tobytes() if value.dtype != object else tuple(value[()])

    with h5py.File(path, "r") as file:
        collect(file, "/")
    return found


def start(command, folder, environment=None, **streams):
    """Starts a process; like the launcher with dense kernels in one thread, unless the environment says otherwise."""
    return subprocess.Popen([str(word) for word in command], cwd=folder, text=True, stderr=subprocess.DEVNULL,
                            env={"OPENBLAS_NUM_THREADS": "1"} | os.environ | (environment or {}), **streams)


def run_coupler(*options):
    return subprocess.run([str(word) for word in (BIN / "coupler", *options)], capture_output=True, text=True,
                          check=False, timeout=PATIENCE)


def interrupt(process):
    process.send_signal(signal.SIGINT)
