"""``lubfric run-in``: the surface of a scene after running-in, as a map, a scene that takes it, a table and a
report."""

import io
import json
import tempfile
import time
from argparse import Namespace
from collections.abc import Callable
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from .._base import __version__, figures, plain, table_bytes, write_whole
from ..errors import InputError, OutputError
from ..models.shared import percent_or_less
from ..running_in import RECORDED, RunIn, estimated_run_in, run_in
from ..scene import Scene
from ..studies import WITHIN_WORDS, in_words
from ..units import converted, number_of, plain_number, printed, unit_for, with_interval, worded
from .command_line import scene_of
from .commands import CommandStart, RunFolder, check_outputs, keeping, paced, references, run_folder, say
from .inputs import INPUT_SECTIONS, inputs
from .markup import number_cells, picture, row_with_key, table
from .methods import methods_to_quote
from .page import framed
from .progress import ProgressLine
from .run_files import BIBTEX_FILE

# Files of the folder; the last says that the others are complete.
FOLDER_FILES = ("surface.npy", "run_in.csv", "run_in.png", "scene.toml", "report.html", BIBTEX_FILE, "run_in.json")


def run_in_scene(arguments: Namespace) -> None:
    """Run in the surface of a scene, and write `FOLDER_FILES` to ``arguments.out``."""
    scene = scene_of(arguments)
    distance = number_of("--distance", arguments.distance, "m")
    coefficient = number_of("--wear-coefficient", arguments.wear_coefficient, "-")
    if (distance > 0) != (coefficient > 0):
        given, missing = ("--distance", "--wear-coefficient") if distance > 0 else ("--wear-coefficient", "--distance")
        raise InputError(
            f"{given} is for wear, which needs {missing} as well", recommendation=f"give {missing}, or neither"
        )
    check_outputs(arguments, arguments.out, FOLDER_FILES)
    begun = CommandStart.now()
    with run_folder(arguments.out, begun) as folder:  # one that cannot be written to is refused before any work
        seconds = estimated_run_in(scene, distance=distance, wear_coefficient=coefficient)
        say(f"{scene.name}: running-in of its surface, about {in_words(seconds)} of processor time ({WITHIN_WORDS})")
        with ProgressLine("parts") as shown, keeping(lambda: ""):
            result = run_in(
                scene,
                passes=arguments.passes,
                distance=distance,
                wear_coefficient=coefficient,
                on_progress=_progress(shown),
            )
        answer = answer_lines(result)
        for line in answer:
            say(line)
        folder.add("surface.npy", _npy, result.surface.heights)
        folder.add("run_in.csv", lambda: table_bytes(result.columns()))
        folder.draw("run_in.png", draw_run_in, result, figures.plain_words(scene.name))
        folder.add("scene.toml", lambda: scene_after(scene, result).encode())
        folder.add("report.html", _page, scene, result, answer, folder.contents)
        folder.add(BIBTEX_FILE, references, result)
        folder.add("run_in.json", lambda: json.dumps(plain(_record(scene, result, folder.contents)), indent=1).encode())
        _put(folder)
    say(f"lubfric run {Path(arguments.out) / 'scene.toml'} computes the friction of the surface after running-in")


def _put(folder: RunFolder) -> None:
    """Put the files in the ``folder``; where that fails, in a temporary folder, because nothing else holds them."""
    try:
        folder.put()
    except (OutputError, OSError) as error:
        rescued = Path(tempfile.mkdtemp(prefix="lubfric-run-in-"))
        for name, content in folder.contents.items():
            write_whole(rescued / name, content)
        raise OutputError(f"{error}; the results are in {rescued}") from error


def answer_lines(result: RunIn) -> list[str]:
    """Return what the running-in changed, in sentences."""
    before = result.before
    after = result.surface
    span = ""
    if result.ends:
        span = f" ({' to '.join(worded(surface.sq, 'm') for surface in result.ends)} by the range of the hardness)"
    first, last = (worded(surface.sq, "m") for surface in (before, after))
    lines = [f"Sq stays {first}{span}." if first == last else f"Sq changes from {first} to {last}{span}."]
    passes = result.deepest.size
    dented = np.count_nonzero(result.dents) / result.dents.size
    if result.shaken_down and not dented:
        lines.append("No asperity yields.")
    elif result.shaken_down:
        lines.append(
            f"The asperities yield on {percent_or_less(dented)} of the map, and no further after {passes} "
            f"{'pass' if passes == 1 else 'passes'}."
        )
    else:
        lines.append(
            f"The asperities still yield, by {worded(float(result.deepest[-1]), 'm')}, in pass {passes}. Give more "
            "--passes."
        )
    wear = result.wear
    if wear is not None:
        depth = worded(float(wear.depth[-1]), "m")
        lines.append(f"Wear removes {depth} on average over {worded(float(wear.distance[-1]), 'm')}; {wear.stopped}.")
        for name, values, intervals, unit in (
            ("The friction coefficient at the speed of the scene", wear.coefficient, wear.interval, "-"),
            ("The lift-off speed", wear.lift_off_speed, wear.lift_off_interval, "m/s"),
        ):
            ends = [with_interval(values[i], intervals[i][0], intervals[i][1], unit=unit) for i in (0, -1)]
            unknown = "" if np.isfinite(intervals).any() else " (intervals not known)"
            lines.append(f"{name} changes from {ends[0]} to {ends[1]}{unknown}.")
        lines += [f"Note: {note}." for note in wear.notes]
    return lines


@figures.styled
def draw_run_in(path: Path, result: RunIn, title: str) -> None:
    """Draw the bearing curves before and after; beside them, with wear, what changes over the distance."""
    count = 1 if result.wear is None else 2
    figure = figures.new_figure(figsize=(4.6 * count, 4.2))
    axes = figure.subplots(1, count, squeeze=False)[0]
    result.plot(axes[0])
    if result.wear is not None:
        result.wear.plot(axes[1])
    figure.suptitle(title)
    figure.savefig(path)


def scene_after(scene: Scene, result: RunIn) -> str:
    """Return the scene file of ``scene`` with the map after running-in, the file surface.npy beside it."""
    lines: list[str] = []
    section = ""
    for line in scene.to_toml().splitlines():
        section = line.strip("[]") if line.startswith("[") else section
        is_old = section == "surface" and not line.startswith("[")
        is_grid = section == "contact" and line.partition(" ")[0] in ("shape", "spacing")
        if not is_old and not is_grid:
            lines.append(line)
        if line == "[surface]":
            dx, dy = result.surface.spacing
            lines += ['file = "surface.npy"', f"spacing = [{dx!r}, {dy!r}]", 'unit = "m"', 'outliers = "keep"', ""]
    return "\n".join(lines) + "\n"


def _progress(shown: ProgressLine) -> Callable[[str, int, int], None]:
    due = paced()
    begun = time.perf_counter()

    def on_progress(what: str, done: int, total: int) -> None:
        shown.update(done, total)
        if what == RECORDED:
            left = (time.perf_counter() - begun) * (total - done) / done
            say(f"{what}: {done} of {total}" + (f", about {in_words(left)} left" if done < total else ""))
        elif due(end=done == total):
            say(f"wear: {done} %" if what == "wear" else f"{what}: {done} of at most {total}")

    return on_progress


def _npy(heights: np.ndarray) -> bytes:
    file = io.BytesIO()
    np.save(file, heights)
    return file.getvalue()


def _record(scene: Scene, result: RunIn, contents: dict[str, bytes]) -> dict[str, Any]:
    """Return what run_in.json holds; ``contents``: the other files, by name."""
    return {
        "version": __version__,
        "scene": scene.to_toml(),
        "spacing": result.surface.spacing,
        "notes": result.surface.notes,
        "passes": {"deepest": result.deepest, "sinking": result.sinking, "shaken_down": result.shaken_down},
        "table": result.columns(),
        "files": sorted([*contents, FOLDER_FILES[-1]]),
    }


def _page(scene: Scene, result: RunIn, answer: list[str], contents: dict[str, bytes]) -> bytes:
    """Return report.html."""
    values = [
        f"<h3>{section}</h3>"
        + table(
            ["quantity", "value", "key"],
            [row_with_key(label, text + note, key) for label, text, key, note in inputs(scene, section)],
        )
        for section in INPUT_SECTIONS
        if list(inputs(scene, section))
    ]
    drawn = contents.get("run_in.png")
    pictures = [picture(drawn, "Bearing curves before and after running-in")] if drawn else []
    return framed(
        "run_in_report.html",
        "running-in of the surface",
        f"{time.strftime('%Y-%m-%d %H:%M:%S UTC', time.gmtime())}, lubfric {__version__}",
        dict(
            name=escape(scene.name),
            version=__version__,
            kind="" if result.shaken_down else "failed",
            status="Converged: no asperity yields any more."
            if result.shaken_down
            else "Not complete: asperities still yield.",
            answer="".join(
                f'<p class="{"answer" if i == 0 else ""}">{escape(line)}</p>' for i, line in enumerate(answer)
            ),
            pictures="".join(pictures),
            table=_table(result),
            inputs="".join(values),
            methods=methods_to_quote((), result),
        ),
    )


def _table(result: RunIn) -> str:
    """Return the table of the page: the parameters of the maps, each length in one unit, and with wear what changes
    over the distance."""
    columns = result.columns()
    wear = result.wear
    states = [*columns["state"][:2]]
    heads = ["surface"]
    cells = [[*states, *([] if wear is None else [f"after {worded(float(s), 'm')} of wear" for s in wear.distance])]]
    for name in ("sq", "sk", "spk", "svk"):
        values = np.asarray(columns[f"{name} [m]"], float)
        unit = unit_for(values.tolist(), "m")
        heads.append(f"{name.capitalize()} [{printed(unit)}]")
        cells.append([plain_number(float(value)) for value in converted(values, "m", unit)])
    if wear is not None:
        nothing = [""] * len(states)
        heads += ["mean depth of wear", "asperity load ratio F_C/F_T", "f", "lift-off speed"]
        cells.append([*nothing, *(worded(float(depth), "m") for depth in wear.depth)])
        cells.append([*nothing, *(plain_number(float(ratio)) for ratio in wear.asperity_load_ratio)])
        for values, intervals, unit in (
            (wear.coefficient, wear.interval, "-"),
            (wear.lift_off_speed, wear.lift_off_interval, "m/s"),
        ):
            shown = [
                with_interval(float(v), float(ends[0]), float(ends[1]), "", unit) for v, ends in zip(values, intervals)
            ]
            cells.append([*nothing, *shown])
    rows = [number_cells(row) for row in zip(*cells)]
    return table(heads, rows)
