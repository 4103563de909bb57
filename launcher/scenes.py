"""The scenes that come with the project."""

from pathlib import Path

from launcher.common import ROOT, Refusal

FOLDER = ROOT / "configs"


def find(word: str) -> Path:
    """The scene file called `word`: a path, or the name of a scene in configs/."""
    for path in (Path(word), FOLDER / word, FOLDER / f"{word}.toml"):
        if path.is_file():
            return path
    names = ", ".join(path.stem for path in sorted(FOLDER.glob("*.toml")))
    raise Refusal(f"a scene file is required; there is no {word}. Scenes that come with fpi: {names}")


def titles() -> list[tuple[str, str]]:
    """Name and title of each scene in configs/."""
    import tomllib  # no run needs it

    return [(path.stem, tomllib.loads(path.read_text(encoding="utf-8")).get("title", "")) for path in sorted(FOLDER.glob("*.toml"))]
