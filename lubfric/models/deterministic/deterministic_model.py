"""The deterministic model as a `lubfric.models.Model`: film and contact solved together on each strip by itself."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from ...samples import Sample, requests_patch
from ...scene import Scene, check_resolved_gap, has_moving_roughness, why_gap_not_resolved
from ...surface import Surface
from ..contract import Model, SampleSolution
from ..model_answer import ModelAnswer
from ..shared import (
    ControlVariate,
    ExpectedViolations,
    Prepared,
    expected_on_hertz,
    rolling_model_error,
    why_no_rough_film,
)
from ..work_estimate import MeasuredTime, WorkEstimate
from .answer import answer_of
from .counted_work import MOST_WORK_OF_POINT, USUAL_PACES
from .estimated_work import estimated_work, measured_time, why_too_costly, why_too_many_cells
from .first_steps import first_steps
from .heat_of_strip import too_hot_in_words, why_too_hot
from .levels import Levels, TwoLevelEstimate, levels_of, solve_pairs, two_levels
from .strip_on_two_grids import StripOnTwoGrids, sample_coarsening_of


@dataclass(frozen=True, kw_only=True)
class DeterministicSolution(SampleSolution):
    """Strips that are solved one by one.

    Attributes
    ----------
    pairs : the strips, `count` of them
    estimate : the mean over them, with the control of a cheaper model or alone
    wanted : number of strips that the tolerances need
    """

    prepared: Prepared
    sample: Sample
    count: int
    speed: float
    pairs: tuple[StripOnTwoGrids, ...]
    estimate: TwoLevelEstimate
    wanted: int

    @cached_property
    def levels(self) -> Levels:
        """All that is known of the point, with the effect of shorter cells, which is solved once. Raises
        `ConvergenceError`, as a failure of the solve."""
        return levels_of(self.prepared, self.speed, self.pairs, self.estimate)

    def required_strips(self) -> int:
        return self.wanted

    def corrected(self) -> DeterministicSolution:
        """Solve the effect of shorter cells (`levels`), if it is not solved yet."""
        _ = self.levels
        return self

    def answer(self) -> ModelAnswer:
        return answer_of(self.prepared, self.speed, self.levels)


class DeterministicModel(Model):
    """The film between rough surfaces in its own gap (docs/deterministic.md)."""

    @property
    def name(self) -> str:
        return "deterministic"

    @property
    def has_slow_strips(self) -> bool:
        return True

    @property
    def takes_boundary_film(self) -> bool:
        return True

    @property
    def includes_motion(self) -> bool:
        return True

    @property
    def takes_cells_of_sample(self) -> bool:
        return False  # its cells are those of `sample_coarsening_of`

    def described_in_auto(self, scene: Scene, where: str, *, is_everywhere: bool) -> str:
        target = f"with a target of {100 * scene.numerics.model_tolerance:g} % for the model-form error"
        elsewhere = (
            ""
            if is_everywhere
            else f"; elsewhere the load-sharing model, and the quick model where {too_hot_in_words()}"
        )
        if has_moving_roughness(scene):
            return f"deterministic model with moving roughness {where}, {target}{elsewhere}"
        how = "on the patch" if requests_patch(scene) else "on some strips as differences from the load-sharing model"
        return f"{self.title}, {how}, {where}, {target}{elsewhere}"

    @property
    def most_strip_work_in_auto(self) -> float:
        return MOST_WORK_OF_POINT

    def limit_of_work_in_auto(self) -> str:
        (least, most) = (f"{pace * MOST_WORK_OF_POINT:g}" for pace in USUAL_PACES)
        return (
            f"the quick model replaces it where one strip takes above {MOST_WORK_OF_POINT:g} s of work counted from its "
            f"cells and steps ({least} to {most} s of processor time on a free core; shorter cells and ends of input "
            "ranges take more)"
        )

    def check(self, scene: Scene, *, has_one_map_for_all_bodies: bool) -> None:
        check_resolved_gap(scene, has_one_map_for_all_bodies=has_one_map_for_all_bodies)

    def expected_violations(self, scene: Scene, speeds: list[float]) -> ExpectedViolations:
        return expected_on_hertz(scene)

    def strips_to_begin_with(self, sample: Sample) -> int:
        return 1

    def estimate_work(
        self, scene: Scene, sample: Sample, surface: Surface, speed: float, cheaper: WorkEstimate | None
    ) -> WorkEstimate:
        return estimated_work(scene, sample, surface, speed, cheaper)

    def measure_time(self, prepared: Prepared, speed: float) -> MeasuredTime | None:
        if speed == 0 or not has_moving_roughness(prepared.scene) or self.why_unable(prepared, speed):
            return None
        measured = first_steps(prepared, speed)
        if measured is None:
            return None
        return measured_time(prepared, speed, measured)

    def methods(self, prepared: Prepared, *, has_contact: bool, has_film: bool) -> tuple[str, ...]:
        return ("deterministic model", "kept mass") if has_film else ("deterministic model",)

    def rolling_error(self, lambda_ratio: float, film_growth: float) -> float:
        return rolling_model_error(lambda_ratio)

    def takes_control(self, scene: Scene, sample: Sample) -> bool:
        is_moving = has_moving_roughness(scene)  # the summits are the control of what moves
        return sample.represents_more and not is_moving

    def solve(
        self,
        prepared: Prepared,
        sample: Sample,
        count: int,
        speed: float,
        *,
        start: SampleSolution | None = None,
        control: ControlVariate | None = None,
    ) -> DeterministicSolution:
        """Solve the first ``count`` strips of ``prepared.sample``, on cells of this model (`takes_cells_of_sample`)."""
        solved = start.pairs if isinstance(start, DeterministicSolution) else ()
        pairs = solve_pairs(prepared, speed, count, solved=solved)
        estimate, wanted = two_levels(prepared, pairs, control)
        return DeterministicSolution(
            prepared=prepared,
            sample=sample,
            count=len(pairs),
            speed=speed,
            pairs=pairs,
            estimate=estimate,
            wanted=wanted,
        )

    def why_unable(self, prepared: Prepared, speed: float) -> str:
        return why_no_rough_film(prepared, speed) or why_too_many_cells(prepared, speed)

    def why_declined(self, prepared: Prepared, speed: float, cheaper: SampleSolution) -> str:
        scene = prepared.scene
        why = why_gap_not_resolved(scene, has_one_map_for_all_bodies=prepared.has_one_map_for_all_bodies)
        why = why or why_too_hot(cheaper.heat())
        if why:
            return f"not the deterministic model: {why}"
        return why_too_costly(prepared, speed, sample_coarsening_of(prepared.scene, prepared.sample))
