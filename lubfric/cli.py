"""The ``lubfric`` command: run, info, plot, oils."""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

from .console import INTERRUPTED, Interrupted, interruptible, say
from .errors import ConvergenceError, LubfricError, ValidityError

MOST_SPEEDS = 100_000
OUTPUTS = ("result.json", "stribeck.csv", "stribeck.png", "fields.npz", "contact.png")


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
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    run = commands.add_parser("run", help="compute the Stribeck curve of a scene and write it to a folder")
    run.add_argument("scene", help="TOML file, or a built-in scene: paper, flat")
    run.add_argument("--out", type=Path, default=Path("out"), help="folder for the results (default: out)")
    run.add_argument("--speeds", help="entrainment speeds in m/s: '0.001,0.01,0.1' or 'low:high:count'")
    run.add_argument(
        "--fields", help="speeds in m/s whose fields go to fields.npz and contact.png (default: the scene's own speed)"
    )
    _add_maps(run)
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
    plot = commands.add_parser("plot", help="draw stribeck.png or history.png again from its table")
    plot.add_argument("folder", type=Path, help="folder written by 'lubfric run'")
    plot.set_defaults(command=_plot)
    oils = commands.add_parser("oils", help="list the named oils, or show one: 'lubfric oils show mineral-100'")
    oils.add_argument("show", nargs="?", choices=["show"], help="show one oil over temperature")
    oils.add_argument("name", nargs="?", help="its name")
    oils.set_defaults(command=_oils)
    return parser


def _add_maps(command: argparse.ArgumentParser) -> None:
    for body in ("surface", "counterface"):
        command.add_argument(f"--{body}", metavar="FILE", help=f"height map to use instead of the scene's {body}")


def _oils(arguments) -> int:
    from .errors import InputError
    from .oil.describe import list_oils, show_oil

    if arguments.show and not arguments.name:
        raise InputError("lubfric oils show needs a name; 'lubfric oils' lists them")
    print(show_oil(arguments.name) if arguments.name else list_oils())
    return 0


def _run(arguments) -> int:
    from .model import prepare
    from .output import read_csv, write_csv, write_fields, write_json
    from .plot import plot_contact, plot_stribeck
    from .scene_file import load_scene
    from .sweep import stribeck

    scene = load_scene(arguments.scene, surface_file=arguments.surface, counterface_file=arguments.counterface)
    if arguments.accept:
        scene = scene.with_(numerics={"accept": True})
    if scene.transient is not None:
        from .unsteady.command import run_history

        return run_history(scene, arguments.out, arguments.animation, say)
    speeds = _speeds("--speeds", arguments.speeds) or list(scene.motion.speeds) or [scene.motion.entrainment_speed]
    chosen = _speeds("--fields", arguments.fields) or [scene.motion.entrainment_speed]
    speeds, chosen = _with_chosen(speeds, chosen)
    out = _folder(arguments.out)
    begun = time.perf_counter()
    say(f"{scene.name}: preparing the height map and the contact")
    model = prepare(scene)
    say(model.surface.describe())
    curve = stribeck(model, speeds, fields=chosen, on_point=_progress, raise_on_failure=False)
    write_csv(out / "stribeck.csv", curve)
    write_json(out / "result.json", model, curve, time.perf_counter() - begun)
    written = ["result.json", "stribeck.csv"]
    if len(curve.errors) < curve.speed.size:
        plot_stribeck(out / "stribeck.png", read_csv(out / "stribeck.csv"), scene.name)
        written.append("stribeck.png")
    points = [p for p in curve.points if p is not None and p.balance is not None]
    if points:
        points.sort(key=lambda p: chosen.index(p.speed))
        write_fields(out / "fields.npz", model, points)
        plot_contact(out / "contact.png", model, points[0])
        written += ["fields.npz", "contact.png"]
    for text in curve.validity:
        say(text)
    if scene.numerics.accept and any(e.severe for i in range(curve.speed.size) for e in curve.entries(i)):
        say("accepted although outside the range of the model: these coefficients are marked, and are no answers")
    say(f"wrote {', '.join(sorted(written))} to {out} in {time.perf_counter() - begun:.1f} s")
    if curve.errors:
        failed = sum(not isinstance(error, ValidityError) for error in curve.errors.values())
        counts = [f"{failed} of {curve.speed.size} speeds failed"] if failed else []
        if len(curve.errors) > failed:
            counts.append(
                f"{len(curve.errors) - failed} of {curve.speed.size} speeds refused (--accept keeps them, marked)"
            )
        first = curve.errors[min(curve.errors)]
        raise ConvergenceError(f"{', '.join(counts)}; first: {first}", curve.report)
    return 0


def _study(arguments) -> int:
    from .studies.command import run_study

    return run_study(arguments)


def _info(arguments) -> int:
    from .describe import describe_scene
    from .scene_file import load_scene

    print(
        describe_scene(
            load_scene(arguments.scene, surface_file=arguments.surface, counterface_file=arguments.counterface)
        )
    )
    return 0


def _plot(arguments) -> int:
    from .errors import InputError
    from .output import read_csv
    from .plot import plot_stribeck
    from .unsteady.command import plot_again

    if plot_again(arguments.folder):
        return 0
    source = arguments.folder / "stribeck.csv"
    for needed in (source, arguments.folder / "result.json"):
        if not needed.is_file():
            raise InputError(f"{arguments.folder} holds no {needed.name}; allowed: a folder written by 'lubfric run'")
    record = arguments.folder / "result.json"
    try:
        name = json.loads(record.read_text(encoding="utf-8"))["scene"]["name"]
    except (ValueError, KeyError, TypeError, RecursionError) as problem:
        raise InputError(f"{record} is torn, or no record of a run ({problem})") from None
    plot_stribeck(arguments.folder / "stribeck.png", read_csv(source), str(name))
    return 0


def _speeds(option: str, text: str | None) -> list[float]:
    """'a,b,c' or 'low:high:count' (geometric), in m/s."""
    import numpy as np

    from .errors import InputError
    from .validate import number, shown

    if text is None:
        return []
    ways = f"{option} {shown(text)}; allowed: '0.001,0.01' or 'low:high:count' with 0 < low < high, 1 <= count, in m/s"
    try:
        words = [float(word) for word in text.replace(":", ",").split(",")]
        for speed in words[: 2 if ":" in text else None]:
            number(option, speed, "m/s", minimum=-1e6, maximum=1e6)
        if ":" not in text:
            return words
        low, high, count = words
        if "," in text or not (0 < low < high and 1 <= count <= MOST_SPEEDS and count == int(count)):
            raise InputError(ways)
    except ValueError:
        raise InputError(ways) from None
    return [float(u) for u in np.geomspace(low, high, int(count))]


def _with_chosen(speeds, chosen):
    """Speeds with the chosen ones among them, and the chosen ones as they stand in there."""
    import math

    own = []
    for speed in chosen:
        near = [u for u in speeds if math.isclose(u, speed, rel_tol=1e-9)]
        own.append(near[0] if near else speed)
        speeds = speeds if near else [*speeds, speed]
    return speeds, own


def _folder(path: Path) -> Path:
    """An existing folder without results of an earlier run."""
    from .errors import InputError

    if path.exists() and not path.is_dir():
        raise InputError(f"--out {path} is a file; allowed: a folder, existing or not")
    path.mkdir(parents=True, exist_ok=True)
    for name in OUTPUTS:
        (path / name).unlink(missing_ok=True)
    return path


def _progress(done, total, speed, outcome) -> None:
    if isinstance(outcome, Exception):
        say(
            f"[{done}/{total}] U = {speed:.4g} m/s {'refused' if isinstance(outcome, ValidityError) else 'failed'}: {outcome}"
        )
    else:
        say(
            f"[{done}/{total}] U = {speed:.4g} m/s: f = {outcome.coefficient:.5g}, "
            f"F_C = {outcome.contact_load:.4g} N, F_H = {outcome.film_load:.4g} N ({outcome.seconds:.2f} s)"
        )
