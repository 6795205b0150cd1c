"""The ``lubfric`` command: run, info, study, fit, plot, init, oils. What a command needs is imported when it runs."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from .._base import __version__
from ..errors import ConvergenceError, InputError, LubfricError
from .commands import INTERRUPTED, interruptible, put, say

CURVE, RATIOS, IN_TIME = "a Stribeck curve", "a traction curve (--ratios)", "a scene with [transient]"
OPTIONS = {"ratios": RATIOS, "animation": IN_TIME}  # of ``lubfric run``, and what they are for
OPTIONS |= dict.fromkeys(("speeds", "fields", "workers", "vtk"), CURVE)
SPEED = "heading of its column of entrainment speeds, with the unit: 'U [mm/s]'"
F = "heading of its column of friction coefficients"
WITHOUT = "the coefficients do not hold the rolling part, as those averaged over both signs of slip"


def main(argv=None) -> int:
    """Entry point; returns the exit code: 0 done, 1 a solve failed, 2 bad input or a file that cannot
    be written, 130 interrupted, 143 terminated."""
    arguments = parser().parse_args(argv)
    try:
        with interruptible():
            arguments.command(arguments)
            return 0
    except (LubfricError, OSError) as error:  # OSError: a folder that cannot be written, a disk that is full
        say(f"lubfric: {error}")
        return 1 if isinstance(error, ConvergenceError) else 2
    except KeyboardInterrupt as error:
        say(f"lubfric: {str(error) or 'interrupted'}")
        return getattr(error, "code", INTERRUPTED)


def parser() -> argparse.ArgumentParser:
    """The parser of the command. What it returns has the function to call as ``command``."""
    whole = argparse.ArgumentParser(prog="lubfric", description="Friction of mixed-lubricated rough line contacts.")
    whole.add_argument("--version", action="version", version=f"lubfric {__version__}")
    commands = whole.add_subparsers(required=True, metavar="COMMAND")

    def command(name: str, work, about: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=about)
        added.set_defaults(command=work)
        return added

    _add_run(command("run", _run, "compute the Stribeck curve of a scene and write it to a folder"))
    _add_scene(command("info", _info, "say what a scene is and what will be solved, without solving it"))
    _add_study(command("study", _study, "vary anything in a scene: many points, kept as they end"))
    _add_fit(command("fit", _fit, "find numbers of a scene from a measured curve"))
    plot = command("plot", _plot, "draw stribeck.png, traction.png or history.png again from its table")
    plot.add_argument("folder", type=Path, help="folder written by 'lubfric run'")
    _add_texts(
        plot, measured="text file of a measured curve to draw among the computed one", speed=SPEED, coefficient=F
    )
    init = command("init", _init, "write a commented scene to start from")
    init.add_argument("file", type=Path, nargs="?", default=Path("scene.toml"), help="(default: scene.toml)")
    oils = command("oils", _oils, "list the named oils, or show one: 'lubfric oils show mineral-100'")
    oils.add_argument("show", nargs="?", choices=["show"], help="show one oil over temperature")
    oils.add_argument("name", nargs="?", help="its name")
    return whole


def _add_run(run: argparse.ArgumentParser) -> None:
    _add_scene(run)
    _add_out(run, "out")
    _add_texts(
        run,
        speeds="entrainment speeds in m/s, or with units: '0.001,0.01,0.1', '1 mm/s:10 m/s:13' or 'auto'",
        fields="speeds in m/s whose fields go to fields.npz and contact.png (default: the scene's own speed)",
        ratios="the traction curve instead: slide-roll ratios '0.01,0.1,1' or 'low:high:count'",
    )
    tolerance = "relative standard error of f that a finite rough surface may leave (default: of the scene, 0.02)"
    run.add_argument("--sampling-tolerance", type=float, help=tolerance)
    workers = "processes that share the speeds of a curve (default: 2 where that pays, else 1)"
    run.add_argument("--workers", type=int, help=workers)
    _add_switches(
        run,
        animation="also draw film and pressure of a scene with [transient] as animation.gif",
        accept="keep results outside the range of the model, marked, instead of refusing them",
        report=argparse.SUPPRESS,  # once asked for report.html, which is always written
        vtk="also write the contacts of --fields for ParaView",
    )


def _add_study(study: argparse.ArgumentParser) -> None:
    study.add_argument("study", help="TOML file that says what is varied")
    _add_out(study, "study")
    study.add_argument("--workers", type=int, default=1, help="processes that share the points (default: 1)")
    _add_switches(
        study,
        explain="say points, predicted time and disk, and solve nothing",
        netcdf="also write study.nc (needs the 'study' extra)",
        parquet="also write study.parquet (needs the 'study' extra)",
    )


def _add_fit(fit: argparse.ArgumentParser) -> None:
    _add_scene(fit)
    fit.add_argument("--measured", required=True, help="text file of the measured curve")
    fit.add_argument("--coefficient", required=True, help=F)
    axis = fit.add_mutually_exclusive_group(required=True)
    _add_texts(axis, speed=SPEED, ratio="heading of its column of slide-roll ratios: 'SRR [%%]'")
    _add_texts(fit, deviation="heading of its column of standard deviations")
    sought = "what is sought, between bounds: 'lubricant.viscosity=50 mPa s:1 Pa s' (else SI); again for another"
    fit.add_argument("--parameter", action="append", required=True, metavar="KEY=LOW:HIGH", help=sought)
    fit.add_argument("--without-rolling", action="store_true", help=WITHOUT)
    _add_out(fit, "fit")


def _add_scene(command: argparse.ArgumentParser) -> None:
    command.add_argument("scene", help="TOML file, or a built-in scene: paper, flat")
    for body in ("surface", "counterface"):
        command.add_argument(f"--{body}", metavar="FILE", help=f"height map to use instead of the scene's {body}")


def _add_out(command: argparse.ArgumentParser, folder: str) -> None:
    command.add_argument("--out", type=Path, default=Path(folder), help=f"folder for the results (default: {folder})")


def _add_texts(command, **options: str) -> None:
    for name, about in options.items():
        command.add_argument(f"--{name}", help=about)


def _add_switches(command, **options: str) -> None:
    for name, about in options.items():
        command.add_argument(f"--{name}", action="store_true", help=about)


def _scene(arguments):
    from ..scene import load_scene

    return load_scene(arguments.scene, surface_file=arguments.surface, counterface_file=arguments.counterface)


def _run(arguments) -> None:
    from ..sharing import takes_strips
    from . import run_curve, run_history

    scene = _scene(arguments)
    changed = {} if arguments.sampling_tolerance is None else {"sampling_tolerance": arguments.sampling_tolerance}
    if changed and not takes_strips(scene):
        raise InputError(
            "--sampling-tolerance is for a rough cylinder on strips of its roughness (numerics.sampling = 'strips'), "
            f"and {scene.name} is solved on one patch, as it is; leave it out"
        )
    scene = scene.with_(numerics=changed | ({"accept": True} if arguments.accept else {}))
    what = IN_TIME if scene.transient is not None else RATIOS if arguments.ratios else CURVE
    for option, of in OPTIONS.items():
        if getattr(arguments, option) not in (None, False) and of != what:
            raise InputError(f"--{option} is for {of}, and this is {what}; leave it out")
    solve = {RATIOS: run_curve.run_traction, IN_TIME: run_history.run_history, CURVE: run_curve.run_sweep}[what]
    solve(scene, arguments)


def _info(arguments) -> None:
    from .describe import describe_scene

    put(sys.stdout, describe_scene(_scene(arguments)) + "\n")


def _study(arguments) -> None:
    from .run_study import run_study

    run_study(arguments)


def _fit(arguments) -> None:
    from .run_study import run_fit

    run_fit(_scene(arguments), arguments)


def _plot(arguments) -> None:
    from . import run_curve, run_history

    given = [name for name in ("measured", "speed", "coefficient") if getattr(arguments, name) is not None]
    if given and "measured" not in given:
        raise InputError(f"--{given[0]} names a column of the measured curve; give --measured as well")
    for table, what in (("history.csv", "a run in time"), ("traction.csv", "a traction curve")):
        if given and (arguments.folder / table).is_file():
            raise InputError(f"--measured is drawn beside a Stribeck curve, and {arguments.folder} holds {what}")
    again = run_history if (arguments.folder / "history.csv").is_file() else run_curve
    again.plot_again(arguments)


def _init(arguments) -> None:
    from ..scene import write_template

    write_template(arguments.file)
    say(f"wrote {arguments.file}; 'lubfric info {arguments.file}' says what it means, 'lubfric run' computes it")


def _oils(arguments) -> None:
    from ..oil import list_oils, show_oil

    if arguments.show and not arguments.name:
        raise InputError("lubfric oils show needs a name; 'lubfric oils' lists them")
    put(sys.stdout, (show_oil(arguments.name) if arguments.name else list_oils()) + "\n")
