"""What was modelled for a result, and what was omitted because the tolerance on f does not need it."""

from dataclasses import dataclass

from .statistics import percent


@dataclass(frozen=True, kw_only=True)
class Decision:
    """The models of film and contact, and the sample, of one operating point.

    - ``model``: its name in ``numerics.model``; ``film``, ``contact``: as text.
    - ``tolerance``: the requested one, on f; ``film_tolerance``: of the film (0: no film).
    - ``cells``: (nx, ny) of the contact (None: none was solved on cells); ``coarsening``: length of its cells in cells
      of the scene's map, along each axis; ``strips``: number of strips of the surface that were solved.
    - ``change_by_cells``: relative change of f by the scene's own cells, for which it is corrected.
    - ``heat``: which heat was modelled, as text ("": none can be).
    - ``basis``: what the model-form error rests on, as text; first in ``text`` ("": the error formulas of the model).
    - ``rubbing``: what the ``contact_load`` of this model is, as text with a place for its part of the load.
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
    basis: str = ""
    rubbing: str = "The asperities carry {part} of the load"

    @property
    def text(self) -> str:
        """The decision as text."""
        return "; ".join(self.parts)

    @property
    def parts(self) -> tuple[str, ...]:
        """The parts of the ``text``: what the error rests on, film, contact, sample, heat and notes."""
        film = f"film: {self.film}" + (f", tolerance {percent(self.film_tolerance)}" if self.film_tolerance else "")
        parts = self.basis, film, f"contact: {self.contact}", self._cells(), self.heat, *self.notes
        return tuple(part for part in parts if part)

    def _cells(self) -> str:
        if self.cells is None:
            return ""
        text = f"{self.strips} strip{'s' if self.strips > 1 else ''} of {self.cells[0]} x {self.cells[1]} cells in all"
        if self.coarsening == (1, 1):
            return f"{text}, the map's own"
        fx, fy = self.coarsening
        return f"{text}, each {fx} x {fy} of the map's own, by which f is corrected ({percent(self.change_by_cells)})"
