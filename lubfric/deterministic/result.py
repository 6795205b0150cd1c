"""What a deterministic solve returns."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..errors import Report
from .forces import Forces, LoadSplit, forces
from .problem import Problem
from .state import TOUCHING, Look, State


@dataclass(frozen=True)
class DeterministicResult:
    """One operating point: fields on cells (nx, ny), x along the motion; forces per width [N/m].

    - pressure [Pa]: of film and contact together. gap [m]: between the rough surfaces, at least the floor. fill [-]:
      the filled part of the gap, below 1 only where the film has ruptured. touching (bool): h = floor. spots (bool):
      the asperity spots of `lubfric.deterministic.forces`. wet (bool): fluid under pressure outside the spots. shear
      [Pa]: on the moving surface. dent [m]: plastic depth.
    - coefficient: (boundary + couette + rolling)/load. split: the load by four rules; ``split.spots`` is the one used.
    - flow_film [m]: flow/U. min_gap, central_gap (mean at x = 0) and mean_gap (over ``strip``, the columns with |x| <=
      b of the load) [m]. spot_fraction, plastic_fraction: of the area of the strip.
    - drawn: of the lubricant in the film, the share that touching cells of the strip give off, because their floor is
      kept full; the rest enters from upstream.
    - approach [m]: h0. inlet_load [N/m]: carried upstream of the grid. ``state`` starts a neighbouring solve.
    """

    x: np.ndarray
    spacing: tuple[float, float]
    pressure: np.ndarray
    gap: np.ndarray
    fill: np.ndarray
    shear: np.ndarray
    touching: np.ndarray
    spots: np.ndarray
    wet: np.ndarray
    dent: np.ndarray
    coefficient: float
    boundary: float
    couette: float
    rolling: float
    split: LoadSplit
    load: float
    speed: float
    flow_film: float
    min_gap: float
    mean_gap: float
    spot_fraction: float
    plastic_fraction: float
    drawn: float
    central_gap: float
    approach: float
    inlet_load: float
    report: Report
    state: State = field(repr=False)


def assemble(problem: Problem, at: Look, report: Report) -> DeterministicResult:
    """The result at a solved state."""
    found: Forces = forces(problem, at)
    strip = np.abs(problem.x) <= max(problem.contact.half_width, 0.5001 * problem.spacing[0])
    state = at.state
    yielded = state.yielded & (state.dent > 0)
    return DeterministicResult(
        x=problem.x,
        spacing=problem.spacing,
        pressure=state.pressure,
        gap=at.balance.film,
        fill=state.fill,
        shear=found.shear,
        touching=state.kind == TOUCHING,
        spots=found.spots,
        wet=found.wet,
        dent=state.dent,
        coefficient=(found.boundary + found.couette + found.rolling) / problem.load,
        boundary=found.boundary,
        couette=found.couette,
        rolling=found.rolling,
        split=found.split,
        load=problem.load,
        speed=problem.speed,
        flow_film=float(at.balance.inlet.flow.mean()) / problem.speed,
        min_gap=float(at.balance.film.min()),
        mean_gap=float(at.balance.film[strip].mean()),
        spot_fraction=float(found.spots[strip].mean()),
        plastic_fraction=float(yielded[strip].mean()),
        drawn=_drawn(problem, at, strip),
        central_gap=float(np.interp(0.0, problem.x, at.balance.film.mean(axis=1))),
        approach=state.approach,
        inlet_load=at.balance.inlet.load,
        report=report,
        state=state,
    )


def _drawn(problem: Problem, at: Look, strip) -> float:
    source = np.where(at.state.kind == TOUCHING, np.maximum(at.residual, 0.0), 0.0)[strip]
    given = float(source.sum()) * problem.spacing[0] / source.shape[1]
    entering = max(float(at.balance.inlet.flow.mean()), 0.0)
    return given / (given + entering) if given > 0 else 0.0
