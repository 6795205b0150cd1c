"""The level that leaves nothing out of the smooth film: elastic, piezoviscous, compressible; `lubfric.solve_ehl`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

from ..ehl import EHLResult
from ..ehl.imposed import line_pressure
from ..ehl.solve import Effort, solve_line_contact
from ..line_contact import LineContact
from ..lubricant import Lubricant
from .contract import Film, FilmLevel
from .shear import ShearForce


@dataclass(frozen=True)
class Elastohydrodynamic(FilmLevel):
    """Full EHL, on as many cells as the tolerance takes."""

    name: str = "ehl"
    words: str = "full EHL"
    numerical: bool = True

    def solve(
        self, line: LineContact, *, tolerance: float, cells: int = 0, imposed=None, start: Film | None = None
    ) -> EHLResult:
        """An `EHLResult`; a ``start`` of another kind is not used."""
        return solve_line_contact(
            line,
            Effort(tolerance, cells),
            imposed=line_pressure(imposed),
            start=start if isinstance(start, EHLResult) else None,
        )

    def shear(self, film: Film, lubricant: Lubricant, **point) -> ShearForce:
        """The rolling force as the film itself knows it."""
        return super().shear(film, lubricant, **{"rolling": cast(EHLResult, film).rolling} | point)
