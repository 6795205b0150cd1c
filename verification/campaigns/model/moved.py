"""A rough surface moved through the film once, by the deterministic model: means over the pass, and the balances of its
fields, by formulas of this program."""

import math
from collections.abc import Sequence
from itertools import islice

import numpy as np

import lubfric
from lubfric.film import LineContact
from lubfric.models import DeterministicResult
from lubfric.models.deterministic import (
    TOUCHING,
    Iterate,
    Problem,
    RoughBody,
    evaluated,
    moments,
    solve_strip,
    travelling,
)
from lubfric.scene import Scene

from ...fem.solvers.fluid import Fluid
from ...types import FloatArray, PlainRow

FILMS = (5e-9, 10e-9, 20e-9, 30e-9, 40e-9)  # m
SWEEP = 2.5  # half-widths that the film travels before anything counts
SLOW = 0.5  # of U: slowest roughness for which the lubricant passes one cell in a step
FAST = 2.0  # of U: fastest such roughness
EXACT = 1e-4  # residual of a step, times the cells along x
FLOOR = 1e-9  # m
BALANCES = "mass", "load", "gap", "bounds"


def passed(scene: Scene, bodies: Sequence[RoughBody], speed: float) -> PlainRow:
    """Return means over one pass of the fastest of ``bodies`` (at rest: of the steady film): ``f``, ``central`` and
    ``mean`` gap [m], ``shares`` of the load on gaps below each of `FILMS`, and ``drawn``, the share of the lubricant
    that touching cells give off; the same at rest, from which it starts; ``off``: how far the `BALANCES` are from 0."""
    heights = np.sum([body.surface.heights for body in bodies], axis=0)
    both_maps = lubfric.Surface(heights, bodies[0].surface.spacing, periodic_axes=(True, True))
    upper = next((body.surface for body in bodies if body.upper), None)
    at_rest = solve_strip(scene, both_maps, speed, upper=upper)
    problem = at_rest.problem
    first = row(problem, at_rest.result, given(evaluated(problem, at_rest.result.state)))
    fastest = max(abs(body.speed) for body in bodies)
    if fastest == 0:
        return first | {"rest": first, "off": balances(problem, at_rest.result, [], 0.0, first["given"]), "steps": 0}
    line = problem.line
    dx = problem.spacing[0]
    U = line.entrainment_speed
    width = max(line.half_width, math.sqrt(2 * line.radius * line.moes_film))
    step = dx / (U if SLOW <= fastest / U <= FAST else fastest)
    start = math.ceil(SWEEP * width / (U * step))
    count = max(4, round(both_maps.size[0] / (fastest * step)))
    moving = moments(
        travelling(problem, bodies),
        step,
        start=at_rest.result.state,
        tolerance=EXACT * problem.x.size,
        shift=int(line.half_width > 8 * dx),
    )
    result, sources = zip(*((moment.result, given(moment.at)) for moment in islice(moving, start, start + count + 1)))
    rows = [row(problem, *moment) for moment in zip(result[1:], sources[1:])]
    mean: PlainRow = {name: np.mean([each[name] for each in rows], axis=0).tolist() for name in rows[0]}
    mean["drawn"] = share(mean["given"], mean["enters"])
    at = travelling(problem, bodies)((start + count) * step)
    out = float(np.mean(sources[2:]))
    return mean | {"rest": first, "off": balances(at, result[-1], result, step, out), "steps": start + count}


def row(problem: Problem, result: DeterministicResult, out: float) -> PlainRow:
    """Return the numbers of one moment, in which touching cells give off ``out`` [m²/s]."""
    p = result.pressure
    h = result.gap
    enters = result.flow_film * result.speed
    shares = [float(p[h < film].sum() / p.sum()) for film in FILMS]
    numbers = {"f": result.coefficient, "central": result.central_gap, "mean": result.mean_gap, "given": out}
    return numbers | {"enters": enters, "drawn": share(out, enters), "shares": shares}


def share(out: float, enters: float) -> float:
    """Return the share of the lubricant that is given off."""
    return out / (out + max(enters, 0.0)) if out > 0 else 0.0


def given(at: Iterate) -> float:
    """Return what touching cells give off [m²/s]: their outflow less their inflow, and what they gain."""
    source = np.where(at.state.kind == TOUCHING, at.residual, 0.0)
    return float(source.sum() * at.problem.spacing[0] / source.shape[1])


def balances(
    problem: Problem, result: DeterministicResult, passing: Sequence[DeterministicResult], step: float, out: float = 0.0
) -> dict[str, float]:
    """Return how far fields are from what they must obey.

    - mass: what enters and what touching cells give off (``out`` [m²/s], mean over all but two), less what leaves
      behind the rupture (U times what is there, at the end of the grid) and what is gained, in the steps of ``step``
      [s] between ``passing`` results, over the former; of a steady film (none) at once.
    - load: ∫ p less the load, relative.
    - gap: mean over y of the gap, less parabola, heights and -4/(pi E') ∫ p ln|x - s| ds, up to a constant, over the
      mean gap between the ends of the contact.
    - bounds: the largest violation of p >= 0, 0 <= fill <= 1, p (1 - fill) = 0, h >= 1 nm, relative.
    """
    line = problem.line
    dx = problem.spacing[0]
    x = result.x
    results = passing or (result,) * 4
    U = line.entrainment_speed
    carried = bool(passing) and abs(U * step / dx - 1) < 1e-9
    masses = [held(line, each, each.gap) for each in results]
    rises = -x[0] * dx / line.radius, (dx - x[0]) * dx / line.radius
    kept = _kept_along(masses, rises) if carried else _kept(masses)
    counted = results[3:] if carried else results[2:]  # what the moments before leave needs three of them, or two
    left = [held(line, each, 1.5 * each.gap - 0.5 * np.roll(each.gap, 1, 0))[-1] for each in counted]
    out_of = [m[-1] for m in kept[:-1]] if carried else left
    lost = [U * (each.flow_film - behind.mean()) for each, behind in zip(counted, out_of)]
    gained = float((kept[-1] - kept[0]).mean(axis=1).sum()) * dx / step if passing else 0.0  # in all steps
    source = out * len(counted)
    missing = float(np.sum(lost)) + source - gained
    enters = U * float(np.sum([each.flow_film for each in counted])) + source
    p = result.pressure.mean(axis=1)
    face = x[:, None] - x[None, :]
    a = face + dx / 2
    b = face - dx / 2
    kernel = -4 / (math.pi * line.e_prime) * (a * np.log(np.abs(a)) - b * np.log(np.abs(b)) - dx)
    shape = x**2 / (2 * line.radius) - problem.heights.mean(axis=1) + kernel @ p
    inside = np.abs(x) < line.half_width
    off = (result.gap - result.dent).mean(axis=1)[inside] - shape[inside]
    fill = result.fill
    top = result.pressure.max()
    broken = -result.pressure.min() / top, -fill.min(), fill.max() - 1, (result.pressure * (1 - fill)).max() / top
    return {
        "mass": abs(missing / enters),
        "load": abs(float(p.sum() * dx + result.inlet_load) / problem.load - 1),
        "gap": float(np.ptp(off)) / 2 / result.mean_gap,
        "bounds": max(0.0, *map(float, broken), 1 - result.gap.min() / FLOOR),
    }


def _kept(masses: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Return what cells of these ``masses`` [m] leave to the next step by BDF2, limited."""
    return [np.maximum(1.5 * now - 0.5 * then, 0.5 * now) for then, now in zip(masses, masses[1:])]


def _kept_along(masses: Sequence[np.ndarray], rises: tuple[float, float]) -> list[np.ndarray]:
    """Return the same by BDF3, where masses are followed along the lubricant, by one cell in a step; ``rises`` [m]: of
    the gap from the first cell to the one before, and from that to the next."""
    once = [np.vstack([m[:1] + rises[0], m[:-1]]) for m in masses]
    twice = [np.vstack([m[:1] + rises[1], m[:-1]]) for m in once]
    kept = [(11 * now - 7 * then + 2 * first) / 6 for first, then, now in zip(twice, once[1:], masses[2:])]
    return [np.clip(left, 0.5 * now, 1.5 * now) for left, now in zip(kept, masses[2:])]


def held(line: LineContact, result: DeterministicResult, gap: FloatArray) -> np.ndarray:
    """Return rho h [m] of the lubricant in this ``gap``, over the density at ambient pressure (nx, ny)."""
    law = Fluid(1.0, density_law=line.lubricant.density_law).rho
    return result.fill * law(result.pressure) * gap
