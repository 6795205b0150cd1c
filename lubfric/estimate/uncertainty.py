"""`Uncertainty`: what is known about the error of a friction coefficient."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .._base import Renamed
from ..models.shared import (
    NEAR_ZERO,
    REDUCED_BY_DETERMINISTIC,
    REDUCED_BY_TOLERANCE,
    SAMPLING_ERROR_MISSED,
    UNKNOWN_SIDES,
    ModelErrorPart,
    Sides,
    StandardError,
    half_width_of_error,
    has_too_few_contacts,
    is_near_zero,
    percent_of_sides,
    sides_in_f,
)
from ..quantities import (
    COLUMN_OF_ERROR,
    ESTIMATED,
    OF_SIDES,
    OF_UNCERTAINTY,
    Quantities,
    UncertaintyQuantities,
    described_in_doc,
)
from ..units import beside_interval, interval_in_words, with_interval


@dataclass(frozen=True, kw_only=True)
class BudgetPart:
    """A part of the uncertainty budget.

    Attributes
    ----------
    quantity : its name in `lubfric.quantities`, which is a field of `Uncertainty`
    label : what the report calls it; {}: the label of `Uncertainty.missing_input`
    label_on_long_cells : the same where the error of the cells is a model-form one; "": the ``label``
    sides : the field of `Uncertainty` with both of its sides, towards 0 and away from it; "": it has one value
    recommendation : what reduces it, as text; "": nothing
    cause : what it comes from, as text; "": its name says so
    name_in_words : its name in `Uncertainty.text`; None: that in `PARTS`
    is_stated_if_zero : whether `Uncertainty.text` has it where it is 0
    note_if_unknown : what follows there where it is not known
    """

    quantity: str
    label: str
    label_on_long_cells: str = ""
    sides: str = ""
    recommendation: Callable[[Uncertainty], str]
    cause: Callable[[Uncertainty], str] = lambda uncertainty: ""
    name_in_words: Callable[[Uncertainty], str] | None = None
    is_stated_if_zero: bool = True
    note_if_unknown: str = ""


# The parts of the uncertainty budget, by what they are called.
PARTS = {
    "numerical": BudgetPart(
        quantity="numerical",
        label="numerical (grids and solvers)",
        label_on_long_cells="numerical (solvers)",
        recommendation=lambda uncertainty: uncertainty.narrows_numerical,
    ),
    "sampling": BudgetPart(
        quantity="sampling",
        label="sampling (finite surface)",
        recommendation=lambda uncertainty: uncertainty.narrows_sampling,
    ),
    "model-form": BudgetPart(
        quantity="model",
        label="model-form (equations)",
        label_on_long_cells="model-form (equations, long cells)",
        note_if_unknown=" (not included)",
        sides="model_sides",
        recommendation=lambda uncertainty: (
            REDUCED_BY_DETERMINISTIC
            if uncertainty.largest_in_model is None
            else uncertainty.largest_in_model.recommendation
        ),
        cause=lambda uncertainty: "" if uncertainty.largest_in_model is None else uncertainty.largest_in_model.cause,
    ),
    "not given": BudgetPart(
        quantity="not_given",
        label="{} (not given)",
        name_in_words=lambda uncertainty: f"{uncertainty.missing_input} not given",
        is_stated_if_zero=False,
        sides="not_given_sides",
        recommendation=lambda uncertainty: f"give a measured {uncertainty.missing_input} to reduce it",
    ),
    "input": BudgetPart(
        quantity="inputs",
        label="input (stated ranges)",
        name_in_words=lambda uncertainty: uncertainty.input_in_words,
        is_stated_if_zero=False,
        sides="input_sides",
        recommendation=lambda uncertainty: f"give a measured {uncertainty.largest_input or 'value'} to reduce it",
    ),
}

# Part of the budget, relative, below which nothing is recommended that reduces it. A convention.
SMALL_PART = 0.005

# Model-form error, relative, that is stated as smaller than this: effects that it does not include may be larger. A
# convention.
LEAST_STATED_MODEL_ERROR = 1e-3


@described_in_doc
@dataclass(frozen=True, kw_only=True)
class Uncertainty(Renamed, UncertaintyQuantities[float]):
    """The uncertainty of the friction coefficient of one operating point. docs/uncertainty.md says what is not
    included.

    A number that is not known is NaN, and ``text`` says why. ``line_scatter`` is the scatter between lines at different
    places on the surface.

    Attributes
    ----------
    coefficient : f, of which the parts are relative errors
    interval : 95 % interval of f, (low, high), from ``numerical``, ``sampling`` and ``model`` where that is known; by
        Student's t with ``freedom`` degrees of freedom
    interval_without_sampling : where ``sampling`` is not known, the interval by all other parts alone, which is too
        narrow; NaN otherwise
    tolerance : relative requested standard error
    notes : remarks on these errors
    model_sides, not_given_sides, input_sides : ``model``, ``not_given`` and ``inputs`` towards 0 and away from it; NaN
        where only the larger is known
    largest_in_model : the largest part of ``model``; None where its parts are not known
    narrows_numerical, narrows_sampling : what narrows ``numerical`` and ``sampling``, as text
    missing_input : the key of the input that the scene does not give, whose range changes f most ("": none)
    largest_input : the input whose range changes f most
    inputs_in_interval : keys of the inputs whose ranges the interval contains
    cut : why the interval is narrower than the budget says, as text: a limit of the shear stress, or the sense of the
        sliding, excludes what is beyond
    """

    coefficient: float = math.nan
    interval: tuple[float, float] = (math.nan, math.nan)
    interval_without_sampling: tuple[float, float] = (math.nan, math.nan)
    tolerance: float = math.nan
    notes: tuple[str, ...] = ()
    model_sides: tuple[float, float] = UNKNOWN_SIDES
    not_given_sides: tuple[float, float] = UNKNOWN_SIDES
    input_sides: tuple[float, float] = UNKNOWN_SIDES
    largest_in_model: ModelErrorPart | None = None
    narrows_numerical: str = REDUCED_BY_TOLERANCE
    narrows_sampling: str = "set a smaller numerics.sampling_tolerance to reduce it"
    missing_input: str = ""
    largest_input: str = ""
    inputs_in_interval: tuple[str, ...] = ()
    cut: tuple[str, ...] = ()
    _RENAMED = {"spots": "effective_contacts", "few_spots": "has_few_contacts"}

    @property
    def budget(self) -> dict[str, float]:
        """The uncertainty budget: half of the width of the 95 % interval by each part alone, relative to f, by the
        names of `PARTS`. NaN where a part is not known.

        That of sampling is its standard error (``sampling``) times Student's t.
        """
        parts = {name: getattr(self, part.quantity) for name, part in PARTS.items()}
        return parts | {"sampling": half_width_of_error(self.sampling, self.freedom)}

    @property
    def budget_in_words(self) -> dict[str, str]:
        """The `budget` as text, by the same names: "42 %", and "-29 to +42 %" where the two sides differ; in f itself,
        as "-0.0004 to +0.0025", where it `is_near_zero`."""
        sides: dict[str, tuple[float, float]] = {
            name: getattr(self, part.sides) for name, part in PARTS.items() if part.sides
        }
        if self.is_near_zero:
            return {
                name: sides_in_f(sides.get(name, UNKNOWN_SIDES), value, self.coefficient)
                for name, value in self.budget.items()
            }
        words = {name: percent_of_sides(sides.get(name, UNKNOWN_SIDES), value) for name, value in self.budget.items()}
        if self.model < LEAST_STATED_MODEL_ERROR:
            words["model-form"] = f"< {100 * LEAST_STATED_MODEL_ERROR:g} %"
        return words

    @property
    def input_in_words(self) -> str:
        """What the part of the inputs is called: with the names of those whose ranges the interval contains."""
        names = [name.rpartition(".")[2] for name in self.inputs_in_interval]
        return f"input ({', '.join(names)})" if names else "input"

    def part_in_words(self, name: str) -> str:
        """Return what the part ``name`` of the `budget` is called as text: with the inputs that it is by."""
        in_words = PARTS[name].name_in_words
        return name if in_words is None else in_words(self)

    @property
    def is_near_zero(self) -> bool:
        """Whether f is near 0 and a part of its error is larger, so that errors are stated in f and not relative to
        it."""
        return bool(is_near_zero(self.coefficient, _largest_of_finite(self.budget.values())))

    @property
    def misses_sampling_tolerance(self) -> bool:
        """Whether the sampling error is above its tolerance; not where f `is_near_zero`, as no relative error counts
        there."""
        return not self.is_near_zero and self.sampling > SAMPLING_ERROR_MISSED * self.tolerance

    @property
    def is_largest_by_model(self) -> bool:
        """Whether no other part of the budget is larger than the model-form error."""
        return not any(part > self.model for part in self.budget.values())

    @property
    def largest_part(self) -> str:
        """What the largest part of the budget is, and what reduces it; "" where that is not known."""
        words = self.largest_part_in_words
        return f"largest part: {words}" if words else ""

    @property
    def largest_part_in_words(self) -> str:
        """The `largest_part` without the words that introduce it."""
        name, more = self.largest_part_and_advice
        return f"{self.part_in_words(name)} {self.budget_in_words[name]}{more}" if name else ""

    @property
    def largest_part_and_advice(self) -> tuple[str, str]:
        """The name of the largest part of the budget, and its cause and what reduces it as text to be appended; both ""
        where that is not known."""
        parts = {name: part for name, part in self.budget.items() if math.isfinite(part) and part > 0}
        if not parts or not math.isfinite(self.sampling):
            return "", ""
        name = max(parts, key=lambda name: parts[name])
        if parts[name] < SMALL_PART:
            return name, ""
        cause = PARTS[name].cause(self)
        recommendation = PARTS[name].recommendation(self)
        because = f" ({cause})" if cause else ""
        advice = f"; {recommendation}" if recommendation else ""
        return name, f"{because}{advice}"

    @property
    def has_few_contacts(self) -> bool:
        """Whether `has_too_few_contacts` asperity contacts carry the load."""
        return has_too_few_contacts(self.effective_contacts, self.sampling, self.tolerance)

    @property
    def text(self) -> str:
        """The 95 % interval of f and the uncertainty budget, as text."""
        if not math.isfinite(self.sampling):
            known = f"95 % interval of f not known{self._others_in_words}"
            return "; ".join((f"{known}: {self._in_words('not known')}", *self.notes))
        sampling_in_words = f"{self.budget_in_words['sampling']} of a line of {1e3 * self.length:.3g} mm"
        interval_text = interval_in_words(*self.interval)
        return "; ".join((f"95 % interval of f {interval_text}: {self._in_words(sampling_in_words)}", *self.notes))

    @property
    def without_sampling_in_words(self) -> str:
        """The `interval_without_sampling` as text, "0.0413 to 0.0473"; "" where there is none."""
        if not all(map(math.isfinite, self.interval_without_sampling)):
            return ""
        return interval_in_words(*self.interval_without_sampling, value=self.coefficient)

    @property
    def _others_in_words(self) -> str:
        words = self.without_sampling_in_words
        return f" (without the sampling error {words})" if words else ""

    def short(self, coefficient: float) -> str:
        """Return f with its 95 % interval, and the uncertainty budget, as text; why there is no interval is in
        ``notes``."""
        return f"{self._f_in_words(coefficient)}; {self._in_words(self.budget_in_words['sampling'])}{self._without_interval}"

    def short_lines(self, coefficient: float) -> list[str]:
        """Return the parts of `short`, a line each: f with its interval, and the budget."""
        budget = self._in_words(self.budget_in_words["sampling"])
        return [f"{self._f_in_words(coefficient)}{self._without_interval}", f"uncertainty budget: {budget}"]

    @property
    def _without_interval(self) -> str:
        """That there is no interval, as text to be appended; "" where there is one."""
        return "" if math.isfinite(self.sampling) else f"; no 95 % interval{self._others_in_words}"

    def _f_in_words(self, coefficient: float) -> str:
        """Return f with its 95 % interval as text."""
        if self.without_sampling_in_words:  # its digits are known, though no interval is
            return f"f = {beside_interval(coefficient, *self.interval_without_sampling)}"
        return f"f = {with_interval(coefficient, *self.interval)}"

    def _in_words(self, sampling_in_words: str) -> str:
        words = self.budget_in_words | {"sampling": sampling_in_words}
        stated = []
        for name, part in PARTS.items():
            value = getattr(self, part.quantity)
            if value == 0 and not part.is_stated_if_zero:
                continue
            note = part.note_if_unknown if math.isnan(value) else ""
            stated.append(f"{self.part_in_words(name)} {words[name]}{note}")
        of_what = f"errors of f itself, which is below {NEAR_ZERO:g}: " if self.is_near_zero else ""
        return "; ".join((f"{of_what}{', '.join(stated)}", *self.cut))


# Columns of the uncertainty of f in every table: the ends of its interval, its parts, and both sides of those that have
# two.
UNCERTAINTY_COLUMNS = ("interval_low", "interval_high", *COLUMN_OF_ERROR.values(), *OF_SIDES, "sampling_tolerance")


def _largest_of_finite(parts: Iterable[float]) -> float:
    """Return the largest of the ``parts`` of an error that are known; 0 where none is."""
    return max((part for part in parts if math.isfinite(part)), default=0.0)


def uncertainty_of_row(columns: Mapping[str, np.ndarray], row: int) -> Uncertainty:
    """Return the `Uncertainty` of f in a ``row`` of a table, (n,) each, as far as its ``columns`` tell it."""
    names = {"coefficient": "coefficient", "sampling_tolerance": "tolerance"}
    names |= {column: name for name, column in COLUMN_OF_ERROR.items()}
    numbers: dict[str, Any] = {name: float(columns[key][row]) for key, name in names.items() if key in columns}
    return Uncertainty(**numbers)


def row_of_uncertainty(uncertainty: Uncertainty) -> dict[str, float]:
    """Return the numbers of an ``uncertainty`` by the names that all tables have for them (`UNCERTAINTY_COLUMNS`)."""
    row = dict(zip(("interval_low", "interval_high"), uncertainty.interval))
    row |= {column: getattr(uncertainty, name) for name, column in COLUMN_OF_ERROR.items()}
    for part in PARTS.values():
        if part.sides:
            names = (f"{COLUMN_OF_ERROR[part.quantity]}_{end}" for end in ("low", "high"))
            row |= zip(names, getattr(uncertainty, part.sides))
    return row | {"sampling_tolerance": uncertainty.tolerance}


@described_in_doc
@dataclass(frozen=True, kw_only=True)
class UncertaintyCurve(Renamed, UncertaintyQuantities[np.ndarray]):
    """`Uncertainty` of many operating points: arrays (n,), NaN where a point failed.

    Attributes
    ----------
    interval : (n, 2)
    model_sides : (n, 2), of the model-form error, towards 0 and away from it
    text : of each point
    """

    interval: np.ndarray
    model_sides: np.ndarray
    text: tuple[str, ...]
    _RENAMED = {"spots": "effective_contacts"}


def curve_of(points: Sequence[Any]) -> UncertaintyCurve:
    """Return the `UncertaintyCurve` of ``points``, each an `Uncertainty` or None."""
    columns = {name: np.array([math.nan if p is None else getattr(p, name) for p in points]) for name in OF_UNCERTAINTY}
    both = np.array([(math.nan, math.nan) if p is None else p.interval for p in points]).reshape(len(points), 2)
    sides = np.array([UNKNOWN_SIDES if p is None else p.model_sides for p in points]).reshape(len(points), 2)
    return UncertaintyCurve(
        **columns, interval=both, model_sides=sides, text=tuple("" if p is None else p.text for p in points)
    )


@dataclass(frozen=True, kw_only=True)
class NumberErrors(Quantities[float]):
    """Estimated relative error of every reported quantity: one standard error, where the surface is part of it. NaN
    where it is not known, or the quantity itself is NaN; ``reasons`` then has the name and why."""

    reasons: dict[str, str]


def number_errors_of(
    numbers: dict[str, float], errors_by_name: dict[str, float], why: str, reasons: dict[str, str]
) -> NumberErrors:
    """Return `NumberErrors` of the ``numbers`` of a point, from ``errors_by_name``.

    ``reasons``: why some errors are not known, by name; ``why`` others are not, unless the number is NaN or 0.
    """
    errors = {name: float(errors_by_name.get(name, math.nan)) for name in ESTIMATED}
    errors = {name: value if math.isfinite(value) else math.nan for name, value in errors.items()}
    by_number = {name: _why_no_relative_error(numbers[name]) for name in ESTIMATED}
    unknown = [name for name, value in errors.items() if math.isnan(value)]
    return NumberErrors(**errors, reasons={name: reasons.get(name) or by_number[name] or why for name in unknown})


def _why_no_relative_error(number: float) -> str:
    """Return why a ``number`` has no relative error, as text; "" if it may have one."""
    if math.isnan(number):
        return "not computed by the model"
    return "it is 0, and so has no relative error" if number == 0 else ""


def with_part(uncertainty: Uncertainty, below: float, above: float) -> Uncertainty:
    """Return ``uncertainty`` with another part in its interval, which moves f [-] so far ``below`` and ``above`` it at
    95 %: parts add up as squares, on each side for themselves."""
    f = uncertainty.coefficient
    low, high = uncertainty.interval
    return replace(uncertainty, interval=(f - math.hypot(f - low, below), f + math.hypot(high - f, above)))


def interval(
    value: float, *, numerical: float, sampling_error: StandardError, model_error: tuple[float, float]
) -> tuple[float, float]:
    """Return value (1 ± sqrt(numerical² + (t sampling error)² + model-form error²)), t the 97.5 % quantile of Student's
    t with the degrees of freedom of the ``sampling_error``; ``model_error``: the model-form error, towards 0 and away
    from it; it counts where it is known."""
    error = sampling_error.value
    if not math.isfinite(error):
        return math.nan, math.nan
    of_sample = half_width_of_error(error, sampling_error.freedom)
    towards, away = (
        abs(value) * math.hypot(numerical, of_sample, 0.0 if math.isnan(side) else side) for side in model_error
    )
    below, above = Sides(towards, away).below_and_above(value)
    return value - below, value + above
