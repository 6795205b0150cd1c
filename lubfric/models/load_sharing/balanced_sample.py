"""The balance of a sample of strips, corrected for its cells: what the load-sharing model solves."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self, cast

from scipy import fft

from ...contact import HalfSpaceContact, RoughContact, weighted_mean
from ...errors import LubfricError, WorkLimitError
from ...samples import Sample
from ...scene import Scene, budget
from ..contract import SampleSolution
from ..shared import (
    FEW_CONTACTS,
    SAMPLING_MATTERS,
    BalanceKey,
    CellEffectKey,
    Prepared,
    StandardError,
    add_errors,
    contact_on_joined_strips,
    contact_on_piece,
    has_too_few_contacts,
    numbers_of_fields,
    remembered,
    speed_of,
    strips_for_error,
)
from .balance import Balance, response_of, solve_balance
from .cell_effect import CellEffect, effect_of_cells, lost_summits
from .closure import open_gap, with_gap_of_closure
from .forces import forces_of
from .point import Point
from .response import Response, loads_at, with_contact_area_scaled
from .scatter import Scatter, scatter_of
from .undetected import hidden_contact, undetected_contact

# Change of ln(F_H/F_C) that cells may make and be corrected for to first order. A choice: a larger value corrects more
# to first order alone, a smaller one solves again.
MOST_CORRECTED_LOG_RATIO = 0.5

# Change of gap or film over the mean gap that is to first order, at most. A choice, as in `MOST_CORRECTED_LOG_RATIO`.
MOST_CORRECTED_GAP = 0.2

# Clearance [Sq] below which long cells may miss asperities. Half and twice this value change nothing on the points of
# `python -m verification.campaigns.constants`.
LARGE_CLEARANCE = 1.0

# Expected films of the total load over Sq at the speeds of reference points: contact, mixed, and about lift-off. A
# choice: more of them costs time, fewer are too far from the points.
REFERENCES = (0.05, 0.4, 1.6)

# Film of the total load [Sq] from which it clears the summits (4.5 Sq) whatever heat takes of it: a point there has no
# reference point. A choice. Half and twice this value change f by less than .01 % and the work by up to 11 % less
# (constants.csv).
CLEAR_OF_SUMMITS = 10.0

# Distance in ln F_C from a reference point up to which its effect of the cells may serve. A choice: a larger value
# saves solves, a smaller one errs less.
NEAR_LOAD = 0.25

# Slide-roll ratio of the reference point [-], whatever that of the point is. Film and contact depend on it little. A
# choice: one for all, so that contacts of all ratios share its points.
REFERENCE_RATIO = 0.1

# Change of f by the distance from the reference point, over the tolerance on f, up to which its effect of the cells
# serves [-]. A choice: a tenth of the tolerance. Half and twice this value change f by less than .01 % and the work by
# up to 7 % (constants.csv).
REFERENCED = 0.1


@dataclass(frozen=True, kw_only=True)
class BalancedSample(SampleSolution):
    """The first strips joined to one line, in balance, corrected for its cells, and what is known of its error.

    Attributes
    ----------
    prepared, sample, count, speed : as of `SampleSolution`
    raw_balance : as it was solved on ``rough_contact``
    corrected_balance : with the division of the load that native cells demand (`corrected`); before, the raw one
    rough_contact : on the first ``count`` strips of ``sample``
    scatter : from place to place
    effect : of the cells
    first_effect : of the cells, at the load at which it was found and from which ``effect`` follows; None: not found
        yet
    undetected : relative effect on f of contact that the sample may have missed by chance where it has none
    """

    prepared: Prepared
    sample: Sample
    count: int
    speed: float
    raw_balance: Balance
    corrected_balance: Balance
    rough_contact: RoughContact
    scatter: Scatter
    effect: CellEffect = CellEffect()
    first_effect: CellEffect | None = None
    undetected: float = 0.0

    @classmethod
    def solved(cls, prepared: Prepared, sample: Sample, count: int, speed: float, start: BalancedSample | None) -> Self:
        """Solve the first ``count`` strips of ``sample`` at ``speed`` [m/s], joined to one line with one film and one
        approach. ``start``: the solution of fewer of them. Raises `ConvergenceError`."""
        scene = prepared.scene
        rough_contact = contact_on_joined_strips(prepared, sample, count)
        begin = _reference(prepared, speed, sample) if start is None else start.start
        is_correctable = not sample.cells.is_native
        raw_balance = solve_balance(
            scene,
            speed,
            rough_contact,
            prepared.surface.sq,
            begin,
            is_correctable=is_correctable,
            starts_at_other_ratio=start is None,
        )
        balanced = cls(
            prepared=prepared,
            speed=speed,
            raw_balance=raw_balance,
            corrected_balance=raw_balance,
            rough_contact=rough_contact,
            scatter=Scatter(length=sample.line_length(count)),
            sample=sample,
            first_effect=None if start is None else start.first_effect,
            count=count,
        )
        on_cells = balanced.on_cells
        if on_cells is None:
            return replace(balanced, undetected=math.nan)
        if raw_balance.response is None:
            assert raw_balance.film is not None
            undetected = undetected_contact(
                scene,
                on_cells,
                film=raw_balance.film,
                forces=raw_balance.forces,
                correlation_length=sample.correlation_lengths[1],
                whole=sample.whole_map,
            )
            return replace(balanced, undetected=undetected)
        effect = balanced.first_effect
        if effect is None and raw_balance.film is not None:
            effect = _effect(prepared, balanced.point, raw_balance, sample)
        return replace(
            balanced,
            scatter=scatter_of(scene, on_cells, raw_balance, sample, count),
            effect=(effect or CellEffect()).at_load(raw_balance.contact_load),
            first_effect=effect,
        )

    @property
    def response(self) -> Response | None:
        """The response of the raw balance; None where nothing touches, or no film is."""
        return self.raw_balance.response

    @property
    def gap_scatter(self) -> StandardError:
        """Standard error of the mean gap [m] at given load: from place to place, and of the effect of the cells."""
        return add_errors(self.scatter.gap, self.effect.error)

    @property
    def sampling_error(self) -> StandardError:
        """The relative standard error of f because the sample is finite; NaN where it is not known."""
        freedom = self.friction_scatter.freedom if self.response is not None else 0
        return StandardError(self._sampling_error(), freedom)

    def _sampling_error(self) -> float:
        if self.raw_balance.film is None:
            return 0.0
        if self.response is None:
            return self.undetected
        of_gap = self.gap_scatter.value
        if not math.isfinite(of_gap):  # a contact without places, or of too few blocks
            return math.nan
        to_first_order = self.response.per_gap("coefficient") * of_gap
        beyond_first_order = self.response.relative("coefficient", of_gap) / to_first_order if to_first_order else 1.0
        return self.friction_scatter.value * beyond_first_order

    @property
    def friction_scatter(self) -> StandardError:
        """Relative standard error of f, to first order: from place to place, and of the effect of the cells."""
        cells = self.effect.error
        response = self.response
        per_gap = response.per_gap("coefficient") if response is not None else 0.0
        return add_errors(self.scatter.coefficient, StandardError(per_gap * cells.value, cells.freedom))

    @property
    def gap_change(self) -> float:
        """Change of the gap [m] for which f is corrected to first order: by the cells, and by what the root left. On
        the scene's own cells nothing is corrected, so that loads and fields belong together."""
        if self.sample.cells.is_native:
            return 0.0
        return self.effect.gap_change + self.left_by_root

    @property
    def left_by_root(self) -> float:
        """The gap [m] that the raw balance leaves open."""
        return open_gap(self.raw_balance.contact_state)

    @property
    def uncorrected_gap(self) -> float:
        """What that correction leaves open of the gap [m]: the correction times the change of ln(F_H/F_C) that it
        makes. No more was seen, but for one of 25 scenes (1.4 times that, beside a scatter of 17 %)."""
        return 0.0 if self.response is None else abs(self.response.log_load_ratio_per_gap) * self.gap_change**2

    def relative_change(self, gap_change: float) -> float:
        """Return the relative change of f by a ``gap_change`` [m] at given load."""
        return 0.0 if self.response is None else self.response.relative("coefficient", gap_change)

    @property
    def point(self) -> Point:
        """The point on this contact, with the settings of the balance."""
        assert self.raw_balance.settings is not None
        return Point(self.prepared.scene, self.speed, self.rough_contact, self.raw_balance.settings)

    @property
    def on_cells(self) -> HalfSpaceContact | None:
        """The contact, whose cells and places along y can be compared; None where it has none of them."""
        return cast(HalfSpaceContact, self.rough_contact) if self.sample.is_resolved else None

    @property
    def start(self) -> Balance | None:
        """The balance from which that of more strips starts; None where nothing touches."""
        if self.response is None:
            return None
        return replace(self.raw_balance, contact_state=replace(self.raw_balance.contact_state, fields=None))

    def required_strips(self) -> int:
        tolerance = self.prepared.scene.numerics.sampling_tolerance
        contacts = self.scatter.effective_contacts
        error = self.sampling_error
        has_too_few = self.response is not None and has_too_few_contacts(contacts, error.value, tolerance)
        at_least = 0.0
        if has_too_few:
            at_least = min(FEW_CONTACTS / contacts, (error.value / (SAMPLING_MATTERS * tolerance)) ** 2)
        count = strips_for_error(
            error,
            tolerance,
            count=self.count,
            first=self.sample.first_strips,
            available=self.sample.available_strips,
            at_least=at_least,
        )
        return count if count == self.count else min(self.sample.available_strips, fft.next_fast_len(count, real=True))

    def takes_more_strips_first(self) -> bool:
        """Return whether more strips are cheaper than shorter cells: where few asperity contacts carry load."""
        return (
            self.count == self.sample.first_strips
            and self.response is not None
            and self.scatter.effective_contacts < FEW_CONTACTS
        )

    def is_too_coarse(self) -> bool:
        """Return whether the cells change the division of the load or the gap by more than can be corrected, or f by
        more than is allowed beyond first order; where the film separates the surfaces, whether they cut off a summit
        that would touch, which takes a solve on native cells."""
        return self._is_too_coarse

    @cached_property
    def _is_too_coarse(self) -> bool:
        """The answer of `is_too_coarse`, made once."""
        response = self.response
        sample = self.sample
        scene = self.prepared.scene
        raw_balance = self.raw_balance
        if sample.cells.is_native or raw_balance.film is None:
            return False
        allowed = budget.CONTACT_GRID * scene.numerics.tolerance
        if response is not None:
            moved = abs(response.log_load_ratio_per_gap * self.gap_change)
            largest = max(abs(self.gap_change), abs(self.effect.film_change))
            if largest > MOST_CORRECTED_GAP * raw_balance.contact_state.mean_gap:
                return True
            by_contact = raw_balance.forces.boundary / max(raw_balance.forces.total, 1e-300)
            part = max(by_contact, raw_balance.contact_load / scene.bodies.load)  # of the friction, or of the load
            # with few contacts, of which more strips may follow, the load is known to a factor anyway
            may_have_few_contacts = (
                self.count < sample.available_strips and self.scatter.effective_contacts < FEW_CONTACTS
            )
            moves_little = may_have_few_contacts and part * math.expm1(min(moved, 30.0)) <= allowed
            if moved > MOST_CORRECTED_LOG_RATIO and not moves_little:
                return True
            return response.relative("coefficient", self.uncorrected_gap) > allowed
        clearance = -open_gap(raw_balance.contact_state)
        if self.count > sample.first_strips or clearance > LARGE_CLEARANCE * self.prepared.surface.sq:
            return False
        depth = lost_summits(self.prepared, self.point, raw_balance, sample) - clearance
        native = contact_on_piece(self.prepared, sample, 0, coarsening=(1, 1))
        return depth > 0 and hidden_contact(scene, native, raw_balance.forces, depth) > allowed

    def corrected(self) -> Self:
        """Return this sample with the load divided as on native cells and at the exact root (`gap_change`): film and
        friction are solved at that division, and areas scaled to its load."""
        raw_balance = self.raw_balance
        response = self.response
        scene = self.prepared.scene
        effect = self.effect
        if response is None or raw_balance.film is None or not self.gap_change:
            return self
        ratio = raw_balance.log_load_ratio + response.log_load_ratio_per_gap * self.gap_change
        loads = loads_at(scene.bodies.load, ratio)
        film = self.point.film(loads[0], raw_balance.film, raw_balance.film.cells)
        contact_state = raw_balance.contact_state
        area = contact_state.real_contact_area_fraction
        by_load = response.slopes.area_factor(loads[1] - raw_balance.contact_load, scene.bodies.width, area)
        plastic = max(contact_state.plastic_area_fraction + effect.plastic_change, 0.0)
        contact_state = replace(contact_state, plastic_area_fraction=plastic)
        contact_state = with_contact_area_scaled(contact_state, effect.area_factor * by_load)
        mean = weighted_mean(film.film_at(self.rough_contact.x), self.rough_contact.weight) + effect.film_change
        contact_state = with_gap_of_closure(contact_state, mean)
        corrected_balance = replace(
            raw_balance,
            film_load=loads[0],
            contact_load=loads[1],
            film=film,
            contact_state=contact_state,
            forces=forces_of(scene, film, contact_state, loads[1]),
        )
        return replace(self, corrected_balance=corrected_balance)


def _reference(prepared: Prepared, speed: float, sample: Sample) -> Balance | None:
    """Return a balance on the first strips to start from: that of the nearest of three fixed speeds (None where a given
    film arrives, at any speed, and where no contact is expected), at `REFERENCE_RATIO`. It depends on scene and cells
    alone, so that no result depends on which speeds were solved before; the points of a traction curve share it."""
    scene = prepared.scene
    sq = prepared.surface.sq
    if speed == 0 or not sample.represents_more or sq == 0 or scene.lubricant.inlet_film is not None:
        return None
    nearest = nearest_reference(scene.line_contact(speed).expected_film / sq)
    if nearest is None:
        return None

    typical = _at_reference_ratio(scene)

    def make() -> Balance | None:
        there = speed_of(typical, nearest * sq) * math.copysign(1.0, speed)
        try:
            return solve_balance(typical, there, contact_on_joined_strips(prepared, sample, sample.first_strips), sq)
        except WorkLimitError:  # not of that speed: a point with more work left solves it
            raise
        except LubfricError:
            return None

    key = BalanceKey(scene=typical, coarsening=sample.cells.coarsening, at=nearest, is_forward=speed > 0)
    balance = remembered(prepared, sample, key, make, _numbers_of_balance)
    return balance if balance is not None and balance.response is not None else None


def _numbers_of_balance(balance: Balance | None) -> int:
    """Return how many numbers the fields of a ``balance`` have."""
    return numbers_of_fields(None if balance is None else balance.contact_state.fields)


def _at_reference_ratio(scene: Scene) -> Scene:
    """Return ``scene`` without what a balance to start from need not know: its sliding and its speeds."""
    motion = replace(scene.motion, entrainment_speed=1.0, slide_roll_ratio=REFERENCE_RATIO, speeds=())
    return replace(scene, motion=motion, transient=None)


def nearest_reference(film: float) -> float | None:
    """Return the expected film [Sq] of the reference point that is nearest to the expected ``film`` [Sq] of a point;
    None where no contact is expected."""
    if film > CLEAR_OF_SUMMITS or film <= 0:
        return None
    return min(REFERENCES, key=lambda reference: abs(math.log(film / reference)))


def _effect(prepared: Prepared, point: Point, balance: Balance, sample: Sample) -> CellEffect:
    """Return the effect of the cells at ``balance``: that at the reference point, if the load on the contact is so near
    that the difference changes f little, else its own."""
    reference = _reference(prepared, point.speed, sample)
    response = balance.response
    if reference is not None and abs(math.log(balance.contact_load / reference.contact_load)) < NEAR_LOAD:
        assert response is not None and reference.film is not None and reference.settings is not None
        there = replace(point, speed=reference.film.entrainment_speed, settings=reference.settings)

        def make() -> CellEffect:
            at_ratio = replace(reference, response=response_of(there, reference))
            return effect_of_cells(prepared, there, at_ratio, sample)

        key = CellEffectKey(coarsening=sample.cells.coarsening, speed=there.speed)
        effect = remembered(prepared, sample, key, make)
        more = effect.at_load(balance.contact_load).remaining_change - effect.remaining_change
        if response.relative("coefficient", more) <= REFERENCED * prepared.scene.numerics.tolerance:
            return effect
    return effect_of_cells(prepared, point, balance, sample)
