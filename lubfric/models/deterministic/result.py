"""What a deterministic solve returns: its fields, its friction, and the part of the load that rubs with f_b.

With one pressure, no equation separates film and contact. What friction needs is where boundary friction begins, and
that is one length, the thickness of the boundary film:

    shear = f_b p where h < boundary film, the bodies' touching cells among them; the lubricant's own law elsewhere.

The stress of a Newtonian lubricant, or of Carreau's law, has no limit of its own. So that of a film above 50 MPa is at
most f_b p. The fields do not depend on that length, so f at half and at twice of it costs no solve.
"""

from dataclasses import dataclass, field

import numpy as np

from ..._base import FloatArray, Renamed
from ...errors import Report
from ...oil import Lubricant, shear_stress
from ..model_answer import ModelDetails
from ..shared import LIMIT_RANGE
from .problem import Problem
from .state import FLUID, TOUCHING, Iterate, State

# Pressure [Pa] below which the stress of a Newtonian film is not limited to f_b p. A choice: below it the stress of any
# film is far below f_b p of an asperity contact.
PRESSED = 50e6


@dataclass(frozen=True, kw_only=True)
class LoadSplit:
    """The load per width [N/m] by what carries it. Parts overlap: ``touching`` is in ``thin``, ``capped`` in
    ``saturated``; ``thin`` and ``saturated`` have nothing in common, and a film below its limit is in none.

    Attributes
    ----------
    touching : on touching cells, h = floor
    thin : on gaps thinner than the boundary film, touching ones among them
    capped : on thicker films of an oil without a limit whose stress is cut to f_b p
    saturated : on all thicker films whose stress is at its limit: that of the oil, or f_b p of one without
    """

    touching: float
    thin: float
    capped: float
    saturated: float

    @property
    def rubbing(self) -> float:
        """The load that rubs with f_b [N/m]."""
        return self.thin + self.capped


@dataclass(frozen=True, kw_only=True)
class DeterministicResult(Renamed, ModelDetails):
    """One operating point of the deterministic model.

    Fields are on cells (nx, ny), x along the motion. Forces are per width [N/m], with what is upstream of the grid.

    Attributes
    ----------
    x, spacing : centres of the cells [m] (nx,), and their lengths along x and y [m]
    pressure : of film and contact together [Pa]
    gap : between the rough surfaces, at least the floor [m]
    fill : filled part of the gap [-], below 1 only where the film has ruptured
    shear : shear stress on surface 2, by the sliding [Pa]
    touching : whether the bodies touch: h = floor
    rubbing : whether the stress is f_b p
    wet : whether there is fluid under pressure that does not rub
    dent : plastic depth [m]
    coefficient : (boundary + couette + rolling)/load [-], of surface 2 against its sliding (`Problem`)
    at_half_film, at_twice_film : ``coefficient`` with half and with twice the boundary film
    sliding_at_half_film, sliding_at_twice_film : their parts (boundary + couette)/load, which no gradient of pressure
        moves
    at_least_limit, at_most_limit : ``coefficient`` with the limiting stress of an oil without one at the ends of
        `LIMIT_RANGE` times p instead of f_b p, on the same fields
    boundary : f_b p over the rubbing cells
    couette : shear of the film by the sliding
    rolling : by the gradient of pressure, and by the pressure on the flanks of a rough surface 2
    rolling_resistance : of both surfaces together, against U: by the gradient of pressure, and by the pressure on the
        flanks of all roughness
    split : the load on rubbing cells, and its parts
    load : of the contact
    load_at, friction_at, couette_at : load, friction and shear of the film by the sliding of every place along y (ny,);
        their means are ``load``, ``coefficient`` times that, and ``couette``
    speed : U [m/s]
    flow_film : flow/U [m]
    min_gap, mean_gap, central_gap : smallest gap, mean over the Hertz strip of the load, and mean at x = 0 [m]
    rubbing_fraction, plastic_fraction : part of the Hertz strip that rubs under pressure, and that is plastic [-]
    rubbing_length : area that rubs under pressure, per length of the line [m]
    top_pressure : the largest in the film [Pa]
    given_off : film at U that touching cells of the Hertz strip give off, because their floor is kept full [m]
    approach : h0 [m]
    inlet_load : load that is carried upstream of the grid
    report : how the solve ended
    state : what a neighbouring solve starts from
    """

    kind = "deterministic"

    x: np.ndarray
    spacing: tuple[float, float]
    pressure: np.ndarray
    gap: np.ndarray
    fill: np.ndarray
    shear: np.ndarray
    touching: np.ndarray
    rubbing: np.ndarray
    wet: np.ndarray
    dent: np.ndarray
    coefficient: float
    at_half_film: float
    at_twice_film: float
    sliding_at_half_film: float
    sliding_at_twice_film: float
    at_least_limit: float
    at_most_limit: float
    boundary: float
    couette: float
    rolling: float
    rolling_resistance: float
    split: LoadSplit
    load: float
    load_at: np.ndarray
    friction_at: np.ndarray
    couette_at: np.ndarray
    speed: float
    flow_film: float
    min_gap: float
    mean_gap: float
    rubbing_fraction: float
    rubbing_length: float
    top_pressure: float
    plastic_fraction: float
    given_off: float
    central_gap: float
    approach: float
    inlet_load: float
    report: Report
    state: State = field(repr=False)
    _RENAMED = {
        "spots": "rubbing",
        "spot_fraction": "rubbing_fraction",
        "spot_length": "rubbing_length",
        "given": "given_off",
        "drawn": "share_given_off",
    }

    @property
    def share_given_off(self) -> float:
        """Share of the lubricant that touching cells give off (``given_off``); in motion that of the means over time
        [-]."""
        return self.given_off / (self.given_off + max(self.flow_film, 0.0)) if self.given_off > 0 else 0.0


@dataclass(frozen=True, kw_only=True)
class SurfaceShear:
    """How the fields shear surface 2.

    Attributes
    ----------
    thin : whether the gap is thinner than the boundary film (nx, ny)
    rubbing : whether the stress is f_b p (nx, ny)
    wet : whether fluid is sheared by its own law (nx, ny)
    stress : shear stress [Pa] (nx, ny)
    boundary : force of the rubbing cells of every place along y [N/m] (ny,)
    couette, rolling : force of the film by sliding and by rolling, with what is upstream of the grid [N/m] (ny,)
    rolling_resistance : of both surfaces together, against U [N/m] (ny,)
    """

    thin: np.ndarray
    rubbing: np.ndarray
    wet: np.ndarray
    stress: np.ndarray
    boundary: np.ndarray
    couette: np.ndarray
    rolling: np.ndarray
    rolling_resistance: np.ndarray

    @property
    def friction(self) -> np.ndarray:
        """The friction of every place along y [N/m] (ny,)."""
        return self.boundary + self.couette + self.rolling


def surface_shear(at: Iterate, law: np.ndarray, boundary_film: float) -> SurfaceShear:
    """Return the shear stress of the surfaces and its forces, with a boundary film of ``boundary_film`` [m]. ``law``:
    the stress [Pa] that the lubricant has by itself (nx, ny)."""
    problem = at.problem
    p = at.state.pressure
    h = at.mass_balance.flow_gap
    inlet = at.mass_balance.inlet
    slides = problem.sliding > 0  # in pure rolling cells that rub do not slide
    limit = problem.boundary_friction * p if slides else np.zeros_like(p)
    dx = problem.spacing[0]
    fluid = at.state.kind == FLUID
    thin = (at.state.kind == TOUCHING) | fluid & (h < boundary_film)
    rubbing = thin | fluid & (p > PRESSED) & (law > limit) if problem.lubricant.has_unlimited_stress else thin
    wet = fluid & ~rubbing
    both = (wet[1:] & wet[:-1]) | (wet[:-1] & (p[1:] == 0)) | (wet[1:] & (p[:-1] == 0))
    stress = np.where(rubbing, limit, np.where(wet, law, 0.0))
    couette = (stress * wet).sum(axis=0) * dx + problem.lubricant.viscosity * problem.sliding * inlet.shearing
    by_gradient = (0.25 * (h[1:] + h[:-1]) * (p[1:] - p[:-1]) * both).sum(axis=0) + inlet.rolling

    def on_flanks(heights: np.ndarray | None) -> float | FloatArray:
        """The force [N/m] along x of the pressure on the flanks of ``heights`` [m]; None: there are none."""
        return 0.0 if heights is None else (0.5 * (p[1:] + p[:-1]) * np.diff(heights, axis=0)).sum(axis=0)

    return SurfaceShear(
        thin=thin,
        rubbing=rubbing,
        wet=wet,
        stress=stress,
        boundary=(limit * rubbing).sum(axis=0) * dx,
        couette=couette,
        rolling=problem.sense * (by_gradient - on_flanks(problem.upper)),
        rolling_resistance=2.0 * by_gradient - on_flanks(problem.heights),
    )


def change_with_oil(result: "DeterministicResult", sliding: float, lubricant: Lubricant) -> float:
    """Return the change of f [-] of a ``result`` if its films had the shear stress of another ``lubricant``, which is
    not Newtonian, as that of the result is not, at the same pressures and gaps; ``sliding``: sliding speed [m/s]."""
    stress = stress_with_oil(result, sliding, lubricant)
    return float((stress - result.shear).sum()) * result.spacing[0] / result.pressure.shape[1] / result.load


def stress_with_oil(result: "DeterministicResult", sliding: float, lubricant: Lubricant) -> np.ndarray:
    """Return the shear stress [Pa] (nx, ny) of a ``result`` if its films had that of another ``lubricant``
    (`change_with_oil`)."""
    with np.errstate(over="ignore"):
        law = shear_stress(lubricant, result.pressure, sliding / result.gap)
    return np.where(result.wet, law, result.shear)


def share_moved_by_hardness(pressure: np.ndarray, hardness: float, other: float) -> float:
    """Return the part of the load that leaves its cells, or comes to those that yield, if the ``hardness`` [Pa] were
    the ``other`` one; ``pressure`` [Pa]: of the cells, up to the hardness."""
    if other < hardness:
        moved = np.maximum(pressure - other, 0.0)
    else:
        moved = np.where(pressure >= hardness, other - hardness, 0.0)
    return float(moved.sum() / pressure.sum())


def at_its_limit(lubricant: Lubricant, pressure: np.ndarray, stress: np.ndarray) -> np.ndarray:
    """Return where the ``stress`` [Pa] of ``lubricant`` is its limiting stress at the ``pressure`` [Pa]."""
    if lubricant.limit is None:
        return np.zeros(pressure.shape, bool)
    return stress >= (1 - 1e-9) * lubricant.limit.critical(pressure)[0]


def with_limit(problem: Problem, sheared: SurfaceShear, pressure: np.ndarray, law: np.ndarray, limit: float) -> float:
    """Return the change of f [-] if the stress of a film without a limit above `PRESSED` were at most ``limit`` times
    the ``pressure`` [Pa] instead of f_b times it; ``law`` [Pa]: the stress without a limit."""
    if not problem.lubricant.has_unlimited_stress:
        return 0.0
    films = (sheared.wet | (sheared.rubbing & ~sheared.thin)) & (pressure > PRESSED)
    change = np.where(films, np.minimum(law, limit * pressure) - sheared.stress, 0.0)
    return float(change.sum()) * problem.spacing[0] / pressure.shape[1] / problem.load


def assemble(at: Iterate, report: Report) -> DeterministicResult:
    """Return the result at a solved state."""
    problem = at.problem
    state = at.state
    h = at.mass_balance.flow_gap
    inlet = at.mass_balance.inlet
    p = state.pressure
    dx = problem.spacing[0]
    touching = state.kind == TOUCHING
    fluid = state.kind == FLUID
    with np.errstate(over="ignore"):
        law = shear_stress(problem.sheared or problem.lubricant, p, problem.sliding / h)
    sheared, *others = (surface_shear(at, law, times * problem.boundary_film) for times in (1.0, 0.5, 2.0))
    coefficients = [float(one.friction.mean()) / problem.load for one in (sheared, *others)]
    sliding = [float((one.boundary + one.couette).mean()) / problem.load for one in others]
    rubbing = sheared.rubbing
    carrying = rubbing & (p > 0)  # a thin film without pressure, behind the contact, is no contact
    capped = rubbing & ~sheared.thin
    saturated = capped | (sheared.wet & at_its_limit(problem.sheared or problem.lubricant, p, law))

    def load_on(cells: np.ndarray) -> float:
        return float(p[cells].sum()) * dx / p.shape[1]

    in_hertz = np.abs(problem.x) <= max(problem.line.half_width, 0.5001 * problem.spacing[0])
    return DeterministicResult(
        x=problem.x,
        spacing=problem.spacing,
        pressure=p,
        gap=h,
        fill=state.fill,
        shear=sheared.stress,
        touching=touching,
        rubbing=rubbing,
        wet=sheared.wet,
        dent=state.dent,
        coefficient=coefficients[0],
        at_half_film=coefficients[1],
        at_twice_film=coefficients[2],
        sliding_at_half_film=sliding[0],
        sliding_at_twice_film=sliding[1],
        at_least_limit=coefficients[0] + with_limit(problem, sheared, p, law, LIMIT_RANGE[0]),
        at_most_limit=coefficients[0] + with_limit(problem, sheared, p, law, LIMIT_RANGE[1]),
        boundary=float(sheared.boundary.mean()),
        couette=float(sheared.couette.mean()),
        rolling=float(sheared.rolling.mean()),
        rolling_resistance=float(sheared.rolling_resistance.mean()),
        split=LoadSplit(
            touching=load_on(touching),
            thin=load_on(sheared.thin),
            capped=load_on(capped),
            saturated=load_on(saturated),
        ),
        load=problem.load,
        load_at=p.sum(axis=0) * dx + inlet.load,
        friction_at=sheared.friction,
        couette_at=sheared.couette,
        speed=problem.speed,
        flow_film=float(inlet.flow.mean()) / problem.speed,
        min_gap=float(h.min()),
        mean_gap=float(h[in_hertz].mean()),
        rubbing_fraction=float(carrying[in_hertz].mean()),
        rubbing_length=float(carrying.sum()) * dx / p.shape[1],
        top_pressure=float(p[fluid & ~sheared.thin].max(initial=0.0)),
        plastic_fraction=float((state.yielded & (state.dent > 0))[in_hertz].mean()),
        given_off=float(np.where(touching, np.maximum(at.residual, 0.0), 0.0)[in_hertz].sum())
        * dx
        / (p.shape[1] * problem.speed),
        central_gap=float(np.interp(0.0, problem.x, h.mean(axis=1))),
        approach=state.approach,
        inlet_load=float(inlet.load.mean()),
        report=report,
        state=state,
    )
