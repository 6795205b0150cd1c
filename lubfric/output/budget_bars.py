"""The uncertainty budget of f as bars: of a point, and of the mean of a run in time."""

import math
from collections.abc import Iterable, Sequence
from html import escape

from ..estimate import PARTS, FrictionResult
from ..models.shared import percent_of_sides, sentence
from ..quantities import COLUMNS
from ..scene import BOUNDARY_FRICTION_KEY
from ..time import TransientResult
from .markup import bullets

# Labels of the parts of the uncertainty budget; that of an input that the scene does not give names it
# (`budget_labels`).
BUDGET = {name: part.label for name, part in PARTS.items()}
# These labels where the error by the cells is part of the model-form error.
BUDGET_ON_LONG_CELLS = {name: part.label_on_long_cells or part.label for name, part in PARTS.items()}
# What the numerical part of a run in time is called: the error of the integral of the film's shear stress alone.
NUMERICAL_IN_TIME = "numerical (grid of the film; not the steps in time)"


def names_of_inputs(keys: Iterable[str]) -> str:
    """Return the labels of the inputs of these ``keys`` (section.key), each once; "input" where there is none."""
    labels = (COLUMNS[key].label if key in COLUMNS else key for key in keys)
    return " and ".join(dict.fromkeys(labels)) or "input"


def budget_labels(points: Sequence[FrictionResult], parts: dict[str, str] = BUDGET) -> dict[str, str]:
    """Return what the ``parts`` of the uncertainty budget of ``points`` are called; inputs that the scene does not give
    by their labels, and no such part where all are given."""
    missing = [known.missing_input for known in (point.uncertainty for point in points) if known.not_given]
    labels = {name: text.format(names_of_inputs(missing)) for name, text in parts.items()}
    return {name: text for name, text in labels.items() if name != "not given" or missing}


def point_budget(point: FrictionResult, place: str) -> str:
    """Return the uncertainty budget of f at a ``point`` of a curve, which lies at a ``place``."""
    known = point.uncertainty
    labels = budget_labels([point], BUDGET_ON_LONG_CELLS if point.decision.counts_cells_as_model_error else BUDGET)
    notes = (known.largest_part, *known.notes)
    return _budget(known.budget, known.budget_in_words, f"f {place}", notes, labels, is_cut=bool(known.cut))


def budget_of_mean(result: TransientResult) -> tuple[dict[str, float], dict[str, str]]:
    """Return the parts of the uncertainty budget of the mean friction coefficient of a run in time, relative to it, and
    the same as text, by the names of `lubfric.estimate.PARTS`; both empty where there is no mean."""
    sides = result.average().budget if result.time.size > 1 else {}
    values = {name: max(below, above) for name, (below, above) in sides.items()}
    if values.get("input") == 0.0:  # no range is in the interval, whether or not inputs have one
        del values["input"]
    return values, {name: percent_of_sides(sides[name], largest) for name, largest in values.items()}


def budget_of_mean_in_words(result: TransientResult) -> list[str]:
    """Return the `budget_of_mean` in a line; none where there is no mean."""
    _, words = budget_of_mean(result)
    parts = ", ".join(f"{NUMERICAL_IN_TIME if name == 'numerical' else name} {text}" for name, text in words.items())
    return [f"Uncertainty budget of the mean: {parts}."] if parts else []


def history_budget(result: TransientResult) -> str:
    """Return the uncertainty budget of the mean friction coefficient of a run in time."""
    values, words = budget_of_mean(result)
    if not values:
        return ""
    largest = max(values, key=lambda name: values[name] if math.isfinite(values[name]) else 0.0)
    of_input = f"input (range of the {COLUMNS[BOUNDARY_FRICTION_KEY].label})"
    labels = BUDGET | {"numerical": NUMERICAL_IN_TIME, "input": of_input}
    advice = f"; give a measured {BOUNDARY_FRICTION_KEY} to reduce it" if largest == "input" else ""
    notes = [
        f"Largest part: {labels[largest]} {words[largest]}{advice}",
        "The numerical part is the error of the integral of the film's shear stress. The error of a step in time, at "
        "most transient.tolerance, is not included",
        "The errors keep their sign at all times, so the interval of a mean is the mean of the intervals",
        *result.not_in,
    ]
    if math.isfinite(values["model-form"]):
        notes.insert(2, "The model-form error is that of steady motion at the same film, asperity load ratio and heat")
    return _budget(values, words, "the mean friction coefficient", notes, labels)


def _budget(
    values: dict[str, float],
    words: dict[str, str],
    subject: str,
    notes: Iterable[str],
    labels: dict[str, str],
    *,
    is_cut: bool = False,
) -> str:
    """Return the uncertainty budget of ``subject`` (`lubfric.estimate.Uncertainty.budget`) as bars of its parts,
    relative to f; ``words``: the parts as text; ``labels``: what each is called; ``is_cut``: whether ``notes`` have a
    limit of the interval."""
    longest = max([value for value in values.values() if math.isfinite(value)], default=0.0) or 1.0
    shown = {name: label for name, label in labels.items() if name in values}
    rows = "".join(
        f'<span>{label}</span><span><i style="width:{100 * min(values[name] / longest, 1.0):.1f}%"></i></span>'
        f"<span>{escape(words[name])}</span>"
        if math.isfinite(values[name])
        else f"<span>{label}</span><span></span><span>not known</span>"
        for name, label in shown.items()
    )
    lines = bullets([sentence(note) for note in notes if note])
    unknown = {name for name in shown if not math.isfinite(values[name])}
    combined = "the interval of f combines them"
    if unknown:
        combined = "the interval of f combines those that are known"
    if unknown - {"model-form"}:
        combined = "one of them is not known, so f has no interval"
    elif is_cut:
        combined += ", within the limits stated below"
    return (
        f"<h2>Uncertainty budget</h2><p>Relative errors of {escape(subject)}, each at 95 %; {combined}.</p>"
        f'<div class="budget">{rows}</div>{lines}'
    )
