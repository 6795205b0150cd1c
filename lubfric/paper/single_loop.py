"""Appendix 2 of the paper: pressure and separation are found in one loop.

The form "printed" is the algorithm as printed. It is the conjugate gradient of Polonsky and Keer (Wear 231 (1999)
206-219, doi:10.1016/S0043-1648(99)00113-1) on the cells in contact. The mean of the convolved direction is subtracted
(Eq. 18), overlapping cells are corrected in a step of their own (Eq. 22), the pressure is cut at the hardness, and the
separation follows from Eq. (8) over the lubricated area.

The form "consistent" (default) keeps the single loop, and changes what prevents convergence:

- Overlapping cells, and yielded cells that have opened, join the search direction. They get no step of their own.
- The length of the step is exact for the separation of this iteration. (Eq. 18 is right for a given *load*.)
- Eq. (8) counts the asperity contacts with their gap of zero. Its right side then falls by less than epsilon rises,
  whatever the share of contact, so the iteration cannot overshoot.
- The bulk deflection that is common to the complete contact becomes part of epsilon at once (`bulk`).
"""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from .._base import FloatArray, validate
from ..contact import ContactResult, SearchResult
from ..errors import CONVERGED, DIVERGED, ITERATION_LIMIT, STAGNATED
from .imposed_film import ImposedFilm, impose

STOPS = ("residual", "separation")
# Iterations without a tenth off the best residual after which the loop has stagnated. A choice: a smaller value may end
# a search that would converge.
LOOP_PATIENCE = 200


def single_loop(
    heights: FloatArray,
    film: float | FloatArray,
    spacing: float,
    e_prime: float,
    *,
    form: str = "consistent",
    stop: str = "residual",
    separation_tolerance: float = 1e-6,
    max_iterations: int = 2000,
    raise_on_failure: bool = True,
    **problem: Any,
) -> ContactResult:
    """Solve the contact of a rough surface under the separation ``h - epsilon``, with epsilon from the volume balance,
    Eq. (8).

    Parameters
    ----------
    heights : (nx, ny) surface z [m], upwards
    film : h [m], a number, (nx,) or (nx, ny)
    weight : area A of Eq. (8), as the part of each cell that lies inside it, (nx,) or (nx, ny); None: the complete
        array
    form : "consistent" or "printed" (see the module)
    stop : "residual", the honest test below; or "separation", Eq. (23): ``|h_s - h_s_old| <= separation_tolerance
        |h_s_old|`` with h_s its mean over A
    spacing, e_prime, hardness, boundary, tolerance, operator, max_iterations, raise_on_failure : as in
        `lubfric.solve_contact`

    Returns
    -------
    ContactResult : its ``approach`` is epsilon. ``report.residuals`` come from the returned pressure alone, and are
        measured by the length L of `lubfric.contact.length_scale`: complementarity and penetration as in
        `solve_contact`, and volume ``|mean_A max(g, 0) - mean_A h|/min(L, mean_A h)``. The solve has converged when the
        largest is <= tolerance, *also* when it was stopped by Eq. (23). The notes say when Eq. (23) was met first.

    Raises
    ------
    InputError : a value out of range, before any work
    ConvergenceError : the largest residual is above the tolerance; carries report and result
    """
    validate.choice("form", form, LOOP_FORMS)
    validate.choice("stop", stop, STOPS)
    validate.positive("separation_tolerance", separation_tolerance, "(-)")

    def iterate(pressure: FloatArray) -> SearchResult:
        with np.errstate(all="ignore"):  # a printed loop may overflow; it then ends as diverged
            return _ended(contact, LOOP_FORMS[form](contact, pressure), stop, separation_tolerance)

    contact = impose(heights, film, spacing, e_prime, max_iterations=max_iterations, **problem)
    return contact.solved(iterate, f"single loop, {form}", raise_on_failure=raise_on_failure)


Iterate = tuple[np.ndarray, np.ndarray, float, int]  # pressure, its displacement, epsilon, convolutions so far


def _printed(contact: ImposedFilm, p: np.ndarray) -> Iterator[Iterate]:
    """Yield the iterates of Appendix 2, Eqs. (14)-(22), in the sign of the paper: its g is minus the gap. They end
    where one has no successor."""
    problem = contact.problem
    apply = contact.problem.operator.apply
    displacement = apply(p)
    convolutions = 1
    offset = contact.lubricated_offset(displacement, p)
    t = np.zeros_like(p)
    last = 1.0
    keep = 0.0
    tau = 0.0
    while convolutions == 1 or np.isfinite(offset) and np.isfinite(tau):
        yield p, displacement, offset, convolutions
        g = offset - problem.gap0 - displacement
        inside = p > 0
        if not inside.any():
            return
        power = np.vdot(g[inside], g[inside])
        t = np.where(inside, g + keep * (power / last) * t, 0.0)
        r = -apply(t)
        r -= r[inside].mean()
        tau = np.vdot(g[inside], t[inside]) / np.vdot(r[inside], t[inside])
        p = np.maximum(p - tau * t, 0.0)
        overlapping = (p == 0) & (g > 0)
        p[overlapping] -= tau * g[overlapping]
        p = np.clip(p, 0.0, problem.hardness)
        last = power
        keep = 0.0 if overlapping.any() else 1.0
        displacement = apply(p)
        convolutions += 2
        offset = contact.lubricated_offset(displacement, p)


def _consistent(contact: ImposedFilm, p: np.ndarray) -> Iterator[Iterate]:
    """Yield the iterates of the consistent form. Cells enter and leave the working set. Directions are kept
    (Polak-Ribiere, never negative), and epsilon follows from Eq. (8) after every step."""
    problem = contact.problem
    hardness = contact.problem.hardness
    apply = contact.problem.operator.apply
    displacement = apply(p)
    convolutions = 2
    offset = contact.offset(displacement)
    shared = bulk(contact, p)
    # the direction, from what, whether it goes on
    d = np.zeros_like(p)
    residue = np.zeros_like(p)
    kept = False
    while True:
        yield p, displacement, offset, convolutions
        gap = problem.gap0 + displacement - offset
        free = ((p > 0) & (p < hardness)) | ((p <= 0) & (gap < 0)) | ((p >= hardness) & (gap > 0))
        more = 0.0
        if free.any():  # else all that touches has yielded, and epsilon alone is not that of Eq. (8) yet
            r = np.where(free, gap, 0.0)
            step = 0.0
            while not step > 0:
                keep = max(0.0, float(np.vdot(r, r - residue) / np.vdot(residue, residue))) if kept else 0.0
                d = np.where(free, keep * d, 0.0) - r if kept else -r
                curvature = np.vdot(d, apply(d)) - shared * d.sum() ** 2
                if curvature <= 0 and shared > 0:  # contact has left the area the bulk was taken from
                    curvature, shared = curvature + shared * d.sum() ** 2, 0.0
                step = -float(np.vdot(r, d) / curvature)
                if not step > 0 and not kept:
                    return
                # else begin again from the steepest descent
                residue = r
                kept = step > 0
            before, p = p.sum(), np.clip(p + step * d, 0.0, hardness)
            displacement = apply(p)
            convolutions += 2
            more = p.sum() - before
        above = problem.gap0 + displacement - (offset + shared * more)  # epsilon has taken over the bulk deflection
        offset = contact.offset(displacement, np.where(p >= hardness, np.maximum(-above, 0.0), 0.0))


LOOP_FORMS: dict[str, Callable[[ImposedFilm, np.ndarray], Iterator[Iterate]]] = {
    "consistent": _consistent,
    "printed": _printed,
}


def _ended(contact: ImposedFilm, iterates: Iterator[Iterate], stop: str, separation_tolerance: float) -> SearchResult:
    """Return the end of the loop; both stopping tests are made after every iteration."""
    # where an iterate has no successor
    problem = contact.problem
    status = DIVERGED
    history: list[float] = []
    notes: list[str] = []
    best = np.inf
    lowest = np.inf
    waiting = 0
    old = np.inf
    for iteration, (pressure, displacement, offset, convolutions) in enumerate(iterates):
        error = contact.residual(pressure, displacement, offset)
        error = error if np.isfinite(error) else np.inf
        history.append(error)
        if error < best or not iteration:
            best = error
            nearest = (pressure, offset)
        lowest, waiting = (error, 0) if error < 0.9 * lowest else (lowest, waiting + 1)
        separation = contact.mean(problem.gap0) - offset  # Eq. (23), from the mean plane of the surface over A
        unchanged = np.isfinite(old) and abs(separation - old) <= separation_tolerance * abs(old)
        old = separation
        if unchanged and not notes:
            notes.append(f"Eq. (23) met at iteration {iteration}, where the residual was {error:.2e}")
        if unchanged if stop == "separation" else error <= 0.9 * problem.tolerance:
            status = CONVERGED
            nearest = (pressure, offset)
            break
        if error == np.inf and iteration > 0:
            break
        if waiting > LOOP_PATIENCE or iteration == problem.max_iterations:
            status = STAGNATED if waiting > LOOP_PATIENCE else ITERATION_LIMIT
            break
    return contact.ended(*nearest, status, convolutions + 1, history, notes, iteration)


def bulk(contact: ImposedFilm, pressure: FloatArray) -> float:
    """Return the smallest deflection [m/Pa] that one loaded cell, wherever it is, causes anywhere in A and the contact.

    It is the smallest deflection under a uniform pressure on the box around A and the contact. This is less than the
    energy of any pressure in that box (equilibrium measure), so the operator minus this constant stays positive there.
    It is zero where the contact is periodic. Without it epsilon would converge very slowly, because the mean gap of a
    smooth cylinder depends little on the load.
    """
    box = np.zeros(pressure.shape)
    rows = np.flatnonzero(((pressure > 0) | (contact.weight > 0)).any(axis=1))
    columns = np.flatnonzero(((pressure > 0) | (contact.weight > 0)).any(axis=0))
    inside = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    box[inside] = 1.0
    return max(0.0, float(contact.problem.operator.apply(box)[inside].min() / box.sum()))
