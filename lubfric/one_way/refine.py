"""One-way load sharing of a scene on finer and finer grids, until the tolerance is met."""

from __future__ import annotations

from dataclasses import replace

from ..deterministic import LEAST, estimate, grids, layer
from ..scene import Scene, check_resolved_gap
from ..surface import Surface
from .point import OneWay, on_cells, solve_one_way


def one_way_point(scene: Scene, surface: Surface, speed: float, start: tuple[OneWay, ...] = ()) -> tuple[OneWay, ...]:
    """One-way load sharing at ``speed`` [m/s], which is not 0.

    It is solved on two grids, and then on finer ones up to the map's own, while the estimate of
    `lubfric.deterministic.refine.estimate` is above ``numerics.tolerance``. ``start``: the result of a neighbour.
    """
    check_resolved_gap(scene)
    lay = layer(scene, surface, speed)
    found: list[OneWay] = []
    shapes = [shape for shape in grids(scene, surface) if shape[1] <= surface.shape[1]]
    if scene.numerics.grid == "given" and shapes[0][1] >= 2 * LEAST:
        shapes.insert(0, (shapes[0][0] // 2, shapes[0][1] // 2))
    for level, shape in enumerate(shapes):
        near = _near(start, found, level)
        found.append(solve_one_way(lay(shape), near))
        error = estimate([one.coefficient for one in found])
        if scene.numerics.grid != "given" and error is not None and error <= scene.numerics.tolerance:
            break
    return tuple(found)


def _near(start: tuple[OneWay, ...], found: list[OneWay], level: int) -> OneWay | None:
    """Where grid ``level`` starts from: the next coarser grid, corrected by the difference of these two grids at the
    neighbour."""
    if level >= len(start) or not found:
        return found[-1] if found else start[0] if start else None
    coarse, here, coarser = found[-1], start[level], start[level - 1]
    if not coarse.lifted == here.lifted == coarser.lifted:
        return coarse
    unknown = coarse.unknown + here.unknown - coarser.unknown
    spot_film = coarse.spot_film * here.spot_film / coarser.spot_film if coarser.spot_film else coarse.spot_film
    changed = on_cells(coarse, here.x, here.ruptured.shape[1]) != on_cells(coarser, here.x, here.ruptured.shape[1])
    ruptured = here.ruptured ^ changed
    return replace(coarse, x=here.x, ruptured=ruptured, unknown=unknown, spot_film=spot_film)
