"""Load sharing between a film and a rough contact, both by finite elements.

A film that carries F_H (`ehl`, full system) is the shape under which the rough strip (`harmonic`) is pressed with F_C =
F_T - F_H. The lubricant volume between the rough surfaces, over the Hertz strip of the total load, has to be that of
the film (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z, Eqs. 8-12). This is one bracketed root in ln(F_H/F_C).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from . import ehl
from .contact import Contact
from .harmonic import Compliance, press
from .report import CONVERGED, ITERATION_LIMIT, SolveReport
from .thinned_film import Law, solve_thinned

POINTS = 16  # of the film in a cell of the contact
PARTS = 10  # of a cell of the film, to integrate shear on
WIDEST = 30.0  # largest |ln(F_H/F_C)| looked at


@dataclass(frozen=True, kw_only=True)
class Bodies:
    """A rough strip under a cylinder.

    ``contact`` is the line contact under the total load F_T, on a line of length width (m). heights (nx, ny) in m are
    on the strip of ``compliance``. hardness is in Pa (inf: elastic), boundary_friction is f_b, and sliding is u2 - u1
    in m/s. The shear acts on surface 2 2.
    """

    contact: ehl.LineContact
    width: float
    compliance: Compliance
    heights: np.ndarray
    hardness: float
    boundary_friction: float
    sliding: float

    @property
    def load(self) -> float:
        """F_T, N."""
        return self.contact.load_per_width * self.width

    @property
    def edges(self) -> np.ndarray:
        """Edges of the cells along x, m."""
        strip = self.compliance.strip
        return np.linspace(-strip.half, strip.half, strip.shape[0] + 1)

    @property
    def weight(self) -> np.ndarray:
        """Share of each cell along x within the Hertz strip of the total load."""
        return self.weight_within(self.contact.half_width)

    def weight_within(self, half_width: float) -> np.ndarray:
        """Return the share of each cell along x within this ``half_width`` (m)."""
        inside = np.clip(self.edges, -half_width, half_width)
        return np.diff(inside) / np.diff(self.edges)

    def under(self, shape: np.ndarray, load: float) -> Under:
        """Return the strip pressed with ``load`` (N) under the film's ``shape`` (nx,)."""
        solution = press(self.compliance, shape[:, None] - self.heights, load / self.width, hardness=self.hardness)
        return Under(np.maximum(solution.gap, 0).mean(axis=1), (solution.pressure > 0).mean(axis=1), solution)


@dataclass(frozen=True, kw_only=True)
class FlatBodies:
    """Bodies as `Bodies`, with roughness that is the same all over the Hertz strip of the total load (paper, Sec. 3.1).

    pressed(mean pressure in Pa) gives the mean gap (m) of a periodic patch, and the share of it in contact.
    """

    contact: ehl.LineContact
    width: float
    pressed: Callable[[float], tuple[float, float]]
    boundary_friction: float
    sliding: float
    cells: int = 64

    @property
    def load(self) -> float:
        """F_T, N."""
        return self.contact.load_per_width * self.width

    @property
    def edges(self) -> np.ndarray:
        """Edges of the cells across the Hertz strip, m."""
        return np.linspace(-self.contact.half_width, self.contact.half_width, self.cells + 1)

    @property
    def weight(self) -> np.ndarray:
        """Weights of the cells: all of them count."""
        return np.ones(self.cells)

    def under(self, shape: np.ndarray, load: float) -> Under:
        """Return the strip pressed with ``load`` (N), whatever the shape of the film."""
        gap, touching = self.pressed(load / (2 * self.contact.half_width * self.width))
        return Under(np.full(self.cells, gap), np.full(self.cells, touching), None)


@dataclass(frozen=True)
class Under:
    """What a film leaves to the contact: mean gap (m), share in contact along x, the strip as pressed."""

    gap: np.ndarray
    touching: np.ndarray
    pressed: Contact | None


@dataclass(frozen=True, kw_only=True)
class SharedLoad:
    """A division of the load.

    Forces are in N, mean_gap and mean_film in m. area is the share of the strip in contact, coefficient is f.
    """

    film_load: float
    contact_load: float
    couette: float
    rolling: float
    coefficient: float
    mean_gap: float
    mean_film: float
    area: float
    film: ehl.EHLSolution
    pressed: Contact | None
    report: SolveReport

    @property
    def shear(self) -> float:
        """Force of the film on surface 2 in the direction in which it slides, N."""
        return math.copysign(1.0, self.couette) * (self.couette + self.rolling)

    @property
    def log_load_ratio(self) -> float:
        """ln(F_H/F_C)."""
        return math.log(self.film_load / self.contact_load)

    @property
    def residual(self) -> float:
        """(gap - film)/(gap + film), which is 0 in balance and grows with the load on the film."""
        return (self.mean_gap - self.mean_film) / (self.mean_gap + self.mean_film)


def share_load(
    bodies: Bodies | FlatBodies,
    *,
    guess: float = 0.0,
    step: float = 1.0,
    refinements: int = 1,
    tolerance: float = 1e-5,
    max_evaluations: int = 40,
) -> SharedLoad:
    """Return the division of the load at which |residual| <= ``tolerance``.

    ``guess`` is that of ln(F_H/F_C), ``step`` the first step from it, ``refinements`` those of the film's mesh. Raises
    `SolveError` with report and last division when the root is not found, and whatever film and contact raise.
    """
    tried: dict[float, SharedLoad] = {}

    def at(log_load_ratio: float) -> float:
        tried[log_load_ratio] = loads_at(bodies, log_load_ratio, refinements)
        return tried[log_load_ratio].residual

    def done() -> bool:
        return abs(best(tried).residual) <= tolerance or len(tried) >= max_evaluations

    root(at, done, guess, step)
    history = tuple(abs(s.residual) for s in tried.values())
    status = CONVERGED if min(history) <= tolerance else ITERATION_LIMIT
    residuals = {"volume": min(history)}
    report = SolveReport(
        solver="load sharing by finite elements",
        status=status,
        iterations=len(history),
        tolerance=tolerance,
        residuals=residuals,
        history=history,
    )
    return report.checked(replace(best(tried), report=report))


def best(tried: dict[float, SharedLoad]) -> SharedLoad:
    """Return the division with the smallest residual."""
    return min(tried.values(), key=lambda s: abs(s.residual))


def root(f: Callable[[float], float], done: Callable[[], bool], guess: float, step: float = 1.0) -> None:
    """Close in on the root of an increasing f: steps outward, then regula falsi in the Illinois form.

    M. Dowell & P. Jarratt, BIT 11 (1971) 168-174, doi:10.1007/BF01934364. Ends when ``done()``.
    """
    a = guess
    fa = f(a)
    while not done():
        b = a - math.copysign(step, fa)
        if abs(b) > WIDEST:
            return
        fb = f(b)
        if fa * fb <= 0:
            break
        a = b
        fa = fb
        step = 2 * step
    while not done():
        c = b - fb * (b - a) / (fb - fa)
        fc = f(c)
        if fc * fb < 0:
            a = b
            fa = fb
        else:
            fa *= 0.5
        b = c
        fb = fc


def loads_at(bodies: Bodies | FlatBodies, log_load_ratio: float, refinements: int) -> SharedLoad:
    """Return film, contact and friction at ln(F_H/F_C) = ``log_load_ratio``."""
    film_load = bodies.load / (1 + math.exp(-log_load_ratio))
    contact_load = bodies.load - film_load
    contact = replace(bodies.contact, load_per_width=film_load / bodies.width)
    if math.isfinite(contact.fluid.eyring_stress) and bodies.sliding:
        law = Law(contact.fluid.eyring_stress)
        _, film = solve_thinned(contact, law, abs(bodies.sliding), refinements=refinements)
    else:
        film = ehl.solve_ehl(contact, refinements=refinements)[-1]
    shape = cell_means(film, bodies.edges)
    under = bodies.under(shape, contact_load)
    weight = bodies.weight / bodies.weight.sum()
    couette, rolling = (bodies.width * f for f in shear(film, bodies.sliding, bodies.edges, 1 - under.touching))
    boundary = bodies.boundary_friction * contact_load * np.sign(bodies.sliding)
    f = float(math.copysign(1.0, bodies.sliding) * (boundary + couette + rolling) / bodies.load)
    gap, mean_film, area = (float(weight @ values) for values in (under.gap, shape, under.touching))
    return SharedLoad(
        film_load=film_load,
        contact_load=contact_load,
        couette=couette,
        rolling=rolling,
        coefficient=f,
        mean_gap=gap,
        mean_film=mean_film,
        area=area,
        film=film,
        pressed=under.pressed,
        report=film.report,
    )


def cell_means(film: ehl.EHLSolution, edges: np.ndarray) -> np.ndarray:
    """Return mean film [m] in each cell."""
    points = edges[:-1, None] + np.diff(edges)[:, None] * (np.arange(POINTS) + 0.5) / POINTS
    return film.at(points.ravel())[1].reshape(points.shape).mean(axis=1)


def shear(film: ehl.EHLSolution, sliding: float, edges: np.ndarray, wet: np.ndarray) -> tuple[float, float]:
    """Return (Couette, rolling) force on surface 2 in N/m: the integrals of eta sliding/h and of (h/2) dp/dx.

    Each is taken times the lubricated share ``wet`` of the cells between ``edges`` (1 outside). The first goes up to
    the rupture, where the film is that of the flow. Both come from far upstream, where the gap is a parabola.
    """
    c = film.contact
    dofs = film.body.line.doflocs[0]
    start = dofs.min() * c.half_width
    end = rupture(film)
    left, right = film.body.line.mesh.p[0][film.body.line.mesh.t] * c.half_width
    x = np.unique([*np.linspace(left, right, PARTS, endpoint=False).ravel(), *edges, end])
    x = x[(x > start) & (x <= end)]
    middle = 0.5 * (x[1:] + x[:-1])
    p, h = film.at(middle)
    share = np.concatenate([[1.0], wet, [1.0]])[np.searchsorted(edges, middle)]
    couette = np.sum(share * c.fluid.stress(np.maximum(p, 0), sliding / h) * np.diff(x))
    rolling = np.sum(share * h / 2 * np.diff(film.at(x)[0]))
    floor = film.H[dofs.argmin()] * c.film_unit - x[0] ** 2 / (2 * c.radius)
    far = [quad(upstream, 0, -1 / x[0], (n, floor, c.radius))[0] for n in (1, 2)]
    couette += c.fluid.viscosity * sliding * far[0]
    rolling += 6 * c.fluid.viscosity * c.entrainment_speed * (far[0] - film.flow_film * far[1])
    return float(couette), float(rolling)


def upstream(t: float, n: int, floor: float, radius: float) -> float:
    """Return integrand of 1/h^n over x to -infinity, in t = -1/x, with h = floor + x^2/2R."""
    return t ** (2 * n - 2) / (floor * t**2 + 1 / (2 * radius)) ** n


def rupture(film: ehl.EHLSolution) -> float:
    """Return where the film behind its minimum is that of the flow (rho h = q/U at p = 0), m."""
    c = film.contact
    order = np.argsort(film.body.x)
    x = film.body.x[order] * c.half_width
    H = film.H[order] * c.film_unit
    thinnest = int(H.argmin())
    past_rupture = thinnest + np.flatnonzero(H[thinnest:] > film.flow_film)[0]

    def excess(at: float) -> float:
        return float(film.at(np.array([at]))[1][0]) - film.flow_film

    return float(brentq(excess, x[thinnest], x[past_rupture], xtol=1e-6 * c.half_width))
