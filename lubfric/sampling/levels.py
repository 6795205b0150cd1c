"""Friction of an endless line by the deterministic model, as a sum over levels of cost.

    f = [f of Eq. (8) on the long line of the sample]               many strips
      + mean over strips (f deterministic - f of Eq. (8))           a few of the same strips
      + mean over strips (f on cells half as long - f)              fewer still

The second level needs few strips where both models scatter alike, as they do about lift-off on most surfaces. Where
they do not, the first level is left out, and the second is the deterministic f alone. Which of the two needs fewer
strips is read off those that are solved (M. B. Giles, Oper. Res. 56 (2008) 607-617, doi:10.1287/opre.1070.0496).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..contact import Strips
from ..deterministic import Strip, estimate
from ..scene import moves
from ..sharing import Prepared, quantities
from .pair import Pair, cells_of, deviations, numbers_of, solve_finer, solve_pair
from .sample import Found, enlarged
from .scatter import BlockError, add_errors, place_error
from .uncertainty import ORDER, student

DIFFERENCE = 0.85  # of numerics.model_tolerance: half-width that the scatter of the difference may leave
CELLS = 0.7  # of numerics.sampling_tolerance: standard error that the effect of the cells may leave
ALONE = 1.2  # scatter of the deterministic f between strips over that of blocks along them
SOLVED = 1.5e-3  # of f: what the tolerance of a strip may move
GROWTH = 4.0, 2.0  # of the number of strips: those that are solved are kept
MOST_WORK = 120.0  # s, counted: of the strips of one point
FEWEST = 3  # strips whose scatter tells an error
LINEAR = (  # numbers of Eq. (8) that a difference is added to
    *("coefficient", "contact_load", "film_load", "shear_force", "couette_force", "rolling_force", "boundary_force"),
    "mean_gap",
)
OTHER_FILMS = ("at_half_film", "at_twice_film")  # f, with another boundary film


@dataclass(frozen=True)
class Levels:
    """The sum over levels.

    - ``numbers``: of the deterministic model on an endless line, by name; ``errors``: their relative standard errors.
      ``by_film``: relative change of f by half and by twice the boundary film.
    - ``line``: number of strips of the first level (0: it was left out); ``pairs``: the strips of the second and third.
    - relative errors of f: ``sampling``, standard, by the number of strips; ``difference``, standard, by that between
      the models; ``numerical``, by the cells of the last level. ``length`` [m]: of all strips.
    """

    numbers: dict[str, float]
    errors: dict[str, float]
    by_film: tuple[float, ...]
    line: int
    pairs: tuple[Pair, ...]
    sampling: BlockError
    difference: BlockError
    numerical: float
    length: float

    @property
    def finer(self) -> int:
        """Number of strips of the third level."""
        return sum(pair.finer is not None for pair in self.pairs)


def levels_of(prepared: Prepared, speed: float, found: Found) -> Levels:
    """The sum over levels at ``speed`` [m/s], not 0, for a scene with strips. ``found``: its sample of Eq. (8) there.

    Strips are solved until the standard error of f is within ``numerics.sampling_tolerance``. With the first level, the
    difference of the models may leave a half-width of `DIFFERENCE` times ``numerics.model_tolerance`` beside it. No
    more are solved than `MOST_WORK` allows. Finer cells follow if the change of f from longer cells is not within
    ``numerics.tolerance``. Raises `ConvergenceError`.
    """
    strips, numerics, load = prepared.strips, prepared.scene.numerics, prepared.scene.bodies.load
    assert strips is not None
    pairs = [solve_pair(prepared, speed, 0, None)]
    most = max(1, min(strips.available, int(MOST_WORK / pairs[0].resolved.work)))

    def wanted(line: int) -> int:
        count, scatter = len(pairs), _scatter(pairs, strips, line)
        f, asked = abs(_sum(prepared, pairs, found, line)["coefficient"]), numerics.sampling_tolerance
        if not line:
            return enlarged(count, 1, most, scatter, f * asked, growth=GROWTH)
        whole = replace(scatter, error=math.hypot(scatter.error, _of_line(found, line, count) * f))
        allowed = f * numerics.model_tolerance / student(scatter.freedom)
        both = math.hypot(f * asked, DIFFERENCE * allowed)
        errors = (whole, both), (scatter, allowed)
        return max(enlarged(count, 1, most, error, limit, growth=GROWTH) for error, limit in errors)

    same = found.strips is not None and found.strips.cells == strips.cells and math.isfinite(found.sampling)
    whole = found.count if same and not strips.whole else 0
    while True:
        line = whole if wanted(whole) <= min(wanted(0), whole) else 0
        line = line if 0 <= _sum(prepared, pairs, found, line)["contact_load"] <= load else 0
        count = wanted(line)
        if count <= len(pairs):
            break
        pairs += [solve_pair(prepared, speed, i, pairs[0].resolved.slope) for i in range(len(pairs), count)]
    by_cells, numerical = _on_finer_cells(prepared, speed, pairs)
    numbers, alone = _sum(prepared, pairs, found, line), _sum(prepared, pairs, found, 0)["coefficient"]
    f, scatter = abs(numbers["coefficient"]), _scatter(pairs, strips, line)
    rest = _of_line(found, line, len(pairs)) * f if line else scatter.error
    freedom = scatter.freedom if not line else found.friction_error.freedom if found.response is not None else ORDER
    of_strips = add_errors(BlockError(rest, freedom), by_cells)
    sampling = replace(of_strips, error=of_strips.error / f)
    difference = BlockError(scatter.error / f if line else 0.0, scatter.freedom)
    both = math.hypot(sampling.error, difference.error, numerical)
    errors = _errors(prepared, pairs, numbers) | {"coefficient": both}
    length = strips.length * max(line, len(pairs))
    films = tuple((numbers.pop(name) - alone) / f for name in OTHER_FILMS)
    return Levels(numbers, errors, films, line, tuple(pairs), sampling, difference, numerical, length)


def _of_line(found: Found, line: int, count: int) -> float:
    """Relative standard error of f by those strips of the first level that are not among ``count`` of the second."""
    return math.sqrt(max(1 - count / line, 0.0)) * found.sampling if line else 0.0


def _sum(prepared: Prepared, pairs: Sequence[Pair], found: Found, line: int) -> dict[str, float]:
    """The numbers of the result by all levels that are solved; ``line``: strips of the first (0: without it)."""
    mean = _mean(_numbers(prepared, pair.resolved) for pair in pairs)
    if line:
        solved = found.solved
        loads = solved.film_load, solved.contact_load
        whole = quantities(solved.forces, solved.film, loads, solved.contact.mean_film)
        shared = _mean(pair.shared for pair in pairs)
        mean |= {name: mean[name] + whole[name] - shared[name] for name in LINEAR}
    finer = [pair for pair in pairs if pair.finer is not None]
    if finer:
        before = _mean(_numbers(prepared, pair.resolved) for pair in finer)
        after = _mean(_numbers(prepared, pair.finer) for pair in finer)
        mean = {name: value + after[name] - before[name] for name, value in mean.items()}
    return mean


def _numbers(prepared: Prepared, strip: Strip | None) -> dict[str, float]:
    assert strip is not None
    others = {name: getattr(strip.result, name) for name in OTHER_FILMS}
    return numbers_of(prepared.scene, prepared.surface.sq, strip.result) | others


def _mean(rows) -> dict[str, float]:
    rows = list(rows)
    return {name: float(np.mean([row[name] for row in rows])) for name in rows[0]}


def _errors(prepared: Prepared, pairs: Sequence[Pair], numbers: dict[str, float]) -> dict[str, float]:
    """Relative standard errors of the ``numbers`` by their scatter between strips."""
    if len(pairs) < FEWEST:
        return {}
    rows = [_numbers(prepared, pair.resolved) for pair in pairs]
    errors = {name: float(np.std([row[name] for row in rows], ddof=1)) / math.sqrt(len(rows)) for name in numbers}
    return {name: errors[name] / abs(value) for name, value in numbers.items() if value}


def _scatter(pairs: Sequence[Pair], strips: Strips, line: int) -> BlockError:
    """Standard error of f by the second level. On a line of N strips, of which the n ``pairs`` are part, Eq. (8) counts
    by 1 - n/N: the rest of it is the same strips again."""
    share = max(1 - len(pairs) / line, 0.0) if line else 0.0
    values = [
        pair.resolved.result.coefficient
        - share * pair.shared["coefficient"]
        + pair.deviations
        - share * pair.shared_deviations
        for pair in pairs
    ]
    error = _block_error(values, strips, pairs[0])
    return error if line else replace(error, error=ALONE * error.error)


def _on_finer_cells(prepared: Prepared, speed: float, pairs: list[Pair]) -> tuple[BlockError, float]:
    """Solve the third level, if it is needed and the roughness rests: the standard error of its mean change of f, and
    the relative error that its cells leave."""
    scene, strips, first = prepared.scene, prepared.strips, pairs[0]
    assert strips is not None
    left = max(estimate([first.longer.result, first.resolved.result]) or 0.0, SOLVED)
    if left <= scene.numerics.tolerance or cells_of(strips, scene.bodies.half_width) == (1, 1) or moves(scene):
        return BlockError(0.0, 1), left
    asked = CELLS * scene.numerics.sampling_tolerance * abs(first.resolved.result.coefficient)
    changes: list[np.ndarray] = []
    for index, pair in enumerate(pairs):
        pairs[index] = solve_finer(prepared, speed, pair)
        changes.append(_changes(pairs[index]))
        error = _block_error(changes, strips, pair)
        if error.error <= asked:
            break
    ladder = [pairs[0].longer, pairs[0].resolved, pairs[0].finer]
    return error, max(estimate([strip.result for strip in ladder if strip is not None]) or 0.0, SOLVED)


def _block_error(values: Sequence[np.ndarray], strips: Strips, pair: Pair) -> BlockError:
    """Standard error of the mean of ``values`` along strips such as ``pair``; of a mirrored map only half counts."""
    step, kept = strips.length / values[0].size, values[0].size // (2 if pair.mirrored else 1)
    return place_error(np.concatenate([one[:kept] for one in values]), step, strips, len(values))


def _changes(pair: Pair) -> np.ndarray:
    """Change of f by the finer cells, from place to place."""
    assert pair.finer is not None
    change = pair.finer.result.coefficient - pair.resolved.result.coefficient
    return change + deviations(pair.finer).reshape(pair.deviations.size, -1).mean(axis=1) - pair.deviations
