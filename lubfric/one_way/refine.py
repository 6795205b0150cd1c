"""One-way load sharing of a scene on one grid after the other, as fine as the tolerance asks."""

from __future__ import annotations

from ..deterministic.point import grids, layer
from ..deterministic.refine import estimate
from ..scene import Scene
from ..scene.resolved_gap import check_resolved_gap
from ..surface import Surface
from .point import OneWay, solve_one_way


def one_way_point(scene: Scene, surface: Surface, speed: float, start: tuple[OneWay, ...] = ()) -> tuple[OneWay, ...]:
    """One-way load sharing at ``speed`` [m/s], not 0: on two grids, and on finer ones up to the map's own while the
    estimate of `lubfric.deterministic.refine.estimate` is above ``numerics.tolerance``. ``start``: of a neighbour."""
    check_resolved_gap(scene)
    lay = layer(scene, surface, speed)
    found: list[OneWay] = []
    shapes = [shape for shape in grids(scene, surface) if shape[1] <= surface.shape[1]]
    for level, shape in enumerate(shapes):
        near = start[level] if level < len(start) else found[-1] if found else None
        found.append(solve_one_way(lay(shape), near))
        error = estimate([one.coefficient for one in found])
        if scene.numerics.grid != "given" and error is not None and error <= scene.numerics.tolerance:
            break
    return tuple(found)
