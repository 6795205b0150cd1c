"""Maps of load sharing: film over roughness, roughness from 1 nm to 2 µm, share of the contact, entrainment of any
sign.

The judge closes load and volume anew, with the film of the differential deflection, dry contacts solved afresh, a root
finder from elsewhere, and its own sum of the friction forces. Allowed is twice the tolerance on friction that the scene
asks for (1 %), on the coefficient and on F_C/F_T.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from lubfric import LubfricError, friction, load_scene, solve_contact, solve_differential_deflection, solve_ehl
from lubfric.contact import FlatContact
from lubfric.sharing import Prepared, prepare

from ..check import Check
from .cell import Condition, judged
from .film_check import viscosity_ratio

ALLOWED = {"friction sum": 1e-9, "bounds": 0.5, "friction": 2.0, "contact share": 2.0}


def cells(level: str) -> Iterator[Check]:
    """All load-sharing cells of ``level`` ("quick" or "full")."""
    quick = level == "quick"
    yield from curves("flat", quick)
    yield from curves("paper", quick)
    yield from special_speeds(quick)


def model_of(name: str, sq: float, shape: int, **sections) -> Prepared:
    """A built-in scene with another roughness on a small grid. Any slope is accepted, because the solver is what is
    tried."""
    scene = load_scene(name)
    if name == "flat":
        roughness = {"sq": sq, "correlation_length": 0.08e-6 * shape}
        grid = {"shape": (shape, shape), "spacing": 1e-6}
    else:
        roughness = {"sq": sq, "correlation_length": 9e-6 * 32 / shape if shape < 48 else 4e-6}
        grid = {"shape": (shape, shape // 2), "spacing": 90e-6 / shape}
    scene = scene.with_(numerics={"sampling": "patch", "accept": True})
    return prepare(scene.with_(surface=roughness, contact=grid, **sections))


def speed_for(scene, film_thickness: float) -> float:
    """Entrainment speed [m/s] at which the smooth film of the whole load has about that thickness, by bisection."""
    low, high = math.log(1e-12), math.log(1e4)
    for _ in range(14):
        middle = 0.5 * (low + high)
        film = solve_ehl(**film_case(scene, scene.bodies.load, math.exp(middle)), tolerance=0.05).central_film
        low, high = (middle, high) if film < film_thickness else (low, middle)
    return math.exp(0.5 * (low + high))


def film_case(scene, load: float, speed: float) -> dict:
    """Arguments of the film solvers for ``load`` [N]."""
    bodies, oil = scene.bodies, scene.lubricant
    return {
        "load_per_width": load / bodies.width,
        "radius": bodies.radius,
        "e_prime": bodies.e_prime,
        "entrainment_speed": speed,
        "viscosity": oil.viscosity,
        "pressure_viscosity_coefficient": oil.pressure_viscosity_coefficient,
        "viscosity_law": oil.viscosity_law,
        "density": oil.density_law,
    }


def checked(model: Prepared, speed: float):
    """check(result) for `judged`: sums of the result itself, and friction and contact load against `judge`."""

    def check(result) -> dict[str, float]:
        scene = model.scene
        total = scene.bodies.load
        forces = result.boundary_force + result.shear_force
        share = result.contact_load / total
        found = {
            "load": abs((result.contact_load + result.film_load) / total - 1),
            "friction sum": abs(result.coefficient * total - forces) / abs(forces),
            "bounds": 0.0 if -1e-12 <= share <= 1 + 1e-12 and 0 <= result.real_contact_area_fraction <= 1 else 1.0,
        }
        if speed == 0:
            coefficient, split = scene.bodies.boundary_friction_coefficient, 1.0
        else:
            coefficient, split = judge(model, result, speed)
        found["friction"] = abs(result.coefficient / coefficient - 1) / scene.numerics.tolerance
        found["contact share"] = abs(share - split) / scene.numerics.tolerance
        allowed = ALLOWED | {"load": 2 * scene.numerics.tolerances.balance}  # one closure balances it
        return {name: value / allowed[name] for name, value in found.items()}

    return check


def judge(model: Prepared, result, speed: float) -> tuple[float, float]:
    """(friction coefficient, F_C/F_T) from another film solver and fresh dry contacts, with the division of the load
    closed again."""
    from scipy.optimize import brentq

    scene, total = model.scene, model.scene.bodies.load

    def sides(split):
        film_load = total / (1 + math.exp(-split))
        film = judge_film(scene, film_load, speed)
        return film, judge_contact(model, total / (1 + math.exp(split)), film)

    def surplus(split):
        contact = sides(split)[1]
        return math.log(contact.gap / contact.film)

    if surplus(40.0) <= 0:  # the film of the whole load clears the summits
        film, contact = sides(40.0)
        return own_friction(scene, film, contact, 0.0, speed), 0.0
    share = min(max(result.film_load / total, 1e-13), 1 - 1e-13)
    low = high = math.log(share / (1 - share))
    step = 0.02
    while surplus(low) > 0:
        low, step = low - step, 3 * step
    step = 0.02
    while surplus(high) < 0 and high < 40:
        high, step = high + step, 3 * step
    split = brentq(surplus, low, high, xtol=2e-3) if high > low else low
    film, contact = sides(split)
    contact_load = total / (1 + math.exp(split))
    return own_friction(scene, film, contact, contact_load, speed), contact_load / total


@dataclass(frozen=True)
class Sides:
    """Mean gap and mean film over A [m], and the share of the width in contact at each x [m]."""

    gap: float
    film: float
    x: np.ndarray
    touching: np.ndarray


def judge_film(scene, load: float, speed: float):
    """The film by differential deflection, or by the tightest Newton solution where that does not converge."""
    case = film_case(scene, load, speed)
    try:
        return solve_differential_deflection(**case, tolerance=2e-3)
    except LubfricError:
        return solve_ehl(**case, tolerance=1e-4)


def judge_contact(model: Prepared, load: float, film) -> Sides:
    """A dry contact solved afresh at ``load`` [N]."""
    patch, scene = model.contact, model.scene
    heights, spacing = model.surface.heights - model.surface.heights.mean(), model.surface.spacing
    x, flat = patch.x, scene.contact.geometry == "flat"
    smooth = film.film_at(x)
    if isinstance(patch, FlatContact):
        pressure, gap0, weight = load / patch.area, heights.max() - heights, np.ones(x.size)
    else:
        pressure = load / (scene.bodies.width * x.size * spacing[0])
        gap0, weight = smooth[:, None] - heights, patch.weight
    dry = solve_contact(
        gap0,
        spacing,
        scene.bodies.e_prime,
        mean_pressure=pressure,
        hardness=scene.bodies.hardness,
        boundary=("periodic" if flat else "free", "periodic"),
        tolerance=1e-6,
    )
    gap, touching = np.maximum(dry.gap, 0), dry.pressure > 0
    if flat:
        return Sides(float(gap.mean()), float(smooth.mean()), x, np.full(x.size, touching.mean()))
    return Sides(
        float(gap.mean(axis=1) @ weight / weight.sum()),
        float(smooth @ weight / weight.sum()),
        x,
        touching.mean(axis=1),
    )


def own_friction(scene, film, contact: Sides, contact_load: float, speed: float) -> float:
    """(f_b F_C + F_sh)/F_T by the trapezoidal rule.

    The film before rupture is Newtonian or Ree-Eyring, and the far inlet is in closed form.
    """
    bodies, oil, ratio = scene.bodies, scene.lubricant, scene.motion.slide_roll_ratio
    sign = math.copysign(1.0, speed)
    order = slice(None) if sign > 0 else slice(None, None, -1)
    x, p, h = film.x[order] * sign, film.pressure[order], film.film_thickness[order]
    wet = x <= sign * film.rupture + 1e-12 * film.half_width
    x, p, h = x[wet], p[wet], h[wet]
    eta = oil.viscosity * np.exp(
        viscosity_ratio(oil.viscosity_law, oil.viscosity, oil.pressure_viscosity_coefficient, p)
    )
    slide = ratio * abs(speed)
    free = 1 - np.interp(sign * x, contact.x, contact.touching, 0.0, 0.0)
    rate = free * slide / h
    if oil.eyring_stress is None:
        couette = np.sum(np.diff(x) * _log_mean(eta) * 0.5 * (rate[1:] + rate[:-1]))
    else:
        tau = free * oil.eyring_stress * np.arcsinh(eta * slide / (h * oil.eyring_stress))
        couette = np.sum(np.diff(x) * 0.5 * (tau[1:] + tau[:-1]))
    couette += oil.viscosity * slide * 2 * bodies.radius / abs(x[0])
    rolling = np.sum(0.25 * (free[1:] + free[:-1]) * (h[1:] + h[:-1]) * np.diff(p)) / 2
    rolling += 1.5 * p[0] * h[0]  # ½∫h dp before the first node, where h ~ x² and p ~ |x|^-3
    boundary = bodies.boundary_friction_coefficient * contact_load * (ratio != 0)
    return float((boundary + bodies.width * (couette + rolling)) / bodies.load)


def _log_mean(eta) -> np.ndarray:
    """Mean of a viscosity that is exponential between the nodes."""
    d = np.diff(np.log(eta))
    return eta[:-1] * np.where(np.abs(d) < 1e-6, 1.0, np.expm1(d) / np.where(d == 0, 1.0, d))


def curves(name: str, quick: bool) -> Iterator[Check]:
    """Film over roughness from 0.01 to 10, by roughness from 1 nm to 2 µm, with both closures. The paper's closure is
    not the default."""
    roughness = [1e-7] if quick else np.geomspace(1e-9, 2e-6, 5)
    ratios = np.geomspace(0.01, 10, 3 if quick else 10)
    for sq in roughness:
        base = model_of(name, float(sq), 32 if quick else 64 if name == "flat" else 48)
        for ratio in ratios:
            speed = speed_for(base.scene, float(ratio * sq))
            for closure in ("load", "separation"):
                model = replace(base, scene=base.scene.with_(numerics={"closure": closure}))
                if closure == "separation" and name == "flat":
                    continue  # its curve has to reach further: prepared anew below
                yield judged(
                    Condition(f"sharing: {name}", "lambda by roughness", ratio, sq),
                    f"closure = {closure}",
                    lambda model=model, speed=speed: friction(model, speed),
                    checked(model, speed),
                    closure == "load",
                )


def special_speeds(quick: bool) -> Iterator[Check]:
    """Nearly all film, nearly all contact, no entrainment, and reversed entrainment."""
    for column, name in enumerate(("flat", "paper")):
        model = model_of(name, 100e-9, 32 if quick else 64)
        for speed in (
            (0.0, -0.01, 0.01) if quick else (0.0, *np.geomspace(1e-10, 30, 12), *-np.geomspace(1e-10, 30, 12))
        ):
            here = Condition("sharing: speed, either sign", name, float(speed), column)
            yield judged(
                here,
                "closure = load",
                lambda model=model, speed=speed: friction(model, float(speed)),
                checked(model, float(speed)),
            )
        yield from shares(model, name, quick)


def shares(model: Prepared, name: str, quick: bool) -> Iterator[Check]:
    """F_C/F_T from 1e-6 to 1 - 1e-6: speeds are found by bisection, and a map is made over the share."""
    total = model.scene.bodies.load
    for share in (
        (0.5,) if quick else (1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 0.9, 0.99, 0.999, 1 - 1e-4, 1 - 1e-5, 1 - 1e-6)
    ):
        low, high = math.log(1e-14), math.log(1e2)
        for _ in range(16 if quick else 40):
            middle = 0.5 * (low + high)
            try:
                found = friction(model, math.exp(middle))
            except LubfricError:
                break
            low, high = (middle, high) if found.contact_load > share * total else (low, middle)
        speed = math.exp(middle)
        yield judged(
            Condition("sharing: share of the contact", name, share, 0.0),
            "closure = load",
            lambda speed=speed: friction(model, speed),
            checked(model, speed),
        )
