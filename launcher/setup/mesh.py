"""Body-fitted meshes: Gmsh turns NAME.geo into NAME.msh, of second order so that round boundaries are."""

import shutil
from pathlib import Path

from launcher.common import Refusal, require_regular
from launcher.processes import describe, ended
from launcher.scenes import find_file


def make(name: str, size: float = 1.0, output: Path | None = None) -> Path:
    """Writes the mesh of the geometry called `name`, a path or one of configs/; `size` scales all element sizes."""
    geometry = find_file(name, ".geo", "geometry")
    if geometry.suffix != ".geo":
        raise Refusal(f"a geometry file (.geo) is required; got {geometry}")
    mesh = output or geometry.with_suffix(".msh")
    if mesh.exists():
        require_regular(mesh)
    gmsh = shutil.which("gmsh")
    if gmsh is None:
        raise Refusal("the program gmsh is required to make meshes and not there: apt-get install -y gmsh")
    command = [gmsh, "-2", "-order", "2", "-format", "msh41", "-setnumber", "size", f"{size:g}",
               str(geometry), "-o", str(mesh)]
    done = ended(command)
    faults = [line for line in done.stdout.splitlines() + done.stderr.splitlines() if line.startswith("Error")]
    if done.returncode != 0 or faults:
        raise Refusal(f"gmsh must mesh {geometry}; it ended with {describe(done.returncode)}: " + "\n".join(faults))
    return mesh
