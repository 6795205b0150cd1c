"""The quick model as a `lubfric.models.Model`: a few strips of the deterministic model on long cells, with the bias and
the error that solved cases give them.

It answers for ``numerics.model = "quick"``. The joined strips of the model "paper" answer in its place, with the
friction of Eq. (9), where the campaign has no such contacts. They are no control of the strips on long cells: on eight
random contacts at rest they took 70 % of the time, and the interval with them was as wide as without.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

from ...errors import ConvergenceError, TooManyCellsError
from ...samples import Sample
from ...scene import Scene, has_moving_roughness, moving_bodies, why_gap_not_resolved
from ...surface import Surface
from ..contract import Model, SampleSolution
from ..deterministic import expected_friction, work_of_fine_fields, work_on_long_cells
from ..load_sharing import (
    PaperModel,
    PaperSolution,
    expected_model_error,
    is_separated,
    methods_of_load_sharing,
)
from ..model_answer import ModelAnswer
from ..shared import (
    Assumption,
    ControlVariate,
    ExpectedViolations,
    Heat,
    Prepared,
    Violation,
    contact_on_joined_strips,
    expected_on_hertz,
    percent_beside,
    rolling_model_error,
    stated_sq,
    why_no_rough_film,
)
from ..work_estimate import NONE_TOUCHES, WorkEstimate
from .calibrated_error import error_model_of, error_models, out_of_range, reported, widening
from .long_cells import CELLS_OF_THIN_FILM, map_coarsening_at_rest, map_coarsening_in_motion
from .strips_on_long_cells import (
    LEAST_TOLERANCE,
    MOST_STRIPS,
    StripsOnLongCells,
    quick_answer_of,
    solve_on_long_cells,
)

# Strips at rest, about, of points whose first one has a small sampling error: one or two in 11 random points of
# `python -m verification.campaigns.estimates`.
USUAL_STRIPS = 1.5

# Expected standard error of f by one strip, over that which the first strips by load sharing leave times the root of
# their number, for which strips are solved [-]: about a fifth of the bounds by the cells. It follows from
# `SAMPLING_OVER_BOUNDS`.
EXPECTED_TARGET = 0.05

# Expected asperity load ratios between which moving roughness is expected on the cells of a thin film [-]: 12 of 13
# contacts between them in verification.campaigns.rolling_work are on these, and 4 of 19 others.
THIN_BY_SHARE = (0.06, 0.7)

# Cells along x in a correlation length that are expected of others [-], between those of both kinds: the work grows
# with the square of their number. A choice: it is at most 1.7 times too small, where they are on the cells of a thin
# film, and 1.3 times too large.
EXPECTED_CELLS = 2.3

# Expected bounds of f by long cells, relative, without film; their rise with the film over Sq; and the film over Sq up
# to which they rise [-]. Fitted to 30 points at rest, all but one within a factor of 1.4: three surfaces and oils at .003
# to 1 m/s. They move estimates alone.
BOUNDS_WITHOUT_FILM = 0.04
BOUNDS_BY_FILM = 0.13
FILM_OF_WIDEST_BOUNDS = 0.8

# Half-width of the bounds of f by long cells over f [-], at least about, where the film is as thick as in the solved
# cases with the thickest one: below it load sharing answers without long cells. Eight points of the scene "paper" had
# 0.05. A choice below that: less solves more points twice, more makes the interval wider where the answer changes from
# one model to the other.
LEAST_BOUNDS = 0.04

BY_LOAD_SHARING = "load-sharing model in place of the quick model"
ELASTIC = "elastic shear (lubricant.shear_modulus) is not calibrated: friction by Eq. (9)"
NOT_FLOODED = (
    "friction by Eq. (9), with the error of the load-sharing model: the quick model is calibrated for flooded "
    "contacts only"
)
THICK_FILM_NOTE = (
    "friction by Eq. (9): the film is thick and touches no asperity, so the error of the load-sharing model is smaller"
)
ONLY_HIGHER_ASPERITIES = (
    "the sampling error allows for higher asperities than those of the solved part; otherwise f does not depend on the "
    "sample"
)
STRIPS_NOT_SOLVED = (
    "friction by Eq. (9), with the error of the load-sharing model: the strips of the quick model were not solved ({})"
)


@dataclass(frozen=True, kw_only=True)
class QuickSolution(SampleSolution):
    """A few strips by the deterministic model on long cells, or the joined strips by load sharing in their place:
    `completed` solves what is missing.

    Attributes
    ----------
    paper_solution : the joined strips by load sharing; None: they are not solved
    on_long_cells : the strips on long cells, which answer; None: they are not solved
    why_by_equation : why load sharing answers in their place, with f of Eq. (9), as text; "": it does not
    """

    prepared: Prepared
    sample: Sample
    count: int
    speed: float
    paper_solution: PaperSolution | None = None
    on_long_cells: StripsOnLongCells | None = None
    why_by_equation: str = ""

    def required_strips(self) -> int:
        return self.count if self.paper_solution is None else self.paper_solution.required_strips()

    def is_too_coarse(self) -> bool:
        return self.paper_solution is not None and self.paper_solution.is_too_coarse()

    def takes_more_strips_first(self) -> bool:
        return self.paper_solution is not None and self.paper_solution.takes_more_strips_first()

    def corrected(self) -> QuickSolution:
        return self if self.paper_solution is None else replace(self, paper_solution=self.paper_solution.corrected())

    def heat(self) -> Heat | None:
        return None if self.paper_solution is None else self.paper_solution.heat()

    def violations(self) -> tuple[Violation, ...]:
        """Return those of the joined strips; the strips on long cells continue a patch that cuts these off."""
        known = () if self.paper_solution is None else self.paper_solution.violations()
        if self.on_long_cells is None:
            return known
        return tuple(violation for violation in known if violation.assumption != Assumption.CONTACT_ON_PATCH)

    def may_suffice(self) -> bool:
        return self.prepared.scene.numerics.model_tolerance >= LEAST_TOLERANCE

    def completed(self) -> QuickSolution:
        """Solve the strips on long cells; where they cannot answer, the joined strips by load sharing, if these are not
        solved."""
        return self._completed

    @cached_property
    def _completed(self) -> QuickSolution:
        if self.on_long_cells is not None or self.why_by_equation:
            return self
        of_thick_films = _error_of_thick_films(self.prepared.scene, self.prepared.surface.sq, self.speed)
        solution = self
        if of_thick_films > 0 and self.paper_solution is None and self._is_separated_at_first():
            solution = self._with_paper_solution()
        (with_strips, why_by_equation) = solution._with_strips(of_thick_films)
        if with_strips is not None:
            return with_strips
        return replace(solution._with_paper_solution(), why_by_equation=why_by_equation)

    def _with_strips(self, of_thick_films: float) -> tuple[QuickSolution | None, str]:
        """Return this solution with its strips on long cells and ""; where they cannot answer, None and why load
        sharing does, as text.

        ``of_thick_films``: least error of long cells under a film that is thicker than in all solved cases; 0: it is
        not.
        """
        is_thick = of_thick_films > 0 and self.paper_solution is not None
        if why := _why_not_calibrated(self.prepared.scene):
            return None, why
        if is_thick and self._is_separated_within(of_thick_films):
            return None, THICK_FILM_NOTE
        try:
            with_strips = replace(self, on_long_cells=solve_on_long_cells(self.prepared, self.speed))
        except (ConvergenceError, TooManyCellsError) as error:
            return None, STRIPS_NOT_SOLVED.format(error)
        error_of_strips = _mean_side(with_strips.answer())
        if is_thick and self._is_separated_within(error_of_strips):
            return None, THICK_FILM_NOTE
        return with_strips, ""

    def _with_paper_solution(self) -> QuickSolution:
        """Solve the joined strips by load sharing, if they are not solved: as many as the sampling error needs. The
        cells remain: `lubfric.estimate.solve_to_tolerance`, which would shorten them, is of a package that uses this
        one."""
        if self.paper_solution is not None:
            return self
        model = PaperModel()
        solution = model.solve(self.prepared, self.sample, self.count, self.speed)
        while (count := solution.required_strips()) > solution.count:
            solution = model.solve(self.prepared, self.sample, count, self.speed, start=solution)
        return replace(self, paper_solution=solution.corrected())

    def _is_separated_at_first(self) -> bool:
        """Return whether the full-load film separates the surfaces of these strips, so that load sharing may answer.
        Where asperities touch on them, they do on more strips."""
        rough_contact = contact_on_joined_strips(self.prepared, self.sample, self.count)
        try:
            return is_separated(self.prepared.scene, self.speed, rough_contact)
        except ConvergenceError:
            return False  # without a film of load sharing the strips on long cells answer

    def _is_separated_within(self, most: float) -> bool:
        """Return whether no asperity carries load by load sharing, with a relative model-form error of at most
        ``most``, in the mean of both sides."""
        assert self.paper_solution is not None
        answer = self.paper_solution.answer()
        return answer.numbers["contact_load"] == 0 and _mean_side(answer) <= most

    def why_sufficient(self) -> str:
        if self.on_long_cells is None or not self.may_suffice():
            return ""
        tolerance = self.prepared.scene.numerics.model_tolerance
        error = self.answer().errors.of_model_alone
        if error > tolerance:
            return ""
        (stated, target) = percent_beside(error, tolerance)
        return f"its model-form error, {stated}, is within numerics.model_tolerance, {target}"

    def answer(self) -> ModelAnswer:
        return self._answer

    @cached_property
    def _answer(self) -> ModelAnswer:
        """The answer, which is made once: `why_sufficient` takes its error."""
        solution = self.completed()
        if solution.on_long_cells is not None:
            return quick_answer_of(solution.prepared, solution.speed, solution.on_long_cells)
        assert solution.paper_solution is not None
        answer = solution.paper_solution.answer()
        decision = replace(answer.decision, basis=BY_LOAD_SHARING)
        notes = [*answer.errors.notes, solution.why_by_equation]
        is_sampling_known = math.isfinite(answer.errors.sampling_error.value)
        if answer.numbers["contact_load"] == 0 and is_sampling_known:
            notes.append(ONLY_HIGHER_ASPERITIES)
        errors = replace(answer.errors, notes=tuple(notes))
        return replace(answer, decision=decision, errors=errors)


def expected_coarsening(scene: Scene, sample: Sample, sq: float, speed: float) -> tuple[float, float]:
    """Return the length of the long cells in those of ``sample`` that is expected for roughness of ``sq`` [m]
    at ``speed`` [m/s]: where it moves, those of a thin film if asperities are expected to carry a part of the load
    (`THIN_BY_SHARE`)."""
    (dx, dy) = sample.cells.spacing
    lengths = sample.lengths_by_slopes
    if has_moving_roughness(scene):
        (least, most) = THIN_BY_SHARE
        is_thin = least <= expected_friction(scene, sq, speed).share <= most
        return map_coarsening_in_motion(
            scene,
            spacing=(dx, dy),
            rows=sample.rows,
            lengths=lengths,
            per_length=CELLS_OF_THIN_FILM if is_thin else EXPECTED_CELLS,
        )
    (fx, fy) = sample.refinement  # of a patch, whose strips are solved on the cells of its map
    (along, across) = map_coarsening_at_rest(scene, spacing=(dx / fx, dy / fy), rows=sample.rows * fy, lengths=lengths)
    return along / fx, across / fy


def _expected_strips(sample: Sample, alone: WorkEstimate) -> float:
    """Return the expected number of strips at rest on long cells, by the sampling error of the joined strips of
    ``sample`` by load sharing ``alone``."""
    if not sample.represents_more:
        return 1.0  # all there is
    of_one = alone.expected_sampling_error * math.sqrt(sample.first_strips)
    return float(min(max((of_one / EXPECTED_TARGET) ** 2, USUAL_STRIPS), MOST_STRIPS))


def _mean_side(answer: ModelAnswer) -> float:
    """Return the relative model-form error of an ``answer``, the mean of both sides: half the width of its interval."""
    return 0.5 * sum(answer.errors.model_error)


def _error_of_thick_films(scene: Scene, sq: float, speed: float) -> float:
    """Return the error of f, relative, that the bounds of long cells have at least where the film over ``sq`` [m] at
    ``speed`` [m/s] is thicker than in all solved cases, by how far they are widened; 0 where it is not. In pure rolling
    all of f is the rolling part (`StripsOnLongCells.bounds`)."""
    if not (speed and sq):
        return 0.0
    error_model = error_model_of(scene)
    times = scene.line_contact(abs(speed)).moes_film / (error_model.range["moes_ratio"][1] * sq)
    is_rolling = scene.motion.slide_roll_ratio == 0
    least = error_model.rolling_error(1.0, 0.0) if is_rolling else LEAST_BOUNDS
    return least * widening([math.log(times)]) if times > 1 else 0.0


class QuickModel(Model):
    """Strips on long cells with a calibrated error; the balance of Eq. (8) where the calibration has no such
    contacts."""

    @property
    def takes_wear(self) -> bool:
        return True

    @property
    def name(self) -> str:
        return "quick"

    @property
    def summary(self) -> str:
        cases = {kind: model.cases for kind, model in error_models().items()}
        return (
            "the deterministic model of film and asperity contact on long cells, with a bias and errors calibrated on "
            f"{cases['rest']} solved cases of roughness at rest and {cases['rolling']} of moving roughness"
        )

    @property
    def takes_boundary_film(self) -> bool:
        return True

    @property
    def includes_motion(self) -> bool:
        return True  # roughness that moves, moves on the long cells as well

    def described(self, scene: Scene) -> str:
        if why := _why_not_calibrated(scene):
            return f"{BY_LOAD_SHARING} (numerics.model); {why}"
        in_place = f"{BY_LOAD_SHARING} (numerics.model)"
        if why := why_gap_not_resolved(scene):
            return f"{in_place}: {why}; its model-form error is not known and not in the interval"
        if not moving_bodies(scene):
            return f"{in_place}: the surfaces are smooth"
        strips = "one strip" if has_moving_roughness(scene) else f"one to {MOST_STRIPS} strips"
        return (
            f"quick model (numerics.model): the deterministic model on {strips} with cells longer than usual (long "
            "cells), and an error calibrated on solved cases"
        )

    def described_in_auto(self, scene: Scene, where: str, *, is_everywhere: bool) -> str:
        return (
            "quick model (the deterministic model on long cells, its error calibrated on solved cases); on its usual "
            "cells the deterministic model would take too long"
        )

    def expected_violations(self, scene: Scene, speeds: list[float]) -> ExpectedViolations:
        if _why_not_calibrated(scene):  # load sharing answers, without long cells
            return expected_on_hertz(scene)
        known = error_model_of(scene).range
        at_all = out_of_range(scene, None, 0.0, known)
        expected: list[tuple[float | None, Violation]] = [(None, part.violation_in(scene)) for part in reported(at_all)]
        for speed in speeds:
            sq = stated_sq(scene)
            if not _is_thick_film_expected(scene, sq, speed):  # else load sharing answers, without long cells
                outside = out_of_range(scene, sq, speed, known)
                expected += [(speed, part.violation_in(scene)) for part in reported(outside) if part not in at_all]
        return (*expected_on_hertz(scene), *expected)

    def estimate_work(
        self, scene: Scene, sample: Sample, surface: Surface, speed: float, cheaper: WorkEstimate | None
    ) -> WorkEstimate:
        """Return what a point takes on long cells, and on joined strips by load sharing where these may answer as well;
        no work where another model answers in its place."""
        alone = cheaper or PaperModel().estimate_work(scene, sample, surface, speed, None)
        if why_gap_not_resolved(scene):
            return replace(alone, seconds=0.0, has_answer=False, shared=())
        is_named = scene.numerics.model == self.name
        if alone.asperities == NONE_TOUCHES and alone.expected_model_error <= _error_of_thick_films(
            scene, surface.sq, speed
        ):
            return replace(alone, seconds=alone.seconds if is_named else 0.0, has_answer=is_named)
        is_shared = is_named and _may_answer_by_equation(scene, surface.sq, speed)
        seconds = alone.seconds if is_shared else 0.0
        has_rough_film = speed != 0 and surface.sq != 0 and sample.is_resolved
        solves_strips = has_rough_film and not _why_not_calibrated(scene) and scene.transient is None
        if solves_strips:
            count = 1.0 if has_moving_roughness(scene) else _expected_strips(sample, alone)
            seconds += work_on_long_cells(
                scene,
                sample,
                surface,
                speed,
                sample_coarsening=expected_coarsening(scene, sample, surface.sq, speed),
                count=count,
            )
        is_passed_over = scene.numerics.model_tolerance < LEAST_TOLERANCE
        may_suffice = solves_strips and not is_passed_over
        alone = replace(
            alone,
            has_answer=is_shared or solves_strips,
            ends_seconds=0.0 if solves_strips else alone.ends_seconds,
            waits_for_next=is_passed_over,
            expected_model_error=_expected_bounds(scene, surface.sq, speed) if may_suffice else math.inf,
        )
        if has_moving_roughness(scene):
            return replace(alone, strips=1, length=sample.line_length(1), seconds=seconds, shared=())
        (along, across) = expected_coarsening(scene, sample, surface.sq, speed)
        (fx, fy) = sample.cells.coarsening
        solved = round(along * fx), round(across * fy)
        fine_fields = work_of_fine_fields(scene, sample, surface.sq, speed, solved) if seconds else 0.0
        shared = alone.shared if is_shared else ()
        return replace(alone, seconds=seconds, fine_fields_seconds=fine_fields, shared=shared)

    def methods(self, prepared: Prepared, *, has_contact: bool, has_film: bool) -> tuple[str, ...]:
        of_film = ("kept mass",) if has_film else ()
        of_sharing = methods_of_load_sharing(prepared, has_contact=has_contact, has_film=has_film)
        return ("deterministic model", *of_film, *of_sharing)

    def rolling_error(self, lambda_ratio: float, film_growth: float) -> float:
        return rolling_model_error(lambda_ratio)

    def why_unable(self, prepared: Prepared, speed: float) -> str:
        if why := why_no_rough_film(prepared, speed):
            return why
        scene = prepared.scene
        return why_gap_not_resolved(scene, has_one_map_for_all_bodies=prepared.has_one_map_for_all_bodies)

    def adopt(self, cheaper: SampleSolution) -> QuickSolution | None:
        return _with_known(cheaper) if isinstance(cheaper, PaperSolution) else None

    def solve(
        self,
        prepared: Prepared,
        sample: Sample,
        count: int,
        speed: float,
        *,
        start: SampleSolution | None = None,
        control: ControlVariate | None = None,
    ) -> QuickSolution:
        """Solve the joined strips by load sharing where that may answer; `QuickSolution.completed` does the rest."""
        if not _may_answer_by_equation(prepared.scene, prepared.surface.sq, speed):
            return QuickSolution(prepared=prepared, sample=sample, count=count, speed=speed)
        begin = start.paper_solution if isinstance(start, QuickSolution) else None
        return _with_known(PaperModel().solve(prepared, sample, count, speed, start=begin))


def _why_not_calibrated(scene: Scene) -> str:
    """Return why the campaign has no contacts like ``scene``, as text; "" if it has."""
    if scene.lubricant.shear_modulus is not None:
        return ELASTIC
    return "" if scene.lubricant.floods else NOT_FLOODED


def _may_answer_by_equation(scene: Scene, sq: float, speed: float) -> bool:
    """Return whether the joined strips by load sharing may answer at ``speed`` [m/s], because the campaign has no such
    contacts or because the film over ``sq`` [m] is thick; under a thick film whose roughness moves they are solved only
    when they have to."""
    if _why_not_calibrated(scene):
        return True
    return not has_moving_roughness(scene) and _error_of_thick_films(scene, sq, speed) > 0


def _is_thick_film_expected(scene: Scene, sq: float | None, speed: float) -> bool:
    """Return whether the film that is expected at ``speed`` [m/s] over ``sq`` [m] (None: not known) is so thick that
    load sharing answers."""
    if not (sq and speed):
        return False
    film = scene.line_contact(abs(speed)).expected_film
    return 0 < expected_model_error(scene, film, sq, abs(speed)) <= _error_of_thick_films(scene, sq, speed)


def _expected_bounds(scene: Scene, sq: float, speed: float) -> float:
    """Return the expected half-width of the bounds of f by long cells over ``sq`` [m] at ``speed`` [m/s], relative."""
    ratio = min(scene.line_contact(abs(speed)).expected_film / sq, FILM_OF_WIDEST_BOUNDS)
    outside = out_of_range(scene, sq, speed, error_model_of(scene).range)
    return (BOUNDS_WITHOUT_FILM + BOUNDS_BY_FILM * ratio) * widening(part.distance for part in outside)


def _with_known(paper_solution: PaperSolution) -> QuickSolution:
    """Return the solution of the quick model where a ``paper_solution`` is known, and nothing else is solved."""
    return QuickSolution(
        prepared=paper_solution.prepared,
        sample=paper_solution.sample,
        count=paper_solution.count,
        speed=paper_solution.speed,
        paper_solution=paper_solution,
    )
