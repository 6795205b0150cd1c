"""Friction of a rough film, cell by cell: roughness that the film flattens, pressed together at the film's load sharing.

Load sharing gives the film the pressure and the thickness of smooth surfaces. Between rough surfaces neither is even.
The film presses long waves of the roughness flat where its viscosity is high (Hooke 2006, doi:10.1243/13506501JET146),
and the pressure that does so varies from cell to cell; viscosity and limiting stress follow it. This module

1. filters every wave of the roughness by what the film leaves of it (`flattened`),
2. closes the balance of Eq. (8) again with the flattened roughness,
3. sums the shear stress over the cells, by the local pressure and the local gap (`summed`): f_b p where the gap is below
   the boundary film, the law of the lubricant elsewhere, at most f_b p where it is Newtonian.

It costs as much as one more balance. What it leaves of the error is calibrated (`lubfric.models.load_sharing.calibrated`).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy import fft

from ..._base import increasing_root
from ...contact import HalfSpaceContact
from ...film import EHLResult, LineContact
from ...oil import Lubricant, log_viscosity_ratio, shear_stress
from ...scene import Scene
from ..shared import LIMIT_RANGE, exponents
from .balance import Balance, solve_balance

BOUNDARY_FILM = 20e-9  # m: that of the deterministic model, where the scene gives none
PRESSED = 50e6  # Pa: below it no Newtonian film is at its cap, as in the deterministic model
BULK = 3e9  # Pa: bulk modulus of an oil under pressure; a film thick beside a wave gives by its own compression
LEVELS = 6  # pressures at which the roughness is filtered; between them it is interpolated
# amplitude reduction of waves that pass the inlet, 1/(1 + .17 n + .03 n²), n = wavelength/b M^.75 L^-.5 (SKF 2011; the
# form of Venner and Lubrecht 1999 for line contacts)
PASSING = (0.17, 0.03)
LOWEST_L = 0.1  # of Moes' L in it: below, viscosity hardly depends on pressure and no wave is flattened in the inlet
# how far a body must move, in U, for its waves to pass the inlet as waves and not as a change of the whole film
MOVING = 3.0
# film of the whole load (Moes) over the boundary film at which half of the load on asperities is on saturated films
# thicker than the boundary film, and the steepness about it (68 Newtonian cases of the campaign at rest: medians 0, .12,
# .58, .93, 1 at 1.2, 2.2, 4, 6.5, 11)
HALF_SATURATED = 3.7

# Steepness of that ratio about it.
STEEPNESS = 3
FLOOR = 1e-9  # m: least gap of a cell
THICKEST = 60.0  # of ln(eta/eta0): a solid
# ln of the mean gap of the deterministic model over that of Eq. (8) with flattened roughness: constant, lay
# ln(lx/ly)/ln 5, skewness, share of Sq that is left less .8, ln of the gap over Sq; fitted to the campaign at rest
RISE = (0.072, -0.109, -0.064, 0.561, -0.238)
RISE_BOUNDS = (0.6, 1.8)  # factor of the film, at least and at most


class RoughMap(NamedTuple):
    """Heights [m] (nx, ny) of one body on the cells of a contact, and the speed [m/s] at which they move along x."""

    heights: np.ndarray
    speed: float


@dataclass(frozen=True, kw_only=True)
class RoughFilm:
    """Friction of a rough film by its cells.

    coefficient : f; at_half_film, at_twice_film: with half and with twice the boundary film; at_least_limit,
        at_most_limit: with the limiting stress of a Newtonian lubricant at the ends of `LIMIT_RANGE` instead of f_b p
    asperity : share of the load on cells closer than the boundary film, dry contact among them
    boundary_film_share, saturated_film_share : of the load on the boundary film, and on thicker films whose stress is at a
        limit. Dry contact does not distinguish them; the part of ``asperity`` that is film is an estimate
        (`HALF_SATURATED`)
    kept : Sq of the flattened roughness over that of the roughness
    gap : mean gap [m]; contact : share of the load that the flattened roughness carries in the balance
    rise : factor on the film by the roughness of the inlet; rolling : part of f by the gradient of the pressure
    """

    coefficient: float
    at_half_film: float
    at_twice_film: float
    at_least_limit: float
    at_most_limit: float
    asperity: float
    boundary_film_share: float
    saturated_film_share: float
    kept: float
    gap: float
    contact: float
    rise: float
    rolling: float


def rough_film(
    scene: Scene, speed: float, contact: HalfSpaceContact, balance: Balance, maps: Sequence[RoughMap]
) -> RoughFilm:
    """Return the `RoughFilm` of ``scene`` at ``speed`` [m/s], not 0, from the ``balance`` of load sharing on
    ``contact``, which has the heights of all ``maps`` together. Raises `ConvergenceError`."""
    film = balance.film
    assert film is not None
    sq = float(contact.heights.std())
    step = contact.x[1] - contact.x[0]
    in_hertz = np.abs(contact.x) <= max(scene.bodies.half_width, 0.5001 * step)
    thickness = float(film.film_at(contact.x)[in_hertz].mean())
    pressure = pressure_at(film, contact.x)
    if balance.contact.fields is not None:
        pressure = pressure + balance.contact.fields.pressure.mean(axis=1)
    line = scene.line_contact(abs(speed))
    sliding = abs(scene.motion.slide_roll_ratio * speed)
    direction = math.copysign(1.0, speed)
    rise = 1.0
    for _ in range(2):  # what is left of the roughness decides by how much it lifts the film
        parts = [
            flattened(line, rough, contact.spacing, pressure, rise * thickness, sliding, direction) for rough in maps
        ]
        heights = np.sum([part.heights for part in parts], axis=0)
        kept = float(heights.std()) / sq
        rise = lifted(contact, kept, balance.contact.mean_gap / sq)
    other = with_film_scaled(scene, speed, rise)
    smooth = replace(contact, heights=heights - heights.mean())
    second = solve_balance(other, speed, smooth, max(kept * sq, 1e-12))
    ripple = np.sum([part.pressure for part in parts], axis=0)
    return summed(scene, speed, smooth, second, ripple, kept=kept, rise=rise)


def pressure_at(film: EHLResult, x: np.ndarray) -> np.ndarray:
    """Return the pressure [Pa] of ``film`` at ``x`` [m], 0 beyond its nodes."""
    order = np.argsort(film.x)
    return np.interp(x, film.x[order], film.pressure[order], left=0.0, right=0.0)


class Flattened(NamedTuple):
    """Heights [m] that the film leaves of a rough body, and the pressure [Pa] that takes the rest away, both (nx, ny)."""

    heights: np.ndarray
    pressure: np.ndarray


def flattened(
    line: LineContact,
    rough: RoughMap,
    spacing: tuple[float, float],
    pressure: np.ndarray,
    film: float,
    sliding: float,
    direction: float,
) -> Flattened:
    """Return what a ``film`` [m] thick leaves of the waves of ``rough`` under the mean ``pressure`` [Pa] (nx,).

    Linear response of a film of even thickness, wave by wave (Hooke 2006): with C = h E'κ/(4 K), the bulk modulus K, and
    Q = 48 (u_r - U) k_x/(E' h³ κ (k_x²/η_x + k_y²/η_y)), of the height r there remains h_a = r (1 - iCQ)/(1 - i(1 + C)Q)
    where the wave travels with its body at u_r, and r F - h_a in waves from the inlet, which travel with the lubricant.
    Shear thins the viscosities along and across the sliding. Both waves start in phase at the inlet and drift apart over
    the contact, so that their sum is a mean over its length. ``sliding`` [m/s]: |u2 - u1|; ``direction``: 1 or -1, the sense of U along x.
    """
    e_prime = line.e_prime
    oil = line.lubricant
    nx, ny = rough.heights.shape
    kx = 2 * np.pi * fft.fftfreq(nx, spacing[0])[:, None] * direction
    ky = 2 * np.pi * fft.rfftfreq(ny, spacing[1])[None, :]
    k = np.hypot(kx, ky)
    k[0, 0] = 1.0
    waves = fft.rfft2(rough.heights - rough.heights.mean())
    longer = 2 * np.pi / k / line.half_width * line.M**0.75 * max(line.L, LOWEST_L) ** -0.5
    passing = 1 / (1 + PASSING[0] * longer + PASSING[1] * longer**2)
    speed = line.entrainment_speed
    compliance = film * e_prime * k / (4 * BULK)
    share = math.tanh(MOVING * abs(rough.speed) / speed)
    together = np.sinc(kx * line.half_width * (1 - rough.speed / speed) / np.pi)
    levels = np.unique(np.quantile(np.maximum(pressure, 0.0), np.linspace(0, 1, LEVELS)))
    heights = []
    pressures = []
    for level in levels:
        along, across = viscosities(oil, float(level), sliding, film)
        stiffness = e_prime * film**3 * k * (kx**2 / along + ky**2 / across)
        stiffness[0, 0] = 1.0
        q = 48 * (rough.speed - speed) * kx / np.maximum(stiffness, 1e-300)
        own = (1 - 1j * compliance * q) / (1 - 1j * (1 + compliance) * q)
        inlet = share * (passing - own)
        both = np.abs(own) ** 2 + np.abs(inlet) ** 2 + 2 * together * (own * inlet.conj()).real
        rest = np.abs(1 - own) ** 2 + np.abs(inlet) ** 2 - 2 * together * ((1 - own) * inlet.conj()).real
        left = _with_size(own + together * inlet, np.sqrt(both))
        taken = _with_size(1 - own - together * inlet, np.sqrt(np.maximum(rest, 0.0))) * (k * e_prime / 4)
        left[0, 0] = 0.0
        taken[0, 0] = 0.0
        heights.append(fft.irfft2(waves * left, s=(nx, ny)))
        pressures.append(fft.irfft2(waves * taken, s=(nx, ny)))
    at = np.interp(np.maximum(pressure, 0.0), levels, np.arange(levels.size))
    return Flattened(_between(heights, at), _between(pressures, at))


def _with_size(values: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Return ``size`` with the phases of ``values``; that of 0 is 0."""
    old = np.abs(values)
    return np.where(old > 1e-12, values * (size / np.maximum(old, 1e-12)), size)


def _between(fields: Sequence[np.ndarray], at: np.ndarray) -> np.ndarray:
    """Return row i of the ``fields``, linear between those of numbers around ``at[i]``."""
    lower = np.minimum(at.astype(int), max(len(fields) - 2, 0))
    upper = np.minimum(lower + 1, len(fields) - 1)
    weight = (at - lower)[:, None]
    rows = np.arange(at.size)
    stack = np.asarray(fields)
    return (1 - weight) * stack[lower, rows] + weight * stack[upper, rows]


def viscosities(oil: Lubricant, pressure: float, sliding: float, film: float) -> tuple[float, float]:
    """Return the viscosities [Pa s] that a small pressure flow feels along and across the ``sliding`` [m/s] of a
    ``film`` [m], at ``pressure`` [Pa]."""
    ratio = min(float(log_viscosity_ratio(oil, np.array(pressure))[0]), THICKEST)
    viscosity = oil.viscosity * math.exp(ratio)
    along = across = 1.0
    for law in oil.shear_laws if sliding > 0 else ():
        relative = np.array(viscosity * sliding / film / float(law.critical(np.array(pressure))[0]))
        along += float(law.thinning(relative, along=True)[0]) - 1.0
        across += float(law.thinning(relative, along=False)[0]) - 1.0
    return viscosity / along, viscosity / across


def lifted(contact: HalfSpaceContact, kept: float, gap: float) -> float:
    """Return the factor on the film by the roughness of its inlet (`RISE`): ridges across hold the lubricant back, and
    ridges along let it out. ``kept``: share of Sq that is left; ``gap``: mean gap over Sq."""
    z = contact.heights
    along, across = (
        float(np.sqrt(np.mean(np.diff(z, axis=axis) ** 2))) / step for axis, step in enumerate(contact.spacing)
    )
    lay = math.log(across / along) / math.log(5.0) if along > 0 < across else 0.0
    skewness = float(np.mean(z**3) / np.mean(z**2) ** 1.5)
    features = (1.0, lay, skewness, kept - 0.8, math.log(max(gap, 1e-3)))
    rise = math.exp(sum(factor * feature for factor, feature in zip(RISE, features)))
    return min(max(rise, RISE_BOUNDS[0]), RISE_BOUNDS[1])


def with_film_scaled(scene: Scene, speed: float, factor: float) -> Scene:
    """Return ``scene`` with a viscosity at which its film is ``factor`` times as thick, with closed forms."""
    exponent = exponents(scene.line_contact(abs(speed)))[2]
    oil = replace(scene.lubricant, viscosity=scene.lubricant.viscosity * factor ** (1 / exponent))
    return replace(scene, lubricant=oil)


def summed(
    scene: Scene,
    speed: float,
    contact: HalfSpaceContact,
    balance: Balance,
    ripple: np.ndarray,
    *,
    kept: float = 1.0,
    rise: float = 1.0,
) -> RoughFilm:
    """Return the friction of ``balance`` summed over the cells of ``contact``; ``ripple`` [Pa] (nx, ny): what the
    pressure of its film has in addition to the mean. The pressure of film and contact is shifted by a constant so
    that it carries the load, and is nowhere negative."""
    bodies = scene.bodies
    oil = scene.lubricant
    film = balance.film
    assert film is not None
    cell = contact.spacing[0]
    load = bodies.load / bodies.width
    smooth = pressure_at(film, contact.x)[:, None]
    fields = balance.contact.fields
    if fields is None:
        gap = film.film_at(contact.x)[:, None] - contact.heights
        pressed = np.zeros_like(gap)
    else:
        gap = fields.gap
        pressed = fields.pressure
    gap = np.maximum(gap, FLOOR)
    inside = smooth > 0

    def carried(shift: float) -> np.ndarray:
        return np.maximum(smooth + np.where(inside, ripple - shift, 0.0) + pressed, 0.0)

    def total(field: np.ndarray) -> float:
        return float(field.mean(axis=1).sum()) * cell

    size = float(np.abs(ripple).max()) + float(np.max(smooth + pressed)) + load / cell
    root = increasing_root(
        lambda shift, last: (1 - total(carried(shift * size)) / load, None),
        0.0,
        step=0.01,
        bounds=(-2.0, 2.0),
        tolerance=1e-4,
    )
    pressure = carried(root.x * size)
    pressure *= load / total(pressure)
    sliding = abs(scene.motion.slide_roll_ratio * speed)
    direction = math.copysign(1.0, speed)
    filled = (contact.x * direction < film.rupture * direction)[:, None]
    with np.errstate(over="ignore"):
        law = np.abs(shear_stress(oil, pressure, sliding / gap))
    rubs = bodies.boundary_friction_coefficient * pressure * (sliding > 0)
    thickness = BOUNDARY_FILM if bodies.boundary_film is None else bodies.boundary_film
    rolling = balance.forces.shear.rolling / bodies.width

    shared = 0.0
    if oil.newtonian or oil.limit is not None:
        ratio = scene.line_contact(abs(speed)).moes_film / thickness / HALF_SATURATED
        shared = 1 - 1 / (1 + ratio**STEEPNESS)

    def friction(boundary_film: float, limit: float | None = None) -> float:
        cap = rubs if limit is None else limit * pressure
        asperities = rubs if limit is None or not oil.newtonian else (1 - shared) * rubs + shared * cap
        stress = np.where((pressure > PRESSED) & oil.newtonian, np.minimum(law, cap), law)
        stress = np.where(gap < boundary_film, asperities, np.where(filled, stress, 0.0))
        return (total(stress) + rolling) / load

    thin = gap < thickness
    asperity = total(pressure * thin) / load
    films = total(pressure * (~thin & filled & saturated(oil, pressure, law, rubs))) / load
    return RoughFilm(
        coefficient=friction(thickness),
        at_half_film=friction(0.5 * thickness),
        at_twice_film=friction(2 * thickness),
        at_least_limit=friction(thickness, LIMIT_RANGE[0]),
        at_most_limit=friction(thickness, LIMIT_RANGE[1]),
        asperity=asperity,
        boundary_film_share=(1 - shared) * asperity,
        saturated_film_share=shared * asperity + films,
        kept=kept,
        gap=balance.contact.mean_gap,
        contact=balance.contact_load / bodies.load,
        rise=rise,
        rolling=rolling / load,
    )


def saturated(oil: Lubricant, pressure: np.ndarray, stress: np.ndarray, rubs: np.ndarray) -> np.ndarray:
    """Return where the ``stress`` [Pa] of a film is at its limit: that of the oil, or f_b p, ``rubs``, of a Newtonian
    one above `PRESSED`."""
    if oil.newtonian:
        return (pressure > PRESSED) & (stress >= rubs) & (rubs > 0)
    if oil.limit is None:
        return np.zeros(pressure.shape, bool)
    return stress >= (1 - 1e-9) * oil.limit.critical(pressure)[0]
