"""Heat of one operating point: modelled if leaving it out would change f by more than its share of the
tolerance."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from ..._base import FloatArray
from ...errors import InputError
from ...film import (
    FAST_PECLET_NUMBER,
    MOST_THERMAL_LOADING,
    FilmHeat,
    InletHeat,
    ShearForce,
    Surroundings,
    heated_film,
    heated_stress,
    inlet_heat,
    isothermal_heat,
)
from ...oil import NO_LIQUID, Lubricant, shear_stress
from ...scene import Scene, budget
from .wording import LEAST_STATED_PART, percent, percent_or_less, rise_in_words

if TYPE_CHECKING:
    from ...contact import ContactState


# Relative change of the film by the heat of its inlet that counts as none: rounding. Half and twice as much change
# nothing.
NEGLIGIBLE_HEAT = 1e-9
# Temperature [K] and temperature coefficient of the viscosity [1/K] of a mineral oil of ISO VG 68 at 70 °C.
TYPICAL = (343.15, 0.035)

# Nodes across the Hertz strip of an even film. A choice, as of the estimate of its shear.
NODES_OF_EVEN_FILM = 201

# Part of what heat does to f that counts as its error [-]. Not measured: published factors of the inlet differ by as
# much (`InletHeat.other`).
PART_IN_ERROR = 0.5

# Exponent of the viscosity in Moes' film, about: it changes slowly, between 0.5 and 1. A choice between them.
VISCOSITY_EXPONENT = 0.7


@dataclass(frozen=True, kw_only=True)
class Heat:
    """Heat of an operating point.

    Attributes
    ----------
    inlet : factors of inlet heating; None: not known
    is_used : whether the film is solved with them
    change : relative change of f by the temperatures of film and surfaces; an upper estimate where ``heated`` is None
    heated : the heated film; None: its temperatures are omitted
    peclet : u b rho c/(2 k) of the faster surface [-]; infinite: ``change`` was not evaluated
    typical : of a moment in time, what `typical_heat` gives
    """

    inlet: InletHeat | None = None
    is_used: bool = False
    change: float = 0.0
    heated: FilmHeat | None = None
    peclet: float = math.inf
    typical: float = 0.0

    @property
    def film_factor(self) -> float:
        """Factor on the film by the heat of the inlet; 1 if that is omitted."""
        return self.inlet.factor if self.is_used and self.inlet is not None else 1.0

    @property
    def flash(self) -> float:
        """Largest rise of the surfaces [K]; NaN if it was not computed."""
        return self.heated.flash if self.heated else math.nan

    @property
    def film_rise(self) -> float:
        """Largest mean rise of the film over the surfaces [K]; NaN if it was not computed."""
        return self.heated.film if self.heated else math.nan

    @property
    def inlet_film_factor(self) -> float:
        """`film_factor`, but NaN where the heat of the inlet is not known."""
        return math.nan if self.inlet is None else self.film_factor

    @property
    def is_evaluated(self) -> bool:
        """Whether the change of f by the temperatures was evaluated."""
        return math.isfinite(self.peclet)

    def reason(self, scene: Scene) -> str:
        """Return why the temperatures were not computed, as text; "" if they were."""
        if self.heated is not None:
            return ""
        if scene.numerics.heat == "off":
            return "not computed: numerics.heat = 'off'"
        if not scene.lubricant.heats:
            return "not computed: the temperature coefficient of the viscosity is not given (lubricant.grade gives it)"
        if self.inlet is None:
            return "not computed: without entrainment there is no film"
        if not self.is_evaluated:
            return "not computed: nothing slides, or the film is far outside its range"
        change = percent_or_less(self.change, before="at most ")
        return f"not computed: heat changes f by {change}, less than the tolerance allows"

    @property
    def left_out(self) -> float:
        """Relative change of f by the temperatures of film and surfaces, at most, where these are omitted."""
        return self.change if self.heated is None else 0.0

    @property
    def is_slow(self) -> bool:
        """Whether the surfaces move too slowly for the formula of the flash temperature, which is then too high."""
        return self.peclet < FAST_PECLET_NUMBER

    def text(self, tolerance: float) -> str:
        """Return the heat as text, each number with its budget."""
        if self.inlet is None:
            return ""
        limit = f"{100 * budget.HEAT * tolerance:.2g} %"
        inlet = f"neglected; it would make the film {percent_or_less(1 - self.inlet.factor)} thinner"
        if self.is_used:
            inlet = (
                f"it multiplies the film by {self.inlet.factor:.3g} (Gupta et al.; by Wilson and Sheu "
                f"{self.inlet.other:.3g})"
            )
        change = percent_or_less(self.change, before="at most ")
        inside = f"neglected; it would change f by {change} (limit: {limit})"
        if self.heated is not None:
            change = f"{-100 * self.change:+.2g} %"
            if abs(self.change) < LEAST_STATED_PART:
                change = percent_or_less(abs(self.change))
            inside = (
                f"it changes f by {change} (surfaces {rise_in_words(self.flash)} and film "
                f"{rise_in_words(self.film_rise)} warmer)"
            )
        return f"heat of the inlet: {inlet}; heat within the contact: {inside}"


def inlet_at(scene: Scene, speed: float) -> tuple[InletHeat | None, bool]:
    """Return the inlet heating of ``scene`` at ``speed`` [m/s], and whether the film is to be solved with it."""
    lubricant = scene.lubricant
    numerics = scene.numerics
    coefficient = lubricant.temperature_coefficient
    if numerics.heat == "off" or not lubricant.heats or coefficient is None or speed == 0:
        return None, False
    bodies = scene.bodies
    inlet = inlet_heat(
        viscosity=lubricant.viscosity,
        temperature_coefficient=coefficient,
        conductivity=lubricant.conductivity,
        speed=abs(speed),
        slide_roll_ratio=scene.motion.slide_roll_ratio,
        pressure_ratio=4 / math.pi * bodies.mean_hertz_pressure / bodies.e_prime,
    )
    wanted = numerics.heat == "on" or 1 - inlet.factor > budget.INLET * numerics.tolerance
    return inlet, wanted


def film_lubricant(scene: Scene, speed: float) -> Lubricant:
    """Return the lubricant with which the film is solved: with the viscosity in the heated inlet at which Moes' film is
    thinner by the factor of `inlet_at`."""
    inlet, used = inlet_at(scene, speed)
    if inlet is None or not used or inlet.factor > 1 - NEGLIGIBLE_HEAT:
        return scene.lubricant
    if inlet.factor <= 0:
        raise InputError(
            f"heat of the inlet: thermal number eta0 beta U²/k = {inlet.thermal_number:.3g} at {abs(speed):.4g} m/s "
            f"gives no film by the factor of Gupta et al. (1992); allowed: up to about {MOST_THERMAL_LOADING:g}, or "
            "numerics.heat = 'off' (speed, viscosity, temperature_coefficient and their units?)"
        )
    from scipy.optimize import newton

    lubricant = scene.lubricant
    line = scene.line_contact(speed)

    def thinner(log_share: float) -> float:
        made = replace(lubricant, viscosity=lubricant.viscosity * math.exp(log_share))
        return math.log(replace(line, lubricant=made).moes_film / line.moes_film)

    wanted = math.log(inlet.factor)
    share = newton(lambda share: thinner(share) - wanted, wanted / VISCOSITY_EXPONENT)
    return replace(lubricant, viscosity=lubricant.viscosity * math.exp(share))


@dataclass(frozen=True, kw_only=True)
class PointHeat:
    """The heat of a film and a contact that share the load, and what it does to the shear of the film.

    Attributes
    ----------
    heat : of inlet, film and surfaces
    inlet_viscosity : viscosity [Pa s] of the warm inlet with which the film was solved; None: as given
    stress : stress(x, pressure, thickness) [Pa] of the heated film, at positions x [m] running downstream; None: it is
        isothermal
    """

    heat: Heat
    inlet_viscosity: float | None = None
    stress: Callable[..., Any] | None = None


class PressurisedFilm(Protocol):
    """What the heat of a film depends on: the nodes, positions x [m], pressure [Pa] and film thickness [m], (n,) each,
    the entrainment speed [m/s], and where the film ruptures [m]. A `lubfric.film.EHLResult` is one."""

    @property
    def x(self) -> FloatArray: ...
    @property
    def pressure(self) -> FloatArray: ...
    @property
    def film_thickness(self) -> FloatArray: ...
    @property
    def entrainment_speed(self) -> float: ...
    @property
    def rupture(self) -> float: ...


def point_heat(
    scene: Scene,
    film: PressurisedFilm,
    contact_state: ContactState,
    *,
    contact_load: float,
    force: float,
    shear: ShearForce,
) -> PointHeat:
    """Return the heat of ``film`` with a ``contact_state`` that carries ``contact_load`` [N].

    ``force``: |f F_T| [N], and ``shear``: of the film, both without the heat of the film.
    """
    inlet, used = inlet_at(scene, film.entrainment_speed)
    if inlet is None:
        return PointHeat(heat=Heat())
    viscosity = film_lubricant(scene, film.entrainment_speed).viscosity if used else None
    pressed = float(film.pressure.max()) > NO_LIQUID  # a rigid film far above its range, on the way to one that is not
    if scene.motion.slide_roll_ratio == 0 or pressed or not shear.excess < math.inf:
        return PointHeat(heat=Heat(inlet=inlet, is_used=used), inlet_viscosity=viscosity)
    lubricant = scene.lubricant
    numerics = scene.numerics
    nodes = _nodes(scene, film, contact_state, contact_load, force)
    change = nodes.change_by(isothermal_heat(lubricant, *nodes.of_film).stress)
    peclet = peclet_at(scene, film.entrainment_speed)
    if numerics.heat != "on" and change <= budget.HEAT * numerics.tolerance:
        omitted = Heat(inlet=inlet, is_used=used, change=change, peclet=peclet)
        return PointHeat(heat=omitted, inlet_viscosity=viscosity)
    heated = heated_film(lubricant, *nodes.of_film)
    change = nodes.change_by(heated.stress)

    def stress(at: FloatArray, pressure: FloatArray, thickness: FloatArray) -> FloatArray:
        wall = np.interp(at, nodes.x, heated.wall)
        return heated_stress(lubricant, pressure, thickness, nodes.around.sliding, wall)[0]

    heat = Heat(inlet=inlet, is_used=used, change=change, heated=heated, peclet=peclet)
    return PointHeat(heat=heat, inlet_viscosity=viscosity, stress=stress)


@dataclass(frozen=True, kw_only=True)
class FilmNodes:
    """The nodes of a film, running downstream (n,).

    Attributes
    ----------
    x, pressure, thickness : position [m], pressure [Pa] and film thickness [m]
    around : what is around them
    cold : size of the shear stress of the isothermal film [Pa]
    width : of the contact [m]
    force : |f F_T| [N]
    """

    x: FloatArray
    pressure: FloatArray
    thickness: FloatArray
    around: Surroundings
    cold: FloatArray
    width: float
    force: float

    @property
    def of_film(self) -> tuple[FloatArray, FloatArray, FloatArray, Surroundings]:
        """What `heated_film` and `isothermal_heat` take."""
        return self.x, self.pressure, self.thickness, self.around

    def change_by(self, stress: FloatArray) -> float:
        """Return by what share of the force a ``stress`` [Pa] (n,) makes the friction less than the isothermal one."""
        lost = np.trapezoid(self.around.wet * (self.cold - np.abs(stress)), self.x)
        return float(self.width * lost) / max(self.force, 1e-300)


def _nodes(
    scene: Scene, film: PressurisedFilm, contact_state: ContactState, contact_load: float, force: float
) -> FilmNodes:
    """Return the nodes of ``film``, around which the contact carries ``contact_load`` [N]."""
    bodies = scene.bodies
    motion = scene.motion
    speed = abs(film.entrainment_speed)
    direction = math.copysign(1.0, film.entrainment_speed)
    order = np.argsort(film.x * direction)
    x = film.x[order] * direction
    p = film.pressure[order]
    h = film.film_thickness[order]
    share = 1.0 - contact_state.touching(x * direction)
    share = np.where(x[:-1] < film.rupture * direction, share, 0.0)
    wet = 0.5 * (np.append(share[:1], share) + np.append(share, share[-1:]))
    sliding = motion.slide_roll_ratio * speed
    half = bodies.half_width
    pressed = 2 * contact_load / (math.pi * half * bodies.width) * np.sqrt(np.maximum(1 - (x / half) ** 2, 0.0))
    return FilmNodes(
        x=x,
        pressure=p,
        thickness=h,
        around=surroundings(scene, speed, wet, bodies.boundary_friction_coefficient * pressed),
        cold=np.abs(shear_stress(scene.lubricant, p, sliding / h)),
        width=bodies.width,
        force=force,
    )


def surroundings(scene: Scene, speed: float, wet: FloatArray, boundary_stress: FloatArray) -> Surroundings:
    """Return what is around the nodes of a film at U = ``speed`` [m/s]: ``wet``, the share of the width that it covers,
    and the ``boundary_stress`` [Pa] of the asperity contacts beside it, each (n,)."""
    speed = abs(speed)
    ratio = scene.motion.slide_roll_ratio
    surfaces = (speed * abs(1 - 0.5 * ratio), speed * abs(1 + 0.5 * ratio))
    carried = sum(e * math.sqrt(u) for e, u in zip(scene.bodies.effusivity, surfaces))
    return Surroundings(carried, ratio * speed, wet, boundary_stress * abs(ratio * speed))


def typical_heat(
    scene: Scene,
    film: PressurisedFilm,
    contact_state: ContactState,
    *,
    contact_load: float,
    force: float,
    shear: ShearForce,
) -> float:
    """Return the share of ``force`` = |f F_T| [N] that the heat of film and surfaces would take away, at most, if the
    viscosity fell with the temperature as that of a typical oil (`TYPICAL`), from the stress of the isothermal film. 0
    where the lubricant says how it falls, where ``numerics.heat`` is off, and where nothing slides. Arguments as of
    `point_heat`."""
    lubricant = scene.lubricant
    known = lubricant.heats or lubricant.temperature_coefficient == 0
    meaningless = float(film.pressure.max()) > NO_LIQUID or not shear.excess < math.inf
    if known or scene.numerics.heat == "off" or scene.motion.slide_roll_ratio == 0 or meaningless:
        return 0.0
    nodes = _nodes(scene, film, contact_state, contact_load, force)
    return nodes.change_by(isothermal_heat(_like_typical(lubricant), *nodes.of_film).stress)


def typical_heat_of_even_film(scene: Scene, speed: float, thickness: float) -> float:
    """Return how much of the friction [-] of a film of even ``thickness`` [m], which carries the total load at
    U = ``speed`` [m/s], `typical_heat` would take away, at most; 0 where that is none.

    Its pressure is an ellipse as wide as the Hertz strip, or as the film of a rigid cylinder, sqrt(2 R h), if that is
    wider.
    """
    lubricant = scene.lubricant
    sliding = abs(scene.motion.slide_roll_ratio * speed)
    known = lubricant.heats or lubricant.temperature_coefficient == 0
    if known or scene.numerics.heat == "off" or sliding == 0:
        return 0.0
    bodies = scene.bodies
    load_per_width = bodies.load / bodies.width
    along = np.linspace(-1.0, 1.0, NODES_OF_EVEN_FILM)
    half_width = max(bodies.half_width, math.sqrt(2.0 * bodies.radius * thickness))
    x = along * half_width
    pressure = 2.0 * load_per_width / (math.pi * half_width) * np.sqrt(1.0 - along**2)
    around = surroundings(scene, speed, np.ones(x.size), np.zeros(x.size))
    film = np.full(x.size, thickness)
    with np.errstate(over="ignore"):
        cold = np.abs(shear_stress(lubricant, pressure, sliding / thickness))
        heated = np.abs(isothermal_heat(_like_typical(lubricant), x, pressure, film, around).stress)
        lost = float(np.trapezoid(cold - heated, x)) / load_per_width
    return lost if math.isfinite(lost) else 0.0


def _like_typical(lubricant: Lubricant) -> Lubricant:
    """Return ``lubricant`` with the temperature and the temperature coefficient of a typical oil where it has none."""
    temperature = lubricant.temperature or TYPICAL[0]
    coefficient = lubricant.temperature_coefficient or TYPICAL[1]
    return replace(lubricant, temperature=temperature, temperature_coefficient=coefficient)


def peclet_at(scene: Scene, speed: float) -> float:
    """Return u b rho c/(2 k) of the faster surface at U = ``speed`` [m/s]; the smaller of both bodies."""
    bodies = scene.bodies
    faster = abs(speed) * (1 + 0.5 * abs(scene.motion.slide_roll_ratio))
    return min(faster * bodies.half_width * c / (2 * k) for k, c in zip(bodies.conductivity, bodies.volumetric_heat))


def error_by_heat(heat: Heat, by_inlet: float) -> float:
    """Return the relative error of f by ``heat``: half of what it does. ``by_inlet``: relative change of f without the
    heat of the inlet, of which it is as much more as the other of two published factors has it."""
    return sum(_parts_of_error(heat, by_inlet))


def heat_error_in_words(heat: Heat, by_inlet: float, tolerance: float, *, is_at_most: bool) -> str:
    """Return of what two parts the `error_by_heat` is made, as text; "" where it is within the ``tolerance`` on f, or
    where one of the parts is 0. ``is_at_most``: ``by_inlet`` is not solved, but the largest there is."""
    within, inlet = _parts_of_error(heat, by_inlet)
    if within + inlet <= tolerance or not (within and inlet):
        return ""
    of_inlet = (
        "half of its effect" if inlet <= PART_IN_ERROR * abs(by_inlet) else "two published formulas differ as much"
    )
    largest = ", an upper bound: f inversely proportional to the film" if is_at_most else ""
    return (
        f"the model-form error by heat is {percent(within + inlet)}. The temperatures in the contact contribute "
        f"{percent(within)} (half of their effect on f); the heat of the inlet, which makes the film "
        f"{percent(1 - heat.film_factor)} thinner, contributes {percent(inlet)} ({of_inlet}{largest})"
    )


def _parts_of_error(heat: Heat, by_inlet: float) -> tuple[float, float]:
    """Return both parts of `error_by_heat`: by the temperatures of film and surfaces, and by the inlet."""
    apart = PART_IN_ERROR
    if heat.film_factor < 1 and heat.inlet is not None:
        apart = max(apart, abs(math.log(heat.inlet.other / heat.film_factor) / math.log(heat.film_factor)))
    return PART_IN_ERROR * abs(heat.change), apart * abs(by_inlet)
