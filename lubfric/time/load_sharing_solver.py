"""One step of the load-sharing model in time: a film that remembers its past and the rough contact share the load of
the moment."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .._base import may_stay_unsolved
from ..contact import ContactState, RoughContact
from ..errors import CONVERGED, ITERATION_LIMIT
from ..film import cubic, hertz
from ..models.load_sharing import film_under, gap_per_film, volume_residual
from ..models.shared import Prepared
from ..scene import Scene
from .film_equations import Spring
from .film_setting import Setting
from .march import Memory, Step

# Choices: a share that is too far off costs further solves, and the last number ends them.
FIRST_TOUCH = 1e-3  # [-] share of the load that is tried when the film has just become too thin for separated surfaces
LAST_TOUCH = 1e-5  # [-] share of the load on the contact below which the film is tried without contact
MOST_TRIALS = 16  # number of film and contact solves in one step, at most


@dataclass(frozen=True)
class ContactStep:
    """The asperity contact in a step: its load [N], its state, and its softness -d(gap)/d(ln load) [m]."""

    load: float
    state: ContactState
    softness: float


@dataclass(frozen=True, kw_only=True)
class ContactOfMoment:
    """The rough contact with the area A of a moment: the ``patch``, and the operator ``to_patch`` from the film H at
    the nodes to the film [m] at its points."""

    patch: RoughContact
    to_patch: np.ndarray

    @cached_property
    def mean_row(self) -> np.ndarray:
        """The operator from H to the mean film [m] over A."""
        mean_row: np.ndarray = self.patch.weight @ self.to_patch / self.patch.weight.sum()
        return mean_row

    def closed(self, film: np.ndarray, load: float, start: ContactState) -> ContactState | None:
        """Return the contact at ``load`` [N] under ``film`` [m]; None if it cannot be solved."""
        if film.min() <= 0.0 and load == 0.0:
            return None
        with may_stay_unsolved():
            return self.patch.close(film, load, start)
        return None


def operator_to(setting: Setting, x: np.ndarray) -> np.ndarray:
    """Return the operator from the film H at the nodes of ``setting`` to the film [m] at ``x`` [m]."""
    unit_vectors = np.eye(setting.grid.n + 1)
    places = x / setting.problem.length_unit
    columns = [cubic(setting.grid.x, each, places) for each in unit_vectors]
    return np.stack(columns, axis=1) * setting.problem.film_unit


@dataclass(frozen=True, kw_only=True)
class LoadSharingSolver:
    """Film and rough contact of a run by the load-sharing model.

    Attributes
    ----------
    prepared : scene and strip of rough surface of the run
    setting : grid and units of the film
    to_patch : operator from the film H at the nodes to the film [m] at the points of the contact's patch
    tolerance : of the volume balance
    correlation_length : of the heights along y [m]
    area, plastic : factors from contact area and plastic area on the strip's cells to those on the scene's own cells;
        NaN where they are not known
    """

    prepared: Prepared
    setting: Setting
    to_patch: np.ndarray
    tolerance: float
    correlation_length: float
    area: float = 1.0
    plastic: float = 1.0

    @property
    def scene(self) -> Scene:
        """The scene, with all that changes in time."""
        return self.prepared.scene

    def contact_at(self, time: float) -> ContactOfMoment:
        """Return the rough contact of the strip with the area A of ``time`` [s]: the Hertz strip of the load and the
        radius just before it, or the complete patch, as in a steady contact."""
        bodies = self.scene.bodies
        history = self.setting.line_history
        load = history.load.before(time) / history.width
        half_width = hertz.line_half_width(load, history.radius.before(time), history.e_prime)
        if self.scene.contact.region == "box" or half_width == bodies.half_width:
            return self._contact_of_scene
        patch = self.prepared.rough_contact
        of_moment = patch.over_strip(half_width, bodies.half_width)
        is_same = np.array_equal(of_moment.x, patch.x)
        return ContactOfMoment(
            patch=of_moment, to_patch=self.to_patch if is_same else operator_to(self.setting, of_moment.x)
        )

    @cached_property
    def _contact_of_scene(self) -> ContactOfMoment:
        """The contact with the area A of the scene, that of every moment where load and radius are constant."""
        return ContactOfMoment(patch=self.prepared.rough_contact, to_patch=self.to_patch)

    def error_of(self, solution: Step, difference: np.ndarray) -> float:
        """Return the relative size of a ``difference`` of films."""
        return self.setting.error_of(solution, difference)

    def solve(self, time: float, memory: Memory | None, z: np.ndarray, past: ContactStep) -> Step:
        """Return the solution at ``time`` [s]; its payload is the `ContactStep`.

        A `Spring` represents the contact in the film's load balance. Then the contact is solved at the load of the
        spring, and its gap gives the next spring (a secant in ln load), until the `volume_residual` is within the
        tolerance.
        """
        contact = self.contact_at(time)
        mean_row = contact.mean_row
        touch = past.load
        softness = past.softness
        seen = None
        total = self.setting.line_history.load.before(time)
        state = past.state
        mean = past.state.mean_gap
        solution: Step
        for _ in range(MOST_TRIALS):
            spring = None
            if touch > 0.0:
                film_in_gap = film_under(mean)
                length = softness * (film_in_gap / gap_per_film(film_in_gap))
                spring = Spring(mean_row, film_in_gap, touch / self.setting.load_unit, length)
            solution = self.setting.solve(time, memory, z, spring)
            if solution.status != CONVERGED:
                return solution
            load = solution.terms.spring[0] * self.setting.load_unit
            if spring is not None and load < LAST_TOUCH * total:
                load = 0.0
            film = contact.to_patch @ solution.terms.H
            contact_state = contact.closed(film, load, state)
            if contact_state is None:
                break
            if load == 0.0:
                if volume_residual(contact_state) <= 0.0:
                    if spring is None:
                        return replace(solution, payload=ContactStep(0.0, contact_state, softness))
                    touch = 0.0
                    z = solution.z
                    state = contact_state
                    seen = None
                    continue
                load = min(FIRST_TOUCH * total, max(touch, LAST_TOUCH * total))
                touching_gap = contact_state.mean_gap
                contact_state = contact.closed(film, load, state)
                if contact_state is None:
                    break
                softness = max(touching_gap - contact_state.mean_gap, 1e-3 * touching_gap)
            elif abs(volume_residual(contact_state)) <= self.tolerance:
                softness = _softness(softness, seen, load, contact_state)
                return replace(solution, payload=ContactStep(load, contact_state, softness))
            softness = _softness(softness, seen, load, contact_state)
            seen = (load, contact_state.mean_gap)
            touch = load
            mean = contact_state.mean_gap
            state = contact_state
            z = solution.z
        return replace(solution, status=ITERATION_LIMIT)


def _softness(old: float, seen: tuple[float, float] | None, load: float, contact_state: ContactState) -> float:
    """Return the secant of the gap over the logarithm of the load, if it is meaningful."""
    if seen is None or abs(math.log(load / seen[0])) < 1e-6:
        return old
    slope = (seen[1] - contact_state.mean_gap) / math.log(load / seen[0])
    return min(max(slope, 0.3 * old), 3.0 * old) if slope > 0.0 else old
