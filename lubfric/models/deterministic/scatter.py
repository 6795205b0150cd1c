"""How strips scatter: f of strips at rest between them and along them, with or without a control, and the moments and
places of moving ones."""

import math
from collections.abc import Sequence

import numpy as np

from ...samples import Sample
from ..shared import ControlVariate, StandardError, block_error
from .strip_on_two_grids import StripOnTwoGrids
from .time_and_place import TimeAndPlace

# The comments state how results change with half and with twice the value of a constant, on three points of the scene
# "paper" (`python -m verification.campaigns.constants lubfric.models.deterministic.scatter`).

# Scatter of the deterministic f between strips over that of blocks [-], without a control variate. From the first
# campaigns of strips, whose numbers are not kept; half and twice change nothing there.
STRIP_OVER_BLOCKS = 1.3

# Scatter between strips, over that of blocks, of the difference of f from the control [-]. From the same campaigns;
# with it the stated sampling error is 1.06 times the scatter of 200 surfaces in mixed lubrication
# (docs/measurements.md, answers-seeds). Half this value narrows the interval by 32 %, twice this value takes twice the
# time.
DIFFERENCE_OVER_BLOCKS = 1.2

# Weight of the scatter of blocks, as a number of strips, where it is pooled with the scatter between strips [-]. Half
# this value changes the interval by .4 %, twice this value takes a third more time.
PRIOR = 3

# Degrees of freedom of the scatter of blocks, at most [-]: blocks of one strip are not independent of each other. Half
# this value takes 39 % more time, twice this value narrows the interval by 8 %.
FREEDOM = 5

# Fewest strips whose scatter gives an error [-]: two degrees of freedom. A convention.
STRIPS_FOR_SCATTER = 3


def samples_over_time(pairs: Sequence[StripOnTwoGrids]) -> list[TimeAndPlace]:
    """Return what the places of strips rub at moments, of those ``pairs`` whose roughness moves; of a mirrored map one
    half."""
    samples = []
    for pair in pairs:
        places = pair.resolved.places_over_time
        if places is not None:
            samples.append(places.half() if pair.is_mirrored else places)
    return samples


def scatter_of_f(
    pairs: Sequence[StripOnTwoGrids], sample: Sample, control: ControlVariate | None = None, share: float = 0.0
) -> StandardError:
    """Return the standard error of the mean over ``pairs`` of f by the deterministic model less ``share`` times the
    differences of these strips by the ``control``. (The pairs are n of the N strips of the line. As Eq. (8) on the
    pairs is part of that on the line, the whole sum scatters with the factor 1 - n/N.)

    Strips show their scatter themselves, but few of them badly. Blocks within them show it at once, but off by up to a
    factor of two. So the variances of both are pooled, that of blocks with the weight of `PRIOR` strips. If windows of
    a measured map scatter more, their own scatter counts.
    """
    count = len(pairs)
    places = [pair.resolved.deviations for pair in pairs]
    f = np.array([pair.resolved.result.coefficient for pair in pairs])
    if control is not None:
        places = [values - share * control.deviations(k, values.size) for k, values in enumerate(places)]
        f -= share * control.numbers["coefficient"][:count]
    within = error_by_blocks(places, sample, pairs[0])
    by_blocks = count * (within.value * (DIFFERENCE_OVER_BLOCKS if control else STRIP_OVER_BLOCKS)) ** 2
    if count == 1:
        return StandardError(math.sqrt(by_blocks), min(within.freedom, FREEDOM))
    by_strips = float(np.var(f, ddof=1))
    if not math.isfinite(by_blocks):  # a short strip has no blocks
        return StandardError(math.sqrt(by_strips / count), count - 1)
    pooled = (PRIOR * by_blocks + (count - 1) * by_strips) / (PRIOR + count - 1)
    if not sample.is_homogeneous and count >= STRIPS_FOR_SCATTER and by_strips > pooled:
        return StandardError(math.sqrt(by_strips / count), count - 1)
    return StandardError(math.sqrt(pooled / count), FREEDOM + count - 1)


def error_by_blocks(values: Sequence[np.ndarray], sample: Sample, pair: StripOnTwoGrids) -> StandardError:
    """Return the standard error of the mean of ``values`` along strips such as ``pair``; of a mirrored map only half
    counts."""
    kept = values[0].size // (2 if pair.is_mirrored else 1)
    places = np.concatenate([one[:kept] for one in values])
    return block_error(places, pair.resolved.problem.spacing[1], sample.correlation_lengths[1])
