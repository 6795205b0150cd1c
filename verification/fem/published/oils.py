"""Oils compared with standards and measured oils."""

from collections.abc import Iterator

import numpy as np

from lubfric import oil
from lubfric.oil import CELSIUS, Estimate, Lubricant, density_ratio, viscosity

from ... import plotting
from ...check import Check, Figure, Item
from .. import references
from ..solvers.fluid import Fluid
from . import against

MM2 = 1e-6  # m²/s in a mm²/s
GRADE_100 = (99.14, 10.954)  # mm²/s at 40 and 100 °C: VG 100, VI 94


def oils(level: str) -> Iterator[Item]:
    """Viscosity index, viscosity over temperature and pressure, density, and estimates of the pressure-viscosity
    coefficient.

    An estimate of the coefficient states a range. Its error is the distance from the estimate to the end of the range
    that lies on the side of the measured oil. So a measured oil outside the range, widened by its own error, fails.
    """
    for (at40, at100), index in references.VISCOSITY_INDEX.items():
        ours = oil.viscosity_index(at40 * MM2, at100 * MM2)
        yield against(
            "d2270", f"viscosity index, {at40:g} / {at100:g} mm²/s", ours, index, 0.0, error=0.05 / abs(index)
        )
    for (m, n), (at40, at70, at100) in references.D341.items():
        made = oil.from_viscosities(at40 * MM2, at100 * MM2)
        ours = made.kinematic_viscosity(70 + CELSIUS) / MM2
        yield against("d341", f"viscosity at 70 °C, m = {m:g}, n = {n:g}", ours, at70, 0.0, "mm²/s")
    for pressure in (0.1e9, 0.5e9, 1e9):
        oily = Lubricant(0.1, 2e-8, density_law="dowson-higginson")
        at = f"at {pressure / 1e9:g} GPa"
        p = np.array([pressure])
        yield against(
            "roelands", f"viscosity {at}", viscosity(oily, p)[0], references.roelands(0.1, 2e-8, pressure), 0, "Pa s"
        )
        yield against("density", f"density {at}", density_ratio(oily, p)[0][0], references.density(pressure), 0)
    finite = Fluid(0.1, viscosity_law="roelands", pressure_viscosity_coefficient=2e-8, density_law="dowson-higginson")
    theirs = references.roelands(0.1, 2e-8, 1e9)
    yield against("roelands", "viscosity at 1 GPa, finite elements", float(finite.eta(1e9)), theirs, 0, "Pa s")
    yield against("density", "density at 1 GPa, finite elements", float(finite.rho(1e9)), references.density(1e9), 0)
    for base, (s, t) in references.GOLD.items():
        ours = oil.gold(100 * MM2, base).value * 1e9
        yield against("gold", f"alpha of {base} by Gold at 100 mm²/s", ours, s * 100**t, 0, "1/GPa")
    hundred = oil.from_viscosities(*(v * MM2 for v in GRADE_100), base="mineral", estimate="so-klaus")
    for celsius, theirs in references.SO_KLAUS.items():
        ours = hundred.pressure_viscosity_coefficient(celsius + CELSIUS).value * 1e9
        note = "viscosity index 94 for 95"
        yield against("so-klaus", f"alpha of VG 100 at {celsius} °C", ours, theirs, 0.0, "1/GPa", note)
    pairs = [*rig_oils(), *machine_oils()]
    for name, key, estimate, theirs in pairs:
        yield estimated(key, name, estimate, theirs)
    yield drawn(pairs)


Pair = tuple[str, str, Estimate, float]


def rig_oils() -> Iterator[Pair]:
    """Estimates for the three oils of a test rig."""
    for name, (at40, at100, base, density, alphas) in references.RIG_OILS.items():
        for method in ("gold", "so-klaus") if base == "mineral" else ("gold",):
            made = oil.from_viscosities(at40 * MM2, at100 * MM2, base=base, density=density, estimate=method)
            for celsius, alpha in alphas.items():
                result = made.pressure_viscosity_coefficient(celsius + CELSIUS)
                yield f"{name}, {celsius} °C, {method}", "arana", result, alpha


def machine_oils() -> Iterator[Pair]:
    """Gold's estimate for three mineral oils, their density taken as 880 kg/m³."""
    for name, points in references.MACHINE_OILS.items():
        for celsius, (mpas, alpha) in points.items():
            yield f"{name}, {celsius} °C, gold", "stachowiak", oil.gold(mpas / 880 * 1e-3, "mineral"), alpha


def estimated(key: str, name: str, estimate: Estimate, theirs: float) -> Check:
    """Compare the estimate with the measured oil."""
    ours = estimate.value * 1e9
    end = (estimate.high if theirs > ours else estimate.low) / estimate.value
    note = f"lubfric over published {ours / theirs:.2f}"
    return against(key, f"alpha of {name}", ours, theirs, abs(end - 1), "1/GPa", note)


def drawn(pairs: list[Pair]) -> Figure:
    """Return estimates over measured coefficients."""
    canvas, ax = plotting.panel(5.4, 4.6)
    for method, mark in (("gold", "o"), ("so-klaus", "s")):
        rows = [
            (theirs, result.value * 1e9, result.low * 1e9, result.high * 1e9)
            for name, _, result, theirs in pairs
            if name.endswith(method)
        ]
        theirs, ours, low, high = np.array(rows).T
        ax.errorbar(theirs, ours, [ours - low, high - ours], fmt=mark, lw=0.7, label=method)
    ax.plot([9, 36], [9, 36], "k-", lw=0.8)
    ax.set(xlabel="measured alpha (1/GPa)", ylabel="estimate and its range (1/GPa)")
    ax.legend(loc="upper left")
    return plotting.finish(
        "alpha", canvas, "Estimates of the pressure-viscosity coefficient compared with measured oils"
    )
