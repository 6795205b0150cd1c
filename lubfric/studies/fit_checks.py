"""Whether a fit describes its data: the size of the residuals against the stated noise, and their signs and order."""

import math
from dataclasses import dataclass

import numpy as np

from .._base import FloatArray

# Probability of the residuals, if the fit describes the data, below which it is said not to.
SIGNIFICANCE = 0.01

# Random orders of the residuals, where these are too many for all orders; fixed, so that a fit is repeatable.
RANDOM_ORDERS = 9999

# Root mean square residual relative to f that the scatter of a measurement explains, where its deviations are not stated.
# A convention: friction on rigs repeats within some 5 to 10 %.
LARGEST_UNSTATED = 0.1

# Residuals below this multiple of the numerical error of f are no sign of anything.
ABOVE_NUMERICAL = 2.0


@dataclass(frozen=True, kw_only=True)
class ResidualTests:
    """What the residuals of a fit say of it. A probability is that of residuals such as these or farther off, if the
    fit describes the data; NaN where the test does not apply.

    Attributes
    ----------
    size : probability of the sum of squares by the stated deviations (chi-square with n - p degrees of freedom)
    times_stated : root mean square residual over the stated deviations, with n - p degrees of freedom
    runs : probability of so few runs of one sign over the measured range (Wald and Wolfowitz)
    order : probability that neighbouring residuals are so alike, among all orders of the residuals (von Neumann's
        ratio, by permutations)
    small : whether the residuals are within the numerical error of f, so that their signs mean nothing
    relative : root mean square residual relative to the measured f
    expected : root mean square model-form error of f at 95 %, relative; 0 where it is not known
    """

    size: float
    times_stated: float
    runs: float
    order: float
    small: bool
    relative: float = math.nan
    expected: float = 0.0

    @property
    def systematic(self) -> bool:
        """Whether the signs or the order of the residuals are not those of chance."""
        return not self.small and min(_known(self.runs), _known(self.order)) < SIGNIFICANCE

    @property
    def too_large(self) -> bool:
        """Whether the residuals are larger than the stated deviations allow."""
        return _known(self.size) < SIGNIFICANCE

    @property
    def too_far(self) -> bool:
        """Whether the residuals, of data without stated deviations, are more than the usual scatter of a measurement and
        more than the model-form error of f."""
        return math.isnan(self.size) and _known_error(self.relative) > max(LARGEST_UNSTATED, self.expected)

    @property
    def text(self) -> str:
        """What the tests found, in a sentence; "" if the fit describes the data as far as they show."""
        how = []
        if self.systematic:
            least, which = min((_known(self.runs), "signs"), (_known(self.order), "order"))
            how.append(f"the residuals are systematic (their {which} has a probability of {least:.1g} by chance)")
        if self.too_large:
            how.append(f"they are {self.times_stated:.2g} times as large as the stated deviations")
        if self.too_far:
            expected = f" and above the model-form error of f, {100 * self.expected:.2g} %" if self.expected else ""
            how.append(
                f"they are {100 * self.relative:.2g} % of f (root mean square), above the {100 * LARGEST_UNSTATED:g} % that "
                f"the scatter of a measurement explains{expected}"
            )
        if not how:
            return ""
        said = " and ".join(how) if self.systematic else how[0].replace("they are", "the residuals are")
        return (
            f"the fit does not describe the data: {said}. The intervals do not hold. Choose other parameters, wider "
            "bounds or another model, or check the data"
            + ("; state their deviations if they are known" if self.too_far else "")
        )


def residual_tests(
    x: np.ndarray,
    residuals: np.ndarray,
    parameters: int,
    numerical: np.ndarray,
    *,
    stated: bool,
    relative: float = math.nan,
    expected: float = 0.0,
) -> ResidualTests:
    """Return the tests of ``residuals`` (n,) over ``x`` (n,), left by a fit of so many ``parameters``.

    ``numerical`` (n,): numerical error of f in the unit of the residuals; ``stated``: whether the residuals are in
    stated deviations; ``relative`` and ``expected``: as in `ResidualTests`.
    """
    from scipy.stats import chi2

    order = np.argsort(x)
    freedom = residuals.size - parameters
    variance = 1.0 + numerical**2
    squares = float(np.sum(residuals**2 / variance))
    signs = residuals[order] > 0
    return ResidualTests(
        size=float(chi2.sf(squares, freedom)) if stated else math.nan,
        times_stated=math.sqrt(squares / freedom) if stated else math.nan,
        runs=probability_of_runs(signs),
        order=probability_of_order(residuals[order]),
        relative=relative,
        expected=expected,
        small=bool(np.sqrt(np.mean(residuals**2)) <= ABOVE_NUMERICAL * np.sqrt(np.mean(numerical**2))),
    )


def probability_of_runs(signs: np.ndarray) -> float:
    """Return the probability of as few runs of equal ``signs`` (n,) as these, or fewer, if all orders are alike.

    A. Wald and J. Wolfowitz, Ann. Math. Statist. 11 (1940) 147-162, doi:10.1214/aoms/1177731909.
    """
    positive = int(np.count_nonzero(signs))
    negative = signs.size - positive
    if not positive or not negative:
        return 1.0
    runs = 1 + int(np.count_nonzero(signs[1:] != signs[:-1]))
    ways = sum(_ways(count, positive, negative) for count in range(2, runs + 1))
    return ways / math.comb(signs.size, positive)


def _ways(runs: int, positive: int, negative: int) -> int:
    """Return the number of orders of so many signs with so many ``runs``."""
    half, odd = divmod(runs, 2)
    if not odd:
        return 2 * math.comb(positive - 1, half - 1) * math.comb(negative - 1, half - 1)
    more = math.comb(positive - 1, half) * math.comb(negative - 1, half - 1)
    return more + math.comb(positive - 1, half - 1) * math.comb(negative - 1, half)


def probability_of_order(residuals: np.ndarray) -> float:
    """Return the probability that the sum of the products of neighbouring ``residuals`` (n,) is as large as this one,
    if all orders of them are alike (J. von Neumann, Ann. Math. Statist. 12 (1941) 367-395)."""
    from scipy.stats import permutation_test

    def neighbours(values: np.ndarray, axis: int = -1) -> float | FloatArray:
        values = np.moveaxis(values, axis, -1)
        return np.sum(values[..., 1:] * values[..., :-1], axis=-1)

    if residuals.size < 4:
        return 1.0
    result = permutation_test(
        (residuals,),
        neighbours,
        permutation_type="pairings",
        alternative="greater",
        n_resamples=RANDOM_ORDERS,
        vectorized=True,
        random_state=np.random.default_rng(0),
    )
    return float(result.pvalue)


def _known(probability: float) -> float:
    """Return ``probability``, or 1 where it is not known."""
    return 1.0 if math.isnan(probability) else probability


def _known_error(error: float) -> float:
    """Return ``error``, or 0 where it is not known."""
    return 0.0 if math.isnan(error) else error


def root_mean_square(values: FloatArray) -> float:
    """Return the root mean square of ``values`` (n,)."""
    return float(np.sqrt(np.mean(np.square(values))))
