"""Effects that are not modelled, and by how much f would likely change: `unmodelled_effects` of a result, and
`expected_effects` before there is one, from the closed forms of `Guess` alone.

Before there is a result, its asperity load ratio and its shear have a range (`POWERS`, `SHEARS`), and so has the change
of f: it holds that of the result by any model.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TypeVar

import numpy as np

from ...film import LineContact, flooded_inlet
from ...oil import density_ratio
from ...scene import LENGTH_KEYS, Scene, has_generated_roughness, has_moving_roughness, why_gap_not_resolved
from .checks import peak_hertz_pressure
from .guessed_friction import FrictionParts, Guess, guessed_parts, parts_together
from .heat import TYPICAL
from .wording import percent

# Film thickness in the example of a starved inlet, over that of a flooded inlet [-]. A convention, not measured.
STARVED_EXAMPLE = 0.7

# Sq after running-in over that before, of the example. Not measured: `lubfric.run_in` computes it for a scene.
WORN = 0.6

# Temperature rise of the oil in the inlet [K] of the example. A convention, not measured.
WARMER = 10.0

# f_b with another additive over that of the scene, of the example. A convention, not measured.
RUBBED = 0.75

# Film over Sq from which the motion of roughness has little effect. A choice: the lambda ratio of full-film
# lubrication.
FILM_THAT_HIDES_ROUGHNESS = 3.0

# E' [Pa] below which a body is a covered roller or a seal. A choice, between polymers and metals.
SOFT_E_PRIME = 5e9

# Half-widths of the Hertz strip that a cover must be thick to count as a half-space. A choice: the stress of a line
# contact falls with the depth, to .2 of its largest there.
DEEP = 5.0

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

# What to do about the pressure-viscosity coefficients of measured oils where that of the scene is an estimate.
GIVE_ALPHA = (
    "give lubricant.pressure_viscosity_coefficient = [value, low, high], whose effect is solved and in the interval"
)

# This recommendation for a run in time, whose interval contains no such range.
GIVE_ALPHA_IN_TIME = "give lubricant.pressure_viscosity_coefficient; the interval of f does not contain this change"

# What to do about the correlation length of generated roughness.
GIVE_LENGTH = (
    "give a measured height map, or surface.correlation_length = [value, low, high], whose effect is solved and in the "
    "interval"
)

# This recommendation for a run in time, whose interval contains no such range.
GIVE_LENGTH_IN_TIME = "give a measured height map; the interval of f does not contain this change"

# The `UnmodelledEffect.kind` of the correlation length.
BY_LENGTH = "correlation_length"

# Powers of the estimated s between which the s of a result lies, and 0: the built-in contact, by three models, has
# powers of 0.17 to 1.7 at Λ from 0.3 to 1.7, and moving roughness by the deterministic model next to no load on
# asperities. A margin is added.
POWERS = (0.12, 0.4, 1.0, 2.5, math.inf)

# Factors on the estimated mu between which the mu of a result may lie [-]. A choice: a factor of 2.
SHEARS = (0.5, 1.0, 2.0)


@dataclass(frozen=True, kw_only=True)
class UnmodelledEffect:
    """An effect that is not modelled.

    Attributes
    ----------
    what : the effect, as text
    change : likely change of f, relative [-]; NaN where it is not known
    other_change : the same of an effect that may go either way, the other way; None: it goes one way
    recommendation : what to do
    is_of_alpha : whether it is that of an estimated pressure-viscosity coefficient: then the change is the largest one
        either way
    kind : which effect it is, where ``what`` has numbers of the moment; "": ``what`` says so
    is_of_measured_alpha : whether that coefficient is measured for the oil, and the change is by its range
    """

    what: str
    change: float
    recommendation: str
    is_of_alpha: bool = False
    kind: str = ""
    other_change: float | None = None
    is_of_measured_alpha: bool = False

    @property
    def changes(self) -> tuple[float, ...]:
        """The change of f, and the other one if there is one."""
        return (self.change,) if self.other_change is None else (self.change, self.other_change)

    @property
    def change_in_words(self) -> str:
        """The change of f as text."""
        return at_most_in_words(self.change) if self.is_of_alpha else change_in_words(*self.changes)

    @property
    def largest_change(self) -> float:
        """The largest change of f without its sign; NaN where it is not known."""
        return max(abs(float(change)) for change in self.changes)


@dataclass(frozen=True, kw_only=True)
class ExpectedEffect:
    """An effect that is not modelled, before there is a result.

    Attributes
    ----------
    what, recommendation, is_of_alpha, kind, is_of_measured_alpha : as of `UnmodelledEffect`
    low, high : lowest and highest change of f, relative [-]; NaN where they are not known
    """

    what: str
    low: float
    high: float
    recommendation: str
    is_of_alpha: bool = False
    kind: str = ""
    is_of_measured_alpha: bool = False

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


@dataclass(frozen=True, kw_only=True)
class _Point:
    """An operating point whose effects are found (`_possible_effects`).

    Attributes
    ----------
    guess : of f there, with the scene, Sq and the speed
    with_ranges : the scene of the run in time, which holds the ranges and tables that a moment has not; else the scene
    is_in_time : whether the point is a moment of a run in time
    includes_motion : whether the model has the motion of the roughness
    way_to_motion : what to do to include it, as text
    """

    guess: Guess
    with_ranges: Scene
    is_in_time: bool
    includes_motion: bool
    way_to_motion: str

    @property
    def scene(self) -> Scene:
        """The scene of the point."""
        return self.guess.scene

    @cached_property
    def line(self) -> LineContact:
        """The smooth line contact."""
        return self.scene.line_contact(self.guess.speed)

    @property
    def is_thin(self) -> bool:
        """Whether the motion of the roughness changes the film."""
        return self.line.expected_film < FILM_THAT_HIDES_ROUGHNESS * self.guess.sq

    def parts(self, result: FrictionParts | None) -> FrictionParts:
        """Return the parts of f of the ``result``, or of the guess."""
        return result or self.guess.parts

    def change_to(
        self, other: Scene, *, sq: float | None = None, times: float = 1.0
    ) -> Callable[[FrictionParts | None], float]:
        """Return the relative change of f to an ``other`` scene, or Sq (``sq`` [m]), or at so many ``times`` the film;
        as a function of the result."""
        after = guessed_parts(other, self.guess.sq if sq is None else sq, self.guess.speed, times)
        return lambda result: self.guess.change(after, result)


@dataclass(frozen=True, kw_only=True)
class _PossibleEffect:
    """An effect, whose ``change`` of f depends on the result: None where it has none. So does ``other_change``, that
    the other way. The others are those of `UnmodelledEffect`."""

    what: str
    change: Callable[[FrictionParts | None], float | None]
    recommendation: str
    is_of_alpha: bool = False
    kind: str = ""
    other_change: Callable[[FrictionParts | None], float | None] = lambda result: None
    is_of_measured_alpha: bool = False

    def at(self, result: FrictionParts | None) -> UnmodelledEffect | None:
        """Return the effect on a ``result``."""
        change = self.change(result)
        if change is None:
            return None
        return UnmodelledEffect(
            what=self.what,
            change=change,
            other_change=self.other_change(result),
            recommendation=self.recommendation,
            is_of_alpha=self.is_of_alpha,
            kind=self.kind,
            is_of_measured_alpha=self.is_of_measured_alpha,
        )


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
    point = _point(scene, sq, speed, run=run, includes_motion=includes_motion, way_to_motion=way_to_motion)
    result = None if friction_parts is None else FrictionParts(*friction_parts)
    effects = (effect.at(result) for effect in _possible_effects(point, point.parts(result).of_all))
    return _largest_first([effect for effect in effects if effect is not None], scene.numerics.tolerance)


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
    point = _point(scene, sq, speed, run=run, includes_motion=includes_motion, way_to_motion=way_to_motion)
    results = list(_expected_results(point.guess))
    effects = []
    for possible in _possible_effects(point, point.guess.parts.of_all):
        ways = (possible.change, possible.other_change)
        changes = [change for way in ways for change in map(way, results) if change is not None]
        if changes:
            effects.append(
                ExpectedEffect(
                    what=possible.what,
                    low=float(np.fmin.reduce(changes)),
                    high=float(np.fmax.reduce(changes)),
                    recommendation=possible.recommendation,
                    is_of_alpha=possible.is_of_alpha,
                    kind=possible.kind,
                    is_of_measured_alpha=possible.is_of_measured_alpha,
                )
            )
    return _largest_first(effects, scene.numerics.tolerance)


def _expected_results(guess: Guess) -> Iterator[FrictionParts | None]:
    """Yield the parts of f between which those of a result lie; None, for the guess itself, where they are 0."""
    varies = guess.of_rubbing > 0 and guess.speed != 0
    for power in POWERS if varies else (1.0,):
        for more in SHEARS if varies else (1.0,):
            parts = parts_together(guess.of_rubbing, guess.share**power, more * guess.shear)
            yield parts if parts.of_all > 0 else None


def _largest_first(effects: list[AnyEffect], tolerance: float) -> tuple[AnyEffect, ...]:
    """Return the ``effects`` above the ``tolerance`` with the largest change of f first; what is not known is last."""
    notable = [effect for effect in effects if not effect.largest_change <= tolerance]
    return tuple(sorted(notable, key=lambda each: -each.largest_change if math.isfinite(each.changes[0]) else 0.0))


def stated_way_to_motion(scene: Scene) -> str:
    """Return what to do so that f of ``scene`` includes the motion of its roughness, or why no model does, as text."""
    if why := why_gap_not_resolved(scene):
        return f"no model includes this motion with {why}"
    return "set numerics.model = 'deterministic' to model this motion"


def _point(
    scene: Scene, sq: float, speed: float, *, run: Scene | None, includes_motion: bool, way_to_motion: str
) -> _Point:
    """Return the point of the arguments of `unmodelled_effects`."""
    with_ranges = run or scene
    return _Point(
        guess=Guess(scene=scene, sq=sq, speed=speed, resolves_gap=includes_motion),
        with_ranges=with_ranges,
        is_in_time=run is not None,
        includes_motion=includes_motion,
        way_to_motion=way_to_motion or stated_way_to_motion(with_ranges),
    )


def _possible_effects(point: _Point, friction: float) -> Iterator[_PossibleEffect]:
    """Yield the effects that a ``point`` with this ``friction`` may have, however small."""
    has_film = point.guess.speed != 0 and friction > 0
    for find in (*EFFECTS_OF_FILM, *EFFECTS_OF_BODIES) if has_film else EFFECTS_OF_BODIES:
        effect = find(point)
        if effect is not None:
            yield effect


def _starved_inlet(point: _Point) -> _PossibleEffect | None:
    if not point.scene.lubricant.floods:
        return None
    line = point.line
    reach = line.half_width + flooded_inlet(math.sqrt(2 * line.radius * line.moes_film), line.half_width)
    is_narrow = line.expected_film * 2 * line.radius > line.half_width**2
    change = point.change_to(point.scene, times=STARVED_EXAMPLE)

    def known_change(result: FrictionParts | None) -> float:
        parts = point.parts(result)
        is_of_film = parts.of_asperities < LEAST_ASPERITY_PART * parts.of_all
        return math.nan if is_narrow and is_of_film else change(result)  # the rolling part may fall by more

    return _PossibleEffect(
        what=f"a starved inlet (film x {STARVED_EXAMPLE:g})",
        change=known_change,
        recommendation=(
            f"the inlet is flooded if oil reaches {1e3 * reach:.2g} mm ahead of the contact line; if it does not, give "
            "lubricant.inlet_length"
        ),
    )


def _compressibility(point: _Point) -> _PossibleEffect | None:
    lubricant = point.scene.lubricant
    peak = peak_hertz_pressure(point.scene)
    if lubricant.density_law != "constant" or peak <= COMPRESSING_PRESSURE:
        return None
    density = float(density_ratio(replace(lubricant, density_law="dowson-higginson"), peak)[0])
    return _PossibleEffect(
        what=(
            f"compressibility of the lubricant ({density:.3g} times its density at the peak Hertz pressure: film "
            "thinner, rolling resistance smaller)"
        ),
        change=point.change_to(point.scene, times=1.0 / density),
        recommendation="set lubricant.density_law = 'dowson-higginson'",
        kind="compressibility",
    )


def _estimated_alpha(point: _Point) -> _PossibleEffect | None:
    guess = point.guess
    scene = point.scene
    ends = ends_of_alpha(scene)
    if not ends:
        return None
    after = {
        alpha: guessed_parts(scene.with_(lubricant={"pressure_viscosity_coefficient": alpha}), guess.sq, guess.speed)
        for alpha in ends
    }
    is_measured = is_alpha_measured(scene)
    of_which = (
        "the range of its measurements" if is_measured else "the range of measured oils, in place of the estimate"
    )
    return _PossibleEffect(
        what=f"a pressure-viscosity coefficient of {1e9 * ends[0]:.3g} to {1e9 * ends[1]:.3g} 1/GPa, {of_which}",
        change=lambda result: max(guess.bound_by_alpha(parts, result, alpha) for alpha, parts in after.items()),
        recommendation=GIVE_ALPHA_IN_TIME if point.is_in_time else GIVE_ALPHA,
        is_of_alpha=True,
        is_of_measured_alpha=is_measured,
    )


def _warmer_inlet(point: _Point) -> _PossibleEffect:
    lubricant = point.scene.lubricant
    thinner = math.exp(-WARMER * (lubricant.temperature_coefficient or TYPICAL[1]))
    warm = point.scene.with_(lubricant={"oil": None, "viscosity": thinner * lubricant.viscosity})
    return _PossibleEffect(
        what=f"oil in the inlet {WARMER:g} K warmer than the given temperature",
        change=point.change_to(warm),
        recommendation="give lubricant.temperature at the inlet of the contact",
    )


def _running_in(point: _Point) -> _PossibleEffect | None:
    if point.guess.sq == 0:
        return None
    return _PossibleEffect(
        what=f"running-in of the surface (Sq x {WORN:g})",
        change=point.change_to(point.scene, sq=WORN * point.guess.sq),
        recommendation="give a height map measured after running-in, or use lubfric.run_in",
    )


def _correlation_length(point: _Point) -> _PossibleEffect | None:
    scene = point.scene
    if point.guess.sq == 0 or not has_generated_roughness(scene):
        return None
    if not point.is_in_time and any(name in LENGTH_KEYS for name, *_ in point.with_ranges.ranges):
        return None  # it is in the interval
    of_rubbing = point.guess.of_rubbing
    (least, most) = MIXED
    follows_roughness = point.includes_motion and has_moving_roughness(scene) and point.is_thin  # of the film

    def change_if_mixed(times: float, result: FrictionParts | None) -> float | None:
        of_asperities = point.parts(result).of_asperities
        if least * of_rubbing < of_asperities < most * of_rubbing:
            return point.guess.change_by_length(times, result)
        is_of_film = of_asperities <= least * of_rubbing
        return math.nan if follows_roughness and is_of_film else None

    return _PossibleEffect(
        what="half or twice the correlation length of the roughness, which no drawing states",
        change=partial(change_if_mixed, 0.5),
        other_change=partial(change_if_mixed, 2.0),
        recommendation=GIVE_LENGTH_IN_TIME if point.is_in_time else GIVE_LENGTH,
        kind=BY_LENGTH,
    )


def _motion_of_roughness(point: _Point) -> _PossibleEffect | None:
    if point.guess.sq == 0 or point.includes_motion or not has_moving_roughness(point.scene) or not point.is_thin:
        return None
    return _PossibleEffect(
        what="motion of the roughness through the contact",
        change=lambda result: math.nan,
        recommendation=point.way_to_motion,
    )


def _soft_cover(point: _Point) -> _PossibleEffect | None:
    if point.scene.bodies.e_prime >= SOFT_E_PRIME:
        return None
    return _PossibleEffect(
        what="a thin soft cover, and its damping",
        change=lambda result: math.nan,
        recommendation=(
            "the body is modelled as solid; if it is a cover thinner than "
            f"{1e3 * DEEP * point.line.half_width:.2g} mm, give e_prime such that the contact is as wide as measured"
        ),
    )


def _another_additive(point: _Point) -> _PossibleEffect | None:
    given = point.with_ranges
    has_range = any("boundary_friction" in name for name, *_ in given.ranges)
    if has_range or given.bodies.boundary_friction_table is not None:
        return None

    def change(result: FrictionParts | None) -> float | None:
        parts = point.parts(result)
        return (RUBBED - 1) * parts.of_asperities / parts.of_all if parts.of_all > 0 else None

    return _PossibleEffect(
        what=f"another additive, a coating or a tribofilm (f_b x {RUBBED:g})",
        change=change,
        recommendation="give bodies.boundary_friction_coefficient = [low, high]",
    )


def _edges(point: _Point) -> _PossibleEffect:
    bodies = point.scene.bodies
    part = 2 * bodies.half_width / bodies.width
    return _PossibleEffect(
        what="the edges of the line contact (edge pressure, misalignment)",
        change=lambda result: part,
        recommendation=(
            "the number is the part of the line within half a contact width of its ends; use a three-dimensional "
            "contact model if the edges matter"
        ),
    )


# What finds the effects that need a film, and the others.
EFFECTS_OF_FILM = (
    _starved_inlet,
    _compressibility,
    _estimated_alpha,
    _warmer_inlet,
    _running_in,
    _correlation_length,
    _motion_of_roughness,
    _soft_cover,
)
EFFECTS_OF_BODIES = (_another_additive, _edges)


def is_alpha_measured(scene: Scene) -> bool:
    """Return whether the pressure-viscosity coefficient is that of measurements of the oil."""
    return scene.lubricant.oil is not None and scene.lubricant.oil.is_coefficient_measured


def ends_of_alpha(scene: Scene) -> tuple[float, ...]:
    """Return the least and the largest pressure-viscosity coefficient [1/Pa] of measured oils; () where the coefficient
    is given."""
    lubricant = scene.lubricant
    if lubricant.oil is None or lubricant.temperature is None:
        return ()
    alpha = lubricant.oil.pressure_viscosity_coefficient(lubricant.temperature)
    return () if alpha.low == alpha.high else (alpha.low, alpha.high)


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
