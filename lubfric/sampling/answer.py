"""The numbers of one operating point with what is known of their error, on a long line or on one patch."""

from __future__ import annotations

import math
from dataclasses import replace

from ..line_contact import LineContact
from ..model import Model
from ..point.deflection import solved_as_deflected
from ..result import FrictionResult, result_of
from ..scene import Scene
from ..validity.model_form import load_sharing_error
from .estimate import of_line
from .line_friction import line_friction
from .patch_error import of_patch


def answered(model: Model, speed: float, start: FrictionResult | None, fields: bool, begun: float) -> FrictionResult:
    """``model`` at ``speed`` [m/s] on a long line where it has one, else on its patch; ``start``: of a neighbouring
    speed, ``fields``: on the patch's own grid, ``begun``: by `time.perf_counter`."""
    foretell_ends(model, speed)
    if model.lines is not None:
        chosen, line = line_friction(model, speed, None if start is None else start.line)
        result, (uncertainty, errors) = result_of(chosen, speed, line.point, begun), of_line(chosen.scene, line)
        result = replace(result, line=line.start)
    else:
        balance = None if start is None else start.balance
        chosen, point = solved_as_deflected(model, speed, balance, given_grid=fields)
        result, (uncertainty, errors) = result_of(chosen, speed, point, begun), of_patch(chosen, speed, point)
    uncertainty = replace(uncertainty, model_form=_model_form(model.scene, result))
    report = replace(result.report, notes=(*result.report.notes, uncertainty.text))
    return replace(result, uncertainty=uncertainty, errors=errors, report=report)


def foretell_ends(model: Model, speed: float) -> None:
    """Raise `InputError` where the contact is sure to reach the ends of its patch at ``speed`` [m/s]."""
    bodies, film = model.scene.bodies, 0.0
    if speed != 0:
        line_load = bodies.load / bodies.width
        film = LineContact(line_load, bodies.radius, bodies.e_prime, speed, model.scene.lubricant).moes_film
    model.contact.foretell(bodies, film)


def _model_form(scene: Scene, result: FrictionResult) -> float:
    """Known for a cylinder and the half-space contact, which were studied."""
    if scene.contact.geometry != "cylinder" or scene.contact.model != "half-space":
        return math.nan
    return load_sharing_error(result.film_to_roughness_ratio, result.contact_load / scene.bodies.load)
