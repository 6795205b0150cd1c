"""The inputs of a scene that a publication states beside its methods."""

from collections.abc import Iterator
from pathlib import Path

from ..film import line_peak_pressure
from ..quantities import worded_value
from ..scene import Roughness, Scene
from ..units import worded

# Methods by which a pressure-viscosity coefficient is estimated (`lubfric.oil.Oil.pressure_viscosity_coefficient`).
ESTIMATED_BY = ("gold", "so-klaus")


def inputs_to_quote(scene: Scene, *, has_given_map: bool = False) -> tuple[str, ...]:
    """Return the roughness, the load, the lubricant and the boundary friction of ``scene``, each with its unit as text, as far as it
    has them. ``has_given_map``: whether maps were given in place of those of the scene."""
    bodies = scene.bodies
    peak = line_peak_pressure(bodies.load / bodies.width, bodies.radius, bodies.e_prime)
    texts = ["height map given as an array"] if has_given_map else [*_roughness(scene)]
    texts += [
        f"load {worded(bodies.load, 'N')} on a length of {worded(bodies.width, 'm')}",
        f"reduced radius {worded(bodies.radius, 'm')}",
        f"peak Hertz pressure {worded(peak, 'Pa')}",
        *_lubricant(scene),
        f"boundary friction coefficient {worded(bodies.boundary_friction_coefficient, '-')}",
    ]
    if bodies.boundary_film is not None:
        texts.append(f"boundary film {worded(bodies.boundary_film, 'm')}")
    return tuple(texts)


def _roughness(scene: Scene) -> Iterator[str]:
    for name, rough in (("", scene.surface), (" of the counterface", scene.counterface)):
        if rough is not None and rough.file is not None:
            yield f"height map{name} {Path(rough.file).name}"
        if rough is not None and rough.sq is not None:
            yield f"Sq{name} {worded(rough.sq, 'm')}{_correlation_length(rough)}"


def _correlation_length(rough: Roughness) -> str:
    if rough.correlation_length is None:
        return ""
    return f" with a correlation length of {worded(rough.correlation_length, 'm')} ({rough.acf} autocorrelation)"


def _lubricant(scene: Scene) -> Iterator[str]:
    lubricant = scene.lubricant
    yield f"viscosity {worded(lubricant.viscosity, 'Pa s')}" + (
        "" if lubricant.temperature is None else f" at {worded_value('lubricant.temperature', lubricant.temperature)}"
    )
    if lubricant.viscosity_law != "constant":
        estimate = ""
        if lubricant.oil is not None and lubricant.temperature is not None:
            estimate = lubricant.oil.pressure_viscosity_coefficient(lubricant.temperature).method
        is_estimated = estimate in ESTIMATED_BY
        alpha = worded(lubricant.pressure_viscosity_coefficient, "1/Pa")
        yield f"pressure-viscosity coefficient {alpha}{' (estimated)' if is_estimated else ''}"
    if lubricant.eyring_stress is not None:
        yield f"Eyring stress {worded(lubricant.eyring_stress, 'Pa')}"
    if lubricant.carreau is not None:
        (stress, exponent) = lubricant.carreau
        yield f"critical stress {worded(stress, 'Pa')} and exponent {exponent:.4g} of Carreau's law"
    if lubricant.limit is not None:
        yield (
            f"limiting stress {worded(lubricant.limiting_stress_offset, 'Pa')} + {lubricant.limiting_stress_coefficient:.4g} times the pressure"
        )
