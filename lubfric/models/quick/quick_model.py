"""The quick answer as a `lubfric.models.Model`: a few strips of the deterministic model on long cells, with the bias and
the error that solved cases give them.

It answers for ``numerics.model = "quick"``. The balance of Eq. (8) on the line answers in its place, with the friction
of Eq. (9), where the campaign has no such contacts. It is no control of the strips: on eight random contacts at rest it
took 70 % of the time, and the interval with it was as wide as that of the strips alone.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..._base import work_left
from ...errors import ConvergenceError
from ...samples import Sample
from ...scene import Scene, has_moving_roughness, why_gap_not_resolved
from ...surface import Surface
from ..contract import Model, ModelAnswer, SampleSolution, WorkEstimate
from ..deterministic import (
    LARGEST_PART,
    CellsInMotion,
    Levels,
    StripOnTwoGrids,
    bodies_of,
    film_ratio_of,
    levels_of,
    sample_target,
    sliding_share_of,
    strip_surface,
    two_levels,
    work_of_fine_fields,
    work_on_strips,
)
from ..deterministic import answer_of as deterministic_answer
from ..load_sharing import PaperModel, PaperSolution, expected_model_error, methods_of_load_sharing
from ..shared import (
    MODEL_ERROR,
    ControlVariate,
    ExpectedViolations,
    Heat,
    Prepared,
    StandardError,
    Violation,
    expected_on_hertz,
    percent_beside,
    rolling_model_error,
    smooth_over_cells,
    violations_by_model_error,
    why_no_rough_film,
)
from .calibrated_error import ErrorModel, Outside, error_model_of, out_of_range, reported, widening
from .long_strips import (
    CELLS_OF_REFERENCES,
    CELLS_OF_THIN_FILM,
    features,
    long_cells_in_motion,
    map_coarsening_at_rest,
    map_coarsening_in_motion,
    numbers_of_strip,
    solve_at_rest,
    solve_moving,
)

# Strips at rest, at most: each adds .2 s.
MOST_STRIPS = 4

# The same, about, on which an estimate of the work rests.
EXPECTED_STRIPS = 2

# Standard error of f by the sample that strips are solved for, relative, at least: a smaller one takes more time than the
# error by the cells is worth.
LEAST_SAMPLING_ERROR = 0.03

# The same, over the half-width of the bounds of f by the cells: with Student's t it widens the interval by a tenth.
OF_BOUNDS = 0.2

# The same on cells for thin films, where a moment takes twice as long and the bounds are half as wide: by four tenths.
OF_NARROW_BOUNDS = 0.4

# Part of the work that a point has left, which one more strip may take [-]: the rest is for the ends of input ranges.
PART_OF_WORK = 0.25

# numerics.model_tolerance below which "auto" does not try this model: the bounds are those of kinds of contacts, and a
# point would be solved twice for the few whose bounds are narrower.
LEAST_TOLERANCE = 0.1

# Part of f_b by which the stress of asperities exceeds that of the film, at least, where a bias of f is one of the
# asperity load. Where both are alike, it is one of the film.
LEAST_CONTRAST = 0.05

ELASTIC = "elastic shear (lubricant.shear_modulus) is not calibrated: friction by Eq. (9)"
NOT_FLOODED = (
    "f of Eq. (9) with the error of load sharing: the campaign behind the calibration has flooded contacts only"
)
THICK_FILM_NOTE = "f of Eq. (9): the film is thick and touches no asperity, where the error of load sharing is small"
STRIPS_NOT_SOLVED = "f of Eq. (9) with the error of load sharing: the strips on long cells were not solved ({})"
NARROWER = "numerics.model = 'deterministic' reduces the error of f, at the cost that `lubfric info` estimates"
NARROWED_BY_DETERMINISTIC = "take numerics.model = 'deterministic', which narrows it"
OF_CELLS = "the error of long cells, calibrated on {} contacts: numerics.model = 'deterministic' reduces it"


@dataclass(frozen=True, kw_only=True)
class LongStrips:
    """The strips on long cells.

    Attributes
    ----------
    levels : their estimate
    model : the error model of such contacts
    bias : of ln of the sliding part of f
    log_half_width : of the 95 % interval of the same
    widening : factor on the bounds outside of the range of the solved cases
    outside : what is outside of it
    """

    levels: Levels
    model: ErrorModel
    bias: float
    log_half_width: float
    widening: float
    outside: tuple[Outside, ...]

    def numbers(self, scene: Scene) -> dict[str, float]:
        """Return the numbers of the strips without their bias, which is one of the sliding part of f.

        The bias of f is one of the asperity load, with f_b on asperities and the mean stress of the film beside it as
        they are. What f has beyond that, because asperities carry none or all of the load, or have the stress of the
        film, remains in the shear of the film. So the forces add up to f.
        """
        numbers = self.levels.numbers
        if scene.motion.slide_roll_ratio == 0:
            return numbers
        load = scene.bodies.load
        rolling = numbers["rolling_force"]
        force = rolling + (load * numbers["coefficient"] - rolling) * math.exp(self.bias)
        rubs = scene.bodies.boundary_friction_coefficient
        share = numbers["contact_load"] / load
        contrast = rubs - (numbers["couette_force"] / numbers["film_load"] if numbers["film_load"] > 0 else rubs)
        new_share = share
        if contrast > LEAST_CONTRAST * rubs:
            new_share = min(max(share + (force / load - numbers["coefficient"]) / contrast, 0.0), 1.0)
        boundary = numbers["boundary_force"] * (new_share / share if share > 0 else 0.0)
        boundary += rubs * new_share * load * (share == 0)
        times = new_share / share if share > 0 else 0.0
        of_films = times if scene.lubricant.newtonian else (1 - new_share) / (1 - share) if share < 1 else 0.0
        return numbers | {
            "coefficient": force / load,
            "contact_load": new_share * load,
            "film_load": (1 - new_share) * load,
            "boundary_film_load": numbers["boundary_film_load"] * times if share > 0 else new_share * load,
            "saturated_film_load": numbers["saturated_film_load"] * of_films,
            "boundary_force": boundary,
            "shear_force": force - boundary,
            "couette_force": force - boundary - rolling,
        }

    def bounds(self, scene: Scene) -> tuple[float, float]:
        """Return the 95 % bounds of f by the cells, relative, below and above. In pure rolling all of f is the rolling
        part."""
        numbers = self.numbers(scene)
        f = numbers["coefficient"]
        rolling = f if scene.motion.slide_roll_ratio == 0 else numbers["rolling_force"] / scene.bodies.load
        sliding = abs(f - rolling)
        if f == 0:
            return math.inf, math.inf
        of_rolling = self.widening * self.model.rolling_error(rolling, sliding)
        down, up = (sliding * abs(math.expm1(side * self.log_half_width)) for side in (-1, 1))
        return math.hypot(down, of_rolling) / abs(f), math.hypot(up, of_rolling) / abs(f)


@dataclass(frozen=True, kw_only=True)
class QuickSolution(SampleSolution):
    """A few strips by the deterministic model on long cells, which are solved when they are needed.

    ``known_paper_solution``: the line by load sharing, where it is solved.
    """

    prepared: Prepared
    sample: Sample
    count: int
    speed: float
    known_paper_solution: PaperSolution | None = None

    @cached_property
    def paper_solution(self) -> PaperSolution:
        """The line by load sharing."""
        return (
            self.known_paper_solution
            or PaperModel().solve(self.prepared, self.sample, self.count, self.speed).corrected()
        )

    @property
    def sampling_error(self) -> StandardError:
        return StandardError(0.0, 1) if self.known_paper_solution is None else self.known_paper_solution.sampling_error

    def required_strips(self) -> int:
        return self.count if self.known_paper_solution is None else self.known_paper_solution.required_strips()

    def is_too_coarse(self) -> bool:
        return self.known_paper_solution is not None and self.known_paper_solution.is_too_coarse()

    def takes_more_strips_first(self) -> bool:
        return self.known_paper_solution is not None and self.known_paper_solution.takes_more_strips_first()

    def corrected(self) -> QuickSolution:
        return (
            self
            if self.known_paper_solution is None
            else replace(self, known_paper_solution=self.known_paper_solution.corrected())
        )

    def heat(self) -> Heat:
        return self.paper_solution.heat()

    def violations(self) -> tuple[Violation, ...]:
        return self.paper_solution.violations()

    @property
    def why_by_equation(self) -> str:
        """Why f is that of Eq. (9), as text; "" where strips on long cells give it."""
        if why := _why_not_calibrated(self.prepared.scene):
            return why
        if self._is_thick:
            return THICK_FILM_NOTE
        return self._solved if isinstance(self._solved, str) else ""

    @cached_property
    def _is_thick(self) -> bool:
        """Whether the film is thicker than those of the solved cases and touches no asperity, so that load sharing has a
        small error."""
        scene = self.prepared.scene
        most = _error_of_thick_films(scene, self.prepared.surface.sq, self.speed)
        if not most:
            return False
        answer = self.paper_solution.answer()
        return answer.numbers["contact_load"] == 0 and max(answer.model_error) <= most

    @cached_property
    def _solved(self) -> LongStrips | str:
        """The strips on long cells, or why they have no solution, as text."""
        try:
            return solve_long_strips(self.prepared, self.speed)
        except ConvergenceError as error:
            return STRIPS_NOT_SOLVED.format(error)

    @property
    def strips(self) -> LongStrips:
        """The strips on long cells, where there are any (`why_by_equation`)."""
        assert isinstance(self._solved, LongStrips)
        return self._solved

    def why_sufficient(self) -> str:
        scene = self.prepared.scene
        tolerance = scene.numerics.model_tolerance
        if tolerance < LEAST_TOLERANCE or self.why_by_equation:
            return ""
        answer = self.answer()
        error = math.sqrt(
            max(max(answer.model_error) ** 2 - answer.by_limit**2, 0.0)
        )  # the limit is no error of a model
        if error > tolerance:
            return ""
        (stated, target) = percent_beside(error, tolerance)
        return f"its model-form error, {stated}, is within numerics.model_tolerance, {target}"

    def answer(self) -> ModelAnswer:
        return self._answer

    @cached_property
    def _answer(self) -> ModelAnswer:
        """The answer: `why_sufficient` needs its error before it is requested."""
        if why := self.why_by_equation:
            answer = self.paper_solution.answer()
            return replace(answer, notes=(*answer.notes, why))
        return quick_answer_of(self.prepared, self.speed, self.strips)


def solve_long_strips(prepared: Prepared, speed: float) -> LongStrips:
    """Return the strips of ``prepared`` at ``speed`` [m/s], not 0, on long cells. Raises `ConvergenceError`."""
    scene = prepared.scene
    pairs = [_solve_strip(prepared, speed, 0, None)]
    numerics = replace(
        scene.numerics,
        sampling_tolerance=_sampling_error(prepared, pairs[0]),
        model_tolerance=max(scene.numerics.model_tolerance, LEAST_TOLERANCE),
    )
    most = 1 if has_moving_roughness(scene) else MOST_STRIPS
    while True:
        estimate, wanted = two_levels(prepared, pairs, None, numerics)
        if len(pairs) >= min(wanted, most) or pairs[0].resolved.work > PART_OF_WORK * work_left():
            break
        pairs.append(_solve_strip(prepared, speed, len(pairs), pairs[0].resolved.slope))
    rows = [_features(prepared, pair) for pair in pairs]
    x = {name: float(np.mean([row[name] for row in rows])) for name in rows[0]}
    model = error_model_of(scene)
    outside = out_of_range(scene, prepared.surface.sq, speed, model.range)
    factor = widening(part.distance for part in outside)
    return LongStrips(
        levels=levels_of(prepared, speed, pairs, estimate, with_shorter_cells=False),
        model=model,
        bias=model.bias_at(x),
        log_half_width=math.hypot(factor * model.log_half_width(x), _error_of_references(prepared, pairs)),
        widening=factor,
        outside=outside,
    )


def sample_coarsening_of_long_cells(scene: Scene, sample: Sample) -> tuple[float, float]:
    """Return the length of the long cells in those of ``sample``, of a patch at rest in those of the map; where roughness
    moves those of a thin film, which are the shorter ones."""
    (dx, dy) = sample.cells.spacing
    if has_moving_roughness(scene):
        return map_coarsening_in_motion(scene, (dx, dy), sample.rows, sample.correlation_lengths, CELLS_OF_THIN_FILM)
    (fx, fy) = sample.refinement
    return map_coarsening_at_rest(scene, (dx / fx, dy / fy), sample.rows * fy, sample.correlation_lengths)


def _error_of_references(prepared: Prepared, pairs: Sequence[StripOnTwoGrids]) -> float:
    """Return the relative error, at 95 %, that the cells of the solved cases behind the calibration have in a contact like
    this, by what the deterministic model expects (`CellsInMotion`); 0 where roughness rests, as the cases tell it there."""
    scene = prepared.scene
    if not has_moving_roughness(scene):
        return 0.0
    results = [pair.resolved.result for pair in pairs]
    half_width = scene.bodies.half_width
    length = prepared.sample.correlation_lengths[0]
    (along, across) = CELLS_OF_REFERENCES
    cell = min(length, half_width) / along
    return CellsInMotion(
        film_ratio=film_ratio_of(results),
        coarse_x=cell / length,
        coarse_y=1.0 / across,
        coarse_b=cell / half_width,
        by_longer=0.0,
        follows_lubricant=all(pair.resolved.follows_lubricant for pair in pairs),
        is_smooth=smooth_over_cells(prepared.surface.heights),
        sliding_share=sliding_share_of(results),
    ).error


def _features(prepared: Prepared, pair: StripOnTwoGrids) -> dict[str, float]:
    """Return the `features` of a ``pair``."""
    length = prepared.sample.correlation_lengths[0]
    numbers = numbers_of_strip(pair, length, is_smooth=smooth_over_cells(prepared.surface.heights))
    return features(numbers, prepared.scene.bodies.boundary_friction_coefficient)


def _sampling_error(prepared: Prepared, pair: StripOnTwoGrids, part: float = OF_BOUNDS) -> float:
    """Return the relative standard error of f by the sample that strips are solved for: this ``part`` of the bounds at the
    features of the first ``pair``."""
    bounds = min(error_model_of(prepared.scene).log_half_width(_features(prepared, pair)), 1.0)
    return max(prepared.scene.numerics.sampling_tolerance, LEAST_SAMPLING_ERROR, part * bounds)


def _solve_strip(prepared: Prepared, speed: float, index: int, slope: float | None) -> StripOnTwoGrids:
    """Return strip ``index`` on long cells."""
    scene = prepared.scene
    sample = prepared.sample
    surface = strip_surface(prepared, index)
    lengths = sample.correlation_lengths
    is_mirrored = sample.distinct_rows(surface.heights) < surface.shape[1]
    if not has_moving_roughness(scene):
        map_coarsening = map_coarsening_at_rest(scene, surface.spacing, surface.shape[1], lengths)
        return replace(solve_at_rest(scene, surface, speed, map_coarsening, slope), mirrored=is_mirrored)
    cells = long_cells_in_motion(scene, bodies_of(prepared, index, speed), speed, lengths)
    part = OF_NARROW_BOUNDS if cells.per_length == CELLS_OF_THIN_FILM else OF_BOUNDS
    target = sample_target(prepared, _sampling_error(prepared, StripOnTwoGrids(cells.rest, cells.rest), part))
    return replace(solve_moving(scene, cells, speed, target), mirrored=is_mirrored)


def quick_answer_of(prepared: Prepared, speed: float, strips: LongStrips) -> ModelAnswer:
    """Return the answer of ``strips`` at ``speed`` [m/s] without their bias, with its error."""
    scene = prepared.scene
    levels = replace(strips.levels, numbers=strips.numbers(scene))
    answer = deterministic_answer(prepared, speed, levels)
    bounds = strips.bounds(scene)
    by_cells = max(bounds) >= max(answer.model_error)
    largest = OF_CELLS.format(strips.model.cases) if by_cells else answer.largest_in_model
    f = levels.numbers["coefficient"]
    basis = f"deterministic model on long cells, calibrated on {strips.model.cases} solved cases"
    below, above = (math.hypot(part, bound) for part, bound in zip(answer.model_error, bounds))
    warnings = (
        violation for violation in answer.violations if not violation.what.startswith(MODEL_ERROR)
    )  # which was without the cells
    return replace(
        answer,
        model_error=(min(below, 1.0), above),
        largest_in_model=largest,
        violations=(
            *warnings,
            *violations_by_model_error(
                prepared,
                max(below, above),
                f,
                consequence=LARGEST_PART.format(largest.partition(":")[0]),
                recommendation=NARROWED_BY_DETERMINISTIC if by_cells else "",
            ),
            *(part.violation for part in reported(strips.outside)),
        ),
        decision=replace(
            answer.decision,
            model="quick",
            basis=basis,
            notes=(*((NARROWER,) if by_cells else ()), *answer.decision.notes),
        ),
    )


def _error_of_thick_films(scene: Scene, sq: float, speed: float) -> float:
    """Return the error of f, relative, that the bounds of long cells have at least where the film over ``sq`` [m] at ``speed``
    [m/s] is thicker than in all solved cases, by how far they are widened; 0 where it is not."""
    if not (speed and sq):
        return 0.0
    times = scene.line_contact(abs(speed)).moes_film / (error_model_of(scene).range["lambda"][1] * sq)
    return LEAST_TOLERANCE * widening([math.log(times)]) if times > 1 else 0.0


class QuickModel(Model):
    """Strips on long cells with a calibrated error; the balance of Eq. (8) where the calibration has no such contacts."""

    @property
    def takes_wear(self) -> bool:
        return True

    @property
    def name(self) -> str:
        return "quick"

    @property
    def includes_motion(self) -> bool:
        return True  # roughness that moves, moves on the long cells as well

    def described(self, scene: Scene) -> str:
        unknown = "; its model-form error is not known and not in the interval" if why_gap_not_resolved(scene) else ""
        return f"deterministic model on long cells, calibrated (numerics.model): fast, with the error of solved cases{unknown}"

    def expected_violations(self, scene: Scene, speeds: list[float]) -> ExpectedViolations:
        known = error_model_of(scene).range
        at_all = out_of_range(scene, None, 0.0, known)
        expected: list[tuple[float | None, Violation]] = [(None, part.violation) for part in reported(at_all)]
        for speed in speeds:
            sq = _stated_sq(scene)
            if (
                sq
                and speed
                and 0
                < expected_model_error(scene, scene.line_contact(abs(speed)).expected_film, sq, abs(speed))
                <= _error_of_thick_films(scene, sq, speed)
            ):
                continue  # load sharing answers, without long cells
            outside = out_of_range(scene, sq, speed, known)
            expected += [(speed, part.violation) for part in reported(outside) if part not in at_all]
        return (*expected_on_hertz(scene), *expected)

    def estimate_work(
        self, scene: Scene, sample: Sample, surface: Surface, speed: float, cheaper: WorkEstimate | None
    ) -> WorkEstimate:
        alone = PaperModel().estimate_work(scene, sample, surface, speed, None)
        is_named = scene.numerics.model == self.name
        if alone.touching == "none" and alone.model_error <= _error_of_thick_films(scene, surface.sq, speed):
            return replace(alone, seconds=alone.seconds if is_named else 0.0)
        has_line = is_named and _may_answer_by_equation(scene, surface.sq, speed)
        seconds = alone.seconds if has_line else 0.0
        if speed and surface.sq and sample.is_resolved and scene.transient is None:
            count = 1 if has_moving_roughness(scene) else EXPECTED_STRIPS
            seconds += work_on_strips(
                scene, sample, surface.sq, speed, sample_coarsening_of_long_cells(scene, sample), count
            )
        if has_moving_roughness(scene):
            return replace(alone, strips=1, length=sample.line_length(1), seconds=seconds, shared=())
        fine_fields = work_of_fine_fields(scene, sample, surface.sq, speed) if seconds else 0.0
        shared = alone.shared if has_line else ()
        return replace(alone, seconds=seconds, fine_fields_seconds=fine_fields, shared=shared)

    def methods(self, prepared: Prepared, *, has_contact: bool, has_film: bool) -> tuple[str, ...]:
        return ("deterministic model", *methods_of_load_sharing(prepared, has_contact=has_contact, has_film=has_film))

    def rolling_error(self, lambda_ratio: float) -> float:
        return rolling_model_error(lambda_ratio)

    def why_unable(self, prepared: Prepared, speed: float) -> str:
        return why_no_rough_film(prepared, speed) or why_gap_not_resolved(prepared.scene, is_joint=prepared.is_joint)

    def adopt(self, cheaper: SampleSolution) -> QuickSolution | None:
        return _beside(cheaper) if isinstance(cheaper, PaperSolution) else None

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
        """Solve the line by load sharing where it may answer; the strips follow when they are needed."""
        if not _may_answer_by_equation(prepared.scene, prepared.surface.sq, speed):
            return QuickSolution(prepared=prepared, sample=sample, count=count, speed=speed)
        line = start.known_paper_solution if isinstance(start, QuickSolution) else None
        return _beside(PaperModel().solve(prepared, sample, count, speed, start=line))


def _why_not_calibrated(scene: Scene) -> str:
    """Return why the campaign has no contacts like ``scene``, as text; "" if it has."""
    if scene.lubricant.shear_modulus is not None:
        return ELASTIC
    return "" if scene.lubricant.floods else NOT_FLOODED


def _may_answer_by_equation(scene: Scene, sq: float, speed: float) -> bool:
    """Return whether the line by load sharing may answer at ``speed`` [m/s], because the campaign has no such contacts or
    because the film over ``sq`` [m] is thick; of moving roughness it is solved only when it has to."""
    if has_moving_roughness(scene):
        return False
    return bool(_why_not_calibrated(scene)) or _error_of_thick_films(scene, sq, speed) > 0


def _stated_sq(scene: Scene) -> float | None:
    """Return the Sq [m] of all roughness of ``scene``, if it states that of each body."""
    parts = [rough.sq for rough in (scene.surface, scene.counterface) if rough is not None]
    return None if None in parts else math.hypot(*(part for part in parts if part is not None))


def _beside(paper_solution: PaperSolution) -> QuickSolution:
    """Return the strips beside a ``paper_solution`` that is solved."""
    return QuickSolution(
        prepared=paper_solution.prepared,
        sample=paper_solution.sample,
        count=paper_solution.count,
        speed=paper_solution.speed,
        known_paper_solution=paper_solution,
    )
