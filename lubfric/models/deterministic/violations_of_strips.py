"""The assumptions of the deterministic model that its strips violate, and the error by touching cells."""

from collections.abc import Iterator, Sequence

from ...oil import NO_LIQUID
from ...scene import BOUNDARY_FILM_KEY, Scene
from ..shared import (
    GIVE_LIMIT,
    Assumption,
    Heat,
    Prepared,
    Violation,
    peak_hertz_pressure,
    percent_or_less,
    violations_by_asperities,
    violations_by_heat,
    violations_by_inlet,
    violations_by_motion,
    violations_by_pressure,
    violations_by_thickness,
)
from .heat_of_strip import LEAST_FILM, MOST_CHANGE, why_too_hot
from .levels import mean
from .problem import BOUNDARY_FILM
from .result import DeterministicResult

# Where a local peak of the film pressure is, by whether asperities carry load. The picture of the contact is of another
# solve, with the contacts.
FILM_OF_STRIPS = {
    True: "of single cells of the film, next to asperity contacts",
    False: "of single cells of the film over the roughness",
}

# Share of the lubricant out of touching cells above which a note reports how f depends on the assumed gap between them.
# A choice: a smaller value reports more points.
MOST_GIVEN_OFF = 0.1

# The cause of the error by those cells.
BY_GAP = "the assumed gap of 1 nm between touching cells"

# Share of the load on a film without a limit that is sheared beyond f_b p above which a warning reports it. A choice: a
# smaller value warns of more points.
CUT = 0.1


def violations_of_strips(
    prepared: Prepared, numbers: dict[str, float], results: Sequence[DeterministicResult], heat: Heat
) -> Iterator[Violation]:
    """Yield the violations of the strips, those about bodies and map first."""
    scene = prepared.scene
    speed = numbers["speed"]
    film = numbers["central_film"]
    yield from prepared.violations
    yield from violations_by_motion(scene, speed, film)
    flow = mean(result.flow_film for result in results)
    friction_force = abs(numbers["coefficient"]) * scene.bodies.load
    yield from violations_by_inlet(scene, scene.line_contact(abs(speed)), flow, friction_force)
    peak = max(peak_hertz_pressure(scene), *(result.top_pressure for result in results))
    yield from violations_by_pressure(scene, peak, FILM_OF_STRIPS[numbers["contact_load"] > 0])
    if peak <= NO_LIQUID:  # else the warning of the film recommends the hardness
        asperities = (float(result.pressure[result.rubbing].max(initial=0.0)) for result in results)
        yield from violations_by_asperities(scene, max(asperities))
    yield from violations_by_thickness(scene, film)
    yield from _violations_by_boundary_film(scene, film)
    yield from _violations_by_saturation(results)
    yield from _violations_by_touching_cells(results)
    yield from violations_by_heat(scene, heat)
    yield from _violations_by_strong_heat(heat)


def _violations_by_boundary_film(scene: Scene, film: float) -> Iterator[Violation]:
    """Yield the violation of a central ``film`` [m] below the boundary film that is assumed where none is given."""
    if scene.bodies.boundary_film is None and film < BOUNDARY_FILM:
        yield Violation(
            assumption=Assumption.ABOVE_BOUNDARY_FILM,
            what="film thickness",
            value=1e9 * film,
            limit=1e9 * BOUNDARY_FILM,
            unit="nm",
            consequence="on gaps below the boundary film the shear stress is f_b p, and their load counts as asperity load; the "
            "boundary film is not "
            f"given, and the model-form error of f contains half and twice {1e9 * BOUNDARY_FILM:g} nm",
            recommendation=f"give {BOUNDARY_FILM_KEY} if it is measured",
        )


def _violations_by_saturation(results: Sequence[DeterministicResult]) -> Iterator[Violation]:
    """Yield the violation of a large load on film that is cut at f_b p."""
    cut = mean(result.split.capped / result.load for result in results)
    if cut > CUT:
        consequence = (
            "the limiting stress of the oil is not given, so the shear stress of the film is limited to f_b p there"
        )
        yield Violation(
            assumption=Assumption.FILM_BELOW_ITS_LIMIT,
            what="share of the load on a saturated film (strips of the deterministic model)",
            value=cut,
            limit=CUT,
            unit="",
            consequence=consequence,
            recommendation=GIVE_LIMIT,
        )


def _violations_by_touching_cells(results: Sequence[DeterministicResult]) -> Iterator[Violation]:
    """Yield the note of a large share of lubricant that comes out of touching cells."""
    share = share_given_off(results)
    if share > MOST_GIVEN_OFF:
        consequence = (
            "little lubricant passes through the contact, and f changes with the assumed gap of 1 nm between touching "
            f"cells; the interval of f includes an error of {percent_or_less(error_by_gap_of(results), 2)} for this"
        )
        yield Violation(
            assumption=Assumption.LUBRICANT_PASSES,
            what="share of the lubricant that comes from touching cells",
            value=share,
            limit=MOST_GIVEN_OFF,
            unit="",
            is_note=True,
            consequence=consequence,
            recommendation="",
        )


def _violations_by_strong_heat(heat: Heat) -> Iterator[Violation]:
    """Yield the violation of heat beyond what was checked."""
    if why := why_too_hot(heat):
        parts = (1 - heat.film_factor) / (1 - LEAST_FILM), heat.change / MOST_CHANGE
        yield Violation(
            assumption=Assumption.CHECKED_HEAT,
            what="ratio of the effect of heat to the largest effect for which the model was checked",
            value=max(parts),
            limit=1.0,
            unit="",
            consequence=why,
            recommendation="set numerics.heat = 'off' to see f without heat",
        )


def share_given_off(results: Sequence[DeterministicResult]) -> float:
    """Return the share of the lubricant that comes out of touching cells, mean over the strips."""
    return mean(result.share_given_off for result in results)


def error_by_gap(given_off: float, *, rubbing: float, boundary: float, f: float) -> float:
    """Return the relative error of f, at 95 %, by the assumed gap between touching cells, from which the share
    ``given_off`` of the lubricant comes.

    That share of the load of the film may be on asperities, or more of theirs on the film: it changes f by no more than
    what this load rubs on either. ``rubbing``: part of the load on asperities; ``boundary``: their part of ``f``. Half
    of the gap changed f by less in 32 of 33 contacts, by half as much in the median (docs/deterministic.md).
    """
    if given_off == 0 or f == 0:
        return 0.0
    on_asperities = abs(boundary) * (1 - rubbing) / rubbing if rubbing > 0 else 0.0
    return given_off * max(on_asperities, abs(f - boundary)) / abs(f)


def error_by_gap_of(results: Sequence[DeterministicResult]) -> float:
    """Return `error_by_gap` of the means over the strips."""
    return error_by_gap(
        share_given_off(results),
        rubbing=mean(result.split.rubbing / result.load for result in results),
        boundary=mean(result.boundary / result.load for result in results),
        f=mean(result.coefficient for result in results),
    )
