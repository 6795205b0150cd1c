"""What a fit will cost, before anything is solved."""

from __future__ import annotations

from ..scene import Scene
from ..sharing import scene_of
from .cost import Ground, by_curve, film_clock, ground_of, in_words, mean_speed, point_seconds
from .fit_parameters import Parameters, parameters_of
from .fit_predict import shares_contact, tolerance_of
from .measured import SPEED, Measured

WARM = 0.5  # of the first curve: a curve whose points start from those of another
STEPS = 3  # curves of a search, beside the first and those of the differences


def explain_fit(scene: Scene, measured: Measured, parameters) -> str:
    """What a fit will do and about how long it will take, in words.

    The map is made, and one film is solved to time this machine. No point is solved.

    Parameters
    ----------
    scene : what is known, as for `lubfric.fit`
    measured : from `lubfric.read_measured`, or `lubfric.Measured(speeds, coefficients)`
    parameters : {"section.key": (lowest, highest)}, in SI units

    Returns
    -------
    Text of some lines

    Raises
    ------
    InputError : a parameter is not one
    """
    found = parameters_of(scene_of(scene), parameters)
    shared = shares_contact(scene, found)
    count = f"{len(found.keys)} parameter{'s' if len(found.keys) > 1 else ''}"
    lines = [f"fit of {count} of {scene.name} to {measured.x.size} points of {measured.source}"]
    for key, low, high, logarithmic in zip(found.keys, found.low, found.high, found.logarithmic):
        lines.append(f"  {key}: {low:g} to {high:g}{', sought in its logarithm' if logarithmic else ''}")
    once = "made once" if shared else "made again for every curve: they depend on a parameter"
    return "\n".join([*lines, f"  map and contact: {once}", f"  time: {_foretold(scene, measured, found, shared)}"])


def _foretold(scene: Scene, measured: Measured, parameters: Parameters, shared: bool) -> str:
    if scene.numerics.model == "deterministic" or scene.numerics.closure == "one-way":
        return "not foretold where the fluid between the asperities is solved for"
    tight = scene.with_(numerics={"tolerance": tolerance_of(scene, measured)})
    ground = ground_of(tight, by_curve(tight))
    more = len(parameters.keys) + shared + STEPS  # both ends of a difference start from one curve
    first = _curve_seconds(tight, ground, measured)
    whole = ground.making + first * (1 + WARM * more) if shared else (ground.making + first) * (1 + more)
    curves = f"some {1 + more} curves, the first {in_words(first)}"
    return f"about {in_words(whole)} on one core (within a factor of 3): {curves}"


def _curve_seconds(scene: Scene, ground: Ground, measured: Measured) -> float:
    """Processor seconds of a first curve at the measured points."""
    speeds = measured.x.tolist() if measured.over == SPEED else [scene.motion.entrainment_speed] * measured.x.size
    film = film_clock(scene, mean_speed(speeds))
    return sum(point_seconds(scene, ground, speed, film) for speed in speeds)
