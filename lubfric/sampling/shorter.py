"""The third level: what cells half as long change, seen on pieces of the surface half as long as a strip.

Relative to f that change hardly depends on speed, far less than it scatters. So pieces are solved at the nearest of
fixed speeds, on which neighbouring points of a curve share them; these follow from the scene alone.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..contact import Strips
from ..deterministic import Strip, changes_of, estimate, solve_strip
from ..errors import ConvergenceError
from ..scene import moves
from ..sharing import Prepared, on_piece
from .moving import map_of
from .pair import Pair, cells_of, longer_than, numbers_of, strip_of
from .sample import speed_of
from .scatter import BlockError, block_error

CELLS = 0.7  # of numerics.sampling_tolerance: standard error that the effect of the cells may leave
MOST_PIECES = 4
SOLVED = 2e-3  # of f: what the tolerance of a strip may move
SHORT = 60.0  # correlation lengths: a strip that is shorter serves as a piece
FIXED = 2.0  # ratio of the expected films at neighbouring fixed speeds

Piece = tuple[Strip, ...]  # on shorter and shorter cells


def on_shorter_cells(
    prepared: Prepared, speed: float, pairs: Sequence[Pair]
) -> tuple[tuple[Piece, ...], BlockError, float]:
    """Solve the third level beside ``pairs``, if it is needed and the roughness rests: its pieces, the standard error
    of their mean relative change of f, and the relative error that the last cells leave. Raises `ConvergenceError`."""
    scene, strips = prepared.scene, prepared.strips
    assert strips is not None
    by_longer = sum(changes_of((pair.longer, pair.resolved))[0] for pair in pairs) / len(pairs)
    left = max(estimate([by_longer]), SOLVED)
    enough = left <= scene.numerics.tolerance and not (strips.whole and scene.numerics.grid == "given")
    own = strips.cells.own and cells_of(strips, scene.bodies.half_width) == (1, 1)
    if enough or own or moves(scene):
        return (), BlockError(0.0, 1), left
    if strips.whole:
        patch = _refined(prepared, speed, 0, pairs[0])
        return (patch,), BlockError(0.0, 1), max(estimate(changes_of(patch)), SOLVED)
    if strips.length < SHORT * strips.lengths[1] and strip_of(prepared, 0)[1] != (1, 1):
        pieces, error = _pieces(prepared, speed, pairs[0])
    else:
        pieces, error = _at_fixed_speed(prepared, speed)
    change = float(np.mean([piece[-1].result.coefficient / piece[1].result.coefficient - 1 for piece in pieces]))
    return pieces, error, max(estimate((by_longer, abs(change))), SOLVED)  # the error of the change is told


def changed(prepared: Prepared, numbers: dict[str, float], pieces: Sequence[Piece]) -> dict[str, float]:
    """``numbers`` of a point on the cells of the second level, as the last ones change them: each by its ratio on the
    ``pieces``; the loads by that of their odds, and the force of the film such that the forces add up to f."""
    rows = [[numbers_of(prepared, piece[k].result) for piece in pieces] for k in (1, -1)]
    before, after = ({name: float(np.mean([row[name] for row in level])) for name in numbers} for level in rows)
    new = {name: value * after[name] / before[name] if before[name] else value for name, value in numbers.items()}
    load, kept = prepared.scene.bodies.load, ("speed", "load_residual", "rolling_force", "film_to_roughness_ratio")
    new |= {name: numbers[name] for name in kept}
    odds = new["contact_load"] / new["film_load"] if new["film_load"] > 0 else math.inf
    new["contact_load"] = load / (1 + 1 / odds) if odds else 0.0
    new["film_load"] = load - new["contact_load"]
    if numbers["contact_load"] > 0:
        new["boundary_force"] = numbers["boundary_force"] * new["contact_load"] / numbers["contact_load"]
    new["shear_force"] = load * new["coefficient"] - new["boundary_force"]
    new["couette_force"] = new["shear_force"] - new["rolling_force"]
    if prepared.surface.sq > 0:
        new["film_to_roughness_ratio"] = new["central_film"] / prepared.surface.sq
    return new


def _at_fixed_speed(prepared: Prepared, speed: float) -> tuple[tuple[Piece, ...], BlockError]:
    """The pieces at the nearest fixed speed; at ``speed`` itself where a given film arrives at any speed, or where they
    cannot be solved there."""
    scene, strips, sq = prepared.scene, prepared.strips, prepared.surface.sq
    assert strips is not None
    if scene.lubricant.inlet_film is not None:
        return _pieces(prepared, speed, None)
    step = round(math.log(scene.line_contact(abs(speed)).expected_film / sq, FIXED))

    def make() -> tuple[tuple[Piece, ...], BlockError] | None:
        there = math.copysign(speed_of(scene, sq * FIXED**step), speed)
        try:
            return _pieces(prepared, there, None)
        except ConvergenceError:
            return None

    def cells(made) -> int:
        return sum(one.problem.heights.size for piece in made[0] for one in piece) if made else 0

    found = prepared.remembered(("reference", strips.cells.factors, "pieces", step, speed > 0), make, cells)
    return found or _pieces(prepared, speed, None)


def _pieces(prepared: Prepared, speed: float, first: Pair | None) -> tuple[tuple[Piece, ...], BlockError]:
    """Pieces at ``speed`` [m/s] until the standard error of their mean relative change of f is small; ``first``: the
    strip that is the first of them (None: all are pieces)."""
    strips, asked = prepared.strips, CELLS * prepared.scene.numerics.sampling_tolerance
    assert strips is not None
    pieces: list[Piece] = []
    error = BlockError(math.inf, 0)
    while len(pieces) < min(strips.pieces, MOST_PIECES) and not error.error <= asked:
        slope = pieces[0][1].slope if pieces else None
        pieces.append(_refined(prepared, speed, len(pieces), None if pieces else first, slope))
        error = _error(pieces, strips)
    return tuple(pieces), error


def _refined(prepared: Prepared, speed: float, index: int, first: Pair | None, slope: float | None = None) -> Piece:
    """A piece of the surface on cells twice as long as those of the strips, on the same, and on cells half as long.
    ``first``: the strip that is it, solved on the first two; of a patch: all of it, on shorter and shorter cells until
    the estimated error is within ``numerics.tolerance``, at last (with ``numerics.grid = "given"`` always) on the map's
    own. ``slope``: of friction over load [-] (None: found by a second solve)."""
    scene, strips = prepared.scene, prepared.strips
    assert strips is not None
    surface, factors = strip_of(prepared, index)
    enough = 0.0 if scene.numerics.grid == "given" else scene.numerics.tolerance
    if first is not None:
        ladder = [first.longer, first.resolved]
    else:
        cells = tuple(f * n for f, n in zip(factors, strips.cells.factors))
        last = max(1, cells[0] // 2), max(1, cells[1] // 2)
        factors = cells[0] // last[0], cells[1] // last[1]
        surface = map_of(prepared, on_piece(prepared, strips, index, last))
        ladder = [solve_strip(scene, surface, speed, factors=longer_than(surface, factors))]
        ladder.append(solve_strip(scene, surface, speed, factors=factors, start=ladder[0], slope=slope is None))
    while factors != (1, 1) and (len(ladder) == 2 or estimate(changes_of(ladder)) > enough):
        factors = max(1, factors[0] // 2), max(1, factors[1] // 2)
        ladder.append(solve_strip(scene, surface, speed, factors=factors, start=ladder[-1]))
    slope = ladder[1].slope if slope is None else slope
    return tuple(replace(one, slope=slope) for one in ladder)


def _error(pieces: Sequence[Piece], strips: Strips) -> BlockError:
    """Standard error of the mean relative change of f from the cells of the second level to the last ones, from place
    to place."""
    changes = []
    for piece in pieces:
        base, last = piece[1], piece[-1]
        places = last.deviations.reshape(base.result.load_at.size, -1).mean(axis=1) - base.deviations
        changes.append((places + last.result.coefficient - base.result.coefficient) / abs(base.result.coefficient))
    return block_error(np.concatenate(changes), pieces[0][1].problem.spacing[1], strips.lengths[1])
