"""The load-sharing model in time: a film that remembers its past and the rough contact share the load of the moment."""

import math
from dataclasses import dataclass, replace

import numpy as np

from ..contact import ContactState, RoughContact
from ..errors import CONVERGED, ITERATION_LIMIT, ConvergenceError
from ..film import cubic
from ..models.shared import Prepared
from ..scene import Scene, moving_bodies
from .film_equations import Spring
from .film_setting import TIME_SHARE, Setting
from .march import Memory, Progress, Step
from .model import Output
from .moment import load_sharing_moment
from .scene_in_time import sampled_times, surface_speed

FIRST_TOUCH = 1e-3  # [-] share of the load that is tried when the film has just become too thin for separated surfaces
LAST_TOUCH = 1e-5  # [-] share of the load on the contact below which the film is tried without contact
MOST_TRIALS = 16  # number of film and contact solves in one step, at most
LOOSEST = 1e-4  # [-] loosest tolerance of the volume balance
STANDS_STILL = "moving roughness is treated as stationary; numerics.model = 'deterministic' moves it"


@dataclass(frozen=True)
class Contact:
    """The contact's part of a step: load [N], state, and softness -d(gap)/d(ln load) [m]."""

    load: float
    state: ContactState
    softness: float


@dataclass(frozen=True, kw_only=True)
class TransientLoadSharing:
    """The load-sharing model in time (`lubfric.time.model.TimeModel`).

    Attributes
    ----------
    prepared : scene and strip of rough surface of the run
    setting : grid and units of the film
    to_patch : operator from the film H at the nodes to the film [m] at the points of the contact's patch
    mean_row : operator from H to the mean film [m] over A
    tolerance : of the volume balance
    correlation_length : of the heights along y [m]
    area, plastic : factors from contact area and plastic area on the strip's cells to those on the scene's own cells;
        NaN where they are not known
    """

    prepared: Prepared
    setting: Setting
    to_patch: np.ndarray
    mean_row: np.ndarray
    tolerance: float
    correlation_length: float
    area: float = 1.0
    plastic: float = 1.0
    stops = ()

    @property
    def first_step(self) -> float:
        """After a start or a jump [s]."""
        return self.setting.first_step

    @property
    def time_error(self) -> float:
        """Largest local error of a step, unless it is said."""
        return TIME_SHARE * self.scene.numerics.tolerance_of("film")

    @property
    def x(self) -> np.ndarray:
        """Of the nodes [m]."""
        return self.setting.grid.x * self.setting.problem.length_unit

    @property
    def cells(self) -> str:
        """Of the grid, in words."""
        return f"{self.setting.grid.n} cells"

    @property
    def scene(self) -> Scene:
        """With all that changes in time."""
        return self.prepared.scene

    @property
    def patch(self) -> RoughContact:
        """The rough contact."""
        return self.prepared.contact

    @property
    def notes(self) -> tuple[str, ...]:
        """What a reader of the result should know."""
        rough = [name for name, _ in moving_bodies(self.scene)]
        times = sampled_times(self.scene)
        moving = any(surface_speed(self.scene, name, time) for name in rough for time in times)
        return (STANDS_STILL,) if moving else ()

    def record(self, progress: Progress) -> Output:
        """Return the numbers and fields after the last step."""
        unit = self.setting.problem
        terms = progress.solution.terms
        numbers, entries = load_sharing_moment(self, progress)
        return Output(
            numbers=numbers,
            entries=entries,
            pressure=terms.P * unit.pressure_unit,
            film_thickness=terms.H * unit.film_unit,
        )

    def resumable(self, progress: Progress) -> Progress:
        """Return ``progress`` with the pressure of the contact, from which the next one is solved, and without what the
        next step computes again."""
        contact = progress.payload
        state = contact.state
        fields = state.fields and replace(state.fields, gap=np.empty(0), displacement=np.empty(0))
        return replace(progress, payload=replace(contact, state=replace(state, fields=fields, y=None)), solution=None)

    def error_of(self, solution: Step, difference: np.ndarray) -> float:
        """Error of the film."""
        return self.setting.error_of(solution, difference)

    def solve(self, time: float, memory: Memory | None, z: np.ndarray, past: Contact) -> Step:
        """Film and contact at ``time`` [s]; the `Contact` is the payload of the solution.

        A `Spring` stands for the contact in the film's load balance. Then the contact is solved at the load of the
        spring, and its gap gives the next spring (a secant in ln load), until |gap - film|/(gap + film) <= tolerance.
        """
        touch = past.load
        softness = past.softness
        seen = None
        total = self.setting.contact.load.before(time)
        state = past.state
        mean = past.state.mean_gap
        solution: Step
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
                    touch = 0.0
                    z = solution.z
                    state = found
                    seen = None
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
            seen = (load, found.mean_gap)
            touch = load
            mean = found.mean_gap
            state = found
            z = solution.z
        return replace(solution, status=ITERATION_LIMIT)

    def _close(self, film: np.ndarray, load: float, start: ContactState) -> ContactState | None:
        """The contact at ``load`` [N] under ``film`` [m]; None if it cannot be solved."""
        if film.min() <= 0.0 and load == 0.0:
            return None
        try:
            return self.patch.close(film, load, start)
        except ConvergenceError:
            return None


def make_load_sharing(
    prepared: Prepared, setting: Setting, *, correlation_length: float, area: float, plastic: float
) -> TransientLoadSharing:
    """Return the model on the strip of ``prepared``, with the operators between the film's grid and the patch.
    ``correlation_length``, ``area``, ``plastic``: as in `TransientLoadSharing`."""
    problem = setting.problem
    patch = prepared.contact
    x = patch.x / problem.length_unit
    unit_vectors = np.eye(setting.grid.n + 1)
    to_patch = np.stack([cubic(setting.grid.x, e, x) for e in unit_vectors], axis=1) * problem.film_unit
    return TransientLoadSharing(
        prepared=prepared,
        setting=setting,
        to_patch=to_patch,
        mean_row=patch.weight @ to_patch / patch.weight.sum(),
        tolerance=min(prepared.scene.numerics.tolerance_of("balance"), LOOSEST),
        correlation_length=correlation_length,
        area=area,
        plastic=plastic,
    )


def _softness(old: float, seen, load: float, found: ContactState) -> float:
    """Secant of the gap over the logarithm of the load, if it is meaningful."""
    if seen is None or abs(math.log(load / seen[0])) < 1e-6:
        return old
    slope = (seen[1] - found.mean_gap) / math.log(load / seen[0])
    return min(max(slope, 0.3 * old), 3.0 * old) if slope > 0.0 else old
