"""The deterministic film of a scene at one speed, and the grids on which it is solved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ..scene import Scene, check_resolved_gap
from ..surface import Surface
from .domain import lay_out
from .problem import Problem
from .refine import Refined, solve_refined

LEAST, MOST = 32, 512  # cells across, of the coarsest and of the finest grid
KEPT = 0.9  # of Sq, on the coarsest grid


def grids(scene: Scene, surface: Surface) -> tuple[tuple[int, int], ...]:
    """Shapes of the map on the grids to try, coarsest first. They are the map's own shape, halved as long as it keeps
    90 % of Sq and 32 cells across, and doubled up to 512 cells across. With ``numerics.grid = "given"``: half of its
    own, and its own."""
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
    """A function lay(shape): the problem of ``surface`` at ``speed`` [m/s] with the map on ``shape``. For a negative
    speed the map is turned."""
    bodies, contact = scene.bodies, scene.line_contact(abs(speed))
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
    """The deterministic film of ``surface`` at ``speed`` [m/s], not 0, on grids that are fine enough for
    ``numerics.tolerance``.

    Raises `InputError` (`lubfric.scene.resolved_gap`) and `ConvergenceError`.
    """
    check_resolved_gap(scene)
    tolerance = 0.0 if scene.numerics.grid == "given" else scene.numerics.tolerance
    return solve_refined(layer(scene, surface, speed), grids(scene, surface), tolerance=tolerance, start=start)
