"""The result of a fit, and how sure it is."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from .._base import Renamed, Shown, figures
from ..errors import Report
from ..estimate import FrictionResult, cite_together
from ..models.shared import (
    ERROR_OF_ORDER_OF_MAGNITUDE,
    Assumption,
    GatheredTexts,
    Violation,
    alpha_of_fit_in_words,
    gathered_on_curve,
    percent,
    percent_or_less,
    student,
)
from ..quantities import counted, worded_value
from ..scene import Scene
from .fit_checks import ResidualTests
from .fit_input import SPEED, Measured, values_at
from .fit_profile import Profile
from .fit_search import SAME_MINIMUM, Candidate
from .vary import Between

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Probability of the intervals. A convention, as in all intervals.
LEVEL = 0.95

# Name of a fitted curve without a band.
NO_BAND = "fit, which does not describe the data: no interval is valid"

# Distance from a bound, as a share of the bounds, below which a parameter is said to lie on it. A choice: above
# `LAST_MOVE`, where a search ends.
AT_BOUND = 5e-3

# Move of the parameters by another sample of the surface, over half of their interval, up to which it is not reported.
# A convention.
UNREPORTED_MOVE = 0.01

# Correlation of two parameters, without sign, above which it is reported. A convention.
CORRELATED = 0.9

# What sets the limit of the numerical error where the fit chose its tolerance.
BY_NOISE = "the fit set this limit from the noise of the data"

# Largest f of the picture over that of points and curve. A choice, so that no mark is cut.
HEADROOM = 1.08

# Other minima that are named in the text of a fit, at most. A choice, for a text that can be read.
MOST_NAMED_MINIMA = 3


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class FitResult(Renamed, Shown):
    """Parameters found by `lubfric.fit`, how well the data determine them, and whether the fit describes the data.

    The covariance is ``s² (JᵀJ)⁻¹``, with s² the sum over n - p if no deviations are given, else 1, and in both cases
    the mean square of the numerical error of f added. The data cannot determine a parameter whose 95 % interval is as
    wide as its bounds. No interval holds where ``describes_data`` is False.

    Attributes
    ----------
    values : the parameters found, {"section.key": value}
    deviations : their standard deviations, by key
    base : the scene that was fitted, with its own numerics
    scene : ``base`` with the values put in
    tolerance : relative tolerance on f that the fit solved to: that of ``base``, or a smaller one by the noise of the
        data
    predicted : f at the measured points, (n,)
    unit : the parameters as positions between their bounds, 0 to 1, (p,)
    unit_covariance : covariance of ``unit``, (p, p)
    slopes : df/d(unit) at the measured points, (n, p)
    violations : the assumptions that do not hold at each of the points (`lubfric.Violation`). A severe one is there
        only where it was accepted; ``validity`` gathers them
    tests : what the residuals say of the fit (`lubfric.studies.fit_checks.ResidualTests`)
    starts : number of starts that were spread over the bounds
    minima : minima of the search by the load-sharing model, the lowest first, as far as their residuals compare with
        it (`lubfric.studies.fit_search.Candidate`)
    sampling : relative standard error of f at the points because a finite surface represents all of it, (n,); NaN
        where it is not known. It is not in the covariance; ``moved_by_surface`` is its effect
    model_error : relative model-form error of f at the points at 95 %, (n,); NaN where it is not known. It is not in
        the covariance
    variance : s², of the residuals over the scale of the measured points
    points : results at the measured points, (n,), without fields
    profiles : by key, what curves show of parameters that f does not change with at the fit, and of those with wide
        intervals (`lubfric.studies.fit_profile.Profile`). Their intervals come from these, and not from the covariance
    """

    base: Scene
    measured: Measured
    parameters: dict[str, Between]
    unit: np.ndarray
    unit_covariance: np.ndarray
    predicted: np.ndarray
    slopes: np.ndarray
    report: Report
    violations: tuple[tuple[Violation, ...], ...] = ()
    _RENAMED = {"entries": "violations"}
    sampling: np.ndarray = field(default_factory=lambda: np.empty(0))
    model_error: np.ndarray = field(default_factory=lambda: np.empty(0))
    tests: ResidualTests | None = None
    starts: int = 0
    minima: tuple[Candidate, ...] = ()
    variance: float = math.nan
    profiles: dict[str, Profile] = field(default_factory=dict)
    points: tuple[FrictionResult, ...] = ()
    tolerance: float = math.nan

    @property
    def values(self) -> dict[str, float]:
        """The parameters."""
        return values_at(self.parameters, self.unit)

    @property
    def covariance(self) -> np.ndarray:
        """Covariance of the parameters, (p, p) in their units, to first order."""
        slopes = self._slopes
        return self.unit_covariance * slopes[:, None] * slopes

    @property
    def deviations(self) -> dict[str, float]:
        """Standard deviations of the parameters."""
        return dict(zip(self.parameters, np.sqrt(np.diag(self.covariance)).tolist()))

    @property
    def correlation(self) -> np.ndarray:
        """Correlation between the parameters, (p, p)."""
        spread = np.sqrt(np.diag(self.unit_covariance))
        return self.unit_covariance / np.outer(spread, spread)

    @property
    def intervals(self) -> dict[str, tuple[float, float]]:
        """95 % intervals of the parameters, cut at their bounds."""
        low, high = (values_at(self.parameters, end) for end in self._ends)
        return {key: (low[key], high[key]) for key in self.parameters}

    @property
    def undetermined(self) -> tuple[str, ...]:
        """Parameters that the data cannot determine: their 95 % interval is as wide as their bounds."""
        wide = [not 2 * reach < 1.0 for reach in self._reach]
        for place, key in enumerate(self.parameters):
            if key in self.profiles:
                wide[place] = self._limits_of(key) == ()
        return tuple(key for key, is_wide in zip(self.parameters, wide) if is_wide)

    @property
    def undetermined_sides(self) -> dict[str, tuple[str, ...]]:
        """By key, on which side the data do not determine a parameter, because its 95 % interval reaches that bound:
        "below", "above"."""
        sides: dict[str, tuple[str, ...]] = {}
        for key, low, high in zip(self.parameters, *self._ends):
            reached = tuple(side for side, at_bound in (("below", low <= 0.0), ("above", high >= 1.0)) if at_bound)
            sides |= {key: reached} if reached else {}
        return sides

    @property
    def validity(self) -> tuple[str, ...]:
        """One text for each assumption that does not hold at some of the points, which begins with where."""
        return tuple(each.text_with_head for each in self.gathered)

    @property
    def gathered(self) -> tuple[GatheredTexts, ...]:
        """The violations of all points, in one record for each assumption."""
        unit, name = ("m/s", "speeds") if self.measured.over == SPEED else ("", "slide-roll ratios")
        violations = self.violations
        if self.tolerance_in_words:
            violations = tuple(tuple(map(_with_limit_of_fit, of_point)) for of_point in violations)
        return gathered_on_curve(list(zip(self.measured.x.tolist(), violations)), unit, name)

    @property
    def at_bounds(self) -> tuple[str, ...]:
        """Parameters that ended on a bound: a value beyond it would fit the data better."""
        edge = np.minimum(self.unit, 1.0 - self.unit) < AT_BOUND
        return tuple(key for key, there in zip(self.parameters, edge) if there)

    @cached_property
    def scene(self) -> Scene:
        """The scene with the values found."""
        return self.base.with_keys(self.values)

    def to_toml(self) -> str:
        """Return `scene` as the text of a scene file, with a comment on each parameter at its head: its 95 % interval,
        or that the data do not determine it."""
        lines = [f"# Fit to {self.measured.source}."]
        if not self.describes_data:
            lines.append("# The fit does NOT describe the data: the values below have no meaning.")
        for key, ends in self.intervals.items():
            value, low, high = (worded_value(key, number) for number in (self.values[key], *ends))
            statement = f"fitted, {value}, 95 % interval {low} to {high}"
            if key in self.undetermined:
                statement = f"NOT DETERMINED by the data. Any value from {low} to {high} fits; {value} is one of them"
            elif key in self.undetermined_sides:
                statement += f". {self._one_sided(key)}"
            on_bound = "; it is on its bound" if key in self.at_bounds else ""
            lines.append(f"# {key}: {statement}{on_bound}.")
        return "\n".join([*lines, "", self.scene.to_toml()])

    @property
    def band(self) -> tuple[np.ndarray, np.ndarray]:
        """(low, high): the 95 % band of the computed curve at the measured points."""
        reach = self.student * np.sqrt(np.einsum("ni,ij,nj->n", self.slopes, self.unit_covariance, self.slopes))
        return self.predicted - reach, self.predicted + reach

    @property
    def moved_by_surface(self) -> dict[str, float]:
        """By how much another sample of the surface would move the parameters, as a standard deviation to first order.

        It would move f by ``sampling``, at all points together or at each by itself; the larger effect counts.
        """
        error = np.where(np.isfinite(self.sampling), self.sampling, 0.0) * np.abs(self.predicted) / self.measured.scale
        effects = np.linalg.pinv(self.slopes / self.measured.scale[:, None], rcond=1e-8) * error
        moved = np.maximum(np.abs(effects.sum(axis=1)), np.sqrt((effects**2).sum(axis=1)))
        return dict(zip(self.parameters, (moved * self._slopes).tolist()))

    @property
    def describes_data(self) -> bool:
        """False where the residuals are systematic, or larger than the stated deviations, or else the usual scatter and
        the model-form error, allow. Such a fit has no meaningful intervals."""
        return self.tests is None or self.tests.describes

    @property
    def other_minima(self) -> tuple[dict[str, float], ...]:
        """Values of the parameters at other minima of the search, which larger residuals part from the lowest one, and
        whose residuals are at most 1.5 times as large as there."""
        return tuple(values_at(self.parameters, each.unit) for each in self._other_candidates)

    @property
    def _other_candidates(self) -> list[Candidate]:
        low, high = self._ends
        return [
            each
            for each in self.minima
            if each.is_separate and np.abs(each.unit - self.unit).max() >= SAME_MINIMUM
            if np.any((each.unit < low) | (each.unit > high))
        ]

    @property
    def effects(self) -> dict[str, float]:
        """Largest relative change of f at the measured points by each parameter: over its bounds, to first order; of
        those that f does not change with there, between the fit and the bounds within the interval, computed there
        (NaN: not solved)."""
        relative = np.abs(self.slopes / self.predicted[:, None]).max(axis=0)
        effects = dict(zip(self.parameters, relative.tolist()))
        return effects | {key: self.profiles[key].change for key in self._flat}

    def cite(self, format: str = "text") -> str:
        """Return the publications of the methods used at the points, the model's first: one a line, or with ``format``
        "bibtex" as BibTeX entries."""
        return cite_together(self.points, format)

    @property
    def rms_deviation(self) -> float:
        """Root mean square deviation of the measured points from the fitted curve, relative to the measured f."""
        return float(np.sqrt(np.mean((self.predicted / self.measured.coefficient - 1) ** 2)))

    @property
    def not_in_intervals(self) -> tuple[str, ...]:
        """What the intervals of the parameters do not include, one text each."""
        notes = (self.error_of_alpha, self._ranges_note(), self._model_note(), self._surface_note())
        return tuple(filter(None, notes))

    @property
    def error_of_alpha(self) -> str:
        """That the intervals do not include the error of an estimated pressure-viscosity coefficient, as text; "" where
        it is given or fitted, or changes f by less than ``numerics.tolerance``."""
        return alpha_of_fit_in_words(point.unmodelled_effects for point in self.points)

    @property
    def identifiability(self) -> tuple[str, ...]:
        """What the data do not show of the parameters, one text each: which they do not determine or not separate, and
        other minima."""
        lines = []
        for key in self.undetermined:
            change = self.effects[key]
            where = "over its bounds it changes f by"
            reason = "f could not be solved at one of its bounds"
            if not math.isnan(change):
                reason = f"{where} {percent(change)}{'' if key in self._flat else ', linearised'}"
            lines.append(f"the data do not determine {key}: {reason}")
        lines += [f"{key}: {self._one_sided(key)}" for key in self.undetermined_sides if key not in self.undetermined]
        keys = [*self.parameters]
        correlation = self.correlation
        for i in range(len(keys)):
            for j in range(i):
                if abs(correlation[i, j]) > CORRELATED:
                    pair = f"{keys[j]} and {keys[i]}"
                    lines.append(f"the data do not separate {pair} well: correlation {correlation[i, j]:.3f}")
        minima = self._other_candidates
        for candidate in minima[:MOST_NAMED_MINIMA]:
            values = values_at(self.parameters, candidate.unit)
            place = ", ".join(f"{key} = {worded_value(key, value)}" for key, value in values.items())
            times = f"{candidate.misfit / self.minima[0].misfit:.2g}"
            large = "as large as" if times == "1" else f"{times} times as large as"
            lines.append(
                f"the search, by the load-sharing model, has another minimum at {place}, with residuals {large} at the "
                "lowest; the intervals do not include it"
            )
        if len(minima) > MOST_NAMED_MINIMA:
            more = counted(len(minima) - MOST_NAMED_MINIMA, "more minima")
            lines.append(f"fit.json and .other_minima have {more}")
        return tuple(lines)

    @property
    def correlations(self) -> tuple[str, ...]:
        """How the parameters are correlated, one text for each pair that the data separate."""
        texts = []
        correlation = self.correlation
        for (i, first), (j, second) in combinations(enumerate(self.parameters), 2):
            is_known = not {first, second} & {*self.undetermined, *self._flat}
            if is_known and abs(correlation[i, j]) <= CORRELATED:
                texts.append(f"{first} and {second} are correlated by {correlation[i, j]:.2f}")
        return tuple(texts)

    @property
    def tolerance_in_words(self) -> str:
        """That the fit set its own tolerance on f, as text; "" where it is that of the scene."""
        own = self.base.numerics.tolerance
        if not self.tolerance < own:
            return ""
        of_data = "stated deviations" if self.measured.deviation is not None else "usual scatter"
        return (
            f"the fit solved f to a tolerance of {percent(self.tolerance)}, which it set from the noise of the data "
            f"(their {of_data}); the scene keeps its numerics.tolerance of {percent(own)}"
        )

    def _one_sided(self, key: str) -> str:
        """Return in a sentence that the data do not determine a parameter on one side, where its interval ends at a
        bound."""
        (side,) = self.undetermined_sides[key]
        value, low, high = (worded_value(key, number) for number in (self.values[key], *self.intervals[key]))
        (known, bound) = (high, low) if side == "below" else (low, high)
        if key not in self.profiles:
            return f"The data do not determine it {side}: {bound} is its bound, not an end by the data"
        if key not in self._flat:
            limit = "at least" if side == "above" else "at most"
            return (
                f"The data do not determine it {side}: it is {limit} {known}, and with the other parameters fitted "
                f"again {bound}, its bound, is within the 95 % limit of the residuals as well"
            )
        return (
            f"The data do not determine it {side}: f does not change with it at {value}, and every value from {known} "
            f"to its bound {bound} fits as well"
        )

    def one_sided_in_words(self, key: str, digits: int = 4) -> str:
        """Return the interval of a parameter that the data do not determine on one side, "at least 1.4 MPa, with no
        upper end within its bounds"; "" where it has two ends or none."""
        if len(sides := self.undetermined_sides.get(key, ())) != 1:
            return ""
        (limit, end, other) = ("at least", 0, "upper") if sides == ("above",) else ("at most", 1, "lower")
        known = worded_value(key, float(f"{self.intervals[key][end]:.{digits}g}"))
        return f"{limit} {known}, with no {other} end within its bounds"

    def _ranges_note(self) -> str:
        """Return that the intervals do not include the ranges of inputs that are not fitted, as text; "" without
        one."""
        keys = [key for key, *_ in self.scene.ranges]
        return f"not in the intervals: the ranges of {', '.join(keys)}" if keys else ""

    def _model_note(self) -> str:
        """Return that the intervals do not include the model-form error of f, as text; "" where it has none."""
        known = self.model_error[np.isfinite(self.model_error)]
        if not self.model_error.size or not np.any(self.model_error != 0):
            return ""
        if not known.size:
            return "not in the intervals: the model-form error of f, which is not known"
        ends = dict.fromkeys(percent(float(end)) for end in (known.min(), known.max()))
        some = "" if known.size == self.model_error.size else " where it is known"
        return f"not in the intervals: the model-form error of f{some}, {' to '.join(ends)}"

    def _surface_note(self) -> str:
        """Return what the intervals do not include of another sample of the surface, as text; "" where that is next to
        nothing."""
        if not np.isfinite(self.sampling).any():
            if self.base.surface.sq == 0 or not self.sampling.size:
                return ""
            return "not in the intervals: the effect of another sample of the surface, which is not known"
        moves = self.moved_by_surface
        reaches = dict(zip(self.parameters, self._reach * np.abs(self._slopes)))
        moves = {key: move for key, move in moves.items() if key not in self._flat}
        if all(move <= UNREPORTED_MOVE * reaches[key] for key, move in moves.items()):
            return ""
        moved = ", ".join(f"{key} by {worded_value(key, float(f'{move:.2g}'))}" for key, move in moves.items())
        return (
            f"not in the intervals: another sample of the surface (sampling error of f at 95 % up to "
            f"{percent(student(math.inf) * float(np.nanmax(self.sampling)))}), which moves {moved}"
        )

    def explain(self) -> str:
        """Return whether the fit describes the data, the values with their intervals, what the data do not determine,
        and the assumptions that do not hold."""
        lines = [f"fit to {counted(self.predicted.size, 'points')} of {self.measured.source}"]
        if self.tests is not None and self.tests.text:
            lines.append(f"  WARNING: {self.tests.text}")
        for key, (low, high) in self.intervals.items():
            sides = self.undetermined_sides.get(key, ())
            note = f" (not determined {' and '.join(sides)})" if sides else ""
            note = " (not determined)" if key in self.undetermined else note
            note += " (on its bound)" if key in self.at_bounds else ""
            note += "" if self.describes_data else " (not valid)"
            value, *ends = (worded_value(key, v) for v in (self.values[key], low, high))
            interval = self.one_sided_in_words(key) or " to ".join(ends)
            lines.append(f"  {key} = {value}, 95 % interval {interval}{note}")
        scatter = f"{percent_or_less(self.rms_deviation)} of the measured f"
        lines.append(f"  root mean square deviation of the points from the fit: {scatter}")
        if self.tests is not None and self.tests.note:
            lines.append(f"  {self.tests.note}")
        correlations = self.correlations if self.describes_data else ()
        of_tolerance = filter(None, [self.tolerance_in_words])
        warnings = (*correlations, *self.identifiability, *self.not_in_intervals, *of_tolerance, *self.validity)
        return "\n".join([*lines, *(f"  {text}" for text in warnings)])

    def _facts(self) -> dict[str, str]:
        facts = {k: f"{self.values[k]:.4g}, 95 % interval {a:.4g} to {b:.4g}" for k, (a, b) in self.intervals.items()}
        facts |= {"undetermined": ", ".join(self.undetermined) or "none"}
        return facts if self.describes_data else {"": "does not describe the data"} | facts

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw measured points, fitted curve and its 95 % band; returns the axes."""
        axes = figures.axes_or_new(ax)
        draw_fit(axes, self.measured, self.predicted, self.band if self.describes_data else None)
        return axes

    def plot_residuals(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the deviation of the points from the fitted curve, relative; returns the axes."""
        axes = figures.axes_or_new(ax)
        draw_residuals(axes, self.measured, self.predicted)
        return axes

    @property
    def _slopes(self) -> np.ndarray:
        """d value/d ``unit``, (p,)."""
        return np.array([bounds.slope(share) for bounds, share in zip(self.parameters.values(), self.unit)])

    @property
    def _ends(self) -> tuple[np.ndarray, np.ndarray]:
        """The ends of the 95 % intervals of ``unit``, cut at the bounds."""
        low, high = (np.clip(self.unit + side * self._reach, 0.0, 1.0) for side in (-1, 1))
        for place, key in enumerate(self.parameters):
            if key in self.profiles:
                low[place] = self.profiles[key].low
                high[place] = self.profiles[key].high
        return low, high

    @property
    def _flat(self) -> tuple[str, ...]:
        """The parameters that f does not change with at the fit."""
        return tuple(key for key, profile in self.profiles.items() if profile.is_flat)

    def _limits_of(self, key: str) -> tuple[str, ...]:
        """Return which ends of the interval of a parameter with a profile lie within its bounds: "lower", "upper"."""
        profile = self.profiles[key]
        return tuple(side for side, known in (("lower", profile.low > 0.0), ("upper", profile.high < 1.0)) if known)

    @property
    def _reach(self) -> np.ndarray:
        """Half of the 95 % intervals of ``unit``, to first order."""
        return self.student * np.sqrt(np.diag(self.unit_covariance))

    @property
    def student(self) -> float:
        """Student's t of the intervals, with n - p degrees of freedom."""
        from scipy.stats import t

        return float(t.ppf(0.5 + LEVEL / 2, self.predicted.size - self.unit.size))


def _with_limit_of_fit(violation: Violation) -> Violation:
    """Return a ``violation`` that says of the numerical error that the fit set its limit; any other one as it is."""
    if violation.assumption != Assumption.NUMERICAL_ERROR or violation.effect > ERROR_OF_ORDER_OF_MAGNITUDE:
        return violation
    return replace(violation, consequence=BY_NOISE)


def draw_fit(axes: "Axes", measured: Measured, predicted: np.ndarray, band: Sequence[np.ndarray] | None) -> None:
    """Draw ``measured`` points, and the fitted curve of which they have the ``predicted`` (n,) with its 95 % ``band``,
    the lower and the upper end (n,); None: the fit does not describe the data, and has none."""
    measured.draw(axes)
    order = np.argsort(x := np.abs(measured.x))
    axes.plot(x[order], predicted[order], color=figures.BLUE, label="fit" if band is not None else NO_BAND)
    if band is not None:
        (low, high) = band
        axes.fill_between(
            x[order], low[order], high[order], color=figures.BLUE, alpha=0.2, lw=0, label="95 % interval of the fit"
        )
    measured.label(axes)
    (lowest, highest) = axes.dataLim.intervaly
    axes.set(ylim=(HEADROOM * min(lowest, 0.0), HEADROOM * highest), ylabel=figures.FRICTION_LABEL)
    figures.key_above(axes)


def draw_residuals(axes: "Axes", measured: Measured, predicted: np.ndarray) -> None:
    """Draw the deviation of ``measured`` points from the ``predicted`` (n,), relative."""
    miss = 100 * (1 - predicted / measured.coefficient)
    axes.axhline(0, color=figures.GREY, lw=0.8)
    axes.plot(np.abs(measured.x), miss, "o", ms=4, color=figures.RED)
    measured.label(axes)
    reach = 1.15 * max(np.abs(miss).max(), 1e-3)
    axes.set(ylim=(-reach, reach), ylabel="(measured - fit)\n/measured (%)")
