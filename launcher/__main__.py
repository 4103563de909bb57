"""Entry point of `./fpi`."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from launcher import ending  # noqa: E402  (the path must be there first)


def carry_out(words: list[str]) -> int:
    from launcher import cli  # Ctrl-C may come while it is imported

    return cli.carry_out(words)


if __name__ == "__main__":
    ending.open_streams()
    sys.exit(ending.end(sys.argv[1:], carry_out))
