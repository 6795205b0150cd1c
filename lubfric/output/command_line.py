"""The ``lubfric`` command: run, info, study, fit, plot, init, oils."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from .._base import __version__
from ..errors import ConvergenceError, LubfricError
from .console import INTERRUPTED, Interrupted, interruptible, put, say

CURVE, RATIOS, IN_TIME = "a Stribeck curve", "a traction curve (--ratios)", "a scene with [transient]"
OPTIONS = {"ratios": RATIOS, "animation": IN_TIME}  # of ``lubfric run``, and what they are for
OPTIONS |= dict.fromkeys(("speeds", "fields", "workers", "report", "vtk"), CURVE)


def main(argv=None) -> int:
    """Entry point; returns the exit code: 0 done, 1 a solve failed, 2 bad input or a file that cannot
    be written, 130 interrupted, 143 terminated."""
    arguments = _parser().parse_args(argv)
    try:
        with interruptible():
            return arguments.command(arguments)
    except ConvergenceError as error:
        say(f"lubfric: {error}")
        return 1
    except LubfricError as error:
        say(f"lubfric: {error}")
        return 2
    except OSError as error:  # a folder that cannot be written, a disk that is full
        say(f"lubfric: {error}")
        return 2
    except Interrupted as error:
        say(f"lubfric: {error}")
        return error.code
    except KeyboardInterrupt:
        say("lubfric: interrupted")
        return INTERRUPTED


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="lubfric", description="Friction of mixed-lubricated rough line contacts.")
    parser.add_argument("--version", action="version", version=f"lubfric {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    run = commands.add_parser("run", help="compute the Stribeck curve of a scene and write it to a folder")
    run.add_argument("scene", help="TOML file, or a built-in scene: paper, flat")
    run.add_argument("--out", type=Path, default=Path("out"), help="folder for the results (default: out)")
    run.add_argument("--speeds", help="entrainment speeds in m/s: '0.001,0.01,0.1', 'low:high:count' or 'auto'")
    run.add_argument(
        "--fields", help="speeds in m/s whose fields go to fields.npz and contact.png (default: the scene's own speed)"
    )
    run.add_argument("--ratios", help="the traction curve instead: slide-roll ratios '0.01,0.1,1' or 'low:high:count'")
    _add_maps(run)
    run.add_argument(
        "--sampling-tolerance",
        type=float,
        help="relative standard error of f that a finite rough surface may leave (default: of the scene, 0.02)",
    )
    run.add_argument(
        "--animation",
        action="store_true",
        help="also draw film and pressure of a scene with [transient] as animation.gif",
    )
    run.add_argument(
        "--accept",
        action="store_true",
        help="keep results outside the range of the model, marked, instead of refusing them",
    )
    run.add_argument(
        "--workers", type=int, help="processes that share the speeds of a curve (default: 2 where that pays, else 1)"
    )
    run.add_argument("--report", action="store_true", help="also write report.html, one page that needs nothing else")
    run.add_argument("--vtk", action="store_true", help="also write the contacts of --fields for ParaView")
    run.set_defaults(command=_run)
    info = commands.add_parser("info", help="say what a scene is and what will be solved, without solving it")
    info.add_argument("scene")
    _add_maps(info)
    info.set_defaults(command=_info)
    study = commands.add_parser("study", help="vary anything in a scene: many points, kept as they end")
    study.add_argument("study", help="TOML file that says what is varied")
    study.add_argument("--out", type=Path, default=Path("study"), help="folder of the study (default: study)")
    study.add_argument("--workers", type=int, default=1, help="processes that share the points (default: 1)")
    study.add_argument("--explain", action="store_true", help="say points, predicted time and disk, and solve nothing")
    study.add_argument("--netcdf", action="store_true", help="also write study.nc (needs the 'study' extra)")
    study.add_argument("--parquet", action="store_true", help="also write study.parquet (needs the 'study' extra)")
    study.set_defaults(command=_study)
    _add_fit(commands)
    _add_plot(commands)
    init = commands.add_parser("init", help="write a commented scene to start from")
    init.add_argument("file", type=Path, nargs="?", default=Path("scene.toml"), help="(default: scene.toml)")
    init.set_defaults(command=_init)
    oils = commands.add_parser("oils", help="list the named oils, or show one: 'lubfric oils show mineral-100'")
    oils.add_argument("show", nargs="?", choices=["show"], help="show one oil over temperature")
    oils.add_argument("name", nargs="?", help="its name")
    oils.set_defaults(command=_oils)
    return parser


def _add_fit(commands) -> None:
    fit = commands.add_parser("fit", help="find numbers of a scene from a measured curve")
    fit.add_argument("scene", help="TOML file, or a built-in scene: paper, flat")
    fit.add_argument("--measured", required=True, help="text file of the measured curve")
    fit.add_argument("--coefficient", required=True, help="heading of its column of friction coefficients")
    axis = fit.add_mutually_exclusive_group(required=True)
    axis.add_argument("--speed", help="heading of its column of entrainment speeds, with the unit: 'U [mm/s]'")
    axis.add_argument("--ratio", help="heading of its column of slide-roll ratios: 'SRR [%%]'")
    fit.add_argument("--deviation", help="heading of its column of standard deviations")
    fit.add_argument(
        "--parameter",
        action="append",
        required=True,
        metavar="KEY=LOW:HIGH",
        help="what is sought, between bounds in SI units: 'lubricant.viscosity=0.05:1'; again for another",
    )
    _add_maps(fit)
    fit.add_argument("--out", type=Path, default=Path("fit"), help="folder for the results (default: fit)")
    fit.set_defaults(command=_fit)


def _add_plot(commands) -> None:
    plot = commands.add_parser("plot", help="draw stribeck.png, traction.png or history.png again from its table")
    plot.add_argument("folder", type=Path, help="folder written by 'lubfric run'")
    plot.add_argument("--measured", help="text file of a measured curve to draw among the computed one")
    plot.add_argument("--speed", help="heading of its column of entrainment speeds, with the unit: 'U [mm/s]'")
    plot.add_argument("--coefficient", help="heading of its column of friction coefficients")
    plot.set_defaults(command=_plot)


def _init(arguments) -> int:
    from ..scene import write_template

    write_template(arguments.file)
    say(f"wrote {arguments.file}; 'lubfric info {arguments.file}' says what it means, 'lubfric run' computes it")
    return 0


def _add_maps(command: argparse.ArgumentParser) -> None:
    for body in ("surface", "counterface"):
        command.add_argument(f"--{body}", metavar="FILE", help=f"height map to use instead of the scene's {body}")


def _oils(arguments) -> int:
    from ..errors import InputError
    from ..oil import list_oils, show_oil

    if arguments.show and not arguments.name:
        raise InputError("lubfric oils show needs a name; 'lubfric oils' lists them")
    put(sys.stdout, (show_oil(arguments.name) if arguments.name else list_oils()) + "\n")
    return 0


def _run(arguments) -> int:
    from ..scene import load_scene

    scene = load_scene(arguments.scene, surface_file=arguments.surface, counterface_file=arguments.counterface)
    if arguments.sampling_tolerance is not None:
        _check_line(scene)
        scene = scene.with_(numerics={"sampling_tolerance": arguments.sampling_tolerance})
    if arguments.accept:
        scene = scene.with_(numerics={"accept": True})
    _check_options(arguments, in_time=scene.transient is not None)
    if arguments.ratios:
        from .run_traction import run_traction

        return run_traction(scene, arguments.out, arguments.ratios)
    if scene.transient is not None:
        from .run_history import run_history

        return run_history(scene, arguments.out, arguments.animation)
    from .run_sweep import Extras, run_sweep

    more = Extras(arguments.report, arguments.vtk, arguments.workers)
    return run_sweep(scene, arguments.out, arguments.speeds, arguments.fields, more)


def _check_line(scene) -> None:
    """Raise `InputError` for ``--sampling-tolerance`` on a scene that is not solved on a line."""
    from ..errors import InputError
    from ..sharing import takes_line

    if not takes_line(scene):
        raise InputError(
            "--sampling-tolerance is for a rough cylinder on a line of its roughness (numerics.sampling = 'line'), and "
            f"{scene.name} is solved on one patch, as it is; leave it out"
        )


def _check_options(arguments, in_time: bool) -> None:
    """Raise `InputError` for options of ``lubfric run`` that what it computes has no use for."""
    from ..errors import InputError

    what = IN_TIME if in_time else RATIOS if arguments.ratios else CURVE
    for option, of in OPTIONS.items():
        if getattr(arguments, option) not in (None, False) and of != what:
            raise InputError(f"--{option} is for {of}, and this is {what}; leave it out")


def _study(arguments) -> int:
    from .run_study import run_study

    return run_study(arguments)


def _fit(arguments) -> int:
    from .run_fit import run_fit

    return run_fit(arguments)


def _info(arguments) -> int:
    from ..scene import load_scene
    from .describe import describe_scene

    scene = load_scene(arguments.scene, surface_file=arguments.surface, counterface_file=arguments.counterface)
    put(sys.stdout, describe_scene(scene) + "\n")
    return 0


def _plot(arguments) -> int:
    from .._base import plot_stribeck, read_table, whole_file
    from ..errors import InputError
    from ..sharing import Validity
    from .run_history import plot_again
    from .run_traction import plot_again as plot_traction_again

    given = [name for name in ("measured", "speed", "coefficient") if getattr(arguments, name) is not None]
    if given and "measured" not in given:
        raise InputError(f"--{given[0]} names a column of the measured curve; give --measured as well")
    for table, what in (("history.csv", "a run in time"), ("traction.csv", "a traction curve")):
        if given and (arguments.folder / table).is_file():
            raise InputError(f"--measured is drawn beside a Stribeck curve, and {arguments.folder} holds {what}")
    if plot_again(arguments.folder) or plot_traction_again(arguments.folder):
        return 0
    source = arguments.folder / "stribeck.csv"
    for needed in (source, arguments.folder / "result.json"):
        if not needed.is_file():
            raise InputError(f"{arguments.folder} holds no {needed.name}; give a folder that 'lubfric run' wrote")
    record = arguments.folder / "result.json"
    try:
        found = json.loads(record.read_text(encoding="utf-8"))
        name, told = found["scene"]["name"], [[Validity(**e) for e in p.get("validity", ())] for p in found["points"]]
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as problem:
        raise InputError(f"{record} is torn, or no record of a run ({problem})") from None
    measured, columns = _measured(arguments), read_table(source)
    if len(columns["speed"]) != len(told):
        raise InputError(
            f"{source} has {len(columns['speed'])} speeds and {record} {len(told)}; run 'lubfric run' again"
        )
    with whole_file(arguments.folder / "stribeck.png") as part:
        plot_stribeck(part, columns, str(name), told, measured)
    return 0


def _measured(arguments):
    """The measured curve of ``lubfric plot --measured``, or None."""
    from ..errors import InputError
    from ..studies import read_measured

    if arguments.measured is None:
        return None
    if arguments.speed is None or arguments.coefficient is None:
        raise InputError("--measured needs --speed and --coefficient, the headings of its columns")
    return read_measured(arguments.measured, coefficient=arguments.coefficient, speed=arguments.speed)
