"""Mean gap against mean pressure of independent asperities on a nominally flat contact."""

from __future__ import annotations

import numpy as np

from ..errors import InputError
from .asperity import find_asperities
from .contact_curve import ContactCurve, errors_between

APPROACHES = np.concatenate([np.geomspace(1e-4, 0.2, 80), np.linspace(0.2, 1.0, 81)[1:]])  # of the height range


def asperity_curve(heights, spacing, e_prime, *, heaviest, definition, reading, hardness=None) -> ContactCurve:
    """Mean gap against mean pressure of independent asperities on a periodic map, from first touch on.

    ``reading``: "volume" or "mean-plane" (`lubfric.contact.asperities`) of heights [m] about their mean. The flat comes
    down until it carries ``heaviest`` [Pa]. If the model cannot carry that, the flat comes down to the deepest valley
    (to the mean plane for "mean-plane"), and the curve ends at the largest pressure. Patches that grow together carry
    less than before; such nodes are left out, so that the pressure rises along the curve. The search ends below half of
    the largest pressure.
    """
    asperities = find_asperities(heights, spacing, e_prime, definition=definition, hardness=hardness)
    top, span = float(heights.max()), float(np.ptp(heights))
    nodes: list[tuple[float, float, float, float]] = []
    for approach in span * APPROACHES:
        found = asperities.at(top - approach)
        gap = _curve_gap(heights, top - approach, reading)
        if gap <= 0:
            break
        if found.load > 0 and (not nodes or found.mean_pressure > nodes[-1][0]):
            nodes.append((found.mean_pressure, gap, min(found.contact_area_fraction, 1.0), found.plastic_area_fraction))
        if nodes and (nodes[-1][0] >= heaviest or found.mean_pressure < 0.5 * nodes[-1][0]):
            break
    if not nodes:
        raise InputError(
            f"contact.model = {definition!r}: none on the map of {heights.shape[0]} x {heights.shape[1]} points; give "
            "a map with points above all of their neighbours, or contact.model = 'half-space'"
        )
    pressure, gap, area, plastic = np.array(nodes[::-1]).T
    errors = errors_between(pressure, gap), errors_between(pressure, area)
    return ContactCurve(pressure, gap, area, plastic, _curve_gap(heights, top, reading), 0, *errors)


def _curve_gap(heights, separation, reading) -> float:
    return float(np.maximum(separation - heights, 0.0).mean()) if reading == "volume" else float(separation)
