"""Triangles of an STL file, text or binary, as far as pictures need them: the programs have checked the file."""

from pathlib import Path

import numpy as np

HEAD, TRIANGLE = 84, 50  # bytes of a binary file


def read(path: Path) -> np.ndarray:
    """Corners (triangles, 3, 3) in the unit of the file."""
    data = path.read_bytes()
    if is_binary(data):
        layout = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
        return np.frombuffer(data, layout, count=announced(data), offset=HEAD)["corners"].astype(float)
    words = data.split()
    starts = [i for i, word in enumerate(words) if word.lower() == b"vertex"]
    return np.array([[float(x) for x in words[i + 1:i + 4]] for i in starts]).reshape(-1, 3, 3)


def announced(data: bytes) -> int:
    """Triangles that the head of a binary file counts."""
    return int.from_bytes(data[80:HEAD], "little")


def is_binary(data: bytes) -> bool:
    """Text begins with "solid", as the head of some binary files does: these have a size that fits, or zeros."""
    if announced(data) > 0 and len(data) == HEAD + TRIANGLE * announced(data):
        return True
    return not data.removeprefix(b"\xef\xbb\xbf").lstrip().lower().startswith(b"solid") or b"\0" in data[:HEAD]
