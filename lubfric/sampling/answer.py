"""The numbers of one operating point with what is known of their error, on a long line or on one patch."""

from __future__ import annotations

import math
from dataclasses import replace

from ..model import Model
from ..point.deflection import solved_as_deflected
from ..result import FrictionResult, result_of
from ..scene import Scene
from ..validity.model_form import load_sharing_error
from .estimate import of_line
from .line_friction import line_friction
from .other_cells import by_half_cells, too_coarse
from .patch_error import of_patch


def answered(model: Model, speed: float, start: FrictionResult | None, fields: bool, begun: float) -> FrictionResult:
    """``model`` at ``speed`` [m/s] on a long line where it has one, else on its patch; ``start``: of a neighbouring
    speed, ``fields``: on the patch's own grid, ``begun``: by `time.perf_counter`."""
    if model.lines is not None:
        chosen, line = line_friction(model, speed, None if start is None else start.line)
        result, (uncertainty, errors) = result_of(chosen, speed, line.point, begun), of_line(chosen.scene, line)
        result = replace(result, line=line.start)
        change = line.by_half_cells
    else:
        balance = None if start is None else start.balance
        chosen, point = solved_as_deflected(model, speed, balance, given_grid=fields)
        result, (uncertainty, errors) = result_of(chosen, speed, point, begun), of_patch(chosen, speed, point)
        change = by_half_cells(chosen, speed, point)
    cautions = too_coarse(change, model.scene.numerics.tolerance)
    result = replace(result, validity=(*result.validity, *cautions))
    uncertainty = replace(uncertainty, model_form=_model_form(model.scene, result))
    report = replace(result.report, notes=(*result.report.notes, *(c.text for c in cautions), uncertainty.text))
    return replace(result, uncertainty=uncertainty, errors=errors, report=report)


def _model_form(scene: Scene, result: FrictionResult) -> float:
    """Known for a cylinder and the half-space contact, which were studied."""
    if scene.contact.geometry != "cylinder" or scene.contact.model != "half-space":
        return math.nan
    return load_sharing_error(result.film_to_roughness_ratio, result.contact_load / scene.bodies.load)
