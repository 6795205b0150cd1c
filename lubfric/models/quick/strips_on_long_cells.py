"""The strips of the quick model: solved on long cells, their f without its bias, and its error."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..._base import work_left
from ...quantities import FRICTION_FORCES
from ...scene import Numerics, Scene, has_moving_roughness
from ..deterministic import (
    UNKNOWN_SLOPE,
    Levels,
    StripOnTwoGrids,
    bodies_of,
    cells_in_motion,
    changed_as_expected,
    levels_of,
    map_of_strip,
    sample_target,
    two_levels,
)
from ..deterministic import answer_of as deterministic_answer
from ..model_answer import ModelAnswer
from ..shared import (
    DETERMINISTIC,
    REDUCED_BY_DETERMINISTIC,
    SAMPLING_ERROR_MISSED,
    ModelErrorPart,
    Prepared,
    Sides,
    is_smooth_over_cells,
    largest_of,
    percent,
    sides_of_parts,
    with_divided_sliding,
)
from .calibrated_error import ErrorModel, Outside, error_model_of, out_of_range, reported, widening
from .long_cells import (
    CELLS_OF_REFERENCES,
    CELLS_OF_THIN_FILM,
    features,
    long_cells_in_motion,
    map_coarsening_at_rest,
    numbers_for_features,
    solve_at_rest,
    solve_moving,
)

# Strips at rest, at most: each adds .2 s. A choice between time and width of the interval.
MOST_STRIPS = 4

# Standard error of f by the sample that strips are solved for, relative, at least: a smaller one takes more time than
# the error by the cells is worth. A choice: a smaller value takes more strips.
LEAST_SAMPLING_ERROR = 0.03

# Standard error of f that strips are solved for, over the half-width of the bounds of f by the cells [-]: with
# Student's t it widens the interval by a tenth. A choice: a smaller value takes more strips.
SAMPLING_OVER_BOUNDS = 0.2

# Standard error of f that strips are solved for, over the half-width of the bounds, on cells for thin films [-], where
# a moment takes twice as long and the bounds are half as wide: with Student's t it widens the interval by four tenths.
# A choice: a smaller value takes more strips.
SAMPLING_OVER_NARROW_BOUNDS = 0.4

# Part of the remaining work of a point that one more strip may take [-]: the rest is for the ends of input ranges. A
# choice: a larger value leaves less to these ends.
PART_OF_WORK = 0.25

# numerics.model_tolerance below which "auto" does not try this model: the bounds are those of kinds of contacts, and a
# point would be solved twice for the few whose bounds are narrower. A choice: a smaller value solves more points twice.
LEAST_TOLERANCE = 0.1

# Part of f_b by which the stress of asperities exceeds that of the film, at least, where a bias of f is one of the
# asperity load. Where both are alike, it is one of the film. A choice: a smaller value divides by differences near 0.
LEAST_CONTRAST = 0.05

NARROWER = "set numerics.model = 'deterministic' to reduce the error of f; 'lubfric info' estimates the cost"
CELLS_IN_MODEL_ERROR = (
    "the error of the long cells (cells longer than those of the deterministic model) is in the model-form error, "
    "not in the numerical one"
)
SAMPLED_LESS = (
    "the quick model {}, until the sampling error of f is small compared with the error of its long cells; "
    "numerics.model = 'deterministic' reduces both, at a cost that 'lubfric info' estimates"
)
OUTSIDE_OF_CASES = "the contact is outside of the calibration ({})"
ABOVE_USUAL = "the error of the long cells is above {}, which nine in ten of the solved cases do not exceed"
GIVEN_TOLERANCE = "the scene gives numerics.model_tolerance in place of its default"
BY_CELLS = "the long cells of the quick model, whose error is calibrated on {} contacts"


@dataclass(frozen=True, kw_only=True)
class StripsOnLongCells:
    """The strips on long cells.

    Attributes
    ----------
    scene : that they are solved for
    levels : their estimate
    error_model : of such contacts
    bias : of ln of the sliding part of f
    log_half_width : of the 95 % interval of the same
    widening : factor on the bounds outside of the range of the solved cases
    outside : what is outside of it
    """

    scene: Scene
    levels: Levels
    error_model: ErrorModel
    bias: float
    log_half_width: float
    widening: float
    outside: tuple[Outside, ...]

    @cached_property
    def numbers(self) -> dict[str, float]:
        """The numbers of the strips without their bias, which is one of the sliding part of f.

        A bias that raises f is attributed to the asperity load; f_b on asperities and the mean stress of the film
        remain. It ends where asperities carry all of the load, because their stress is the larger one. Where asperities
        have the stress of the film, it is attributed to the shear of the film. So the forces add up to f.

        A bias that lowers f changes asperity load and sliding forces by the same factor. On 17 solved cases whose
        asperities carry less than a tenth of the load, the median error of their load ratio is 36 % at rest and 31 % in
        rolling; it was 44 and 54 % where such a bias too was one of the asperity load alone, which ended at 0.
        """
        numbers = self.levels.numbers
        if self.scene.motion.slide_roll_ratio == 0:
            return numbers
        load = self.scene.bodies.load
        rolling = self.levels.rolling_of_strips
        if self.bias < 0:
            return changed_as_expected(numbers, math.expm1(self.bias), rolling)
        force = rolling + (load * numbers["coefficient"] - rolling) * math.exp(self.bias)
        load_ratio = numbers["contact_load"] / load
        if self._contrast > LEAST_CONTRAST * self.scene.bodies.boundary_friction_coefficient:
            force = min(force, load * (numbers["coefficient"] + self._contrast * (1 - load_ratio)))
            load_ratio = max(load_ratio + (force / load - numbers["coefficient"]) / self._contrast, 0.0)
        changed = _with_asperity_load_ratio(self.scene, numbers, load_ratio) | {"coefficient": force / load}
        answer = with_divided_sliding(changed, numbers, load)
        forces = {name: answer[name] for name in ("coefficient", *FRICTION_FORCES)}
        return _with_asperity_load_ratio(self.scene, numbers, answer["contact_load"] / load) | forces

    @property
    def _contrast(self) -> float:
        """The friction coefficient of asperities less that of the film."""
        numbers = self.levels.numbers
        of_film = numbers["couette_force"] / numbers["film_load"] if numbers["film_load"] > 0 else 0.0
        return self.scene.bodies.boundary_friction_coefficient - of_film

    @property
    def bounds(self) -> Sides:
        """The 95 % bounds of f by the cells, relative, towards 0 and away from it. In pure rolling all of f is the
        rolling part."""
        f = self.numbers["coefficient"]
        is_rolling = self.scene.motion.slide_roll_ratio == 0
        rolling = f if is_rolling else self.levels.rolling_of_strips / self.scene.bodies.load
        sliding = abs(f - rolling)
        if f == 0:
            return Sides(math.inf, math.inf)
        of_rolling = self.widening * self.error_model.rolling_error(rolling, sliding)
        towards, away = (sliding * abs(math.expm1(side * self.log_half_width)) for side in (-1, 1))
        return Sides(math.hypot(towards, of_rolling) / abs(f), math.hypot(away, of_rolling) / abs(f))


def _with_asperity_load_ratio(scene: Scene, numbers: dict[str, float], load_ratio: float) -> dict[str, float]:
    """Return ``numbers`` with another asperity load ratio F_C/F_T.

    Friction and films of the asperity contacts change in proportion to their load. Where no asperity carried any, all
    of the load is on boundary film, with f_b. A saturated film is one of asperities; with a shear law it is one of the
    film load.
    """
    load = scene.bodies.load
    before = numbers["contact_load"] / load
    if before > 0:
        growth = load_ratio / before
        boundary_force = numbers["boundary_force"] * growth
        boundary_film_load = numbers["boundary_film_load"] * growth
    else:
        growth = 0.0
        boundary_force = scene.bodies.boundary_friction_coefficient * load_ratio * load
        boundary_film_load = load_ratio * load
    growth_of_saturated_film = growth
    if not scene.lubricant.has_unlimited_stress:
        growth_of_saturated_film = (1 - load_ratio) / (1 - before) if before < 1 else 0.0
    return numbers | {
        "contact_load": load_ratio * load,
        "film_load": (1 - load_ratio) * load,
        "boundary_film_load": boundary_film_load,
        "saturated_film_load": numbers["saturated_film_load"] * growth_of_saturated_film,
        "boundary_force": boundary_force,
    }


def solve_on_long_cells(prepared: Prepared, speed: float) -> StripsOnLongCells:
    """Return the strips of ``prepared`` at ``speed`` [m/s], not 0, on long cells. Raises `ConvergenceError`."""
    scene = prepared.scene
    pairs = [_solve_pair(prepared, speed, 0, find_slope=True)]
    target = _sampling_target(prepared, pairs[0])
    most = 1 if has_moving_roughness(scene) else MOST_STRIPS
    while True:
        estimate, wanted = two_levels(prepared, pairs, None, sampling_tolerance=target)
        if len(pairs) >= min(wanted, most) or pairs[0].resolved.work > PART_OF_WORK * work_left():
            break
        pairs.append(_solve_pair(prepared, speed, len(pairs), slope=pairs[0].resolved.slope))
    rows = [_features_of(prepared, pair) for pair in pairs]
    x = {name: float(np.mean([row[name] for row in rows])) for name in rows[0]}
    error_model = error_model_of(scene)
    outside = out_of_range(scene, prepared.surface.sq, speed, error_model.range)
    factor = widening(part.distance for part in outside)
    return StripsOnLongCells(
        scene=scene,
        levels=levels_of(prepared, speed, pairs, estimate, with_shorter_cells=False),
        error_model=error_model,
        bias=error_model.bias_at(x),
        log_half_width=math.hypot(factor * error_model.log_half_width(x), _error_of_references(prepared, pairs)),
        widening=factor,
        outside=outside,
    )


def _error_of_references(prepared: Prepared, pairs: Sequence[StripOnTwoGrids]) -> float:
    """Return the relative error, at 95 %, that the cells of the solved cases behind the calibration have in a contact
    like this, by what the deterministic model expects (`CellsInMotion`); 0 where roughness rests, as the cases tell it
    there."""
    scene = prepared.scene
    if not has_moving_roughness(scene):
        return 0.0
    (along, across) = CELLS_OF_REFERENCES
    (lx, ly) = prepared.sample.lengths_by_slopes
    cell = min(lx, scene.bodies.half_width) / along, ly / across
    is_smooth = is_smooth_over_cells(prepared.surface.heights)
    return cells_in_motion(prepared, [pair.resolved for pair in pairs], cell, is_smooth=is_smooth).error


def _features_of(prepared: Prepared, pair: StripOnTwoGrids) -> dict[str, float]:
    """Return the `features` of a ``pair``."""
    (length, _) = prepared.sample.lengths_by_slopes
    numbers = numbers_for_features(pair, length, is_smooth=is_smooth_over_cells(prepared.surface.heights))
    return features(numbers, prepared.scene.bodies.boundary_friction_coefficient)


def _sampling_target(prepared: Prepared, pair: StripOnTwoGrids, part: float = SAMPLING_OVER_BOUNDS) -> float:
    """Return the relative standard error of f by the sample that strips are solved for: this ``part`` of the bounds at
    the features of the first ``pair``."""
    bounds = min(error_model_of(prepared.scene).log_half_width(_features_of(prepared, pair)), 1.0)
    return max(prepared.scene.numerics.sampling_tolerance, LEAST_SAMPLING_ERROR, part * bounds)


def _solve_pair(
    prepared: Prepared, speed: float, index: int, *, slope: float = UNKNOWN_SLOPE, find_slope: bool = False
) -> StripOnTwoGrids:
    """Return strip ``index`` on long cells; ``slope``, ``find_slope``: as of `solve_at_rest`."""
    scene = prepared.scene
    sample = prepared.sample
    surface = map_of_strip(prepared, index)
    # of two bodies with unlike lengths: by the longer ones f of a needle roller on a ground shaft was .04, not .096
    lengths = sample.lengths_by_slopes
    is_mirrored = sample.distinct_rows(surface.heights) < surface.shape[1]
    if not has_moving_roughness(scene):
        map_coarsening = map_coarsening_at_rest(scene, spacing=surface.spacing, rows=surface.shape[1], lengths=lengths)
        pair = solve_at_rest(
            scene,
            surface,
            speed,
            map_coarsening=map_coarsening,
            slope=slope,
            find_slope=find_slope,
            memo=prepared.memo,
        )
        return replace(pair, is_mirrored=is_mirrored)
    cells = long_cells_in_motion(scene, bodies_of(prepared, index, speed), speed, lengths)
    part = SAMPLING_OVER_NARROW_BOUNDS if cells.per_length == CELLS_OF_THIN_FILM else SAMPLING_OVER_BOUNDS
    at_rest = StripOnTwoGrids.on_one_grid(cells.rest)  # all that is known before the motion
    target = sample_target(prepared, _sampling_target(prepared, at_rest, part))
    return replace(solve_moving(scene, cells, speed, target), is_mirrored=is_mirrored)


def _why_unusual(on_long_cells: StripsOnLongCells) -> str:
    """Return why the error by the cells is not one that solved cases have, as text: outside of their range, larger than
    that of nine in ten, or beside a target that the scene sets in place of the default; "" if it is one."""
    outside = [
        f"{part.what} {'above' if part.value > part.limit else 'below'} {part.limit_in_words}"
        for part in reported(on_long_cells.outside)
    ]
    if outside:
        return OUTSIDE_OF_CASES.format(" and ".join(outside))
    usual_error = on_long_cells.error_model.usual_error
    if max(on_long_cells.bounds) > usual_error:
        return ABOVE_USUAL.format(percent(usual_error))
    is_default = on_long_cells.scene.numerics.model_tolerance == Numerics().model_tolerance
    return "" if is_default else GIVEN_TOLERANCE


def _is_sampled_less(prepared: Prepared, answer: ModelAnswer) -> bool:
    """Return whether the sampling error of an ``answer`` misses its tolerance because of the target of this model
    (`_sampling_target`), not because the map has no more strips."""
    tolerance = prepared.scene.numerics.sampling_tolerance
    misses = answer.errors.sampling_error.value > SAMPLING_ERROR_MISSED * tolerance
    return misses and answer.errors.area_needed <= 1


def quick_answer_of(prepared: Prepared, speed: float, on_long_cells: StripsOnLongCells) -> ModelAnswer:
    """Return the answer of the strips ``on_long_cells`` at ``speed`` [m/s] without their bias, with its error."""
    levels = replace(on_long_cells.levels, numbers=on_long_cells.numbers)
    answer = deterministic_answer(prepared, speed, levels)
    why_unusual = _why_unusual(on_long_cells)
    by_cells = ModelErrorPart(
        sides=on_long_cells.bounds,
        cause=BY_CELLS.format(on_long_cells.error_model.cases),
        recommendation=REDUCED_BY_DETERMINISTIC,
        reduced_by_model=DETERMINISTIC,
        is_usual=not why_unusual,
        why_unusual=why_unusual,
    )
    parts = (by_cells, *answer.errors.parts_of_model)
    cases = on_long_cells.error_model.cases
    basis = f"quick model (the deterministic model on long cells, calibrated on {cases} solved cases)"
    fields = answer.fields
    if fields is not None:
        fields = replace(fields, solve=f"quick model (long cells): {fields.solve}")
    is_sampled_less = _is_sampled_less(prepared, answer)
    strips = "follows one strip" if has_moving_roughness(prepared.scene) else f"solves at most {MOST_STRIPS} strips"
    return replace(
        answer,
        fields=fields,
        narrows_sampling=REDUCED_BY_DETERMINISTIC if is_sampled_less else "",
        errors=replace(
            answer.errors,
            model_error=sides_of_parts(parts).capped(),
            notes=(
                *answer.errors.notes,
                *((SAMPLED_LESS.format(strips),) if is_sampled_less else ()),
                CELLS_IN_MODEL_ERROR,
            ),
            parts_of_model=parts,
        ),
        violations=(
            *answer.violations,
            *(part.violation_in(on_long_cells.scene) for part in reported(on_long_cells.outside)),
        ),
        decision=replace(
            answer.decision,
            basis=basis,
            counts_cells_as_model_error=True,
            notes=(*((NARROWER,) if largest_of(parts) is by_cells else ()), *answer.decision.notes),
        ),
    )
