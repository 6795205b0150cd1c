"""Load sharing in time: a film that remembers its past and the rough contact share the load of the moment."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..contact import ContactState, RoughContact
from ..errors import CONVERGED, ITERATION_LIMIT, ConvergenceError
from ..film import cubic
from ..scene import Scene
from .film_equations import Spring
from .film_setting import FilmStep, Setting
from .march import Memory
from .steady import Strip

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
class Sharing:
    """A solver of `lubfric.time.march`: film and rough contact share the load of the moment.

    ``setting``: of the film; ``to_patch`` gives the film [m] at the points of the contact's patch from H, and its
    ``mean_row`` the mean film over A; ``tolerance``: of the volume.
    """

    strip: Strip
    setting: Setting
    to_patch: np.ndarray
    mean_row: np.ndarray
    tolerance: float

    @property
    def scene(self) -> Scene:
        """With all that changes in time."""
        return self.strip.prepared.scene

    @property
    def patch(self) -> RoughContact:
        """The rough contact."""
        return self.strip.prepared.contact

    def error_of(self, solution: FilmStep, difference: np.ndarray) -> float:
        """Error of the film."""
        return self.setting.error_of(solution, difference)

    def solve(self, time: float, memory: Memory | None, z: np.ndarray, past: Contact) -> FilmStep:
        """Film and contact at ``time`` [s]; the `Contact` is the payload of the solution.

        A `Spring` stands for the contact in the film's load balance. Then the contact is solved at the load of the
        spring, and its gap gives the next spring (a secant in ln load), until |gap - film|/(gap + film) <= tolerance.
        """
        touch, softness, seen = past.load, past.softness, None
        total = self.setting.contact.load.before(time)
        state, mean = past.state, past.state.mean_gap
        solution: FilmStep
        for _ in range(MOST_TRIALS):
            spring = None
            if touch > 0.0:
                spring = Spring(self.mean_row, mean, touch / self.setting.load_unit, softness)
            solution = self.setting.solve(time, memory, z, spring)
            if solution.status != CONVERGED:
                return solution
            load = solution.terms.spring[0] * self.setting.load_unit
            if spring is not None and load < LAST_TOUCH * total:
                load = 0.0
            film = self.to_patch @ solution.terms.H
            found = self._close(film, load, state)
            if found is None:
                break
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
                    break
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
            return self.patch.close(film, load, start)
        except ConvergenceError:
            return None


def make_sharing(strip: Strip, setting: Setting) -> Sharing:
    """The `Sharing` on ``strip``, with the operators between the film's grid and the patch."""
    p, patch = setting.problem, strip.prepared.contact
    x = patch.x / p.length_unit
    unit_vectors = np.eye(setting.grid.n + 1)
    to_patch = np.stack([cubic(setting.grid.x, e, x) for e in unit_vectors], axis=1) * p.film_unit
    tolerance = min(strip.prepared.scene.numerics.tolerances.balance, LOOSEST)
    return Sharing(strip, setting, to_patch, patch.weight @ to_patch / patch.weight.sum(), tolerance)


def _softness(old: float, seen, load: float, found: ContactState) -> float:
    """Secant of the gap over the logarithm of the load, if it is meaningful."""
    if seen is None or abs(math.log(load / seen[0])) < 1e-6:
        return old
    slope = (seen[1] - found.mean_gap) / math.log(load / seen[0])
    return min(max(slope, 0.3 * old), 3.0 * old) if slope > 0.0 else old
