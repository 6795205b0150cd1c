"""The model of the paper as a `lubfric.models.Model`: film and contact of a line of strips share one load."""

from __future__ import annotations

import math

from ...samples import Sample
from ...scene import Scene, why_gap_not_resolved
from ...surface import Surface
from ..contract import Model, SampleSolution
from ..model_answer import ModelAnswer
from ..shared import (
    ControlVariate,
    ExpectedViolations,
    Heat,
    Prepared,
    Violation,
    expected_in_film,
    rolling_error_by_load,
    rolling_model_error,
)
from ..work_estimate import WorkEstimate
from .answer import answer_of, violations_of_sample
from .balanced_sample import BalancedSample
from .differences_of_strips import control_for
from .errors_of import model_error_of_eq8
from .estimated_work import estimated_work
from .methods import methods_of_load_sharing


class PaperSolution(BalancedSample):
    """The first strips joined to one line, with one film and one approach, which say what they know of f."""

    def control(self) -> ControlVariate | None:
        return control_for(self)

    def why_sufficient(self) -> str:
        tolerance = self.prepared.scene.numerics.model_tolerance
        if self.response is None and max(model_error_of_eq8(self)[0]) <= tolerance:
            return "load sharing alone: the film is so thick that the roughness changes f by less than the tolerance"
        return ""

    def heat(self) -> Heat:
        return self.corrected_balance.forces.heat

    def violations(self) -> tuple[Violation, ...]:
        return violations_of_sample(self)

    def answer(self) -> ModelAnswer:
        return answer_of(self)


class PaperModel(Model):
    """The load-sharing model of the paper: film and asperity contacts share the load, Eq. (8); friction by Eq. (9)
    (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z)."""

    @property
    def name(self) -> str:
        return "paper"

    @property
    def title(self) -> str:
        return "load-sharing model"

    @property
    def takes_wear(self) -> bool:
        return True

    def described(self, scene: Scene) -> str:
        width = "its model-form error is not known and not in the interval"
        return (
            f"{self.title} of the paper (numerics.model): fast; "
            f"{width if why_gap_not_resolved(scene) else 'its interval is wide'}"
        )

    def described_in_auto(self, scene: Scene, where: str, *, is_everywhere: bool) -> str:
        if why := why_gap_not_resolved(scene):
            return f"{self.title} alone: {why}; its model-form error is not known and not in the interval"
        return (
            f"{self.title} alone where the film is thick or the surfaces are smooth; a point at which its model-form "
            "error is above numerics.model_tolerance, as may be in pure rolling, is solved by the next model"
        )

    def expected_violations(self, scene: Scene, speeds: list[float]) -> ExpectedViolations:
        return expected_in_film(scene, speeds)

    def estimate_work(
        self, scene: Scene, sample: Sample, surface: Surface, speed: float, cheaper: WorkEstimate | None
    ) -> WorkEstimate:
        return estimated_work(scene, sample, surface, speed)

    def methods(self, prepared: Prepared, *, has_contact: bool, has_film: bool) -> tuple[str, ...]:
        return methods_of_load_sharing(prepared, has_contact=has_contact, has_film=has_film)

    def rolling_error(self, lambda_ratio: float, film_growth: float) -> float:
        return math.hypot(rolling_model_error(lambda_ratio), rolling_error_by_load(film_growth))

    def solve(
        self,
        prepared: Prepared,
        sample: Sample,
        count: int,
        speed: float,
        *,
        start: SampleSolution | None = None,
        control: ControlVariate | None = None,
    ) -> PaperSolution:
        begin = start if isinstance(start, PaperSolution) else None
        return PaperSolution.solved(prepared, sample, count, speed, begin)
