"""The warnings of a result, and the effects that are not modelled."""

from collections.abc import Container, Iterable, Sequence
from html import escape

import numpy as np

from ..models.shared import ExpectedEffect, GatheredTexts, Prepared, UnmodelledEffect, at_values, sentence
from ..studies import CurveResult
from ..time import LEAST_SHARE_OF_F, TransientResult, effects_of_run, rolls, without_steady_film
from .describe import SceneEstimate
from .markup import NUMBER, Cell, bullets, folded_notes, plain_cells, table
from .operating_point import place_on_curve

# What the page has where no effect of a place is tabled.
NO_EFFECTS = (
    "{}, at its asperity load ratio, each known effect changes f by less than the numerical tolerance. ('lubfric info' "
    "estimates larger changes before the solve, for all asperity load ratios that the result might have had.)"
)
# What the page has where there are no warnings.
NO_WARNINGS = "There are no warnings."
# The same where there are notes, as on errors above their tolerances.
NOTES_ALONE = "There are no warnings, but notes: the interval of f includes their effect, or nothing reduces it."


def warnings_and_notes(gathered: Iterable[GatheredTexts], further_notes: Iterable[str] = ()) -> str:
    """Return the list of the warnings among the ``gathered`` violations, and below it that of the notes and the
    ``further_notes``, each a sentence."""
    known = list(gathered)
    warnings = [sentence(each.text) for each in known if not each.is_note]
    notes = [sentence(each.text_without_head) for each in known if each.is_note]
    notes += map(sentence, further_notes)
    return bullets(warnings, NOTES_ALONE if notes else NO_WARNINGS, "warning") + folded_notes(
        bullets(notes), len(notes)
    )


def effects_table(
    effects: Sequence[UnmodelledEffect | ExpectedEffect],
    place: str,
    which: str = "",
    moments: Sequence[str] = (),
    note: str = "",
) -> str:
    """Return the table of the effects that are not modelled at a ``place``; ``which``: what is said of the place;
    ``moments``: of a run in time, when each is largest; ``note``: a sentence to be appended."""
    if not effects:
        return f"<p>{escape(NO_EFFECTS.format(sentence(place).removesuffix('.')))}</p>"
    rows = []
    for index, effect in enumerate(effects):
        row = [Cell(text=sentence(effect.what)), Cell(text=effect.change_in_words, kind=NUMBER)]
        row += plain_cells(moments[index : index + 1])
        row += plain_cells([sentence(effect.recommendation)])
        rows.append(row)
    head = f"<p>Likely changes of f {escape(place)}{which}, estimated with closed forms.{note}</p>"
    heads = ["effect", "change of f", *(["where"] if moments else []), "recommendation"]
    return head + table(heads, rows, in_sentences=True)


def effects_at_other_points(curve: CurveResult, listed: Container[str]) -> str:
    """Return the table of the effects that are not modelled and are not ``listed`` for the operating point, each at the
    point of the curve where it changes f the most; "" where there are none."""
    largest: dict[str, tuple[float, UnmodelledEffect, str]] = {}
    unknown_at: dict[str, list[float]] = {}
    name, _, unit, plural = curve.SWEPT
    for index, point in enumerate(curve.points):
        if point is None:
            continue
        for effect in point.unmodelled_effects:
            if effect.what in listed:
                continue
            if np.isnan(effect.largest_change):
                unknown_at.setdefault(effect.what, []).append(getattr(curve, name)[index])
            change = float(np.nan_to_num(effect.largest_change * abs(point.coefficient)))
            if effect.what not in largest or change > largest[effect.what][0]:
                largest[effect.what] = (change, effect, place_on_curve(curve, index))
    shown = sorted(largest.values(), key=lambda row: -row[0])
    place = "at other points of the curve"
    which = ", each at the point where it changes f the most, or at those where its change is not estimated"
    places = [
        at_values(unknown_at[what], unit, plural) if np.isnan(effect.largest_change) else where
        for what, (_, effect, where) in ((row[1].what, row) for row in shown)
    ]
    moments = [where.removeprefix("at ") for where in places]
    return effects_table([effect for _, effect, _ in shown], place, which, moments) if shown else ""


def history_effects(prepared: Prepared, result: TransientResult, estimate: SceneEstimate) -> str:
    """Return the table of the effects that are not modelled, each at the output at which it changes f the most."""
    effects = effects_of_run(prepared, result)
    place = "of the run"
    share = f"{100 * LEAST_SHARE_OF_F:g} %"
    which = f", each at the output where it changes f the most, among the outputs with f above {share} of its mean"
    note = without_steady_film(prepared.scene, result.time.tolist())
    if result.time.size < 2 or not rolls(result.columns).any():
        effects = estimate.effects_over_time
        place = "before the solve"
        which = ", each at the time when it changes f the most"
        note = ""
    moments = [each.moment_in_words for each in effects]
    return effects_table([each.effect for each in effects], place, which, moments, note)
