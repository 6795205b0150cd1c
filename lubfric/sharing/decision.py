"""What a result left out, and the numbers by which that was judged."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from ..film import LeftOut
from ..scene import Numerics, budget
from .one_grid import Stage
from .prepared import Prepared
from .split import steepness


@dataclass(frozen=True)
class Decision:
    """Levels of film and contact, and the grid, of one operating point.

    - ``film``, ``contact``: names of the levels; ``film_words``: the film in words.
    - ``left_out``: relative errors of film and film friction by what the film level neglects. f changes by
      ``sensitivity`` times as much.
    - ``film_tolerance``: of a numerical film (0: closed form).
    - ``clearance`` [sigma]: between the film and the highest summits (negative: contact).
    - ``steepness``: d ln(F_H/F_C)/d ln U (None: not known).
    - ``shape``: of the contact grid; ``coarsening``: length of its cells in cells of the scene's map, along each axis.
    - ``grid_error``: estimated relative error of f by the grid (None: it is the map's own grid); ``own_error``: on the
      map's own grid, the change by the last step to it (infinite: nothing to compare it with).
    - ``tolerance``: the one asked for, on f.
    - ``deflected_by``: the pressure that deflects the film, as in ``numerics.film_deflection`` ("": no film);
      ``deflection``: why, in words; ``deflection_left_out``: relative error of the film by that choice (0 where the
      scene names the pressure).
    - ``heat``: which heat was modelled, in words ("": not chosen, not known).
    - ``forced``: what the scene fixed instead of leaving it to be chosen.
    """

    film: str
    contact: str
    tolerance: float
    film_words: str = "none"
    left_out: LeftOut = LeftOut()
    sensitivity: float = 1.0
    film_tolerance: float = 0.0
    clearance: float | None = None
    steepness: float | None = None
    shape: tuple[int, int] | None = None
    coarsening: tuple[int, int] = (1, 1)
    grid_error: float | None = None
    own_error: float = math.inf
    deflected_by: str = ""
    deflection: str = ""
    deflection_left_out: float = 0.0
    heat: str = ""
    forced: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The decision in words, each number beside its budget."""
        parts = (self.film_text, self._contact(), self._grid(), self.deflection, self.heat, *self.notes)
        return "; ".join(part for part in parts if part)

    @property
    def film_text(self) -> str:
        """The part of ``text`` about the film."""
        text = f"film: {self.film_words}"
        if self.film == "none":
            return text
        if self.film_tolerance > 0:
            text += f", tolerance {_percent(self.film_tolerance)}"
        elif self.left_out.total > 0:
            parts = [f"{name} correction {_percent(value)}" for name, value in self.left_out.parts.items() if value > 0]
            limit = budget.FILM_LEVEL * self.tolerance
            reached = self.left_out.total * self.sensitivity
            text += f", {' + '.join(parts)}"
            text += f" ({_percent(reached)} of f) {'<' if reached <= limit else '>'} {_percent(limit)} budget"
        return text + (" (forced)" if "film_level" in self.forced else "")

    def _contact(self) -> str:
        text = f"contact: {self.contact}"
        if self.clearance is not None:
            text += f", clearance {self.clearance:.2g} sigma"
        return text + (" (forced)" if "contact_level" in self.forced else "")

    def _grid(self) -> str:
        if self.shape is None:
            return ""
        text = f"grid: {self.shape[0]} x {self.shape[1]}"
        if self.coarsening != (1, 1):
            text += f", cells of {self.coarsening[0]} x {self.coarsening[1]}"
        if self.grid_error is not None:
            limit = budget.CONTACT_GRID * self.tolerance
            text += (
                f", estimated error {_percent(self.grid_error)} of f {'<' if self.grid_error <= limit else '>'} "
                f"{_percent(limit)} budget"
            )
        else:
            text += ", the map's own"
            text += "" if math.isfinite(self.own_error) or "grid" in self.forced else ", compared with no other"
        return text + (" (forced)" if "grid" in self.forced else "")


def _percent(value: float) -> str:
    return f"{100 * value:.2g} %"


def dry(prepared: Prepared, speed: float) -> Decision:
    """The decision for a contact without film, on its own grid: at a ``speed`` other than 0 the film is left out."""
    grid, numerics = prepared.contact.grid, prepared.scene.numerics
    return Decision(
        film="none",
        film_words="none, no entrainment" if speed == 0 else "none, left out (forced)",
        contact=prepared.contact.name,
        tolerance=numerics.tolerance,
        shape=None if grid is None else grid.cells,
        forced=_forced(numerics),
    )


def alone(stage: Stage) -> Decision:
    """The decision for a film that carries the whole load."""
    state, sq = stage.balance.contact, stage.point.prepared.surface.sq
    return replace(_film(stage), contact="none", clearance=(state.mean_film - state.mean_gap) / max(sq, 1e-12))


def in_contact(stage: Stage, error: float, *, finest: bool) -> Decision:
    """The decision for film and contact on a grid with the estimated ``error`` of f. ``finest``: it is the map's own
    grid."""
    prepared, grid, own = stage.point.prepared, stage.point.contact.grid, stage.point.prepared.contact.grid
    balance = stage.balance
    steep = steepness(stage.point, balance.split, balance.slope) if balance.slope and balance.film_load > 0 else None
    decision = replace(
        _film(stage), contact=prepared.contact.name, grid_error=None if finest else error, steepness=steep
    )
    if finest:
        decision = replace(decision, own_error=error)
    if grid is not None and own is not None:
        dx, dy = (round(a / b) for a, b in zip(grid.spacing, own.spacing))
        decision = replace(decision, shape=grid.cells, coarsening=(dx, dy))
    return decision


def _film(stage: Stage) -> Decision:
    numerics, settings, found = stage.point.scene.numerics, stage.point.settings, stage.balance.forces
    notes: tuple[str, ...] = ()
    if settings.level.numerical and found.quadrature > budget.SHEAR_SUM * numerics.tolerance:
        notes = (
            f"the film's friction is not resolved (a pressure spike?): estimated error "
            f"{100 * found.quadrature:.1g} % of f",
        )
    return Decision(
        film=settings.level.name,
        contact="",
        tolerance=numerics.tolerance,
        film_words=settings.level.words,
        left_out=stage.left_out,
        sensitivity=found.sensitivity,
        film_tolerance=settings.film_tolerance if settings.level.numerical else 0.0,
        deflected_by=numerics.film_deflection,
        heat=found.heat.text(numerics.tolerance),
        forced=_forced(numerics),
        notes=notes,
    )


def _forced(numerics: Numerics) -> tuple[str, ...]:
    full = numerics.model == "full"
    return tuple(name for name in ("film_level", "contact_level", "grid") if full or getattr(numerics, name) != "auto")
