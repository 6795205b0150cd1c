"""The methods behind a result as a paragraph that a publication or a test report may quote."""

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ..models import title_of
from ..models.shared import Decision
from ..quantities import COLUMNS
from ..scene import BOUNDARY_FILM
from ..units import worded
from .uncertainty import PARTS, Uncertainty

# What chose among the models that may answer.
WHICH_MODEL = ", the cheapest within the tolerances at each point"

# Authors of a source that are named; of more the first alone. A convention.
NAMED_AUTHORS = 2

# Parts of the interval that are no errors of their own name, in the paragraph; {}: the inputs.
PARTS_IN_PARAGRAPH = {
    "not given": f"the assumed range of the {{}}, half to twice {worded(BOUNDARY_FILM, 'm')}",
    "input": "the stated range of the {}",
}


def methods_paragraph(
    version: str,
    sources: Sequence[dict[str, Any]],
    decisions: Sequence[Decision],
    uncertainties: Sequence[Uncertainty],
    inputs: Sequence[str],
    what: str = "Friction",
    models: Sequence[str] = (),
) -> str:
    """Return the paragraph: ``what`` was computed, by the program of the ``version``; by which models and on which
    cells the points are (``decisions``; the ``models`` that may answer, where it is not known which did), their
    ``inputs``, the ``sources`` of the methods (of papers.toml), and what the intervals of f contain and how wide they
    are, by their ``uncertainties``."""
    by_model = Counter(decision.model for decision in decisions)
    total = sum(by_model.values())
    shares = [
        title_of(name) if count == total else f"{title_of(name)} ({count} of {total} points)"
        for name, count in by_model.most_common()
    ]
    names = [title_of(name) for name in models]
    which = f"{_joined(names, 'or')}{WHICH_MODEL if len(names) > 1 else ''}"
    by = f" by its {_joined(shares) or which}" if shares or names else ""
    by_purpose: dict[str, list[str]] = {}
    for source in sources:
        by_purpose.setdefault(source["purpose"], []).append(_reference(source))
    methods = "; ".join(f"{purpose} ({'; '.join(references)})" for purpose, references in by_purpose.items())
    sentences = [f"{what} was computed with lubfric {version}{by}."]
    facts = [*inputs, *_cells(decisions)]
    sentences += [f"The inputs are: {'; '.join(facts)}."] if facts else []
    sentences += [f"The methods are: {methods}."] if methods else []
    parts = _parts_of_interval(uncertainties)
    sentences += [f"The 95 % interval of f contains {_joined(parts)}{_widths(uncertainties)}."] if parts else []
    return " ".join(sentences)


def _cells(decisions: Sequence[Decision]) -> list[str]:
    """Return on how many strips and cells the points were solved; nothing where none has cells."""
    joined = [(each.strips, each.shape) for each in decisions if each.shape is not None]
    single = [(each.strips, each.cells_of_strip) for each in decisions if each.cells_of_strip is not None]
    return [
        f"{_span([strips for strips, _ in sizes])} strip{'s' if max(sizes)[0] > 1 else ''} of "
        f"{_span([nx for _, (nx, _) in sizes])} x {_span([ny for _, (_, ny) in sizes])} cells {how}"
        for sizes, how in ((joined, "in all (dry contact)"), (single, "each (film and contact)"))
        if sizes
    ]


def _span(numbers: Sequence[int]) -> str:
    """Return the range of ``numbers`` as text: "3", or "1 to 4"."""
    return " to ".join(map(str, dict.fromkeys((min(numbers), max(numbers)))))


def _widths(uncertainties: Sequence[Uncertainty]) -> str:
    """Return the range of half the widths of the intervals, relative to f, as text; "" where none is known. Where f is
    near 0 it has none."""
    known = [each for each in uncertainties if np.isfinite(each.interval).all() and not each.is_near_zero]
    halves = [100 * (each.interval[1] - each.interval[0]) / abs(2 * each.coefficient) for each in known]
    if not halves:
        return ""
    ends = dict.fromkeys(f"{float(f'{half:.2g}'):g}" for half in (min(halves), max(halves)))
    return f"; half its width is {' to '.join(ends)} % of f"


def _parts_of_interval(uncertainties: Sequence[Uncertainty]) -> list[str]:
    """Return what the intervals contain that are known, as text."""
    known = [each for each in uncertainties if np.isfinite(each.interval).all()]
    errors = []
    ranges = []
    for name, part in PARTS.items():
        if not any(getattr(each, part.quantity) > 0 for each in known):
            continue
        if name not in PARTS_IN_PARAGRAPH:
            errors.append(name)
            continue
        missing = (each.missing_input for each in known)
        given = (key for each in known for key in each.inputs_in_interval)
        keys = dict.fromkeys(missing if name == "not given" else given)
        labels = [COLUMNS[key].label if key in COLUMNS else key for key in keys if key]
        ranges += [PARTS_IN_PARAGRAPH[name].format(label) for label in labels]
    if not errors:
        return ranges
    return [f"the {_joined(errors)} error{'s' if len(errors) > 1 else ''}", *ranges]


def _reference(source: dict[str, Any]) -> str:
    """Return a ``source`` as it is cited within a sentence: "Polonsky and Keer 1999, doi:..."."""
    if source["type"] == "software":
        return f"{source['author'][0]} {source['year']}, lubfric {source['version']}, {source['manual']}"
    if source["type"] == "techreport":
        return f"{source['number']}, {source['year']}"
    names = [author.rpartition(" ")[2] for author in source["author"]]
    who = f"{names[0]} et al." if len(names) > NAMED_AUTHORS else " and ".join(names)
    return f"{who} {source['year']}" + (f", doi:{source['doi']}" if "doi" in source else "")


def _joined(words: Iterable[str], last_word: str = "and") -> str:
    """Return ``words`` as a list in a sentence: "a, b and c", with the ``last_word`` before the last."""
    *others, last = [*words] or [""]
    return f" {last_word} ".join(filter(None, (", ".join(others), last)))
