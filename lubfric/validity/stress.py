"""Shear stress: what a film is asked to carry against what oils carry."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..lubricant import shear_stress
from .entry import Validity

CARRIED_AT_REST, CARRIED = 5e6, 0.12  # Pa and per Pa: above every limiting stress measured in oils (0.03 to 0.1 of p)
SHARE = 0.2  # of f: excess above which f is no answer
FRICTION = 0.2  # of the film


@dataclass(frozen=True)
class Shear:
    """Shear of a film: its force, that above what oils carry, the film's load [N], and the largest stress ratio [-]."""

    force: float
    excess: float
    load: float
    ratio: float


def carried_stress(pressure):
    """What an oil carries at most [Pa] at ``pressure`` [Pa]: 5 MPa + 0.12 p."""
    return CARRIED_AT_REST + CARRIED * np.maximum(pressure, 0.0)


def shear_of(lubricant, film, sliding: float, wet: np.ndarray, width: float, load: float) -> Shear:
    """Of ``film`` (x, pressure, film_thickness at n nodes) sheared at ``sliding`` [m/s]; wet (n - 1,): share of the width."""
    order = np.argsort(film.x)
    x, p, h = film.x[order], np.maximum(film.pressure[order], 0.0), film.film_thickness[order]
    with np.errstate(over="ignore", invalid="ignore"):
        stress = np.minimum(np.abs(shear_stress(lubricant, p, abs(sliding) / h)), 1e30)
    above = np.maximum(stress - carried_stress(p), 0.0)

    def force(tau):
        return float(width * np.sum(0.5 * (tau[1:] + tau[:-1]) * np.diff(x) * wet))

    return Shear(force(stress), force(above), load, float(np.max(stress / carried_stress(p))))


def of_shear(shear: Shear, friction_force: float, tolerance: float, newtonian: bool) -> list[Validity]:
    """``friction_force``: f F_T [N], of which a share above ``tolerance`` that no oil carries is told, above 0.2 refused."""
    if friction_force <= 0:
        return []
    found, share = [], shear.excess / friction_force
    law = "Newtonian shear" if newtonian else "the shear law"
    remedy = "give lubricant.eyring_stress (some 5e6 Pa) and limiting_stress_coefficient (some 0.05 to 0.1)"
    if share > tolerance:
        severe = share > SHARE
        found.append(
            Validity(
                "share of f from shear stresses that no oil carries", share, SHARE if severe else tolerance, "",
                f"{law} asks up to {shear.ratio:.2g} times 5 MPa + 0.12 p of the film, and gives it a friction coefficient of "
                f"{shear.force / max(shear.load, 1e-300):.2g}", remedy, severe,
            )
        )  # fmt: skip
    elif shear.force > FRICTION * shear.load and shear.force > tolerance * friction_force:
        found.append(
            Validity("friction coefficient of the film", shear.force / max(shear.load, 1e-300), FRICTION, "",
                     "more than any lubricant gives", remedy)
        )  # fmt: skip
    return found
