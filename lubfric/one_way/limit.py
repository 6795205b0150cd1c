"""The pressure beyond which a film in a given gap is not believed.

A rigid gap lets the pressure of a thin film rise without bound (Q reaches its largest value). In truth the bodies give
way. The limit is where the lubricant, as a Newtonian fluid, would be sheared above the boundary friction, ``eta(p) Δu/h
= f_b p``. From there on a film rubs like a contact, and counts as one here. The limit follows from the fluid, the speed
and the gap. docs/model-error.md tells how far f moves with it.
"""

from __future__ import annotations

import numpy as np

from ..lubricant import Lubricant, viscosity

PRESSURES = np.geomspace(1e6, 2e10, 800)  # Pa


def pressure_limit(lubricant: Lubricant, film, sliding: float, boundary_friction: float) -> np.ndarray:
    """The largest p [Pa] with eta(p) Δu/h <= f_b p, at films ``film`` [m] of any shape; infinite for a constant
    viscosity. Where no pressure is low enough (thin films, fast), the one at which eta/p is least.
    """
    if lubricant.viscosity_law == "constant":
        return np.full(np.shape(film), np.inf)
    with np.errstate(over="ignore"):
        rate = boundary_friction * PRESSURES / viscosity(lubricant, PRESSURES)
    top = int(np.argmax(rate))
    falling = slice(top, None)
    log_rate = np.log(np.maximum(rate[falling], 1e-300))
    return np.exp(np.interp(-np.log(sliding / film), -log_rate, np.log(PRESSURES[falling])))
