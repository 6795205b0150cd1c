"""Wiring of the rough contact: hardness, area, coarse grids, and what part of the width is touched."""

from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.contact import ContactState
from lubfric.models import prepare

from ...check import AT_LEAST, Check, Item, compared
from ...fem import parts

DRY = {"accept": True, "tolerance": 1e-3, "sampling": "patch"}
CELL = 2e-6  # m, length of the cells
STRIP = "pressures of the strip that was found, summed anew"


def wiring_contact(level: str) -> Iterator[Item]:
    """At rest the contact carries everything, so that hardness and area can be seen on it alone.

    The flat curve is held against one dry contact at its pressure, asperities that all yield against load over
    hardness, and the cylinder against its hardness. Coarse grids follow, and what part of the width is touched.
    """
    yield from flat()
    yield from asperities()
    yield from cylinder()
    yield from coarse()
    yield from columns()


def heights(nx: int, ny: int, seed: int = 4) -> np.ndarray:
    """Return heights [m] of a few waves, Sq 240 nm."""
    z = np.random.default_rng(seed).standard_normal((nx, ny))
    k = np.hypot(np.fft.fftfreq(nx)[:, None] * nx, np.fft.fftfreq(ny) * ny)
    z = np.fft.ifft2(np.fft.fft2(z) * ((k > 0.5) & (k < 9))).real
    return (z - z.mean()) * (240e-9 / z.std())


def flat() -> Iterator[Item]:
    """The contact curve at the mean Hertz pressure, elastic and yielding, against `lubfric.solve_contact`."""
    z = heights(64, 64)
    for words, hardness in (("elastic", None), ("hardness 1 GPa", 1e9)):
        s = lubfric.load_scene("flat").with_(bodies={"hardness": hardness}, numerics=DRY)
        point = lubfric.friction(prepare(s, lubfric.Surface(z, (CELL, CELL))), 0.0)
        b = np.sqrt(8 * 5.5 / 6e-3 * 2e-3 / (np.pi * 231e9))
        pressure = 5.5 / (2 * b * 6e-3)
        one = lubfric.solve_contact(z.max() - z, CELL, 231e9, mean_pressure=pressure, hardness=hardness, tolerance=1e-8)
        gap = float(np.maximum(one.gap, 0).mean())
        area = float(np.mean(one.pressure > 0))
        rows = [
            ("mean gap", "m", point.mean_gap, gap, 2e-3),
            ("area", "1", point.real_contact_area_fraction, area, 0.02),
        ]
        yield from compared(f"flat, {words}", rows, "lubfric.solve_contact")


def asperities() -> Iterator[Item]:
    """Summits so soft that all of them yield carry the hardness on all that they touch."""
    surface = lubfric.Surface(heights(64, 64), (CELL, CELL))

    def area(geometry: str, hardness: float | None) -> float:
        contact = {"geometry": geometry, "model": "summits", "shape": (64, 64), "spacing": CELL}
        s = lubfric.load_scene("paper").with_(bodies={"hardness": hardness}, contact=contact, numerics=DRY)
        return lubfric.friction(prepare(s, surface), 0.0).real_contact_area_fraction

    yield Check(
        "soft summits, flat: area",
        area("flat", 2.5e8),
        expected=102e6 / 2.5e8,
        tolerance=0.03,
        source="load over hardness",
    )
    softer = area("cylinder", 2.5e8) / area("cylinder", None)
    yield Check(
        "soft summits, cylinder: area over the elastic one",
        softer,
        expected=2.0,
        tolerance=0.0,
        source="softer",
        kind=AT_LEAST,
    )


def cylinder() -> Iterator[Item]:
    """Check that no pressure exceeds the hardness, that the pressure carries the total load, and that the area A has
    the requested width."""
    z = heights(64, 32)
    for region in ("hertz", "box"):
        s = lubfric.load_scene("paper").with_(
            bodies={"hardness": 1.2e9}, contact={"shape": (64, 32), "spacing": 1e-6, "region": region}, numerics=DRY
        )
        point = lubfric.friction(prepare(s, lubfric.Surface(z, (1e-6, 1e-6))), 0.0, fields=True)
        fields = parts.contact_fields(point)
        rows = [
            ("highest pressure", "Pa", float(fields.pressure.max()), 1.2e9, 1e-9),
            ("load of the pressures", "N", float(fields.pressure.mean() * 64e-6 * 6e-3), 5.5, 1e-6),
        ]
        yield from compared(f"cylinder, {region}", rows, "the hardness and the load of the scene")
        edges = np.linspace(-32e-6, 32e-6, 65)
        half = np.sqrt(8 * 5.5 / 6e-3 * 2e-3 / (np.pi * 231e9)) if region == "hertz" else 32e-6
        weight = np.diff(np.clip(edges, -half, half))
        gap = float(weight @ np.maximum(fields.gap, 0).mean(axis=1) / weight.sum())
        area = float(weight @ (fields.pressure > 0).mean(axis=1) / weight.sum())
        rows = [
            ("mean gap", "m", point.mean_gap, gap, 2e-3),
            ("area", "1", point.real_contact_area_fraction, area, 2e-3),
        ]
        yield from compared(f"cylinder, {region}", rows, STRIP)


def coarse() -> Iterator[Item]:
    """Coarse cells have the heights of the map at their own x."""
    s = lubfric.load_scene("paper").with_(contact={"shape": (128, 64), "spacing": 0.5e-6})
    x = (np.arange(128) - 63.5) * 0.5e-6
    z = 1e-7 * np.repeat(np.sin(2 * np.pi * x / 64e-6)[:, None], 64, axis=1)
    made = parts.half_space(prepare(s, lubfric.Surface(z, (0.5e-6, 0.5e-6))))
    expected = np.interp(made.x, x, z[:, 0])
    off = np.abs(made.heights - (expected - expected.mean())[:, None]).max() / z.std() + float(made.x.size == 128)
    yield Check(
        "coarse cells: largest error of a height over Sq",
        float(off),
        expected=0.0,
        tolerance=1e-6,
        source="the map there",
        kind="absolute",
    )


def columns() -> Iterator[Item]:
    """The share in contact of stretches of x: it sums to all of it, and lies about the right place."""
    x = np.arange(-5.0, 6.0)
    share = np.array([0, 0, 1, 0.5, 0, 0, 0, 0.2, 0, 0, 0.0])
    state = ContactState(
        mean_gap=1.0,
        mean_film=1.0,
        x=x,
        contact_fraction=share,
        real_contact_area_fraction=0.0,
        plastic_area_fraction=0.0,
    )
    edges = np.linspace(-6.0, 6.0, 481)
    result = state.touching(edges) * np.diff(edges)
    middle = 0.5 * (edges[1:] + edges[:-1])
    yield Check(
        "columns in contact: sum", float(result.sum()), expected=1.7, tolerance=1e-9, source="the sum of the columns"
    )
    centre = float(share @ x / share.sum())
    yield Check(
        "columns in contact: centre",
        float(result @ middle / result.sum()),
        expected=centre,
        tolerance=1e-9,
        source="their first moment",
    )
