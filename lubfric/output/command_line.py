"""The ``lubfric`` command. What one of the commands in commands.toml needs is imported when it runs."""

from __future__ import annotations

import argparse
from argparse import Namespace
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._base import __version__, check_address_space, packaged
from ..errors import ConvergenceError, InputError, LubfricError
from ..units import number_of
from .commands import INTERRUPTED, answer, interruptible, say

if TYPE_CHECKING:
    from ..scene import Scene


OF_CURVES = "a Stribeck curve"
OF_TRACTION = "a traction curve (--ratios)"
OF_RUNS_IN_TIME = "a scene with [transient]"
FOR = {"ratios": (OF_TRACTION,), "animation": (OF_RUNS_IN_TIME,), "workers": (OF_CURVES, OF_TRACTION)} | dict.fromkeys(
    ("speeds", "fields", "vtk"), (OF_CURVES,)
)


def _path(text: str) -> Path:
    """Return the path that an argument names, with the home directory for a "~". An empty name is refused: it would be
    the current folder."""
    if not text.strip():
        raise argparse.ArgumentTypeError(
            "the name is empty; give the name of a file or folder ('.': the current folder)"
        )
    try:
        return Path(text).expanduser()
    except RuntimeError:  # no such user
        raise argparse.ArgumentTypeError(
            f"{text!r} names the home directory of an unknown user; write it out"
        ) from None


ARGUMENT_KINDS: dict[str, dict[str, Any]] = {
    "path": {"type": _path},
    "count": {"type": int},
    "switch": {"action": "store_true"},
}


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command and return the exit code: 0 done, 1 a solve failed, 2 bad input or a file that cannot be written,
    130 interrupted, 143 terminated."""
    arguments = parser().parse_args(argv)
    try:
        with interruptible():
            check_address_space()
            module, _, function = arguments.call.partition(".")
            getattr(import_module(f".{module}", __package__), function)(arguments)
            return 0
    except (LubfricError, OSError) as error:  # OSError: a folder that cannot be written, a disk that is full
        say(f"lubfric: {error}")
        return 1 if isinstance(error, ConvergenceError) else 2
    except MemoryError as error:
        needed = str(error) or "more than this process may use"
        say(f"lubfric: not enough memory: it needs {needed}; allow more, or give a smaller map or fewer cells")
        return 1
    except KeyboardInterrupt as error:
        message, code = error.args if len(error.args) == 2 else ("interrupted", INTERRUPTED)
        say(f"lubfric: {message}")
        return code


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command. What it returns has ``call``, the module and the function to call."""
    lubfric_parser = argparse.ArgumentParser(
        prog="lubfric", description="Friction of mixed-lubricated rough line contacts."
    )
    lubfric_parser.add_argument("--version", action="version", version=f"lubfric {__version__}")
    commands = lubfric_parser.add_subparsers(required=True, metavar="COMMAND")
    table = packaged(__package__, "commands.toml")
    for name, row in table.items():
        if name != "groups":
            command = commands.add_parser(name, help=row["about"])
            command.set_defaults(call=row["call"])
            groups = [table["groups"][group] for group in row.get("with", ())]
            for argument, options in (pair for part in (*groups, row.get("arguments", {})) for pair in part.items()):
                kind = ARGUMENT_KINDS.get(options.get("kind"), {})
                given = {key: value for key, value in options.items() if key != "kind"}
                given |= {} if given.get("help") else {"help": argparse.SUPPRESS}
                command.add_argument(argument, **kind | given)
    return lubfric_parser


def scene_of(arguments: Namespace) -> Scene:
    """Return the scene that the ``arguments`` name."""
    from ..scene import load_scene

    return load_scene(arguments.scene, surface_file=arguments.surface, counterface_file=arguments.counterface)


def run(arguments: Namespace) -> None:
    """Compute a curve or a run in time, and write it to a folder."""
    from ..samples import takes_strips
    from . import run_curve, run_history

    scene = scene_of(arguments)
    _take_options_of_file(arguments)
    requested = arguments.sampling_tolerance
    changed = {} if requested is None else {"sampling_tolerance": number_of("--sampling-tolerance", requested, "-")}
    if changed and not takes_strips(scene):
        raise InputError(
            "--sampling-tolerance is for a rough cylinder on strips of its roughness (numerics.sampling = 'strips'), "
            f"and {scene.name} is solved on one patch; omit the option"
        )
    scene = scene.with_(numerics=changed | ({"accept": True} if arguments.accept else {}))
    what = OF_TRACTION if arguments.ratios else OF_CURVES
    if scene.transient is not None:
        what = OF_RUNS_IN_TIME
    for option, of in FOR.items():
        is_default = getattr(arguments, option) in ((None, 1) if option == "workers" else (None, False))
        if not is_default and what not in of:
            raise InputError(f"--{option} is for {' or '.join(of)}, and this is {what}; omit it")
    if what == OF_RUNS_IN_TIME and arguments.measured is not None:
        raise InputError(f"--measured is drawn with a curve, and this is {what}; omit it")
    solve = {
        OF_TRACTION: run_curve.run_traction,
        OF_RUNS_IN_TIME: run_history.run_history,
        OF_CURVES: run_curve.run_sweep,
    }[what]
    solve(scene, arguments)


def _take_options_of_file(arguments: Namespace) -> None:
    """Give ``arguments`` the options that the scene file holds, as resolved.toml of a traction run does, unless the
    command has one of these itself. A line on stderr says so."""
    from ..scene import options_of

    options = options_of(arguments.scene)
    if not options:
        return
    words = " ".join(f"--{name}={value}" for name, value in options.items())
    given = [name for name in ("ratios", "speeds", "fields") if getattr(arguments, name) is not None]
    if given:
        say(f"{arguments.scene} contains {words}; --{given[0]} of the command replaces them")
        return
    say(f"options of {arguments.scene}: {words}")
    for name, value in options.items():
        setattr(arguments, name, value)


def info(arguments: Namespace) -> None:
    """Say what a scene is. Then raise what 'lubfric run' would, where it is certain to refuse the scene."""
    from ..models.shared import refused, violations_by_unusual_inputs
    from .describe import described_scene
    from .swept_values import parse_ratios, parse_speeds

    scene = scene_of(arguments)
    speeds = arguments.speeds
    for option in ("speeds", "ratios"):
        if getattr(arguments, option) is not None and scene.transient is not None:
            raise InputError(f"--{option} is for a curve, and this is a scene with [transient]; omit it")
    if speeds is not None and arguments.ratios is not None:
        raise InputError("--ratios is for a traction curve, and --speeds for a Stribeck curve; omit one of them")
    chosen = speeds if speeds == "auto" else parse_speeds("--speeds", speeds)
    ratios = parse_ratios(arguments.ratios)
    (description, estimate) = described_scene(scene, chosen, ratios, measures=True)
    answer(description + "\n")
    refused(violations_by_unusual_inputs(scene), accept=scene.numerics.accept)
    if scene.transient is not None:
        refused(estimate.severe, accept=scene.numerics.accept)
    elif estimate.severe and not scene.numerics.accept:
        raise ConvergenceError(
            f"'lubfric run' would refuse a result (--accept keeps it, marked): {estimate.severe[0].text}"
        )


def init(arguments: Namespace) -> None:
    """Write a scene to start from."""
    from ..scene import write_template

    write_template(arguments.file)
    name = arguments.file
    say(f"wrote {name}; 'lubfric info {name}' shows what will be solved, 'lubfric run {name}' computes the friction")


def oils(_: Namespace) -> None:
    """List the named oils."""
    from ..oil import list_oils

    answer(list_oils() + "\n")
