"""A forecast of how long a line will be and what it will cost, from closed forms. Nothing is solved."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..scene import Scene
from .lines_contract import Lines
from .lines_length import MOST, PAIR, PILOT, SAFETY

CELL_SECONDS = 2.5e-6  # processor time of a cell of a line in balance, about
PIECE_SECONDS = 1.3e-6  # of a cell of a piece on finer and finer cells, of the finest
GAP = 1.6  # Sq: mean gap of a contact that carries most of the load, about
RISE = 0.4  # of the film of the whole load, by which it is wider, about
FLOOR = 0.25  # of f_b: friction where the film carries most, about
SHORT = 25.0  # correlation lengths: a map shorter along the line holds too few blocks for a standard error
CLEAR = 3.5  # Sq: a film that thick hardly meets a summit


def foretold(scene: Scene, lines: Lines, sq: float, speed: float) -> tuple[float, float]:
    """The relative standard error of f after the pilot, and the length [m] that ``numerics.sampling_tolerance`` needs,
    both to an order of magnitude.

    The mean gap over a strip of length L and half-width b scatters as a mean of L (2b + sqrt(pi) lx)/(pi lx ly)
    independent heights. The effect on f follows from the share of the load that the rigid film of the whole load would
    carry if it were as thick as the gap.
    """
    (lx, ly), pilot = lines.lengths, pilot_length(lines)
    if speed == 0:
        return 0.0, pilot
    film = scene.line_contact(speed).moes_film
    if film > CLEAR * sq:
        return 0.0, pilot
    gap = GAP * sq + RISE * film
    share = min(film / gap, 1.0)
    scatter = sq * math.sqrt(math.pi * lx * ly / (pilot * (2 * scene.bodies.half_width + math.sqrt(math.pi) * lx)))
    error = scatter / gap * share / (1 - share + FLOOR)
    asked = scene.numerics.sampling_tolerance
    length = pilot * max(1.0, SAFETY * (error / asked) ** 2) if error > asked else pilot
    return error, min(length, lines.available, MOST * ly)


def pilot_length(lines: Lines) -> float:
    """Length [m] of the first line."""
    return min(PILOT * lines.lengths[1], lines.available)


def piece_cells(lines: Lines) -> float:
    """Cells of a piece of the surface on the scene's own cells; 0 if the lines have these cells."""
    (fx, fy), step = lines.cells.factors, lines.cells.coarse[1]
    return lines.cells.count * fx * fy * min(PAIR * lines.lengths[1], lines.available) / step if fx * fy > 1 else 0.0


def table(scene: Scene, lines: Lines, sq: float, speeds: Sequence[float]) -> list[str]:
    """Rows for `lubfric info`: length and cost of the line at ``speeds`` [m/s]."""
    asked, first = scene.numerics.sampling_tolerance, pilot_length(lines)
    dx, dy = lines.cells.coarse
    short = lines.available < SHORT * lines.lengths[1]
    rows = [
        f"line of the roughness for f within {100 * asked:g} %, on cells of {dx * 1e6:.3g} x {dy * 1e6:.3g} um; "
        f"the first is {1e3 * first:.2g} mm long (orders of magnitude)",
        f"  {'U (m/s)':<12} {'length (mm)':>11} {'error on the first':>20} {'time (s)':>10}",
    ]
    for speed in speeds:
        error, length = foretold(scene, lines, sq, speed)
        seconds = CELL_SECONDS * lines.cells.count * length / dy + PIECE_SECONDS * piece_cells(lines)
        ends = length == lines.available and error**2 * first > asked**2 * length
        known = "not known" if short and error else f"{100 * error:.2g} %"
        rows.append(
            f"  {speed:<12.4g} {1e3 * length:>11.2g} {known:>20} {max(seconds, 0.01):>10.1g}"
            f"{'   the map ends here' if ends and not short else ''}"
        )
    if short:
        rows.append(
            f"  the map is shorter than {SHORT:g} correlation lengths: in contact, the result may have no interval"
        )
    return rows
