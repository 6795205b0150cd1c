"""A rough strip whose bodies touch (mixed lubrication), compared with finite elements: at rest and moving.

The strip is that of `rough_strip` with rougher bodies and a slower film. Both programs decide the contact by
complementarity: at each node or cell the gap is the floor and carries any pressure, or lubricant flows through a larger
gap. The floor is 30 or 25 nm (a boundary layer), so that a quarter to a third of the load is on touching places while
lubricant fills the rest of the contact. A film that ruptures between touching places is left out: there the finite
elements have p = 0 without a memory of the lubricant, the deterministic model keeps its mass.

Where the gap is a little above the floor or is the floor makes no difference to the film, so that the area of contact
itself is not compared; the load on gaps up to 1.1 floors is.
"""

from collections.abc import Iterator

from ...check import Item, Table
from ...types import TableRow
from ..solvers.rough_ehl import Discretisation
from .rough_strip import StripCase, both_programs, judged_films, picture_field, rows_of

CASES = (
    StripCase(load=1e5, speed=0.05, sq=100e-9, floor=30e-9),
    StripCase(load=2e5, speed=0.05, sq=100e-9, floor=25e-9),
)
GRIDS = {"quick": ((64, 8), (96, 12)), "default": ((96, 12), (128, 16)), "full": ((96, 12), (128, 16), (176, 22))}
CELLS = {"quick": (32, 64), "default": (48, 96), "full": (48, 96, 144)}
MOVING_GRIDS = {"default": ((64, 8), (96, 12)), "full": ((64, 8), (96, 12), (128, 16))}
MOVING_CELLS = {"default": (24, 36), "full": (24, 36, 48)}
# Allowed, relative: of the finer grids. Steps between the two finest grids of each program are as large (table).
ALLOWED = {"mean gap": 0.02, "flow": 0.03, "touching load": 0.1, "viscous force": 0.08}
QUANTITIES = ("mean gap (m)", "load on gaps up to 1.1 floors", "flow (m²/s)", "viscous force (N/m per m/s)")


def touching_strip(level: str) -> Iterator[Item]:
    """Gap, pressure, flow and the load of touching bodies by the deterministic model and by finite elements.

    Two loads at rest, the first also moving at 0.75 U, on nested grids of both programs. The check takes the finest of
    both; the table has all.
    """
    rows: list[TableRow] = []
    bodies: dict[tuple[int, int], Discretisation] = {}
    for case in CASES:
        for moving in (False, True):
            if (moving and (level == "quick" or case != CASES[0])) or (level == "quick" and case != CASES[0]):
                continue
            name = f"{case.load:g} N/m, {'moving' if moving else 'at rest'}"
            cells = MOVING_CELLS[level] if moving else CELLS[level]
            grids = MOVING_GRIDS[level] if moving else GRIDS[level]
            ours, elements = both_programs(case, cells, grids, moving=moving, bodies=bodies)
            yield from judged_films(name, case, ours[-1], elements[-1], ALLOWED)
            rows += rows_of(name, case, cells, ours, grids, elements)
            if not moving:
                picture = f"touching_strip_{case.load:.0f}"
                what = f"touching bodies at {case.load:g} N/m"
                yield picture_field(picture, what, case, ours[-1][0], elements[-1][0])
    caption = "Touching bodies by both programs on each grid: means over |x| < 0.8 b, and over the moments compared"
    yield Table("touching-strip", caption, ("case", "by", "cells in b", *QUANTITIES), rows)
