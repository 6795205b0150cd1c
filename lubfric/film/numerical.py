"""The level that leaves nothing out of the smooth film: elastic, piezoviscous, compressible; `lubfric.solve_ehl`."""

from __future__ import annotations

from dataclasses import dataclass

from ..ehl import EHLResult, solve_ehl
from ..line_contact import LineContact
from .contract import Film, FilmLevel


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
        lubricant = line.lubricant
        return solve_ehl(
            load_per_width=line.load_per_width,
            radius=line.radius,
            e_prime=line.e_prime,
            entrainment_speed=line.entrainment_speed,
            viscosity=lubricant.viscosity,
            viscosity_law=lubricant.viscosity_law,
            density=lubricant.density_law,
            pressure_viscosity_coefficient=lubricant.pressure_viscosity_coefficient,
            tolerance=tolerance,
            least_cells=cells,
            imposed_pressure=imposed,
            start=start if isinstance(start, EHLResult) else None,
        )
