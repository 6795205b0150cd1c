"""Friction of an endless rough line to a given standard error: a first sample of strips, then more of them, then the
effect of their cells."""

import math
from dataclasses import dataclass, replace

from scipy import fft

from ...contact import (
    RoughContact,
    weighted_mean,
)
from ...errors import LubfricError
from ...samples import Sample
from ...scene import budget
from ..shared import (
    FEW,
    MATTERS,
    BlockError,
    Prepared,
    ReferenceKey,
    add_errors,
    contact_on,
    on_piece,
    on_stack,
    required_strips,
    speed_of,
    too_few,
)
from .balance import (
    Balance,
    solve_balance,
)
from .cell_effect import (
    CellEffect,
    effect_of_cells,
    lost_summits,
)
from .forces import (
    forces,
)
from .point import (
    Point,
)
from .response import (
    Response,
    loads_at,
    with_contact_area_scaled,
)
from .scatter import (
    Scatter,
    scatter_of,
)
from .undetected import (
    hidden_contact,
    undetected_contact,
)

# times the length that a standard error asks for; times the length so far, at least
FARTHEST = 0.5  # of ln(F_H/F_C), by which what the cells change may be corrected
LARGEST = 0.2  # of the mean gap: a change of gap or film beyond it is not to first order
CLOSE = 1.0  # Sq: clearance below which summits may be lost to the cells
REFERENCES = (0.05, 0.4, 1.6)  # expected film of the whole load over Sq, at the speeds of reference points
NEAR_LOAD = 0.25  # of ln F_C, from a reference point whose cells serve as one's own,
REFERENCED = 0.1  # if they leave no more than that of the tolerance on f


@dataclass(frozen=True)
class SampleSolution:
    """The balance of a sample, corrected for its cells, and what is known of its error.

    - ``balance``: with the division of the load that the scene's own cells demand; ``solved``: as it was solved on
      ``contact``, the first ``count`` strips of ``sample``.
    - ``effect``: of the cells; ``scatter``: from place to place; ``missed``: contact that the sample may have missed by
      chance where none was found: its relative effect on f.
    """

    balance: Balance
    solved: Balance
    contact: RoughContact
    scatter: Scatter
    sample: Sample
    effect: CellEffect = CellEffect()
    count: int = 1
    undetected: float = 0.0

    @property
    def response(self) -> Response | None:
        """Of the balance as it was solved."""
        return self.solved.response

    @property
    def gap_error(self) -> BlockError:
        """Standard error of the mean gap [m] at given load: from place to place, and of the effect of the cells."""
        return add_errors(self.scatter.gap, self.effect.error)

    @property
    def sampling(self) -> float:
        """Relative standard error of f because the sample is finite."""
        if self.solved.film is None:
            return 0.0
        if self.response is None:
            return self.undetected
        whole = self.response.relative("coefficient", self.gap_error.error)
        to_first_order = self.response.per_gap("coefficient") * self.gap_error.error
        return self.friction_error.error * (whole / to_first_order if to_first_order else 1.0)

    @property
    def friction_error(self) -> BlockError:
        """Relative standard error of f, to first order: from place to place, and of the effect of the cells."""
        cells = self.effect.error
        response = self.response
        per_gap = response.per_gap("coefficient") if response is not None else 0.0
        return add_errors(self.scatter.friction, BlockError(per_gap * cells.error, cells.freedom))

    @property
    def corrected(self) -> float:
        """Change of the gap [m] for which f is corrected to first order: by the cells, and by what the root left. On
        the scene's own cells nothing is corrected, so that loads and fields belong together."""
        if self.sample.cells.is_native:
            return 0.0
        return self.effect.gap + self.left_by_root

    @property
    def left_by_root(self) -> float:
        """Mean gap less mean film [m], as the balance was solved."""
        return self.solved.contact.mean_gap - self.solved.contact.mean_film

    @property
    def second_order(self) -> float:
        """What that correction leaves open of the gap [m]: the correction times the change of ln(F_H/F_C) that it
        makes. No more was seen, but for one of 25 scenes (1.4 times that, beside a scatter of 17 %)."""
        return 0.0 if self.response is None else abs(self.response.log_load_ratio_per_gap) * self.corrected**2

    def change(self, name: str) -> float:
        """Relative change of f by the gap [m] that the `CellEffect` has under ``name``."""
        return 0.0 if self.response is None else self.response.relative("coefficient", getattr(self.effect, name))


def sampled(prepared: Prepared, speed: float, *, own_cells: bool = False) -> SampleSolution:
    """Solve ``prepared`` at ``speed`` [m/s]: on more strips until the standard error of f is within
    ``numerics.sampling_tolerance``, on cells so fine that their effect can be corrected for. ``own_cells``: on those of
    the scene, where one patch is all that there is. Raises `ConvergenceError`."""
    sample = prepared.sample
    if own_cells and sample.is_single_patch:
        sample = sample.native()
    while True:
        found = _on_cells(prepared, speed, sample)
        if sample.cells.is_native or not _too_coarse(prepared, speed, found):
            return _corrected(prepared, speed, found)
        sample = sample.halved()


def _on_cells(prepared: Prepared, speed: float, sample: Sample) -> SampleSolution:
    scene = prepared.scene
    count = sample.first
    start = _reference(prepared, speed, sample)
    effect: CellEffect | None = None
    while True:
        contact = contact_on(prepared, sample, count)
        coarse = not sample.cells.is_native
        solved = solve_balance(scene, speed, contact, prepared.surface.sq, start, correctable=coarse)
        line = Scatter(sample.rows_of(count) * sample.cells.coarse[1])
        found = SampleSolution(solved, solved, contact, line, sample=sample, count=count)
        if not sample.is_resolved:  # it has no places along y to compare, and no cells to correct for
            return replace(found, undetected=math.nan)
        if solved.response is None:
            missed = undetected_contact(scene, contact, solved.film, solved.forces, sample.lengths[1])
            found = replace(found, undetected=missed)
        else:
            scatter = scatter_of(scene, on_stack(prepared, sample, count), solved, sample, count)
            if effect is None and solved.film is not None:
                effect = _effect(prepared, _point(prepared, speed, found), solved, sample)
            found = replace(found, scatter=scatter, effect=(effect or CellEffect()).at_load(solved.contact_load))
        more = _wanted(prepared, found, sample)
        grazing = count == sample.first and solved.response is not None and found.scatter.spots < FEW
        if more <= count or (not grazing and _too_coarse(prepared, speed, found)):
            return found  # where few spots graze each other, more strips are cheaper than shorter cells
        start = None if solved.response is None else replace(solved, contact=replace(solved.contact, fields=None))
        count = more


def _reference(prepared: Prepared, speed: float, sample: Sample) -> Balance | None:
    """A balance on the first strips to start from: that of the nearest of three fixed speeds (None where a given film
    arrives, at any speed). It depends on scene and cells alone, so that no result depends on which speeds were solved
    before."""
    scene = prepared.scene
    sq = prepared.surface.sq
    if speed == 0 or sample.is_single_patch or sq == 0 or scene.lubricant.inlet_film is not None:
        return None
    film = scene.line_contact(speed).expected_film / sq
    nearest = min(REFERENCES, key=lambda reference: abs(math.log(film / reference)))

    def make() -> Balance | None:
        there = speed_of(scene, nearest * sq) * math.copysign(1.0, speed)
        try:
            return solve_balance(scene, there, on_stack(prepared, sample, sample.first), sq)
        except LubfricError:
            return None

    found = prepared.memo.get(ReferenceKey(sample.cells.coarsening, "balance", nearest, speed > 0), make)
    return found if found is not None and found.response is not None else None


def _effect(prepared: Prepared, point: Point, balance: Balance, sample: Sample) -> CellEffect:
    """The effect of the cells at ``balance``: that at the reference point, if the load on the contact is so near that
    the difference hardly moves f, else its own."""
    reference = _reference(prepared, point.speed, sample)
    response = balance.response
    if reference is not None and abs(math.log(balance.contact_load / reference.contact_load)) < NEAR_LOAD:
        assert response is not None and reference.film is not None and reference.settings is not None
        there = replace(point, speed=reference.film.entrainment_speed, settings=reference.settings)

        def make() -> CellEffect:
            return effect_of_cells(prepared, there, reference, sample)

        found = prepared.memo.get(
            ReferenceKey(sample.cells.coarsening, "effect of cells", there.speed, there.speed > 0), make
        )
        more = found.at_load(balance.contact_load).remaining_change - found.remaining_change
        if response.relative("coefficient", more) <= REFERENCED * prepared.scene.numerics.tolerance:
            return found
    return effect_of_cells(prepared, point, balance, sample)


def _wanted(prepared: Prepared, found: SampleSolution, sample: Sample) -> int:
    """Number of strips that ``numerics.sampling_tolerance`` needs, at least as many as there are."""
    asked = prepared.scene.numerics.sampling_tolerance
    spots = found.scatter.spots
    touching = found.response is not None
    few = touching and too_few(spots, found.sampling, asked)
    enough = min(FEW / spots, (found.sampling / (MATTERS * asked)) ** 2) if few else 0.0
    error = BlockError(found.sampling, found.friction_error.freedom if touching else 0)
    more = required_strips(found.count, sample.first, sample.available, error, asked, enough)
    return more if more == found.count else min(sample.available, fft.next_fast_len(more, real=True))  # 90, not 89


def _too_coarse(prepared: Prepared, speed: float, found: SampleSolution) -> bool:
    """Whether the cells change the division of the load or the gap by more than can be corrected, or f by more than is
    allowed beyond first order; where the film clears the summits, whether the cells cut off a summit that would
    touch."""
    response = found.response
    sample = found.sample
    scene = prepared.scene
    if sample.cells.is_native or found.solved.film is None:
        return False
    allowed = budget.CONTACT_GRID * scene.numerics.tolerance
    if response is not None:
        moved = abs(response.log_load_ratio_per_gap * found.corrected)
        if max(abs(found.corrected), abs(found.effect.film)) > LARGEST * found.solved.contact.mean_gap:
            return True
        there = found.solved.forces
        load = found.solved.contact_load
        spots = max(there.boundary / max(there.total, 1e-300), load / scene.bodies.load)  # of friction, or of the load
        if found.count == sample.available or found.scatter.spots >= FEW:  # else it is known to a factor anyway
            spots = math.inf
        if moved > FARTHEST and spots * math.expm1(min(moved, 30.0)) > allowed:
            return True
        return response.relative("coefficient", found.second_order) > allowed
    clearance = found.solved.contact.mean_film - found.solved.contact.mean_gap
    if found.count > sample.first or clearance > CLOSE * prepared.surface.sq:
        return False
    depth = lost_summits(prepared, _point(prepared, speed, found), found.solved, sample) - clearance
    own = on_piece(prepared, sample, 0, (1, 1))
    return depth > 0 and hidden_contact(scene, own, found.solved.forces, depth) > allowed


def _point(prepared: Prepared, speed: float, found: SampleSolution) -> Point:
    assert found.solved.settings is not None
    return Point(prepared.scene, speed, found.contact, found.solved.settings)


def _corrected(prepared: Prepared, speed: float, found: SampleSolution) -> SampleSolution:
    """``found`` with the load divided as its own cells and the end of the root demand: film and friction are those of
    that division, areas follow its load."""
    solved = found.solved
    response = found.response
    scene = prepared.scene
    effect = found.effect
    if response is None or solved.film is None or not found.corrected:
        return found
    loads = loads_at(scene.bodies.load, solved.log_load_ratio + response.log_load_ratio_per_gap * found.corrected)
    film = _point(prepared, speed, found).film(loads[0], solved.film, solved.film.cells)
    state = solved.contact
    area = solved.contact.real_contact_area_fraction
    by_load = response.slopes.area_factor(loads[1] - solved.contact_load, scene.bodies.width, area)
    plastic = max(state.plastic_area_fraction + effect.plastic, 0.0)
    state = with_contact_area_scaled(replace(state, plastic_area_fraction=plastic), effect.area * by_load)
    mean = weighted_mean(film.film_at(found.contact.x), found.contact.weight) + effect.film
    state = replace(state, mean_gap=mean, mean_film=mean)
    there = forces(scene, film, state, loads[1])
    balance = replace(solved, film_load=loads[0], contact_load=loads[1], film=film, contact=state, forces=there)
    return replace(found, balance=balance)
