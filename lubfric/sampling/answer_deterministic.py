"""The deterministic model, one gap with one pressure, as a `FrictionResult`: its numbers, and what a reader has to
know."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ..deterministic import Refined, deterministic_point
from ..sharing import Decision, Prepared, Validity, of_error, of_motion, of_pressure, of_thickness
from .answer_resolved import resolved_result
from .result import FrictionResult
from .uncertainty import field_errors_of, not_sampled

NO_PLACES = "not estimated for one pressure of film and contact"
DRAWN, CUT = 0.1, 0.1  # lubricant drawn from touching cells, load of a Newtonian film sheared beyond f_b p: told above


def deterministic_answer(
    prepared: Prepared, speed: float, start: FrictionResult | None, begun: float
) -> FrictionResult:
    """Solve ``prepared`` at ``speed`` [m/s], which is not 0. ``start``: the result of a neighbouring speed; ``begun``:
    the starting time, by `time.perf_counter`."""
    scene, surface = prepared.scene, prepared.surface
    found = deterministic_point(scene, surface, speed, None if start is None else start.deterministic)
    known = {} if found.error is None else {"coefficient": found.error}
    decision = Decision(
        "deterministic", "asperity spots", scene.numerics.tolerance, film_words=_words(found), notes=_notes(found)
    )
    entries = tuple(_entries(prepared, speed, found))
    per_width, numbers = _per_width(prepared, found), _numbers(prepared, found)
    return replace(
        resolved_result(prepared, speed, begun, decision, found.result.report, entries, per_width, numbers),
        deterministic=found,
        uncertainty=not_sampled(found.error, scene, surface.size[1], NO_PLACES),
        errors=field_errors_of(known, NO_PLACES),
    )


def _per_width(prepared: Prepared, found: Refined) -> dict[str, float]:
    bodies, result = prepared.scene.bodies, found.result
    return {
        "contact_load": result.split.spots,
        "film_load": bodies.load / bodies.width - result.split.spots,
        "boundary_force": result.boundary,
        "couette_force": result.couette,
        "rolling_force": result.rolling,
    }


def _numbers(prepared: Prepared, found: Refined) -> dict[str, float]:
    result, width = found.result, prepared.scene.bodies.width
    dx, dy = result.spacing
    area = float(result.spots.sum()) * dx * dy
    return {
        "coefficient": result.coefficient,
        "real_contact_area_fraction": result.spot_fraction,
        "real_contact_area": area * width / prepared.surface.size[1],
        "plastic_area_fraction": result.plastic_fraction,
        "min_film": result.min_gap,
        "central_film": result.central_gap,
        "mean_gap": result.mean_gap,
        "load_residual": result.report.residuals["load"],
    }


def _words(found: Refined) -> str:
    """The film of ``found`` in one phrase: its grids and their estimated error."""
    shapes = " and ".join(f"{r.pressure.shape[0]} x {r.pressure.shape[1]}" for r in found.results[-2:])
    error = "" if found.error is None else f", estimated error {100 * found.error:.2g} % of f"
    return f"one pressure with the contact on {shapes} cells{error}"


def _notes(found: Refined) -> tuple[str, ...]:
    """The division of the load by each rule, and how the finest grid was solved, in words."""
    result = found.result
    split, load = result.split, result.load
    return (
        f"load on touching cells {100 * split.touching / load:.3g} %, on asperity spots {100 * split.spots / load:.3g} "
        f"%, where the film is sheared beyond f_b p too {100 * split.saturated / load:.3g} %",
        *result.report.notes,
    )


def _entries(prepared: Prepared, speed: float, found: Refined) -> Iterator[Validity]:
    """Entries for all assumptions that are violated; those about bodies and map first."""
    scene, result = prepared.scene, found.result
    yield from prepared.known
    yield from of_motion(scene, speed, result.central_gap)
    yield from of_pressure(scene, float(result.pressure[result.wet].max(initial=0.0)))
    yield from of_thickness(scene, result.central_gap)
    cut = (result.split.saturated - result.split.spots) / result.load
    if scene.lubricant.newtonian and cut > CUT:
        consequence = "a Newtonian film would be sheared above f_b p there; its stress was limited to that"
        remedy = "choose lubricant.eyring_stress or a limiting stress"
        yield Validity("share of the load on a saturated film", cut, CUT, "", consequence, remedy)
    if result.drawn > DRAWN:
        consequence = "f depends on the 1 nm of lubricant that touching bodies are said to keep, by about a percent"
        remedy = "read f to a percent or two: hardly any lubricant passes the contact"
        yield Validity("share of the lubricant out of touching cells", result.drawn, DRAWN, "", consequence, remedy)
    yield from of_error(found.error, scene.numerics.tolerance, "a finer contact.spacing, a larger tolerance")
