"""How a sheared fluid resists a pressure flow: the fluidity between two cells, and its change by the sliding.

The pressure flow through a face is ``-rho h³/(12 eta) Φ dp/dx``. 1/eta is averaged over the pressures between the two
cells, so that the flow follows the reduced pressure ∫ dp/eta. Φ >= 1 is the factor by which the sliding thins the
fluid, by its shear laws (`lubfric.oil.shear_laws`) at s = eta Δu/(h tau_c). What two laws add to 1 is added.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..._base import FloatArray
from ...oil import Lubricant, density_ratio, log_viscosity_ratio

# Largest ln(eta/eta0) [-]: beyond it the film is not distinguished from a solid. A choice, below the largest exponent
# of double precision, 709.
THICKEST = 300.0


@dataclass(frozen=True, kw_only=True)
class CellFluid:
    """The laws at the pressures of the cells: ln(eta/eta0), rho/rho0, and their derivatives by p [1/Pa]; of each shear
    law tau_c [Pa] and its derivative [-], numbers if that is 0."""

    log_viscosity: np.ndarray
    log_slope: np.ndarray
    density: np.ndarray
    density_slope: np.ndarray
    critical: tuple[Any, ...]


def cell_fluid(lubricant: Lubricant, pressure: FloatArray) -> CellFluid:
    """Return the laws of ``lubricant`` at ``pressure`` [Pa], any shape."""
    log_viscosity, log_slope = log_viscosity_ratio(lubricant, pressure)
    density, density_slope = density_ratio(lubricant, pressure)
    critical = tuple(law.critical(pressure) for law in lubricant.shear_laws)
    return CellFluid(
        log_viscosity=np.minimum(log_viscosity, THICKEST),
        log_slope=log_slope,
        density=density,
        density_slope=density_slope,
        critical=critical,
    )


def mean_fluidity(left: FloatArray, right: FloatArray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return ln of the mean of exp(-l) between l = ``left`` and ``right`` (l linear between them), and its derivatives
    by both."""
    d = right - left
    small = np.abs(d) < 1e-3
    size = np.abs(np.where(small, 1.0, d))
    mean = np.where(small, 1.0 - np.abs(d) / 2 + d * d / 6, -np.expm1(-size) / size)  # of exp(-(l - low))
    higher = np.where(small, -0.5 + np.abs(d) / 12, np.exp(-size) / -np.expm1(-size) - 1 / size)  # d ln(mean)/d|d|
    lower = -1.0 - higher
    falling = left > right
    log_mean = np.log(mean) - np.minimum(left, right)
    return log_mean, np.where(falling, higher, lower), np.where(falling, lower, higher)


def thinning(
    lubricant: Lubricant, newtonian_stress: FloatArray, critical: Sequence[FloatArray | float], *, along: bool
) -> tuple[Any, Any, list[FloatArray]]:
    """Return Φ [-] at the Newtonian stress eta Δu/h [Pa] on faces, with the ``critical`` stress [Pa] of each law there;
    its derivative d ln Φ/d ln s; and the parts of the derivative that belong to the laws."""
    factor = 1.0
    slopes = []
    for law, tau_c in zip(lubricant.shear_laws, critical):
        by_law, slope = law.thinning(newtonian_stress / tau_c, along=along)
        factor = by_law + (factor - 1.0)
        slopes.append(slope)
    parts = [slope / factor for slope in slopes]
    return factor, sum(parts), parts
