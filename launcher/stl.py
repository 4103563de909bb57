"""Triangles of an STL file, text or binary, as far as pictures need them: the programs have checked the file."""

from pathlib import Path

import numpy as np

HEAD, TRIANGLE = 84, 50  # bytes of a binary file


def read(path: Path) -> np.ndarray:
    """Corners (triangles, 3, 3) in the unit of the file."""
    data = path.read_bytes()
    count = int.from_bytes(data[80:HEAD], "little")
    if len(data) == HEAD + TRIANGLE * count:
        rows = np.frombuffer(data, np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")]), offset=HEAD)
        return rows["corners"].astype(float)
    words = data.split()
    starts = [i for i, word in enumerate(words) if word.lower() == b"vertex"]
    return np.array([[float(x) for x in words[i + 1:i + 4]] for i in starts]).reshape(-1, 3, 3)
