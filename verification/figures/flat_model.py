"""Load sharing of nominally flat surfaces from tables: films once for each load, contact curves once for each surface.

Every surface, contact model and reading of the paper's Figs. 5 and 6 shares the films. So a map of d costs no more than
its films and its contact curves. `lubfric.friction` does the same without tables, and the figure compares some points.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

from lubfric.contact import ContactCurve
from lubfric.film import shear_force, solve_ehl
from lubfric.scene.scene import Scene

from ..parts import case_of_scene

SHARES = np.geomspace(1e-4, 1.0, 13)  # F_H/F_T of the table
POINTS = 128
FINE = 600


@dataclass(frozen=True)
class FilmTable:
    """Films at one load and one speed, by the film shares ``SHARES``.

    They are the mean film over the Hertz strip [m], the shear force F_sh/F_T without contact, and the part of it inside
    the strip. Values in between are read off a fine table.
    """

    film: np.ndarray
    shear: np.ndarray
    strip_shear: np.ndarray

    @cached_property
    def fine(self) -> tuple[np.ndarray, np.ndarray]:
        """ln(F_H/F_T), and there ln film, ln shear and the strip's part of the shear, interpolated by cubics."""
        x = np.linspace(np.log(SHARES[0]), 0.0, FINE)
        nodes = np.stack([np.log(self.film), np.log(self.shear), self.strip_shear / self.shear])
        return x, PchipInterpolator(np.log(SHARES), nodes, axis=1)(x)

    def film_at(self, share: float) -> float:
        """Mean film [m] at F_H/F_T."""
        x, values = self.fine
        return math.exp(np.interp(math.log(share), x, values[0]))

    def shear_at(self, share: float, contact_fraction: float) -> float:
        """F_sh/F_T when ``contact_fraction`` of the strip is in contact. It is linear in that fraction."""
        x, values = self.fine
        whole, inside = (np.interp(math.log(share), x, v) for v in values[1:])
        return math.exp(whole) * (1 - contact_fraction * inside)


@dataclass(frozen=True)
class GapTable:
    """A contact curve on a fine table, from ``touching_gap`` [m] to ``most`` [Pa], which is what it carries."""

    log_pressure: np.ndarray
    gap: np.ndarray
    area: np.ndarray
    touching_gap: float
    most: float

    def at(self, pressure: float) -> tuple[float, float]:
        """Mean gap [m] and contact area fraction. Below the table they are linear in the pressure."""
        x = math.log(max(pressure, 1e-300))
        if x >= self.log_pressure[0]:
            return float(np.interp(x, self.log_pressure, self.gap)), float(np.interp(x, self.log_pressure, self.area))
        share = pressure / math.exp(self.log_pressure[0])
        return self.touching_gap - share * (self.touching_gap - self.gap[0]), share * self.area[0]


def tabulated(curve: ContactCurve) -> GapTable:
    """The `GapTable` of a contact curve, from 1e-7 of the heaviest pressure up."""
    most = float(curve.mean_pressure[0])
    x = np.linspace(math.log(1e-7 * most), math.log(most) - 1e-12, FINE // 3)
    gap, area, _ = np.array([curve.at(math.exp(v)) for v in x]).T
    return GapTable(x, gap, area, curve.touching_gap, most)


def at_mean_pressure(scene: Scene, mean_pressure: float) -> Scene:
    """The scene with the load whose mean Hertz pressure [Pa] is given: w = 32 p^2 R/(pi E')."""
    b = scene.bodies
    return scene.with_(
        bodies={"load": 32 * mean_pressure**2 * b.radius / (math.pi * b.e_prime) * b.width, "hardness": None}
    )


def film_tables(scene: Scene, speed: float, *, scaled: bool, laws) -> list[FilmTable]:
    """A `FilmTable` for each shear law (a dict of `lubfric.Lubricant` fields), all from the same films.

    ``scaled`` takes Johnson's modulus E' F_H/F_T.
    """
    b, lubricant = scene.bodies, scene.lubricant
    half = b.half_width
    x = (np.arange(POINTS) + 0.5 - POINTS / 2) * 2 * half / POINTS
    films, start = [], None
    for share in SHARES[::-1]:
        case = case_of_scene(scene, b.load * share, speed) | {"e_prime": b.e_prime * (share if scaled else 1.0)}
        start = solve_ehl(**case, tolerance=3e-3, start=start)
        films.append(start)
    films = films[::-1]
    thickness = np.array([film.film_at(x).mean() for film in films])
    tables = []

    def none(x):
        return 0 * x[1:]

    def strip(x):
        return np.diff(np.clip(x, -half, half)) / np.diff(x)

    for law in laws:
        keys: dict[str, Any] = {"slide_roll_ratio": scene.motion.slide_roll_ratio, "width": b.width}
        forces = [
            [
                shear_force(film, replace(lubricant, **law), contact_fraction=part, **keys).total
                for part in (none, strip)
            ]
            for film in films
        ]
        whole, outside = np.array(forces).T / b.load
        tables.append(FilmTable(thickness, whole, whole - outside))
    return tables


def share(table: FilmTable, curve: GapTable, mean_pressure: float, boundary_friction: float) -> tuple[float, float]:
    """(f, F_H/F_T) of the balance of load and volume, NaN where the load cannot be carried.

    The mean gap of the contact curve is the mean film, and the contact pressure is the total less the film's share.
    """
    if table.film_at(1.0) >= curve.touching_gap:
        return table.shear_at(1.0, 0.0), 1.0
    most = curve.most
    least_share = max(1 - most / mean_pressure, SHARES[0]) * (1 + 1e-12)

    def surplus(split):
        film_share = 1 / (1 + math.exp(-split))
        return curve.at(min((1 - film_share) * mean_pressure, most))[0] - table.film_at(film_share)

    low, high = math.log(least_share / (1 - least_share)), 25.0
    if surplus(low) > 0:  # the model carries too little even with the thickest film it allows
        return math.nan, math.nan
    split = brentq(surplus, low, high, xtol=1e-7)
    film_share = 1 / (1 + math.exp(-split))
    touching = curve.at(min((1 - film_share) * mean_pressure, most))[1]
    return boundary_friction * (1 - film_share) + table.shear_at(film_share, touching), film_share


def deviation(asperity, half_space) -> tuple[float, int]:
    """d of Eq. (13), max |f_d - f_c|/f_d, and the index of its speed; (NaN, -1) without points."""
    difference = np.abs(np.asarray(asperity) - np.asarray(half_space))
    if not np.isfinite(difference).any():
        return math.nan, -1
    worst = int(np.nanargmax(difference))
    return float(difference[worst] / asperity[worst]), worst
