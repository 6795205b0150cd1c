"""The nested alternative to the single loop: solve the contact at a fixed separation, update the separation, repeat.

This is the method of Morales-Espejel et al. as Akchurin et al. 2015 (doi:10.1007/s11249-015-0536-z, end of Sec. 2.2)
describe it: "iteratively solving the system (3) and Eq. (8)", which they found to take too long.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .._base import increasing_root, validate
from ..contact import ContactResult, refine
from ..errors import CONVERGED, DIVERGED, ITERATION_LIMIT
from .imposed_film import ImposedFilm, Outcome, impose

UPDATES = ("root", "repeat")


def alternating(
    heights,
    film,
    spacing,
    e_prime,
    *,
    weight=None,
    hardness=None,
    boundary=("periodic", "periodic"),
    tolerance=1e-6,
    update="root",
    operator=None,
    max_iterations=100,
    raise_on_failure=True,
) -> ContactResult:
    """Contact under the separation ``h - epsilon``: system (3) is solved at one epsilon after the other.

    update : "repeat" takes epsilon from Eq. (8) over the lubricated area, as described in the paper. An error in
        epsilon is passed on by the share with which the deflection of the lubricated area follows epsilon. That share
        is zero in an elastic periodic cell, and nearly one under a cylinder, where the iteration hardly proceeds.
        "root" (default) brackets the zero of the volume balance as a function of epsilon. The volume falls with
        epsilon, so there is exactly one.
    max_iterations : of the outer loop

    The other arguments, the result, its residuals and the errors raised are those of
    `lubfric.paper.single_loop`. ``report.iterations`` counts the outer loop, ``report.evaluations`` every
    convolution.
    """
    validate.choice("update", update, UPDATES)
    iterate = _by_root if update == "root" else _by_repetition
    contact = impose(heights, film, weight, spacing, e_prime, hardness, boundary, tolerance, operator, max_iterations)
    return contact.solved(iterate, f"alternating, {update}", raise_on_failure)


class _Inner:
    """System (3) at a given epsilon. Each solve starts from the last one."""

    def __init__(self, contact: ImposedFilm, pressure):
        self.contact, self.pressure, self.convolutions = contact, pressure, 1.0
        self.first_offset = contact.offset(contact.problem.operator.apply(pressure))
        self.tight = replace(contact.problem, tolerance=0.3 * contact.problem.tolerance, max_iterations=2000)

    def solve(self, offset: float) -> float:
        """Solve at this epsilon and return (film - volume)/min(L, film), which rises with epsilon."""
        found = refine(self.tight, self.pressure.copy(), level=offset)
        self.pressure, self.displacement = found.state.pressure, found.state.displacement
        self.convolutions += found.convolutions
        return self.contact.surplus(found.state)


def _by_repetition(contact: ImposedFilm, pressure) -> Outcome:
    inner = _Inner(contact, pressure)
    offset, history, status = inner.first_offset, [], ITERATION_LIMIT
    for _ in range(contact.problem.max_iterations):
        history.append(abs(inner.solve(offset)))
        if history[-1] <= 0.5 * contact.problem.tolerance:
            status = CONVERGED
            break
        following = contact.lubricated_offset(inner.displacement, inner.pressure)
        if not np.isfinite(following) or history[-1] > 1e6:
            status = DIVERGED
            break
        offset = following
    return Outcome(inner.pressure, offset, status, len(history), inner.convolutions, history, [])


def _by_root(contact: ImposedFilm, pressure) -> Outcome:
    inner = _Inner(contact, pressure)
    first = inner.first_offset
    lowest = float(contact.problem.gap0.min())  # first touch: below it there is no pressure

    def surplus(offset, _):
        return inner.solve(offset), (inner.pressure, offset)

    step = max(0.05 * abs(first - lowest), 1e-3 * contact.mean_film)
    root = increasing_root(
        surplus,
        first,
        step=step,
        bounds=(lowest + 1e-9 * abs(first - lowest), np.inf),
        tolerance=0.5 * contact.problem.tolerance,
        max_evaluations=contact.problem.max_iterations,
    )
    pressure, offset = root.payload
    return Outcome(pressure, offset, root.status, len(root.history), inner.convolutions, list(root.history), [])
