"""A guess of f from closed forms, of which only ratios count: by how much f changes with an input, where nothing is
solved.

f is guessed as ``f_b s + mu (1 - s)``. The share s = exp(-1.8 λ^1.2) of the load on the asperities (Aihara's law, one
of the measured ones, which lie within a factor of two of each other) is that at λ, the expected film of the total load
over Sq. mu is the shear of that film in the gap of a dry contact, or of one as thick as the gap of rough surfaces,
under the Hertz pressure, with the resistance of its inlet to rolling. Where a result is known, mu is scaled to what it
has; s follows Aihara's law from what it has by load sharing, and by models of the resolved gap s/(1 - s) follows a
power of λ that solved contacts show.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...film import hertz, smallest_film, starved_inlet
from ...oil import carried_stress, shear_stress
from ...scene import Scene, has_moving_roughness
from .checks_before import STRIP_NODES
from .heat import typical_heat_of_even_film

# Aihara's law of the asperity load ratio: exp(-`AIHARA_FACTOR` λ^`AIHARA_POWER`). As printed by the sources of
# docs/theory.md.
AIHARA_FACTOR = 1.8
AIHARA_POWER = 1.2

# Power of λ with which the load on asperities over that on the film changes, where roughness rests and where it moves
# [-]. Fitted with the pressure-viscosity coefficient times the pressure to 237 and 209 contacts solved by the
# deterministic model (verification.campaigns.calibration): -3.47 ± .17 and -2.72 ± .15.
LOAD_RATIO_AT_REST = -3.5
LOAD_RATIO_IN_MOTION = -2.7

# Power of the pressure-viscosity coefficient with which the load on asperities over that on the film falls at a given
# film [-]: asperities press the film between them far above the Hertz pressure. A choice: with it the bound holds at 23
# contacts, at rest and rolling, of Λ from 0.02 to 6, solved by the quick model with both ends of the range; where they
# change f by 1 % or more, it is 1.1 to 15 times the change.
LOAD_RATIO_BY_ALPHA = -1.0

# Power of the correlation length of the roughness with which the load on asperities over that on the film changes [-].
# A choice between the means of 42 changes at rest, -0.9 ± .2, and of 35 in motion, -1.3 ± .2, to half and to twice the
# length, of random contacts solved by the quick model (``verification.campaigns.calibration lengths``). The 50 solved
# changes of f above 5 % have the sign of those that it gives; half are 0.9 to 1.9 times, nine in ten 0.4 to 5.6 times as
# large.
LOAD_RATIO_BY_LENGTH = -1.2

# Mean gap of a contact that carries most of the load [Sq], about: measured 1.67 in the scene "paper" at 1 mm/s.
GAP_IN_CONTACT = 1.6

# Least share of asperities or film of the load that is scaled to that of a result. A choice, against a division by 0.
LEAST_SCALED_SHARE = 1e-6

# Distance that a film reaches before a narrow contact, in sqrt(2 R h): the pressure of a rigid one has fallen to 4 % of
# its largest there. A choice: a smaller value cuts the film off.
UPSTREAM = 4.0

# Distance that a film reaches behind a narrow contact, in sqrt(2 R h), by Reynolds' condition on a rigid cylinder. It
# follows from Reynolds' equation (Swift-Stieber).
REYNOLDS_RUPTURE = 0.475


class FrictionParts(NamedTuple):
    """The friction coefficient [-] that asperities alone make, and that of all."""

    of_asperities: float
    of_all: float


def expected_coefficient(scene: Scene, sq: float, speed: float) -> float:
    """Return the guess of |f| [-] of ``scene`` at ``speed`` [m/s] from closed forms, of which only ratios count;
    ``sq`` [m]: of its surface."""
    return guessed_parts(scene, sq, speed).of_all


def expected_typical_heat(scene: Scene, sq: float, speed: float) -> float:
    """Return the largest part of f that the heat of the film would take away at ``speed`` [m/s] if the viscosity fell
    with the temperature as that of a typical oil, before f is known; ``sq`` [m]: of the surface. 0 where the lubricant
    says how it falls."""
    if speed == 0:
        return 0.0
    lost = typical_heat_of_even_film(scene, speed, scene.line_contact(abs(speed)).expected_film)
    if not lost > 0:
        return 0.0
    parts = guessed_parts(scene, sq, speed)
    f_b = scene.bodies.boundary_friction_coefficient
    wet = 1.0 - (parts.of_asperities / f_b if f_b else 0.0)
    return min(wet * lost / parts.of_all, 1.0)


def rubbing_coefficient(scene: Scene) -> float:
    """Return the friction coefficient [-] of what rubs: f_b, or 0 where nothing slides."""
    return scene.bodies.boundary_friction_coefficient if scene.motion.slide_roll_ratio != 0 else 0.0


def guessed_parts(scene: Scene, sq: float, speed: float, times: float = 1.0) -> FrictionParts:
    """Return the friction of ``scene`` at ``speed`` [m/s], to some ten per cent, at so many ``times`` the expected
    film; ``sq`` [m]: of its surface."""
    of_rubbing = rubbing_coefficient(scene)
    if speed == 0:
        return FrictionParts(of_rubbing, of_rubbing)
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
        stress = shear_stress(scene.lubricant, pressure, abs(scene.motion.slide_roll_ratio * speed) / gap)
    rolling = 6 * scene.lubricant.viscosity * abs(speed) * (1 / gap - max(thickness, least) / gap**2)
    mu = float(np.trapezoid(np.minimum(stress, carried_stress(pressure)) + rolling, x)) / line.load_per_width
    return parts_together(of_rubbing, share, mu)


def parts_together(of_rubbing: float, share: float, shear: float) -> FrictionParts:
    """Return the friction of asperities that carry this ``share`` of the load and rub with the coefficient
    ``of_rubbing``, beside a film of the coefficient ``shear``."""
    of_asperities = of_rubbing * share
    return FrictionParts(of_asperities, of_asperities + shear * (1.0 - share))


@dataclass(frozen=True, kw_only=True)
class Guess:
    """The guess of f at a point, and how f of a result there would change.

    Attributes
    ----------
    scene, sq, speed : the scene, Sq of its surface [m], and the speed [m/s]
    resolves_gap : whether the result is that of a model of the resolved gap, whose s/(1 - s) follows a power of λ;
        otherwise s follows Aihara's law
    """

    scene: Scene
    sq: float
    speed: float
    resolves_gap: bool

    @cached_property
    def parts(self) -> FrictionParts:
        """The parts of f."""
        return guessed_parts(self.scene, self.sq, self.speed)

    @cached_property
    def of_rubbing(self) -> float:
        """The friction coefficient of what rubs [-]."""
        return rubbing_coefficient(self.scene)

    @property
    def share(self) -> float:
        """The share of the load on asperities [-]."""
        return self.parts.of_asperities / self.of_rubbing if self.of_rubbing else 0.0

    @property
    def shear(self) -> float:
        """The friction coefficient of the film [-]."""
        return (self.parts.of_all - self.parts.of_asperities) / max(1.0 - self.share, LEAST_SCALED_SHARE)

    def change(self, after: FrictionParts, result: FrictionParts | None) -> float:
        """Return the relative change of f where the guess becomes ``after``: of a ``result``, or of the guess."""
        if result is None or not self.of_rubbing:
            return after.of_all / self.parts.of_all - 1
        shares = self._shares(after, result)
        (guessed, changed, shear) = self._shears(after, result, shares)
        other_shear = shear * changed / guessed if guessed else 0.0
        return parts_together(self.of_rubbing, self._share_after(shares), other_shear).of_all / result.of_all - 1

    def bound_by_alpha(self, after: FrictionParts, result: FrictionParts | None, alpha: float) -> float:
        """Return a bound of that change, either way, by another pressure-viscosity coefficient ``alpha`` [1/Pa].

        A larger one makes the film thicker, so that asperities carry less, and raises the shear stress of the film.
        These two changes of f have opposite signs, so the larger one bounds what is left of them; which one is larger,
        closed forms do not show. Of 29 random films that carry the load alone, with an Eyring or a limiting stress, it is
        0.91 to 1.8 times the larger change that was solved, and once 0.55 times one of 46 %.
        """
        if not self.of_rubbing:
            return abs(after.of_all / self.parts.of_all - 1)
        known = result or self.parts
        shares = self._shares(after, known)
        there = shares[-1]
        growth = math.log(alpha / self.scene.lubricant.pressure_viscosity_coefficient)
        other = self._share_after(shares, LOAD_RATIO_BY_ALPHA * growth)
        (guessed, changed, shear) = self._shears(after, known, shares)
        other_shear = shear * changed / guessed if guessed else shear
        by_load = (self.of_rubbing - shear) * (other - there)
        by_shear = (other_shear - shear) * (1 - there)
        return max(abs(by_load), abs(by_shear)) / known.of_all

    def change_by_length(self, times: float, result: FrictionParts | None) -> float:
        """Return the relative change of f where the correlation length of the roughness is so many ``times`` as long:
        of a ``result``, or of the guess. The shear of the film remains."""
        known = result or self.parts
        share = _within(known.of_asperities / self.of_rubbing)
        shear = max(known.of_all - known.of_asperities, 0.0) / (1 - share)
        other = _with_load_ratio(share, LOAD_RATIO_BY_LENGTH * math.log(times))
        return parts_together(self.of_rubbing, other, shear).of_all / known.of_all - 1

    def _shares(self, after: FrictionParts, known: FrictionParts) -> list[float]:
        """Return the shares of the load on asperities: of the guess, ``after`` the change, and of what is ``known``."""
        return [_within(parts.of_asperities / self.of_rubbing) for parts in (self.parts, after, known)]

    def _shears(self, after: FrictionParts, known: FrictionParts, shares: list[float]) -> list[float]:
        """Return the friction coefficients of the film [-] of the same, whose ``shares`` are given."""
        return [
            max(parts.of_all - parts.of_asperities, 0.0) / (1 - share)
            for parts, share in zip((self.parts, after, known), shares)
        ]

    def _share_after(self, shares: list[float], growth: float = 0.0) -> float:
        """Return the share of the load on asperities after the change, of what is known; ``growth``: of ln s/(1 - s)
        at the same film, where the gap is resolved."""
        (guessed, changed, there) = shares
        ratio = math.log(changed) / math.log(guessed)  # of λ^`AIHARA_POWER`
        if not self.resolves_gap:
            return float(there**ratio)
        by_film = LOAD_RATIO_IN_MOTION if has_moving_roughness(self.scene) else LOAD_RATIO_AT_REST
        return _with_load_ratio(there, by_film * math.log(ratio) / AIHARA_POWER + growth)


def _within(share: float) -> float:
    """Return the ``share`` of asperities or film of the load, not closer to 0 and 1 than `LEAST_SCALED_SHARE`."""
    return min(max(share, LEAST_SCALED_SHARE), 1 - LEAST_SCALED_SHARE)


def _with_load_ratio(share: float, growth: float) -> float:
    """Return the ``share`` s of asperities whose ln s/(1 - s) is larger by ``growth``."""
    return 1.0 / (1.0 + (1.0 / share - 1.0) * math.exp(-growth))
