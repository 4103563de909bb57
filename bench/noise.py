#!/usr/bin/python3
"""Force noise of cylinders that swing through the mesh, in fluid at rest and across a stream, for several step sizes:
how far the force is from a smooth one. Nothing is asserted here."""

import argparse
import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from bench.measure import ONE_THREAD
from launcher.common import program

FLOWS = "oscillating", "stream"
COURANT = 2, 1, 0.5, 0.25, 0.125, 0.03125  # elements crossed in a step; the last two are a quarter and a sixteenth of 0.5


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("flows", nargs="*", metavar="FLOW", help=f"of {', '.join(FLOWS)}; both where none is named")
    parser.add_argument("--cfl", type=float, nargs="+", default=COURANT, metavar="C", help="elements crossed in a step")
    arguments = parser.parse_args()
    flows = arguments.flows or FLOWS
    if unknown := set(flows) - set(FLOWS):
        parser.error(f"a flow of {', '.join(FLOWS)} is required; got {', '.join(unknown)}")
    running = [subprocess.Popen([program("interface_noise"), flow, *map(str, arguments.cfl)], stdout=subprocess.PIPE,
                                env=os.environ | ONE_THREAD, text=True) for flow in flows]
    for process in running:
        print(process.communicate()[0], flush=True)
    sys.exit(max(process.returncode for process in running))


if __name__ == "__main__":
    main()
