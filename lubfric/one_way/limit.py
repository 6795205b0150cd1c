"""The pressure up to which a film in a given gap is trusted.

In a rigid gap the pressure of a thin film rises without bound (Q reaches its largest value); real bodies would deform.
The limit is the pressure at which the shear stress of the lubricant, as a Newtonian fluid, reaches the boundary
friction, ``eta(p) Δu/h = f_b p``. Beyond it a film rubs like a contact, and is counted as one. The limit follows from
the fluid, the speed and the gap. docs/model-error.md tells how strongly f depends on it.
"""

from __future__ import annotations

import numpy as np

from ..oil import Lubricant, viscosity

PRESSURES = np.geomspace(1e6, 2e10, 800)  # Pa


def pressure_limit(lubricant: Lubricant, film, sliding: float, boundary_friction: float) -> np.ndarray:
    """The largest p [Pa] with eta(p) Δu/h <= f_b p, for films ``film`` [m] of any shape; infinite for a constant
    viscosity. If no pressure is low enough (thin films at high speed), the one at which eta/p is smallest."""
    if lubricant.viscosity_law == "constant":
        return np.full(np.shape(film), np.inf)
    with np.errstate(over="ignore"):
        rate = boundary_friction * PRESSURES / viscosity(lubricant, PRESSURES)
    top = int(np.argmax(rate))
    falling = slice(top, None)
    log_rate = np.log(np.maximum(rate[falling], 1e-300))
    return np.exp(np.interp(-np.log(sliding / film), -log_rate, np.log(PRESSURES[falling])))
