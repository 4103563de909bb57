"""The commands of `./fpi` and what each does. What only some commands need is imported there: a small run feels it."""

import argparse
import os
import shutil
import sys
from pathlib import Path

from launcher import scenes
from launcher.common import MISUSED, ROOT, Refusal, VERSION, program, programs, require_plain
from launcher.ending import document
from launcher.processes import answer, ended
from launcher.run import display, report, run, trust
from launcher.setup import build


class Parser(argparse.ArgumentParser):
    """Refuses as everything else does. Options have no short forms, which another option may take away."""

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, allow_abbrev=False, **options)

    def error(self, message: str):
        raise Refusal(f"{message}; `{self.prog} -h` tells what there is", MISUSED)


def carry_out(words: list[str]) -> int:
    """Returns the exit status; see launcher.ending for what is raised."""
    arguments = parser().parse_args(words)
    return arguments.do(arguments)


def parser() -> argparse.ArgumentParser:
    top = Parser(prog="fpi", description="Resolved fluid-particle interaction: runs, pictures, tests.")
    top.add_argument("--version", action="version", version=f"fpi {VERSION.read_text().strip()}")
    commands = top.add_subparsers(title="commands", metavar="COMMAND", required=True)

    def command(name, do, text, scene=False):
        sub = commands.add_parser(name, help=text, description=text)
        sub.set_defaults(do=do)
        if scene:
            sub.add_argument("scene", metavar="SCENE", help="a scene file, or the name of one in configs/")
            set_option(sub, "replaces a value of the scene, e.g. fluid.density=998 or bodies.0.radius=0.01")
        return sub

    def set_option(sub, text):
        sub.add_argument("--set", dest="overrides", metavar="KEY=VALUE", action="append", default=[], help=text)

    def script_options(sub):
        sub.add_argument("--quiet", action="store_true", help="print errors only")
        sub.add_argument("--json", action="store_true", help="print summary.json at the end, and errors, only")
        sub.add_argument("--jobs", type=positive, metavar="N", help="threads of each program (default: all cores for assembly, one for dense kernels)")
        sub.add_argument("--listen", metavar="ADDRESS", help="where the coupler binds, e.g. tcp://0.0.0.0:5555")
        sub.add_argument("--keys", type=Path, metavar="DIR", help="folder of keys, needed beyond this machine")
        sub.add_argument("--trust", action="store_true", help="start the programs that the scene names (command = ...), now and later")

    running = command("run", do_run, "run a scene to its end", scene=True)
    running.add_argument("--out", type=Path, metavar="DIR", help="run folder, new or empty (default runs/SCENE)")
    script_options(running)
    sweeping = command("sweep", do_sweep, "run a scene at every combination of some values, go on where it was left, and tabulate", scene=True)
    sweeping.add_argument("axes", nargs="+", metavar="KEY=A,B,C", help="a key of the scene and its values, e.g. fluid.pressure_drop=[1,0],[2,0]")
    sweeping.add_argument("--out", type=Path, metavar="DIR", help="folder of the sweep, new or that of the same sweep (default runs/SCENE-sweep)")
    script_options(sweeping)
    checking = command("check", do_check, "say all that a run of a scene would refuse, without running it", scene=True)
    checking.add_argument("--json", action="store_true", help="print findings and figures as JSON, and nothing else")
    resuming = command("resume", do_resume, "continue a run from its last checkpoint")
    resuming.add_argument("run", type=Path, metavar="RUN", help="the run folder")
    set_option(resuming, "a later end, time.end=…, extends a run, finished or not; the values that decided its results stay")
    script_options(resuming)
    plotting = command("plot", do_plot, "draw the results of a run")
    plotting.add_argument("run", type=Path, metavar="RUN", help="the run folder")
    plotting.add_argument("--movie", action="store_true", help="and a movie of its bodies (MP4 with ffmpeg, else GIF)")
    meshing = command("mesh", do_mesh, "make a body-fitted mesh with Gmsh")
    meshing.add_argument("geometry", metavar="NAME", help="a .geo file, or the name of one in configs/")
    meshing.add_argument("--size", type=factor, default=1.0, metavar="F", help="scales all element sizes (default 1)")
    meshing.add_argument("--out", type=Path, metavar="FILE", help="the mesh file (default: .msh beside the geometry)")
    command("list", do_list, "name the scenes that come with fpi")
    building = command("build", do_build, "install what is missing and build the programs")
    building.add_argument("--all", action="store_true", help="the tests, too")
    building.add_argument("--preset", choices=build.PRESETS, default="release")
    building.add_argument("--jobs", type=positive, metavar="N", help="compilers at a time (default: all cores)")
    testing = command("test", do_test, "build and run the tests")
    testing.add_argument("--all", action="store_true", help="the slow ones too")
    testing.add_argument("--preset", choices=build.PRESETS, default="release")
    testing.add_argument("--jobs", type=positive, metavar="N", help="compilers and tests at a time")
    linting = command("lint", do_lint, "check format, Python, documents and structure, without a build")
    linting.add_argument("--tidy", choices=("changed", "all"), help="clang-tidy too, on what changed since --base or all sources (slow)")
    linting.add_argument("--base", metavar="COMMIT", default="HEAD", help="of what changed (default HEAD)")
    command("demo", do_demo, "install, build, let a disc settle, draw it")
    bench = command("bench", do_bench, "run time against error on benchmark flows, steps a second of grains, beside other programs; what the coupling takes; noise of forces; growth with the number of grains")
    bench.add_argument("subject", nargs="?", choices=("fluid", "grains", "coupling", "noise", "growth"), default="fluid", help="what is measured")
    bench.add_argument("rest", nargs=argparse.REMAINDER, metavar="...", help="its options; -h names them")
    stressing = command("stress", do_stress, "random cases of embedded or coupled bodies: which survive, how exact and quiet they are or how soon they converge")
    stressing.add_argument("subject", nargs="?", choices=("interface", "coupling"), default="interface", help="what is tried")
    stressing.add_argument("--seed", type=positive, default=1, metavar="N", help="of the random numbers (default 1)")
    stressing.add_argument("--cases", type=positive, metavar="N", help="how many, about (default some 250; few with --quick)")
    stressing.add_argument("--only", metavar="CASE", help="one case by its name, with all it says")
    stressing.add_argument("--quick", action="store_true", help="coarse meshes and few steps: seconds")
    stressing.add_argument("--jobs", type=positive, metavar="N", help="cases at a time (default: all cores)")
    stressing.add_argument("--out", type=Path, metavar="FILE", default=ROOT / "runs" / "stress.json", help="all results as JSON")
    stressing.add_argument("--json", action="store_true", help="print them, and nothing else")
    command("paper", do_paper, "run the flows of the paper and write docs/paper.md with their pictures")
    keys = command("keys", do_keys, "make the keys for runs across machines")
    keys.add_argument("folder", type=Path, metavar="DIR", help="folder for the keys")
    return top


def positive(text: str) -> int:
    if not (text.isascii() and text.isdigit() and len(text) < 10 and int(text) > 0):
        raise argparse.ArgumentTypeError(f"a whole number of at least 1 is required; got {text}")
    return int(text)


def factor(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = 0
    if not 1e-3 <= number <= 1e3:
        raise argparse.ArgumentTypeError(f"a factor from 0.001 to 1000 is required; got {text}")
    return number


def do_run(arguments) -> int:
    ensure_programs(arguments.quiet or arguments.json)
    scene = scenes.find(arguments.scene)
    plan = trusted_plan(scene, arguments, arguments.overrides)
    stages = [(run.Request(Path(stage["scene"]), Path(stage["folder"])), trusted_plan(Path(stage["scene"]), arguments))
              for stage in plan["stages"] if not stage["ready"]]
    for request, its_plan in stages:  # the scenes that the planned one goes on from
        request.folder.mkdir(parents=True, exist_ok=True)
        status, summary = run_to_end(request, its_plan, arguments)
        if status != 0:
            report_end(request.folder, status, summary, arguments)
            return status
    if stages:  # what they ended with belongs to the scene
        plan = run.plan(scene, arguments.overrides)
        trust.require(scene, plan, trusted=True)
    return execute(run.Request(scene, run.new_folder(arguments.out, scene), arguments.overrides), plan, arguments)


def trusted_plan(scene: Path, arguments, overrides: list[str] = ()) -> dict:
    """The plan of a scene whose programs may be started."""
    plan = run.plan(scene, list(overrides))
    trust.require(scene, plan, arguments.trust, overrides)
    return plan


def do_resume(arguments) -> int:
    ensure_programs(arguments.quiet or arguments.json)
    scene = arguments.run / "scene.toml"
    if not scene.is_file():
        raise Refusal(f"a run folder with its scene.toml is required; there is none in {arguments.run}")
    trusted_plan(scene, arguments)
    request = run.Request(scene, arguments.run, arguments.overrides, resume=True)
    return execute(request, run.plan(scene, arguments.overrides), arguments)


def do_sweep(arguments) -> int:
    ensure_programs(arguments.quiet or arguments.json)
    from launcher.study import sweep

    scene = scenes.find(arguments.scene)
    out = arguments.out or Path("runs") / f"{scene.stem}-sweep"
    points = sweep.points(sweep.parse(arguments.axes))
    trusted_plan(scene, arguments, arguments.overrides)
    rows = []
    for number, point in enumerate(points, 1):
        if not (arguments.quiet or arguments.json):
            print(f"[{number}/{len(points)}] {', '.join(point.overrides)}")
        status, row = run_point(scene, point, out / point.name, arguments)
        rows.append(row)
        sweep.write(out / "sweep.csv", rows)
        if status >= 128:
            raise Refusal(f"{row.reason}; the same `./fpi sweep` goes on from there", status)
        if row.reason and not arguments.json:
            print(f"fpi: {', '.join(point.overrides)}: {row.reason}", file=sys.stderr)
    report_sweep(out, rows, arguments)
    return int(any(row.status != "completed" for row in rows))


def run_point(scene: Path, point, folder: Path, arguments):
    """Exit status and row of a point of a sweep: what its run left behind, which is made or taken to its end first."""
    from launcher.study import sweep

    overrides = [*arguments.overrides, *point.overrides]
    plan = run.plan(scene, overrides)
    state = sweep.state_of(folder, lambda path: run.plan(path, [])["scene_fingerprint"], plan["scene_fingerprint"])
    if state == "done":
        status, summary = 0, report.summary_of(folder)
    else:
        if state == "new":
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
        resumed = state == "begun"
        request = run.Request(folder / "scene.toml" if resumed else scene, folder, [] if resumed else overrides, resumed)
        status, summary = run_to_end(request, plan, arguments)
    return status, sweep.Row(point, summary["status"], sweep.figures(summary), summary["reason"])


def report_sweep(out: Path, rows: list, arguments) -> None:
    """Table, fit of Darcy's and Forchheimer's law where the drive was swept, and picture."""
    from launcher.study import sweep

    done = [row for row in rows if row.status == "completed"]
    driven = any(sweep.is_drive(key) for key in rows[0].point.values) and any("pressure_gradient" in row.figures for row in done)
    medium = sweep.medium(out / done[0].point.name / "scene.toml") if driven else None
    fits = list(sweep.fits(done, medium)) if driven else []
    if done:
        ensure_packages(arguments.quiet or arguments.json)
        if fits:
            sweep.draw_fits(out / "sweep.png", done, fits, medium)
        else:
            sweep.draw(out / "sweep.png", done)
    if arguments.json:
        document({"out": str(out), "fits": [vars(fit) for fit in fits],
                  "runs": [{**row.point.values, "status": row.status, "reason": row.reason, **row.figures} for row in rows]})
    elif not arguments.quiet:
        files = "sweep.csv, sweep.png" if done else "sweep.csv"
        print("\n" + "\n".join([sweep.table(rows), "", *map(sweep.describe, fits), f"in {out}: {files}"]))


def execute(request: run.Request, plan: dict, arguments) -> int:
    status, summary = run_to_end(request, plan, arguments)
    report_end(request.folder, status, summary, arguments)
    return status


def run_to_end(request: run.Request, plan: dict, arguments) -> tuple[int, dict]:
    """Exit status of a run, and its summary: of one that never began status and reason only."""
    request.listen, request.keys, request.threads = arguments.listen, arguments.keys, arguments.jobs
    for folder in (request.folder, request.keys):
        if folder is not None and folder.is_dir():
            require_plain(folder)
    the_run = run.Run(request, plan, display.Display())
    with run.interruptions_call(the_run.interrupt):  # a screen that is begun is ended, too
        screen = the_run.display = display.choose(arguments.quiet or arguments.json)
        screen.say(f"{plan['title'] or request.scene.stem}: results go to {request.folder}")
        try:
            status = the_run.execute()
        finally:
            screen.close()
    summary = the_run.outcome(report.summary_of(request.folder))
    as_run = request.folder / "scene.toml"
    if trust.commands(plan) and as_run.is_file():
        trust.remember_run(as_run, run.plan(as_run, []))
    return status if status != 0 else int(summary["status"] != "completed"), summary


def report_end(folder: Path, status: int, summary: dict, arguments) -> None:
    """Tells how a run ended: as JSON, as a table, or by nothing but the reason why it failed."""
    if arguments.json:
        document({"run": str(folder), **summary})
    elif status != 0 and (arguments.quiet or "steps" not in summary):
        raise Refusal(summary["reason"], status)
    elif not arguments.quiet:
        report.show(folder, summary)


def do_check(arguments) -> int:
    ensure_programs(quiet=arguments.json)
    report = run.check(scenes.find(arguments.scene), arguments.overrides, arguments.json)
    reports = [report] + [run.check(Path(stage["scene"]), [], arguments.json) for stage in report["stages"] if not stage["ready"]]
    if arguments.json:
        for one in reports:
            del one["text"]
        document({**report, "checked_stages": reports[1:]})
    else:
        print("\n".join(line for one in reports for line in one["text"]))
    return int(any(one["status"] != "ok" for one in reports))


def do_plot(arguments) -> int:
    ensure_packages()
    from launcher.plots import plot  # needs packages that set-up installs

    pictures = plot.draw(arguments.run, arguments.movie)
    for picture in pictures:
        print(picture)
    if any(picture.suffix == ".gif" for picture in pictures):
        print("The movie is a GIF: for an MP4 install ffmpeg (sudo apt-get install ffmpeg) and draw again.")
    return 0


def do_mesh(arguments) -> int:
    from launcher.setup import mesh

    print(mesh.make(arguments.geometry, arguments.size, arguments.out))
    return 0


def do_list(_arguments) -> int:
    field = ""
    for folder, name, title in scenes.titles():
        if folder != field:
            field = folder
            print(f"{field.replace('_', ' ')}:")
        print(f"  {name:32s} {title}")
    return 0


def do_build(arguments) -> int:
    ensure_packages()
    build.build(arguments.preset, arguments.jobs, targets=build.EVERYTHING if arguments.all else build.PROGRAMS)
    return 0


def do_test(arguments) -> int:
    ensure_packages()
    build.build(arguments.preset, arguments.jobs, targets=build.EVERYTHING)
    return build.test(arguments.preset, arguments.all, arguments.jobs)


def do_lint(arguments) -> int:
    from launcher.setup import lint, packages

    packages.install(packages.LINT)
    faults = lint.lint(arguments.tidy, arguments.base)
    print(*faults, sep="\n", end="\n" if faults else "")
    return int(bool(faults))


def do_demo(_arguments) -> int:
    ensure_packages()
    build.build()
    scene = scenes.find("settling_disc")
    folder = str(run.new_folder(None, scene))
    status = carry_out(["run", str(scene), "--out", folder])
    if status != 0:
        return status
    print("\n  pictures:")
    return carry_out(["plot", folder])


def do_bench(arguments) -> int:
    ensure_packages()
    build.build(targets=(*build.PROGRAMS, *(["interface_noise"] if arguments.subject == "noise" else [])))
    script = ROOT / "bench" / f"{arguments.subject}.py"
    # Ctrl-C ends the script as it ends the launcher, without a traceback.
    start = ("import runpy, signal, sys; signal.signal(signal.SIGINT, signal.SIG_DFL); sys.argv.pop(0); "
             "runpy.run_path(sys.argv[0], run_name='__main__')")
    command = [sys.executable, "-I", "-X", "utf8", "-c", start, str(script), *arguments.rest]
    status = ended(command, stdin=None, stdout=None, stderr=None).returncode
    return status if status >= 0 else 128 - status


def do_stress(arguments) -> int:
    ensure_programs(arguments.json, *(["interface_stress"] if arguments.subject == "interface" else []))
    from launcher.study import stress

    sweep = stress.Sweep(arguments.subject, arguments.seed, arguments.cases, arguments.only, arguments.quick)
    results = sweep.run(arguments.jobs, arguments.json)
    stress.write(arguments.out, sweep, results)
    if arguments.json or arguments.only:
        document(results)
    else:
        print(stress.table(sweep, results))
    print(stress.failures(sweep, results), file=sys.stderr)
    return int(any(row["failure"] and not row["refused"] for row in results))


def do_paper(_arguments) -> int:
    ensure_packages()
    build.build()
    from launcher.study import paper  # needs packages that set-up installs

    paper.make(lambda scene, folder: carry_out(["run", str(scene), "--out", str(folder)]))
    return 0


def do_keys(arguments) -> int:
    ensure_programs(quiet=False)
    print(answer([str(program("coupler")), "--make-keys", str(arguments.folder)]), end="")
    return 0


def ensure_programs(quiet: bool, *more: str) -> None:
    """Sets up and builds where the programs of a run, or `more`, are not there yet; the commands `build` and `test` bring
    them up to date."""
    needed = (*build.PROGRAMS, *more)
    if os.environ.get("FPI_BIN") or all((programs() / name).exists() for name in needed):
        return
    ensure_packages(quiet)
    build.build(quiet=quiet, targets=needed)


def ensure_packages(quiet: bool = False) -> None:
    from launcher.setup import packages

    packages.ensure(say=(lambda text: None) if quiet else print)
