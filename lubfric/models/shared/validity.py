"""`Validity`: one assumption of the model that is violated; and those of many points as a few sentences."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from ...errors import ValidityError


@dataclass(frozen=True)
class Validity:
    """An assumption of the model that is violated.

    Attributes
    ----------
    what : the quantity, as text
    value, limit : its value, and the limit of the model, both in ``unit``
    consequence : what that does to the result
    remedy : what to change
    severe : True: the coefficient means nothing, and a `ValidityError` is raised unless accepted. False: a warning
    """

    what: str
    value: float
    limit: float
    unit: str
    consequence: str
    remedy: str
    severe: bool = False

    def __post_init__(self) -> None:
        for name, kind in (("value", float), ("limit", float), ("severe", bool)):
            object.__setattr__(self, name, kind(getattr(self, name)))

    @property
    def text(self) -> str:
        """Three sentences: the violated assumption, what that does, what to do. The first begins with "warning: " or
        "not valid: "."""
        head = "not valid" if self.severe else "warning"
        unit = f" {self.unit}" if self.unit not in ("", "-") else ""
        side = "above" if self.value > self.limit else "below"
        limit = f", {side} {self.limit:.3g}{unit}" if math.isfinite(self.limit) else ""
        numbers = f"{self.value:.3g}{unit}{limit}"
        return f"{head}: {self.what} is {numbers}. {sentence(self.consequence)} Recommendation: {self.remedy}."


def sentence(text: str) -> str:
    """Return ``text`` with a capital letter at its begin, unless that is the name of a key, and a full stop at its
    end."""
    is_name = any(sign in text.partition(" ")[0].rstrip(".:,;") for sign in "._=")
    first = text[:1] if is_name else text[:1].upper()
    return f"{first}{text[1:]}{'' if text.endswith(('.', '?')) else '.'}"


def refused(entries: tuple[Validity, ...], accept: bool, result: object = None) -> None:
    """Raise `ValidityError` with ``result`` if one of ``entries`` is severe, unless ``accept``."""
    severe = [entry for entry in entries if entry.severe]
    if severe and not accept:
        said = " ".join(entry.text for entry in severe)
        advice = "numerics.accept = true (on the command line --accept) keeps the result, marked."
        raise ValidityError(f"{said} {advice}", tuple(severe), result)


def entries_of(point: Any, error: Exception | None) -> tuple[Validity, ...]:
    """Violated assumptions at ``point`` of a curve (None: failed), or at the result that ``error`` refused."""
    refused = error.result if point is None and isinstance(error, ValidityError) else None
    checked = point if refused is None else refused
    return () if checked is None else checked.validity


def in_a_cell(entries: Iterable[Validity]) -> str:
    """The texts of ``entries`` in one cell of a table."""
    return " | ".join(entry.text for entry in entries)


def gathered(
    points: list[tuple[float, tuple[Validity, ...]]], unit: str = "m/s", name: str = "speeds"
) -> tuple[str, ...]:
    """One sentence for each assumption that is violated anywhere: at how many points, from where to where, and the
    worst value.

    ``points``: pairs (value of the swept quantity, entries of that point).
    """
    groups: dict[tuple[str, bool], list[tuple[float, Validity]]] = {}
    for value, entries in points:
        for entry in entries:
            groups.setdefault((entry.what, entry.severe), []).append((value, entry))
    lines = []
    for group in groups.values():
        worst = max((entry for _, entry in group), key=_distance)
        values = sorted(value for value, _ in group)
        if len(group) == 1:
            lines.append(f"{at_value(values[0], unit, name)}: {worst.text}")
        else:
            ends = f"{values[0]:g} to {values[-1]:g} {unit}".rstrip()
            lines.append(f"at {len(group)} {name}, {ends}: {worst.text}")
    return tuple(lines)


def at_value(value: float, unit: str, name: str) -> str:
    """Return the place of one value of a curve: "at 3 m/s", or without a ``unit`` "at a slide-roll ratio of 0.05".
    ``name``: of several values."""
    return f"at {value:.6g} {unit}" if unit else f"at a {name.removesuffix('s')} of {value:.6g}"


def _distance(entry: Validity) -> float:
    """The ratio by which the value is beyond its limit."""
    if entry.limit == 0 or entry.value == 0:
        return abs(entry.value - entry.limit)
    ratio = abs(entry.value / entry.limit)
    return max(ratio, 1 / ratio)
