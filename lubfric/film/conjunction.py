"""Shear stress and temperatures between the bodies, found together."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular

from ..errors import CONVERGED, ITERATION_LIMIT, Report
from ..oil import Lubricant, shear_stress
from .flash import flash_matrix
from .heated_stress import heated_stress

NODES = 257  # at most, of the flash temperature
STEPS = 40
DIFFERENCE = 0.05  # K
TOLERANCE = 1e-6  # of the largest rise


@dataclass(frozen=True)
class Surroundings:
    """The bodies that carry the heat away, and other sources of heat.

    carried: e1 √u1 + e2 √u2 of the bodies; sliding: u2 - u1 [m/s]; contact_heat (n,) [W/m²] of the contact spots and
    wet (n,), the share of the width that the film covers, at the nodes of the film.
    """

    carried: float
    sliding: float
    wet: np.ndarray
    contact_heat: np.ndarray


@dataclass(frozen=True)
class FilmHeat:
    """Temperatures of a film at its nodes, running downstream.

    stress (n,) [Pa] over the film, signed; wall (n,) [K] of the surfaces; film_rise (n,) [K] mean over the film above
    its walls. ``report``: residual, the largest mismatch of the surface temperature over its largest rise.
    """

    stress: np.ndarray
    wall: np.ndarray
    film_rise: np.ndarray
    report: Report

    @property
    def flash(self) -> float:
        """Largest rise of the surfaces [K] (the wall's first node is upstream of all heat)."""
        return float(np.max(self.wall) - self.wall[0])

    @property
    def film(self) -> float:
        """Largest mean rise of the film over its walls [K]."""
        return float(np.max(self.film_rise))


def isothermal_heat(lubricant: Lubricant, x, pressure, film, around: Surroundings) -> FilmHeat:
    """An upper estimate of the temperatures in one pass: the surfaces as hot as the stress of the unheated film makes
    them, and the stress of the film between such surfaces.

    They are hotter than in the solution, so the stress of the heated film lies between this stress and the isothermal
    one.
    """
    nodes = _nodes(x.size)
    stress = shear_stress(lubricant, pressure, around.sliding / film)
    heat = around.wet * np.abs(stress * around.sliding) + around.contact_heat
    wall = lubricant.temperature + flash_matrix(x[nodes], around.carried) @ heat[nodes]
    wall = np.interp(x, x[nodes], wall)
    left, rise = heated_stress(lubricant, pressure, film, around.sliding, wall)
    return FilmHeat(left, wall, rise, Report("heat, one pass", CONVERGED, 1, 0.0, math.inf))


def heated_film(lubricant: Lubricant, x, pressure, film, around: Surroundings, *, raise_on_failure=True) -> FilmHeat:
    """Stress and temperatures of a film. ``x`` (n,) [m] rises downstream; ``pressure`` [Pa] and ``film`` [m] are at its
    nodes.

    The heat of film and contact spots makes the surfaces hot (`flash_matrix`, on at most 257 of the nodes). The stress
    is that of the film between such walls (`heated_stress`). Newton's method finds the wall temperatures. It stops when
    no equation is off by more than 1e-6 of the largest rise. After 40 steps it raises `ConvergenceError` with the
    report.
    """
    nodes = _nodes(x.size)
    at, p, h, wet, extra = (a[nodes] for a in (x, pressure, film, around.wet, around.contact_heat))
    matrix, speed = flash_matrix(at, around.carried), abs(around.sliding)

    def heat(wall):
        return wet * np.abs(heated_stress(lubricant, p, h, around.sliding, wall)[0]) * speed + extra

    def mismatch(rise, made):
        return matrix @ made - rise

    rise, made = np.zeros(at.size), heat(np.full(at.size, lubricant.temperature))
    off, history = mismatch(rise, made), []
    for _ in range(STEPS):
        wall = lubricant.temperature + rise
        slope = (heat(wall + DIFFERENCE) - made) / DIFFERENCE
        step = solve_triangular(np.eye(at.size) - matrix * slope, off, lower=True)
        share = 1.0
        while True:
            new = np.maximum(rise + share * step, 0.0)
            made = heat(lubricant.temperature + new)
            left = mismatch(new, made)
            if np.max(np.abs(left)) < np.max(np.abs(off)) or share < 1e-3:
                break
            share *= 0.5
        rise, off = new, left
        history.append(float(np.max(np.abs(off)) / max(np.max(rise), 1e-9)))
        if history[-1] <= TOLERANCE:
            break
    status = CONVERGED if history[-1] <= TOLERANCE else ITERATION_LIMIT
    report = Report("heat of the film", status, len(history), history[-1], TOLERANCE, history=tuple(history))
    wall = np.interp(x, at, lubricant.temperature + rise)
    stress, film_rise = heated_stress(lubricant, pressure, film, around.sliding, wall)
    found = FilmHeat(stress, wall, film_rise, report)
    if raise_on_failure:
        report.raise_if_failed(found)
    return found


def _nodes(count: int) -> np.ndarray:
    """Indices, evenly spread, of at most `NODES` of ``count`` nodes; first and last are among them."""
    return np.unique(np.linspace(0, count - 1, min(count, NODES)).round().astype(int))
