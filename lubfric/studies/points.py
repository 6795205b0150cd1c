"""The unit of work of sweeps and studies: points of one scene. A point is a function of its scene and speed alone, so
one process or many, in any order, in one call or several, give the same bits."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from .._base import instance
from ..errors import LubfricError, ValidityError
from ..sampling import FrictionResult, friction
from ..scene import Scene
from ..sharing import Prepared, prepare
from .choose import chosen, first_speeds
from .store import Store, digest, fingerprint, point_key

Outcome = FrictionResult | LubfricError


@dataclass(frozen=True)
class Piece:
    """Points of one scene, as a process receives them: at ``speeds`` [m/s], or at speeds that the curve chooses (none).

    ``key``: of the scene (`key_of`); ``kept``: speeds at which film and contact are kept, which chosen ones include;
    ``folder``: of the store, or None.
    """

    scene: Scene | Prepared
    key: str
    speeds: tuple[float, ...]
    kept: frozenset[float] = frozenset()
    folder: str | None = None


def solved(piece: Piece) -> Iterator[tuple[str, float, Outcome | None]]:
    """(key of the scene, speed, outcome) of each point, when it is in the store. A point that fails has its error as
    outcome. If the scene cannot be made ready, that is the error of all. A curve that chose its speeds ends with None.
    """
    store, speeds = Store(piece.folder), piece.speeds
    try:
        model = piece.scene if isinstance(piece.scene, Prepared) else prepare(piece.scene)
        first = speeds or sorted({*first_speeds(model.scene, model.surface.sq), *piece.kept}, reverse=True)
    except LubfricError as error:
        points = _points(store, piece, error, speeds or (math.nan,))
    else:
        solve = partial(_points, store, piece, model)
        points = solve(first) if speeds else chosen(model, first, solve)
    done: tuple[float, ...] = ()
    for speed, outcome in points:
        done = (*done, speed)
        if not speeds:
            store.add(digest(piece.key), (done, False))
        yield piece.key, speed, outcome
    if not speeds:
        store.add(digest(piece.key), (done, True))
        yield piece.key, math.nan, None


def _points(store: Store, piece: Piece, model: Prepared | LubfricError, speeds) -> Iterator[tuple[float, Outcome]]:
    """(speed, outcome) at ``speeds`` [m/s]: from the store, or solved and then in the store, without fields unless they
    are wanted. ``model``: the scene made ready, or why that failed."""
    for speed in speeds:
        key = point_key(piece.key, speed, speed in piece.kept)
        outcome = store.get(key)
        if outcome is None:
            outcome = model if isinstance(model, LubfricError) else _solved(model, speed, speed in piece.kept)
            store.add(key, outcome)
        yield speed, outcome


def _solved(prepared: Prepared, speed: float, fields: bool) -> Outcome:
    try:
        found = friction(prepared, speed, fields=fields)
        return found if fields else found.without_fields()
    except ValidityError as error:
        result = None if error.result is None else error.result.without_fields()
        return ValidityError(error.message, error.entries, result)
    except LubfricError as error:
        return error


def key_of(prepared: Prepared) -> str:
    """The key of a scene that was made ready: a hash of the scene, and of a surface and a contact given to
    `lubfric.prepare`."""
    return fingerprint(prepared) if prepared.given else fingerprint(prepared.scene)


def made_ready(scene: Scene | Prepared, tolerance: float | None = None, model: str | None = None) -> Prepared:
    """``scene`` made ready, with another tolerance on f and another model if they are given."""
    instance("scene", scene, (Scene, Prepared), "what lubfric.load_scene or lubfric.prepare returned")
    changed = {name: value for name, value in (("tolerance", tolerance), ("model", model)) if value is not None}
    if isinstance(scene, Scene):
        return prepare(scene.with_(numerics=changed))
    asked = scene.scene.with_(numerics=changed)
    return scene if asked == scene.scene else prepare(asked, like=scene)
