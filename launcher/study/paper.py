"""The counterparts of the paper's figures: runs the scenes, draws them, and writes docs/paper.md with our values."""

import re
import shutil
from pathlib import Path

from PIL import Image

from launcher import scenes
from launcher.common import ROOT, Refusal, programs, replace_text
from launcher.plots import plot, results
from launcher.run import report, run

TEMPLATE = ROOT / "docs" / "paper.in.md"
PAGE = ROOT / "docs" / "paper.md"
PICTURES = ROOT / "docs" / "paper"
RUNS = ROOT / "runs" / "paper"
LARGEST = 150_000  # bytes of a picture
SETTLED = 5.0  # [s] from when on flows that change are measured
VALUE = re.compile(r"\{(\w+):([^{}:]+)(?::([^{}]*))?\}")  # {scene:key/key:format} of summary.json, and largest_traction
PICTURE = re.compile(r"\]\(paper/(\w+)/([\w.]+)\)")  # ](paper/scene/picture.png)


def make(run_scene, say=print) -> None:
    """`run_scene(path, folder)` runs a scene of configs/ and returns its exit status; runs of the same are kept."""
    template, summaries = TEMPLATE.read_text(encoding="utf-8"), {}
    for scene in dict.fromkeys(found[1] for found in [*VALUE.finditer(template), *PICTURE.finditer(template)]):
        folder, path = RUNS / scene, scenes.find(scene)
        if not is_up_to_date(folder, path):
            shutil.rmtree(folder, ignore_errors=True)
            if run_scene(path, folder) != 0:
                raise Refusal(f"the scene {scene} must reach its end; see {folder}")
        summaries[scene] = report.summary_of(folder)
        since = SETTLED if summaries[scene]["steps"] > 1 else 0.0
        summaries[scene]["largest_traction"] = results.largest_tractions(folder, since)
        say(f"{scene}: done, drawing")
        drawn = {picture.name: picture for picture in plot.draw(folder)}
        for name in {found[2] for found in PICTURE.finditer(template) if found[1] == scene}:
            if name not in drawn:
                raise Refusal(f"the picture {name} of {scene} is required by {TEMPLATE}; drawn were {sorted(drawn)}")
            compress(drawn[name], PICTURES / scene / name)
    replace_text(PAGE, fill(template, summaries))


def is_up_to_date(folder: Path, scene: Path) -> bool:
    """True where a run reached its end with the programs, the mesh and the scene as they are now."""
    summary, as_run = report.summary_of(folder), folder / "scene.toml"
    if summary is None or summary["status"] != "completed":
        return False
    if any(program.stat().st_mtime > as_run.stat().st_mtime for program in programs().iterdir()):
        return False
    return run.plan(as_run, [])["scene_fingerprint"] == run.plan(scene, [])["scene_fingerprint"]


def fill(template: str, summaries: dict[str, dict]) -> str:
    """The template with every value in its place."""
    def value(found: re.Match) -> str:
        container = summaries[found[1]]
        for key in found[2].split("/"):
            container = entry(container, key)
        if container is None:
            raise Refusal(f"the summary of {found[1]} must have {found[2]}, which {TEMPLATE} names; it does not")
        return format(container, found[3] or "")

    return VALUE.sub(value, template)


def entry(container, key: str):
    """Of a table by key, of a list by number or by the name of its entry; None where there is none."""
    if isinstance(container, list):
        by_name = {one["name"]: one for one in container if isinstance(one, dict)}
        container = {str(i): one for i, one in enumerate(container)} | by_name
    return container.get(key) if isinstance(container, dict) else None


def compress(source: Path, target: Path) -> None:
    """A copy of a picture of at most LARGEST bytes: as it is where it can be, else of fewer colours, then smaller."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.stat().st_size <= LARGEST:
        shutil.copyfile(source, target)
        return
    with Image.open(source) as original:
        image = original.convert("RGB")
    for _ in range(8):
        fewer = image.quantize(256, Image.Quantize.MAXCOVERAGE, kmeans=1000, dither=Image.Dither.NONE)  # keeps rare colours
        fewer.save(target, optimize=True)
        if target.stat().st_size <= LARGEST:
            return
        image = image.resize((round(0.85 * image.width), round(0.85 * image.height)), Image.Resampling.LANCZOS)
    raise Refusal(f"a picture of at most {LARGEST} bytes is required; {source} stays larger")
