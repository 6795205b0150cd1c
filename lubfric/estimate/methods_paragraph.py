"""The methods behind a result as a paragraph that a publication or a test report may quote."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from ..models import title_of, title_to_quote
from ..models.shared import UNKNOWN_SIDES, Decision, percent
from ..quantities import COLUMNS
from ..scene import BOUNDARY_FILM
from ..units import worded
from .uncertainty import PARTS, Uncertainty

# What chose among the models that may answer.
WHICH_MODEL = ", the cheapest within the tolerances at each point"

# What the numbers behind the parts of the interval are.
SIZES_IN_PARAGRAPH = " (in brackets half its width by each alone, relative to f)"

# Authors of a source that are named; of more the first alone. A convention.
NAMED_AUTHORS = 2

# Parts of the interval that are no errors of their own name, in the paragraph, of one input and of several; {}: the
# inputs.
ASSUMED_RANGE = f"the assumed range of the {{}}, half to twice {worded(BOUNDARY_FILM, 'm')}"
PARTS_IN_PARAGRAPH = {
    "not given": (ASSUMED_RANGE, ASSUMED_RANGE),
    "input": ("the stated range of the {}", "the stated ranges of the {}"),
}


def methods_paragraph(
    version: str,
    sources: Sequence[dict[str, Any]],
    decisions: Sequence[Decision],
    uncertainties: Sequence[Uncertainty],
    inputs: Sequence[str],
    what: str = "Friction",
    models: Sequence[str] = (),
    points_by_model: Mapping[str, int] | None = None,
) -> str:
    """Return the paragraph: ``what`` was computed, by the program of the ``version``; by which models and on which
    cells the points are (``decisions``; the ``points_by_model``, where no decisions are kept; the ``models`` that may
    answer, where it is not known which did), their
    ``inputs``, the ``sources`` of the methods (of papers.toml), and what the intervals of f contain and how wide they
    are, by their ``uncertainties``."""
    kept = {title_to_quote(name): count for name, count in (points_by_model or {}).items()}
    by_title = Counter(kept or map(_title, decisions))
    total = by_title.total()
    shares = [
        title if count == total else f"{title} ({count} of {total} points)" for title, count in by_title.most_common()
    ]
    names = [title_of(name) for name in models]
    which = f"{_joined(names, 'or')}{WHICH_MODEL if len(names) > 1 else ''}"
    by = f" by its {_joined(shares) or which}" if shares or names else ""
    methods = _purposes([source for source in sources if not source.get("is_origin")])
    origins = _purposes([source for source in sources if source.get("is_origin")])
    sentences = [f"{what} was computed with lubfric {version}{by}."]
    facts = [*inputs, *_cells(decisions)]
    sentences += [f"The inputs are: {'; '.join(facts)}."] if facts else []
    sentences += [f"The methods are: {methods}."] if methods else []
    sentences += [f"Credit is due to the {origins}."] if origins else []
    parts = _parts_of_interval(uncertainties)
    sentences += (
        [f"The 95 % interval of f contains{SIZES_IN_PARAGRAPH} {_joined(parts)}{_widths(uncertainties)}."]
        if parts
        else []
    )
    return " ".join(sentences)


def _title(decision: Decision) -> str:
    """Return what answered by a ``decision``, as text: what stands in for its model, where that solved no film with its
    contact."""
    stands_in = decision.basis if decision.cells_of_strip is None else ""
    return stands_in or title_to_quote(decision.model)


def _purposes(sources: Sequence[dict[str, Any]]) -> str:
    """Return what ``sources`` are used for, each purpose once with its sources, as text."""
    by_purpose: dict[str, list[str]] = {}
    for source in sources:
        by_purpose.setdefault(source["purpose"], []).append(_reference(source))
    return "; ".join(f"{purpose} ({'; '.join(references)})" for purpose, references in by_purpose.items())


def _cells(decisions: Sequence[Decision]) -> list[str]:
    """Return on how many strips and cells the points were solved; nothing where none has cells."""
    joined = [(each.strips, each.shape, each.cell_size) for each in decisions if each.shape is not None]
    single = [
        (each.strips, each.cells_of_strip, each.cell_size) for each in decisions if each.cells_of_strip is not None
    ]
    return [
        f"{_span([strips for strips, *_ in solved])} strip{'s' if max(solved)[0] > 1 else ''} of "
        f"{_span([nx for _, (nx, _), _ in solved])} x {_span([ny for _, (_, ny), _ in solved])} cells {how}"
        f"{_cell_sizes([size for *_, size in solved if size is not None])}"
        for solved, how in ((joined, "in all (dry contact)"), (single, "each (film and contact)"))
        if solved
    ]


def _cell_sizes(sizes: Sequence[tuple[float, float]]) -> str:
    """Return the range of the ``sizes`` [m] of cells along the motion and along the line, as text behind their number;
    "" without sizes."""
    if not sizes:
        return ""
    (along, across) = (
        worded(tuple(dict.fromkeys((min(lengths), max(lengths)))), "m").replace(" and ", " to ")
        for lengths in zip(*sizes)
    )
    return f", {along} long along the motion and {across} along the line"


def _span(numbers: Sequence[int]) -> str:
    """Return the range of ``numbers`` as text: "3", or "1 to 4"."""
    return " to ".join(map(str, dict.fromkeys((min(numbers), max(numbers)))))


def _widths(uncertainties: Sequence[Uncertainty]) -> str:
    """Return the range of half the widths of the intervals, relative to f, as text; "" where none is known."""
    halves = [
        (each.interval[1] - each.interval[0]) / abs(2 * each.coefficient)
        for each in _with_relative_errors(uncertainties)
    ]
    return f"; half its width is {_percents(halves)} of f" if halves else ""


def _with_relative_errors(uncertainties: Sequence[Uncertainty]) -> list[Uncertainty]:
    """Return those of the ``uncertainties`` that have an interval relative to f: where f is near 0 there is none."""
    return [each for each in uncertainties if np.isfinite(each.interval).all() and not each.is_near_zero]


def _percents(shares: Sequence[float]) -> str:
    """Return the range of ``shares`` as text: "0.74 %", or "1.4 to 12 %"."""
    ends = dict.fromkeys(percent(share).removesuffix(" %") for share in (min(shares), max(shares)))
    return f"{' to '.join(ends)} %"


def _size_of_part(name: str, uncertainties: Sequence[Uncertainty]) -> str:
    """Return the range of a part of the budget, by its ``name`` in `PARTS`, as text to be appended: " (1.4 to 12 %)";
    "" where it is not known relative to f."""
    sides_by = PARTS[name].sides
    sizes = []
    for each in _with_relative_errors(uncertainties):
        sides = getattr(each, sides_by) if sides_by else UNKNOWN_SIDES
        size = float(np.mean(sides)) if np.isfinite(sides).all() else each.budget[name]
        sizes += [size] if np.isfinite(size) else []
    return f" ({_percents(sizes)})" if sizes else ""


def _parts_of_interval(uncertainties: Sequence[Uncertainty]) -> list[str]:
    """Return what the intervals contain that are known, each with its size, as text."""
    known = [each for each in uncertainties if np.isfinite(each.interval).all()]
    parts = []
    for name, part in PARTS.items():
        if not any(getattr(each, part.quantity) > 0 for each in known):
            continue
        size = _size_of_part(name, known)
        if name not in PARTS_IN_PARAGRAPH:
            parts.append(f"the {name} error{size}")
            continue
        missing = (each.missing_input for each in known)
        given = (key for each in known for key in each.inputs_in_interval)
        keys = dict.fromkeys(missing if name == "not given" else given)
        labels = [COLUMNS[key].label if key in COLUMNS else key for key in keys if key]
        if labels:
            parts.append(f"{PARTS_IN_PARAGRAPH[name][len(labels) > 1].format(_joined(labels))}{size}")
    return parts


def _reference(source: dict[str, Any]) -> str:
    """Return a ``source`` as it is cited within a sentence: "Polonsky and Keer 1999, doi:..."."""
    if source["type"] == "software":
        return f"a method of lubfric {source['version']} itself, described in its {source['manual']}"
    if source["type"] == "techreport":
        return f"{source['number']}, {source['year']}"
    names = [author.rpartition(" ")[2] for author in source["author"]]
    who = f"{names[0]} et al." if len(names) > NAMED_AUTHORS else " and ".join(names)
    return f"{who} {source['year']}" + (f", doi:{source['doi']}" if "doi" in source else "")


def _joined(words: Iterable[str], last_word: str = "and") -> str:
    """Return ``words`` as a list in a sentence: "a, b and c", with the ``last_word`` before the last."""
    *others, last = [*words] or [""]
    return f" {last_word} ".join(filter(None, (", ".join(others), last)))
