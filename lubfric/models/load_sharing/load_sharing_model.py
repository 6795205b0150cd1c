"""The calibrated load-sharing model as a `lubfric.models.Model`: the balance of the paper, with f and error of `calibrated`.

It answers for ``numerics.model = "load-sharing"``; "paper" keeps the friction of the paper, Eq. (9) on a smooth film.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

from ...samples import Sample
from ...scene import Scene, gap_not_resolved, moves
from ...surface import Surface
from ..contract import AtInputs, Model, ModelAnswer, SampleSolution, WorkEstimate
from ..shared import (
    ControlVariate,
    ExpectedWarnings,
    Prepared,
    add_errors,
    expected_in_film,
    limit_in_words,
    no_rough_film,
    percent,
)
from .answer import answer_of
from .calibrated import CalibratedFriction, calibrated_friction, film_on_strip
from .calibrated_error import error_model_of, least_half_width
from .error_of_eq8 import rolling_model_error
from .estimated_work import estimated_work
from .methods import methods_of_load_sharing
from .paper_model import PaperModel, PaperSolution

# CPU time [s] of the rough film of a point, and of each end of a range of an input: .11 to .25 on the scene "paper" and on a
# needle roller and a gear flank whose inputs have three and four ranges (`lubfric.friction` by this model and by "paper").
ROUGH_FILM = 0.2

BOUNDARY = "Moes' film over Sq is below that of the solved cases behind the calibration: f of Eq. (9), the paper{}"
ELASTIC = "elastic shear (lubricant.shear_modulus) is not calibrated: friction by Eq. (9)"
# what narrows the bounds; at rest long cells cost as much as this model and err less (docs/models.md, chart)
NARROWER = {
    "at rest": "numerics.model = 'deterministic' narrows f, with numerics.tolerance = 0.1 at about the same cost",
    "moving": "numerics.model = 'deterministic' narrows f, at the cost that `lubfric info` estimates",
}
NOT_FLOODED = (
    "f of Eq. (9) with the error of load sharing: the campaign behind the calibration has flooded contacts only"
)


@dataclass(frozen=True)
class LoadSharingSolution(PaperSolution):
    """The strips by load sharing; f of their `RoughFilm`, with the error that the campaign gives it."""

    @property
    def applies(self) -> bool:
        """Whether the campaign has such contacts: flooded ones, with a film that does not shear elastically."""
        lubricant = self.prepared.scene.lubricant
        return lubricant.floods and lubricant.shear_modulus is None and self.balanced.balance.film is not None

    @cached_property
    def friction(self) -> CalibratedFriction:
        """Return f and its error."""
        return calibrated_friction(self.prepared, self.sample, self.speed, self.balanced.balance)

    def corrected(self) -> LoadSharingSolution:
        return LoadSharingSolution(self.balanced.corrected())

    def why_sufficient(self) -> str:
        tolerance = self.prepared.scene.numerics.model_tolerance
        if tolerance < least_half_width() or not self.applies or self.friction.error > tolerance:
            return ""
        return "its error is within numerics.model_tolerance"

    def answer(self) -> ModelAnswer:
        if not self.applies:
            answer = answer_of(self.balanced)
            elastic = self.prepared.scene.lubricant.shear_modulus is not None
            return replace(answer, notes=(*answer.notes, ELASTIC if elastic else NOT_FLOODED))
        answer = calibrated_answer(self.prepared, answer_of(self.balanced), self.friction)
        return replace(answer, at_inputs=self._at_inputs) if self.friction.weight == 1.0 else answer

    def _at_inputs(self) -> AtInputs:
        """Return f of the rough film at other inputs, on the first strip."""

        def coefficient(scene: Scene) -> float:
            strip = film_on_strip(self.prepared, self.sample, scene, self.speed, None)
            heat = strip.balance.forces.heat
            bias = error_model_of(scene).bias_at(strip.features)
            return strip.film.coefficient * math.exp(bias) * (1 - heat.change if heat.heated else 1.0)

        return AtInputs(middle=coefficient(self.prepared.scene), coefficient=coefficient)


class LoadSharingModel(Model):
    """Load sharing by Eq. (8), with the roughness that the film flattens, its shear summed over cells, and a calibrated
    error."""

    @property
    def name(self) -> str:
        return "load-sharing"

    @property
    def includes_motion(self) -> bool:
        return True  # cases of moving roughness are among those behind the calibration

    def described(self, scene: Scene) -> str:
        unknown = "; its model-form error is not known and not in the interval" if gap_not_resolved(scene) else ""
        return f"load-sharing model, calibrated (numerics.model): fast, with the error of solved cases{unknown}"

    def expected_warnings(self, scene: Scene, speeds: list[float]) -> ExpectedWarnings:
        return expected_in_film(scene, speeds)

    def estimate(
        self, scene: Scene, sample: Sample, surface: Surface, speed: float, cheaper: WorkEstimate | None
    ) -> WorkEstimate:
        alone = estimated_work(scene, sample, surface, speed)
        films = ROUGH_FILM * (1 + 2 * len(scene.ranges))
        return replace(alone, seconds=films + (alone.seconds if cheaper is None else 0.0))

    def methods(self, prepared: Prepared, *, contact: bool, film: bool) -> tuple[str, ...]:
        return methods_of_load_sharing(prepared, contact=contact, film=film)

    def rolling_error(self, lambda_ratio: float) -> float:
        return rolling_model_error(lambda_ratio)

    def why_unable(self, prepared: Prepared, speed: float) -> str:
        return no_rough_film(prepared, speed) or gap_not_resolved(prepared.scene, given=prepared.given)

    def adopt(self, cheaper: SampleSolution) -> LoadSharingSolution | None:
        return LoadSharingSolution(cheaper.balanced) if isinstance(cheaper, PaperSolution) else None

    def solve(
        self,
        prepared: Prepared,
        sample: Sample,
        count: int,
        speed: float,
        *,
        start: SampleSolution | None = None,
        control: ControlVariate | None = None,
    ) -> LoadSharingSolution:
        return LoadSharingSolution(PaperModel().solve(prepared, sample, count, speed, start=start).balanced)


@dataclass(frozen=True, kw_only=True)
class CalibratedLoads:
    """Loads [N] on what rubs: ``contact``, where the stress is f_b p; ``boundary_film``, on gaps below the boundary film;
    ``saturated_film``, on thicker films at their limit, which of a Newtonian oil is f_b p too."""

    contact: float
    boundary_film: float
    saturated_film: float


def calibrated_loads(scene: Scene, friction: CalibratedFriction) -> CalibratedLoads:
    """Return how the load divides so that the forces add up to the calibrated f.

    With the share a of the load where the stress is f_b p, and the mean stress t of the film over its pressure, f =
    f_b a + t (1 - a) + rolling. The bias of f is one of a: t stays as the rough film has it, and a follows from f, from 0
    to 1. What f has beyond a = 1 remains in the shear of the film.
    """
    film = friction.film
    load = scene.bodies.load
    rubs = scene.bodies.boundary_friction_coefficient * (scene.motion.slide_roll_ratio != 0)
    thicker = film.boundary_film_share + film.saturated_film_share - film.asperity
    at_limit = film.asperity + thicker * scene.lubricant.newtonian
    share = at_limit
    if at_limit < 1.0:
        stress = max(film.coefficient - film.rolling - rubs * at_limit, 0.0) / (1.0 - at_limit)
        if rubs > stress:
            share = min(max((friction.coefficient - film.rolling - stress) / (rubs - stress), 0.0), 1.0)
    if not scene.lubricant.newtonian:
        left = (1.0 - share) / (1.0 - at_limit) if at_limit < 1.0 else 0.0
        return CalibratedLoads(contact=share * load, boundary_film=share * load, saturated_film=left * thicker * load)
    part = film.boundary_film_share / at_limit if at_limit > 0 else 0.0
    return CalibratedLoads(
        contact=share * load, boundary_film=part * share * load, saturated_film=(1 - part) * share * load
    )


def calibrated_answer(prepared: Prepared, answer: ModelAnswer, friction: CalibratedFriction) -> ModelAnswer:
    """Return ``answer``, of Eqs. (8) and (9), with f, the forces and the error of calibrated load sharing."""
    scene = prepared.scene
    load = scene.bodies.load
    weight = friction.weight
    if weight == 0.0:
        return replace(answer, notes=(*answer.notes, BOUNDARY.format("")))
    force = friction.coefficient * load
    loads = calibrated_loads(scene, friction)
    boundary = scene.bodies.boundary_friction_coefficient * loads.contact * (scene.motion.slide_roll_ratio != 0)
    calibrated = {
        "coefficient": friction.coefficient,
        "contact_load": loads.contact,
        "film_load": load - loads.contact,
        "boundary_film_load": loads.boundary_film,
        "saturated_film_load": loads.saturated_film,
        "boundary_force": boundary,
        "shear_force": force - boundary,
        "couette_force": force - boundary - answer.numbers["rolling_force"],
        "load_residual": 0.0,
    }
    by_equation = {name: answer.numbers.get(name, 0.0) for name in calibrated}
    by_equation |= {"boundary_film_load": by_equation["contact_load"], "saturated_film_load": 0.0}
    numbers = {name: weight * value + (1 - weight) * by_equation[name] for name, value in calibrated.items()}
    shares = (numbers["boundary_film_load"] / load, numbers["saturated_film_load"] / load)
    f = numbers["coefficient"]
    both = ((friction.coefficient, friction.sides), (by_equation["coefficient"], answer.model_error))
    below, above = (
        sum(part * abs(value) * sides[k] for part, (value, sides) in zip((weight, 1 - weight), both, strict=True))
        / max(abs(f), 1e-12)
        for k in (0, 1)
    )
    if (
        friction.outside and f > 0
    ):  # the bounds of Eq. (9) hold there too: the narrower of both, but not below those inside
        lowest = by_equation["coefficient"] * (1 - answer.model_error[0])
        highest = by_equation["coefficient"] * (1 + answer.model_error[1])
        below = min(below, max(1 - lowest / f, friction.least_bounds[0]))
        above = min(above, max(highest / f - 1, friction.least_bounds[1]))
    notes = list(answer.notes)
    if weight < 1.0:
        notes.append(BOUNDARY.format(f" with a weight of {1 - weight:.2f}"))
    if friction.outside:
        outside = "; ".join(friction.outside)
        notes.append(f"outside the range of the solved cases behind the model-form error, which is widened: {outside}")
    if words := limit_in_words(friction.by_limit):
        notes.append(words)
    return replace(
        answer,
        numbers=answer.numbers | numbers,
        model_error=(below, above),
        sampling=add_errors(answer.sampling, replace(friction.of_strips, error=weight * friction.of_strips.error)),
        by_limit=max(friction.by_limit),
        largest_in_model=_largest(friction),
        notes=tuple(notes),
        decision=replace(
            answer.decision,
            model="load-sharing",
            basis=basis_of(friction),
            notes=(in_words(friction, shares, is_moving=moves(scene)), *answer.decision.notes),
        ),
    )


def _largest(friction: CalibratedFriction) -> str:
    parts = {
        f"the error of the model on {friction.cases} solved cases: numerics.model = 'deterministic' narrows it": max(
            friction.bounds
        ),
        "the boundary film, whose thickness is not given: bodies.boundary_film narrows it": max(
            map(abs, friction.by_film)
        ),
        "heat, half of whose effect counts as its error": friction.by_heat,
        "the limiting stress of the oil, which is not given: lubricant.limiting_stress_coefficient narrows it": max(
            friction.by_limit
        ),
    }
    return max(parts, key=lambda part: parts[part])


def basis_of(friction: CalibratedFriction) -> str:
    """Return what the answer rests on, as text."""
    return f"load-sharing model, calibrated on {friction.cases} solved cases"


def in_words(friction: CalibratedFriction, shares: tuple[float, float], *, is_moving: bool) -> str:
    """Return what makes f up, and what narrows it, as text; ``shares`` of the load: on boundary and saturated films."""
    parts = []
    if any(friction.by_film):
        half, twice = friction.by_film
        parts.append(f"f by half the boundary film {100 * half:+.2g} %, by twice {100 * twice:+.2g} %")
    parts.append(f"asperity load: boundary film {percent(shares[0])}, saturated film {percent(shares[1])}")
    parts.append(NARROWER["moving" if is_moving else "at rest"])
    return "; ".join(parts)
