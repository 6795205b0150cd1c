"""The result of a fit, and how sure it is."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from .._base import Shown, figures
from ..errors import Report
from ..estimate import percent
from ..models.shared import (
    Validity,
    gathered,
)
from ..quantities import counted, worded_value
from ..scene import Scene
from .fit_input import SPEED, Measured, values_at
from .vary import Between

LEVEL = 0.95
AT_BOUND = 5e-3  # of the bounds


@dataclass(frozen=True, eq=False, repr=False)
class FitResult(Shown):
    """Parameters found by `lubfric.fit`, and how well the data determine them.

    The covariance is ``s² (JᵀJ)⁻¹``, with s² the sum over n - p if no deviations are given, else 1, and in both cases
    the mean square of the numerical error of f beside it. The data cannot determine a parameter whose 95 % interval is
    as wide as its bounds.

    Attributes
    ----------
    values : the parameters found, {"section.key": value}
    deviations : their standard deviations, by key
    scene : the scene with the values put in
    predicted : f at the measured points, (n,)
    unit : the parameters as positions between their bounds, 0 to 1, (p,)
    unit_covariance : covariance of ``unit``, (p, p)
    slopes : df/d(unit) at the measured points, (n, p)
    entries : the assumptions that do not hold at each of the points (`lubfric.Validity`). A severe one is there only
        where it was accepted; ``validity`` gathers them
    sampling : relative standard error of f at the points because a finite surface stands for all of it, (n,); NaN where
        it is not known. It is not in the covariance; ``moved_by_surface`` is its effect
    """

    base: Scene
    measured: Measured
    parameters: dict[str, Between]
    unit: np.ndarray
    unit_covariance: np.ndarray
    predicted: np.ndarray
    slopes: np.ndarray
    report: Report
    entries: tuple[tuple[Validity, ...], ...] = ()
    sampling: np.ndarray = field(default_factory=lambda: np.empty(0))

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
        low, high = (values_at(self.parameters, np.clip(self.unit + s * self._reach, 0.0, 1.0)) for s in (-1, 1))
        return {key: (low[key], high[key]) for key in self.parameters}

    @property
    def undetermined(self) -> tuple[str, ...]:
        """Parameters that the data cannot determine: their 95 % interval is as wide as their bounds."""
        return tuple(key for key, reach in zip(self.parameters, self._reach) if not 2 * reach < 1.0)

    @property
    def validity(self) -> tuple[str, ...]:
        """One sentence for each assumption that does not hold at some of the points."""
        unit, name = ("m/s", "speeds") if self.measured.over == SPEED else ("(slide-roll ratio)", "ratios")
        return gathered(list(zip(self.measured.x.tolist(), self.entries)), unit, name)

    @property
    def at_bounds(self) -> tuple[str, ...]:
        """Parameters that ended on a bound: a value beyond it would fit the data better."""
        edge = np.minimum(self.unit, 1.0 - self.unit) < AT_BOUND
        return tuple(key for key, there in zip(self.parameters, edge) if there)

    @cached_property
    def scene(self) -> Scene:
        """The scene with the values found."""
        return self.base.with_keys(self.values)

    @property
    def band(self) -> tuple[np.ndarray, np.ndarray]:
        """(low, high): the 95 % band of the computed curve at the measured points."""
        reach = self._student * np.sqrt(np.einsum("ni,ij,nj->n", self.slopes, self.unit_covariance, self.slopes))
        return self.predicted - reach, self.predicted + reach

    @property
    def moved_by_surface(self) -> dict[str, float]:
        """By how much another piece of the surface would move the parameters, as a standard deviation to first order.

        It would move f by ``sampling``, at all points together or at each by itself; the larger effect counts.
        """
        off = np.where(np.isfinite(self.sampling), self.sampling, 0.0) * np.abs(self.predicted) / self.measured.scale
        effects = np.linalg.pinv(self.slopes / self.measured.scale[:, None], rcond=1e-8) * off
        moved = np.maximum(np.abs(effects.sum(axis=1)), np.sqrt((effects**2).sum(axis=1)))
        return dict(zip(self.parameters, (moved * self._slopes).tolist()))

    def _misfit(self) -> str:
        """In words that the points lie farther from the fit than their deviations allow (chi-squared, 95 %); "" if
        they do not, or have none."""
        if self.measured.deviation is None:
            return ""
        from scipy.stats import chi2

        squares = self.report.residuals["sum of squares"]
        freedom = self.predicted.size - self.unit.size
        if squares <= chi2.ppf(LEVEL, freedom):
            return ""
        times = np.sqrt(squares / freedom)
        return f"the points lie {times:.2g} times as far off as their deviations say: the intervals are too narrow"

    def _of_surface(self) -> str:
        """What the intervals leave out, in words; "" for a surface that leaves nothing open."""
        if not np.isfinite(self.sampling).any():
            if self.base.surface.sq == 0 or not self.sampling.size:
                return ""
            return "not in the intervals: what another piece of the surface would give, which is not known"
        if np.nanmax(self.sampling) == 0:
            return ""
        moved = ", ".join(f"{key} by {move:.2g}" for key, move in self.moved_by_surface.items())
        return (
            f"not in the intervals: another piece of the surface (standard error of f up to "
            f"{percent(float(np.nanmax(self.sampling)))}), which moves {moved}"
        )

    def explain(self) -> str:
        """Values, intervals, correlations, the parameters that the data cannot determine, and the assumptions that do
        not hold."""
        lines = [f"fit to {counted(self.predicted.size, 'points')} of {self.measured.source}"]
        for key, (low, high) in self.intervals.items():
            note = " - the data do not determine it" if key in self.undetermined else ""
            note += " - on its bound" if key in self.at_bounds else ""
            value, *ends = (worded_value(key, v) for v in (self.values[key], low, high))
            lines.append(f"  {key} = {value}, 95 % interval {' to '.join(ends)}{note}")
        keys = [*self.parameters]
        correlation = self.correlation
        for i in range(len(keys)):
            for j in range(i):
                if abs(correlation[i, j]) > 0.9:
                    lines.append(f"  {keys[j]} and {keys[i]} go together: correlation {correlation[i, j]:.3f}")
        scatter = float(np.sqrt(np.mean((self.predicted / self.measured.coefficient - 1) ** 2)))
        cautions = [f"  {text}" for text in (self._misfit(), self._of_surface(), *self.validity) if text]
        return "\n".join([*lines, f"  scatter about the fit {100 * scatter:.2g} % of f", *cautions])

    def _facts(self) -> dict[str, str]:
        facts = {k: f"{self.values[k]:.4g}, 95 % interval {a:.4g} to {b:.4g}" for k, (a, b) in self.intervals.items()}
        return facts | {"undetermined": ", ".join(self.undetermined) or "none"}

    def plot(self, ax=None):
        """Measured points, fitted curve and its 95 % band; returns the axes."""
        axes = figures.axes_or_new(ax)
        (low, high) = self.band
        self.measured.draw(axes)
        order = np.argsort(x := np.abs(self.measured.x))
        axes.plot(x[order], self.predicted[order], color=figures.BLUE, label="fit")
        axes.fill_between(x[order], low[order], high[order], color=figures.BLUE, alpha=0.2, lw=0, label="95 % band")
        self.measured.label(axes)
        axes.set(ylim=(0.0, None), ylabel=figures.FRICTION)
        axes.legend(frameon=False)
        return axes

    def plot_residuals(self, ax=None):
        """Deviation of the points from the fitted curve, relative; returns the axes."""
        axes = figures.axes_or_new(ax)
        miss = 100 * (self.measured.coefficient / self.predicted - 1)
        axes.axhline(0, color=figures.GREY, lw=0.8)
        axes.plot(np.abs(self.measured.x), miss, "o", ms=4, color=figures.RED)
        self.measured.label(axes)
        reach = 1.15 * max(np.abs(miss).max(), 1e-3)
        axes.set(ylim=(-reach, reach), ylabel="measured - fit (%)")
        return axes

    @property
    def _slopes(self) -> np.ndarray:
        """d value/d ``unit``, (p,)."""
        return np.array([bounds.slope(share) for bounds, share in zip(self.parameters.values(), self.unit)])

    @property
    def _reach(self) -> np.ndarray:
        """Half of the 95 % intervals of ``unit``."""
        return self._student * np.sqrt(np.diag(self.unit_covariance))

    @property
    def _student(self) -> float:
        from scipy.stats import t

        return float(t.ppf(0.5 + LEVEL / 2, self.predicted.size - self.unit.size))
