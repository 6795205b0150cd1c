"""The methods behind a result as a paragraph that a publication or a test report may quote."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from ..models import title_of, title_to_quote
from ..models.shared import UNKNOWN_SIDES, Decision, percent
from ..quantities import COLUMNS
from ..scene import BOUNDARY_FILM
from ..units import with_interval, worded
from .uncertainty import PARTS, Uncertainty

# What chose among the models that may answer.
WHICH_MODEL = ", the cheapest within the tolerances at each point"

# What f is, and what the interval is made of.
DEFINITION_OF_F = (
    "The friction coefficient f is the force on surface 2 against its sliding over surface 1, over the load."
)
COMBINED = (
    "On each side of f the parts add up by the root of the sum of their squares. The ends of a range are taken as 95 % "
    "limits of independent inputs. The interval ends where the limits of the shear stress and the sense of the sliding "
    "allow no other f."
)

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
    """Return paragraphs and lists: ``what`` was computed, by the program of the ``version``; by which models and on which
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
    sentences = [f"{what} was computed with lubfric {version}{by}.", *_cells(decisions)]
    sentences += [DEFINITION_OF_F] if names or shares or uncertainties else []
    methods = _purposes([source for source in sources if not source.get("is_origin")])
    origins = _joined(_purposes([source for source in sources if source.get("is_origin")]))
    sentences += [f"Credit is due to the {origins}."] if origins else []
    parts = _parts_of_interval(uncertainties)
    interval = ["The 95 % interval of f contains, with half its width by each part alone relative to f:"]
    interval += [*_lines(parts), " ".join([COMBINED, *_intervals(uncertainties)])]
    paragraphs = (
        [" ".join(sentences)],
        ["Inputs:", *_lines(inputs)] if inputs else [],
        ["Methods:", *_lines(methods)] if methods else [],
        interval if parts else [],
    )
    return "\n\n".join("\n".join(lines) for lines in paragraphs if lines)


def _lines(texts: Iterable[str]) -> list[str]:
    """Return the ``texts`` as the lines of a list."""
    return [f"- {text}" for text in texts]


def _title(decision: Decision) -> str:
    """Return what answered by a ``decision``, as text: what stands in for its model, where that solved no film with its
    contact."""
    stands_in = decision.basis if decision.cells_of_strip is None else ""
    return stands_in or title_to_quote(decision.model)


def _purposes(sources: Sequence[dict[str, Any]]) -> list[str]:
    """Return what ``sources`` are used for, each purpose once with its sources, as text."""
    by_purpose: dict[str, list[str]] = {}
    for source in sources:
        by_purpose.setdefault(source["purpose"], []).append(_reference(source))
    return [f"{purpose} ({'; '.join(references)})" for purpose, references in by_purpose.items()]


def _cells(decisions: Sequence[Decision]) -> list[str]:
    """Return on how many strips and cells the points were solved, a sentence each; nothing where none has cells."""
    joined = [(each.strips, each.shape, each.cell_size) for each in decisions if each.shape is not None]
    single = [
        (each.strips, each.cells_of_strip, each.cell_size) for each in decisions if each.cells_of_strip is not None
    ]
    sentences = [
        f"{where} solved on {_span([strips for strips, *_ in solved])} strip{'s' if max(solved)[0] > 1 else ''} of "
        f"{_span([nx for _, (nx, _), _ in solved])} x {_span([ny for _, (_, ny), _ in solved])} cells {how}"
        f"{_cell_sizes([size for *_, size in solved if size is not None])}."
        for solved, where, how in (
            (joined, "The dry contact was", "in all"),
            (single, "Film and contact together were", "each"),
        )
        if solved
    ]
    controls = [each.control_strips for each in decisions if each.control_strips]
    if controls:
        number = f"{_span(controls)} strip{'s' if max(controls) > 1 else ''}"
        where = "f" if len(controls) == len(decisions) else f"At {len(controls)} of {len(decisions)} points f"
        sentences.append(
            f"{where} is that of the load-sharing model on {number}, corrected by the mean difference of the models."
        )
    shorter = sorted({times for each in decisions for times in each.shorter_cells})
    if shorter:
        sentences.append(
            f"It was corrected by the change of f on cells {_joined(map(str, shorter))} times as short, on pieces of the "
            "strips."
        )
    return sentences


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


def _intervals(uncertainties: Sequence[Uncertainty]) -> list[str]:
    """Return f and its interval, of one point, and the range of half the widths of the intervals relative to f, a
    sentence each; [] where none is known."""
    known = _with_relative_errors(uncertainties)
    if not known:
        return []
    halves = [(each.interval[1] - each.interval[0]) / abs(2 * each.coefficient) for each in known]
    of_point = [f"f is {with_interval(known[0].coefficient, *known[0].interval)}."] if len(uncertainties) == 1 else []
    return [*of_point, f"Half the width of the interval is {_percents(halves)} of f."]


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
