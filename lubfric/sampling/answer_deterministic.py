"""The deterministic model, one gap with one pressure, as a `FrictionResult`: its numbers, and what a reader has to
know."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from ..deterministic import DeterministicResult, Refined, deterministic_point
from ..scene import Scene
from ..sharing import Prepared, Validity, inlet_at, of_error, of_inlet, of_motion, of_pressure, of_thickness
from .decision import Decision
from .errors_of import TOO_SHORT
from .levels import Levels, levels_of
from .pair import numbers_of
from .result import FrictionResult
from .sample import Found
from .uncertainty import Uncertainty, field_errors_of, interval, not_sampled, percent, student

NO_PLACES = "not estimated for one pressure of film and contact"
FEW_STRIPS = "not known from fewer than three strips"
BIASED = "a short patch, which balances the load by itself, is biased too: about lift-off f is some 10 % too low"
BY_FILM = "f by half the boundary film {:+.2g} %, by twice {:+.2g} %"
FINER = "a larger numerics.tolerance, or a finer contact.spacing"
DRAWN, CUT = 0.1, 0.1  # lubricant drawn from touching cells, load of a Newtonian film sheared beyond f_b p: told above


def strips_answer(prepared: Prepared, speed: float, found: Found, begun: float) -> FrictionResult:
    """Solve the strips of ``prepared`` at ``speed`` [m/s], which is not 0; ``found``: the sample of Eq. (8) there.
    ``begun``: the starting time, by `time.perf_counter`. The film is isothermal. Raises `ConvergenceError`."""
    scene, levels = prepared.scene, levels_of(prepared, speed, found)
    numerics, f = scene.numerics, levels.numbers["coefficient"]
    sampling = levels.sampling.error if math.isfinite(levels.sampling.error) else math.nan
    results = [pair.resolved.result for pair in levels.pairs]
    by_scatter = student(levels.difference.freedom) * levels.difference.error
    model = math.hypot(by_scatter, _film_error(scene, levels.by_film))
    known = Uncertainty(
        numerical=levels.numerical,
        sampling=sampling,
        model=model,
        interval=interval(f, levels.numerical, sampling, levels.sampling.freedom, model),
        line_scatter=sampling * math.sqrt(levels.length / scene.bodies.width),
        length=levels.length,
        freedom=float(levels.sampling.freedom),
        tolerance=numerics.sampling_tolerance,
        notes=_sample_notes(prepared, sampling, levels.length),
    )
    first = levels.pairs[0]
    on_grids = tuple(strip.result for strip in (first.resolved, first.finer) if strip is not None)
    return _answer(
        prepared,
        levels.numbers | {"speed": speed},
        results,
        begun,
        decision=_decision(scene, results, _words_of_levels(levels), levels.by_film),
        uncertainty=known,
        errors=field_errors_of(levels.errors, FEW_STRIPS),
        balance=found.balance,
        deterministic=Refined(on_grids, levels.numerical),
    )


def patch_answer(prepared: Prepared, speed: float, begun: float) -> FrictionResult:
    """Solve the one patch of ``prepared`` at ``speed`` [m/s], which is not 0, on finer and finer grids. ``begun``: the
    starting time, by `time.perf_counter`. The film is isothermal. Raises `ConvergenceError`."""
    scene, surface = prepared.scene, prepared.surface
    found = deterministic_point(scene, surface, speed)
    shapes = " and ".join(f"{r.pressure.shape[0]} x {r.pressure.shape[1]}" for r in found.results[-2:])
    error = "" if found.error is None else f", estimated error {100 * found.error:.2g} % of f"
    result = found.result
    by_film = result.at_half_film / result.coefficient - 1, result.at_twice_film / result.coefficient - 1
    known = not_sampled(found.error, scene, surface.size[1], NO_PLACES)
    return _answer(
        prepared,
        numbers_of(scene, surface.sq, result) | {"speed": speed},
        [result],
        begun,
        decision=_decision(scene, [result], f"one pressure with the contact on {shapes} cells{error}", by_film),
        uncertainty=replace(known, model=_film_error(scene, by_film)),
        errors=field_errors_of({} if found.error is None else {"coefficient": found.error}, NO_PLACES),
        deterministic=found,
    )


def _answer(prepared: Prepared, numbers, results, begun: float, *, decision, uncertainty, **parts) -> FrictionResult:
    """The `FrictionResult` of ``numbers``, from the ``results`` of one strip or more."""
    numerics = prepared.scene.numerics
    numerical, model = uncertainty.numerical, uncertainty.model
    entries = (
        *_entries(prepared, numbers, results),
        *of_error(numerical, numerics.tolerance, FINER),
        *_of_model(model, numerics.model_tolerance),
    )
    return FrictionResult(
        **(numbers | {"seconds": time.perf_counter() - begun}),
        report=replace(results[0].report, notes=(decision.text, *(e.text for e in entries), uncertainty.text)),
        uncertainty=uncertainty,
        decision=decision,
        validity=entries,
        **parts,
    )


def _decision(scene: Scene, results: Sequence[DeterministicResult], words: str, by_film) -> Decision:
    notes = (_division(results), BY_FILM.format(*(100 * change for change in by_film)), *results[0].report.notes)
    return Decision("deterministic", words, "boundary film", scene.numerics.tolerance, strips=len(results), notes=notes)


def _of_model(model: float, tolerance: float) -> tuple[Validity, ...]:
    """A caution where the error of the model, relative, is above ``tolerance``."""
    if not model > tolerance:
        return ()
    what, consequence = "error of f by the model", "the boundary film, or the scatter between the models, leaves that"
    remedy = "give bodies.boundary_film if you know it, or a longer map"
    return (Validity(what, 100 * model, 100 * tolerance, "%", consequence, remedy),)


def _sample_notes(prepared: Prepared, sampling: float, length: float) -> tuple[str, ...]:
    """What a reader should know of the ``sampling`` error of strips of this ``length`` [m]."""
    strips, asked = prepared.strips, prepared.scene.numerics.sampling_tolerance
    assert strips is not None
    if math.isnan(sampling):
        return TOO_SHORT.format(length / strips.lengths[1]), BIASED
    return (f"more than the {percent(asked)} asked",) if sampling > asked else ()


def _words_of_levels(levels: Levels) -> str:
    """The film in one phrase: its strips and cells, and what was added up."""
    first = levels.pairs[0].resolved.result
    count, finer = len(levels.pairs), levels.finer
    strips = f"{count} strip{'s' if count > 1 else ''} of {first.pressure.shape[0]} x {first.pressure.shape[1]} cells"
    cells = f", {finer} of them on cells half as long too" if finer else ""
    if not levels.line:
        return f"one pressure with the contact on {strips}{cells}"
    return f"one pressure with the contact: its difference from Eq. (8) on {strips}{cells}, of a line of {levels.line}"


def _division(results: Sequence[DeterministicResult]) -> str:
    """The load that rubs with f_b, by its parts, in words."""
    touching, thin, capped = (
        100 * _mean(getattr(result.split, name) / result.load for result in results)
        for name in ("touching", "thin", "capped")
    )
    return (
        f"load on touching cells {touching:.3g} %, on gaps below the boundary film {thin:.3g} %, on thicker Newtonian "
        f"films at f_b p {capped:.3g} %"
    )


def _film_error(scene: Scene, by_film: Sequence[float]) -> float:
    """Relative error of f by the boundary film: the larger change by half and by twice of it, unless it is given."""
    return 0.0 if scene.bodies.boundary_film is not None else max(map(abs, by_film))


def _mean(values) -> float:
    return float(np.mean(list(values)))


def _entries(prepared: Prepared, numbers, results: Sequence[DeterministicResult]) -> Iterator[Validity]:
    """Entries for all assumptions that are violated; those about bodies and map first."""
    scene, speed, film = prepared.scene, numbers["speed"], numbers["central_film"]
    yield from prepared.known
    yield from of_motion(scene, speed, film)
    yield from of_inlet(scene, speed, _mean(result.flow_film for result in results))
    for entry in of_pressure(scene, max(result.top_pressure for result in results)):
        yield replace(entry, severe=False)  # of one cell: no stress there is above the limit, whatever the pressure
    yield from of_thickness(scene, film)
    cut = _mean(result.split.capped / result.load for result in results)
    if cut > CUT:
        consequence = "a Newtonian film would be sheared above f_b p there; its stress was limited to that"
        remedy = "choose lubricant.eyring_stress or a limiting stress"
        yield Validity("share of the load on a saturated film", cut, CUT, "", consequence, remedy)
    drawn = _mean(result.drawn for result in results)
    if drawn > DRAWN:
        consequence = "f depends on the 1 nm of lubricant that touching bodies are said to keep, by about a percent"
        remedy = "read f to a percent or two: hardly any lubricant passes the contact"
        yield Validity("share of the lubricant out of touching cells", drawn, DRAWN, "", consequence, remedy)
    yield from _heat_left_out(scene, speed, numbers["couette_force"] / scene.bodies.width, film)


def _heat_left_out(scene: Scene, speed: float, couette: float, film: float) -> tuple[Validity, ...]:
    """A caution if the heat that these models leave out would matter.

    It matters by the heat of the inlet, or by the viscosity that the film loses. For the latter, the mean rise of the
    film over its walls is ``tau du h/(12 k)``. ``couette``: its force [N/m].
    """
    inlet, _ = inlet_at(scene, speed)
    if inlet is None:
        return ()
    lubricant, sliding = scene.lubricant, abs(scene.motion.slide_roll_ratio * speed)
    stress = abs(couette) / (2 * scene.bodies.half_width)
    rise = stress * sliding * film / (12 * lubricant.conductivity)
    change = max(1 - inlet.factor, rise * (lubricant.temperature_coefficient or 0.0))
    if not change > scene.numerics.tolerance:
        return ()
    return (
        Validity(
            "loss of film or viscosity by heat",
            change,
            scene.numerics.tolerance,
            "",
            "this model is isothermal: in truth the film is thinner and shears more easily",
            "load sharing (numerics.model = 'auto') has the heat; heat = 'off' asks for none",
        ),
    )
