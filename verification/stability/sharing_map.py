"""Load sharing: film to roughness ratio, roughness from 1 nm to 2 um, share of the contact, entrainment of any sign.

The judge solves neither for the load split nor with the library's film: at the film load found it takes the film of
the differential deflection, measures the gap of a fresh dry contact at the contact load found, and adds up loads and
friction forces again.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from lubfric import LubfricError, friction, load_scene, solve_contact, solve_differential_deflection, solve_ehl
from lubfric.mixed import Model, prepare

from .cell import Cell, Condition, judged

ALLOWED = {"load": 1e-9, "volume": 0.02, "film": 2.0, "friction": 1e-9, "bounds": 1e-9}


def cells(level: str) -> Iterator[Cell]:
    """All load-sharing cells of ``level`` ("quick" or "full")."""
    quick = level == "quick"
    yield from curves("flat", quick)
    yield from curves("paper", quick)
    yield from special_speeds(quick)


def model_of(name: str, sq: float, shape: int, **sections) -> Model:
    """A built-in scene with another roughness on a small grid."""
    scene = load_scene(name)
    if name == "flat":
        roughness = {"sq": sq, "correlation_length": 0.08e-6 * shape}
        grid = {"shape": (shape, shape), "spacing": 1e-6}
    else:
        roughness = {"sq": sq, "correlation_length": 9e-6 * 32 / shape if shape < 48 else 4e-6}
        grid = {"shape": (shape, shape // 2), "spacing": 90e-6 / shape}
    return prepare(scene.with_(surface=roughness, contact=grid, **sections))


def speed_for(scene, film_thickness: float) -> float:
    """Entrainment speed [m/s] at which the smooth film of the whole load has about that thickness: bisection."""
    low, high = math.log(1e-12), math.log(1e4)
    for _ in range(14):
        middle = 0.5 * (low + high)
        film = solve_ehl(**film_case(scene, scene.bodies.load, math.exp(middle)), tolerance=0.05).central_film
        low, high = (middle, high) if film < film_thickness else (low, middle)
    return math.exp(0.5 * (low + high))


def film_case(scene, load: float, speed: float) -> dict:
    """Arguments of the film solvers for ``load`` [N]."""
    bodies, oil = scene.bodies, scene.lubricant
    return {"load_per_width": load / bodies.width, "radius": bodies.radius, "e_prime": bodies.e_prime,
            "entrainment_speed": speed, "viscosity": oil.viscosity,
            "pressure_viscosity_coefficient": oil.pressure_viscosity_coefficient,
            "viscosity_law": oil.viscosity_law, "density": oil.density_law}


def checked(model: Model, speed: float):
    """check(result) for `judged`."""
    def check(result) -> dict[str, float]:
        scene = model.scene
        total = scene.bodies.load
        carried = result.contact_load + result.film_load
        forces = result.boundary_force + result.shear_force
        found = {"load": abs(carried / total - 1), "friction": abs(result.coefficient * total - forces) / abs(forces)}
        ratios = {name: value / ALLOWED[name] for name, value in found.items()}
        share = result.contact_load / total
        ratios["bounds"] = 0.0 if -1e-12 <= share <= 1 + 1e-12 and result.real_contact_area_fraction <= 1 else math.inf
        if speed != 0:
            film = judge_film(scene, result.film_load, speed)
            gap, mean = judge_gap(model, result, film)
            ratios["film"] = abs(result.min_film / film.min_film - 1) / (ALLOWED["film"] * scene.numerics.film_tolerance)
            ratios["volume"] = (abs(gap - mean) / (gap + mean) if result.contact_load > 0 else max(0.0, gap - mean) / mean
                                ) / ALLOWED["volume"]
        return ratios
    return check


def judge_film(scene, load: float, speed: float):
    """By differential deflection, or if that does not converge by the tightest Newton solution."""
    case = film_case(scene, load, speed)
    try:
        return solve_differential_deflection(**case, tolerance=1e-3)
    except LubfricError:
        return solve_ehl(**case, tolerance=1e-4)


def judge_gap(model: Model, result, film) -> tuple[float, float]:
    """(mean gap, mean film) over A [m]: a dry contact solved afresh at the contact load found (touching if none)."""
    patch, scene = model.patch, model.scene
    heights, spacing = model.surface.heights - model.surface.heights.mean(), model.surface.spacing
    x = patch.x
    smooth = film.film_at(x)
    load = max(result.contact_load, 1e-12 * scene.bodies.load)
    if scene.contact.geometry == "flat":
        pressure, gap0, weight = load / patch.area, heights.max() - heights, np.ones(x.size)
        boundary = ("periodic", "periodic")
    else:
        pressure = load / (scene.bodies.width * x.size * spacing[0])
        gap0, weight, boundary = smooth[:, None] - heights, patch.region_weight, ("free", "periodic")
    dry = solve_contact(gap0, spacing, scene.bodies.e_prime, mean_pressure=pressure, hardness=scene.bodies.hardness,
                        boundary=boundary, tolerance=1e-6)
    gap = np.maximum(dry.gap, 0)
    if scene.contact.geometry == "flat":
        return float(gap.mean()), float(smooth.mean())
    return float(gap.mean(axis=1) @ weight / weight.sum()), float(smooth @ weight / weight.sum())


def curves(name: str, quick: bool) -> Iterator[Cell]:
    """Lambda 0.01 to 10 by roughness 1 nm to 2 um, both closures; the paper's closure is not the default."""
    roughness = np.geomspace(1e-9, 2e-6, 2 if quick else 7)
    ratios = np.geomspace(0.01, 10, 3 if quick else 13 if name == "flat" else 9)
    for sq in roughness:
        base = model_of(name, float(sq), 32 if quick else 64 if name == "flat" else 48)
        for ratio in ratios:
            speed = speed_for(base.scene, float(ratio * sq))
            for closure in ("load", "separation"):
                model = replace(base, scene=base.scene.with_(numerics={"closure": closure}))
                if closure == "separation" and name == "flat":
                    continue                            # its curve has to reach further: prepared anew below
                yield judged(Condition(f"sharing: {name}", "lambda by roughness", ratio, sq), f"closure = {closure}",
                             lambda model=model, speed=speed: friction(model, speed), checked(model, speed),
                             closure == "load")


def special_speeds(quick: bool) -> Iterator[Cell]:
    """Nearly all film, nearly all contact, no entrainment, reversed entrainment."""
    for column, name in enumerate(("flat", "paper")):
        model = model_of(name, 100e-9, 32 if quick else 64)
        for speed in (0.0, -0.01, 0.01) if quick else (0.0, *np.geomspace(1e-10, 30, 24), *-np.geomspace(1e-10, 30, 24)):
            here = Condition("sharing: speed, either sign", name, float(speed), column)
            yield judged(here, "closure = load", lambda model=model, speed=speed: friction(model, float(speed)),
                         checked(model, float(speed)))
        yield from shares(model, name, quick)


def shares(model: Model, name: str, quick: bool) -> Iterator[Cell]:
    """F_C/F_T from 1e-6 to 1 - 1e-6: speeds found by bisection, then a map over the share."""
    total = model.scene.bodies.load
    for share in (1e-2, 0.5) if quick else (1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 0.9, 0.99, 0.999, 1 - 1e-4, 1 - 1e-5, 1 - 1e-6):
        low, high = math.log(1e-14), math.log(1e2)
        for _ in range(20 if quick else 40):
            middle = 0.5 * (low + high)
            try:
                found = friction(model, math.exp(middle))
            except LubfricError:
                break
            low, high = (middle, high) if found.contact_load > share * total else (low, middle)
        speed = math.exp(middle)
        yield judged(Condition("sharing: share of the contact", name, share, 0.0), "closure = load",
                     lambda speed=speed: friction(model, speed), checked(model, speed))
