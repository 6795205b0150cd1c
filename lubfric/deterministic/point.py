"""A scene at one speed, solved as a whole: on which grids, and what a reader has to know."""

from __future__ import annotations

from dataclasses import replace

from ..line_contact import LineContact
from ..point.cautions import ROELANDS_LIMIT, Caution
from ..scene import Scene
from ..surface import Surface
from .domain import lay_out
from .refine import Refined, solve_refined
from .takes import check_scene

LEAST, MOST = 32, 512  # cells across, of the coarsest and of the finest grid
KEPT = 0.9  # of Sq, on the coarsest grid
DRAWN, CUT = 0.1, 0.1  # flow drawn from ruptured valleys, load of a Newtonian film sheared beyond f_b p: told above


def grids(scene: Scene, surface: Surface) -> tuple[tuple[int, int], ...]:
    """Shapes of the map on the grids to be tried, coarsest first: halved while it keeps 90 % of Sq and 32 cells across,
    its own, and doubled up to 512 cells across; its half and its own for ``numerics.grid = "given"``."""
    nx, ny = surface.shape
    if scene.numerics.grid == "given":
        return ((max(nx // 2, 1), max(ny // 2, 1)), (nx, ny))
    shapes = [(nx, ny)]
    while shapes[0][1] >= 2 * LEAST and (len(shapes) < 2 or _keeps(surface, shapes[0])):
        shapes.insert(0, (shapes[0][0] // 2, shapes[0][1] // 2))
    while 2 * shapes[-1][1] <= MOST:
        shapes.append((2 * shapes[-1][0], 2 * shapes[-1][1]))
    return tuple(shapes)


def _keeps(surface: Surface, shape) -> bool:
    half = surface.resampled(shape=(shape[0] // 2, shape[1] // 2))
    return half.sq >= KEPT * surface.sq


def deterministic_point(scene: Scene, surface: Surface, speed: float, start: Refined | None = None) -> Refined:
    """The deterministic film of ``surface`` at ``speed`` [m/s], not 0, on grids fine enough for ``numerics.tolerance``.

    A negative speed turns the map round. Raises `InputError` (`lubfric.deterministic.takes`) and `ConvergenceError`.
    """
    check_scene(scene)
    bodies = scene.bodies
    contact = LineContact(bodies.load / bodies.width, bodies.radius, bodies.e_prime, abs(speed), scene.lubricant)
    if speed < 0:
        surface = replace(surface, heights=surface.heights[::-1], mask=None)

    def lay(shape):
        return lay_out(
            surface if shape == surface.shape else surface.resampled(shape=shape),
            contact,
            sliding=2 * abs(speed),
            boundary_friction=bodies.boundary_friction_coefficient,
            hardness=bodies.hardness,
        )

    shapes = grids(scene, surface)
    tolerance = 0.0 if scene.numerics.grid == "given" else scene.numerics.tolerance
    return solve_refined(lay, shapes, tolerance=tolerance, start=start)


def words(found: Refined) -> str:
    """The film of ``found`` in one phrase: its grids and their estimated error."""
    shapes = " and ".join(f"{r.pressure.shape[0]} x {r.pressure.shape[1]}" for r in found.results[-2:])
    error = "" if found.error is None else f", estimated error {100 * found.error:.2g} % of f"
    return f"one pressure with the contact on {shapes} cells{error}"


def notes(found: Refined) -> tuple[str, ...]:
    """How the load divides by each rule, and how the finest grid was solved."""
    result = found.result
    split, load = result.split, result.load
    return (
        f"load on touching cells {100 * split.touching / load:.3g} %, on asperity spots {100 * split.spots / load:.3g} %, "
        f"where the film is sheared beyond f_b p too {100 * split.saturated / load:.3g} %",
        *result.report.notes,
    )


def cautions(scene: Scene, found: Refined) -> tuple[Caution, ...]:
    """Where the result leaves the range in which the model is meant to hold."""
    told, result, lubricant = [], found.result, scene.lubricant
    peak = float(result.pressure[result.wet].max(initial=0.0))
    if peak > ROELANDS_LIMIT and lubricant.viscosity_law != "constant":
        sentence = f"film pressure {peak / 1e9:.2g} GPa, where the viscosity law is an extrapolation"
        told.append(Caution("film pressure", peak, ROELANDS_LIMIT, "Pa", sentence))
    newtonian = lubricant.eyring_stress is None and lubricant.limiting_stress_coefficient is None
    cut = (result.split.saturated - result.split.spots) / result.load
    if newtonian and cut > CUT:
        remedy = "lubricant.eyring_stress or a limiting stress"
        sentence = f"{100 * cut:.2g} % of the load is on a Newtonian film whose shear was cut at f_b p; choose {remedy}"
        told.append(Caution("load on a film sheared beyond f_b p", cut, CUT, "-", sentence, remedy))
    if result.drawn > DRAWN:
        sentence = f"{100 * result.drawn:.2g} % of the flow under the strip comes out of ruptured valleys, which are taken as full"
        told.append(Caution("flow out of ruptured valleys", result.drawn, DRAWN, "-", sentence))
    error = found.error
    if error is not None and error > scene.numerics.tolerance:
        sentence = f"the finest grid leaves an estimated error of {100 * error:.2g} % in f, above the tolerance"
        told.append(Caution("error of the grid", error, scene.numerics.tolerance, "-", sentence, "numerics.grid"))
    return tuple(told)
