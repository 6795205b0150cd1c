"""Whether a fit describes its data: the size of the residuals against the stated noise, their order, and whether an
offset or a factor of the measured f would explain them.

The residuals of a fit are not independent: what its parameters can follow is taken out of them. So the probabilities
are those among residuals of random noise from which the same parameters take out the same, to first order.
"""

import math
from dataclasses import dataclass

import numpy as np

from .._base import FloatArray

# Probability of the residuals, if the fit describes the data, below which it is said not to. A convention.
SIGNIFICANCE = 0.01

# Probability by chance below which the residuals are said not to be random, and the fit perhaps not to describe the
# data. A convention.
DOUBTED = 0.05

# Random residuals with which those of a fit are compared; fixed, so that a fit is repeatable. A choice: a probability
# of .01 is known to 10 % from them.
RANDOM_RESIDUALS = 9999

# Probability of residuals that is stated as that or less. A choice: smaller ones are not known from so many.
RAREST = 1e-3

# Numbers in these, at most: more points are compared with fewer. A choice, for memory.
MOST_NUMBERS = 5_000_000

# Fewest points of which the order is tested. A choice: fewer have no order.
FEWEST_OF_ORDER = 4

# Smallest part of the column of an offset or a factor that the parameters leave: below it they stand for it. A choice:
# a smaller value tests columns of rounding.
LEAST_REST = 1e-3

# Share of the sum of squares from which an offset or a factor is said to explain the residuals. A convention.
EXPLAINING = 0.5

# Difference of the shares that an offset and a factor explain, below which either may be the cause. A convention.
AS_LIKELY = 0.1

# Root mean square residual relative to f that the scatter of a measurement explains, where its deviations are not
# stated. A convention: friction on rigs repeats within some 5 to 10 %.
LARGEST_UNSTATED = 0.1

# Residuals below this multiple of the numerical error of f are no sign of anything. A choice: twice.
ABOVE_NUMERICAL = 2.0


@dataclass(frozen=True, kw_only=True)
class ResidualTests:
    """What the residuals of a fit say of it. A probability is that of residuals such as these or farther off, if the
    fit describes the data; NaN where the test does not apply.

    Attributes
    ----------
    size : probability of the sum of squares by the stated deviations (chi-square with n - p degrees of freedom)
    times_stated : root mean square residual over the stated deviations, with n - p degrees of freedom
    order : probability that neighbouring residuals are so alike (von Neumann's ratio)
    shape : probability that a constant offset and a factor of the measured f explain so much of them (F test)
    chance : probability of the clearest sign, of order, shape or both together
    offset : the constant offset of the measured f that makes the sum of squares least, to first order [-]
    explained : share of the sum of squares that this offset explains
    factor, explained_by_factor : the factor of the measured f that does so [-], and the share that it explains
    small : whether the residuals are within the numerical error of f, so that their order means nothing
    relative : root mean square residual relative to the measured f
    expected : root mean square model-form error of f at 95 %, relative; 0 where it is not known
    """

    size: float
    times_stated: float
    order: float
    shape: float
    chance: float
    offset: float
    explained: float
    small: bool
    relative: float = math.nan
    expected: float = 0.0
    factor: float = math.nan
    explained_by_factor: float = math.nan

    @property
    def systematic(self) -> bool:
        """Whether the residuals are not those of chance, at 1 %."""
        return not self.small and _known(self.chance) < SIGNIFICANCE

    @property
    def doubtful(self) -> bool:
        """Whether the residuals are not those of chance at 5 %, but may be at 1 %."""
        return not self.small and SIGNIFICANCE <= _known(self.chance) < DOUBTED

    @property
    def too_large(self) -> bool:
        """Whether the residuals are larger than the stated deviations allow."""
        return _known(self.size) < SIGNIFICANCE

    @property
    def too_far(self) -> bool:
        """Whether the residuals, of data without stated deviations, are more than the usual scatter of a measurement
        and more than the model-form error of f."""
        return math.isnan(self.size) and _known_error(self.relative) > max(LARGEST_UNSTATED, self.expected)

    @property
    def describes(self) -> bool:
        """Whether the fit describes the data as far as the tests show."""
        return not (self.systematic or self.too_large or self.too_far)

    @property
    def reason(self) -> str:
        """Why the fit does not describe the data; "" if it does as far as the tests show."""
        how = []
        if self.systematic:
            how.append(f"the residuals are systematic: {self._rarity}{self._cause}")
        subject = "they are" if self.systematic else "the residuals are"
        if self.too_large:
            how.append(f"{subject} {self.times_stated:.2g} times as large as the stated deviations")
        if self.too_far:
            expected = f" and above the model-form error of f, {100 * self.expected:.2g} %" if self.expected else ""
            how.append(
                f"{subject} {100 * self.relative:.2g} % of f (root mean square), above the {100 * LARGEST_UNSTATED:g} "
                f"% that the scatter of a measurement explains{expected}"
            )
        return "; and ".join(how)

    @property
    def text(self) -> str:
        """The `reason`, what that means and what to do, in sentences; "" if the fit describes the data as far as the
        tests show."""
        if self.describes:
            return ""
        head = f"the fit does not describe the data: {self.reason}. The intervals are not valid"
        if self.is_within_model:
            return f"{head}. {self.model_as_cause}"
        advice = "Choose other parameters, wider bounds or another model, or check the data"
        return f"{head}. {advice}" + ("; state their deviations if they are known" if self.too_far else "")

    @property
    def is_within_model(self) -> bool:
        """Whether the residuals of a fit that does not describe the data are within the model-form error of f."""
        return not self.describes and self.relative <= self.expected

    @property
    def model_as_cause(self) -> str:
        """That the model-form error may cause residuals that are within it, and what to do, in sentences."""
        return (
            f"The residuals, {100 * self.relative:.2g} % of f, are within the model-form error of f, "
            f"{100 * self.expected:.2g} % (both root mean square): the error of the model may cause them, with right "
            "data and parameters. Fit by a model with a smaller error (numerics.model), and with other samples of "
            "the surface (surface.seed)"
        )

    @property
    def note(self) -> str:
        """What the test of the order and the shape of the residuals found, where the fit describes the data."""
        if not self.describes or math.isnan(self.chance):
            return ""
        if self.small:
            return "the residuals are within the numerical error of f"
        if self.doubtful:
            return (
                f"the residuals may be systematic: {self._rarity}{self._cause}. The fit may not describe the data "
                "then, and the intervals, which assume random scatter, may be too narrow"
            )
        return (
            "the residuals look like random scatter, which the intervals assume: neither their order nor an offset or "
            "a factor of the measured f shows a systematic deviation"
        )

    @property
    def _rarity(self) -> str:
        """How often random scatter leaves residuals as regular as these, in a sentence."""
        if self.chance <= RAREST:
            return f"random scatter leaves residuals as regular in fewer than 1 of {1 / RAREST:.0f} measurements"
        return (
            f"random scatter leaves residuals as regular in about 1 of {float(f'{1 / self.chance:.1g}'):.0f} "
            "measurements"
        )

    @property
    def _cause(self) -> str:
        """What explains the residuals, to be appended; "" if nothing is known."""
        if _known(self.shape) >= DOUBTED:
            return ""
        causes = {
            f"an offset of the measured f, of the order of {self.offset:.1g},": self.explained,
            f"a factor of the measured f, of the order of {self.factor:.2g},": self.explained_by_factor,
        }
        known = {cause: share for cause, share in causes.items() if share > EXPLAINING}
        likely = {cause: share for cause, share in known.items() if share > max(known.values()) - AS_LIKELY}
        ways = [f"{cause} would explain {100 * share:.0f} % of their squares" for cause, share in likely.items()]
        return "".join(f"; {way}" for way in (", or ".join(ways),) if way)


def residual_tests(
    x: FloatArray,
    residuals: FloatArray,
    jacobian: FloatArray,
    numerical: FloatArray,
    *,
    stated: bool,
    fitted: FloatArray | None = None,
    scale: FloatArray | None = None,
    relative: float = math.nan,
    expected: float = 0.0,
) -> ResidualTests:
    """Return the tests of ``residuals`` (n,) over ``x`` (n,).

    Parameters
    ----------
    jacobian : of the residuals by the parameters, (n, p)
    numerical : numerical error of f in the unit of the residuals, (n,)
    stated : whether the residuals are in stated deviations
    fitted : f of the fit, (n,); None: 1
    scale : what its residuals are divided by, (n,); None: 1. The measured f itself must not be: it holds the noise
    relative, expected : as in `ResidualTests`
    """
    from scipy.stats import chi2

    count = residuals.size
    along = np.argsort(x, kind="stable")
    freedom = max(count - jacobian.shape[1], 1)
    squares = float(np.sum(residuals**2 / (1.0 + numerical**2)))
    per_offset = np.ones(count) if scale is None else 1.0 / scale
    per_factor = per_offset if fitted is None else fitted * per_offset
    error = float(np.sqrt(np.sum(numerical**2)))
    axes = _axes_of(jacobian[along], error)
    both = np.stack([per_offset, per_factor], axis=1)[along]
    order, shape, chance = chance_of(residuals[along], axes, _new_axes(both, axes))
    offset, explained = _shift(residuals[along], axes, per_offset[along])
    more, explained_by_factor = _shift(residuals[along], axes, per_factor[along])
    is_factor_apart = fitted is not None  # else it is the offset once more
    return ResidualTests(
        size=float(chi2.sf(squares, freedom)) if stated else math.nan,
        times_stated=math.sqrt(squares / freedom) if stated else math.nan,
        order=order,
        shape=shape,
        chance=chance,
        offset=offset,
        explained=explained,
        factor=1.0 + more if is_factor_apart else math.nan,
        explained_by_factor=explained_by_factor if is_factor_apart else math.nan,
        relative=relative,
        expected=expected,
        small=bool(np.sqrt(np.mean(residuals**2)) <= ABOVE_NUMERICAL * np.sqrt(np.mean(numerical**2))),
    )


def chance_of(residuals: FloatArray, axes: FloatArray, further: FloatArray) -> tuple[float, float, float]:
    """Return the probabilities of the order of ``residuals`` (n,), of what ``further`` axes explain of them, and of
    both.

    They are those among random residuals (normal, alike at all points) without what the parameters follow: the order by
    the sum of the products of neighbours over the sum of squares (J. von Neumann, Ann. Math. Statist. 12 (1941)
    367-395, doi:10.1214/aoms/1177731677), and the further axes by the F test of two nested models. The probability of
    both is that of the least of three: these two, and that of their product (R. A. Fisher), so that neither one clear
    sign nor two weak ones are missed. The distribution of this least is that among the random residuals as well, as the
    three are not independent.

    Parameters
    ----------
    residuals : in the order of the measurement's axis, (n,)
    axes : orthonormal, of what the parameters follow, (n, p)
    further : orthonormal and normal to ``axes``: of what else may explain the residuals, (n, q); q = 0: not tested

    Returns NaN for what cannot be tested.
    """
    from scipy.stats import f, rankdata

    count = residuals.size
    left = count - axes.shape[1] - further.shape[1]
    if count < FEWEST_OF_ORDER or count <= axes.shape[1] + 1:
        return math.nan, math.nan, math.nan
    draws = min(RANDOM_RESIDUALS, MOST_NUMBERS // count)
    random = np.random.default_rng(0).standard_normal((draws, count))
    every = np.concatenate([residuals[None, :], random])
    every -= (every @ axes) @ axes.T
    squares = np.sum(every**2, axis=1)
    if not squares[0] > 0.0:
        return math.nan, math.nan, math.nan
    alike = np.sum(every[:, 1:] * every[:, :-1], axis=1) / squares
    of_order = rankdata(-alike, method="max") / every.shape[0]
    if not further.shape[1] or left < 1:
        return float(of_order[0]), math.nan, float(of_order[0])
    explained = np.sum((every @ further) ** 2, axis=1) / squares
    ratio = explained / further.shape[1] / np.maximum((1.0 - explained) / left, np.finfo(float).tiny)
    of_shape = f.sf(ratio, further.shape[1], left)
    product = np.log(of_order) + np.log(np.maximum(of_shape, np.finfo(float).tiny))
    of_product = rankdata(product, method="max") / every.shape[0]
    least = np.minimum.reduce([of_order, of_shape, of_product])
    chance = float(np.mean(least <= least[0]))
    return float(of_order[0]), float(of_shape[0]), chance


def _axes_of(jacobian: FloatArray, error: float) -> FloatArray:
    """Return orthonormal axes, (n, q), of what the parameters change of the residuals over their bounds by more than
    ``error``."""
    axes, singular, _ = np.linalg.svd(jacobian, full_matrices=False)
    return np.asarray(axes[:, singular > max(error, 1e-8 * singular.max(initial=0.0))])


def _new_axes(columns: FloatArray, axes: FloatArray) -> FloatArray:
    """Return orthonormal axes of ``columns`` (n, m) without ``axes`` (n, p) and without what is next to them."""
    columns = columns / np.linalg.norm(columns, axis=0)
    left = columns - axes @ (axes.T @ columns)
    new, singular, _ = np.linalg.svd(left, full_matrices=False)
    return np.asarray(new[:, singular > LEAST_REST])


def _shift(residuals: FloatArray, axes: FloatArray, column: FloatArray) -> tuple[float, float]:
    """Return by how many times the ``column`` (n,), of an offset of the measured f or of its relative change, the sum
    of the squared ``residuals`` becomes least, with the parameters moved along to first order, and the share of the sum
    that this explains; NaN where the parameters stand for it."""
    left = column - axes @ (axes.T @ column)
    length = float(np.linalg.norm(left))
    own = residuals - axes @ (axes.T @ residuals)
    squares = float(own @ own)
    if length <= LEAST_REST * float(np.linalg.norm(column)) or squares == 0.0:
        return math.nan, math.nan
    along = float(left @ own) / length
    return -along / length, along**2 / squares


def _known(probability: float) -> float:
    """Return ``probability``, or 1 where it is not known."""
    return 1.0 if math.isnan(probability) else probability


def _known_error(error: float) -> float:
    """Return ``error``, or 0 where it is not known."""
    return 0.0 if math.isnan(error) else error


def root_mean_square(values: FloatArray) -> float:
    """Return the root mean square of ``values`` (n,)."""
    return float(np.sqrt(np.mean(np.square(values))))
