"""Elastic shear of the film and of the discs at small slip: the linear branch of a traction curve.

A particle of the film is sheared from where it enters. Its rate of shear is elastic and viscous in turn (Maxwell), with
the shear modulus G of the film and the flow F of its shear law (K. L. Johnson, J. L. Tevaarwerk, Proc. R. Soc. Lond. A
356 (1977) 215-236, doi:10.1098/rspa.1977.0129):

    Δu - U d(c τ_total)/dx = h (F(τ) + (U/G) dτ/dx),   τ_total = wet τ + τ_asperity

c [m/Pa] is the tangential compliance of the two discs, a bed of springs as in Kalker's simplified theory (J. J. Kalker,
Three-Dimensional Elastic Bodies in Rolling Contact, 1990, Ch. 2, doi:10.1007/978-94-015-7889-9): c = 8 b/(π E'), which
gives the traction of a dry line contact at vanishing creep ξ = Δu/U, Q = (π/4) b E' ξ a width (F. W. Carter, Proc. R.
Soc. Lond. A 112 (1926) 151-157, doi:10.1098/rspa.1926.0100). Asperities stick until they bear f_b times their pressure,
and slide then.

The left side is the slip s between the surfaces. The equation is stepped downstream, node by node, by the implicit
Euler method: both sides are explicit in τ, and rise with it, so that each step is one root.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..oil import Lubricant, viscosity

# Steps a cell of the film. Measured: half as many move the force by less than 0.5 % (tests/film/test_elastic_shear.py).
SUBSTEPS = 4
# Relative tolerance of the root of a step [-]. A choice: far below the error of the steps.
ROOT = 1e-10


def disc_compliance(half_width: float, e_prime: float) -> float:
    """Return c [m/Pa] = 8 b/(π E'), the tangential displacement of both discs per shear stress.

    half_width : b [m]; e_prime : E' [Pa]
    """
    return 8.0 * half_width / (np.pi * e_prime)


@dataclass(frozen=True, kw_only=True)
class ElasticContact:
    """What the elastic shear of a contact needs in addition to its film.

    Attributes
    ----------
    compliance : tangential compliance of both discs [m/Pa] (`disc_compliance`)
    x : nodes of the asperity stress, rising [m], (n,)
    asperity_limit : f_b times the mean asperity pressure across the width at each x [Pa], (n,)
    """

    compliance: float
    x: np.ndarray
    asperity_limit: np.ndarray


@dataclass(frozen=True, kw_only=True)
class ElasticShear:
    """The stresses that elastic shear leaves, as shares of those without it.

    Attributes
    ----------
    film_share : of the film's stress at each of its nodes [-], (n,), 0 to 1
    asperity_share : of the friction of the asperities [-], 0 to 1
    """

    film_share: np.ndarray
    asperity_share: float


def elastic_shear(
    lubricant: Lubricant,
    contact: ElasticContact,
    x: np.ndarray,
    pressure: np.ndarray,
    film: np.ndarray,
    *,
    entrainment_speed: float,
    sliding: float,
    wet: np.ndarray,
) -> ElasticShear:
    """Return how much of the isothermal stresses elastic shear leaves.

    Parameters
    ----------
    lubricant : with a shear modulus
    contact : discs and asperities
    x, pressure, film : nodes of the film, rising downstream [m]; pressure [Pa]; thickness [m], (n,) each
    entrainment_speed : U > 0 [m/s]
    sliding : Δu [m/s], its sign does not matter
    wet : share of the width that the film fills in each of the n - 1 cells [-]
    """
    slip = abs(sliding)
    if slip == 0.0:
        return ElasticShear(film_share=np.ones(x.size), asperity_share=0.0)
    steps = np.linspace(0.0, 1.0, SUBSTEPS + 1)[1:]
    fine = np.append(x[0], (x[:-1, None] + np.diff(x)[:, None] * steps).ravel())
    p, h = (np.interp(fine, x, values) for values in (pressure, film))
    limit = np.interp(fine, contact.x, contact.asperity_limit, left=0.0, right=0.0)
    filled = np.repeat(wet, SUBSTEPS)
    dx = np.diff(fine)
    laws = _Laws(lubricant, p)
    viscous = laws.stress(slip / h)
    tau = np.empty(fine.size)
    asperity = np.zeros(fine.size)
    tau[0] = viscous[0]
    total = wet[0] * tau[0]
    for i in range(1, fine.size):
        film_rate = entrainment_speed / dx[i - 1]
        disc_rate = film_rate * contact.compliance
        here = _Node(laws=laws, i=i, film=h[i], before=tau[i - 1], film_rate=film_rate)
        asperity[i] = _step(here, slip, disc_rate, filled[i - 1], total, limit[i])
        tau[i] = here.tau
        total = filled[i - 1] * tau[i] + asperity[i]
    share = np.divide(tau, viscous, out=np.ones(tau.size), where=viscous > 0)[::SUBSTEPS]
    full = float(np.sum(0.5 * (limit[1:] + limit[:-1]) * dx))
    carried = float(np.sum(0.5 * (asperity[1:] + asperity[:-1]) * dx))
    return ElasticShear(film_share=share, asperity_share=carried / full if full > 0 else 1.0)


class _Laws:
    """The shear laws of a lubricant at the nodes: stress of a rate, and rate of a stress."""

    def __init__(self, lubricant: Lubricant, pressure: np.ndarray):
        assert lubricant.shear_modulus is not None
        self.modulus = lubricant.shear_modulus
        self.viscosity = viscosity(lubricant, pressure)
        self.flow = lubricant.flow_law
        self.critical: Any = None
        if self.flow is not None:
            self.critical = np.broadcast_to(self.flow.critical(pressure)[0], pressure.shape)
        limit = lubricant.limit
        self.limit = np.full(pressure.shape, np.inf) if limit is None else limit.critical(pressure)[0]

    def stress(self, rate: np.ndarray) -> np.ndarray:
        """Return the stress [Pa] at each node of a shear ``rate`` [1/s], without elastic shear."""
        newtonian = self.viscosity * rate
        tau = newtonian if self.flow is None else self.flow.stress(newtonian, self.critical)
        return np.minimum(tau, self.limit)

    def rate(self, tau: float, i: int) -> float:
        """Return the viscous shear rate [1/s] at node ``i`` of a stress [Pa] below the limit."""
        if self.flow is None:
            return tau / self.viscosity[i]
        assert self.critical is not None
        with np.errstate(over="ignore"):
            return float(self.flow.newtonian(tau, self.critical[i])) / self.viscosity[i]


@dataclass(kw_only=True)
class _Node:
    """One node of a step: the slip of its film at a stress, and the stress that was found."""

    laws: _Laws
    i: int
    film: float
    before: float
    film_rate: float
    tau: float = 0.0

    def slip(self, tau: float) -> float:
        """Return the slip [m/s] between the surfaces at which the film has the stress ``tau`` [Pa]."""
        elastic = self.film_rate * (tau - self.before) / self.laws.modulus
        return self.film * (self.laws.rate(tau, self.i) + elastic)


def _step(node: _Node, sliding: float, disc_rate: float, wet: float, total: float, limit: float) -> float:
    """Set the stress of the film at ``node``, and return that of the asperities there [Pa], below their ``limit``.

    Where the asperities can bear the stress of the discs without slip, they stick.
    """
    sticking = _root(node, lambda tau: node.slip(tau))
    needed = total + sliding / disc_rate - wet * sticking if disc_rate > 0 else np.inf
    if needed <= limit:
        node.tau = sticking
        return needed
    node.tau = _root(node, lambda tau: node.slip(tau) + disc_rate * (wet * tau + limit - total) - sliding)
    return limit


def _root(node: _Node, rise: Callable[[float], float]) -> float:
    """Return the stress [Pa] at which ``rise``, a rising function of it, is zero; at most the limit at the node."""
    from scipy.optimize import brentq

    most = float(node.laws.limit[node.i])
    if not np.isfinite(most):
        most = 1.0
        for _ in range(60):
            if rise(most) > 0:
                break
            most *= 8.0
    if rise(most) <= 0:
        return most
    least = 0.0 if rise(0.0) <= 0 else -most
    return brentq(rise, least, most, xtol=ROOT * most, rtol=1e-12) if rise(least) < 0 else least
