"""Load sharing in time: a film that remembers its past shares the load of the moment with the rough contact."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..ehl.result import cubic
from ..ehl.transient.active_set import StepSolution
from ..ehl.transient.setting import Setting
from ..ehl.transient.squeeze import Spring
from ..errors import ConvergenceError
from ..march.bdf import Memory
from ..report import CONVERGED, ITERATION_LIMIT
from ..rough.contract import ContactState, RoughContact

FIRST_TOUCH = 1e-3  # of the load: tried when the film has just come too thin for separated surfaces
LAST_TOUCH = 1e-5  # of the load: below it, ask whether the film clears the surface
MOST_TRIALS = 16


@dataclass(frozen=True)
class Contact:
    """The contact's part of a step: load [N], state, and softness -d(gap)/d(ln load) [m]."""

    load: float
    state: ContactState
    softness: float


@dataclass(frozen=True)
class Sharing:
    """What a step needs: the film's setting, the patch, the matrix that carries H to the film [m] at the
    patch's points, and the row of it that gives the mean film over A. ``unit``: N per unit of film load;
    correlation_length [m]: of the heights along y (NaN: not known)."""

    setting: Setting
    patch: RoughContact
    to_patch: np.ndarray
    mean_row: np.ndarray
    unit: float
    width: float
    tolerance: float
    correlation_length: float = math.nan

    def film_on_patch(self, H: np.ndarray) -> np.ndarray:
        """Smooth film [m] at the points of the patch."""
        return self.to_patch @ H

    def total(self, time: float) -> float:
        """F_T just before ``time`` [N]."""
        return self.setting.contact.load.before(time) * self.width


def make_sharing(
    setting: Setting, patch, width: float, tolerance: float, correlation_length: float = math.nan
) -> Sharing:
    """The operators that join the film's grid and the patch."""
    p = setting.problem
    x = patch.x / p.length_unit
    unit_vectors = np.eye(setting.grid.n + 1)
    to_patch = np.stack([cubic(setting.grid.x, e, x) for e in unit_vectors], axis=1) * p.film_unit
    weight = patch.weight
    return Sharing(
        setting,
        patch,
        to_patch,
        weight @ to_patch / weight.sum(),
        p.contact.e_prime * p.film_unit * width,
        width,
        tolerance,
        correlation_length,
    )


def share_step(sharing: Sharing, time: float, memory: Memory, z: np.ndarray, past: Contact) -> StepSolution:
    """Film and contact at ``time`` [s]; the `Contact` is the payload of the solution.

    The contact enters the film's load balance as a `Spring`; the contact is then solved at the load the
    spring took, and its gap gives the next spring (a secant in ln load), until |gap - film|/(gap + film)
    <= tolerance.
    """
    touch, softness, seen = past.load, past.softness, None
    total = sharing.total(time)
    state, mean = past.state, past.state.mean_gap
    solution: StepSolution
    for _ in range(MOST_TRIALS):
        spring = None
        if touch > 0.0:
            spring = Spring(sharing.mean_row, mean, touch / sharing.unit, softness)
        solution = sharing.setting.step(time, memory, z, spring)
        if solution.status != CONVERGED:
            return solution
        load = solution.terms.spring[0] * sharing.unit
        if spring is not None and load < LAST_TOUCH * total:
            load = 0.0
        film = sharing.film_on_patch(solution.terms.H)
        found = _close(sharing, film, load, state)
        if found is None:
            return replace(solution, status=ITERATION_LIMIT)
        if load == 0.0:
            if found.volume_residual <= 0.0:
                if spring is None:
                    return replace(solution, payload=Contact(0.0, found, softness))
                touch, z, state, seen = 0.0, solution.z, found, None
                continue
            load = min(FIRST_TOUCH * total, max(touch, LAST_TOUCH * total))
            touching = found.mean_gap
            found = _close(sharing, film, load, state)
            if found is None:
                return replace(solution, status=ITERATION_LIMIT)
            softness = max(touching - found.mean_gap, 1e-3 * touching)
        elif abs(found.volume_residual) <= sharing.tolerance:
            return replace(solution, payload=Contact(load, found, _softness(softness, seen, load, found)))
        softness = _softness(softness, seen, load, found)
        seen, touch, mean, state, z = (load, found.mean_gap), load, found.mean_gap, found, solution.z
    return replace(solution, status=ITERATION_LIMIT)


def _softness(old: float, seen, load: float, found: ContactState) -> float:
    """Secant of the gap over the logarithm of the load, where it says something."""
    if seen is None or abs(math.log(load / seen[0])) < 1e-6:
        return old
    slope = (seen[1] - found.mean_gap) / math.log(load / seen[0])
    return min(max(slope, 0.3 * old), 3.0 * old) if slope > 0.0 else old


def _close(sharing: Sharing, film: np.ndarray, load: float, start: ContactState) -> ContactState | None:
    """The contact at ``load`` [N] under ``film`` [m]; None where it cannot be solved."""
    if film.min() <= 0.0 and load == 0.0:
        return None
    try:
        return sharing.patch.close(film, load, start)
    except ConvergenceError:
        return None
