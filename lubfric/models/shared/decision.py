"""What was modelled for a result, and what was omitted because the tolerance on f does not need it."""

from dataclasses import dataclass

from ..._base import Renamed
from .wording import percent


@dataclass(frozen=True, kw_only=True)
class Decision(Renamed):
    """What was modelled for one operating point: film, contact and sample.

    Attributes
    ----------
    model : the model that answered, by its `Model.name`; of the answer of a model "": `lubfric.estimate` says it
    film_in_words, contact_in_words : how film and contact were modelled
    tolerance : the requested one, on f
    film_tolerance : of the film; 0: there is none
    shape : cells (nx, ny) of the contact; None: none was solved on cells
    coarsening : length of these cells in native ones, along each axis
    strips : number of strips of the surface that were solved
    cells_of_strip : cells (nx, ny) of a strip whose film was solved with its contact; None: none was
    cell_size : length (dx, dy) [m] of the cells of ``shape`` or ``cells_of_strip``, along the motion and along the line
    control_strips : strips on which the load-sharing model was solved, where f is its f and the difference of the models on
        ``strips``; 0: f is that of ``strips``
    shorter_cells : how many times as short the cells of pieces of the strips are, by whose change f is corrected
    change_by_cells : relative change of f by native cells, for which it is corrected
    heat_in_words : which heat was modelled; "": none can be
    notes : what else a reader should know
    basis : what answered of this model, and what its model-form error rests on, first in ``text``; "": its name says so
    counts_cells_as_model_error : whether the error by the cells is in the model-form error, not in the numerical one
    contact_load_in_words : what the ``contact_load`` of this model is, with a place for its part of the load
    rolling_in_words : of which film the rolling resistance is; "": of that of the model
    """

    model: str = ""
    film_in_words: str
    contact_in_words: str
    tolerance: float
    film_tolerance: float = 0.0
    shape: tuple[int, int] | None = None
    coarsening: tuple[int, int] = (1, 1)
    strips: int = 1
    cells_of_strip: tuple[int, int] | None = None
    cell_size: tuple[float, float] | None = None
    control_strips: int = 0
    shorter_cells: tuple[int, ...] = ()
    change_by_cells: float = 0.0
    heat_in_words: str = ""
    notes: tuple[str, ...] = ()
    basis: str = ""
    counts_cells_as_model_error: bool = False
    contact_load_in_words: str = "The asperities carry {part} of the load"
    rolling_in_words: str = ""
    _RENAMED = {
        "film": "film_in_words",
        "contact": "contact_in_words",
        "cells": "shape",
        "heat": "heat_in_words",
    }

    @property
    def text(self) -> str:
        """The decision as text."""
        return "; ".join(self.parts)

    @property
    def parts(self) -> tuple[str, ...]:
        """The parts of the ``text``: what the error rests on, film, contact, sample, heat and notes."""
        film = f"film: {self.film_in_words}" + (
            f", tolerance {percent(self.film_tolerance)}" if self.film_tolerance else ""
        )
        parts = self.basis, film, f"contact: {self.contact_in_words}", self._cells(), self.heat_in_words, *self.notes
        return tuple(part for part in parts if part)

    def _cells(self) -> str:
        if self.shape is None:
            return ""
        text = f"{self.strips} strip{'s' if self.strips > 1 else ''} of {self.shape[0]} x {self.shape[1]} cells in all"
        if self.coarsening == (1, 1):
            return f"{text}, as long as those of the map"
        fx, fy = self.coarsening
        return (
            f"{text}, each as long as {fx} x {fy} cells of the map; f is corrected for this "
            f"({percent(self.change_by_cells)})"
        )
