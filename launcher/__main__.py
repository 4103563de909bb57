"""Entry point of `./fpi`."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from launcher.cli import main  # noqa: E402  (the path must be there first)

if __name__ == "__main__":
    sys.stdout.reconfigure(line_buffering=True)  # progress must show in a pipe or a log, too
    sys.exit(main(sys.argv[1:]))
