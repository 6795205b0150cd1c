"""The deterministic model, one gap with one pressure, as a `FrictionResult`: its numbers, and what a reader has to
know."""

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from ..models.deterministic import (
    LEAST_FILM,
    MOST_CHANGE,
    DeterministicResult,
    Levels,
    levels_of,
    mean,
    strip_heat,
    too_hot,
    warmed,
)
from ..models.load_sharing import SampleSolution, control_for
from ..models.shared import (
    Decision,
    Heat,
    Prepared,
    Validity,
    error_by_heat,
    of_error,
    of_heat,
    of_inlet,
    of_motion,
    of_pressure,
    of_thickness,
    percent,
    student,
)
from ..quantities import depending_on
from ..samples import measured
from ..scene import Scene, moves
from .errors_of import TOO_SHORT
from .ranges import with_ranges
from .result import FrictionResult
from .uncertainty import (
    Uncertainty,
    field_errors_of,
    interval,
)

FEW_STRIPS = "not known from fewer than three strips"
ONE_HEAT = "heat is found on one strip"
BIASED = "a short patch, which balances the load by itself, is biased too: about lift-off f is some 10 % too low"
BY_FILM = "f by half the boundary film {:+.2g} %, by twice {:+.2g} %"
BY_INLET = "f without the heat of the inlet {:+.2g} %"
BY_FLOW = "f by a flow that is thinned half as much at the limiting stress {:+.2g} %"
OF_MODEL = (
    "the boundary film, the law of the flow, heat, or the scatter between the models leaves that",
    "give bodies.boundary_film if you know it, or a longer map",
)
LOOSER = "a larger numerics.tolerance"
# lubricant drawn from touching cells, load of a Newtonian film sheared beyond f_b p: told above
DRAWN = 0.1
CUT = 0.1


def strips_answer(prepared: Prepared, speed: float, found: SampleSolution | None, begun: float) -> FrictionResult:
    """Solve the strips of ``prepared`` at ``speed`` [m/s], which is not 0; ``found``: the sample of Eq. (8) there, if
    any. ``begun``: the starting time, by `time.perf_counter`. Raises `ConvergenceError`."""
    scene = prepared.scene
    levels = levels_of(prepared, speed, None if found is None else control_for(prepared, found))
    sample = prepared.sample
    numerics = scene.numerics
    results = [pair.resolved.result for pair in levels.pairs]
    heat = strip_heat(scene, results[0])
    numbers: dict[str, Any] = warmed(scene, levels.numbers, heat) | {"speed": speed}
    f = numbers["coefficient"]
    sampling = levels.sampling.error if math.isfinite(levels.sampling.error) else math.nan
    by_scatter = student(levels.difference.freedom) * levels.difference.error
    by_film = 0.0 if scene.bodies.boundary_film is not None else max(map(abs, levels.by_film))
    parts_of_model = {
        "the boundary film, whose thickness is not given: bodies.boundary_film narrows it": by_film,
        "the difference of the models from place to place: a smaller numerics.model_tolerance narrows it": by_scatter,
        "the flow of a film at its limiting stress, which theories leave open": abs(levels.by_flow),
        "heat, half of whose effect counts as its error": error_by_heat(heat, levels.by_inlet),
    }
    model = math.hypot(*parts_of_model.values())
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
        largest_in_model=max(parts_of_model, key=lambda part: parts_of_model[part]),
    )
    decision = _decision(scene, results, levels, heat)
    of_heat = dict.fromkeys(depending_on("heat"), heat.reason(scene) or ONE_HEAT)
    entries = (
        *_entries(prepared, numbers, results, heat),
        *of_error(levels.numerical, numerics.tolerance, _way_out(prepared)),
        *_of_model(model, numerics.model_tolerance),
    )
    finest = levels.pieces[0][-1] if sample.is_single_patch and levels.pieces else levels.pairs[0].resolved
    result = FrictionResult(
        **(numbers | {"seconds": time.perf_counter() - begun}),
        report=replace(results[0].report, notes=(decision.text, *(e.text for e in entries), known.text)),
        uncertainty=known,
        errors=field_errors_of(levels.errors | dict.fromkeys(of_heat, math.nan), FEW_STRIPS, of_heat),
        decision=decision,
        validity=entries,
        balance=None if found is None or sample.is_single_patch else found.balance,
        heights=None if found is None or sample.is_single_patch else found.contact.heights,  # type: ignore[attr-defined]
        deterministic=finest.result,
    )
    return with_ranges(prepared, result, levels.pairs[0].resolved if moves(scene) else finest)


def _decision(scene: Scene, results: Sequence[DeterministicResult], levels: Levels, heat: Heat) -> Decision:
    by_film = BY_FILM.format(*(100 * change for change in levels.by_film))
    by_flow = (BY_FLOW.format(100 * levels.by_flow),) if levels.by_flow else ()
    by_inlet = (BY_INLET.format(100 * levels.by_inlet),) if levels.by_inlet else ()
    notes = (*by_inlet, _division(results), by_film, *by_flow, *results[0].report.notes)
    words = _words_of_levels(levels)
    tolerance = scene.numerics.tolerance
    known = heat.text(tolerance)
    return Decision("deterministic", words, "boundary film", tolerance, strips=len(results), heat=known, notes=notes)


def _of_model(model: float, tolerance: float) -> Iterator[Validity]:
    """A warning where the error of the model, relative, is above ``tolerance``."""
    if model > tolerance:
        yield Validity("error of f by the model", 100 * model, 100 * tolerance, "%", *OF_MODEL)


def _way_out(prepared: Prepared) -> str:
    """What makes the error by the cells smaller: shorter ones, if the map has them."""
    scene = prepared.scene
    sample = prepared.sample
    if not sample.cells.is_native and (moves(scene) or not sample.is_single_patch):
        return f"numerics.grid = 'given' for shorter cells, or {LOOSER}"
    if prepared.given or measured(scene):
        return f"{LOOSER}, or a map with shorter cells"
    return f"a finer contact.spacing with numerics.grid = 'given', or {LOOSER}"


def _sample_notes(prepared: Prepared, sampling: float, length: float) -> tuple[str, ...]:
    """What a reader should know of the ``sampling`` error of strips of this ``length`` [m]."""
    sample = prepared.sample
    asked = prepared.scene.numerics.sampling_tolerance
    if math.isnan(sampling):
        return TOO_SHORT.format(length / sample.lengths[1]), BIASED
    return (f"the surface leaves more than the {percent(asked)} asked",) if sampling > asked else ()


def _words_of_levels(levels: Levels) -> str:
    """The film in one phrase: its strips and cells, and what was added up."""
    first = levels.pairs[0].resolved.result
    count = len(levels.pairs)
    pieces = levels.pieces
    strips = f"{count} strip{'s' if count > 1 else ''} of {first.pressure.shape[0]} x {first.pressure.shape[1]} cells"
    if pieces:
        times = round(pieces[0][1].result.spacing[0] / pieces[0][-1].result.spacing[0])
        strips += f", the effect of cells {times} times as short on {len(pieces)} piece{'s' if len(pieces) > 1 else ''}"
    if levels.shortest:
        strips += f", of cells {2 * times} times as short on a shorter one"
    if not levels.line:
        return f"one pressure with the contact on {strips}"
    return f"one pressure with the contact: its difference from Eq. (8) on {strips}, of a line of {levels.line}"


def _division(results: Sequence[DeterministicResult]) -> str:
    """The load that rubs with f_b, by its parts, in words."""
    touching, thin, capped = (
        100 * mean(getattr(result.split, name) / result.load for result in results)
        for name in ("touching", "thin", "capped")
    )
    return (
        f"load on touching cells {touching:.3g} %, on gaps below the boundary film {thin:.3g} %, on thicker Newtonian "
        f"films at f_b p {capped:.3g} %"
    )


def _entries(prepared: Prepared, numbers, results: Sequence[DeterministicResult], heat: Heat) -> Iterator[Validity]:
    """Entries for all assumptions that are violated; those about bodies and map first."""
    scene = prepared.scene
    speed = numbers["speed"]
    film = numbers["central_film"]
    yield from prepared.known
    yield from of_motion(scene, speed, film)
    flow = mean(result.flow_film for result in results)
    friction = abs(numbers["coefficient"]) * scene.bodies.load
    yield from of_inlet(scene, scene.line_contact(abs(speed)), flow, friction)
    for entry in of_pressure(scene, max(result.top_pressure for result in results)):
        yield replace(entry, severe=False)  # of one cell: no stress there is above the limit, whatever the pressure
    yield from of_thickness(scene, film)
    cut = mean(result.split.capped / result.load for result in results)
    if cut > CUT:
        consequence = "a Newtonian film would be sheared above f_b p there; its stress was limited to that"
        remedy = "choose lubricant.eyring_stress or a limiting stress"
        yield Validity("share of the load on a saturated film", cut, CUT, "", consequence, remedy)
    drawn = mean(result.drawn for result in results)
    if drawn > DRAWN:
        consequence = "f depends on the 1 nm of lubricant that touching bodies are said to keep, by about a percent"
        remedy = "read f to a percent or two: hardly any lubricant passes the contact"
        yield Validity("share of the lubricant out of touching cells", drawn, DRAWN, "", consequence, remedy)
    yield from of_heat(scene, heat)
    if why := too_hot(heat):
        parts = (1 - heat.film_factor) / (1 - LEAST_FILM), heat.change / MOST_CHANGE
        yield Validity("heat over the most that was checked", max(parts), 1.0, "", why, "read f with its interval")
