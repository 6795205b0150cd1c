"""One strip of the surface, solved by both models: the deterministic one, and Eq. (8)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..contact import Strips
from ..deterministic import DeterministicResult, Strip
from ..quantities import NUMBERS
from ..scene import Scene
from ..sharing import Prepared, on_strip, quantities, solve_balance
from .moving import solved_strip
from .scatter import friction_influence, mirrored

PER_LENGTH, PER_HALF_WIDTH = 2.0, 1.0  # cells, at least: in a correlation length, and in b along x


@dataclass(frozen=True)
class Pair:
    """Strip number ``index`` of the sample.

    - ``resolved``: by the deterministic model; ``finer``: on cells half as long (None: not solved); ``longer``: on
      cells twice as long, from which it started. ``shared``: its numbers by Eq. (8).
    - ``deviations``, ``shared_deviations``: of f from place to place along y (ny,), with a mean of 0, by the two
      models. ``mirrored``: whether the second half along y is the mirror image of the first.
    """

    index: int
    resolved: Strip
    longer: Strip
    shared: dict[str, float]
    shared_deviations: np.ndarray
    mirrored: bool = False
    finer: Strip | None = None

    @property
    def deviations(self) -> np.ndarray:
        """Of f by the deterministic model."""
        return deviations(self.resolved)


def deviations(strip: Strip) -> np.ndarray:
    """Of f from place to place along ``strip``."""
    return strip.deviations / strip.result.load


def cells_of(strips: Strips, half_width: float) -> tuple[int, int]:
    """Length of the cells of the deterministic model in cells of the ``strips``, along x and y: 2, or 1 where 2 would
    leave less than `PER_LENGTH` in a correlation length or `PER_HALF_WIDTH` in the ``half_width`` [m], or does not
    divide the strip."""
    (lx, ly), (dx, dy) = strips.lengths, strips.cells.coarse
    along = min(lx / PER_LENGTH, half_width / PER_HALF_WIDTH) >= 2 * dx * (1 - 1e-9)
    across = ly / PER_LENGTH >= 2 * dy * (1 - 1e-9) and round(strips.length / dy) % 2 == 0
    return 1 + along, 1 + across


def solve_pair(prepared: Prepared, speed: float, index: int, slope: float | None) -> Pair:
    """Strip ``index`` at ``speed`` [m/s], not 0. The deterministic model begins on cells twice as long. ``slope``:
    of friction over load [-] (None: found by a second solve). Raises `ConvergenceError`."""
    scene, strips = prepared.scene, prepared.strips
    assert strips is not None
    contact = on_strip(prepared, strips, index)
    fx, fy = cells_of(strips, scene.bodies.half_width)
    longer = 2 * fx, fy if contact.heights.shape[1] % (2 * fy) else 2 * fy
    first = solved_strip(prepared, index, speed, factors=longer)
    strip = solved_strip(prepared, index, speed, factors=(fx, fy), start=first, slope=slope is None)
    strip = replace(strip, slope=strip.slope if slope is None else slope, work=strip.work + first.work)
    balance = solve_balance(scene, speed, contact, prepared.surface.sq)
    loads = balance.film_load, balance.contact_load
    mean = balance.contact.mean_gap if balance.contact_load else balance.contact.mean_film
    numbers = quantities(balance.forces, balance.film, loads, mean)
    by_place = friction_influence(scene, contact, balance) * balance.forces.coefficient
    rows = by_place[: by_place.size // fy * fy].reshape(-1, fy).mean(axis=1)
    return Pair(index, strip, first, numbers, rows, strips.whole and mirrored(contact.heights))


def solve_finer(prepared: Prepared, speed: float, pair: Pair) -> Pair:
    """``pair``, on the cells of the strips too. Raises `ConvergenceError`."""
    finer = solved_strip(prepared, pair.index, speed, start=pair.resolved)
    return replace(pair, finer=replace(finer, slope=pair.resolved.slope))


def numbers_of(scene: Scene, sq: float, result: DeterministicResult) -> dict[str, float]:
    """All numbers of a point but the time, by name; NaN where the model has no such number. ``sq`` [m]: of the
    surface."""
    bodies, width = scene.bodies, scene.bodies.width
    contact_load = result.split.spots * width
    return dict.fromkeys(NUMBERS, math.nan) | {
        "speed": result.speed,
        "coefficient": result.coefficient,
        "contact_load": contact_load,
        "film_load": bodies.load - contact_load,
        "shear_force": (result.couette + result.rolling) * width,
        "couette_force": result.couette * width,
        "rolling_force": result.rolling * width,
        "boundary_force": result.boundary * width,
        "real_contact_area_fraction": result.spot_fraction,
        "real_contact_area": result.spot_length * width,
        "plastic_area_fraction": result.plastic_fraction,
        "min_film": result.min_gap,
        "central_film": result.central_gap,
        "mean_gap": result.mean_gap,
        "film_to_roughness_ratio": result.central_gap / sq if sq > 0 else math.inf,
        "inlet_film_factor": 1.0,
        "flash_temperature_rise": 0.0,
        "film_temperature_rise": 0.0,
        "load_residual": result.report.residuals["load"],
    }
