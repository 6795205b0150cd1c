"""What places of a strip rub at moments: the mean friction, and its standard error from blocks of time and place.

In a block both are long enough to be nearly independent of the next. Over the blocks friction is a linear function of
the control (`summits`) and of the load of the block, whose means on the infinite line contact are known; what is left
scatters by chance. So a part of a pass of the map shows its own error.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..shared import LEAST_FREEDOM, PLACE_BLOCK, SHARED_LENGTH, TIME_BLOCK, StandardError
from .summits import SummitControl

# Correlation length of friction over time without the part that the control explains, in half-widths of the Hertz strip
# [-]. A choice, a little less than the 1.5 half-widths of friction itself.
TIME_LENGTH = 1.3


class Places(NamedTuple):
    """f of a strip, and friction and load [N/m] of its places along y (ny,)."""

    coefficient: float
    friction: np.ndarray
    load: np.ndarray


@dataclass(frozen=True, kw_only=True)
class TimeAndPlace:
    """Numbers of moments that follow each other, at all places along y (n, ny).

    ``friction``, ``load``, ``contact_load``, ``couette`` [N/m]: the third of what rubs with f_b, the last of the film
    that the sliding shears; ``summits`` [m]: the control. ``travelled``: half-widths between two moments, of the film
    or the slowest rough body; ``spacing`` [m]: along y. ``mean_load`` [N/m]: of all places at every moment.
    """

    friction: np.ndarray
    load: np.ndarray
    contact_load: np.ndarray
    couette: np.ndarray
    summits: np.ndarray
    travelled: float
    spacing: float
    mean_load: float

    def half(self) -> "TimeAndPlace":
        """Return the first half of all places: of a mirrored map the others are the same once more."""
        kept = self.friction.shape[1] // 2
        return TimeAndPlace(
            friction=self.friction[:, :kept],
            load=self.load[:, :kept],
            contact_load=self.contact_load[:, :kept],
            couette=self.couette[:, :kept],
            summits=self.summits[:, :kept],
            travelled=self.travelled,
            spacing=self.spacing,
            mean_load=self.mean_load,
        )

    def places(self, moments: int) -> Places:
        """Return the means over the first ``moments``."""
        friction = self.friction[:moments].mean(axis=0)
        return Places(float(friction.mean()) / self.mean_load, friction, self.load[:moments].mean(axis=0))

    def block_counts(self, correlation_length: float) -> tuple[int, int]:
        """Return the numbers of blocks in time and along y, for a ``correlation_length`` [m] along y."""
        (moments, places) = self.friction.shape
        in_time = int(moments * self.travelled / TIME_BLOCK)
        along_y = int(places * self.spacing / (PLACE_BLOCK * correlation_length))
        return min(max(in_time, 1), moments), min(max(along_y, 1), places)

    def independence(self, correlation_length: float) -> float:
        """Return the variance of the mean over a block relative to that of independent ones (`block_error`)."""
        in_time, along_y = self.block_counts(correlation_length)
        way = self.friction.shape[0] // in_time * self.travelled / TIME_LENGTH
        width = self.friction.shape[1] // along_y * self.spacing / correlation_length
        # where a rough body rests, time is one block without neighbours, and all that scatters does so from place to
        # place
        of_time = max(1 - SHARED_LENGTH / way, 0.1) if way > 0 else 1.0
        return of_time * max(1 - SHARED_LENGTH / width, 0.1)


@dataclass(frozen=True)
class MeanOverBlocks:
    """A mean over blocks, relative to the load: its ``value`` at the control and load of the infinite line contact;
    ``plain``: without them; standard errors of both; ``correction``: what the control changed."""

    value: float
    error: StandardError
    plain: StandardError
    correction: float


def mean_over_blocks(
    samples: Sequence[TimeAndPlace], name: str, correlation_length: float, control: SummitControl | None
) -> MeanOverBlocks:
    """Return the mean of the field ``name`` of `TimeAndPlace` over ``samples``, and its standard error.

    ``correlation_length`` [m]: along y; ``control``: None, or one that is not known, is omitted.
    """
    rows = []
    places = 0
    for sample in samples:
        load = sample.mean_load
        counts = sample.block_counts(correlation_length)
        blocks = [_block_means(field, counts) for field in (getattr(sample, name), sample.summits, sample.load)]
        rows.append(np.array([blocks[0] / load, blocks[1], blocks[2] / load - 1]))
        places += sample.friction.size
    values, summits, loads = np.concatenate(rows, axis=1)
    mean = sum(float(getattr(sample, name).sum()) / sample.mean_load for sample in samples) / places
    independence = samples[0].independence(correlation_length)
    columns = [np.ones_like(values), loads]
    plain = _residual(values, columns, independence)
    if control is None or not control.is_known:
        return MeanOverBlocks(mean, plain, plain, 0.0)
    columns.append((summits - control.mean) / control.threshold)
    residual = _residual(values, columns, independence)
    slope = float(_fitted(values, columns)[-1])
    excess = sum(float(sample.summits.sum()) for sample in samples) / places - control.mean
    correction = -slope * excess / control.threshold
    of_mean = slope * control.error / control.threshold
    error = StandardError(math.hypot(residual.value, of_mean), residual.freedom)
    return MeanOverBlocks(mean + correction, error, plain, correction)


def least_blocks(control: SummitControl | None) -> int:
    """Return the number of blocks below which the standard error of a mean over them is not known, with this
    ``control``."""
    return LEAST_FREEDOM + (2 if control is None or not control.is_known else 3)


def _block_means(field: np.ndarray, counts: tuple[int, int]) -> np.ndarray:
    """Return the means of ``field`` (n, ny) over blocks of equal size; a remainder at the ends is omitted."""
    in_time, along_y = counts
    moments = field.shape[0] // in_time
    places = field.shape[1] // along_y
    kept = field[: in_time * moments, : along_y * places]
    return kept.reshape(in_time, moments, along_y, places).mean(axis=(1, 3)).ravel()


def _fitted(values: np.ndarray, columns: Sequence[np.ndarray]) -> np.ndarray:
    factors, *_ = np.linalg.lstsq(np.stack(columns, axis=1), values, rcond=None)
    return factors


def _residual(values: np.ndarray, columns: Sequence[np.ndarray], independence: float) -> StandardError:
    """Return the standard error of the mean of ``values`` that a linear function of ``columns`` leaves."""
    freedom = values.size - len(columns)
    if freedom < LEAST_FREEDOM:
        return StandardError(math.inf, 0)
    left = values - np.stack(columns, axis=1) @ _fitted(values, columns)
    return StandardError(math.sqrt(float(left @ left) / (freedom * values.size * independence)), freedom)
