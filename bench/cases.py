"""The benchmark flows: their reference values and, from coarse to fine, what each program runs."""

import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from bench.oscillation import shedding
from bench.tools import ROOT, Run, dolfinx, fpi, freefem, gmsh_mesh, history


@dataclass
class Case:
    title: str
    references: dict[str, tuple[float, str]]  # value and what errors are measured in: absolute or relative
    rungs: Callable[[Path], list[list[Run]]]  # runs by fineness; may write meshes into the folder

    def errors(self, values: dict[str, float]) -> dict[str, float]:
        """Of each quantity; nothing for those that were not found."""
        return {name: abs(values[name] - reference) / (abs(reference) if kind == "relative" else 1)
                for name, (reference, kind) in self.references.items() if name in values}


def forces(found: dict) -> dict:
    return {"cd": found["drag"], "cl": found["lift"]}


def steady_cylinder(folder: Path) -> list[list[Run]]:
    def ours(summary, _run):
        return forces(summary["coefficients"])

    def fitted(tool, size, order, *more):
        mesh = gmsh_mesh("cylinder", size, order, folder)
        return fpi(tool, f"size {size:g}", "cylinder_fitted", folder, [f"fluid.mesh.file={mesh}", *more], ours)

    def rung(size: float, ratio: int, edges: int) -> list[Run]:
        cell = f"fluid.mesh.refinements.0.size={0.1 / ratio:g}"
        wake = f"fluid.mesh.refinements.1.size={0.4 / ratio:g}"
        curved = gmsh_mesh("cylinder", size, 2, folder)
        return [fitted("fpi fitted straight", size, 1),
                fitted("fpi fitted curved", size, 2),
                fitted("fpi fitted curved, MUMPS", size, 2, "fluid.linear_solver=\"mumps\""),
                fpi("fpi embedded", f"D/h {ratio}", "cylinder_steady", folder, [cell, wake], ours),
                *dolfinx(f"size {size:g}", "dfg_2d1.py", [curved], forces),
                *freefem(f"{edges} edges", "dfg_2d1.edp", [edges], forces)]

    return [rung(2, 8, 32), rung(1, 16, 64), rung(0.5, 32, 128), rung(0.3, 48, 192)]


def shedding_cylinder(folder: Path) -> list[list[Run]]:
    end, start = 7, 5

    def measured(series):
        return shedding(series, start, length=0.1, velocity=1)

    def ours(_summary, run):
        return measured(history(run, "time", "drag", "lift"))

    def theirs(found):
        return measured(found["series"])

    def rung(size: float, edges: int, step: float, split_step: float) -> list[Run]:
        common = [f"time.step={step:g}", "output.fields=false"]
        curved = gmsh_mesh("cylinder_shedding", size, 2, folder)
        return [fpi("fpi fitted curved", f"size {size:g}, step {step:g}", "cylinder_shedding_fitted", folder,
                    [*common, f"fluid.mesh.file={curved}"], ours),
                fpi("fpi embedded", f"size {size:g}, step {step:g}", "cylinder_shedding", folder,
                    [*common, f"fluid.mesh.refinements.0.size={0.0032 * size:g}",
                     f"fluid.mesh.refinements.1.size={0.0125 * size:g}"], ours),
                *dolfinx(f"size {size:g}, step {split_step:g}", "dfg_2d2.py", [curved, split_step, end, start], theirs),
                *freefem(f"{edges} edges, step {step:g}", "dfg_2d2.edp", [edges, step, end, start], theirs)]

    return [rung(1.42, 64, 0.01, 0.005), rung(1, 96, 0.004, 0.0025)]


def cavity(folder: Path) -> list[list[Run]]:
    def ours(summary, _run):
        upright, level = summary["profiles"]["upright"], summary["profiles"]["level"]
        return {"u_min": upright["min"], "v_max": level["max"], "v_min": level["min"]}

    def theirs(found):
        return {name: found[name] for name in ("u_min", "v_max", "v_min")}

    def rung(cells: int, freefem_cells: int) -> list[Run]:
        sets = [f"fluid.mesh.cells_x={cells}", f"fluid.mesh.cells_y={cells}"]
        return [fpi("fpi", f"{cells} cells", "cavity_1000", folder, sets, ours),
                fpi("fpi, MUMPS", f"{cells} cells", "cavity_1000", folder, [*sets, "fluid.linear_solver=\"mumps\""], ours),
                *freefem(f"{freefem_cells} cells", "cavity.edp", [freefem_cells], theirs)]

    return [rung(32, 24), rung(56, 40), rung(80, 64)]


def percolation(folder: Path) -> list[list[Run]]:
    def ours(summary, _run):
        return {"flux": summary["percolation"]["superficial_velocity_x"]}  # times 2 m², over 2 m

    def fitted(found):
        return {"flux": found["flux"]}

    packing = folder / "packing"
    subprocess.run([str(ROOT / "fpi"), "run", "percolation_random", "--quiet", "--out", str(packing),
                    "--set", "fluid.mesh.elements_per_diameter=2"], check=True)

    def rung(ratio: int, edges: int) -> list[Run]:
        sets = [f"fluid.mesh.elements_per_diameter={ratio}", "output.fields=false"]
        return [fpi("fpi", f"D/h {ratio}", "percolation_random", folder, sets, ours),
                fpi("fpi, MUMPS", f"D/h {ratio}", "percolation_random", folder, [*sets, "fluid.linear_solver=\"mumps\""], ours),
                *freefem(f"{edges} edges", "percolation.edp", [packing / "grains.csv", edges], fitted)]

    return [rung(6, 20), rung(8, 32), rung(10, 48), rung(16, 64)]


CASES = {
    "2d1": Case("DFG 2D-1, steady cylinder", {"cd": (5.57953523384, "absolute"), "cl": (0.010618948146, "absolute")},
                steady_cylinder),
    "2d2": Case("DFG 2D-2, vortex shedding, 7 s",
                {"cd_max": (3.227393, "relative"), "cd_min": (3.164263, "relative"), "cl_range": (2.007871, "relative"),
                 "St": (0.301841, "relative")}, shedding_cylinder),
    "cavity": Case("Lid-driven cavity, Re 1000", {"u_min": (-0.3885698, "absolute"), "v_max": (0.3769447, "absolute"),
                                                  "v_min": (-0.5270771, "absolute")}, cavity),
    "percolation": Case("Stokes flow past 80 random grains", {"flux": (2.913e-5, "relative")}, percolation),
}
