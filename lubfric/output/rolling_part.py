"""The part of the power loss that is rolling resistance, in tables of points."""

import numpy as np

from .._base import FloatArray
from ..units import printed
from .markup import number_or_dash

# Part of the power loss above which a table of points states the rolling resistance in it. A choice: below it the loss
# follows from f, load and sliding speed to within a digit.
TABLED_ROLLING_PART = 0.1

# Part of the power loss from which the rolling resistance in it is named, and has three digits in a table. A choice: what a
# number of two digits shows.
SMALL_ROLLING_PART = 0.01

# What a rolling part below 0 is.
NEGATIVE_ROLLING_PART = (
    "A rolling resistance below 0 is that of one sample of the surface: asperity contacts of roughness at rest add a part "
    "of either sign, which is 0 on average."
)


def rolling_part(rolling_resistance: FloatArray | float, speed: FloatArray | float) -> FloatArray:
    """Return the part of the power loss [W] that is rolling resistance, at points with the ``rolling_resistance`` [N]
    of both surfaces and the entrainment ``speed`` [m/s], (n,) or of one point; the other part is the work of shear."""
    return np.asarray(rolling_resistance * np.abs(speed))


def is_tabled(rolling: FloatArray, power_loss: FloatArray) -> bool:
    """Return whether the ``rolling`` part [W] is more than `TABLED_ROLLING_PART` of the ``power_loss`` [W] anywhere."""
    return bool((rolling > TABLED_ROLLING_PART * np.abs(power_loss)).any())


def cells_of_rolling(rolling: FloatArray, power_loss: FloatArray) -> list[str]:
    """Return the texts of cells of the ``rolling`` part, (n,), in the unit of the ``power_loss``: to three digits, or
    two where it is a small part of the loss; "-" where it is not known."""
    are_small = np.abs(rolling) < SMALL_ROLLING_PART * np.abs(power_loss)
    cells = zip(rolling.tolist(), are_small.tolist())
    return [number_or_dash(part, 2 if is_small else 3) for part, is_small in cells]


def negative_in_words(rolling: FloatArray) -> str:
    """Return what a ``rolling`` part below 0 is, in a sentence; "" where there is none."""
    return NEGATIVE_ROLLING_PART if (rolling < 0).any() else ""


def heading_of_rolling(unit: str) -> str:
    """Return the heading of the column of rolling resistance in a ``unit``, after that of the power loss."""
    return f"part of P by rolling resistance [{printed(unit)}]"
