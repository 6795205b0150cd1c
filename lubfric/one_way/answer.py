"""One-way load sharing of a scene, on grids as fine as the tolerance asks, and its numbers as a `FrictionResult`."""

from __future__ import annotations

import math
import time
from dataclasses import replace

import numpy as np

from ..deterministic.point import grids, layer
from ..deterministic.refine import estimate
from ..deterministic.takes import check_scene
from ..model import Model
from ..point.decision import Decision
from ..result import FrictionResult
from ..sampling.uncertainty import field_errors_of, not_sampled
from ..scene import Scene
from ..surface import Surface
from ..validity.bodies import of_motion
from ..validity.model_form import one_way_error
from .point import OneWay, solve_one_way

NOT_KNOWN = "not estimated for the one-way closure: one patch, as it is"


def one_way_point(scene: Scene, surface: Surface, speed: float, start: tuple[OneWay, ...] = ()) -> tuple[OneWay, ...]:
    """One-way load sharing at ``speed`` [m/s], not 0: on two grids, and on finer ones up to the map's own while the
    estimate of `lubfric.deterministic.refine.estimate` is above ``numerics.tolerance``. ``start``: of a neighbour."""
    check_scene(scene)
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


def one_way_result(model: Model, speed: float, found: tuple[OneWay, ...], begun: float) -> FrictionResult:
    """The numbers of the finest of ``found``; ``begun``: when the solve did, by `time.perf_counter`."""
    scene, one = model.scene, found[-1]
    bodies, width, strip = scene.bodies, scene.bodies.width, np.abs(one.x) <= scene.bodies.half_width
    error = estimate([o.coefficient for o in found])
    shape = f"{one.gap.shape[0]} x {one.gap.shape[1]} cells"
    decision = Decision(
        film="one-way",
        contact="semi-periodic",
        tolerance=scene.numerics.tolerance,
        film_words=f"in the contact's own gap, of constant density, on {shape}"
        + ("" if error is None else f", estimated error {100 * error:.2g} % of f"),
        forced=("grid",) if scene.numerics.grid == "given" else (),
        notes=one.report.notes,
    )
    central = float(np.interp(0.0, one.x, one.gap.mean(axis=1)))
    passed = (*model.known, *of_motion(scene, speed, central))
    cell = (one.x[1] - one.x[0]) * width / one.gap.shape[1]
    hardness = math.inf if bodies.hardness is None else bodies.hardness
    return FrictionResult(
        speed=speed,
        coefficient=one.coefficient,
        contact_load=one.contact_load * width,
        film_load=one.film_load * width,
        shear_force=(one.couette + one.rolling) * width,
        couette_force=one.couette * width,
        rolling_force=one.rolling * width,
        boundary_force=one.boundary * width,
        real_contact_area_fraction=float(one.closed[strip].mean()),
        real_contact_area=float(one.closed.sum()) * cell,
        plastic_area_fraction=float((one.contact_pressure[strip] >= hardness).mean()),
        min_film=float(one.gap[~one.closed].min()),
        central_film=central,
        mean_gap=float(one.gap[strip].mean()),
        film_to_roughness_ratio=central / model.surface.sq if model.surface.sq > 0 else math.inf,
        inlet_film_factor=1.0,
        flash_temperature_rise=0.0,
        film_temperature_rise=0.0,
        load_residual=(one.contact_load + one.film_load) * width / bodies.load - 1,
        volume_residual=math.nan,
        seconds=time.perf_counter() - begun,
        report=replace(one.report, notes=(decision.text, *(entry.text for entry in passed))),
        decision=decision,
        validity=passed,
        one_way=found,
        uncertainty=replace(
            not_sampled(error, scene, model.surface.size[1], NOT_KNOWN),
            model_form=one_way_error(one.contact_load / (one.contact_load + one.film_load)),
        ),
        errors=field_errors_of({}, NOT_KNOWN),
    )
