"""report.html of a run: one page that a reader understands who was not there. It needs no other file, and prints."""

from html import escape
from typing import Any

from ..models.shared import Prepared
from ..scene import Scene
from ..studies import CurveResult, Law
from ..time import TransientResult
from .budget_bars import history_budget, point_budget
from .curve_answer import curve_answer, gap_notes
from .curve_tables import details_of_points, formula_of_curve, operating_table
from .describe import SceneEstimate
from .effects_and_warnings import effects_at_other_points, effects_table, history_effects, warnings_and_notes
from .history_answer import history_answer, history_notes
from .history_table import history_table
from .inputs import INPUT_SECTIONS
from .inputs_as_given import inputs_as_given
from .markup import bullets, paragraphs, picture
from .methods import made_table, method_lists, methods_to_quote, scene_in_words
from .operating_point import nearest_solved
from .page import framed
from .run_files import captions
from .status import curve_in_words, missed_by_run, status_kind, status_of_curve

# Caption of the picture of a curve of one point.
CAPTION_OF_POINT = "Friction with its parts and its interval, load ratios and film of the point"


def report_page(
    prepared: Prepared,
    result: CurveResult | TransientResult,
    *,
    record: dict[str, Any],
    contents: dict[str, bytes],
    estimate: SceneEstimate,
    given: dict[str, Any],
    law: Law | str = "",
) -> bytes:
    """Return the page of ``result``.

    Parameters
    ----------
    record : what result.json holds
    contents : content of the files of the run by name, its pictures among them
    estimate : what was known before the solve
    given : tables of the scene as the user wrote them
    law : the formula of a curve, or why it has none; "" for what is no Stribeck curve
    """
    scene = prepared.scene
    parts = (
        _curve_parts(scene, result, law, estimate)
        if isinstance(result, CurveResult)
        else _history_parts(prepared, result, estimate)
    )
    return framed(
        "report.html",
        "friction of a lubricated line contact",
        f"{scene_in_words(scene)}. {record['date']}, lubfric {record['versions']['lubfric']}.",
        parts
        | {
            "name": escape(scene.name),
            "curve": _pictures(contents, shows_answer=True, caption=_caption_of_point(result)),
            "warnings": warnings_and_notes(result.gathered, gap_notes(result)),
            "inputs": "".join(inputs_as_given(scene, section, given.get(section, {})) for section in INPUT_SECTIONS),
            "pictures": _pictures(contents, shows_answer=False)
            or "<p>There is no contact or rough surface to show.</p>",
            "method": methods_to_quote(
                [scene_in_words(scene), *[f"roughness: {text}" for text in estimate.sections["surface"][:1]]], result
            )
            + method_lists(prepared, result, estimate),
            "made": made_table(record),
        },
    )


def _curve_parts(scene: Scene, curve: CurveResult, law: Law | str, estimate: SceneEstimate) -> dict[str, str]:
    """Return the parts of the page that a curve fills."""
    nearest = nearest_solved(scene, curve)
    point = None if nearest is None else nearest[0]
    answer = ["No point of the curve has an answer."] if nearest is None else curve_answer(scene, curve, *nearest)
    effects = estimate.effects if point is None else point.unmodelled_effects
    return {
        "kind": status_of_curve(scene, curve).kind(failed=bool(curve.errors)),
        "status": escape(curve_in_words(scene, curve)),
        "answer": paragraphs(answer),
        "budget": "" if nearest is None else point_budget(*nearest),
        "table": operating_table(scene, curve),
        "effects": effects_table(effects, "before the solve" if nearest is None else nearest[1])
        + effects_at_other_points(curve, {effect.what for effect in effects}),
        "details": details_of_points(curve) + formula_of_curve(law, curve),
        "sources": bullets(curve.cite().splitlines()),
    }


def _history_parts(prepared: Prepared, result: TransientResult, estimate: SceneEstimate) -> dict[str, str]:
    """Return the parts of the page that a run in time fills."""
    above = missed_by_run(prepared.scene, result)
    return {
        "kind": status_kind(failed=not result.is_complete, inexact=len(above)),
        "status": escape(" ".join((result.status, *above))),
        "answer": paragraphs(
            [
                *history_answer(prepared.scene, result, complete=result.is_complete),
                *history_notes(prepared.scene, result),
            ]
        ),
        "budget": history_budget(result),
        "table": history_table(prepared.scene, result),
        "effects": history_effects(prepared, result, estimate),
        "details": "",
        "sources": bullets(result.cite().splitlines()),
    }


def _caption_of_point(result: CurveResult | TransientResult) -> str:
    """Return the caption of the picture of a curve of one point; "" of any other result."""
    return CAPTION_OF_POINT if isinstance(result, CurveResult) and len(result.points) == 1 else ""


def _pictures(contents: dict[str, bytes], *, shows_answer: bool, caption: str = "") -> str:
    """Return the pictures among ``contents`` that the page shows beside its answer, or at its end; ``caption``: of all
    of them, "" for their own."""
    return "".join(
        picture(contents[name], caption or text) for name, text in captions(contents, shows_answer=shows_answer).items()
    )
