"""The scenes that come with the project."""

from pathlib import Path

from launcher.common import ROOT, Refusal, read_text, require_regular

FOLDER = ROOT / "configs"


def find(word: str) -> Path:
    """The scene file called `word`: a path, or the name of a scene in configs/."""
    return find_file(word, ".toml", "scene")


def find_file(word: str, suffix: str, what: str) -> Path:
    """The file called `word`: a path, or a name in a folder of configs/."""
    if (path := Path(word)).is_file():
        return path
    places = path, *(path for path in shipped(suffix) if word in (path.stem, path.name))
    for path in places:
        if path.is_file():
            return path
    for path in places:
        if path.is_symlink() and not path.exists():
            raise Refusal(f"a {what} file is required; {path} is a link to nothing")
        if path.exists():
            require_regular(path)
    names = ", ".join(path.stem for path in shipped(suffix))
    raise Refusal(f"a {what} file ({suffix}) is required; there is no {word}. Those that come with fpi: {names}")


def shipped(suffix: str) -> list[Path]:
    """The files in configs/, whose folders are fields of physics, by name."""
    return sorted(FOLDER.glob(f"*/*{suffix}"), key=lambda path: path.name)


def titles() -> list[tuple[str, str, str]]:
    """Folder, name and title of each scene in configs/, folder by folder."""
    return [(path.parent.name, path.stem, title(path)) for path in sorted(shipped(".toml"))]


def title(scene: Path) -> str:
    import tomllib  # no run needs it

    try:
        return str(tomllib.loads(read_text(scene)).get("title", ""))
    except (OSError, Refusal, tomllib.TOMLDecodeError) as error:
        return f"(cannot be read: {error})"
