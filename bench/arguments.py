"""What all benches are asked: which cases, how many of them, and where to."""

import argparse
from collections.abc import Collection
from pathlib import Path

from bench.tools import ROOT


def bench_parser(description: str, cases: Collection[str], quick: str) -> argparse.ArgumentParser:
    """Of cases, --quick (the help says what it leaves out) and --out."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"of {', '.join(cases)}; all where none is named")
    parser.add_argument("--quick", action="store_true", help=quick)
    parser.add_argument("--out", type=Path, default=ROOT / "runs" / "bench", metavar="DIR", help="for JSON and picture")
    return parser


def read_arguments(parser: argparse.ArgumentParser, cases: Collection[str]) -> argparse.Namespace:
    """Ends the bench where a case is not known; makes the folder of results."""
    arguments = parser.parse_args()
    if unknown := set(arguments.cases) - set(cases):
        parser.error(f"a case of {', '.join(cases)} is required; got {', '.join(unknown)}")
    arguments.out.mkdir(parents=True, exist_ok=True)
    return arguments
