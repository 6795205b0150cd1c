"""Entries for shear stress: what a film is asked to carry against what oils carry."""

from __future__ import annotations

import math

from .entry import Validity

SHARE = 0.2  # of f: excess above which f is no answer
FRICTION = 0.2  # of the film


def meaningless(shear) -> bool:
    """Whether most of the force of ``shear`` (`ShearForce`) comes from stresses that no oil carries."""
    return not shear.excess <= 0.5 * abs(shear.couette)


def of_shear(scene, shear, film_load: float, friction_force: float) -> list[Validity]:
    """Entries for the ``shear`` (`ShearForce`) of a film that carries ``film_load``; ``friction_force``: f F_T; both in
    N, or both per width.

    A share of the friction that no oil carries is a caution above the tolerance on f, and refused above 0.2.
    """
    tolerance = scene.numerics.tolerance
    if not friction_force > 0:
        return []
    share = shear.excess / friction_force if shear.excess < math.inf else 1.0
    found, friction = [], abs(shear.couette) / max(film_load, 1e-300)
    law = "Newtonian shear" if scene.lubricant.newtonian else "the shear law"
    remedy = "give lubricant.eyring_stress (some 5e6 Pa) and limiting_stress_coefficient (some 0.05 to 0.1)"
    if share > tolerance:
        severe = share > SHARE
        found.append(
            Validity(
                "share of f from shear stresses that no oil carries",
                share,
                SHARE if severe else tolerance,
                "",
                f"{law} asks up to {shear.stress_ratio:.2g} times 5 MPa + 0.12 p of the film, and gives it a "
                "friction coefficient of "
                f"{friction:.2g}",
                remedy,
                severe,
            )
        )
    elif friction > FRICTION and abs(shear.couette) > tolerance * friction_force:
        found.append(
            Validity(
                "friction coefficient of the film", friction, FRICTION, "", "more than any lubricant gives", remedy
            )
        )
    return found
