"""Standard errors of means along a line, and the number of strips that a standard error needs."""

import math
from dataclasses import dataclass

import numpy as np

from ..._base import FloatArray

# Mean square of the change of the heights over two cells, over that over one, of smooth heights, at least: 4 of a
# parabola, 2 of an exponential autocorrelation. A choice between them.
SMOOTH_RATIO = 3.0

# Blocks of a line, at most. The constants of this module are judged by the coverage of the 95 % intervals (`python -m
# verification sampling`, docs/measurements.md: 91 to 99 %); `python -m verification.campaigns.constants` halves and
# doubles each. Twice as many change the width of an interval by 1 %.
MOST_BLOCKS = 32

# Blocks of the wanted length; a line with fewer is cut into shorter ones. A choice, judged as `MOST_BLOCKS`.
ENOUGH_BLOCKS = 8

# Blocks, below which the error is not known: four degrees of freedom. A choice, judged as `MOST_BLOCKS`.
LEAST_BLOCKS = 5

# Correlation lengths along y in a block, wanted: neighbouring blocks share 6 % of their variance (`SHARED_LENGTH`). A
# choice: longer blocks are fewer.
WANTED_BLOCK_LENGTH = 9.0

# Correlation lengths along y in a block, at least: neighbouring blocks share 11 % of their variance (`SHARED_LENGTH`).
# A choice: longer blocks are fewer.
LEAST_BLOCK_LENGTH = 5.0

# Half-widths that roughness and film travel in a block, at least. At one place friction has a correlation over time of
# exp(-(s/1.5 b)²) (needle roller, lambda ratio 0.5), with s the way travelled. A choice: twice that measured length;
# shorter blocks depend on one another.
TIME_BLOCK = 3.0

# Correlation lengths along y in a block of moving roughness, at least. A choice: shorter blocks depend on one another,
# longer ones are too few.
PLACE_BLOCK = 4.0

# Degrees of freedom below which the error is not known. A choice: Student's t is 2.8 there, and grows fast below.
LEAST_FREEDOM = 4

# Correlation lengths of a block that are as those of its neighbour: ∫ |y| exp(-y²) dy/∫ exp(-y²) dy, of a Gaussian
# correlation. It follows from these integrals.
SHARED_LENGTH = 1 / math.sqrt(math.pi)

# Factor on the number of strips that an error needs, because this error is itself known to 1/sqrt(2 nu) only. A choice,
# judged as `MOST_BLOCKS`.
STRIPS_SAFETY = 1.3

# Factor by which a sample grows, at least: fewer new strips tell little that is new. Half and twice this value change
# nothing (constants.csv).
LEAST_GROWTH = 1.5

# Sampling error over its target, above which it misses the target [-]: a standard error of a few strips is itself not
# known to 5 %. A choice: a smaller value states what is no difference.
SAMPLING_ERROR_MISSED = 1.05

# Factors by which a sample grows, at most: the first one, and a longer one. A standard error from few blocks is no
# guide further. A choice: a larger value may solve strips in vain, a smaller one takes more rounds. Half and twice this
# value change f by up to 1.3 % and the work by up to 13 % (constants.csv).
SAMPLE_GROWTH = 4.0, 8.0

# Confidence of the intervals. A convention (GUM, as in docs/uncertainty.md).
CONFIDENCE = 0.95

# Degrees of freedom of an error that is not counted from blocks: Student's t is then 2.04 for 1.96. A choice: a smaller
# value widens intervals, by 4 % here. Half and twice this value change f by less than .01 % and the work by less than 1
# % (constants.csv).
FREEDOM_NOT_COUNTED = 30

# Effective asperity contacts below which an interval covers less often than it states: 91.5 % at 55 N
# (docs/measurements.md, `python -m verification sampling`).
FEW_CONTACTS = 10.0

# Part of the sampling tolerance below which an error needs no more asperity contacts. Half and twice this value change
# nothing on the points of the campaign above.
SAMPLING_MATTERS = 0.25


@dataclass(frozen=True)
class StandardError:
    """Standard error of a mean over blocks: its ``value``, in the unit of what is averaged, and its degrees of
    freedom."""

    value: float
    freedom: int

    @property
    def cautious(self) -> float:
        """1 + 1/sqrt(nu) times the value, with nu degrees of freedom: from few blocks it is itself known to 1/sqrt(2
        nu) only."""
        return self.value * (1 + 1 / math.sqrt(self.freedom)) if self.freedom > 0 else self.value


def block_error(
    values: np.ndarray, step: float, correlation_length: float, exact: FloatArray | None = None
) -> StandardError:
    """Return the standard error of the mean of ``values`` (ny,), on cells of ``step`` [m], from block means.

    It is s/sqrt(n (1 - 0.56/b)) with n = 8 to 32 blocks, each at least b = 9 correlation lengths [m] long. If the line
    is too short for eight of these, 5 to 8 blocks of five lengths are taken. A remainder shorter than a block is
    omitted. If the line is shorter still, the error is infinite, with no degree of freedom.

    Neighbouring blocks are alike near their common end, and so scatter less than independent ones. For values with the
    correlation exp(-(y/l)²), the variance of a mean over b l is smaller than that of an infinite line contact by the
    fraction int |y| exp(-y²) dy / int exp(-y²) dy / b = 1/(sqrt(pi) b).

    ``exact`` (ny,): a quantity of every place whose mean over the line is known exactly. Scatter that the blocks share
    with it is no error: s is then that of the residuals of a straight line through the blocks.
    """
    count = min(MOST_BLOCKS, int(values.size * step / (WANTED_BLOCK_LENGTH * correlation_length)))
    count = max(count, min(ENOUGH_BLOCKS, int(values.size * step / (LEAST_BLOCK_LENGTH * correlation_length))))
    count = min(count, values.size)
    if count < LEAST_BLOCKS:
        return StandardError(math.inf, 0)
    means = means_of_blocks(values, count)
    freedom = count - 1
    if exact is not None:
        known = means_of_blocks(exact, count)
        known -= known.mean()
        if (square := float(known @ known)) > 0:
            means = means - known * (float(known @ means) / square)
            freedom = count - 2
    square = float(np.sum((means - means.mean()) ** 2))
    length = values.size // count * step / correlation_length
    return StandardError(math.sqrt(square / (freedom * count * (1 - SHARED_LENGTH / length))), freedom)


def means_of_blocks(values: FloatArray, count: int) -> FloatArray:
    """Return the means of ``values`` over ``count`` blocks of equal length; a remainder at the end is omitted."""
    size = values.size // count
    means: FloatArray = values[: size * count].reshape(count, size).mean(axis=1)
    return means


def add_errors(*parts: StandardError) -> StandardError:
    """Return the error of a sum of independent quantities. The degrees of freedom are by Welch and Satterthwaite (F. E.
    Satterthwaite, Biometrics Bull. 2 (1946) 110-114, doi:10.2307/3002019)."""
    terms = [(part.value**2, part.freedom) for part in parts]
    variance = sum(v for v, _ in terms)
    if variance == 0 or not math.isfinite(variance):
        return StandardError(math.sqrt(variance), sum(f for _, f in terms))
    return StandardError(math.sqrt(variance), int(variance**2 / sum(v**2 / max(f, 1) for v, f in terms)))


def strips_for_error(
    error: StandardError,
    target: float,
    *,
    count: int,
    first: int,
    available: int,
    at_least: float = 0.0,
    growth: tuple[float, float] = SAMPLE_GROWTH,
    spare: tuple[float, float] = (STRIPS_SAFETY, LEAST_GROWTH),
) -> int:
    """Return how many strips bring a standard ``error`` on ``count`` of them within ``target``, as it falls with the
    root of their number: ``count`` if it is within.

    Parameters
    ----------
    first, available : number of strips that are solved first, and that there are
    at_least : factor on ``count`` that is needed for another reason; 0: none
    growth : largest factor on ``count``, of the ``first`` strips and of more
    spare : factor on what the error needs, and least factor on ``count``

    If a sample counted as long enough whenever its blocks happen to scatter little, the stated error would be too
    small. So the first strips count as enough only if even their `StandardError.cautious` error is within the target.
    """
    reached = error.cautious if count == first else error.value
    if reached <= target and not at_least:
        return count
    most = growth[1] if count > first else growth[0]
    times = spare[0] * max((reached / target) ** 2, at_least) if math.isfinite(reached) else most
    return min(available, math.ceil(min(max(times, spare[1]), most) * count - 1e-9))


def area_needed(error: float, target: float, *, has_ended: bool) -> float:
    """Return how many times the area of a surface brings a standard ``error`` on it within ``target``, as it falls with
    the root of the area: 1 where it is within, or where the surface has not ended; NaN where the error is not known."""
    if not has_ended:
        return 1.0
    return max((error / target) ** 2, 1.0) if math.isfinite(error) else math.nan


def has_too_few_contacts(effective_contacts: float, reached: float, target: float) -> bool:
    """Return whether so few asperity contacts carry the load that an interval is too narrow more often than it says,
    and the standard error ``reached`` is not small compared with ``target``. 0 contacts: nothing touches."""
    return 0 < effective_contacts < FEW_CONTACTS and reached > SAMPLING_MATTERS * target


def student(freedom: float) -> float:
    """Return the 97.5 % quantile of Student's t."""
    from scipy.special import stdtrit

    return float(stdtrit(max(freedom, 1.0), 0.5 + 0.5 * CONFIDENCE))


def half_width_of_error(error: float, freedom: float) -> float:
    """Return half of the width of the 95 % interval by a standard ``error`` of ``freedom`` degrees: Student's t times
    the error; 0 without one, whatever the freedom."""
    return student(freedom) * error if error else error


def ratio_of_changes(last: float, before: float, bounds: tuple[float, float], unknown: float) -> float:
    """Return the ratio with which the changes from grid to grid go on: that of the ``last`` one to the one ``before``,
    within ``bounds``; ``unknown`` where there is none before, or it is 0."""
    (least, most) = bounds
    return min(max(last / before, least), most) if before > 0 else unknown


def is_smooth_over_cells(heights: FloatArray) -> bool:
    """Return whether ``heights`` (nx, ny) are smooth over a cell along y: over two cells they change twice as much as
    over one. Of an exponential autocorrelation it is sqrt(2), and one change of f by shorter cells says nothing of the
    next."""
    one, two = (float(np.mean(np.square(heights - np.roll(heights, k, axis=1)))) for k in (1, 2))
    return two >= SMOOTH_RATIO * one
