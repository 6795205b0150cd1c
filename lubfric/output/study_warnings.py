"""The warnings and notes of a study, with the numbers of their points."""

from dataclasses import replace

import numpy as np

from ..models.shared import GatheredTexts, first_sentence, sentence
from ..quantities import COLUMNS, counted, worded_value
from ..samples import is_measured, requests_patch
from ..scene import has_moving_roughness
from ..studies import OF_TOLERANCES, StudyResult, columns_of_study
from .study_points import scene_of_each

# Where the points are listed that a sentence has no room for.
ALL_IN_TABLE = " The column validity of study.csv has all of them."


def numbered_warnings(result: StudyResult) -> list[GatheredTexts]:
    """Return the warnings of a study, one for all points that share the reason: doubts about its plain numbers, which
    are of no point, then the assumptions that do not hold somewhere, with the points where that is a note."""
    warnings = [GatheredTexts(statement=sentence(note)) for note in result.plan.notes]
    for each in result.gathered:
        if not each.is_note:
            places = [f" {note.place} this is a note." for note in result.gathered if _is_note_of(note, each)]
            warnings.append(replace(each, statement="".join((each.statement, *places))))
    return warnings


def notes_without_warning(result: StudyResult) -> list[str]:
    """Return the notes of a study, but those that `numbered_warnings` names, as the same is a warning elsewhere."""
    notes = [each for each in result.gathered if each.is_note]
    return [note.text_without_head for note in notes if not any(_is_note_of(note, each) for each in result.gathered)]


def _is_note_of(note: GatheredTexts, warning: GatheredTexts) -> bool:
    """Return whether a ``note`` states of other points what a ``warning`` does."""
    violation = note.violation
    other = warning.violation
    if violation is None or other is None or not note.is_note or warning.is_note:
        return False
    return violation.assumption == other.assumption and violation.what == other.what


def counts_of_warnings(result: StudyResult) -> str:
    """Return at how many points of a study there are warnings and notes, as its tables have them, and what these are;
    "" where there are none."""
    noted = {number for each in result.gathered if each.is_note for number in each.numbers}
    if not result.with_warnings and not noted:
        return ""
    notes = f", notes at {len(noted)} ({_coverage_of_notes(result)})" if noted else ""
    where = f"warnings at {result.with_warnings} of {counted(result.solved, 'points')}{notes}"
    return f"{where}; study.csv has them in the column validity"


def _coverage_of_notes(result: StudyResult) -> str:
    """Return whether the intervals of f cover what notes say, as text."""
    known = np.isfinite(result["interval_low"])[np.isfinite(result["coefficient"])]
    if not known.any():
        return "no point has an interval of f that would include their effect"
    where = "" if known.all() else ", where it is known,"
    return f"the interval of f{where} includes their effect, or nothing reduces it; recommendations narrow the interval"


def warning_lines(result: StudyResult) -> list[str]:
    """Return how many points have warnings and notes, and each reason of a warning with its points and the worst value,
    in a line each."""
    counts = counts_of_warnings(result)
    if not counts:
        return []
    heads = [first_sentence(each.text) for each in result.gathered if not each.is_note]
    full = ", and report.html has them in full, with recommendations"
    return [f"{counts}{full}{':' if heads else '.'}", *(f"  {head[:1].lower()}{head[1:]}" for head in heads)]


def tolerance_lines(result: StudyResult) -> list[str]:
    """Return which points miss the tolerance of the numerical error, of the sampling error, and of the model-form
    error."""
    of_tolerances = [
        each
        for each in result.gathered
        if each.violation is not None and each.is_note and each.violation.assumption in OF_TOLERANCES
    ]
    return [f"{each.text_without_head}{'' if each.names_all_points else ALL_IN_TABLE}" for each in of_tolerances]


def why_no_intervals(result: StudyResult) -> str:
    """Return at which points of a study the interval of f is not known, and, of a patch, how long it is there and at
    the other points; "" where all intervals are known."""
    columns = columns_of_study(result)
    solved = np.isfinite(columns["coefficient"])
    unknown = solved & np.isnan(columns["interval_low"])
    if not unknown.any():
        return ""
    known = solved & ~unknown
    text = f" The interval of f is not known at {counted(int(unknown.sum()), 'points')}"
    apart = []
    for name in result.coords:
        here, there = (list(dict.fromkeys(columns[name][where].tolist())) for where in (unknown, known))
        if known.any() and not set(here) & set(there):
            values = ", ".join(worded_value(name, value) for value in here)
            apart.append(f"{COLUMNS[name].label if name in COLUMNS else name} {values}")
    text += f" ({'; '.join(apart)})" if apart else ""
    scene = result.plan.scene
    if not requests_patch(scene):
        return f"{text}."
    shape = scene.contact.shape
    spacing = scene.contact.spacing
    varies = any(name.startswith("contact") for name in result.coords)
    text += ", because the single patch is too short there for a sampling error"
    if has_moving_roughness(scene) and known.any() and shape is not None and spacing is not None and not varies:
        length = shape[0] * float(np.broadcast_to(spacing, 2)[0])
        widths = length / np.array([each.bodies.half_width for each in scene_of_each(result)])
        text += (
            f". It is {_ends(widths[unknown])} half-widths of the Hertz strip long along the motion there, and "
            f"{_ends(widths[known])} at the points with an interval"
        )
    way = "a larger map" if is_measured(scene) else "numerics.sampling = 'strips' or a larger contact.shape"
    return f"{text}. Give {way} for an interval; 'lubfric run' of such a point states how much is missing."


def _ends(values: np.ndarray) -> str:
    """Return the ends of the range of ``values`` as text."""
    return " to ".join(dict.fromkeys(f"{end:.3g}" for end in (values.min(), values.max())))
