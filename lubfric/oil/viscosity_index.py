"""Viscosity index, and the kinematic viscosity at 100 °C that belongs to one: ASTM D2270 (ISO 2909) both ways."""

from __future__ import annotations

import math

import numpy as np

from .._base import validate
from ..errors import InputError
from .index_table import AT_100, HIGH, LOW

LEAST = 2e-6  # m²/s at 100 °C: below it the index is not defined
SLOPE = 0.00715  # of procedure B
LARGEST = 400.0  # index accepted by `viscosity_at_100`; oils on the market end below 250


def viscosity_index(nu40: float, nu100: float) -> float:
    """Viscosity index [-], not rounded, from the kinematic viscosities [m²/s] at 40 °C and at 100 °C.

    ASTM D2270: with L and H of the standard's table (above 70 mm²/s at 100 °C of its formulas), procedure A,
    ``100 (L - nu40)/(L - H)``, where nu40 >= H; procedure B, ``100 + (10^N - 1)/0.00715`` with
    ``N = log(H/nu40)/log(nu100)`` in mm²/s, below (index 100 and more). The standard rounds to whole numbers.

    Raises `InputError` for viscosities that are not positive, a nu100 below 2 mm²/s (not defined there) or not below
    nu40.
    """
    nu40, nu100 = validate.positive("nu40", nu40, "m²/s"), validate.positive("nu100", nu100, "m²/s")
    if nu100 < LEAST * (1 - 1e-12):
        raise InputError(
            f" = {nu100:g} m²/s is out of range",
            "nu100",
            f"from 2e-6 m²/s (2 mm²/s), the viscosity index is not defined below{_millimetres(nu40, nu100)}",
        )
    if nu40 <= nu100:
        raise InputError(
            f" = {nu40:g} m²/s is not above nu100 = {nu100:g} m²/s", "nu40", "nu40 > nu100 (swapped?)", also=("nu100",)
        )
    if nu100 > 1e-2:
        raise InputError(f" = {nu100:g} m²/s is out of range", "nu100", f"up to 0.01 m²/s{_millimetres(nu40, nu100)}")
    return _index(nu40 * 1e6, nu100 * 1e6)


def _millimetres(nu40: float, nu100: float) -> str:
    return "; mm²/s were meant? 1 mm²/s = 1e-6 m²/s" if min(nu40, nu100) > 1e-2 else ""


def _index(at_40: float, at_100: float) -> float:
    """The viscosity index, from viscosities in mm²/s."""
    low, high = _low_high(at_100)
    if at_40 >= high:
        return 100 * (low - at_40) / (low - high)
    return 100 + (10 ** (math.log(high / at_40) / math.log(at_100)) - 1) / SLOPE


def _low_high(at_100: float) -> tuple[float, float]:
    """L and H [mm²/s] at a kinematic viscosity [mm²/s] at 100 °C."""
    if at_100 > AT_100[-1]:
        return (0.8353 * at_100 + 14.67) * at_100 - 216, (0.1684 * at_100 + 11.85) * at_100 - 97
    return float(np.interp(at_100, AT_100, LOW)), float(np.interp(at_100, AT_100, HIGH))


def viscosity_at_100(nu40: float, index: float) -> float:
    """Kinematic viscosity at 100 °C [m²/s] of an oil of ``nu40`` [m²/s] at 40 °C and viscosity index ``index``: D2270
    inverted, by one bracketed root; `viscosity_index` of the result is ``index`` to 1e-9.

    Raises `InputError` where no viscosity from 2 mm²/s at 100 °C up has that index.
    """
    from scipy.optimize import brentq

    nu40 = validate.positive("nu40", nu40, "m²/s", maximum=1.0)
    index = validate.number("viscosity_index", index, "(-)", minimum=-200, maximum=LARGEST)
    at_40, least = nu40 * 1e6, LEAST * 1e6
    if at_40 <= least or _index(at_40, least) > index:
        raise InputError(
            f" = {index:g} (-) with nu40 = {nu40:g} m²/s gives less than 2e-6 m²/s at 100 °C, where the index is not "
            "defined",
            "viscosity_index",
            way_out="give the kinematic viscosities at 40 and 100 °C instead",
            also=("nu40",),
        )
    if _index(at_40, 0.999 * at_40) < index:
        raise InputError(
            f" = {index:g} (-) has no oil of nu40 = {nu40:g} m²/s", "viscosity_index", "a lower index", also=("nu40",)
        )
    root = brentq(lambda at_100: _index(at_40, at_100) - index, least, 0.999 * at_40, xtol=1e-13, rtol=1e-14)
    return root * 1e-6
