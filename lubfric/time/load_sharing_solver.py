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
from ..models.load_sharing import film_under, volume_residual, with_gap_of_closure
from ..models.shared import Prepared
from ..scene import Scene
from .film_equations import Spring
from .film_setting import Setting
from .march import Memory, Step

# Choices: a share that is too far off costs further solves, and the last number ends them.
FIRST_TOUCH = 1e-5  # [-] share of the load that is tried when the film has just become too thin for separated surfaces
FIRST_POWER = 1.5  # [-] of the approach in the load of the contact, before two loads are known: of one Hertz contact
LEAST_APPROACH = 1e-9  # [-] of a contact from first touch, over its gap: less is rounding
# Change of ln(load) from which the power of the approach follows [-]: less may be rounding. Seven random runs take a
# counted work of 17 s, and 28 s with 1e-3, under which the load of a slow run changes in every trial.
LEAST_LOG_LOAD = 1e-5
MOST_TRIALS = 16  # number of film and contact solves in one step, at most
PLAIN_TRIALS = 4  # of them, after which two loads that enclose the balance are closed in
# Part of the distance of two loads that enclose the balance by which a trial stays away from each [-]. A choice: a
# larger value takes more trials where the gap jumps near the middle, a smaller one where it jumps near an end.
KEPT_AWAY = 0.25
# Travel of a spring of constant load over the mean gap [-]: its load changes by a thousandth of the relative change of
# the gap. A choice: it moves the trials alone.
LONG_TRAVEL = 1e3


@dataclass(frozen=True, kw_only=True)
class ContactStep:
    """The asperity contact in a step: its load [N], its state, the mean gap of first touch under the same film [m], and
    the power of the approach from there with which the load increases. ``is_jump``: the gap is between those of two
    contacts of nearly this load (`LoadBracket`)."""

    load: float
    state: ContactState
    touching_gap: float
    power: float = FIRST_POWER
    is_jump: bool = False

    @property
    def approach(self) -> float:
        """How much smaller than at first touch the mean gap is [m]."""
        return max(self.touching_gap - self.state.mean_gap, LEAST_APPROACH * self.touching_gap)

    def spring(self, mean_row: np.ndarray, load_unit: float) -> Spring | None:
        """Return the contact as a spring in the load balance of the film; None of separated surfaces."""
        if self.load == 0.0:
            return None
        return Spring(
            weights=mean_row,
            opening=film_under(self.touching_gap),
            mean=film_under(self.touching_gap - self.approach),
            load=self.load / load_unit,
            power=self.power,
        )

    def power_from(self, other: ContactStep) -> float:
        """Return the power with which the contact leads from ``other``, of the same step in time, to this one, if that
        is meaningful, else the one that was taken. Both approaches count from the first touch of this one: that of the
        other film is another one, and their difference is no compression."""
        log_load = math.log(self.load / other.load) if other.load else 0.0
        approach = max(self.touching_gap - other.state.mean_gap, LEAST_APPROACH * self.touching_gap)
        log_approach = math.log(self.approach / approach)
        if abs(log_load) < LEAST_LOG_LOAD or log_load * log_approach <= 0.0:
            return self.power
        return min(max(log_load / log_approach, 0.5 * self.power, 1.0), 2.0 * self.power)


def constant_spring(mean_row: np.ndarray, load: float, mean_gap: float) -> Spring:
    """Return a spring that carries about ``load`` (in the unit of the film's) at every film near ``mean_gap`` [m]."""
    mean = film_under(mean_gap)
    return Spring(weights=mean_row, opening=(1.0 + LONG_TRAVEL) * mean, mean=mean, load=load, power=1.0)


@dataclass
class LoadBracket:
    """Two contacts of one step whose loads enclose that of the balance: the gap of the ``lighter`` is wider than the
    closure demands, that of the ``heavier`` narrower (None: not found yet).

    Where a single cell yields, its load cannot grow, and the gap jumps until another cell touches: no load has the gaps
    between. There a secant leads from one side of the jump to the other and back.
    """

    lighter: ContactStep | None = None
    heavier: ContactStep | None = None

    def add(self, touch: ContactStep) -> None:
        """Take ``touch``, which replaces the end on its side."""
        if volume_residual(touch.state) > 0.0:
            self.lighter = touch
        else:
            self.heavier = touch

    @property
    def width(self) -> float:
        """How much more the heavier contact carries [N]; NaN without two ends in this order."""
        if self.lighter is None or self.heavier is None or self.lighter.load >= self.heavier.load:
            return math.nan
        return self.heavier.load - self.lighter.load

    def spring(self, mean_row: np.ndarray, load_unit: float) -> Spring | None:
        """Return the spring through two loads between the ends, at their gaps; None without two ends."""
        if self.lighter is None or self.heavier is None or math.isnan(self.width):
            return None
        (low, high) = (
            load / load_unit
            for load in (
                self.lighter.load + KEPT_AWAY * self.width,
                self.heavier.load - KEPT_AWAY * self.width,
            )
        )
        mean = film_under(self.heavier.state.mean_gap)
        travel = film_under(self.lighter.state.mean_gap) - mean
        if travel <= 0.0:
            return constant_spring(mean_row, 0.5 * (low + high), self.heavier.state.mean_gap)
        return Spring(weights=mean_row, opening=mean + travel * high / (high - low), mean=mean, load=high, power=1.0)

    def jump(self) -> ContactStep:
        """Return the contact between the two ends: the heavier one, with the gap that the closure demands."""
        assert self.heavier is not None
        state = with_gap_of_closure(self.heavier.state, self.heavier.state.mean_film)
        return replace(self.heavier, state=state, is_jump=True)


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

        A `Spring` represents the contact in the film's load balance. It ends at first touch: the surfaces separate
        where the contact has no load left, however small that was before. The contact is solved at the load of the
        spring, and its gap gives the next spring (a power of the approach from first touch), until the
        `volume_residual` is within the tolerance, or two loads that enclose the balance are, over the total load.
        """
        contact = self.contact_at(time)
        total = self.setting.line_history.load.before(time)
        touch = past
        bracket = LoadBracket()
        for number in range(MOST_TRIALS):
            spring = self._spring(contact.mean_row, touch, bracket, number, is_after_jump=past.is_jump, total=total)
            solution = self.setting.solve(time, memory, z, spring)
            if solution.status != CONVERGED:
                return solution
            load = solution.terms.spring[0] * self.setting.load_unit
            film = contact.to_patch @ solution.terms.H
            separated = contact.patch.close(film, 0.0)
            if load == 0.0 and film.min() <= 0.0:
                break
            if load == 0.0 and volume_residual(separated) <= self.tolerance:
                contact_step = replace(touch, load=0.0, state=separated, touching_gap=separated.mean_gap, is_jump=False)
                return replace(solution, payload=contact_step)
            tried = load or touch.load or FIRST_TOUCH * total
            state = contact.closed(film, tried, touch.state)
            if state is None:
                break
            solved = replace(touch, load=tried, state=state, touching_gap=separated.mean_gap, is_jump=False)
            touch = solved if touch is past else replace(solved, power=solved.power_from(touch))
            if load > 0.0 and abs(volume_residual(state)) <= self.tolerance:
                return replace(solution, payload=touch)
            bracket.add(touch)
            if load > 0.0 and bracket.width <= self.tolerance * total:
                return replace(solution, payload=bracket.jump())
            z = solution.z
        return replace(solution, status=ITERATION_LIMIT)

    def _spring(
        self,
        mean_row: np.ndarray,
        touch: ContactStep,
        bracket: LoadBracket,
        number: int,
        *,
        is_after_jump: bool,
        total: float,
    ) -> Spring | None:
        """Return the spring of trial ``number``, from the last contact ``touch``. After a step that ended in a jump of
        the gap, the first two trials are at its load and as far on the other side as `LoadBracket` may be wide."""
        unit = self.setting.load_unit
        if is_after_jump and number < 2:
            change = 0.5 * self.tolerance * total * number
            change = change if bracket.lighter is not None else -change
            return constant_spring(mean_row, (touch.load + change) / unit, touch.state.mean_gap)
        closing = bracket.spring(mean_row, unit) if number >= PLAIN_TRIALS else None
        return closing or touch.spring(mean_row, unit)
