#!/usr/bin/python3
"""Run time against error on the fluid benchmarks: DFG 2D-1 with the cylinder embedded, on a ladder of meshes.
Where FreeFem++ is installed it runs the same case, body-fitted, beside ours. Nothing is asserted here."""

import json
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PEERS = Path(__file__).resolve().parent / "peers"
DRAG = 5.57953523384  # Schäfer & Turek case 2D-1, reference value of the FeatFlow group
LADDER = {8: 0.0125, 16: 0.00625, 32: 0.003125}  # D/h: size on the cylinder [m] for D = 0.1 m


def ours(ratio: int, folder: Path) -> dict:
    """One run of configs/cylinder_steady.toml with the given D/h; its summary."""
    run = folder / f"embedded-{ratio}"
    command = [str(ROOT / "fpi"), "run", "cylinder_steady", "--out", str(run), "--json",
               "--set", f"fluid.mesh.refinements.0.size={LADDER[ratio]}", "--set", "output.fields=false"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"bench: `{' '.join(command)}` ended with status {done.returncode}:\n{done.stderr}")
    return json.loads(done.stdout)


def freefem(edges: int) -> tuple[int, float, float]:
    """The case in FreeFem++ with that many edges around the cylinder: unknowns, drag coefficient, seconds."""
    start = time.monotonic()
    command = ["FreeFem++", "-nw", "-v", "0", str(PEERS / "dfg_2d1.edp"), str(edges)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"bench: `{' '.join(command)}` ended with status {done.returncode}:\n{done.stdout[-500:]}")
    unknowns, drag = done.stdout.split()[-2:]
    return int(unknowns), float(drag), time.monotonic() - start


def row(name: str, unknowns: int, error: float, seconds: float, rest: str = "") -> None:
    print(f"{name:22s} {unknowns:10d} {error:12.2e} {seconds:9.2f}  {rest}")


def main() -> None:
    print(f"{'DFG 2D-1':22s} {'unknowns':>10s} {'cd error':>12s} {'wall s':>9s}  where it goes [s]")
    with tempfile.TemporaryDirectory() as folder:
        for ratio in LADDER:
            summary = ours(ratio, Path(folder))
            seconds = summary["wall_seconds"]
            parts = ", ".join(f"{key} {seconds[key]:.2f}" for key in ("mesh", "assembly", "factor", "solve", "interface"))
            row(f"fpi embedded D/h = {ratio}", summary["unknowns"], abs(summary["coefficients"]["drag"] / DRAG - 1),
                seconds["total"], parts)
    if shutil.which("FreeFem++"):
        for edges in (64, 128, 256):
            unknowns, drag, seconds = freefem(edges)
            row(f"FreeFem++ {edges} edges", unknowns, abs(drag / DRAG - 1), seconds)


if __name__ == "__main__":
    main()
