"""Contact under an imposed film, and its nested solution.

The film gives the shape of the separation h - epsilon, and Eq. (8) gives epsilon. Both methods of the paper solve this
problem: A. Akchurin et al., Tribol. Lett. 59:19 (2015), Eqs. (3), (7), (8), doi:10.1007/s11249-015-0536-z. With the
signs of this library the gap is ``g = h - epsilon - z + K p``.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .._base import FloatArray, increasing_root, validate
from ..contact import (
    ContactProblem,
    ContactResult,
    SearchResult,
    TrialContact,
    contact_problem,
    contact_result,
    evaluate,
    on_grid,
    refine,
    trial_contact,
)
from ..errors import CONVERGED, DIVERGED, ITERATION_LIMIT, STAGNATED, InputError, returned

UPDATES = ("root", "repeat")


@dataclass(frozen=True)
class ImposedFilm:
    """A rough surface under a film of given shape.

    ``problem`` holds gap0 = h - z [m], shifted so that its minimum is zero, with operator and limits. The area A is
    given by weights that sum to 1; the mean film over A is in m. Offsets epsilon [m] inside this class refer to that
    gap0.
    """

    problem: ContactProblem
    weight: np.ndarray
    mean_film: float

    def mean(self, field: FloatArray) -> float:
        """Return the mean of a field over the area A."""
        return float(np.vdot(self.weight, field))

    @property
    def is_separated(self) -> bool:
        """Return whether the film fits between the undeformed surfaces without contact."""
        return self.mean(self.problem.gap0) - self.mean_film <= self.problem.gap0.min()

    def lubricated_offset(self, displacement: FloatArray, pressure: FloatArray) -> float:
        """Return epsilon [m] of Eq. (8) as printed: the lubricated part of A contains the volume of the film.

        It is NaN when the pressure leaves no cell of A free, because Eq. (8) then has no solution.
        """
        free = self.weight * (pressure == 0)
        wet = free.sum()
        volume = np.vdot(free, self.problem.gap0 + displacement)
        return float((volume - self.mean_film) / wet) if wet > 0 else math.nan

    def offset(self, displacement: FloatArray, overlap: float | FloatArray = 0.0) -> float:
        """Return epsilon [m] of Eq. (8) over all of A, where the gap of asperity contacts counts as zero: the same
        solution.

        ``overlap`` [m] is a field: the overlap of yielded cells, which contains no lubricant.
        """
        return self.mean(self.problem.gap0 + displacement + overlap) - self.mean_film

    def surplus(self, state: TrialContact) -> float:
        """Return by how much the film exceeds the volume between the surfaces: their difference over A, in the smaller
        of the mean film and the length in which `lubfric.solve_contact` measures residuals."""
        return (self.mean_film - self.mean(np.maximum(state.gap, 0.0))) / min(state.scale, self.mean_film)

    def residual(self, pressure: FloatArray, displacement: FloatArray, offset: float) -> float:
        """Return the worst of complementarity, penetration and volume, as in `lubfric.paper.single_loop`."""
        state = trial_contact(self.problem, pressure, displacement, offset)
        return max(state.residual, abs(self.surplus(state)))

    def ended(
        self,
        pressure: FloatArray,
        offset: float,
        status: str,
        convolutions: float,
        history: Sequence[float],
        notes: Sequence[str] = (),
        iterations: int | None = None,
    ) -> SearchResult:
        """Return the end of an iteration: its state is computed anew from the pressure and epsilon alone."""
        state = evaluate(self.problem, self.problem.operator, pressure, offset)
        steps = len(history) if iterations is None else iterations
        return SearchResult(
            state=state,
            status=status,
            iterations=steps,
            convolutions=convolutions + 1,
            history=tuple(history),
            notes=tuple(notes),
        )

    def solved(
        self, iterate: Callable[[np.ndarray], SearchResult], solver: str, *, raise_on_failure: bool
    ) -> ContactResult:
        """Return the contact by ``iterate`` from a first pressure."""
        if self.is_separated:
            zero = np.zeros_like(self.problem.gap0)
            note = "the film is thicker than the roughness, so there is no contact"
            solver = "none"
            search = self.ended(zero, self.offset(zero), CONVERGED, 0, [], [note])
        else:
            overlap = np.maximum(self.mean(self.problem.gap0) - self.mean_film - self.problem.gap0, 0.0)
            stiffness = np.vdot(overlap, self.problem.operator.apply(overlap))  # of the offset of undeformed surfaces
            first = np.minimum(overlap * (np.vdot(overlap, overlap) / stiffness), self.problem.hardness)
            search = iterate(first)
        control = {"volume": abs(self.surplus(search.state))}
        result = contact_result(self.problem, replace(search, solver=solver), control, STAGNATED)
        return returned(result, raise_on_failure=raise_on_failure)


def impose(
    heights: FloatArray,
    film: Any,
    spacing: float,
    e_prime: float,
    *,
    weight: Any = None,
    **problem: Any,
) -> ImposedFilm:
    """Return the validated contact; arguments as in `lubfric.paper.single_loop`."""
    heights = validate.array("heights", heights, "m", ndim=2)
    film = on_grid("film", film, heights.shape, "m")
    weight = np.ones(heights.shape) if weight is None else on_grid("weight", weight, heights.shape, "(-)")
    if weight.min() < 0 or weight.sum() == 0:
        raise InputError("weight must be >= 0 (-) everywhere and > 0 somewhere: it marks the area A of Eq. (8)")
    weight = weight / weight.sum()
    mean_film = validate.positive("mean of film over the area A", float(np.vdot(weight, film)), "m")
    return ImposedFilm(contact_problem(film - heights, spacing, e_prime, **problem), weight, mean_film)


def alternating(
    heights: FloatArray,
    film: float | FloatArray,
    spacing: float,
    e_prime: float,
    *,
    update: str = "root",
    max_iterations: int = 100,
    raise_on_failure: bool = True,
    **problem: Any,
) -> ContactResult:
    """Solve the contact under the separation ``h - epsilon``: system (3) is solved at one epsilon after the other.

    This is the nested alternative to the single loop, the method of Morales-Espejel et al. as Akchurin et al. 2015
    (doi:10.1007/s11249-015-0536-z, end of Sec. 2.2) describe it: "iteratively solving the system (3) and Eq. (8)",
    which they found to take too long.

    update : "repeat" takes epsilon from Eq. (8) over the lubricated area, as described in the paper. An error in
        epsilon is passed on by the share with which the deflection of the lubricated area follows epsilon. That share
        is zero in an elastic periodic cell, and nearly one under a cylinder, where the iteration is very slow. "root"
        (default) brackets the zero of the volume balance as a function of epsilon. The volume falls with epsilon, so
        there is exactly one.
    max_iterations : of the outer loop

    The other arguments, the result, its residuals and the errors raised are those of
    `lubfric.paper.single_loop`. ``report.iterations`` counts the outer loop, ``report.evaluations`` every
    convolution.
    """
    validate.choice("update", update, UPDATES)
    contact = impose(heights, film, spacing, e_prime, max_iterations=max_iterations, **problem)
    return contact.solved(
        lambda first: _alternated(contact, first, update), f"alternating, {update}", raise_on_failure=raise_on_failure
    )


def _alternated(contact: ImposedFilm, pressure: FloatArray, update: str) -> SearchResult:
    """Return the solution of system (3), solved again and again, each time from the last one."""
    problem = contact.problem
    state = evaluate(contact.problem, contact.problem.operator, pressure)
    spent = 1.0
    tight = replace(problem, tolerance=0.3 * problem.tolerance, max_iterations=2000)
    offset = contact.offset(state.displacement)

    def surplus(offset: float, _: Any = None) -> tuple[float, tuple[FloatArray, float]]:
        """Return (film - volume)/min(L, film), which rises with epsilon, and the pressure."""
        nonlocal state, spent
        search = refine(tight, trial_contact(tight, state.pressure, state.displacement, offset), approach=offset)
        state = search.state
        spent += search.convolutions
        return contact.surplus(state), (state.pressure, offset)

    if update == "root":
        lowest = float(problem.gap0.min())  # first touch: below it there is no pressure
        root = increasing_root(
            surplus,
            offset,
            step=max(0.05 * abs(offset - lowest), 1e-3 * contact.mean_film),
            bounds=(lowest + 1e-9 * abs(offset - lowest), np.inf),
            tolerance=0.5 * problem.tolerance,
            max_evaluations=problem.max_iterations,
        )
        pressure, offset = root.payload
        return contact.ended(pressure, offset, root.status, spent, root.history)
    history: list[float] = []
    while len(history) < problem.max_iterations:
        history.append(abs(surplus(offset)[0]))
        if history[-1] <= 0.5 * problem.tolerance:
            return contact.ended(state.pressure, offset, CONVERGED, spent, history)
        following = contact.lubricated_offset(state.displacement, state.pressure)
        if not np.isfinite(following) or history[-1] > 1e6:
            return contact.ended(state.pressure, offset, DIVERGED, spent, history)
        offset = following
    return contact.ended(state.pressure, offset, ITERATION_LIMIT, spent, history)
