"""Maps of the dry rough contact: load, hardness, size, aspect ratio, mean gap, tilt, precision."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import numpy as np
from scipy import fft

import lubfric
from lubfric import solve_contact

from ..check import Check
from ..polonsky_keer import polonsky_keer
from .cell import Condition, judged
from .contact_check import contact_deviations

E_PRIME = 231e9
PERIODIC, MIXED, FREE = ("periodic", "periodic"), ("free", "periodic"), ("free", "free")
BOUNDARIES = {"periodic": PERIODIC, "periodic along y": MIXED, "free": FREE}
OWN = {
    "complementarity": 1e-5,
    "penetration": 1e-4,
    "sign": 1e-12,
    "fields": 1e-4,
    "load": 1e-5,
    "volume": 1e-4,
}
SECOND = {"pressure L2": 1e-3, "mean gap": 1e-3}
SURFACES = (
    "gaussian",
    "smooth",
    "exponential",
    "self-affine, H = 0.8",
    "self-affine, H = 0.2",
    "noise",
    "sine",
    "sphere",
)


@lru_cache(maxsize=64)
def surface(kind: str, nx: int, ny: int, sigma: float = 0.2e-6, spacing: float = 1e-6, seed: int = 3) -> np.ndarray:
    """Heights [m] of rms ``sigma``: fields of a given spectrum in a box of nx x ny cells, or a simple shape."""
    x, y = (np.arange(n) * spacing for n in (nx, ny))
    if kind == "sine":
        z = np.cos(2 * np.pi * x / (nx * spacing))[:, None] * np.cos(2 * np.pi * y / (ny * spacing))
    elif kind == "sphere":
        z = -((x - x.mean())[:, None] ** 2 + (y - y.mean()) ** 2)
    else:
        kx, ky = (2 * np.pi * fft.fftfreq(n, spacing) for n in (nx, ny))
        k = np.hypot(kx[:, None], ky)
        length = 0.12 * min(max(nx, 8), max(ny, 8)) * spacing
        power = {
            "gaussian": np.exp(-((k * length) ** 2) / 4),
            "smooth": np.exp(-((k * 2 * length) ** 2) / 4),
            "exponential": (1 + (k * length) ** 2) ** -1.5,
            "noise": np.ones_like(k),
            "self-affine, H = 0.8": (1 + (k * length) ** 2) ** -1.8,
            "self-affine, H = 0.2": (1 + (k * length) ** 2) ** -1.2,
        }[kind]
        white = np.random.default_rng(seed).standard_normal((nx, ny))
        z = fft.ifft2(np.sqrt(power) * fft.fft2(white)).real
    z = z - z.mean()
    return z * (sigma / z.std()) if z.std() > 0 else z


def cells(level: str) -> Iterator[Check]:
    """All contact cells of ``level`` ("quick" or "full")."""
    quick = level == "quick"
    yield from loads(quick)
    yield from hardnesses(quick)
    yield from sizes(quick)
    yield from gaps(quick)
    yield from slopes(quick)
    yield from tilts(quick)
    yield from precisions(quick)


def solved(here: Condition, gap0, spacing, boundary, second=False, solver=solve_contact, **control) -> Check:
    """One cell of the default solver. With ``second`` it is also held against plain Polonsky-Keer, where that
    converges."""
    tolerance = control.pop("tolerance", 1e-6)
    physical = {k: v for k, v in control.items() if k in ("mean_pressure", "mean_gap", "hardness")}
    ease = max(1.0, tolerance / 1e-6)

    def check(result) -> dict[str, float]:
        found = contact_deviations(result, gap0, spacing, E_PRIME, boundary, **physical)
        ratios = {name: value / OWN[name] / ease for name, value in found.items()}
        return ratios | (_second(result, gap0, spacing, physical) if second else {})

    return judged(
        here,
        "solve_contact",
        lambda: solver(gap0, spacing, E_PRIME, boundary=boundary, tolerance=tolerance, **control),
        check,
    )


def _second(result, gap0, spacing, physical) -> dict[str, float]:
    operator = lubfric.contact.half_space(gap0.shape, spacing, E_PRIME)
    p, converged = polonsky_keer(gap0, operator, physical["mean_pressure"], tolerance=1e-9, max_iterations=3000)
    if not converged:
        return {}
    gap = gap0 + operator.apply(p)
    mean = (gap - gap[p > 0].mean()).mean()
    scale = max(mean, float(gap0.std()) * 1e-3)
    return {
        "pressure L2": float(np.linalg.norm(result.pressure - p) / np.linalg.norm(p)) / SECOND["pressure L2"],
        "mean gap": abs(result.mean_gap - mean) / scale / SECOND["mean gap"],
    }


def full_contact(heights, spacing: float) -> float:
    """Pressure [Pa] that would flatten the heights if it could pull as well. It is the largest tension needed."""
    kx, ky = (2 * np.pi * fft.fftfreq(n, spacing) for n in heights.shape)
    k = np.hypot(kx[:, None], ky)
    return float(-(fft.ifft2(fft.fft2(heights) * E_PRIME * k / 4).real).min())


def loads(quick: bool) -> Iterator[Check]:
    """From one touching cell to full contact and beyond, for every surface and boundary."""
    n = 24 if quick else 48
    shares = (
        (1e-9, 1e-2, 1.5)
        if quick
        else (1e-24, 1e-18, 1e-12, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3, 0.6, 0.9, 1.1, 3.0)
    )
    for label, boundary in BOUNDARIES.items():
        for row, kind in enumerate(SURFACES):
            z = surface(kind, n, n)
            for share in shares:
                yield solved(
                    Condition("contact: load and surface", label, share, row),
                    z.max() - z,
                    1e-6,
                    boundary,
                    second=boundary == PERIODIC,
                    mean_pressure=share * full_contact(z, 1e-6),
                )


def hardnesses(quick: bool) -> Iterator[Check]:
    """Elastic to fully plastic: hardness over E', by load over hardness up to the whole area yielding."""
    n = 24 if quick else 48
    for kind in ("exponential",) if quick else ("exponential", "gaussian", "sine"):
        for label, boundary in list(BOUNDARIES.items())[: 1 if quick else 3]:
            z = surface(kind, n, n)
            for hardness in np.geomspace(1e-5, 1, 3 if quick else 6):
                for share in (1e-4, 0.5, 1.0) if quick else (1e-8, 1e-4, 1e-2, 0.1, 0.3, 0.6, 0.9, 0.99, 0.9999, 1.0):
                    limit = float(hardness) * E_PRIME
                    yield solved(
                        Condition("contact: hardness", f"{kind}, {label}", hardness, share),
                        z.max() - z,
                        1e-6,
                        boundary,
                        hardness=limit,
                        mean_pressure=share * limit,
                    )


def sizes(quick: bool) -> Iterator[Check]:
    """Odd and prime sizes down to one cell, and cells up to 50 times as long as wide."""
    shapes = (
        ((1, 1), (2, 3), (31, 17), (64, 1), (36, 60))
        if quick
        else (
            (1, 1),
            (2, 2),
            (2, 3),
            (3, 5),
            (7, 7),
            (16, 16),
            (31, 17),
            (37, 53),
            (64, 1),
            (1, 61),
            (50, 48),
            (97, 12),
            (36, 60),
        )
    )
    for row, shape in enumerate(shapes):
        z = surface("exponential", *shape)
        for aspect in (1.0, 50.0) if quick else (0.02, 0.1, 1.0, 10.0, 50.0):
            for label, boundary in BOUNDARIES.items():
                for pressure in (1e8,) if quick else (1e6, 1e9, 3e10):
                    yield solved(
                        Condition("contact: size and aspect ratio", f"{label}, {pressure / 1e6:g} MPa", aspect, row),
                        z.max() - z,
                        (1e-6 * aspect, 1e-6),
                        boundary,
                        mean_pressure=pressure,
                    )


def gaps(quick: bool) -> Iterator[Check]:
    """A prescribed mean gap, from a millionth of the roughness to almost no touch."""
    n = 24 if quick else 48
    kinds = SURFACES[:3] if quick else SURFACES
    for label, boundary in BOUNDARIES.items():
        for row, kind in enumerate(kinds):
            z = surface(kind, n, n)
            touching = float(z.max() - z.mean())
            for share in (1e-3, 0.5, 0.99) if quick else (1e-6, 1e-4, 1e-2, 0.1, 0.3, 0.6, 0.9, 0.999):
                hardness = None if row % 2 else 0.05 * E_PRIME
                if hardness and share < 1e-2:
                    continue
                yield solved(
                    Condition("contact: mean gap", label, share, row),
                    z.max() - z,
                    1e-6,
                    boundary,
                    mean_gap=share * touching,
                    hardness=hardness,
                )


def slopes(quick: bool) -> Iterator[Check]:
    """Roughness from a picometre to slopes far beyond small-slope theory, which the equations do not know of."""
    for kind in ("exponential",) if quick else ("exponential", "noise", "gaussian"):
        for sigma in np.geomspace(1e-12, 1e-3, 4 if quick else 10):
            z = surface(kind, 40, 40, float(sigma))
            for pressure in (1e6, 1e9) if quick else (1e3, 1e6, 1e8, 1e10):
                yield solved(
                    Condition("contact: roughness height", kind, sigma, pressure),
                    z.max() - z,
                    1e-6,
                    PERIODIC,
                    second=True,
                    mean_pressure=pressure,
                )


def tilts(quick: bool) -> Iterator[Check]:
    """Maps that do not close on themselves: tilted by so many roughness heights, and offset by a metre."""
    n = 24 if quick else 45
    z = surface("exponential", n, n)
    ramp = np.linspace(-0.5, 0.5, n)
    for label, boundary in BOUNDARIES.items():
        for tilt in (0.0, 100.0) if quick else (0.0, 1.0, 10.0, 100.0, 1000.0):
            tilted = z + tilt * z.std() * (ramp[:, None] + 0.5 * ramp)
            for offset in (0.0, 1e-3) if quick else (0.0, 1e-3, 1.0):
                for pressure in (1e8,) if quick else (1e6, 1e8, 1e10):
                    gap0 = np.round(tilted.max() - tilted, 15) + offset
                    yield solved(
                        Condition("contact: tilt and offset", f"{label}, {pressure / 1e6:g} MPa", tilt, offset),
                        gap0,
                        1e-6,
                        boundary,
                        mean_pressure=pressure,
                    )


def precisions(quick: bool) -> Iterator[Check]:
    """Heights in single and double precision, tolerances from 1e-1 to 1e-12, good and absurd starts."""
    z = surface("exponential", 48, 48)
    absurd = np.zeros_like(z)
    absurd[5, 7] = 1e14
    for row, (dtype, start) in enumerate(
        ((np.float64, None), (np.float32, None), (np.float64, absurd), (np.float64, np.ones_like(z)))
    ):
        for tolerance in (1e-2, 1e-8) if quick else (0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12):
            for pressure in (2e8,) if quick else (1e5, 2e8, 5e9):
                gap0 = (z.max() - z).astype(dtype)
                yield solved(
                    Condition("contact: precision, tolerance, start", f"{pressure / 1e6:g} MPa", tolerance, row),
                    gap0.astype(float),
                    1e-6,
                    PERIODIC,
                    mean_pressure=pressure,
                    start=start,
                    tolerance=tolerance,
                )
