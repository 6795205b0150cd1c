"""A scene at one speed, solved as a whole: on which grids, and what a reader has to know."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ..line_contact import LineContact
from ..model import Model
from ..scene import Scene
from ..surface import Surface
from ..validity.bodies import of_motion
from ..validity.entry import Validity
from ..validity.film import of_pressure, of_thickness
from .domain import lay_out
from .problem import Problem
from .refine import Refined, solve_refined
from .takes import check_scene

LEAST, MOST = 32, 512  # cells across, of the coarsest and of the finest grid
KEPT = 0.9  # of Sq, on the coarsest grid
DRAWN, CUT = 0.1, 0.1  # flow drawn from touching cells, load of a Newtonian film sheared beyond f_b p: told above


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


def layer(scene: Scene, surface: Surface, speed: float) -> Callable[[tuple[int, int]], Problem]:
    """lay(shape): the problem of ``surface`` at ``speed`` [m/s], the map on ``shape``; a negative speed turns it."""
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

    return lay


def deterministic_point(scene: Scene, surface: Surface, speed: float, start: Refined | None = None) -> Refined:
    """The deterministic film of ``surface`` at ``speed`` [m/s], not 0, on grids fine enough for ``numerics.tolerance``.

    Raises `InputError` (`lubfric.deterministic.takes`) and `ConvergenceError`.
    """
    check_scene(scene)
    tolerance = 0.0 if scene.numerics.grid == "given" else scene.numerics.tolerance
    return solve_refined(layer(scene, surface, speed), grids(scene, surface), tolerance=tolerance, start=start)


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
        f"load on touching cells {100 * split.touching / load:.3g} %, on asperity spots "
        f"{100 * split.spots / load:.3g} %, "
        f"where the film is sheared beyond f_b p too {100 * split.saturated / load:.3g} %",
        *result.report.notes,
    )


def validity(model: Model, speed: float, found: Refined) -> tuple[Validity, ...]:
    """Entries for all that does not hold; those of bodies and map first."""
    scene, result = model.scene, found.result
    entries = [*model.known, *of_motion(scene, speed, result.central_gap)]
    entries += of_pressure(scene.lubricant, float(result.pressure[result.wet].max(initial=0.0)))
    entries += of_thickness(scene.bodies, result.central_gap)
    lubricant = scene.lubricant
    newtonian = lubricant.eyring_stress is None and lubricant.limiting_stress_coefficient is None
    cut = (result.split.saturated - result.split.spots) / result.load
    if newtonian and cut > CUT:
        consequence = "a Newtonian film there would be sheared beyond f_b p, and was cut to it"
        remedy = "choose lubricant.eyring_stress or a limiting stress"
        entries.append(Validity("share of the load on a saturated film", cut, CUT, "", consequence, remedy))
    if result.drawn > DRAWN:
        consequence = "the film behind them is fed too well"
        remedy = "finer cells (contact.spacing)"
        entries.append(
            Validity("share of the flow out of touching cells", result.drawn, DRAWN, "", consequence, remedy)
        )
    error, tolerance = found.error, scene.numerics.tolerance
    if error is not None and error > tolerance:
        consequence = "the finest grid leaves more than the tolerance"
        remedy = "a finer contact.spacing, a larger tolerance"
        entries.append(Validity("estimated error of the grid in f", error, tolerance, "", consequence, remedy))
    return tuple(entries)
