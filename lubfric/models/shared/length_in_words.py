"""What half or twice the correlation length of generated roughness changes, beside the interval of f, in words."""

from collections.abc import Sequence

from ...units import plain_number
from .unmodelled import BY_LENGTH, UnmodelledEffect

# Solved change of f by another correlation length over that of closed forms that is taken into account [-]: of 50 solved
# changes above 5 % (`LOAD_RATIO_BY_LENGTH`), 39 are at most so many times as large. A choice.
POSSIBLE_OVER_ESTIMATED = 2.0


def length_beside_interval(
    effects: Sequence[UnmodelledEffect], coefficient: float, interval: tuple[float, float]
) -> str:
    """Return what f would be with half and twice the correlation length, and what to give, in a few words beside its
    ``interval``; "" where none of the ``effects`` at f = ``coefficient`` may be larger than half the width of the
    interval, and where it is not estimated."""
    half_width = 0.5 * (interval[1] - interval[0])
    for effect in effects:
        change = POSSIBLE_OVER_ESTIMATED * effect.largest_change * abs(coefficient)
        if effect.kind == BY_LENGTH and change > half_width:
            (half, twice) = (plain_number((1.0 + each) * coefficient) for each in effect.changes)
            return (
                "f depends on the correlation length, which no drawing states: half of it gives about "
                f"{half}, twice about {twice}, by closed forms (each change of f to a factor of about two); give a "
                "measured map, or surface.correlation_length = [value, low, high]"
            )
    return ""
