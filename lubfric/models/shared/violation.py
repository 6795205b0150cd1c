"""`Violation`: one assumption of the model that is violated; and those of many points as a few sentences."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, TypeVar

from ..._base import Renamed
from ...errors import ValidityError
from .wording import distinct_texts

# A place of a point: its number, or its value on a curve.
Place = TypeVar("Place", int, float)
# What one sentence may report together: assumption, quantity, whether it is severe, a note, above its limit.
Kind = tuple[str, str, bool, bool, bool]

# What begins the last sentence of the text of a violation.
RECOMMENDATION = " Recommendation"
# What is between the texts of a cell.
TEXT_SEPARATOR = " | "
# Runs of points that are named in one sentence, at most. A choice, for a sentence that can be read.
MOST_PLACES = 12


# Digits of a value and of its limit, at least. A convention.
LIMIT_DIGITS = 3


def _in_digits(value: float, digits: int) -> str:
    """Return ``value`` with so many ``digits``, without a power of ten up to a million."""
    rounded = float(f"{value:.{digits}g}")
    return f"{rounded:.0f}" if 10**digits <= abs(rounded) < 1e6 else f"{rounded:.{digits}g}"


class Assumption(StrEnum):
    """What the models assume. Results name the one that is violated (`Violation.assumption`)."""

    USUAL_VALUES = "usual values"
    HALF_SPACE = "contact narrower than the bodies"
    LINE_CONTACT = "contact longer than wide"
    ELASTIC_BODIES = "elastic bodies"
    ELASTIC_ASPERITIES = "elastic asperities"
    SMALL_SLOPES = "small slopes of the map"
    CORRELATED_HEIGHTS = "correlated heights of the map"
    MAP_WITHOUT_FORM = "map without form"
    FINE_MAP = "map on cells short enough"
    LONG_SAMPLE = "sample with many asperities"
    STRIPS_LIKE_MAP = "strips as rough as the map"
    SAMPLE_LIKE_SURFACE = "sample with the summits of its surface"
    CONTACT_ON_PATCH = "contact within the patch"
    LONG_PATCH = "patch longer than the contact"
    ASPERITIES_END = "asperities that end on the map"
    ONE_DIRECTION = "surfaces that move in one direction"
    LAMINAR_FILM = "laminar film"
    NO_INERTIA = "film without inertia"
    THIN_FILM = "film thinner than the cylinder"
    FILM_UNDER_TOTAL_LOAD = "film deflected by the total load"
    FLOODED_INLET = "flooded inlet"
    LONG_INLET = "inlet long enough"
    PRESSURE_OF_VISCOSITY_LAW = "pressure in the range of the viscosity law"
    LIQUID_OIL = "lubricant that is liquid at its pressure"
    STRESS_OF_OILS = "shear stress that oils carry"
    STRESS_OF_OILS_UNDER_TOTAL_LOAD = "shear stress that oils carry, if the film carries the total load"
    FRICTION_OF_FILMS = "friction that films reach"
    ABOVE_BOUNDARY_FILM = "film thicker than the boundary film"
    FILM_BELOW_ITS_LIMIT = "film below its limiting stress"
    LUBRICANT_PASSES = "lubricant that passes the contact"
    HEAT_INCLUDED = "heat included"
    KNOWN_INLET_HEAT = "known heat of the inlet"
    FAST_SURFACES = "surfaces fast enough for the flash temperature"
    CHECKED_HEAT = "heat within what was checked"
    ISOTHERMAL_RUN = "isothermal run in time"
    CALIBRATED = "contact like those of the calibration"
    RESOLVED_SHEAR = "resolved shear stress in time"
    NUMERICAL_ERROR = "numerical error within its tolerance"
    SAMPLING_ERROR = "sampling error within its tolerance"
    LARGE_ENOUGH_MAP = "map large enough for the tolerance of the sampling error"
    MODEL_FORM_ERROR = "model-form error within its tolerance"


@dataclass(frozen=True, kw_only=True)
class Violation(Renamed):
    """An assumption of the model that is violated.

    Attributes
    ----------
    assumption : which one, an `Assumption`; "": one of a model from outside
    what : the quantity, as text
    value, limit : its value, and the limit of the model, both in ``unit``
    consequence : how the violation affects the result
    recommendation : what to change
    severe : True: the coefficient has no meaning, and a `ValidityError` is raised unless accepted. False: a warning
    is_note : True: a note instead of a warning, because the interval of f includes the effect, or because no action
        helps
    effect : largest relative change of f that it may cause; NaN where that is not known
    recommendation_seconds : estimated processor time [s] of a point with the ``recommendation``; NaN where that is not
        known
    """

    assumption: str = ""
    what: str
    value: float
    limit: float
    unit: str
    consequence: str
    recommendation: str
    severe: bool = False
    is_note: bool = False
    effect: float = field(default=math.nan, compare=False)  # NaN is not equal to itself in another process
    recommendation_seconds: float = field(default=math.nan, compare=False)
    _RENAMED = {"remedy": "recommendation"}

    def __post_init__(self) -> None:
        for name, kind in (
            ("assumption", str),
            ("value", float),
            ("limit", float),
            ("severe", bool),
            ("is_note", bool),
            ("effect", float),
            ("recommendation_seconds", float),
        ):
            object.__setattr__(self, name, kind(getattr(self, name)))

    @property
    def text(self) -> str:
        """Three sentences: the violated assumption, its consequence, and the recommendation. The first begins with
        "warning: ", "note: " or "not valid: "."""
        return self.text_of(f"{self.value_in_words}{self.spaced_unit}")

    @property
    def kind(self) -> Kind:
        """What violations have in common that one sentence may report together: the assumption, the quantity, whether
        they are severe, or notes, and on which side of the limit they are."""
        return self.assumption, self.what, self.severe, self.is_note, self.value > self.limit

    @property
    def is_below(self) -> bool:
        """Whether the value is below a limit."""
        return math.isfinite(self.limit) and not self.value > self.limit

    @property
    def head(self) -> str:
        """What the `text` begins with: "not valid", "note" or "warning"."""
        if self.severe:
            return "not valid"
        return "note" if self.is_note else "warning"

    @property
    def value_in_words(self) -> str:
        """The value with three digits, or with as many as it needs to differ from the limit."""
        return self._beside_limit[0]

    @property
    def spaced_unit(self) -> str:
        """The unit with a blank before it; "" where there is none."""
        return f" {self.unit}" if self.unit not in ("", "-") else ""

    @property
    def _beside_limit(self) -> tuple[str, str]:
        """The value and the limit as texts that differ."""
        return distinct_texts(self.value, self.limit, _in_digits, least=LIMIT_DIGITS)

    def text_of(
        self, values: str, place: str = "", place_of_recommendation: str = "", *, limits: Sequence[float] = ()
    ) -> str:
        """Return the `text` with ``values`` in place of the value and its unit, such as "5.2 % (at 0.1 m/s) to 8.69 %
        (at 3 m/s)"; ``place``, ``place_of_recommendation``: where the consequence and the recommendation hold as they
        are stated, if not everywhere; ``limits``: of all values, where it may differ from that of this one."""
        return f"{self.head}: {self.statement(values, place, place_of_recommendation, limits=limits)}"

    def statement(
        self,
        values: str,
        place: str = "",
        place_of_recommendation: str = "",
        *,
        limits: Sequence[float] = (),
        seconds: Sequence[float] = (),
    ) -> str:
        """Return the `text_of` without its `head`; ``seconds``: `recommendation_seconds` of all points with this
        recommendation, where they may differ from those of this one."""
        numbers = f"{values}{self._limits_in_words(limits)}"
        where = f" {place_of_recommendation}" if place_of_recommendation else ""
        cost = cost_in_words(seconds or [self.recommendation_seconds])
        last = f"{RECOMMENDATION}{where}{cost}: {self.recommendation}." if self.recommendation else ""
        consequence = f"{place}: {self.consequence}" if place else self.consequence
        return f"{self.what} is {numbers}. {sentence(consequence)}{last}"

    def _limits_in_words(self, limits: Sequence[float]) -> str:
        """Return on which side of which limits the value is, as text to be appended; "" where it has no limit."""
        if not math.isfinite(self.limit):
            return ""
        side = "above" if self.value > self.limit else "below"
        known = [limit for limit in limits if math.isfinite(limit)] or [self.limit]
        low, high = (_in_digits(end, LIMIT_DIGITS) for end in (min(known), max(known)))
        if low == high:
            return f", {side} {self._beside_limit[1]}{self.spaced_unit}"
        return f", {side} their limits, {low} to {high}{self.spaced_unit}"


def cost_in_words(seconds: Sequence[float]) -> str:
    """Return the estimated processor times [s] of points, of which NaN are not known, as text to be appended: with one
    digit, because they are estimates; "" where none is known."""
    known = [value for value in seconds if math.isfinite(value)]
    if not known:
        return ""
    low, high = (f"{float(f'{end:.1g}'):g}" for end in (min(known), max(known)))
    return f" (about {low if low == high else f'{low} to {high}'} s of processor time a point)"


def sentence(text: str) -> str:
    """Return ``text`` with a capital letter at its begin, unless that is the name of a key or the symbol f, and a full
    stop at its end."""
    word = text.partition(" ")[0].rstrip(".:,;")
    is_name = word == "f" or any(sign in word for sign in "._=")
    first = text[:1] if is_name else text[:1].upper()
    return f"{first}{text[1:]}{'' if text.endswith(('.', '?')) else '.'}"


def refused(violations: tuple[Violation, ...], *, accept: bool, result: object = None) -> None:
    """Raise `ValidityError` with ``result`` if one of ``violations`` is severe, unless ``accept``."""
    severe = [violation for violation in violations if violation.severe]
    if severe and not accept:
        message = " ".join(violation.text for violation in severe)
        advice = "numerics.accept = true (on the command line --accept) keeps the result, marked."
        raise ValidityError(f"{message} {advice}", tuple(severe), result)


def violations_of(point: Any, error: Exception | None) -> tuple[Violation, ...]:
    """Return the violated assumptions at ``point`` of a curve (None: failed), or at the result that ``error``
    refused."""
    refused = error.result if point is None and isinstance(error, ValidityError) else None
    checked = point if refused is None else refused
    return () if checked is None else checked.validity


def first_sentence(text: str) -> str:
    """Return the first sentence of ``text``, of one violation or gathered over points, which is what is violated."""
    return text.partition(". ")[0]


def in_a_cell(violations: Iterable[Violation]) -> str:
    """Return the texts of ``violations`` in one cell of a table."""
    return TEXT_SEPARATOR.join(violation.text for violation in violations)


def gathered(
    points: list[tuple[float, tuple[Violation, ...]]], unit: str = "m/s", name: str = "speeds"
) -> tuple[str, ...]:
    """Return the texts of `gathered_on_curve`, each with its `Violation.head`."""
    return tuple(each.text_with_head for each in gathered_on_curve(points, unit, name))


def gathered_on_curve(
    points: list[tuple[float, tuple[Violation, ...]]], unit: str = "m/s", name: str = "speeds"
) -> tuple[GatheredTexts, ...]:
    """Return one text for each assumption that is violated anywhere: at how many points, from where to where, and the
    smallest and the largest value with their places; what it does and what to do: of the worst one, with the places
    where that is the same, if not all. Those that change f the most are the first.

    ``points``: pairs (value of the swept quantity, violations of that point).
    """
    lines = []
    for group in sorted(_groups(points), key=lambda pairs: _rank([violation for _, violation in pairs])):
        worst = _worst([violation for _, violation in group])
        alike = _alike(group, worst)
        places = (at_values(those, unit, name) if len(those) < len(group) else "" for those in alike)
        place = at_values(sorted(value for value, _ in group), unit, name)
        limits = [violation.limit for _, violation in group]
        seconds = _seconds_of_alike(group, worst)
        statement = worst.statement(_from_to(group, unit), *places, limits=limits, seconds=seconds)
        lines.append(GatheredTexts(statement=statement, place=place, violation=worst))
    return tuple(lines)


def _groups(points: Iterable[tuple[Place, Iterable[Violation]]]) -> list[list[tuple[Place, Violation]]]:
    """Return the violations of ``points``, pairs (place, violations there), in groups of one `Violation.kind`."""
    groups: dict[Kind, list[tuple[Place, Violation]]] = {}
    for place, violations in points:
        for violation in violations:
            groups.setdefault(violation.kind, []).append((place, violation))
    return list(groups.values())


def _rank(violations: Sequence[Violation]) -> tuple[bool, float]:
    """Return by what ``violations`` of one kind are sorted: severe ones first, then by the size of their effect on f,
    where that is known."""
    effects = [violation.effect for violation in violations if math.isfinite(violation.effect)]
    return not any(violation.severe for violation in violations), -max(effects, default=0.0)


def _worst(violations: Sequence[Violation]) -> Violation:
    """Return that of ``violations`` of one kind whose words hold for all: that with the largest effect on f if this is
    known of all, else that with the value farthest beyond the limit."""
    if all(math.isfinite(violation.effect) for violation in violations):
        return max(violations, key=lambda violation: violation.effect)
    return max(violations, key=lambda violation: -violation.value if violation.is_below else violation.value)


def _alike(group: Iterable[tuple[Place, Violation]], worst: Violation) -> tuple[list[Place], list[Place]]:
    """Return the places of a ``group`` with the consequence of its ``worst`` violation, and those with its
    recommendation, both sorted."""
    pairs = list(group)
    return (
        sorted(place for place, violation in pairs if violation.consequence == worst.consequence),
        sorted(place for place, violation in pairs if violation.recommendation == worst.recommendation),
    )


def _seconds_of_alike(group: Iterable[tuple[Place, Violation]], worst: Violation) -> list[float]:
    """Return the `Violation.recommendation_seconds` of those of a ``group`` with the recommendation of its ``worst``
    violation."""
    return [each.recommendation_seconds for _, each in group if each.recommendation == worst.recommendation]


def _from_to(group: list[tuple[float, Violation]], unit: str) -> str:
    """Return the smallest and the largest value of a ``group`` with their places, or the one value of all."""
    least, most = (find(group, key=lambda pair: pair[1].value) for find in (min, max))
    ends = [f"{violation.value_in_words}{violation.spaced_unit}" for _, violation in (least, most)]
    if ends[0] == ends[1]:
        return ends[0]
    places = [f"at {place:.4g} {unit}".rstrip() for place, _ in (least, most)]
    return f"{ends[0]} ({places[0]}) to {ends[1]} ({places[1]})"


@dataclass(frozen=True, kw_only=True)
class GatheredTexts:
    """What is violated at some points of a table or of a curve.

    Attributes
    ----------
    statement : what is violated, what that does and what to do, in sentences
    place : the points, as text; "" of no point
    numbers : of these points, from 1; () on a curve
    names_all_points : whether ``place`` has each of these numbers
    violation : the worst one; None: it is of no point
    """

    statement: str
    place: str = ""
    numbers: tuple[int, ...] = ()
    names_all_points: bool = False
    violation: Violation | None = None

    @property
    def is_note(self) -> bool:
        """Whether it is a note."""
        return self.violation is not None and self.violation.is_note

    @property
    def text(self) -> str:
        """The place, the `Violation.head` unless it is that of a warning, and the statement."""
        head = "" if self.violation is None else self.violation.head
        return ": ".join(part for part in (self.place, head.removeprefix("warning"), self.statement) if part)

    @property
    def text_with_head(self) -> str:
        """The place, the `Violation.head` and the statement."""
        head = "" if self.violation is None else self.violation.head
        return ": ".join(part for part in (self.place, head, self.statement) if part)

    @property
    def text_without_head(self) -> str:
        """The place and the statement."""
        return ": ".join(part for part in (self.place, self.statement) if part)


def gathered_in_table(rows: Sequence[Sequence[Violation]]) -> list[GatheredTexts]:
    """Return one text for each assumption that is violated anywhere, as `gathered`, from the violations of each row of
    a table, with the point whose value is farthest beyond its limit; consequence and recommendation are those of the
    worst one, with the points where they are the same, if not all. Points are named by their number, from 1. Those that
    change f the most are the first, then those of the most points."""
    lines = []
    groups = [dict(group) for group in _groups(enumerate(rows, 1))]
    for group in sorted(groups, key=lambda group: (*_rank([*group.values()]), -len(group))):
        worst = _worst([*group.values()])
        alike = _alike(group.items(), worst)
        (place, advised) = (numbers_in_words(n, len(rows)) if len(n) < len(group) else "" for n in alike)
        limits = [violation.limit for violation in group.values()]
        lines.append(
            GatheredTexts(
                statement=worst.statement(
                    _range_in_table(group),
                    place,
                    advised.lower(),
                    limits=limits,
                    seconds=_seconds_of_alike(group.items(), worst),
                ),
                place=numbers_in_words(sorted(group), len(rows)),
                numbers=tuple(sorted(group)),
                names_all_points=len(_runs(sorted(group))) <= MOST_PLACES,
                violation=worst,
            )
        )
    return lines


def _in_order(group: dict[int, Violation]) -> list[tuple[int, Violation]]:
    """Return the pairs (number, violation) of a ``group`` by the values as they are printed; [] where one is not
    finite."""
    if not all(math.isfinite(violation.value) for violation in group.values()):
        return []
    return sorted(group.items(), key=lambda pair: (float(pair[1].value_in_words), pair[0]))


def _farthest_in_table(group: dict[int, Violation]) -> tuple[int, Violation]:
    """Return the number and the violation whose value is farthest beyond its limit; the first where that is not
    known."""
    ordered = _in_order(group) or list(group.items())[:1]
    return ordered[0 if ordered[0][1].is_below else -1]


def _range_in_table(group: dict[int, Violation]) -> str:
    """Return the smallest and the largest value of a ``group`` with the number of the one farthest beyond its limit, or
    the one value of all."""
    (at_worst, worst) = _farthest_in_table(group)
    ordered = _in_order(group)
    ends = [ordered[end][1].value_in_words for end in (0, -1)] if ordered else []
    if len({*ends}) < 2:
        return f"{worst.value_in_words}{worst.spaced_unit}"
    place = f" (at point {at_worst})"
    if worst.is_below:
        return f"{ends[0]}{place} to {ends[1]}{worst.spaced_unit}"
    return f"{ends[0]} to {ends[1]}{worst.spaced_unit}{place if math.isfinite(worst.limit) else ''}"


def numbers_in_words(numbers: list[int], count: int) -> str:
    """Return which of ``count`` points ``numbers`` are, as text: "At points 1, 3 to 5 and 9"; of many scattered ones
    how many they are: "At 20 of 41 points"."""
    if count == 1:
        return "At the point"
    if len(numbers) == 1:
        return f"At point {numbers[0]}"
    shown = [f"{run[0]} to {run[-1]}" if len(run) > 2 else ", ".join(map(str, run)) for run in _runs(numbers)]
    if len(shown) > MOST_PLACES:
        return f"At {len(numbers)} of {count} points"
    *before, last = ", ".join(shown).rsplit(", ", 1)
    return f"At points {' and '.join((*before, last))}"


def _runs(numbers: Iterable[int]) -> list[list[int]]:
    """Return the runs of consecutive ``numbers``, which are in order."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return runs


def at_value(value: float, unit: str, name: str) -> str:
    """Return the place of one value of a curve: "at 3 m/s", or without a ``unit`` "at a slide-roll ratio of 0.05".
    ``name``: of several values."""
    return f"at {value:.4g} {unit}" if unit else f"at a {name.removesuffix('s')} of {value:.4g}"


def at_values(values: Sequence[float], unit: str, name: str) -> str:
    """Return the place of several ``values`` of a curve: "at 3 speeds, 0.1 to 1 m/s", "at 2 speeds, 0.1 and 1 m/s"; of
    one as `at_value`."""
    if len(values) == 1:
        return at_value(values[0], unit, name)
    between = "and" if len(values) == 2 else "to"
    return f"at {len(values)} {name}, {f'{min(values):.4g} {between} {max(values):.4g} {unit}'.rstrip()}"
