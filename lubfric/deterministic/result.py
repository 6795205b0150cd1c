"""What a deterministic solve returns: its fields, its friction, and the split of the load between asperity spots and
the film between them.

With one pressure, no equation tells film and contact apart, so the split is a rule:

    A cell belongs to an asperity spot where the bodies touch (h = floor), or where p > 50 MPa, a Newtonian film would
    be sheared above the boundary friction, eta Δu/h > f_b p, and h is less than half its mean over the section.

The second condition finds the summits of a light contact, which carry films of nanometres. Alone it would also mark the
whole of a thick film at high pressure, whose stress is at its limit for another reason. The third condition leaves that
to the film. `LoadSplit` has the load by other rules. The friction coefficient hardly depends on the rule, because the
stress is f_b p on spots, follows the lubricant's law in the film, and is limited to f_b p in a Newtonian film above 50
MPa too.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..errors import Report
from ..oil import shear_stress, viscosity
from .state import FLUID, TOUCHING, Iterate, State

PRESSED = 50e6  # Pa
CLOSE = 0.5  # of the mean gap of the section
MEANS = (
    *("coefficient", "boundary", "couette", "rolling", "flow_film", "mean_gap", "central_gap", "spot_length"),
    *("spot_fraction", "plastic_fraction", "drawn", "inlet_load"),
)  # fields of a `DeterministicResult` that are means over its length along y, as the loads of its ``split`` are


@dataclass(frozen=True)
class LoadSplit:
    """Load [N/m] on the cells that three rules select, from the narrowest: ``touching`` (h = floor); ``spots`` (the
    rule of this module); ``saturated``: p > 50 MPa and eta Δu/h > f_b p, or touching."""

    touching: float
    spots: float
    saturated: float


@dataclass(frozen=True)
class DeterministicResult:
    """One operating point: fields on cells (nx, ny), x along the motion; forces per width [N/m].

    - pressure [Pa]: of film and contact together. gap [m]: between the rough surfaces, at least the floor. fill [-]:
      the filled part of the gap, below 1 only where the film has ruptured. touching (bool): h = floor. spots (bool):
      the asperity spots of this module. wet (bool): fluid under pressure outside the spots. shear [Pa]: on the moving
      surface. dent [m]: plastic depth.
    - boundary: f_b p over the spots. couette, rolling: shear of the film, with that upstream of the grid. coefficient:
      (boundary + couette + rolling)/load. split: the load by three rules; ``split.spots`` is the one used.
    - flow_film [m]: flow/U. min_gap, central_gap (mean at x = 0) and mean_gap (over the strip, the columns with |x| <=
      b of the load) [m]. spot_fraction, plastic_fraction: of the area of the strip.
    - load_at, friction_at [N/m] (ny,): load and friction of every column of cells along x, with those upstream. Their
      means are ``load`` and ``coefficient`` times that.
    - spot_length [m]: area of all spots per length. top_pressure [Pa]: the largest in the film.
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
    load_at: np.ndarray
    friction_at: np.ndarray
    speed: float
    flow_film: float
    min_gap: float
    mean_gap: float
    spot_fraction: float
    spot_length: float
    top_pressure: float
    plastic_fraction: float
    drawn: float
    central_gap: float
    approach: float
    inlet_load: float
    report: Report
    state: State = field(repr=False)


def assemble(at: Iterate, report: Report, pressed=PRESSED, close=CLOSE) -> DeterministicResult:
    """The result at a solved state; ``pressed`` [Pa] and ``close`` [-] are the two numbers of the rule for spots."""
    problem, state, h, inlet = at.problem, at.state, at.balance.film, at.balance.inlet
    p, touching, fluid = state.pressure, state.kind == TOUCHING, state.kind == FLUID
    f_b, rate, dx = problem.boundary_friction, problem.sliding / h, problem.spacing[0]
    with np.errstate(over="ignore"):
        saturated = fluid & (p > pressed) & (viscosity(problem.lubricant, p) * rate > f_b * p)
        law = shear_stress(problem.lubricant, p, rate)
    if problem.lubricant.newtonian:
        law = np.where(saturated, np.minimum(law, f_b * p), law)
    spots = touching | saturated & (h < close * h.mean(axis=1)[:, None])
    wet = fluid & ~spots
    shear = np.where(spots, f_b * p, np.where(fluid, law, 0.0))
    split = LoadSplit(*(float(p[where].sum()) * dx / p.shape[1] for where in (touching, spots, touching | saturated)))
    couette = (shear * wet).sum(axis=0) * dx + problem.lubricant.viscosity * problem.sliding * inlet.shearing
    rolling = _rolling(p, h, wet) + inlet.rolling
    friction = f_b * (p * spots).sum(axis=0) * dx + couette + rolling
    strip = np.abs(problem.x) <= max(problem.contact.half_width, 0.5001 * problem.spacing[0])
    return DeterministicResult(
        x=problem.x,
        spacing=problem.spacing,
        pressure=p,
        gap=h,
        fill=state.fill,
        shear=shear,
        touching=touching,
        spots=spots,
        wet=wet,
        dent=state.dent,
        coefficient=float(friction.mean()) / problem.load,
        boundary=f_b * split.spots,
        couette=float(couette.mean()),
        rolling=float(rolling.mean()),
        split=split,
        load=problem.load,
        load_at=p.sum(axis=0) * dx + inlet.load,
        friction_at=friction,
        speed=problem.speed,
        flow_film=float(inlet.flow.mean()) / problem.speed,
        min_gap=float(h.min()),
        mean_gap=float(h[strip].mean()),
        spot_fraction=float(spots[strip].mean()),
        spot_length=float(spots.sum()) * dx / p.shape[1],
        top_pressure=float(p[wet].max(initial=0.0)),
        plastic_fraction=float((state.yielded & (state.dent > 0))[strip].mean()),
        drawn=_drawn(at, touching, strip),
        central_gap=float(np.interp(0.0, problem.x, h.mean(axis=1))),
        approach=state.approach,
        inlet_load=float(inlet.load.mean()),
        report=report,
        state=state,
    )


def _rolling(p, h, wet) -> np.ndarray:
    """∫ (h/2) dp/dx [N/m] of every column on the grid, between cells that are ``wet`` or without pressure."""
    both = (wet[1:] & wet[:-1]) | (wet[:-1] & (p[1:] == 0)) | (wet[1:] & (p[:-1] == 0))
    return (0.25 * (h[1:] + h[:-1]) * (p[1:] - p[:-1]) * both).sum(axis=0)


def _drawn(at: Iterate, touching, strip) -> float:
    source = np.where(touching, np.maximum(at.residual, 0.0), 0.0)[strip]
    given = float(source.sum()) * at.problem.spacing[0] / source.shape[1]
    entering = max(float(at.balance.inlet.flow.mean()), 0.0)
    return given / (given + entering) if given > 0 else 0.0
