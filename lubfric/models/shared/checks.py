"""Checks of a solution: motion, film, shear stress and heat outside the range of the model."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..._base import FloatArray
from ...contact import ridges
from ...film import FAST_PECLET_NUMBER, MOST_SLIDE_ROLL_RATIO_OF_INLET, MOST_THERMAL_LOADING, LineContact, ShearForce
from ...oil import CELSIUS, NO_LIQUID
from ...samples import way_to_longer_patch
from ...units import worded
from .heat import TYPICAL, Heat
from .model_error import IN_INTERVAL
from .violation import Assumption, Violation

if TYPE_CHECKING:
    from ...scene import Scene
    from ...surface import Surface


# Reynolds number rho U h/eta up to which a film is laminar; between it and `TURBULENT` it is in transition. Usual for
# bearings; not measured here.
LAMINAR = 1000.0

# Reynolds number rho U h/eta from which a film is turbulent, and Reynolds' equation means nothing. Usual for
# bearings; not measured here.
TURBULENT = 2000.0

# Reduced Reynolds number (rho U h/eta) h/b from which inertia counts: it is the ratio of inertia to viscous forces. A
# choice: a tenth.
INERTIA = 0.1

# Slide-roll ratio beyond which the surfaces move against one another. It follows from u1 u2 < 0.
OPPOSED = 2.0

# Part by which a ratio may exceed `OPPOSED` because speeds of a table are rounded [-]. A choice: four digits leave
# less.
ROUNDED_SPEEDS = 1e-3

# Density of an oil [kg/m³], where none is given: that of a mineral oil at 30 °C (oils.toml).
DENSITY = 870.0

# Pressure [Pa], about, up to which the law of Roelands was fitted (thesis, Delft 1966).
ROELANDS_LIMIT = 1e9

# Pressure [Pa] from which the law of Barus is far above measured viscosities. Not measured here: it
# decides a warning, no number.
BARUS_LIMIT = 3e8

# Pressure [Pa] above which a viscosity law is extrapolated, of the laws that have one.
OF_VISCOSITY_LAW = {"roelands": ROELANDS_LIMIT, "barus": BARUS_LIMIT}

# Film over the radius from which it is not thin: at sqrt(2 R h) the parabola for the circle is off by 5 %. A choice: a
# smaller value warns of more films.
THICK_FILM = 0.1

# Part of the mean gap that the undeformed cylinder may rise over the Hertz strip. Not measured: it decides a warning,
# no number.
STRIP_SHARE = 0.2

# Film pressure over the peak Hertz pressure from which it is a local peak, of roughness or of the spike. Not measured:
# a convention.
SPIKE = 1.05

# What the highest pressure of a film is called, smooth or rough.
FILM_PRESSURE = "highest film pressure"

# Part of the plastic limit from which a local peak is at this limit [-]. A choice: any number between the rounding of a
# solve and 1 does.
YIELDING_PART = 0.99

# Pressure [Pa] above which asperities of the hardest through-hardened steel yield: 830 HV (typical.toml).
YIELDED_ASPERITIES = 8.1e9

# What to give so that the film is deflected by the total load.
DEFLECTION_OF_TOTAL_LOAD = "numerics.film_deflection = 'scaled'"

# What to do where inertia or turbulence disturb the film.
LESS_INERTIA = "reduce the speed or raise the viscosity"

# Share of the contact load on the two edge columns of a patch from which its ends cut off the contact. Not measured:
# it decides where a point is refused, no number.
ON_ENDS = 0.01

# Names of the numerical and of the sampling error where they are above their tolerances; tables of studies hold them as
# text.
NUMERICAL_ERROR = "estimated numerical error of f"
SAMPLING_ERROR = "sampling error of f at 95 %"

# What sets the limit of the numerical error of a point.
BY_TOLERANCE = "numerics.tolerance sets this limit"

# Numerical error of f, relative, from which on it is a warning even where an interval includes it [-]. A convention: no
# formula is fitted to such points.
LARGE_NUMERICAL_ERROR = 0.2

# Numerical error of f, relative, from which on f is only an order of magnitude [-]. A convention: f may be half as
# large, or half as large again.
ERROR_OF_ORDER_OF_MAGNITUDE = 0.5

# Digits of a slip in percent that a user writes, at most: a ratio that follows from two speeds has more. A choice.
DIGITS_OF_SLIP = 2

# Share of f from stresses that no oil carries from which on f is refused. Not measured: a convention.
REFUSED_SHARE = 0.2

# Friction coefficient of a film that no lubricant reaches: traction fluids have some 0.1 (typical.toml).
MOST_FILM_FRICTION = 0.2


def violations_by_motion(scene: Scene, speed: float, thickness: float) -> Iterator[Violation]:
    """Yield the violations by sliding, inertia and turbulence at ``speed`` [m/s] and a film thickness [m] (NaN: no
    film)."""
    ratio = abs(scene.motion.slide_roll_ratio)
    if ratio > OPPOSED * (1 + ROUNDED_SPEEDS):
        why = "the surfaces move in opposite directions; heat and dimples of such films are not modelled"
        what = "slide-roll ratio"
        check = "the speeds of the surfaces: the ratio is 2 in simple sliding"
        if scene.transient is not None:  # the ratio follows from the speeds of the moment
            check = "motion.entrainment_speed and motion.sliding_speed over the run"
        elif float(f"{ratio:.{DIGITS_OF_SLIP}g}") == ratio:  # no quotient of two speeds
            check += f", and a slip of {ratio:g} % ({ratio / 100:g}) goes into motion.slip_percent"
        advice = f"use f only as an estimate if this motion is meant, as at the nose of a cam; otherwise check {check}"
        yield Violation(
            assumption=Assumption.ONE_DIRECTION,
            what=what,
            value=ratio,
            limit=OPPOSED,
            unit="",
            consequence=why,
            recommendation=advice,
        )
    if math.isfinite(thickness) and thickness > 0:
        oil = scene.lubricant.oil
        temperature = scene.lubricant.temperature
        density = DENSITY if oil is None or temperature is None else oil.density_at(temperature)
        reynolds = density * abs(speed) * thickness / scene.lubricant.viscosity
        inertia = reynolds * thickness / max(scene.bodies.half_width, math.sqrt(2 * scene.bodies.radius * thickness))
        if reynolds > LAMINAR:
            limit = TURBULENT if reynolds > TURBULENT else LAMINAR
            why = "Reynolds' equation needs a laminar film, and this film is turbulent or nearly so"
            what = "Reynolds number"
            recommendation = LESS_INERTIA
            yield Violation(
                assumption=Assumption.LAMINAR_FILM,
                what=what,
                value=reynolds,
                limit=limit,
                unit="",
                consequence=why,
                recommendation=recommendation,
                severe=reynolds > TURBULENT,
            )
        elif inertia > INERTIA:
            why = "Reynolds' equation neglects inertia, so film and f have an unknown error"
            what = "inertia over viscous forces in the film"
            yield Violation(
                assumption=Assumption.NO_INERTIA,
                what=what,
                value=inertia,
                limit=INERTIA,
                unit="",
                consequence=why,
                recommendation=LESS_INERTIA,
            )


def violations_by_film(
    scene: Scene, *, thickness: float, peak: float, shear: ShearForce, film_load: float, force: float, heat: Heat
) -> Iterator[Violation]:
    """Yield the violations by a film of central ``thickness`` [m] and ``peak`` pressure [Pa], by its ``shear`` and its
    ``heat``."""
    yield from violations_by_pressure(scene, max(peak, peak_hertz_pressure(scene)))
    yield from violations_by_thickness(scene, thickness)
    yield from violations_by_shear(scene, shear, film_load, force)
    yield from violations_by_heat(scene, heat)


def peak_hertz_pressure(scene: Scene) -> float:
    """Return the peak Hertz pressure [Pa] of the total load. A film between asperities has at least this pressure,
    however little of the load it carries by Eq. (8)."""
    return 4 / math.pi * scene.bodies.mean_hertz_pressure


def violations_by_pressure(scene: Scene, peak: float, place: str = "") -> Iterator[Violation]:
    """Yield the violation by the highest film pressure ``peak`` [Pa]. ``place``: of a rough film, where that is, as
    text; "": the film is smooth.

    No oil is liquid above 10 GPa. This is severe where the film is smooth or the peak Hertz pressure is above it, and a
    warning where asperities that do not yield press the film that much. Above the limit of the viscosity law it is a
    warning where the peak Hertz pressure is, and no limiting stress bounds the friction; local peaks of a rough film
    are small parts of it.
    """
    limit = OF_VISCOSITY_LAW.get(scene.lubricant.viscosity_law, math.inf)
    if peak > NO_LIQUID and place and peak_hertz_pressure(scene) <= NO_LIQUID:
        yield _violation_between_asperities(scene, peak, place)
    elif peak > NO_LIQUID:
        (facts, advice) = _spike(scene, peak, NO_LIQUID, place)
        yield Violation(
            assumption=Assumption.LIQUID_OIL,
            what=FILM_PRESSURE,
            value=peak / 1e9,
            limit=NO_LIQUID / 1e9,
            unit="GPa",
            consequence="; ".join(("no oil is liquid at this pressure, so f has no meaning", *facts)),
            recommendation="; ".join((*advice, "check bodies.load")),
            severe=True,
        )
    elif peak > limit:
        hertz_peak = peak_hertz_pressure(scene)
        (facts, advice) = _spike(scene, peak, limit, place)
        (bounds, more) = _bounds_of_stress(scene)
        extrapolated = f"the viscosity law ({scene.lubricant.viscosity_law}) is extrapolated there"
        yield Violation(
            assumption=Assumption.PRESSURE_OF_VISCOSITY_LAW,
            what=FILM_PRESSURE,
            value=peak / 1e9,
            limit=limit / 1e9,
            unit="GPa",
            consequence="; ".join((extrapolated, *facts, *bounds)),
            recommendation="; ".join((*advice, *more)),
            is_note=bool(place and hertz_peak <= limit) or not more,
        )


def _violation_between_asperities(scene: Scene, peak: float, place: str) -> Violation:
    """Return the warning that asperities press the film to a ``peak`` pressure [Pa] at which no oil is liquid."""
    (facts, advice) = _spike(scene, peak, NO_LIQUID, place)
    (bounds, more) = _bounds_of_stress(scene)
    if more and scene.lubricant.has_unlimited_stress:
        bounds = ["f_b times the pressure bounds the shear stress of the film"]
    if scene.bodies.hardness is None:
        advice.append(
            "give bodies.hardness: without this plastic limit the asperities stay elastic, which causes the peak"
        )
    else:
        advice.append("check the heights and the spacing of [surface], and bodies.hardness")
    return Violation(
        assumption=Assumption.LIQUID_OIL,
        what=FILM_PRESSURE,
        value=peak / 1e9,
        limit=NO_LIQUID / 1e9,
        unit="GPa",
        consequence="; ".join(
            ("no oil is liquid at this pressure, so the viscosity has no meaning there", *facts, *bounds)
        ),
        recommendation="; ".join((*advice, *more)),
    )


def violations_by_asperities(scene: Scene, peak: float) -> Iterator[Violation]:
    """Yield the violation by asperities whose highest pressure ``peak`` [Pa] no steel carries, where no hardness limits
    it."""
    if scene.bodies.hardness is None and peak > YIELDED_ASPERITIES:
        yield Violation(
            assumption=Assumption.ELASTIC_ASPERITIES,
            what="highest asperity pressure",
            value=peak / 1e9,
            limit=YIELDED_ASPERITIES / 1e9,
            unit="GPa",
            consequence="hard steel yields at this pressure, but the asperities are modelled as elastic",
            recommendation="give bodies.hardness",
        )


def _spike(scene: Scene, peak: float, limit: float, place: str) -> tuple[list[str], list[str]]:
    """Return where a ``peak`` pressure [Pa] of the film above its ``limit`` [Pa] is and what causes it, and what lowers
    it, as texts."""
    facts = []
    advice = []
    hertz_peak = peak_hertz_pressure(scene)
    if peak > SPIKE * hertz_peak:
        where = place or "of the smooth film"
        facts.append(f"this is a local peak {where}; the peak Hertz pressure is {hertz_peak / 1e9:.3g} GPa")
        hardness = scene.bodies.hardness
        if hardness is not None and peak > YIELDING_PART * hardness:
            facts.append(f"asperities yield at {hardness / 1e9:.3g} GPa, the plastic limit, which bounds the peak")
    if scene.lubricant.density_law == "constant" and hertz_peak < limit:
        facts.append("a constant density causes such a spike")
        advice.append("give lubricant.density_law = 'dowson-higginson', which lowers the peak")
    return facts, advice


def _bounds_of_stress(scene: Scene) -> tuple[list[str], list[str]]:
    """Return that the limiting stress bounds the friction of the film, or else that this is to be given, as texts."""
    if scene.lubricant.limit is not None or scene.lubricant.is_limited_by_boundary_friction:
        return ["the limiting stress bounds the friction of the film"], []
    return [], [
        "give a measured limiting stress (lubricant.limiting_stress_coefficient), which bounds the friction of the film"
    ]


def violations_by_thickness(scene: Scene, thickness: float) -> Iterator[Violation]:
    """Yield the violations by the central film thickness ``thickness`` [m]."""
    radius = scene.bodies.radius
    if not thickness > THICK_FILM * radius:
        return
    why = "Reynolds' equation needs a film that is thin compared with the cylinder"
    yield Violation(
        assumption=Assumption.THIN_FILM,
        what="film over radius",
        value=thickness / radius,
        limit=THICK_FILM,
        unit="",
        consequence=why,
        recommendation="check bodies.radius, viscosity and speed",
    )


def violations_by_inlet(scene: Scene, line: LineContact, flow: float, friction_force: float) -> Iterator[Violation]:
    """Yield the violations by a film of ``line``, a `LineContact`, that a given inlet changes: its ``flow`` film [m]
    over that of a full one, by Moes; or what the lubricant farther out would add to ``friction_force`` |f| F_T [N] by
    rolling, 12 eta U R/x a width from x on: ∫ h/2 dp/dx dx, where the film is far thicker than where it rolls in."""
    oil = scene.lubricant
    tolerance = scene.numerics.tolerance
    flooded = line.moes_film
    out = oil.inlet_length or math.inf
    lost = 12 * oil.viscosity * line.entrainment_speed * line.radius / out * scene.bodies.width
    if not oil.floods and flow <= (1 - tolerance) * flooded:
        keys = ("inlet_length", "inlet_film")
        given = " and ".join(f"lubricant.{key}" for key in keys if getattr(oil, key) is not None)
        consequence = f"{given} starves the inlet, so f depends on this value"
        what = "film thickness over that of a fully flooded inlet (Moes)"
        advice = f"keep {given} if the contact is starved; omit it for a flooded inlet"
        yield Violation(
            assumption=Assumption.FLOODED_INLET,
            what=what,
            value=flow / flooded,
            limit=1.0,
            unit="",
            consequence=consequence,
            recommendation=advice,
            is_note=True,
        )
    elif lost > tolerance * friction_force:
        what = "rolling friction of the inlet beyond inlet_length, relative to f"
        why = "f depends on where the lubricant begins, so on inlet_length"
        yield Violation(
            assumption=Assumption.LONG_INLET,
            what=what,
            value=100 * lost / friction_force,
            limit=100 * tolerance,
            unit="%",
            consequence=why,
            recommendation="omit lubricant.inlet_length for a fully flooded inlet",
            effect=lost / friction_force,
        )


def violations_by_inlet_of_moment(scene: Scene, speed: float) -> Iterator[Violation]:
    """Yield the violations by a starved inlet by closed forms, of steady motion or one moment of a run in time, whose
    ``scene`` has the values of the moment: `violations_by_inlet` of the flow at ``speed`` [m/s]."""
    if speed != 0 and scene.lubricant.inlet_length is not None:
        line = scene.line_contact(abs(speed))
        yield from violations_by_inlet(scene, line, line.starved_film, math.inf)


def violations_by_deflection(
    scene: Scene, mean_gap: float, recommendation: str = DEFLECTION_OF_TOTAL_LOAD
) -> Iterator[Violation]:
    """Yield the violations by a film that only its own pressure deflects, over a contact with that ``mean_gap`` [m]:
    the possible error of its share of the load."""
    change = scene.bodies.strip_rise / max(mean_gap, 1e-300)
    if not change > STRIP_SHARE:
        return
    why = (
        "only its own pressure deflects the film: at low speeds the film carries too much load, and f stays below f_b; "
        "at other speeds f may be too low or too high"
    )
    what = "rise of the undeformed cylinder over the Hertz strip, relative to the mean gap,"
    yield Violation(
        assumption=Assumption.FILM_UNDER_TOTAL_LOAD,
        what=what,
        value=change,
        limit=STRIP_SHARE,
        unit="",
        consequence=why,
        recommendation=recommendation,
    )


def violations_by_ends(scene: Scene, share: float, surface: Surface) -> Iterator[Violation]:
    """Yield the violations by the ``share`` of the contact's load on the edge columns of the patch ``surface`` of
    ``scene``."""
    if share > ON_ENDS:
        why = f"the contact is longer than the patch ({worded(surface.size[0], 'm')}), which cuts off its ends"
        what = "share of the contact load on the edge columns of the patch"
        yield Violation(
            assumption=Assumption.CONTACT_ON_PATCH,
            what=what,
            value=100 * share,
            limit=100 * ON_ENDS,
            unit="%",
            consequence=why,
            recommendation=f"give {way_to_longer_patch(scene, surface)}",
            severe=True,
        )


def violations_by_patches(scene: Scene, heights: FloatArray, area: float) -> Iterator[Violation]:
    """Yield the violations by asperities that are patches of ``heights`` [m] (nx, ny), whose contact area is the
    fraction ``area``: half of their base area, since they are paraboloids."""
    if scene.contact.model != "patches" or area == 0:
        return
    count = ridges(heights, min(2 * area, 1.0), (scene.contact.geometry == "flat", True))
    if count:
        why = "a ridge that crosses the whole map counts as one asperity, so f depends on the length of the map"
        what = "number of asperities that extend across the whole map"
        yield Violation(
            assumption=Assumption.ASPERITIES_END,
            what=what,
            value=count,
            limit=0,
            unit="",
            consequence=why,
            recommendation="give contact.model = 'half-space' or 'summits'",
        )


def is_of_impossible_stress(shear: ShearForce) -> bool:
    """Return whether most of the force of ``shear`` comes from stresses that no oil carries."""
    return not shear.excess <= 0.5 * abs(shear.couette)


def violations_by_shear(
    scene: Scene, shear: ShearForce, film_load: float, friction_force: float
) -> Iterator[Violation]:
    """Yield the violations by the ``shear`` (`ShearForce`) of a film that carries ``film_load``; ``friction_force``: f
    F_T; both in N, or both per width.

    If the share of the friction that no oil carries is above the tolerance on f, that is a warning; above 0.2 the point
    is refused.
    """
    tolerance = scene.numerics.tolerance
    if not friction_force > 0:
        return
    share = shear.excess / friction_force if shear.excess < math.inf else 1.0
    of_film = abs(shear.couette) / max(film_load, 1e-300)
    law = "the shear law" if scene.lubricant.shear_laws else "Newtonian shear"
    recommendation = "give lubricant.eyring_stress (some 5e6 Pa) and limiting_stress_coefficient (some 0.05 to 0.1)"
    if share > tolerance:
        severe = share > REFUSED_SHARE
        yield Violation(
            assumption=Assumption.STRESS_OF_OILS,
            what="part of f from shear stresses above 5 MPa + 0.12 p",
            value=share,
            limit=REFUSED_SHARE if severe else tolerance,
            unit="",
            consequence=f"no oil carries such stresses; {law} reaches {shear.stress_ratio:.2g} times this limit, and "
            f"gives the film a friction coefficient of {of_film:.2g}",
            recommendation=recommendation,
            severe=severe,
            effect=share,
        )
    elif of_film > MOST_FILM_FRICTION and abs(shear.couette) > tolerance * friction_force:
        what = "friction coefficient of the film"
        why = "no lubricant has such a high friction coefficient"
        yield Violation(
            assumption=Assumption.FRICTION_OF_FILMS,
            what=what,
            value=of_film,
            limit=MOST_FILM_FRICTION,
            unit="",
            consequence=why,
            recommendation=recommendation,
        )


def violations_by_heat(scene: Scene, heat: Heat) -> Iterator[Violation]:
    """Yield the violations by the ``heat`` of a point that is large, or not known."""
    tolerance = scene.numerics.tolerance
    if heat.is_used and heat.inlet is not None:
        spread = abs(heat.inlet.other / max(heat.inlet.factor, 1e-12) - 1)
        extrapolated = (
            abs(scene.motion.slide_roll_ratio) > MOST_SLIDE_ROLL_RATIO_OF_INLET
            or heat.inlet.thermal_number > MOST_THERMAL_LOADING
        )
        if extrapolated and spread > tolerance:
            (least, most) = sorted((heat.inlet.factor, heat.inlet.other))
            yield Violation(
                assumption=Assumption.KNOWN_INLET_HEAT,
                what="relative difference between two published factors for the heat of the inlet",
                value=spread,
                limit=tolerance,
                unit="",
                consequence=f"by one or the other the film is {least:.2g} or {most:.2g} times as thick as the isothermal "
                "one; neither was derived for such sliding; the model-form error of f contains their difference",
                recommendation="compare with f of the isothermal film (numerics.heat = 'off'); only a measured film "
                "shows which factor holds",
                is_note=True,
            )
    if heat.is_slow and heat.change > tolerance:
        yield Violation(
            assumption=Assumption.FAST_SURFACES,
            what="Péclet number of the faster surface",
            value=heat.peclet,
            limit=FAST_PECLET_NUMBER,
            unit="",
            consequence="the formula of the flash temperature is for a fast heat source: here the temperature is too "
            f"high, and f is too low by at most {100 * heat.change:.2g} %, half of which its model-form error contains",
            recommendation="set numerics.heat = 'off' for the upper bound of f, without heat",
            is_note=heat.change <= scene.numerics.model_tolerance,
            effect=heat.change,
        )


def violations_by_typical_heat(scene: Scene, change: float, estimated: str = "") -> Iterator[Violation]:
    """Yield the violations by heat that is omitted because the lubricant does not say how its viscosity falls with the
    temperature. ``change``: the share of f that a typical oil would lose by it (`typical_heat`);
    ``estimated``: how it is known before the solve, as text."""
    if change > scene.numerics.tolerance:
        temperature, coefficient = TYPICAL
        yield Violation(
            assumption=Assumption.HEAT_INCLUDED,
            what="reduction of f by the heat of the film",
            value=100 * change,
            limit=100 * scene.numerics.tolerance,
            unit="%",
            consequence="heat is not included, because the scene does not state how the viscosity falls with the "
            f"temperature; the number is the largest effect on a typical oil at {temperature - CELSIUS:.0f} °C, whose "
            f"viscosity falls by {100 * coefficient:.2g} % per K{estimated and f'; {estimated}'}",
            recommendation="give lubricant.temperature and temperature_coefficient, or an oil (grade, nu40, oil); set "
            "numerics.heat = 'off' to neglect heat without this warning",
            effect=change,
        )


def _consequence_of_numerical_error(error: float, *, has_interval: bool) -> str:
    """Return what a numerical ``error`` of f, relative, above its limit means; ``has_interval``: whether f has an
    interval, which includes the error."""
    if error > ERROR_OF_ORDER_OF_MAGNITUDE:
        return "the error is so large that f is only an order of magnitude"
    return f"{BY_TOLERANCE}; {IN_INTERVAL[has_interval]}"


def violations_by_numerical_error(
    error: float | None, tolerance: float, recommendation: str, *, has_interval: bool = True
) -> Iterator[Violation]:
    """Yield a note if the estimated numerical ``error`` of f, relative, is above the tolerance (None, NaN: not known):
    an interval of f has it. A large one (`LARGE_NUMERICAL_ERROR`) is a warning. ``has_interval``: whether f has
    one."""
    if error is not None and error > tolerance:
        yield Violation(
            assumption=Assumption.NUMERICAL_ERROR,
            what=NUMERICAL_ERROR,
            is_note=not error > LARGE_NUMERICAL_ERROR,
            value=100 * error,
            limit=100 * tolerance,
            unit="%",
            consequence=_consequence_of_numerical_error(error, has_interval=has_interval),
            recommendation=recommendation,
            effect=error,
        )
