"""The computed friction at the measured points, for any values of the parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from ..errors import ConvergenceError
from ..sampling import FrictionResult, friction
from ..scene import Scene
from ..sharing import Prepared, prepare
from .fit_parameters import Parameters
from .measured import SPEED, Measured
from .spread import spread

PIECES = 8  # of a curve on an executor
SHARING = (
    "surface.",
    "counterface.",
    "contact.",
    "bodies.e_prime",
    "bodies.hardness",
)  # of which the map and the contact are made
FREE = ("bodies.boundary_friction_coefficient",)  # of the bodies, which neither map nor contact depends on


@dataclass(frozen=True)
class Curve:
    """The computed curve at a position ``unit`` of the parameters: f (n,), and all from which the same points start for
    other values."""

    unit: np.ndarray
    coefficient: np.ndarray
    points: tuple[FrictionResult, ...] = field(repr=False)


@dataclass(frozen=True)
class Predictor:
    """f of ``scene`` at the points of ``measured``, for any values of ``parameters``. Each curve is solved to
    ``tolerance``.

    ``like``: a prepared scene whose map and operator or curve suit all values; None if these depend on the values.
    ``warm``: whether a point can start from that of other values. ``on_points``: called with the number of solved
    points of a curve as they end.
    """

    scene: Scene
    measured: Measured
    parameters: Parameters
    tolerance: float
    executor: object = None
    like: Prepared | None = field(default=None, repr=False)
    warm: bool = True
    on_points: Callable[[int], None] | None = field(default=None, repr=False)

    def at(self, unit: np.ndarray, near: Curve | None = None) -> Curve:
        """The curve at positions of the parameters between their bounds, each point started from that of the curve
        ``near``; without one, from its neighbour. Raises `ConvergenceError` when a point fails."""
        scene = self.parameters.into(self.scene, self.parameters.values(np.clip(unit, 0.0, 1.0)))
        scene = scene.with_(numerics={"tolerance": self.tolerance})
        prepared = prepare(scene) if self.like is None else prepare(scene, like=self.like)
        speeds = self.measured.over == SPEED
        order = np.argsort(-np.abs(self.measured.x) if speeds else self.measured.x)
        base = near if self.warm else None
        executor = None if base is None else self.executor  # the first curve goes from neighbour to neighbour
        pieces = [Piece(prepared, run, self.measured.x[run], speeds) for run in _split(order, executor)]
        if base is not None:
            pieces = [replace(piece, starts=tuple(base.points[i] for i in piece.indices)) for piece in pieces]
        found: dict[int, FrictionResult] = {}
        for index, point in spread(executor, solved, pieces):
            found[index] = point
            if self.on_points:
                self.on_points(len(found))
        points = tuple(found[i] for i in range(order.size))
        return Curve(unit.copy(), np.array([point.coefficient for point in points]), points)


@dataclass(frozen=True)
class Piece:
    """Some points of a curve: their ``indices``, and ``x``, speeds [m/s] or slide-roll ratios; ``starts``: of each."""

    prepared: Prepared
    indices: np.ndarray
    x: np.ndarray
    speeds: bool
    starts: tuple[FrictionResult, ...] = ()


def solved(piece: Piece) -> Iterator[tuple[int, FrictionResult]]:
    """Each point as it ends, with its number in the curve: solved from its start or, without one, from the point before
    it."""
    last: FrictionResult | None = None
    for at, (index, x) in enumerate(zip(piece.indices, piece.x)):
        start = piece.starts[at] if piece.starts else last
        start = start if start is not None and start.starts else None
        prepared, speed = piece.prepared, float(x)
        if not piece.speeds:
            moved = prepared.scene.with_(motion={"slide_roll_ratio": float(x)})
            prepared, speed = prepare(moved, like=prepared), moved.motion.entrainment_speed
        last = friction(prepared, speed, start=start)
        yield int(index), last


def _split(order: np.ndarray, executor) -> list[np.ndarray]:
    return [order] if executor is None else np.array_split(order, min(order.size, PIECES))


def tolerance_of(scene: Scene, measured: Measured) -> float:
    """The tolerance on f of a fit: as tight as the scatter of the measurement requires."""
    shares = 0.05 if measured.deviation is None else float(np.median(measured.deviation / np.abs(measured.coefficient)))
    return min(scene.numerics.tolerance, max(0.2 * shares, 1e-3))


def shares_contact(scene: Scene, parameters: Parameters) -> bool:
    """Whether one map, and one operator or contact curve, suit all values of the parameters."""
    by_curve = scene.contact.geometry == "flat" or scene.numerics.contact_level == "flat"
    making = (
        (*SHARING, "bodies.load", "bodies.hertz_pressure", "bodies.radius", "bodies.width") if by_curve else SHARING
    )
    if scene.contact.shape is None:
        making = (*making, "bodies.")
    return not any(key.startswith(making) and key not in FREE for key in parameters.keys)


def predictor(scene: Scene, measured: Measured, parameters: Parameters, executor, on_points=None) -> Predictor:
    """A `Predictor` made ready."""
    tolerance, shared = tolerance_of(scene, measured), shares_contact(scene, parameters)
    like = prepare(scene.with_(numerics={"tolerance": tolerance})) if shared else None
    warm = shared and "bodies.width" not in parameters.keys  # of which the contacts of a long line are made
    return Predictor(scene, measured, parameters, tolerance, executor, like, warm, on_points)


def jacobian(predict: Predictor, here: Curve, step: float) -> np.ndarray:
    """df/d(unit), (n, p), at the curve ``here``, by differences of ``step`` that stay within the bounds.

    Both ends of a difference start from ``here``: what film level and which cells they take then cancels, and a
    parameter without effect has no slope."""
    unit = here.unit
    same = predict.at(unit, here).coefficient if predict.warm else here.coefficient
    columns = []
    for i in range(unit.size):
        moved = unit.copy()
        moved[i] += step if unit[i] + step <= 1.0 else -step
        try:
            columns.append((predict.at(moved, here).coefficient - same) / (moved[i] - unit[i]))
        except ConvergenceError as error:
            key = predict.parameters.keys[i]
            raise ConvergenceError(
                f"{key} moved by {step:g} of its range: {error}", error.report, error.result
            ) from error
    return np.stack(columns, axis=1)
