"""The deterministic model, one gap with one pressure, as a `FrictionResult`: its numbers, and what a reader has to
know."""

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from ..deterministic import DeterministicResult, Refined
from ..scene import Scene
from ..sharing import Prepared, Validity, inlet_at, of_error, of_inlet, of_motion, of_pressure, of_thickness
from .decision import Decision
from .errors_of import TOO_SHORT
from .levels import Levels, levels_of, mean
from .result import FrictionResult
from .sample import Found
from .uncertainty import Uncertainty, field_errors_of, interval, percent, student

FEW_STRIPS = "not known from fewer than three strips"
BIASED = "a short patch, which balances the load by itself, is biased too: about lift-off f is some 10 % too low"
BY_FILM = "f by half the boundary film {:+.2g} %, by twice {:+.2g} %"
BY_FLOW = "f by a flow that is thinned half as much at the limiting stress {:+.2g} %"
OF_MODEL = (
    "the boundary film, the law of the flow, or the scatter between the models leaves that",
    "give bodies.boundary_film if you know it, or a longer map",
)
FINER = "a larger numerics.tolerance, or a finer contact.spacing"
DRAWN, CUT = 0.1, 0.1  # lubricant drawn from touching cells, load of a Newtonian film sheared beyond f_b p: told above


def strips_answer(prepared: Prepared, speed: float, found: Found | None, begun: float) -> FrictionResult:
    """Solve the strips of ``prepared`` at ``speed`` [m/s], which is not 0; ``found``: the sample of Eq. (8) there, if
    any. ``begun``: the starting time, by `time.perf_counter`. The film is isothermal. Raises `ConvergenceError`."""
    scene, levels, strips = prepared.scene, levels_of(prepared, speed, found), prepared.strips
    assert strips is not None
    numerics = scene.numerics
    numbers: dict[str, Any] = levels.numbers | {"speed": speed}
    f, results = numbers["coefficient"], [pair.resolved.result for pair in levels.pairs]
    sampling = levels.sampling.error if math.isfinite(levels.sampling.error) else math.nan
    by_scatter = student(levels.difference.freedom) * levels.difference.error
    by_film = 0.0 if scene.bodies.boundary_film is not None else max(map(abs, levels.by_film))
    model = math.hypot(by_scatter, by_film, levels.by_flow)
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
    decision = _decision(scene, results, levels)
    entries = (
        *_entries(prepared, numbers, results),
        *of_error(levels.numerical, numerics.tolerance, FINER),
        *_of_model(model, numerics.model_tolerance),
    )
    grids = levels.pieces[0] if strips.whole and levels.pieces else (levels.pairs[0].resolved,)
    return FrictionResult(
        **(numbers | {"seconds": time.perf_counter() - begun}),
        report=replace(results[0].report, notes=(decision.text, *(e.text for e in entries), known.text)),
        uncertainty=known,
        errors=field_errors_of(levels.errors, FEW_STRIPS),
        decision=decision,
        validity=entries,
        balance=None if found is None or strips.whole else found.balance,
        deterministic=Refined(tuple(strip.result for strip in grids), levels.numerical),
    )


def _decision(scene: Scene, results: Sequence[DeterministicResult], levels: Levels) -> Decision:
    by_film = BY_FILM.format(*(100 * change for change in levels.by_film))
    by_flow = (BY_FLOW.format(100 * levels.by_flow),) if levels.by_flow else ()
    notes = (_division(results), by_film, *by_flow, *results[0].report.notes)
    words, tolerance = _words_of_levels(levels), scene.numerics.tolerance
    return Decision("deterministic", words, "boundary film", tolerance, strips=len(results), notes=notes)


def _of_model(model: float, tolerance: float) -> Iterator[Validity]:
    """A caution where the error of the model, relative, is above ``tolerance``."""
    if model > tolerance:
        yield Validity("error of f by the model", 100 * model, 100 * tolerance, "%", *OF_MODEL)


def _sample_notes(prepared: Prepared, sampling: float, length: float) -> tuple[str, ...]:
    """What a reader should know of the ``sampling`` error of strips of this ``length`` [m]."""
    strips, asked = prepared.strips, prepared.scene.numerics.sampling_tolerance
    assert strips is not None
    if math.isnan(sampling):
        return TOO_SHORT.format(length / strips.lengths[1]), BIASED
    return (f"the surface leaves more than the {percent(asked)} asked",) if sampling > asked else ()


def _words_of_levels(levels: Levels) -> str:
    """The film in one phrase: its strips and cells, and what was added up."""
    first, count, pieces = levels.pairs[0].resolved.result, len(levels.pairs), levels.pieces
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


def _entries(prepared: Prepared, numbers, results: Sequence[DeterministicResult]) -> Iterator[Validity]:
    """Entries for all assumptions that are violated; those about bodies and map first."""
    scene, speed, film = prepared.scene, numbers["speed"], numbers["central_film"]
    yield from prepared.known
    yield from of_motion(scene, speed, film)
    flow = mean(result.flow_film for result in results)
    yield from of_inlet(scene, flow, scene.line_contact(speed).moes_film)
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
    what, tolerance = "loss of film or viscosity by heat", scene.numerics.tolerance
    consequence = "this model is isothermal: in truth the film is thinner and shears more easily"
    remedy = "load sharing (numerics.model = 'auto') has the heat; heat = 'off' asks for none"
    return (Validity(what, change, tolerance, "", consequence, remedy),) if change > tolerance else ()
