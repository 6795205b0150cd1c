"""Appendix 2 of the paper: pressure and separation are found in one loop.

The form "printed" is the algorithm as printed. It is the conjugate gradient of Polonsky and Keer (Wear 231 (1999)
206-219, doi:10.1016/S0043-1648(99)00113-1) on the cells in contact. The mean of the convolved direction is subtracted
(Eq. 18), overlapping cells are corrected in a step of their own (Eq. 22), the pressure is cut at the hardness, and the
separation follows from Eq. (8) over the lubricated area.

The form "consistent" (default) keeps the single loop, and changes what prevents convergence:

- Overlapping cells, and yielded cells that have opened, join the search direction. They get no step of their own.
- The length of the step is exact for the separation of this iteration. (Eq. 18 is right for a given *load*.)
- Eq. (8) counts the contact spots with their gap of zero. Its right side then falls by less than epsilon rises,
  whatever the share of contact, so the iteration cannot overshoot.
- The bulk deflection that is common to the whole contact becomes part of epsilon at once (`bulk`).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .._base import validate
from ..contact import ContactResult, Found
from ..errors import CONVERGED, DIVERGED, ITERATION_LIMIT, STAGNATED
from .imposed_film import ImposedFilm, impose

FORMS = ("consistent", "printed")
STOPS = ("residual", "separation")
PATIENCE = 200  # iterations without a tenth off the best residual


def single_loop(
    heights,
    film,
    spacing,
    e_prime,
    *,
    form="consistent",
    stop="residual",
    separation_tolerance=1e-6,
    max_iterations=2000,
    raise_on_failure=True,
    **problem,
) -> ContactResult:
    """Contact of a rough surface under the separation ``h - epsilon``, with epsilon from the volume balance, Eq. (8).

    Parameters
    ----------
    heights : (nx, ny) surface z [m], upwards
    film : h [m], a number, (nx,) or (nx, ny)
    weight : area A of Eq. (8), as the part of each cell that lies inside it, (nx,) or (nx, ny); None: the whole array
    form : "consistent" or "printed" (see the module)
    stop : "residual", the honest test below; or "separation", Eq. (23):
        ``|h_s - h_s_old| <= separation_tolerance |h_s_old|`` with h_s its mean over A
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
    validate.choice("form", form, FORMS)
    validate.choice("stop", stop, STOPS)
    validate.positive("separation_tolerance", separation_tolerance, "(-)")

    def iterate(pressure) -> Found:
        step = {"consistent": _Consistent, "printed": _Printed}[form](contact, pressure)
        with np.errstate(all="ignore"):  # a printed loop may overflow; it then ends as diverged
            return _loop(contact, step, stop, separation_tolerance)

    contact = impose(heights, film, spacing, e_prime, max_iterations=max_iterations, **problem)
    return contact.solved(iterate, f"single loop, {form}", raise_on_failure)


def _loop(contact: ImposedFilm, step, stop: str, separation_tolerance: float) -> Found:
    """Iterate; both stopping tests are made after every iteration."""
    problem, status = contact.problem, ITERATION_LIMIT
    history: list[float] = []
    notes: list[str] = []
    best, lowest, waiting, old = (np.inf, step.pressure, step.offset), np.inf, 0, np.inf
    for iteration in range(problem.max_iterations + 1):
        if iteration > 0 and not step.advance():
            status = DIVERGED
            break
        error = contact.residual(step.pressure, step.displacement, step.offset)
        error = error if np.isfinite(error) else np.inf
        history.append(error)
        if error < best[0]:
            best = (error, step.pressure.copy(), step.offset)
        lowest, waiting = (error, 0) if error < 0.9 * lowest else (lowest, waiting + 1)
        separation = contact.mean(problem.gap0) - step.offset  # Eq. (23), from the mean plane of the surface over A
        settled = np.isfinite(old) and abs(separation - old) <= separation_tolerance * abs(old)
        old = separation
        if settled and not notes:
            notes.append(f"Eq. (23) met at iteration {iteration}, where the residual was {error:.2e}")
        if settled if stop == "separation" else error <= 0.9 * problem.tolerance:
            status = CONVERGED
        elif error == np.inf and iteration > 0:
            status = DIVERGED
        elif waiting > PATIENCE:
            status = STAGNATED
        if status != ITERATION_LIMIT:
            break
    pressure, offset = (step.pressure, step.offset) if status == CONVERGED else best[1:]
    return contact.ended(pressure, offset, status, step.convolutions + 1, history, notes, iteration)


class _Printed:
    """One iteration of Appendix 2, Eqs. (14)-(22), in the sign of the paper: its g is minus the gap."""

    def __init__(self, contact: ImposedFilm, pressure):
        self.contact, self.pressure = contact, pressure
        self.displacement = contact.problem.operator.apply(pressure)
        self.offset = contact.lubricated_offset(self.displacement, pressure)
        self.direction = np.zeros_like(pressure)
        self.power, self.keep, self.convolutions = 1.0, 0.0, 1

    def advance(self) -> bool:
        problem, p = self.contact.problem, self.pressure
        g = self.offset - problem.gap0 - self.displacement
        inside = p > 0
        if not inside.any():
            return False
        power = np.vdot(g[inside], g[inside])
        t = np.where(inside, g + self.keep * (power / self.power) * self.direction, 0.0)
        r = -problem.operator.apply(t)
        r -= r[inside].mean()
        tau = np.vdot(g[inside], t[inside]) / np.vdot(r[inside], t[inside])
        p = np.maximum(p - tau * t, 0.0)
        overlapping = (p == 0) & (g > 0)
        p[overlapping] -= tau * g[overlapping]
        self.pressure = np.clip(p, 0.0, problem.hardness)
        self.direction, self.power, self.keep = t, power, 0.0 if overlapping.any() else 1.0
        self.displacement = problem.operator.apply(self.pressure)
        self.offset = self.contact.lubricated_offset(self.displacement, self.pressure)
        self.convolutions += 2
        return bool(np.isfinite(self.offset) and np.isfinite(tau))


class _Consistent:
    """One iteration of the consistent form.

    Cells enter and leave the working set. Directions are kept (Polak-Ribiere, never negative), and epsilon follows from
    Eq. (8) after every step.
    """

    def __init__(self, contact: ImposedFilm, pressure):
        self.contact, self.pressure = contact, pressure
        self.displacement = contact.problem.operator.apply(pressure)
        self.offset = contact.offset(self.displacement)
        self.bulk = bulk(contact, pressure)
        self.direction: Any = None
        self.residue: Any = None
        self.convolutions = 2

    def advance(self) -> bool:
        problem, p, hardness = self.contact.problem, self.pressure, self.contact.problem.hardness
        gap = problem.gap0 + self.displacement - self.offset
        free = ((p > 0) & (p < hardness)) | ((p <= 0) & (gap < 0)) | ((p >= hardness) & (gap > 0))
        if not free.any():  # all that touches has yielded: epsilon alone is not that of Eq. (8) yet
            self._follow(0.0)
            return True
        r = np.where(free, gap, 0.0)
        d = -r
        if self.direction is not None:
            keep = max(0.0, np.vdot(r, r - self.residue) / np.vdot(self.residue, self.residue))
            d += np.where(free, keep * self.direction, 0.0)
        curvature = np.vdot(d, problem.operator.apply(d)) - self.bulk * d.sum() ** 2
        if curvature <= 0 and self.bulk > 0:  # contact has left the area the bulk was taken from
            curvature, self.bulk = curvature + self.bulk * d.sum() ** 2, 0.0
        step: Any = -(np.vdot(r, d) / curvature)
        if not step > 0:
            if self.direction is None:
                return False
            self.direction = None  # begin again from the steepest descent
            return self.advance()
        self.pressure = np.clip(p + step * d, 0.0, hardness)
        self.direction, self.residue = d, r
        self.displacement = problem.operator.apply(self.pressure)
        self.convolutions += 2
        self._follow(self.pressure.sum() - p.sum())
        return True

    def _follow(self, more) -> None:
        """Take epsilon from Eq. (8), with the overlap of yielded cells after epsilon has taken over the bulk
        deflection."""
        problem = self.contact.problem
        offset = self.offset + self.bulk * more
        gap = problem.gap0 + self.displacement - offset
        overlap = np.where(self.pressure >= problem.hardness, np.maximum(-gap, 0.0), 0.0)
        self.offset = self.contact.offset(self.displacement, overlap)


def bulk(contact: ImposedFilm, pressure) -> float:
    """The smallest deflection [m/Pa] that one loaded cell, wherever it is, causes anywhere in A and the contact.

    It is the smallest deflection under a uniform pressure on the box around A and the contact. This is less than the
    energy of any pressure in that box (equilibrium measure), so the operator minus this constant stays positive there.
    It is zero where the contact is periodic. Without it epsilon would hardly proceed, because the mean gap of a smooth
    cylinder hardly depends on the load.
    """
    box = np.zeros(pressure.shape)
    rows = np.flatnonzero(((pressure > 0) | (contact.weight > 0)).any(axis=1))
    columns = np.flatnonzero(((pressure > 0) | (contact.weight > 0)).any(axis=0))
    inside = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    box[inside] = 1.0
    return max(0.0, float(contact.problem.operator.apply(box)[inside].min() / box.sum()))
