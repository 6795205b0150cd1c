"""What was modelled for a result, and what was left out because the tolerance on f does not need it."""

import math
from dataclasses import dataclass

from ..contact import RoughContact
from ..models.load_sharing import Balance
from ..scene import Scene, budget
from .uncertainty import percent


@dataclass(frozen=True)
class Decision:
    """The models of film and contact, and the sample, of one operating point.

    - ``model``: "load sharing" or "deterministic"; ``film``, ``contact``: in words.
    - ``tolerance``: the one asked for, on f; ``film_tolerance``: of the film (0: no film).
    - ``cells``: (nx, ny) of the contact (None: none was solved on cells); ``coarsening``: length of its cells in cells
      of the scene's map, along each axis; ``strips``: number of strips of the surface that were solved.
    - ``change_by_cells``: relative change of f by the scene's own cells, for which it is corrected.
    - ``heat``: which heat was modelled, in words ("": none can be).
    """

    model: str
    film: str
    contact: str
    tolerance: float
    film_tolerance: float = 0.0
    cells: tuple[int, int] | None = None
    coarsening: tuple[int, int] = (1, 1)
    strips: int = 1
    change_by_cells: float = 0.0
    heat: str = ""
    notes: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The decision in words."""
        film = f"film: {self.film}" + (f", tolerance {percent(self.film_tolerance)}" if self.film_tolerance else "")
        parts = film, f"contact: {self.contact}", self._cells(), self.heat, *self.notes
        return "; ".join(part for part in parts if part)

    def _cells(self) -> str:
        if self.cells is None:
            return ""
        text = f"{self.strips} strip{'s' if self.strips > 1 else ''} of {self.cells[0]} x {self.cells[1]} cells in all"
        if self.coarsening == (1, 1):
            return f"{text}, the map's own"
        fx, fy = self.coarsening
        return f"{text}, each {fx} x {fy} of the map's own, by which f is corrected ({percent(self.change_by_cells)})"


def decided(scene: Scene, contact: RoughContact, balance: Balance, clearance: float, why: str, **sample) -> Decision:
    """The decision behind ``balance`` on ``contact``. ``clearance`` [Sq]: between the film and the highest summits, NaN
    in contact; ``why``: the reason for this model; ``sample``: further fields of `Decision`."""
    tolerance = scene.numerics.tolerance
    film = balance.film
    grid = contact.grid
    touching = math.isnan(clearance)
    notes = (*balance.notes, *filter(None, [why]))
    heat = ""
    if film is not None:
        heat = balance.forces.heat.text(tolerance)
        if (missed := balance.forces.quadrature) > budget.SHEAR_SUM * tolerance:
            text = f"the film's friction is not resolved (a pressure spike?): estimated error {100 * missed:.1g} % of f"
            notes = (*notes, text)
    return Decision(
        model="load sharing",
        film="none, no entrainment" if film is None else "full EHL",
        contact=contact.name if touching else f"none, clearance {clearance:.2g} Sq",
        tolerance=tolerance,
        film_tolerance=0.0 if balance.settings is None else balance.settings.film_tolerance,
        cells=grid if touching else None,
        heat=heat,
        notes=notes,
        **sample,
    )
