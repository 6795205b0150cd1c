"""The methods behind a result as a paragraph that a publication or a test report may quote."""

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ..models import title_of
from ..models.shared import Decision
from ..quantities import COLUMNS, counted
from .uncertainty import PARTS, Uncertainty

# Authors of a source that are named; of more the first alone. A convention.
NAMED_AUTHORS = 2

# Parts of the interval that are no errors of their own name, in the paragraph; {}: the inputs.
PARTS_IN_PARAGRAPH = {"not given": "the range of {}, which was not given", "input": "the ranges of {}"}


def methods_paragraph(
    version: str,
    sources: Sequence[dict[str, Any]],
    decisions: Sequence[Decision],
    uncertainties: Sequence[Uncertainty],
    inputs: Sequence[str],
    what: str = "Friction",
) -> str:
    """Return the paragraph: ``what`` was computed, by the program of the ``version``; by which models and on which
    cells the points are (``decisions``), their ``inputs``, the ``sources`` of the methods (of papers.toml), and what
    the intervals of f contain by their ``uncertainties``."""
    by_model = Counter(decision.model for decision in decisions)
    total = sum(by_model.values())
    shares = [
        title_of(name) if count == total else f"{title_of(name)} ({count} of {total} points)"
        for name, count in by_model.most_common()
    ]
    by = f" by its {_joined(shares)}" if shares else ""
    by_purpose: dict[str, list[str]] = {}
    for source in sources:
        by_purpose.setdefault(source["purpose"], []).append(_reference(source))
    methods = "; ".join(f"{purpose} ({'; '.join(references)})" for purpose, references in by_purpose.items())
    sentences = [f"{what} was computed with lubfric {version}{by}."]
    facts = [*inputs, *_cells(decisions)]
    sentences += [f"The inputs are: {'; '.join(facts)}."] if facts else []
    sentences += [f"The methods are: {methods}."] if methods else []
    parts = _parts_of_interval(uncertainties)
    sentences += [f"The 95 % interval of f contains {_joined(parts)}."] if parts else []
    return " ".join(sentences)


def _cells(decisions: Sequence[Decision]) -> list[str]:
    """Return on how many strips and cells the points were solved; nothing where none has cells."""
    sizes = {(each.strips, *each.shape) for each in decisions if each.shape is not None}
    if not sizes:
        return []
    ends = dict.fromkeys((min(sizes), max(sizes)))
    texts = [f"{nx} x {ny} cells in {counted(strips, 'strips')}" for strips, nx, ny in ends]
    return [" to ".join(texts)]


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
        ranges.append(PARTS_IN_PARAGRAPH[name].format(_joined(labels)))
    if not errors:
        return ranges
    return [f"the {_joined(errors)} error{'s' if len(errors) > 1 else ''}", *ranges]


def _reference(source: dict[str, Any]) -> str:
    """Return a ``source`` as it is cited within a sentence: "Polonsky and Keer 1999, doi:..."."""
    if source["type"] == "software":
        return "documentation of lubfric"
    if source["type"] == "techreport":
        return f"{source['number']}, {source['year']}"
    names = [author.rpartition(" ")[2] for author in source["author"]]
    who = f"{names[0]} et al." if len(names) > NAMED_AUTHORS else " and ".join(names)
    return f"{who} {source['year']}" + (f", doi:{source['doi']}" if "doi" in source else "")


def _joined(words: Iterable[str]) -> str:
    """Return ``words`` as a list in a sentence: "a, b and c"."""
    *others, last = [*words] or [""]
    return " and ".join(filter(None, (", ".join(others), last)))
