"""Oils in words, for people: units they use (mm²/s, °C, mPa s, 1/GPa)."""

from __future__ import annotations

from .make import OILS, named_oil, oil_names
from .oil import Oil
from .temperature import CELSIUS, Walther

SHOWN = (20, 40, 60, 70, 80, 100, 120)  # °C


def list_oils() -> str:
    """One line a named oil."""
    lines = [f"{name:<16} {OILS[name].name}" for name in oil_names()]
    return "\n".join(
        [*lines, "", 'any other: grade = "ISO VG 68" with viscosity_index, or nu40 and nu100 in m²/s, in [lubricant]']
    )


def show_oil(name: str) -> str:
    """A table of the properties of a named oil over temperature, with their sources."""
    oil, entry = named_oil(name), OILS[name.lower()]
    table = oil.viscosity_law
    law = f"ASTM D341 (constant 0.7): m = {table.m:.4f}, n = {table.n:.4f}" if isinstance(table, Walther) else "a table"
    lines = [
        f"{name}: {entry.name}",
        f"  {entry.source}",
        f"  {law}; viscosity index {oil.index:.1f} (ASTM D2270); density {oil.density_15:g} kg/m³ at 15 °C",
        "",
        "   °C   mm²/s    mPa s   kg/m³   alpha 1/GPa (measured oils from, to)   1/K",
    ]
    return "\n".join([*lines, *(_row(oil, t + CELSIUS) for t in SHOWN)])


def _row(oil: Oil, temperature: float) -> str:
    alpha = oil.pressure_viscosity_coefficient(temperature)
    bounds = f"({alpha.low * 1e9:.3g}, {alpha.high * 1e9:.3g})"
    return (
        f"  {temperature - CELSIUS:3.0f}  {oil.kinematic_viscosity(temperature) * 1e6:6.4g}  "
        f"{oil.viscosity(temperature) * 1e3:7.4g}  {oil.density_at(temperature):6.1f}   {alpha.value * 1e9:5.3g} "
        f"{bounds:<28}  {oil.temperature_coefficient(temperature):.4f}"
    )


FILM_EXPONENT = 0.56  # of alpha, in the central film of a full EHL contact (Dowson and Toyoda, 1978)


def estimate_in_words(oil: Oil, temperature: float) -> str:
    """Viscosity and pressure-viscosity coefficient of ``oil`` at ``temperature`` [K], and how well the coefficient
    is known."""
    text = (
        f"oil: {oil.name} at {temperature - CELSIUS:.3g} °C: {oil.viscosity(temperature) * 1e3:.3g} mPa s (D341, "
        f"constant 0.7), density {oil.density_at(temperature):.4g} kg/m³"
    )
    alpha, other = oil.pressure_viscosity_coefficient(temperature), oil.other_estimate(temperature)
    if alpha.low == alpha.high:
        return f"{text}, alpha {alpha.value * 1e9:.3g} /GPa as given"
    text += f", alpha {alpha.text} /GPa"
    if other is not None:
        text += f"; {other.source} gives {other.value * 1e9:.3g} ({100 * (other.value / alpha.value - 1):+.2g} %)"
    thin, thick = ((bound / alpha.value) ** FILM_EXPONENT - 1 for bound in (alpha.low, alpha.high))
    return f"{text}; the range is worth {100 * thin:+.2g} to {100 * thick:+.2g} % of a full film"
