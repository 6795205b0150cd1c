"""What a report says of its methods: the contact and the oil in a line, a paragraph to quote, what was solved, and by
which versions."""

from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

from ..models.shared import Prepared, sentence
from ..scene import Scene
from ..studies import CurveResult
from ..time import TransientResult
from ..units import plain_number, worded
from .describe import TABLE_CAPTION, SceneEstimate
from .inputs import over_the_run
from .markup import KEY, Cell, bullets, number_cells, table
from .operating_point import nearest_solved


def scene_in_words(scene: Scene) -> str:
    """Return the contact and the oil of a scene in a line."""
    bodies = scene.bodies
    oil = scene.lubricant
    warm = "" if oil.temperature is None else f" at {oil.temperature - 273.15:.4g} °C"
    radius = over_the_run(scene, "radius", bodies.radius, "m")
    load = over_the_run(scene, "load", bodies.load, "N")
    viscosity = over_the_run(scene, "viscosity", oil.viscosity, "Pa s")
    return (
        f"Line contact of reduced radius {radius} and length {worded(bodies.width, 'm')} under {load}, in an oil of "
        f"{viscosity}{warm}"
    )


def methods_to_quote(facts: Sequence[str], result: Any) -> str:
    """Return a paragraph about the inputs and the methods of a ``result`` (`cite`), which a reader may quote; the
    ``facts`` of its scene where nothing was solved."""
    text = result.cite("methods") or " ".join(map(sentence, facts))
    return f'<p class="small">Methods, to quote:</p><blockquote>{escape(text)}</blockquote>' if text else ""


def method_lists(prepared: Prepared, result: CurveResult | TransientResult, estimate: SceneEstimate) -> str:
    """Return what was solved and on which surface; and, folded, what was estimated before."""
    planned = [text for name in ("contact", "model") for text in estimate.sections[name]]
    lines = estimate.sections["transient"]
    nearest = nearest_solved(prepared.scene, result) if isinstance(result, CurveResult) else None
    if nearest is not None:
        (point, place) = nearest
        lines = [f"{place}: {part}" for part in point.decision.parts]
    elif isinstance(result, TransientResult):
        lines = [*lines, *planned]
        planned = []
    surface = dict.fromkeys([*estimate.sections["surface"], *prepared.surface.notes])
    heads = estimate.table[0]
    rows = [number_cells(row) for row in estimate.table[1:]]
    return (
        bullets([sentence(line) for line in lines])
        + bullets([sentence(line) for line in surface])
        + "<details><summary>Estimate before the solve</summary>"
        + bullets([sentence(line) for line in planned])
        + f"<p>{escape(sentence(TABLE_CAPTION))}</p>"
        + table(heads, rows)
        + "</details>"
    )


def made_table(record: dict[str, Any]) -> str:
    """Return versions, the hash of the scene, and the time of the run."""
    rows = [
        *record["versions"].items(),
        *((f"SHA-256 of the height map {path}", checksum) for path, checksum in record["map_sha256"].items()),
        ("scene", record["hash"]),
        *(
            []
            if record["seed"] is None
            else [("seed of the scene (surface.seed), from which those of the strips follow", record["seed"])]
        ),
        *_times(record),
        ("solver", record["report"]["solver"]),
    ]
    note = (
        "<p>resolved.toml contains the scene with all defaults; comments there state numbers that follow from its keys, "
        "and values of lubfric in place of keys that are not given. In its folder, "
        f"<code>{escape(record['command'])}</code> computes the same numbers with the versions and height maps "
        "below.</p>"
    )
    return note + facts_table(rows)


def _times(record: dict[str, Any]) -> list[tuple[str, str]]:
    """Return the times of a run: of its points, each as it was solved, and of the command."""
    continues = record["continued"]
    of_call = " of the last call, which continued an interrupted run" if continues else " of the run"
    rows = []
    if "points_seconds" in record:
        together = plain_number(record["points_seconds"], "s")
        rows.append(("wall-clock time of all points together, each as it was solved", together))
    if continues and "points_read" in record:
        known = f"{record['points_read']} of {len(record['points'])}"
        rows.append(("points that the interrupted run had solved", known))
    of_calls = " of the run" if record.get("earlier_processor_seconds") else of_call
    return [
        *rows,
        (f"wall-clock time{of_call}", plain_number(record["seconds"], "s")),
        (f"processor time, all processes together{of_calls}", plain_number(record["processor_seconds"], "s")),
    ]


def facts_table(rows: Iterable[tuple[str, Any]]) -> str:
    """Return the table of facts on how a result was computed; ``rows``: pairs of a name and a value."""
    return table(("", ""), [[Cell(text=name), Cell(text=str(value), kind=KEY)] for name, value in rows])
