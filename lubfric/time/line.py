"""The line of a run in time: as long as the steady balance needs at the speeds of the run."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..errors import LubfricError
from ..sampling import LineFound, line_friction, lines_of_model, mean_of, of_line
from ..scene import Constant
from ..sharing import MOST_CELLS, Prepared, line_contact, on_halved_cells
from .at_a_time import changes
from .sharing import OnOwnCells

SPEEDS = 4  # looked at between the fastest and the slowest of a run
SLOWEST = 1e-3  # of the fastest: slower ones are boundary lubrication


def long_enough(prepared: Prepared) -> tuple[Prepared, OnOwnCells]:
    """``prepared`` on a line as long as `lubfric.friction` needs for ``numerics.sampling_tolerance`` at the worst of
    four speeds of the run, or as memory and map allow. Its cells are so short that they change f by no more than
    ``numerics.tolerance`` at any of these speeds, or the scene's own: a run in time is not corrected for them.

    ``prepared`` itself if it is on one patch, or if its line is long enough. Beside it what its contact areas
    are on the scene's own cells, mean over the speeds.
    """
    lines, speeds = prepared.lines, _speeds(prepared)
    if lines is None:
        return prepared, OnOwnCells()
    if not speeds:
        return prepared, OnOwnCells() if lines.cells.factors == (1, 1) else OnOwnCells(math.nan, math.nan)
    needs = [_need(prepared, speed) for speed in speeds]
    while lines.cells.factors != (1, 1) and max(n.by_cells for n in needs) > prepared.scene.numerics.tolerance:
        prepared = on_halved_cells(prepared)
        lines = lines_of_model(prepared)
        needs = [_need(prepared, speed) for speed in speeds]
    asked = max(need.length for need in needs)
    held = MOST_CELLS / lines.cells.count * lines.cells.coarse[1]
    cells = OnOwnCells(_mean([need.cells.area for need in needs]), _mean([need.cells.plastic for need in needs]))
    if asked <= prepared.surface.size[1] * 1.05:
        return prepared, cells
    surface = lines.line(0, min(asked, held, lines.available))
    return replace(prepared, surface=surface, contact=line_contact(prepared.scene, surface)), cells


def _mean(factors: list[float]) -> float:
    known = [factor for factor in factors if math.isfinite(factor)]
    return sum(known) / len(known) if known else math.nan


def _speeds(prepared: Prepared) -> list[float]:
    """Speeds [m/s] at which the line is looked at; none where nothing is entrained."""
    plan = changes(prepared.scene)
    low, high = (plan.speed or Constant(prepared.scene.motion.entrainment_speed)).range(plan.duration)
    fastest = max(abs(low), abs(high))
    if fastest == 0.0:
        return []
    slowest = max(min(abs(low), abs(high)) if low * high > 0 else 0.0, SLOWEST * fastest)
    return np.unique(np.geomspace(fastest, slowest, SPEEDS)).tolist() if slowest < fastest else [fastest]


@dataclass(frozen=True)
class _Need:
    """What a steady speed needs: the ``length`` [m] of its line. What its cells do: the relative change of f
    ``by_cells``, and that of areas."""

    length: float = 0.0
    by_cells: float = 0.0
    cells: OnOwnCells = OnOwnCells(math.nan, math.nan)


def _need(prepared: Prepared, speed: float) -> _Need:
    """The `_Need` at a steady ``speed`` [m/s]; zero if there is no steady solution that tells it."""
    try:
        chosen, line = line_friction(prepared, speed)
    except LubfricError:
        return _Need()
    factors = lines_of_model(prepared).cells.factors
    cells = OnOwnCells() if factors == (1, 1) else _on_own_cells(line)
    by_cells = line.by_cells if line.cells.factors == factors else math.inf
    return _Need(of_line(chosen.scene, line)[0].length, by_cells, cells)


def _on_own_cells(line: LineFound) -> OnOwnCells:
    plastic = line.together.plastic_fraction
    corrected = line.point.balance.contact.plastic_area_fraction
    return OnOwnCells(mean_of(line.grid, "area", math.nan), corrected / plastic if plastic else math.nan)
