"""Checks of a scene and its map before anything is solved: half-space, small slopes, enough asperities."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...film import ShearForce, hertz
from ...oil import carried_stress, shear_stress
from ...quantities import counted
from ...samples import (
    Sample,
    is_measured,
    length_of_rough_contact,
    measured_strips,
    requests_patch,
    rough_bodies,
    way_to_longer_line,
    way_to_longer_patch,
)
from ...scene import Bodies, Scene, has_moving_roughness, longest_contact, unusual_values
from ...surface import Surface, advised_form, correlation_length, rms_slope
from ...units import worded
from .checks import (
    ON_ENDS,
    REFUSED_SHARE,
    peak_hertz_pressure,
    violations_by_motion,
    violations_by_pressure,
    violations_by_shear,
)
from .statistics import LEAST_BLOCK_LENGTH, LEAST_BLOCKS, LEAST_FREEDOM, PLACE_BLOCK, TIME_BLOCK
from .violation import Assumption, Violation
from .wording import percent

# Nodes across the Hertz strip of the estimate of the shear: their sum is off by 6e-5 with an Eyring stress. A choice: a
# larger value takes longer.
STRIP_NODES = 201

# Half-width of the Hertz strip over R from which a parabola for the circle is off: by b²/(4 R²) = 0.25 % of the height.
# A choice: a smaller value warns of more contacts.
WIDE_STRIP = 0.1

# Half-width of the Hertz strip over R above which the half-space model is meaningless. Not measured: a convention.
WIDEST_STRIP = 0.5

# Rms slope from which slopes are not small: the contact is solved for infinitesimal ones, which errs by the square, 25
# %. A choice: a smaller value warns of more surfaces.
STEEP = 0.5

# Rms slope of no real surface: heights or spacing are in a wrong unit. Not measured: a convention.
REFUSED_SLOPE = 1.5

# Cells in a correlation length below which a map is noise: independent cells have 0.63. A choice, a little above.
NOISE = 0.8
FILTERED = "check the order of its lines, or give surface.s_filter"

# Correlation lengths that a generated patch should be wide. Not measured: a convention.
LEAST_PATCH_LENGTHS = 10

# Correlation lengths that the windows of a measured map should be wide: the fewest from which the error by the sample
# is known (statistics.py).
LEAST_LENGTHS_FOR_INTERVAL = LEAST_BLOCKS * LEAST_BLOCK_LENGTH

# Parameters of a straight line over the load of blocks, at least: those that friction follows without a control
# (`lubfric.models.deterministic`). By definition.
FEWEST_PARAMETERS = 2

# Share [%] of Sq² that a form explains from which the map shows the form and not the roughness: its Sq is then twice
# that of the roughness. A convention.
MOST_OF_FORM = 75.0

# Deviation of the Sq of strips from that of their map, at most, that is no violation whatever the sample explains. A
# convention.
LEAST_STRIP_DEVIATION = 0.05

# Peak Hertz pressure [Pa] that hard steel does not carry elastically: static ratings of bearings allow 4.0 to 4.6 GPa
# (ISO 76).
YIELDED = 4.5e9


# Length of a map over that of its patch up to which nothing was cut. A convention, for rounding.
UNCUT_LENGTH = 1 + 1e-9


def why_sample_too_short(scene: Scene, lengths: float, sample: Sample) -> str:
    """Return that so few correlation ``lengths`` of the ``sample`` that is solved give no interval, and what to
    change."""
    return (
        f"sampling not known: {lengths:.3g} correlation lengths of the solved surface along y are too few for an "
        f"interval; {_ways_to_interval(scene, sample)}"
    )


def why_map_too_small(tolerance: float, times: float) -> str:
    """Return that the map is too small for the sampling ``tolerance``, which needs so many ``times`` its area."""
    return (
        f"the map is too small for the requested {percent(tolerance)}, which needs about {float(f'{times:.2g}'):g} "
        "times its area"
    )


def why_too_few_blocks(
    scene: Scene,
    sample: Sample,
    *,
    blocks: tuple[int, int],
    needed: int,
    size: tuple[float, float],
    size_of_block: tuple[float, float],
) -> str:
    """Return that the ``sample`` that moves through the contact has so few ``blocks``, along the motion and along y,
    fewer than the ``needed`` ones, that it gives no interval, and what to change.

    ``size``: of the surface that passes, in half-widths of the Hertz strip and in correlation lengths along y;
    ``size_of_block``: the least one of a block.
    """
    (along, across) = blocks
    return (
        "sampling not known: the surface that passes the contact has "
        f"{counted(along * across, 'nearly independent blocks')} ({along} along the motion x {across} along y), and an "
        f"interval needs {needed}; it is {size[0]:.3g} half-widths of the Hertz strip long "
        f"({worded(scene.bodies.half_width, 'm')} at this load; a block needs {size_of_block[0]:g}) and {size[1]:.3g} "
        f"correlation lengths wide along y (a block needs {size_of_block[1]:g}); {_ways_to_interval(scene, sample)}, "
        "or a map that is longer along the motion"
    )


def expected_without_interval(scene: Scene, sample: Sample, *, includes_motion: bool) -> Iterator[Violation]:
    """Yield the violation by a ``sample`` all of which is too short for a sampling error of f where asperities touch;
    ``includes_motion``: whether the model judges it by blocks of time and place where its roughness moves."""
    if not sample.is_resolved or sample.sq == 0:
        return
    lengths = sample.available_strips * sample.strip_length / sample.correlation_lengths[1]
    needed = float(LEAST_LENGTHS_FOR_INTERVAL)
    advice = _ways_to_interval(scene, sample)
    if includes_motion and has_moving_roughness(scene):
        along = max(int(sample.stated_map().size[0] / (TIME_BLOCK * scene.bodies.half_width)), 1)
        needed = PLACE_BLOCK * math.ceil((LEAST_FREEDOM + FEWEST_PARAMETERS) / along)
        advice = f"{advice}, or a map that is longer along the motion"
    if lengths < needed:
        yield Violation(
            assumption=Assumption.LONG_SAMPLE,
            what="length of the sample along the line over the correlation length of the map",
            value=lengths,
            limit=needed,
            unit="",
            consequence="f will have no 95 % interval where asperities touch: its sampling error will not be known",
            recommendation=advice,
        )


def _ways_to_interval(scene: Scene, sample: Sample) -> str:
    """Return what gives an interval to a ``sample`` that is too short for one, as text.

    To omit an extension is advised only where the map, without it, has more windows and does not cut the contact off;
    to omit ``numerics.sampling`` only where strips give one.
    """
    keys = ["numerics.sampling"] if requests_patch(scene) and _strips_give_interval(scene, sample) else []
    extended = [f"{name}.extension" for rough, name in rough_bodies(scene) if rough.extension != "none"]
    if extended and _is_long_enough(scene, sample) and sample.strips_without_extension(scene) > sample.available_strips:
        keys += extended
    omit = f"omit {' and '.join(keys)}, or " if keys else ""
    longer = way_to_longer_line(scene, sample.whole_map)
    return f"{omit}give {longer}"


def _strips_give_interval(scene: Scene, sample: Sample) -> bool:
    """Return whether strips of the surface, in place of one patch, are long enough for an interval: generated ones
    always, and windows of a measured map where the patch alone has enough of them."""
    if not is_measured(scene):
        return True
    with_strips = scene.with_(**{name: {"extension": "none"} for _, name in rough_bodies(scene)})
    try:
        strips = measured_strips(with_strips, sample.whole_map)
    except InputError:  # of too few rows for windows
        return False
    needed = LEAST_LENGTHS_FOR_INTERVAL * strips.correlation_lengths[1]
    return strips.available_strips * strips.strip_length >= needed


def _is_long_enough(scene: Scene, sample: Sample) -> bool:
    """Return whether the map of ``sample``, before it is continued, is longer than the rough contact."""
    surface = sample.maps_before_extension[0]
    return surface.size[0] >= length_of_rough_contact(scene, sample.whole_map.sq)


def beforehand(scene: Scene, sample: Sample, surface: Surface) -> tuple[Violation, ...]:
    """Return the violations for values far from the usual, for the bodies, for the map, and for the ``surface`` that
    the ``sample`` states."""
    cells = [_cells_of_length(surface, axis) for axis in (0, 1)]
    lengths = math.nan if math.isnan(cells[1]) else surface.size[1] / sample.correlation_lengths[1]
    of_map = violations_by_map(rms_slope(surface)[2], lengths, cells, _longer_map(scene, sample))
    of_ends = _violations_by_short_patch(scene, surface, sample.whole_map) if sample.is_resolved else ()
    return (*violations_by_unusual_inputs(scene), *violations_by_bodies(scene.bodies), *of_map, *of_ends)


def _longer_map(scene: Scene, sample: Sample) -> str:
    """Return which longer map the windows of a measured map need; "" for any other sample."""
    return way_to_longer_line(scene, sample.whole_map) if is_measured(scene) else ""


def _violations_by_short_patch(scene: Scene, surface: Surface, whole: Surface) -> Iterator[Violation]:
    """Yield the violations by a patch ``surface`` of the ``whole`` map whose ends may cut the contact off."""
    needed = length_of_rough_contact(scene, surface.sq)
    length = surface.size[0]
    may_be_cut = not surface.periodic_axes[0] or _runs_on_patch(scene)
    if surface.sq == 0 or not may_be_cut or length >= needed:
        return
    refuses = (
        f"the load-sharing model refuses a result with more than {100 * ON_ENDS:g} % of the contact load on the edge "
        "columns"
    )
    others = (
        "the quick and the deterministic model continue the patch by its mirror image, and by default one of them "
        "then gives the answer"
    )
    longest = ""
    time = longest_contact(scene, surface.sq).time
    if scene.transient is not None:
        others = "the deterministic model continues the patch in time"
        longest = "" if time is None else f" at t = {worded(time, 's')}"
    cut = ""
    if is_measured(scene) and scene.contact.shape is None and whole.size[0] > length * UNCUT_LENGTH:
        cut = (
            f"the map, {worded(whole.size[0], 'm')} long, is cut to a whole number of the longer cells of this "
            "contact; "
        )
    yield Violation(
        assumption=Assumption.LONG_PATCH,
        what="length of the patch along the motion",
        value=1e6 * length,
        limit=1e6 * needed,
        unit="µm",
        consequence=f"{cut}the contact of the rough surfaces is longer than the patch{longest}, which may cut off its "
        f"ends; {refuses}; {others}",
        recommendation=f"give {way_to_longer_patch(scene, surface)}",
    )


def _runs_on_patch(scene: Scene) -> bool:
    """Return whether ``scene`` is a run in time whose model solves its patch as it is, without continuing it."""
    return scene.transient is not None and scene.numerics.model != "deterministic"


def violations_by_form(scene: Scene, maps: Sequence[Surface], *, has_given_map: bool) -> Iterator[Violation]:
    """Yield the violations by a form that is left in the ``maps``, of each rough body or of all: measured ones, or
    those that were given to `lubfric.prepare`."""
    sections = ("surface", "counterface")
    for section, rough, surface in zip(sections, (scene.surface, scene.counterface), maps):
        file = None if has_given_map or rough is None else rough.file
        if not (has_given_map or file) or surface.sq == 0:
            continue
        left = surface.left_by()
        form = advised_form(surface.left_by(includes_outliers=False))
        source = surface.source
        if rough is not None and file is not None:
            source = Path(file).name
            form = "quadratic" if form == rough.form == "cylinder" else form  # it is curved along the other axis too
        share = 100 * (1 - (left[form] / left[""]) ** 2)
        if form == "plane" or share <= MOST_OF_FORM:
            continue
        name = f" ({source})" if source else ""
        sq = [f"{1e9 * left[key]:.4g} nm" for key in ("", form)]
        why = (
            f"Sq is {sq[0]} with this form and {sq[1]} without it, so film, contact and f are those of the form, not "
            "of the roughness"
        )
        file_advice = f"give {section}.form = {form!r}"
        yield Violation(
            assumption=Assumption.MAP_WITHOUT_FORM,
            what=f"share of the form {form!r} in Sq² of [{section}]{name}",
            value=share,
            limit=MOST_OF_FORM,
            unit="%",
            consequence=why,
            recommendation=f"remove the form from the map: level({form!r})" if has_given_map else file_advice,
        )


def violations_by_strips(deviation: float, explained: float) -> Iterator[Violation]:
    """Yield the violations by strips whose Sq is, relative, ``deviation`` above that of their map, of which a sample of
    their size may differ by the ``explained`` part."""
    if abs(deviation) > max(explained, LEAST_STRIP_DEVIATION):
        yield Violation(
            assumption=Assumption.STRIPS_LIKE_MAP,
            what="difference of Sq between the strips that are solved first and the map",
            value=100 * abs(deviation),
            limit=100 * max(explained, LEAST_STRIP_DEVIATION),
            unit="%",
            consequence=f"the solved strips are {'rougher' if deviation > 0 else 'smoother'} than the map by more than "
            "their size explains: the map has a form, or its roughness differs from place to place",
            recommendation="remove the form (key form), or crop the map to the part that is in contact",
        )


def stated_sq(scene: Scene) -> float | None:
    """Return the Sq [m] of all roughness of ``scene``, if it states that of each body."""
    parts = [rough.sq for rough in (scene.surface, scene.counterface) if rough is not None]
    return None if None in parts else math.hypot(*(part for part in parts if part is not None))


def is_of_map_alone(violation: Violation) -> bool:
    """Return whether a violation is one of `violations_by_form` or `violations_by_strips`, which depend on the map
    alone."""
    return violation.assumption in (Assumption.MAP_WITHOUT_FORM, Assumption.STRIPS_LIKE_MAP)


def violations_by_unusual_inputs(scene: Scene) -> tuple[Violation, ...]:
    """Return the violations for values far from the usual."""
    return tuple(
        Violation(
            assumption=Assumption.USUAL_VALUES,
            what=value.key,
            value=value.value,
            limit=value.limit,
            unit=value.unit,
            consequence=value.question or "the value is unusual",
            recommendation=value.advice,
            severe=value.is_refused,
        )
        for value in unusual_values(scene)
    )


def _cells_of_length(surface: Surface, axis: int) -> float:
    """Return the correlation length of the map along ``axis`` over its cells; NaN if it has no such length: a lay along
    that axis, a flat map, or one of a few cells."""
    if surface.shape[axis] < 8 or surface.sq == 0:
        return math.nan
    try:
        return correlation_length(surface, axis) / surface.spacing[axis]
    except InputError:
        return math.nan


def violations_by_bodies(bodies: Bodies) -> Iterator[Violation]:
    """Yield the violations by a load beyond the half-space and the elasticity of the Hertz contact."""
    wide = bodies.half_width / bodies.radius
    if wide > WIDE_STRIP:
        recommendation = "check bodies.load, e_prime and radius; reduce the load, or choose a stiffer body"
        why = "the half-space model needs a contact that is narrow compared with the body"
        what = "contact half-width over radius"
        yield Violation(
            assumption=Assumption.HALF_SPACE,
            what=what,
            value=wide,
            limit=WIDEST_STRIP if wide > WIDEST_STRIP else WIDE_STRIP,
            unit="",
            consequence=why,
            recommendation=recommendation,
            severe=wide > WIDEST_STRIP,
        )
    if bodies.width < 2 * bodies.half_width:
        why = "the contact is wider than it is long, so it is no line contact"
        what = "line length over contact width"
        yield Violation(
            assumption=Assumption.LINE_CONTACT,
            what=what,
            value=bodies.width / (2 * bodies.half_width),
            limit=1.0,
            unit="",
            consequence=why,
            recommendation="check bodies.width, radius and load",
        )
    peak = hertz.line_peak_pressure(bodies.load / bodies.width, bodies.radius, bodies.e_prime)
    if bodies.hardness is None and peak > YIELDED:
        why = "hard steel yields at this pressure, but the bodies are modelled as elastic"
        what = "peak Hertz pressure"
        yield Violation(
            assumption=Assumption.ELASTIC_BODIES,
            what=what,
            value=peak / 1e9,
            limit=YIELDED / 1e9,
            unit="GPa",
            consequence=why,
            recommendation="check bodies.load; give bodies.hardness",
        )


def violations_by_map(
    slope: float, lengths: float, cells: Iterable[float] = (), longer: str = ""
) -> Iterator[Violation]:
    """Yield the violations by the map. ``slope``: its rms slope [-]; ``lengths``: its width over its correlation length
    across the motion; ``cells``: in its correlation length along x and y. NaN: not known. ``longer``: which longer map
    a measured one is to be replaced by, as text; "": the map is not measured."""
    if slope > STEEP:
        recommendation = "check the units of heights and spacing; filter the map at the scale that matters"
        why = "the half-space assumes small slopes; contact area and pressures are wrong"
        what = "rms slope of the map"
        yield Violation(
            assumption=Assumption.SMALL_SLOPES,
            what=what,
            value=slope,
            limit=REFUSED_SLOPE if slope > REFUSED_SLOPE else STEEP,
            unit="",
            consequence=why,
            recommendation=recommendation,
            severe=slope > REFUSED_SLOPE,
        )
    least = LEAST_LENGTHS_FOR_INTERVAL if longer else LEAST_PATCH_LENGTHS
    if lengths < least:
        why = (
            "the sample has few asperities: another patch of the same surface would give another f, and f may have "
            "no 95 % interval"
        )
        yield Violation(
            assumption=Assumption.LONG_SAMPLE,
            what="length of the sample along the line over the correlation length of the map",
            value=lengths,
            limit=least,
            unit="",
            consequence=why,
            recommendation=f"give {longer or 'a larger contact.shape or map'}",
        )
    for axis, count in zip("xy", cells):
        if count < NOISE:
            what = f"cells in a correlation length along {axis}"
            recommendation = f"give a map with a shorter step along {axis}, {FILTERED}"
            yield Violation(
                assumption=Assumption.CORRELATED_HEIGHTS,
                what=what,
                value=count,
                limit=NOISE,
                unit="",
                consequence="neighbouring heights are uncorrelated, as in noise, so the contact has no meaning",
                recommendation=recommendation,
                severe=True,
            )


# Film over Sq from which it carries the whole load. Not measured: a convention; it decides what is said before a solve.
SEPARATING = 3.0

# What is added where the film may carry a part of the load alone.
IF_ALL = (
    "this estimate is for a film that carries the total load; where asperities carry a part of it, the share is "
    f"smaller, and the result is refused only if the share is above {REFUSED_SHARE:g}"
)

# Limits that will be exceeded, each with the speed [m/s] at which it is; None: at all speeds.
ExpectedViolations = tuple[tuple[float | None, Violation], ...]


def expected_on_hertz(scene: Scene) -> ExpectedViolations:
    """Return the limits of the oil that the peak Hertz pressure exceeds at all speeds, none of them severe."""
    return tuple(
        (None, replace(violation, severe=False))
        for violation in violations_by_pressure(scene, peak_hertz_pressure(scene))
    )


def expected_in_film(scene: Scene, speeds: list[float]) -> ExpectedViolations:
    """Return the limits that the film expected under the total load exceeds at ``speeds`` [m/s]."""
    expected: list[tuple[float | None, Violation]] = []
    for speed in speeds:
        if speed != 0:
            film = scene.line_contact(speed).expected_film
            expected += [(speed, violation) for violation in violations_by_motion(scene, speed, film)]
            by_film = _expected_violations_by_film(scene, speed, film)
            expected += [(speed, violation) for violation in by_film]
    return tuple(expected)


def _expected_violations_by_film(scene: Scene, speed: float, thickness: float) -> list[Violation]:
    """Return the violations by a film of even ``thickness`` [m] under the Hertz pressure, which carries the whole load.

    None by its shear is severe unless the film is certain to do so: asperities that carry a part of the load leave it
    less friction.
    """
    bodies = scene.bodies
    lubricant = scene.lubricant
    w = scene.bodies.load / scene.bodies.width
    x = np.linspace(-1, 1, STRIP_NODES) * bodies.half_width
    pressure = np.asarray(hertz.line_pressure(x, w, bodies.radius, bodies.e_prime))
    with np.errstate(over="ignore"):
        sliding = abs(scene.motion.slide_roll_ratio * speed)
        stress = np.minimum(shear_stress(lubricant, pressure, sliding / thickness), 1e30)
    above = np.maximum(stress - carried_stress(pressure), 0.0)
    force, excess = (float(bodies.width * np.trapezoid(tau, x)) for tau in (stress, above))
    shear = ShearForce(
        couette=force, rolling=0.0, excess=excess, stress_ratio=float(np.max(stress / carried_stress(pressure)))
    )
    total = max(force, bodies.boundary_friction_coefficient * bodies.load)
    by_shear = violations_by_shear(scene, shear, bodies.load, total)
    if not _separates(scene, thickness):
        by_shear = (
            replace(
                violation,
                severe=False,
                assumption=Assumption.STRESS_OF_OILS_UNDER_TOTAL_LOAD,
                limit=scene.numerics.tolerance,
                consequence=f"{violation.consequence}; {IF_ALL}",
            )
            if violation.severe
            else violation
            for violation in by_shear
        )
    return [*violations_by_pressure(scene, peak_hertz_pressure(scene)), *by_shear]


def _separates(scene: Scene, thickness: float) -> bool:
    """Return whether a film of ``thickness`` [m] is certain to carry the whole load: the roughness is known, and
    lower."""
    sq = stated_sq(scene)
    return sq is not None and thickness > SEPARATING * sq
