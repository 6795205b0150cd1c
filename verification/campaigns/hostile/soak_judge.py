"""Solve the balance of a result again, with another film solver, new dry contacts, and own sums of friction forces.

Only the surface, the dry contact of one map, and the film by differential deflection come from `lubfric`; this module
connects them. A secant through two divisions of the load, that of the result and a neighbouring one, gives the
division that balances. Where it is far from the result, a bracketed root is solved.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from lubfric import (
    EHLResult,
    FrictionResult,
    LubfricError,
    Surface,
    solve_contact,
    solve_differential_deflection,
    solve_ehl,
)
from lubfric.models.load_sharing import error_of_share
from lubfric.models.shared import Prepared
from lubfric.samples import Sample

from ...fem.parts import case_of_scene
from ...types import Keywords
from .soak_force import friction_force
from .soak_heat import inlet_viscosity

ALLOWED = {"load": 2e-3, "friction sum": 1e-9, "bounds": 0.5, "friction": 2.0, "contact share": 2.0}
PIECES = 3  # of the strips, on the scene's own cells and on those of the strips
BY_PIECES = 0.5  # of the stated standard error: what other pieces may change
LOOSE = 2e-3  # tolerance of a film
TIGHT = 1e-4  # tolerance of a film whose friction is a small difference, or feels the pressure spike
CANCELS = 0.2  # f over the sum of the sizes of its parts below which they cancel
ROOT = 2e-4  # of ln(F_H/F_C), to which a bracketed root is found
ACROSS = 8001  # points of a film over a flat strip
BESIDE = 0.05  # of ln(F_H/F_C): distance of the second division of the load from the first
NEAR = 0.4  # of ln(F_H/F_C): as far is a secant of both divisions trusted


@dataclass(frozen=True)
class MappedStrip:
    """Heights [m] of a piece of the surface, less their mean, with its spacing and x [m]."""

    heights: np.ndarray
    spacing: tuple[float, float]
    x: np.ndarray


@dataclass(frozen=True, kw_only=True)
class Sides:
    """Film, mean gap and mean film over A [m], and the share of the width in contact at each x [m]."""

    film: EHLResult
    gap: float
    mean_film: float
    x: np.ndarray
    touching: np.ndarray


@dataclass(frozen=True, kw_only=True)
class Judge:
    """A prepared scene at one speed [m/s].

    The film is deflected by its own pressure or, ``scaled``, by the total load. ``strip`` is the complete sample. In
    addition there are pairs of fine and coarse pieces, whose difference is added.
    """

    prepared: Prepared
    speed: float
    scaled: bool
    strip: MappedStrip
    pairs: tuple[tuple[MappedStrip, MappedStrip], ...] = ()
    film_tolerance: float = LOOSE

    def sides(self, log_load_ratio: float) -> Sides:
        """Return film and contacts at ln(F_H/F_C)."""
        load = self.prepared.scene.bodies.load
        film_load = load / (1 + math.exp(-log_load_ratio))
        film = self.film(film_load, film_load / load if self.scaled else 1.0)
        gap, mean_film, touching = self.pressed(self.strip, film, load - film_load)
        areas: list[float] = []
        for pair in self.pairs:
            (fine, under, more), (coarse, over, fewer) = (self.pressed(piece, film, load - film_load) for piece in pair)
            gap += (fine - coarse) / len(self.pairs)
            mean_film += (under - over) / len(self.pairs)
            areas.append(more.mean() / fewer.mean() if fewer.any() and more.any() else 1.0)
        return Sides(
            film=film,
            gap=gap,
            mean_film=mean_film,
            x=self.strip.x,
            touching=touching * (np.mean(areas) if areas else 1.0),
        )

    def film(self, film_load: float, modulus: float) -> EHLResult:
        """Return the film by differential deflection, or by the tightest Newton solution where that does not converge
        or where shear thins the flow."""
        scene = self.prepared.scene
        case = case_of_scene(scene, film_load, self.speed)
        case |= {"e_prime": modulus * scene.bodies.e_prime, "viscosity": inlet_viscosity(scene, self.speed)}
        stress = scene.lubricant.eyring_stress
        sliding = scene.motion.slide_roll_ratio * self.speed
        try:
            if stress is None:
                return solve_differential_deflection(**case, tolerance=self.film_tolerance)
        except LubfricError:
            pass
        return solve_ehl(**case, sliding=sliding, eyring_stress=stress, tolerance=1e-4)

    def pressed(self, strip: MappedStrip, film: EHLResult, load: float) -> tuple[float, float, np.ndarray]:
        """Return mean gap and mean film over A [m], and share in contact at each x, of a dry contact at ``load``
        [N]."""
        scene = self.prepared.scene
        x = strip.x
        smooth = film.film_at(x)
        flat = scene.contact.geometry == "flat"
        bodies = scene.bodies
        half = bodies.half_width
        if flat:
            pressure = load / (2 * half * bodies.width)
            gap0 = -strip.heights
            weight = np.ones(x.size)
            inner = np.linspace(-half, half, ACROSS)
            mean_film = float(np.trapezoid(film.film_at(inner), inner)) / (2 * half)
        else:
            parabola = x**2 / (2 * bodies.radius)
            share = film.e_prime / bodies.e_prime if self.scaled else 1.0
            pressure = load / (bodies.width * x.size * strip.spacing[0])
            gap0 = (parabola + share * (smooth - parabola))[:, None] - strip.heights
            weight = self._weight(strip)
            mean_film = float(smooth @ weight / weight.sum())
        if load <= 1e-9 * bodies.load:
            return float((weight @ (gap0 - gap0.min()).mean(axis=1)) / weight.sum()), mean_film, np.zeros(x.size)
        settings: Keywords = {"mean_pressure": pressure, "hardness": bodies.hardness, "tolerance": 1e-6}
        boundary = ("periodic" if flat else "free", "periodic")
        dry = solve_contact(gap0, strip.spacing, bodies.e_prime, boundary=boundary, **settings)
        gap = np.maximum(dry.gap, 0)
        touching = dry.pressure > 0
        columns = np.full(x.size, touching.mean()) if flat else touching.mean(axis=1)
        return float(gap.mean(axis=1) @ weight / weight.sum()), mean_film, columns

    def _weight(self, strip: MappedStrip) -> np.ndarray:
        half = self.prepared.scene.bodies.half_width
        dx = strip.spacing[0]
        if self.prepared.scene.contact.region == "box":
            return np.ones(strip.x.size)
        inside = np.minimum(strip.x + dx / 2, half) - np.maximum(strip.x - dx / 2, -half)
        return np.clip(inside / dx, 0, 1)

    def coefficient(self, log_load_ratio: float, sides: Sides) -> tuple[float, float]:
        """Return f at a division of the load, and what the tolerance and the nodes of the film leave open of it."""
        scene = self.prepared.scene
        contact_load = scene.bodies.load / (1 + math.exp(log_load_ratio))
        force, parts, spike = friction_force(scene, sides, contact_load, self.speed)
        return force / scene.bodies.load, (self.film_tolerance * parts + spike) / scene.bodies.load


def judge_of(prepared: Prepared, result: FrictionResult) -> Judge:
    """Return what solves the balance of ``result`` of ``prepared`` anew: a patch on its own cells, or the strips of the
    result."""
    scene = prepared.scene
    parts = abs(result.couette_force) + abs(result.rolling_force) + result.boundary_force
    cancels = abs(result.coefficient) * scene.bodies.load < CANCELS * parts
    oil = scene.lubricant
    newtonian = oil.eyring_stress is None and oil.limiting_stress_coefficient is None  # whose spike f feels
    tolerance = TIGHT if cancels or newtonian or scene.motion.slide_roll_ratio == 0 else LOOSE
    scaled = scene.numerics.film_deflection == "scaled"
    sample = prepared.sample
    pairs: tuple[tuple[MappedStrip, MappedStrip], ...] = ()
    if not sample.represents_more:
        n = prepared.surface.shape[0]
        dx = prepared.surface.spacing[0]
        strip = _strip(prepared.surface, (np.arange(n) - 0.5 * (n - 1)) * dx)
    else:
        while sample.cells.coarsening != result.decision.coarsening:
            sample = sample.halved()
        strip = _strip(sample.joined(range(result.decision.strips)), sample.cells.axis())
        if not sample.cells.is_native:
            pairs = tuple(_pair(sample, i) for i in range(min(PIECES, sample.available_pieces)))
    return Judge(
        prepared=prepared, speed=result.speed, scaled=scaled, strip=strip, pairs=pairs, film_tolerance=tolerance
    )


def _strip(surface: Surface, x: np.ndarray) -> MappedStrip:
    return MappedStrip(surface.heights - surface.heights.mean(), surface.spacing, x)


def _pair(sample: Sample, index: int) -> tuple[MappedStrip, MappedStrip]:
    """Return a piece on its own cells and on those of the strips."""
    cells = sample.cells
    piece = sample.piece(index)
    kept = replace(piece, heights=cells.thinned(piece.heights, cells.coarsening), spacing=cells.spacing)
    return _strip(piece, cells.axis((1, 1))), _strip(kept, cells.axis())


def verdict(prepared: Prepared, result: FrictionResult) -> dict[str, float]:
    """Return deviations of ``result`` by name, over what is allowed. At rest the contact carries all."""
    scene = prepared.scene
    load = prepared.scene.bodies.load
    share = result.contact_load / load
    forces = result.boundary_force + result.shear_force
    results = {
        "load": abs((result.contact_load + result.film_load) / load - 1),
        "friction sum": abs(result.coefficient * load - forces) / max(abs(forces), 1e-300),
        "bounds": 0.0 if -1e-12 <= share <= 1 + 1e-12 and 0 <= result.real_contact_area_fraction <= 1 else 1.0,
    }
    if result.speed == 0:
        results["contact share"] = abs(share - 1) / scene.numerics.tolerance
        expected = scene.bodies.boundary_friction_coefficient
        results["friction"] = abs(result.coefficient / expected - 1) / scene.numerics.tolerance
    elif scene.contact.model == "half-space" and scene.surface.sq:
        stated = max(scene.numerics.tolerance, result.uncertainty.numerical)
        of_share = scene.numerics.tolerance
        judge = judge_of(prepared, result)
        if judge.pairs and share > 0:
            stated += BY_PIECES * result.uncertainty.sampling
            has_limit = scene.lubricant.limit is not None
            by_model = 0.5 * error_of_share(result.film_to_roughness_ratio, share, may_be_film=has_limit)
            of_sample = math.sqrt(max((result.errors.contact_load * share) ** 2 - by_model**2, 0.0))
            of_share = max(of_share, BY_PIECES * of_sample)
        for closely in (False, True):  # cells that touch one by one: a secant of two balances may miss
            (coefficient, open_), contact_share = closed_again(judge, share, closely=closely)
            allowed = stated * abs(result.coefficient) + open_ / ALLOWED["friction"]
            results["friction"] = abs(result.coefficient - coefficient) / allowed
            results["contact share"] = abs(share - contact_share) / of_share
            if max(results[name] / ALLOWED[name] for name in ("friction", "contact share")) <= 1:
                break
    return {name: value / ALLOWED[name] for name, value in results.items()}


def closed_again(judge: Judge, share: float, *, closely: bool = False) -> tuple[tuple[float, float], float]:
    """Return ((f, its error), F_C/F_T) of the balance nearest to a contact that carries ``share`` of the load: from two
    divisions of the load or, ``closely``, by a bracketed root."""
    if share == 0:
        sides = judge.sides(40.0)
        if sides.gap <= sides.mean_film:
            return judge.coefficient(40.0, sides), 0.0
        share = 1e-3
    inside = min(max(share, 1e-13), 1 - 1e-13)
    here = math.log((1 - inside) / inside)
    beside = here + BESIDE
    first = judge.sides(here)
    second = judge.sides(beside)
    off, off_beside = (math.log(s.gap / s.mean_film) for s in (first, second))
    (f, open_) = judge.coefficient(here, first)
    (f_beside, _) = judge.coefficient(beside, second)
    slope = (off_beside - off) / BESIDE
    moved = -off / slope if slope > 0 else math.inf
    if closely or abs(moved) > NEAR:
        return _bracketed(judge, here)
    log_load_ratio = here + moved
    return (f + (f_beside - f) * moved / BESIDE, open_), 1 / (1 + math.exp(log_load_ratio))


def _bracketed(judge: Judge, here: float) -> tuple[tuple[float, float], float]:
    """Close the balance as `closed_again` does, by a root between divisions on both sides of it."""

    def surplus(log_load_ratio: float) -> float:
        sides = judge.sides(log_load_ratio)
        return math.log(sides.gap / sides.mean_film)

    if surplus(40.0) <= 0:
        return judge.coefficient(40.0, judge.sides(40.0)), 0.0
    low = here
    high = low
    step = 0.1
    while surplus(low) > 0:
        low, step = low - step, 3 * step
    step = 0.1
    while surplus(high) < 0 and high < 40:
        high, step = high + step, 3 * step
    log_load_ratio = brentq(surplus, low, high, xtol=ROOT) if high > low else low
    return judge.coefficient(log_load_ratio, judge.sides(log_load_ratio)), 1 / (1 + math.exp(log_load_ratio))
