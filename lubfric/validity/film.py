"""The film of a solution: pressure, thickness, and what deflects it."""

from __future__ import annotations

from ..lubricant import NO_LIQUID
from .entry import Validity

ROELANDS_LIMIT = 1e9  # Pa, about the pressure to which the law was fitted
BARUS_LIMIT = 3e8  # Pa
THICK = 0.1  # of the radius
STRIP_SHARE = 0.2  # of the mean gap that the undeformed cylinder may rise over the strip
ANOTHER = "numerics.film_deflection = 'scaled' or 'total' (or 'auto', which chooses)"


def of_pressure(lubricant, peak: float) -> list[Validity]:
    """Entries for the highest film pressure ``peak`` [Pa]."""
    if peak > NO_LIQUID:
        return [
            Validity(
                "film pressure",
                peak / 1e9,
                NO_LIQUID / 1e9,
                "GPa",
                "no oil is a liquid there",
                "check bodies.load and numerics.film_level",
                True,
            )
        ]
    limit = {"roelands": ROELANDS_LIMIT, "barus": BARUS_LIMIT}.get(lubricant.viscosity_law)
    if limit is None or peak <= limit:
        return []
    return [
        Validity(
            "film pressure",
            peak / 1e9,
            limit / 1e9,
            "GPa",
            f"the {lubricant.viscosity_law} viscosity law is an extrapolation there",
            "the film's friction rests on it: a measured limiting stress is safer",
        )
    ]


def of_thickness(bodies, film: float) -> list[Validity]:
    """Entries for the central film thickness ``film`` [m]."""
    if not film > THICK * bodies.radius:
        return []
    return [
        Validity(
            "film over radius",
            film / bodies.radius,
            THICK,
            "",
            "the film is not thin against the cylinder",
            "check bodies.radius, viscosity and speed",
        )
    ]


def of_deflection(change: float, limit: float, remedy: str = ANOTHER) -> list[Validity]:
    """Entries for a film that is deflected by its own pressure alone. ``change``: what its share of the load may be
    wrong by [-]."""
    if not change > limit:
        return []
    return [
        Validity(
            "rise of the undeformed cylinder over the Hertz strip, relative to the mean gap,",
            change,
            limit,
            "",
            "a film flattened by its own pressure alone takes too much of the load: f does not tend to f_b",
            remedy,
        )
    ]
