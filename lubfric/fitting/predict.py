"""The computed friction at the measured points, for any values of the parameters."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..errors import ConvergenceError
from ..prepared import Prepared, prepare
from ..scene import Scene
from ..steady import friction
from ..sweep import stribeck
from .measured import SPEED, Measured
from .parameters import Parameters

SHARING = (
    "surface.",
    "counterface.",
    "contact.",
    "bodies.e_prime",
    "bodies.hardness",
)  # of which the map and the contact are made


@dataclass(frozen=True)
class Predictor:
    """f of ``scene`` at the points of ``measured``, for any values of ``parameters``. Each curve is solved to
    ``tolerance``.

    ``like``: a prepared scene whose map and operator or curve serve for all values. None where these depend on the
    values.
    """

    scene: Scene
    measured: Measured
    parameters: Parameters
    tolerance: float
    executor: object = None
    like: Prepared | None = field(default=None, repr=False)

    def at(self, unit: np.ndarray) -> np.ndarray:
        """f (n,) at positions of the parameters between their bounds. Raises `ConvergenceError` when a point fails."""
        scene = self.parameters.into(self.scene, self.parameters.values(np.clip(unit, 0.0, 1.0)))
        scene = scene.with_(numerics={"tolerance": self.tolerance})
        prepared = prepare(scene) if self.like is None else prepare(scene, like=self.like)
        if self.measured.over == SPEED:
            return stribeck(prepared, self.measured.x, self.executor).coefficient
        return _traction(prepared, self.measured.x)


def _traction(prepared: Prepared, slips) -> np.ndarray:
    """f at slide-roll ratios, each started from its neighbour."""
    found, start = [], None
    for slip in slips:
        start = friction(
            prepare(prepared.scene.with_(motion={"slide_roll_ratio": float(slip)}), like=prepared), start=start
        )
        found.append(start.coefficient)
    return np.array(found)


def predictor(scene: Scene, measured: Measured, parameters: Parameters, executor) -> Predictor:
    """A `Predictor` made ready, with a tolerance as tight as the scatter of the measurement asks for."""
    shares = 0.05 if measured.deviation is None else float(np.median(measured.deviation / np.abs(measured.coefficient)))
    tolerance = min(scene.numerics.tolerance, max(0.2 * shares, 1e-3))
    by_curve = scene.contact.geometry == "flat" or scene.numerics.contact_level == "flat"
    making = (*SHARING, "bodies.load", "bodies.radius", "bodies.width") if by_curve else SHARING
    if scene.contact.shape is None:
        making = (*making, "bodies.")
    shared = not any(key.startswith(making) for key in parameters.keys)
    like = prepare(scene.with_(numerics={"tolerance": tolerance})) if shared else None
    return Predictor(scene, measured, parameters, tolerance, executor, like)


def jacobian(predict: Predictor, unit: np.ndarray, here: np.ndarray, step: float) -> np.ndarray:
    """df/d(unit), (n, p), by differences of ``step`` that stay within the bounds."""
    columns = []
    for i in range(unit.size):
        moved = unit.copy()
        moved[i] += step if unit[i] + step <= 1.0 else -step
        try:
            columns.append((predict.at(moved) - here) / (moved[i] - unit[i]))
        except ConvergenceError as error:
            key = predict.parameters.keys[i]
            raise ConvergenceError(
                f"{key} moved by {step:g} of its range: {error}", error.report, error.result
            ) from error
    return np.stack(columns, axis=1)
