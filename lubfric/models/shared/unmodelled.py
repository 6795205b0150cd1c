"""Effects that are not modelled, and by how much f would likely change: `unmodelled_effects` of a result, and
`expected_effects` before there is one, from closed forms alone.

f is guessed as ``f_b s + mu (1 - s)``. The share s = exp(-1.8 λ^1.2) of the load on the asperities (Aihara's law, one
of the measured ones, which lie within a factor of two of each other) is that at λ, the expected film of the total load
over Sq. mu is the shear of that film in the gap of a dry contact, or of one as thick as the gap of rough surfaces,
under the Hertz pressure, with the resistance of its inlet to rolling. Only ratios of guesses count. Where a result is
known, mu is scaled to what it has; s follows Aihara's law from what it has by load sharing, and by models of the
resolved gap s/(1 - s) follows a power of λ that solved contacts show. Before there is one, both have a range (`POWERS`,
`SHEARS`), and so has the change of f: it holds that of the result by any model.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from ...film import flooded_inlet, hertz, smallest_film, starved_inlet
from ...oil import carried_stress, density_ratio, shear_stress
from ...scene import Scene, has_generated_roughness, has_moving_roughness, why_gap_not_resolved
from ...units import worded
from .checks import peak_hertz_pressure
from .checks_before import STRIP_NODES
from .heat import TYPICAL, typical_heat_of_even_film
from .violation import numbers_in_words
from .wording import percent

# Film over that of a full inlet, of the example of a starved one. A convention, not measured.
STARVED_EXAMPLE = 0.7

# Sq after running-in over that before, of the example. Not measured: `lubfric.run_in` computes it for a scene.
WORN = 0.6

# Temperature rise of the oil in the inlet [K] of the example. A convention, not measured.
WARMER = 10.0

# f_b with another additive over that of the scene, of the example. A convention, not measured.
RUBBED = 0.75

# Aihara's law of the asperity load ratio: exp(-`AIHARA_FACTOR` λ^`AIHARA_POWER`). As printed by the sources of
# docs/theory.md.
AIHARA_FACTOR = 1.8
AIHARA_POWER = 1.2

# Power of λ with which the load on asperities over that on the film changes, where roughness rests and where it moves
# [-]. Fitted with the pressure-viscosity coefficient times the pressure to 237 and 209 contacts solved by the
# deterministic model (verification.campaigns.calibration): -3.47 ± .17 and -2.72 ± .15.
LOAD_RATIO_AT_REST = -3.5
LOAD_RATIO_IN_MOTION = -2.7

# Mean gap of a contact that carries most of the load [Sq], about: measured 1.67 in the scene "paper" at 1 mm/s.
GAP_IN_CONTACT = 1.6

# Film over Sq from which the motion of roughness has little effect. A choice: the lambda ratio of full-film
# lubrication.
FILM_THAT_HIDES_ROUGHNESS = 3.0

# E' [Pa] below which a body is a covered roller or a seal. A choice, between polymers and metals.
SOFT_E_PRIME = 5e9

# Half-widths of the Hertz strip that a cover must be thick to count as a half-space. A choice: the stress of a line
# contact falls with the depth, to .2 of its largest there.
DEEP = 5.0

# Least share of asperities or film of the load that is scaled to that of a result. A choice, against a division by 0.
LEAST_SCALED_SHARE = 1e-6

# Distance that a film reaches before a narrow contact, in sqrt(2 R h): the pressure of a rigid one has fallen to 4 % of
# its largest there. A choice: less cuts the film off.
UPSTREAM = 4.0

# Distance that a film reaches behind a narrow contact, in sqrt(2 R h), by Reynolds' condition on a rigid cylinder. It
# follows from Reynolds' equation (Swift-Stieber).
REYNOLDS_RUPTURE = 0.475

# Friction of asperities over f_b between which the correlation length of the roughness counts [-]; of moving roughness
# in a thin film the upper end alone: it bends the film without touching. A choice: the ends of mixed lubrication, where
# f is that of the film or f_b whatever the length is.
MIXED = (0.02, 0.98)

# Peak Hertz pressure [Pa] from which compressibility is an effect of its own: with it the film is thinner and f
# larger. A choice between 0.5 GPa, where f of 6 contacts solved with both densities fell by 0 to 5 %, and 0.9 GPa, from
# which f of 6 contacts rose by 0 to 9 %.
COMPRESSING_PRESSURE = 0.7e9

# Part of f by asperities below which the film makes it. A choice: it selects a sentence.
LEAST_ASPERITY_PART = 0.1


# Power of the pressure-viscosity coefficient with which the load on asperities over that on the film falls at a given
# film [-]: asperities press the film between them far above the Hertz pressure. A choice: with it the bound holds at 23
# contacts, at rest and rolling, of Λ from 0.02 to 6, solved by the quick model with both ends of the range; where they
# change f by 1 % or more, it is 1.1 to 15 times the change.
LOAD_RATIO_BY_ALPHA = -1.0

# What to do about the pressure-viscosity coefficients of measured oils where that of the scene is an estimate.
GIVE_ALPHA = (
    "give lubricant.pressure_viscosity_coefficient = [value, low, high] to have the change solved and in the interval"
)

# The same of a run in time, whose interval contains no such range.
GIVE_ALPHA_IN_TIME = "give lubricant.pressure_viscosity_coefficient; the interval of f does not contain this change"

# Powers of the guess of s between which that of a result lies, and 0: the built-in contact, by three models, has those
# of 0.17 to 1.7 at Λ from 0.3 to 1.7, and moving roughness by the deterministic model next to no load on asperities.
# A margin is added.
POWERS = (0.12, 0.4, 1.0, 2.5, math.inf)

# Times the guess of mu between which that of a result may lie. A choice: a factor of 2.
SHEARS = (0.5, 1.0, 2.0)


@dataclass(frozen=True, kw_only=True)
class UnmodelledEffect:
    """An effect that is not modelled.

    Attributes
    ----------
    what : the effect, as text
    change : likely change of f, relative [-]; NaN where it is not known
    recommendation : what to do
    is_of_alpha : whether it is that of an estimated pressure-viscosity coefficient: then the change is the largest one
        either way
    """

    what: str
    change: float
    recommendation: str
    is_of_alpha: bool = False

    @property
    def changes(self) -> tuple[float]:
        """The change of f."""
        return (self.change,)

    @property
    def change_in_words(self) -> str:
        """The change of f as text."""
        return at_most_in_words(self.change) if self.is_of_alpha else change_in_words(self.change)

    @property
    def largest_change(self) -> float:
        """The change of f without its sign; NaN where it is not known."""
        return abs(float(self.change))


@dataclass(frozen=True, kw_only=True)
class ExpectedEffect:
    """An effect that is not modelled, before there is a result.

    Attributes
    ----------
    what, recommendation, is_of_alpha : as of `UnmodelledEffect`
    low, high : lowest and highest change of f, relative [-]; NaN where they are not known
    """

    what: str
    low: float
    high: float
    recommendation: str
    is_of_alpha: bool = False

    @property
    def changes(self) -> tuple[float, float]:
        """The lowest and the highest change of f."""
        return self.low, self.high

    @property
    def change_in_words(self) -> str:
        """The change of f as text."""
        return at_most_in_words(self.high) if self.is_of_alpha else change_in_words(*self.changes)

    @property
    def largest_change(self) -> float:
        """The largest change of f without its sign; NaN where it is not known."""
        return max(abs(float(change)) for change in self.changes)


AnyEffect = TypeVar("AnyEffect", UnmodelledEffect, ExpectedEffect)


def unmodelled_effects(
    scene: Scene,
    sq: float,
    speed: float,
    friction_parts: tuple[float, float] | None = None,
    *,
    run: Scene | None = None,
    includes_motion: bool = True,
    way_to_motion: str = "",
) -> tuple[UnmodelledEffect, ...]:
    """Return the effects that are not modelled for ``scene``, whose surface has the standard deviation ``sq`` [m], at
    ``speed`` [m/s]: the largest change of f first, what is not known last. What would change f by less than
    ``numerics.tolerance`` is not reported.

    ``friction_parts``: the friction [-] of asperities alone and of all, of a result there, if there is one; ``run``:
    the scene of the run in time of which ``scene`` is one moment, which holds the ranges and tables that a moment has
    not; ``includes_motion``: whether the model has the motion of the roughness
    (`lubfric.models.Model.includes_motion`); ``way_to_motion``: what to do to include it, as text; "":
    `stated_way_to_motion`.
    """
    tolerance = scene.numerics.tolerance
    effects = _all_effects(
        scene, sq, speed, friction_parts, run=run, includes_motion=includes_motion, way_to_motion=way_to_motion
    )
    return _largest_first([effect for effect in effects if not effect.largest_change <= tolerance])


def _largest_first(effects: list[AnyEffect]) -> tuple[AnyEffect, ...]:
    """Return ``effects`` with the largest change of f first; what is not known is last."""
    return tuple(sorted(effects, key=lambda each: -each.largest_change if math.isfinite(each.changes[0]) else 0.0))


def alpha_of_points_in_words(effects_by_point: Mapping[int, Sequence[UnmodelledEffect]], count: int) -> str:
    """Return in a sentence by how much the range of an estimated pressure-viscosity coefficient changes f at most at
    ``count`` points of a study, where, and what to give; "" where the coefficient is given, or the changes are below
    the tolerance.

    ``effects_by_point``: the effects that are not modelled, by the number of the point, from 1.
    """
    changes = {number: _largest_by_alpha(effects) for number, effects in effects_by_point.items()}
    numbers = sorted(number for number, change in changes.items() if change > 0)
    if not numbers:
        return ""
    worst = max(numbers, key=lambda number: changes[number])
    largest = at_most_in_words(changes[worst]) + (f" (at point {worst})" if count > 1 else "")
    where = "At all points" if len(numbers) == count > 1 else numbers_in_words(numbers, count)
    others = " (less than the numerical tolerance at the others)" if len(numbers) < count else ""
    return (
        "The pressure-viscosity coefficient is an estimate, whose error is not in the interval of f. "
        f"{where}{others}, by closed forms, "
        f"that of measured oils changes f by {largest}; {GIVE_ALPHA}."
    )


def alpha_of_fit_in_words(effects_of_points: Iterable[Sequence[UnmodelledEffect]]) -> str:
    """Return by how much the range of an estimated pressure-viscosity coefficient changes f at most at the points of a
    fit, whose parameters have this error too, and what to give; "" as of `alpha_of_points_in_words`."""
    largest = max(map(_largest_by_alpha, effects_of_points), default=0.0)
    if not largest:
        return ""
    return (
        "not in the intervals: the error of the pressure-viscosity coefficient, which is an estimate and moves the "
        "fitted parameters; by "
        f"closed forms, that of measured oils changes f by {at_most_in_words(largest)}; give "
        "lubricant.pressure_viscosity_coefficient"
    )


def expected_alpha_in_words(effects: Sequence[ExpectedEffect]) -> str:
    """Return the same before there is a result, from the ``effects`` that are expected at all points; "" where there is
    none."""
    largest = _largest_by_alpha(effects)
    if not largest:
        return ""
    return (
        "the pressure-viscosity coefficient is an estimate, whose error will not be in the interval of f: by closed "
        "forms, that of "
        f"measured oils changes f by {at_most_in_words(largest)}; {GIVE_ALPHA}"
    )


def expected_alpha_at(scene: Scene, speed: float, effects: Sequence[ExpectedEffect]) -> str:
    """Return what the range of an estimated pressure-viscosity coefficient means for f at ``speed`` [m/s], before there
    is a result, and what to do, in two sentences; "" where none of the ``effects`` is of this coefficient."""
    largest = _largest_by_alpha(effects)
    if not largest:
        return ""
    (low, high) = (1e9 * alpha for alpha in _ends_of_alpha(scene))
    return (
        f"the pressure-viscosity coefficient is estimated; measured oils have {low:.3g} to {high:.3g} 1/GPa, and the "
        "interval of f does "
        f"not contain this range. At {speed:.4g} m/s and a peak Hertz pressure of "
        f"{worded(peak_hertz_pressure(scene), 'Pa')} it may change "
        f"f by {at_most_in_words(largest)}, as long as the asperity load ratio is not known; the report states what "
        "remains for "
        "the solved one. Give lubricant.pressure_viscosity_coefficient, from a data sheet or a measurement, to "
        "remove it, or "
        "[value, low, high] to have the change solved and in the interval"
    )


def alpha_beside_interval(effects: Sequence[UnmodelledEffect]) -> str:
    """Return how the range of an estimated pressure-viscosity coefficient changes f in a few words beside the interval
    of f; "" as of `alpha_of_points_in_words`."""
    largest = _largest_by_alpha(effects)
    if not largest:
        return ""
    return (
        "the pressure-viscosity coefficient is estimated, and its range is not in the interval (that of measured "
        "oils changes f by "
        f"{at_most_in_words(largest)})"
    )


def _largest_by_alpha(effects: Sequence[UnmodelledEffect] | Sequence[ExpectedEffect]) -> float:
    """Return the largest change of f by an estimated pressure-viscosity coefficient among the ``effects``; 0 where
    there is none."""
    return max((effect.largest_change for effect in effects if effect.is_of_alpha), default=0.0)


def expected_effects(
    scene: Scene,
    sq: float,
    speed: float,
    *,
    run: Scene | None = None,
    includes_motion: bool = True,
    way_to_motion: str = "",
) -> tuple[ExpectedEffect, ...]:
    """Return the effects that are not modelled at ``speed`` [m/s], before f is known there, each with the range of its
    change of f: that of any result with the asperity load ratio and the shear of `POWERS` and `SHEARS`. The largest is
    first. ``run``, ``includes_motion``, ``way_to_motion``: as in `unmodelled_effects`."""
    of_boundary, f = _parts(scene, sq, speed)
    of_rubbing = scene.bodies.boundary_friction_coefficient if scene.motion.slide_roll_ratio != 0 else 0.0
    share = of_boundary / of_rubbing if of_rubbing else 0.0
    shear = (f - of_boundary) / max(1.0 - share, LEAST_SCALED_SHARE)
    ranges: dict[str, ExpectedEffect] = {}
    for power in POWERS if of_rubbing and speed else (1.0,):
        of_load = share**power
        for more in SHEARS if of_rubbing and speed else (1.0,):
            friction_parts = of_rubbing * of_load, of_rubbing * of_load + more * shear * (1.0 - of_load)
            known_parts = friction_parts if friction_parts[1] > 0 else None
            effects = _all_effects(
                scene, sq, speed, known_parts, run=run, includes_motion=includes_motion, way_to_motion=way_to_motion
            )
            for effect in effects:
                known = ranges.get(effect.what, _at_one_result(effect))
                low = float(np.fmin(known.low, effect.change))
                high = float(np.fmax(known.high, effect.change))
                ranges[effect.what] = replace(known, low=low, high=high, recommendation=effect.recommendation)
    tolerance = scene.numerics.tolerance
    return _largest_first([effect for effect in ranges.values() if not effect.largest_change <= tolerance])


def _at_one_result(effect: UnmodelledEffect) -> ExpectedEffect:
    """Return the ``effect`` with the range that is its one change of f."""
    return ExpectedEffect(
        what=effect.what,
        low=effect.change,
        high=effect.change,
        recommendation=effect.recommendation,
        is_of_alpha=effect.is_of_alpha,
    )


def _all_effects(
    scene: Scene,
    sq: float,
    speed: float,
    friction_parts: tuple[float, float] | None = None,
    *,
    run: Scene | None = None,
    includes_motion: bool,
    way_to_motion: str = "",
) -> list[UnmodelledEffect]:
    """Return all effects, however small; arguments as of `unmodelled_effects`."""
    bodies = scene.bodies
    with_ranges = run or scene
    of_boundary, f = friction_parts or _parts(scene, sq, speed)
    effects: list[UnmodelledEffect] = []
    if speed != 0 and f > 0:
        effects = _of_film(
            scene,
            sq,
            speed,
            friction_parts,
            is_in_time=run is not None,
            includes_motion=includes_motion,
            way_to_motion=way_to_motion or stated_way_to_motion(with_ranges),
        )
    is_stated = (
        any("boundary_friction" in name for name, *_ in with_ranges.ranges)
        or with_ranges.bodies.boundary_friction_table is not None
    )
    if f > 0 and not is_stated:
        effects.append(
            UnmodelledEffect(
                what=f"another additive, a coating or a tribofilm (f_b x {RUBBED:g})",
                change=(RUBBED - 1) * of_boundary / f,
                recommendation="give bodies.boundary_friction_coefficient = [low, high]",
            )
        )
    effects.append(
        UnmodelledEffect(
            what="the edges of the line contact (edge pressure, misalignment)",
            change=2 * bodies.half_width / bodies.width,
            recommendation=(
                "the number is the part of the line within half a contact width of its ends; use a three-dimensional "
                "contact model if the edges matter"
            ),
        )
    )
    return effects


def expected_coefficient(scene: Scene, sq: float, speed: float) -> float:
    """Return the guess of |f| [-] of ``scene`` at ``speed`` [m/s] from closed forms, of which only ratios count;
    ``sq`` [m]: of its surface."""
    return _parts(scene, sq, speed)[1]


def stated_way_to_motion(scene: Scene) -> str:
    """Return what to do so that f of ``scene`` includes the motion of its roughness, or why no model does, as text."""
    if why := why_gap_not_resolved(scene):
        return f"no model includes this motion with {why}"
    return "set numerics.model = 'deterministic' to model this motion"


def _of_film(
    scene: Scene,
    sq: float,
    speed: float,
    friction_parts: tuple[float, float] | None,
    *,
    is_in_time: bool,
    includes_motion: bool,
    way_to_motion: str,
) -> list[UnmodelledEffect]:
    """Return what needs a film."""
    line = scene.line_contact(speed)
    lubricant = scene.lubricant
    thinner = math.exp(-WARMER * (lubricant.temperature_coefficient or TYPICAL[1]))
    warm = scene.with_(lubricant={"oil": None, "viscosity": thinner * lubricant.viscosity})
    reach = line.half_width + flooded_inlet(math.sqrt(2 * line.radius * line.moes_film), line.half_width)
    before = _parts(scene, sq, speed)
    of_rubbing = scene.bodies.boundary_friction_coefficient if scene.motion.slide_roll_ratio != 0 else 0.0
    is_narrow = line.expected_film * 2 * line.radius > line.half_width**2
    is_of_film = (friction_parts or before)[0] < LEAST_ASPERITY_PART * (friction_parts or before)[1]

    by_film: float | None = None  # load sharing follows Aihara's law
    if includes_motion:
        by_film = LOAD_RATIO_IN_MOTION if has_moving_roughness(scene) else LOAD_RATIO_AT_REST

    def change(other: Scene, rough: float, times: float = 1.0) -> float:
        after = _parts(other, rough, speed, times)
        if friction_parts is not None:
            after = _scaled(of_rubbing, before, after, friction_parts, by_film=by_film)
        return after[1] / (friction_parts or before)[1] - 1

    effects: list[UnmodelledEffect] = []
    if lubricant.floods:
        is_unknown = is_narrow and is_of_film  # the rolling part may fall by more
        effects.append(
            UnmodelledEffect(
                what=f"a starved inlet (film x {STARVED_EXAMPLE:g})",
                change=math.nan if is_unknown else change(scene, sq, STARVED_EXAMPLE),
                recommendation=(
                    f"the inlet is flooded if oil reaches {1e3 * reach:.2g} mm ahead of the contact line; if it does "
                    "not, give lubricant.inlet_length"
                ),
            )
        )
    peak = peak_hertz_pressure(scene)
    if lubricant.density_law == "constant" and peak > COMPRESSING_PRESSURE:
        density = float(density_ratio(replace(lubricant, density_law="dowson-higginson"), peak)[0])
        effects.append(
            UnmodelledEffect(
                what=(
                    f"compressibility of the lubricant ({density:.3g} times its density at the peak Hertz pressure: "
                    "film thinner, rolling resistance smaller)"
                ),
                change=change(scene, sq, 1.0 / density),
                recommendation="set lubricant.density_law = 'dowson-higginson'",
            )
        )
    if ends := _ends_of_alpha(scene):
        by_alpha = [
            _bound_by_alpha(scene, sq, speed, alpha, friction_parts or before, of_rubbing=of_rubbing, by_film=by_film)
            for alpha in ends
        ]
        effects.append(
            UnmodelledEffect(
                what=(
                    f"a pressure-viscosity coefficient of {1e9 * ends[0]:.3g} to {1e9 * ends[1]:.3g} 1/GPa, the "
                    "range of measured oils, "
                    "in place of the estimate"
                ),
                change=max(by_alpha),
                recommendation=GIVE_ALPHA_IN_TIME if is_in_time else GIVE_ALPHA,
                is_of_alpha=True,
            )
        )
    effects.append(
        UnmodelledEffect(
            what=f"oil in the inlet {WARMER:g} K warmer than the given temperature",
            change=change(warm, sq),
            recommendation="give lubricant.temperature at the inlet of the contact",
        )
    )
    if sq > 0:
        effects.append(
            UnmodelledEffect(
                what=f"running-in of the surface (Sq x {WORN:g})",
                change=change(scene, WORN * sq),
                recommendation="give a height map measured after running-in, or use lubfric.run_in",
            )
        )
        (least, most) = MIXED
        of_asperities = (friction_parts or before)[0]
        is_thin = line.expected_film < FILM_THAT_HIDES_ROUGHNESS * sq
        is_mixed = least * of_rubbing < of_asperities < most * of_rubbing
        if includes_motion and has_moving_roughness(scene) and is_thin:
            is_mixed = of_asperities < most * of_rubbing or not of_rubbing  # the film follows the roughness there
        if has_generated_roughness(scene) and is_mixed:
            effects.append(
                UnmodelledEffect(
                    what="half or twice the correlation length of the roughness, which no drawing states",
                    change=math.nan,
                    recommendation=(
                        "give a measured height map, or vary surface.correlation_length in a study; under heavy "
                        "loads it may change f by "
                        "more than its interval"
                    ),
                )
            )
        if has_moving_roughness(scene) and not includes_motion and is_thin:
            effects.append(
                UnmodelledEffect(
                    what="motion of the roughness through the contact",
                    change=math.nan,
                    recommendation=way_to_motion,
                )
            )
    if scene.bodies.e_prime < SOFT_E_PRIME:
        effects.append(
            UnmodelledEffect(
                what="a thin soft cover, and its damping",
                change=math.nan,
                recommendation=(
                    "the body is modelled as solid; if it is a cover thinner than "
                    f"{1e3 * DEEP * line.half_width:.2g} mm, "
                    "give e_prime such that the contact is as wide as measured"
                ),
            )
        )
    return effects


def _ends_of_alpha(scene: Scene) -> tuple[float, ...]:
    """Return the least and the largest pressure-viscosity coefficient [1/Pa] of measured oils; () where the coefficient
    is given."""
    lubricant = scene.lubricant
    if lubricant.oil is None or lubricant.temperature is None:
        return ()
    alpha = lubricant.oil.pressure_viscosity_coefficient(lubricant.temperature)
    return () if alpha.low == alpha.high else (alpha.low, alpha.high)


def _bound_by_alpha(
    scene: Scene,
    sq: float,
    speed: float,
    alpha: float,
    friction_parts: tuple[float, float],
    *,
    of_rubbing: float,
    by_film: float | None,
) -> float:
    """Return a bound of the relative change of f, either way, by another pressure-viscosity coefficient ``alpha``
    [1/Pa].

    A larger one makes the film thicker, so that asperities carry less, and raises the shear stress of the film. These
    two changes of f have opposite signs, so the larger one bounds what is left of them; which one is larger, closed
    forms do not show. The shear is at most that of the closed form, unless that of the result is larger.
    """
    before = _parts(scene, sq, speed)
    after = _parts(scene.with_(lubricant={"pressure_viscosity_coefficient": alpha}), sq, speed)
    f = friction_parts[1]
    if not of_rubbing:
        return abs(after[1] / before[1] - 1)
    shares = [_within(parts[0] / of_rubbing) for parts in (before, after, friction_parts)]
    thin, thick, there = shares
    if by_film is None:
        other = _within(math.exp(math.log(there) * math.log(thick) / math.log(thin)))
    else:
        log_of_film = math.log(math.log(thick) / math.log(thin)) / AIHARA_POWER
        growth = math.log(alpha / scene.lubricant.pressure_viscosity_coefficient)
        other = _with_load_ratio(there, by_film * log_of_film + LOAD_RATIO_BY_ALPHA * growth)
    (guessed, changed, shear) = (
        max(parts[1] - parts[0], 0.0) / (1 - share) for parts, share in zip((before, after, friction_parts), shares)
    )
    other_shear = min(shear * changed / guessed, max(changed, shear)) if guessed else shear
    by_load = (of_rubbing - shear) * (other - there)
    by_shear = (other_shear - shear) * (1 - there)
    return max(abs(by_load), abs(by_shear)) / f


def _within(share: float) -> float:
    """Return the ``share`` of asperities or film of the load, not closer to 0 and 1 than `LEAST_SCALED_SHARE`."""
    return min(max(share, LEAST_SCALED_SHARE), 1 - LEAST_SCALED_SHARE)


def _with_load_ratio(share: float, growth: float) -> float:
    """Return the ``share`` s of asperities whose ln s/(1 - s) is larger by ``growth``."""
    return 1.0 / (1.0 + (1.0 / share - 1.0) * math.exp(-growth))


def _scaled(
    f_b: float,
    before: tuple[float, float],
    after: tuple[float, float],
    friction_parts: tuple[float, float],
    *,
    by_film: float | None,
) -> tuple[float, float]:
    """Return the parts ``after``, as changes from the guess ``before`` to the ``friction_parts`` of a result: the share
    by Aihara's law with the λ that gives it there, or s/(1 - s) by the power ``by_film`` of λ; and mu in proportion."""
    if not f_b:
        return 0.0, after[1] / before[1] * friction_parts[1]
    shares = [_within(parts[0] / f_b) for parts in (before, after, friction_parts)]
    (guessed, changed, there) = (math.log(1 / share) for share in shares)
    share = math.exp(-there * changed / guessed)
    if by_film is not None:
        log_of_film = math.log(changed / guessed) / AIHARA_POWER
        share = _with_load_ratio(shares[2], by_film * log_of_film)
    shears = [max(parts[1] - parts[0], 0.0) / (1 - s) for parts, s in zip((before, after, friction_parts), shares)]
    shear = shears[2] * shears[1] / shears[0] if shears[0] else 0.0
    return f_b * share, f_b * share + shear * (1 - share)


def _parts(scene: Scene, sq: float, speed: float, times: float = 1.0) -> tuple[float, float]:
    """Return the friction [-] of asperities alone and of all, to some ten per cent, at so many ``times`` the expected
    film."""
    bodies = scene.bodies
    ratio = scene.motion.slide_roll_ratio
    of_rubbing = bodies.boundary_friction_coefficient if ratio != 0 else 0.0
    if speed == 0:
        return of_rubbing, of_rubbing
    line = scene.line_contact(speed)
    thickness = times * line.expected_film
    b = line.half_width
    share = math.exp(-AIHARA_FACTOR * (thickness / sq) ** AIHARA_POWER) if sq > 0 else 0.0
    rise = math.sqrt(2 * line.radius * thickness)
    begins = b + UPSTREAM * rise
    if times < 1:
        begins = min(begins, starved_inlet(times, math.sqrt(2 * line.radius * line.expected_film), b))
    x = np.linspace(-begins, b + REYNOLDS_RUPTURE * rise, STRIP_NODES)
    shape = line.load_per_width, line.radius, line.e_prime
    least = math.hypot(smallest_film(thickness, rise, b), GAP_IN_CONTACT * sq)
    gap = least + hertz.line_gap(x, *shape)
    with np.errstate(over="ignore"):
        pressure = hertz.line_pressure(x, *shape)
        stress = shear_stress(scene.lubricant, pressure, abs(ratio * speed) / gap)
    rolling = 6 * scene.lubricant.viscosity * abs(speed) * (1 / gap - max(thickness, least) / gap**2)
    mu = float(np.trapezoid(np.minimum(stress, carried_stress(pressure)) + rolling, x)) / line.load_per_width
    return of_rubbing * share, of_rubbing * share + mu * (1 - share)


def expected_typical_heat(scene: Scene, sq: float, speed: float) -> float:
    """Return the largest part of f that the heat of the film would take away at ``speed`` [m/s] if the viscosity fell
    with the temperature as that of a typical oil, before f is known; ``sq`` [m]: of the surface. 0 where the lubricant
    says how it falls."""
    if speed == 0:
        return 0.0
    lost = typical_heat_of_even_film(scene, speed, scene.line_contact(abs(speed)).expected_film)
    if not lost > 0:
        return 0.0
    of_boundary, f = _parts(scene, sq, speed)
    f_b = scene.bodies.boundary_friction_coefficient
    wet = 1.0 - (of_boundary / f_b if f_b else 0.0)
    return min(wet * lost / f, 1.0)


def effect_in_words(effect: UnmodelledEffect | ExpectedEffect) -> str:
    """Return the effect in one line: what it is, the change of f to two digits, what to do."""
    return f"{effect.what}: f {effect.change_in_words}; {effect.recommendation}"


def change_in_words(low: float, high: float | None = None) -> str:
    """Return a change of f in percent to two digits, or the range of one: "+4.2 %", "+4 to +27 %"."""
    if math.isnan(low):
        return "not estimated"
    ends = dict.fromkeys(f"{_signed(change)}" for change in (low, low if high is None else high))
    return f"{' to '.join(ends)} %"


def at_most_in_words(change: float) -> str:
    """Return the largest change of f either way in percent, to two digits."""
    return f"at most about {percent(change)} either way"


def _signed(change: float) -> str:
    """Return a change in percent with its sign, to two digits; "0" for what rounds to nothing."""
    percentage = 100 * change
    text = f"{percentage:+.0f}" if abs(percentage) >= 99.5 else f"{percentage:+.2g}"
    return "0" if abs(percentage) < 0.005 else text
