"""Load sharing in time: a film that remembers its past and the rough contact share the load of the moment."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..contact import ContactState
from ..errors import CONVERGED, ITERATION_LIMIT, ConvergenceError
from ..film import cubic
from ..sampling import correlation_along_y
from ..sharing import Prepared
from .bdf import Memory
from .film_active_set import StepSolution
from .film_setting import Setting
from .film_squeeze import Spring

FIRST_TOUCH = 1e-3  # of the load: tried when the film has just come too thin for separated surfaces
LAST_TOUCH = 1e-5  # of the load: below it, ask whether the film clears the surface
MOST_TRIALS = 16
LOOSEST = 1e-4  # tolerance on the volume


@dataclass(frozen=True)
class Contact:
    """The contact's part of a step: load [N], state, and softness -d(gap)/d(ln load) [m]."""

    load: float
    state: ContactState
    softness: float


@dataclass(frozen=True)
class OnOwnCells:
    """Factors by which contact ``area`` and ``plastic`` area on the cells of a line are those on the scene's own (NaN:
    not known)."""

    area: float = 1.0
    plastic: float = 1.0


@dataclass(frozen=True)
class Sharing:
    """One implicit step of film and rough contact, which share the load of the moment (a `lubfric.time.bdf.Solver`).

    ``setting``: of the film; ``to_patch`` gives the film [m] at the points of the patch from H, and its ``mean_row``
    the mean film over A; ``tolerance``: of the volume; ``cells``: by which its areas are those on the scene's
    own cells.
    """

    prepared: Prepared
    setting: Setting
    to_patch: np.ndarray
    mean_row: np.ndarray
    tolerance: float
    cells: OnOwnCells

    @property
    def unit(self) -> float:
        """Load [N] per unit of film load."""
        p = self.setting.problem
        return p.contact.e_prime * p.film_unit * self.width

    @property
    def width(self) -> float:
        """Of the contact [m]."""
        return self.prepared.scene.bodies.width

    @cached_property
    def correlation_length(self) -> float:
        """Of the heights along y [m]."""
        return correlation_along_y(self.prepared)

    def total(self, time: float) -> float:
        """F_T just before ``time`` [N]."""
        return self.setting.contact.load_per_width(time) * self.width

    def error_of(self, solution: StepSolution, difference: np.ndarray) -> float:
        """Error of the film."""
        return self.setting.error_of(solution, difference)

    def solve(self, time: float, memory: Memory, z: np.ndarray, past: Contact) -> StepSolution:
        """Film and contact at ``time`` [s]; the `Contact` is the payload of the solution.

        A `Spring` stands for the contact in the film's load balance. Then the contact is solved at the load of the
        spring, and its gap gives the next spring (a secant in ln load), until |gap - film|/(gap + film) <= tolerance.
        """
        touch, softness, seen = past.load, past.softness, None
        total = self.total(time)
        state, mean = past.state, past.state.mean_gap
        solution: StepSolution
        for _ in range(MOST_TRIALS):
            spring = None
            if touch > 0.0:
                spring = Spring(self.mean_row, mean, touch / self.unit, softness)
            solution = self.setting.solve(time, memory, z, spring)
            if solution.status != CONVERGED:
                return solution
            load = solution.terms.spring[0] * self.unit
            if spring is not None and load < LAST_TOUCH * total:
                load = 0.0
            film = self.to_patch @ solution.terms.H
            found = self._close(film, load, state)
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
                found = self._close(film, load, state)
                if found is None:
                    return replace(solution, status=ITERATION_LIMIT)
                softness = max(touching - found.mean_gap, 1e-3 * touching)
            elif abs(found.volume_residual) <= self.tolerance:
                return replace(solution, payload=Contact(load, found, _softness(softness, seen, load, found)))
            softness = _softness(softness, seen, load, found)
            seen, touch, mean, state, z = (load, found.mean_gap), load, found.mean_gap, found, solution.z
        return replace(solution, status=ITERATION_LIMIT)

    def _close(self, film: np.ndarray, load: float, start: ContactState) -> ContactState | None:
        """The contact at ``load`` [N] under ``film`` [m]; None if it cannot be solved."""
        if film.min() <= 0.0 and load == 0.0:
            return None
        try:
            return self.prepared.contact.close(film, load, start)
        except ConvergenceError:
            return None


def make_sharing(prepared: Prepared, setting: Setting, cells: OnOwnCells) -> Sharing:
    """The `Sharing` of a scene, with the operators between the film's grid and the patch. ``cells``: those of
    `Sharing`."""
    p, patch = setting.problem, prepared.contact
    x = patch.x / p.length_unit
    unit_vectors = np.eye(setting.grid.n + 1)
    to_patch = np.stack([cubic(setting.grid.x, e, x) for e in unit_vectors], axis=1) * p.film_unit
    weight = patch.weight
    tolerance = min(prepared.scene.numerics.tolerances.balance, LOOSEST)
    return Sharing(prepared, setting, to_patch, weight @ to_patch / weight.sum(), tolerance, cells)


def _softness(old: float, seen, load: float, found: ContactState) -> float:
    """Secant of the gap over the logarithm of the load, if it is meaningful."""
    if seen is None or abs(math.log(load / seen[0])) < 1e-6:
        return old
    slope = (seen[1] - found.mean_gap) / math.log(load / seen[0])
    return min(max(slope, 0.3 * old), 3.0 * old) if slope > 0.0 else old
