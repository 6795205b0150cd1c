"""Maps of the dry rough contact: load, hardness, size, aspect ratio, mean gap, tilt, precision."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy import fft

from lubfric import ContactResult, solve_contact
from lubfric.contact.operator import half_space

from ...types import Keywords, Law
from ..polonsky_keer import polonsky_keer
from .cell import Cell
from .contact_check import contact_deviations

E_PRIME = 231e9  # Pa, E' of two steel bodies
PERIODIC = ("periodic", "periodic")
MIXED = ("free", "periodic")
FREE = ("free", "free")
BOUNDARIES = {"periodic": PERIODIC, "periodic along y": MIXED, "free": FREE}
OWN = {"complementarity": 1e-5, "penetration": 1e-4, "sign": 1e-12, "fields": 1e-4, "load": 1e-5, "volume": 1e-4}
SECOND = 1e-3  # of pressure and mean gap, beside plain Polonsky-Keer
POWER: dict[str, Law] = {  # spectral density of a field, by the wave number times its length
    "gaussian": lambda k: np.exp(-(k**2) / 4),
    "smooth": lambda k: np.exp(-(k**2)),
    "exponential": lambda k: (1 + k**2) ** -1.5,
    "self-affine, H = 0.8": lambda k: (1 + k**2) ** -1.8,
    "self-affine, H = 0.2": lambda k: (1 + k**2) ** -1.2,
    "noise": np.ones_like,
}
SURFACES = (*POWER, "sine", "sphere")


@dataclass(frozen=True, kw_only=True)
class Pressed:
    """A rough map on a flat: kind, shape and rms [m] of the map, and the arguments of the solver, in SI units."""

    kind: str
    shape: tuple[int, int]
    boundary: tuple[str, str] = PERIODIC
    mean_pressure: float | None = None
    mean_gap: float | None = None
    hardness: float | None = None
    sigma: float = 0.2e-6
    aspect: float = 1.0  # length over width of a cell of 1 µm
    tilt: float = 0.0  # in rms heights
    offset: float = 0.0
    tolerance: float = 1e-6
    single: bool = False  # heights of single precision
    start: str = "none"  # or "absurd" or "even"
    second: bool = False  # held against plain Polonsky-Keer as well, where that converges

    @property
    def spacing(self) -> tuple[float, float]:
        """Length and width of a cell [m]."""
        return 1e-6 * self.aspect, 1e-6

    @property
    def gap0(self) -> np.ndarray:
        """The undeformed gap [m]."""
        z = surface(self.kind, *self.shape, self.sigma)
        if self.tilt:
            x, y = (np.linspace(-0.5, 0.5, n) for n in self.shape)
            z = z + self.tilt * z.std() * (x[:, None] + 0.5 * y)
        gap = np.round(z.max() - z, 15) if self.tilt or self.offset else z.max() - z
        return (gap + self.offset).astype(np.float32 if self.single else float).astype(float)


@lru_cache(maxsize=64)
def surface(kind: str, nx: int, ny: int, sigma: float = 0.2e-6) -> np.ndarray:
    """Return heights [m] of rms ``sigma``: fields of a given spectrum in a box of nx x ny cells of 1 µm, or a simple
    shape."""
    x, y = (np.arange(n) * 1e-6 for n in (nx, ny))
    if kind == "sine":
        z = np.cos(2 * np.pi * np.arange(nx) / nx)[:, None] * np.cos(2 * np.pi * np.arange(ny) / ny)
    elif kind == "sphere":
        z = -((x - x.mean())[:, None] ** 2 + (y - y.mean()) ** 2)
    else:
        length = 0.12 * min(max(nx, 8), max(ny, 8)) * 1e-6
        white = fft.fft2(np.random.default_rng(3).standard_normal((nx, ny)))
        z = fft.ifft2(np.sqrt(POWER[kind](wave_numbers((nx, ny)) * length)) * white).real
    z = z - z.mean()
    return z * (sigma / z.std()) if z.std() > 0 else z


def wave_numbers(shape: tuple[int, int]) -> np.ndarray:
    """Return |k| [rad/m] on cells of 1 µm."""
    kx, ky = (2 * np.pi * fft.fftfreq(n, 1e-6) for n in shape)
    return np.hypot(kx[:, None], ky)


def full_contact(heights: np.ndarray) -> float:
    """Return pressure [Pa] that would flatten the heights if it could pull as well. It is the largest tension
    needed."""
    return float(-(fft.ifft2(fft.fft2(heights) * E_PRIME * wave_numbers(heights.shape) / 4).real).min())


def solve(cell: Cell[Pressed]) -> ContactResult:
    """Return the cell by the default solver."""
    p: Pressed = cell.problem
    absurd = np.zeros(p.shape)
    absurd.flat[-1] = 1e14
    start = {"none": None, "even": np.ones(p.shape), "absurd": absurd}[p.start]
    pressed: Keywords = {"mean_pressure": p.mean_pressure, "mean_gap": p.mean_gap, "hardness": p.hardness}
    return solve_contact(p.gap0, p.spacing, E_PRIME, boundary=p.boundary, tolerance=p.tolerance, start=start, **pressed)


def deviations(cell: Cell[Pressed], result: ContactResult) -> dict[str, float]:
    """Return complementarity, signs, fields and load of the result, and the second opinion, over what is allowed."""
    p: Pressed = cell.problem
    physical = {"hardness": p.hardness, "mean_pressure": p.mean_pressure, "mean_gap": p.mean_gap}
    solved = contact_deviations(result, p.gap0, p.spacing, E_PRIME, p.boundary, **physical)
    ease = max(1.0, p.tolerance / 1e-6)
    ratios = {name: value / OWN[name] / ease for name, value in solved.items()}
    return ratios | (_second(result, p, p.mean_pressure) if p.second and p.mean_pressure else {})


def _second(result: ContactResult, p: Pressed, load: float) -> dict[str, float]:
    operator = half_space(p.shape, p.spacing, E_PRIME)
    gap0 = p.gap0
    pressure, converged = polonsky_keer(gap0, operator, load, tolerance=1e-9, max_iterations=3000)
    if not converged:
        return {}
    gap = gap0 + operator.apply(pressure)
    mean = (gap - gap[pressure > 0].mean()).mean()
    scale = max(mean, float(gap0.std()) * 1e-3)
    off = float(np.linalg.norm(result.pressure - pressure) / np.linalg.norm(pressure))
    return {"pressure L2": off / SECOND, "mean gap beside": abs(result.mean_gap - mean) / scale / SECOND}


def cells(*, quick: bool) -> Iterator[Cell[Pressed]]:
    """All contact cells."""
    for part in (loads, hardnesses, sizes, gaps, heights, tilts, precisions):
        yield from part(quick=quick)


def loads(*, quick: bool) -> Iterator[Cell[Pressed]]:
    """From one touching cell to full contact and beyond, for every surface and boundary."""
    n = 24 if quick else 48
    many = (1e-24, 1e-18, 1e-12, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3, 0.6, 0.9, 1.1, 3.0)
    for label, boundary in BOUNDARIES.items():
        for row, kind in enumerate(SURFACES):
            flat = full_contact(surface(kind, n, n))
            for share in (1e-9, 1e-2, 1.5) if quick else many:
                pressed = Pressed(
                    kind=kind, shape=(n, n), boundary=boundary, mean_pressure=share * flat, second=boundary == PERIODIC
                )
                yield Cell(map="contact: load and surface", panel=label, x=share, y=row, problem=pressed)


def hardnesses(*, quick: bool) -> Iterator[Cell[Pressed]]:
    """Elastic to fully plastic: hardness over E', by load over hardness, until the complete area yields."""
    n = 24 if quick else 48
    many = (1e-8, 1e-4, 1e-2, 0.1, 0.3, 0.6, 0.9, 0.99, 0.9999, 1.0)
    for kind in ("exponential",) if quick else ("exponential", "gaussian", "sine"):
        for label, boundary in list(BOUNDARIES.items())[: 1 if quick else 3]:
            for hardness in np.geomspace(1e-5, 1, 3 if quick else 6).tolist():
                for share in (1e-4, 0.5, 1.0) if quick else many:
                    limit = hardness * E_PRIME
                    pressed = Pressed(
                        kind=kind, shape=(n, n), boundary=boundary, mean_pressure=share * limit, hardness=limit
                    )
                    yield Cell(map="contact: hardness", panel=f"{kind}, {label}", x=hardness, y=share, problem=pressed)


def sizes(*, quick: bool) -> Iterator[Cell[Pressed]]:
    """Odd and prime sizes down to one cell, and cells up to 50 times as long as wide."""
    few = ((1, 1), (2, 3), (31, 17), (64, 1), (36, 60))
    more = ((2, 2), (3, 5), (7, 7), (16, 16), (37, 53), (1, 61), (50, 48), (97, 12))
    for row, shape in enumerate(few if quick else few + more):
        for aspect in (1.0, 50.0) if quick else (0.02, 0.1, 1.0, 10.0, 50.0):
            for label, boundary in BOUNDARIES.items():
                for pressure in (1e8,) if quick else (1e6, 1e9, 3e10):
                    pressed = Pressed(
                        kind="exponential", shape=shape, boundary=boundary, mean_pressure=pressure, aspect=aspect
                    )
                    panel = f"{label}, {pressure / 1e6:g} MPa"
                    yield Cell(map="contact: size and aspect ratio", panel=panel, x=aspect, y=row, problem=pressed)


def gaps(*, quick: bool) -> Iterator[Cell[Pressed]]:
    """A prescribed mean gap, from a millionth of the roughness to almost no touch."""
    n = 24 if quick else 48
    for label, boundary in BOUNDARIES.items():
        for row, kind in enumerate(SURFACES[:3] if quick else SURFACES):
            z = surface(kind, n, n)
            touching = float(z.max() - z.mean())
            hardness = None if row % 2 else 0.05 * E_PRIME
            for share in (1e-3, 0.5, 0.99) if quick else (1e-6, 1e-4, 1e-2, 0.1, 0.3, 0.6, 0.9, 0.999):
                if hardness is None or share >= 1e-2:
                    pressed = Pressed(
                        kind=kind, shape=(n, n), boundary=boundary, mean_gap=share * touching, hardness=hardness
                    )
                    yield Cell(map="contact: mean gap", panel=label, x=share, y=row, problem=pressed)


def heights(*, quick: bool) -> Iterator[Cell[Pressed]]:
    """Roughness from a picometre to slopes far beyond small-slope theory, which the equations do not know of."""
    for kind in ("exponential",) if quick else ("exponential", "noise", "gaussian"):
        for sigma in np.geomspace(1e-12, 1e-3, 4 if quick else 10).tolist():
            for pressure in (1e6, 1e9) if quick else (1e3, 1e6, 1e8, 1e10):
                pressed = Pressed(kind=kind, shape=(40, 40), mean_pressure=pressure, sigma=sigma, second=True)
                yield Cell(map="contact: roughness height", panel=kind, x=sigma, y=pressure, problem=pressed)


def tilts(*, quick: bool) -> Iterator[Cell[Pressed]]:
    """Maps that do not close on themselves: tilted by so many roughness heights, and offset by a metre."""
    n = 24 if quick else 45
    for label, boundary in BOUNDARIES.items():
        for tilt in (0.0, 100.0) if quick else (0.0, 1.0, 10.0, 100.0, 1000.0):
            for offset in (0.0, 1e-3) if quick else (0.0, 1e-3, 1.0):
                for pressure in (1e8,) if quick else (1e6, 1e8, 1e10):
                    pressed = Pressed(
                        kind="exponential",
                        shape=(n, n),
                        boundary=boundary,
                        mean_pressure=pressure,
                        tilt=tilt,
                        offset=offset,
                    )
                    panel = f"{label}, {pressure / 1e6:g} MPa"
                    yield Cell(map="contact: tilt and offset", panel=panel, x=tilt, y=offset, problem=pressed)


def precisions(*, quick: bool) -> Iterator[Cell[Pressed]]:
    """Heights in single and double precision, tolerances from 1e-1 to 1e-12, good and absurd starts."""
    for row, (single, start) in enumerate(((False, "none"), (True, "none"), (False, "absurd"), (False, "even"))):
        for tolerance in (1e-2, 1e-8) if quick else (0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12):
            for pressure in (2e8,) if quick else (1e5, 2e8, 5e9):
                pressed = Pressed(
                    kind="exponential",
                    shape=(48, 48),
                    mean_pressure=pressure,
                    tolerance=tolerance,
                    single=single,
                    start=start,
                )
                panel = f"{pressure / 1e6:g} MPa"
                yield Cell(map="contact: precision, tolerance, start", panel=panel, x=tolerance, y=row, problem=pressed)
