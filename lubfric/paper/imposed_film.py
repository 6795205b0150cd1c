"""Contact under an imposed film: the film gives the shape of the separation h - epsilon, and Eq. (8) gives epsilon.

Both methods of the paper solve this problem: A. Akchurin et al., Tribol. Lett. 59:19 (2015), Eqs. (3), (7), (8),
doi:10.1007/s11249-015-0536-z. With the signs of this library the gap is ``g = h - epsilon - z + K p``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .._base import validate
from ..contact import ContactResult, Found, Problem, State, concluded, look, make_problem, state_of
from ..errors import CONVERGED, STAGNATED, InputError


@dataclass(frozen=True)
class ImposedFilm:
    """A rough surface under a film of given shape.

    ``problem`` holds gap0 = h - z [m], shifted so that its minimum is zero, with operator and limits. The area A is
    given by weights that sum to 1; the mean film over A is in m. Offsets epsilon [m] inside this class refer to that
    gap0.
    """

    problem: Problem
    weight: np.ndarray
    mean_film: float

    def mean(self, field) -> float:
        """Mean of a field over the area A."""
        return float(np.vdot(self.weight, field))

    @property
    def separated(self) -> bool:
        """Whether the film fits between the undeformed surfaces without contact."""
        return self.mean(self.problem.gap0) - self.mean_film <= self.problem.gap0.min()

    def lubricated_offset(self, displacement, pressure) -> float:
        """epsilon [m] of Eq. (8) as printed: the lubricated part of A contains the volume of the film.

        It is NaN when the pressure leaves no cell of A free, because Eq. (8) then has no solution.
        """
        free = self.weight * (pressure == 0)
        wet = free.sum()
        volume = np.vdot(free, self.problem.gap0 + displacement)
        return float((volume - self.mean_film) / wet) if wet > 0 else math.nan

    def offset(self, displacement, overlap=0.0) -> float:
        """epsilon [m] of Eq. (8) over all of A, where the gap of contact spots counts as zero: the same solution.

        ``overlap`` [m] is a field: the overlap of yielded cells, which contains no lubricant.
        """
        return self.mean(self.problem.gap0 + displacement + overlap) - self.mean_film

    def first_pressure(self) -> np.ndarray:
        """A first pressure, proportional to the overlap at the offset of the undeformed surfaces, with the best
        factor."""
        overlap = np.maximum(self.mean(self.problem.gap0) - self.mean_film - self.problem.gap0, 0.0)
        stiffness = np.vdot(overlap, self.problem.operator.apply(overlap))
        return np.minimum(overlap * (np.vdot(overlap, overlap) / stiffness), self.problem.hardness)

    def surplus(self, state: State) -> float:
        """By how much the film exceeds the volume between the surfaces: their difference over A, in the smaller of the
        mean film and the length in which `lubfric.solve_contact` measures residuals."""
        return (self.mean_film - self.mean(np.maximum(state.gap, 0.0))) / min(state.scale, self.mean_film)

    def residual(self, pressure, displacement, offset) -> float:
        """The worst of complementarity, penetration and volume, as in `lubfric.paper.single_loop`."""
        state = state_of(self.problem, pressure, displacement, offset)
        return max(state.residual, abs(self.surplus(state)))

    def solved(self, iterate: Iteration, solver: str, raise_on_failure: bool) -> ContactResult:
        """The contact by ``iterate``, with residuals computed anew from the pressure alone."""
        if self.separated:
            zero, note = np.zeros_like(self.problem.gap0), "the film clears the surface: no contact"
            solver, end = "none", Outcome(zero, self.offset(zero), CONVERGED, 0, 0, [], [note])
        else:
            end = iterate(self, self.first_pressure())
        state = look(self.problem, self.problem.operator, end.pressure, end.offset)
        found = Found(
            state,
            end.status,
            end.iterations,
            end.convolutions + 1,
            end.history,
            solver=solver,
            notes=end.notes,
        )
        result = concluded(self.problem, found, {"volume": abs(self.surplus(state))}, STAGNATED)
        if raise_on_failure:
            result.report.raise_if_failed(result)
        return result


@dataclass(frozen=True)
class Outcome:
    """The end of an iteration."""

    pressure: np.ndarray
    offset: float
    status: str
    iterations: int
    convolutions: float
    history: Sequence[float]
    notes: Sequence[str]


Iteration = Callable[[ImposedFilm, np.ndarray], Outcome]  # from a first pressure


def impose(heights, film, weight, *problem) -> ImposedFilm:
    """The validated contact; ``problem``: what `lubfric.contact.make_problem` takes after the gap h - z [m]."""
    heights = validate.array("heights", heights, "m", ndim=2)
    film = _on_grid("film", film, heights.shape, "m")
    weight = np.ones(heights.shape) if weight is None else _on_grid("weight", weight, heights.shape, "(-)")
    if weight.min() < 0 or weight.sum() == 0:
        raise InputError("weight must be >= 0 (-) everywhere and > 0 somewhere: it marks the area A of Eq. (8)")
    weight = weight / weight.sum()
    mean_film = validate.positive("mean of film over the area A", float(np.vdot(weight, film)), "m")
    return ImposedFilm(make_problem(film - heights, *problem), weight, mean_film)


def _on_grid(name, value, shape, unit) -> np.ndarray:
    field = np.asarray(value, dtype=float)
    if field.ndim == 1:
        field = field[:, None]  # along x
    try:
        field = np.broadcast_to(field, shape)
    except ValueError:
        raise InputError(f"{name} has shape {np.shape(value)}; allowed: a number, (nx,) or {shape} [{unit}]") from None
    return validate.array(name, field, unit, ndim=2)
