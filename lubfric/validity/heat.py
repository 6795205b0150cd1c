"""Entries for heat: where the inlet factors and the flash temperature are used beyond what they were made for."""

from __future__ import annotations

from ..heat.flash import FAST
from ..heat.inlet import LARGEST, SLIDING
from .entry import Validity


def of_heat(heat, slide_roll_ratio: float, tolerance: float) -> list[Validity]:
    """``heat``: `lubfric.heat.point.Heat` of a point."""
    found = []
    if heat.used:
        spread = abs(heat.inlet.other / max(heat.inlet.factor, 1e-12) - 1)
        beyond = abs(slide_roll_ratio) > SLIDING or heat.inlet.thermal_number > LARGEST
        if beyond and spread > tolerance:
            found.append(
                Validity(
                    "difference of two published inlet heating factors",
                    spread,
                    tolerance,
                    "",
                    f"the film is between {heat.inlet.factor:.2g} and {heat.inlet.other:.2g} of the "
                    "isothermal one, neither factor "
                    "was made for such sliding",
                    "a measured film; numerics.heat = 'off' gives the isothermal bound",
                )
            )
    if heat.slow and heat.change > tolerance:
        found.append(
            Validity(
                "Péclet number of the faster surface",
                heat.peclet,
                FAST,
                "",
                "the heat source moves slowly: the flash temperature "
                f"used is too high, and f too low by at most {100 * heat.change:.2g} %",
                "numerics.heat = 'off' gives the other bound",
            )
        )
    return found
