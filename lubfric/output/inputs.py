"""The inputs of a scene as text, and what follows from them: for ``lubfric info`` and for the report."""

from collections.abc import Iterator

from ..film import hertz
from ..oil import estimate_in_words
from ..quantities import KEYS, worded_value
from ..scene import (
    BOUNDARY_FILM,
    BOUNDARY_FILM_KEY,
    BOUNDARY_FRICTION_KEY,
    FRICTION_OVER,
    HISTORIES,
    Scene,
    sampled_times,
    source_of,
    typical,
)
from ..time import first_largest, scene_at
from ..units import range_in_words, worded

# Keys that mean nothing where a history of this name is given.
REPLACED = {"motion.slide_roll_ratio": "sliding"}

# Key of the limiting stress at ambient pressure: without a limiting_stress_coefficient it is not used.
LIMIT_OFFSET = "lubricant.limiting_stress_offset"

# Key of the autocorrelation at the correlation length of a generated map: a measured one has none.
DECAY_LEVEL = "decay_level"

# What follows the value of an input that the scene does not give, and that is known to a range only.
BY_DEFAULT = ", range half to twice, the default of lubfric"

INPUT_SECTIONS = ("bodies", "lubricant", "motion", "surface", "counterface", "contact", "transient", "numerics")


def inputs(scene: Scene, section: str) -> Iterator[tuple[str, str, str, str]]:
    """Yield (what it is, the value with its unit, the key, and its range, its table, or the range of typical values) of
    every input in a section of the scene."""
    for key, quantity in KEYS.items():
        value = getattr(getattr(scene, section, None), key.removeprefix(f"{section}."), None)
        if key == BOUNDARY_FILM_KEY and value is None and section == "bodies":
            yield quantity.label, worded_value(key, BOUNDARY_FILM), key, BY_DEFAULT
            continue
        if not key.startswith(f"{section}.") or value is None or value == ():
            continue
        alike = {word: ends for word, (middle, *ends) in typical(key).items() if middle == value}
        lowest, highest = next(iter(alike.values()), (0.0, 0.0))
        ends = range_in_words(lowest, highest, quantity.unit)
        note = (
            f", taken as exact; the name {' or '.join(map(repr, alike))} gives the typical range, {ends}"
            if alike
            else ""
        )
        if key == LIMIT_OFFSET and scene.lubricant.limit is None:
            continue
        if key == f"{section}.{DECAY_LEVEL}" and getattr(scene, section).file is not None:
            continue
        if key in REPLACED and getattr(scene.transient, REPLACED[key], None) is not None:
            continue
        text = worded_value(key, value)
        changing = [name for name, of in HISTORIES.items() if of == key and getattr(scene.transient, name, None)]
        if changing:
            note = f" over the run: transient.{changing[0]}"
            text = over_the_run(scene, changing[0], value, quantity.unit)
        for name, low, high in scene.ranges:
            if name == key:
                words = [word for word, usual in alike.items() if usual == [low, high]]
                note = f", range {range_in_words(low, high, quantity.unit)}"
                note += f", typical of {' or '.join(words)} ({source_of(key, words[0])})" if words else ""
        table = scene.bodies.boundary_friction_table
        if table is not None and key == BOUNDARY_FRICTION_KEY:
            unit = FRICTION_OVER[table.over]
            points = (f"{value:.4g} at {worded(place, unit)}" for place, value in zip(table.at, table.values))
            note = f", by a table over {table.over}: {', '.join(points)}"
        yield quantity.label, text, key, note


def over_the_run(scene: Scene, name: str, constant: float, unit: str) -> str:
    """Return the range of what a run in time changes under ``name`` as text, in the SI ``unit``: "300 to 700 N"; the
    ``constant`` where nothing changes it."""
    history = getattr(scene.transient, name, None)
    if scene.transient is None or history is None:
        return worded(constant, unit)
    low, high = history.range(scene.transient.duration)
    return range_in_words(low, high, unit)


def input_rows(scene: Scene, section: str) -> list[str]:
    """Return the `inputs` of a section of ``scene``, one line each."""
    return [f"{label}: {text}  ({key}){note}" for label, text, key, note in inputs(scene, section)]


def _bodies(scene: Scene) -> list[str]:
    """Return what follows from the bodies and the load, one line each."""
    b = scene.bodies
    if scene.transient is None:
        peak = hertz.line_peak_pressure(b.load / b.width, b.radius, b.e_prime)
        rows = [
            f"Hertz: half-width {worded(b.half_width, 'm')}, mean pressure {worded(b.mean_hertz_pressure, 'Pa')}, "
            f"peak {worded(peak, 'Pa')}; load per length {worded(b.load / b.width, 'N/m')}"
        ]
    else:
        low, high, time = _cycle_peak_pressure(scene)
        widths = [scene_at(scene, each).bodies.half_width for each in sampled_times(scene)]
        rows = [
            f"Hertz: peak pressure {_pressures_in_words(scene, low, high, time)}; half-width "
            f"{range_in_words(min(widths), max(widths), 'm')}; area A of the volume balance: the Hertz strip "
            "of the moment"
        ]
    if b.hardness is None:
        rows.append("asperity contacts: elastic (no bodies.hardness)")
    return rows


def _pressures_in_words(scene: Scene, low: float, high: float, time: float) -> str:
    """Return the smallest and the largest peak pressure [Pa] of a run, the latter at a ``time`` [s], as text."""
    if worded(low, "Pa") == worded(high, "Pa"):
        return f"{worded(high, 'Pa')} at all times"
    assert scene.transient is not None
    moment = scene.transient.moment_in_words(time)
    return f"{range_in_words(low, high, 'Pa')} over the run, largest at t = {moment}"


def _cycle_peak_pressure(scene: Scene) -> tuple[float, float, float]:
    """Return the smallest and the largest peak Hertz pressure [Pa] of a run in time, and the time [s] of the latter."""
    times = sampled_times(scene)
    bodies = [scene_at(scene, time, side).bodies for time in times for side in ("before", "at")]
    peaks = [hertz.line_peak_pressure(b.load / b.width, b.radius, b.e_prime) for b in bodies]
    largest = max(peaks)
    return min(peaks), largest, times[first_largest(peaks) // 2]


def _lubricant(scene: Scene) -> list[str]:
    """Return what follows from the oil, and the laws that hold for it, one line each."""
    oil = scene.lubricant
    rows = []
    if oil.oil is not None and oil.temperature is not None:
        rows += estimate_in_words(oil.oil, oil.temperature).split("; ")
    rows.append(f"viscosity over pressure: {oil.viscosity_law}; density over pressure: {oil.density_law}")
    if oil.is_limited_by_boundary_friction:
        rows.append("shear: Newtonian up to f_b p, as stated")
    elif oil.has_unlimited_stress:
        law = "Newtonian" if not oil.shear_laws else f"by the law of lubricant.{oil.shear_laws[0].key}"
        rows.append(
            f"shear: {law}, at any stress (no lubricant.eyring_stress, no lubricant.limiting_stress_coefficient)"
        )
    known = oil.heats and oil.temperature_coefficient is not None
    heat = "isothermal, because the temperature coefficient of the viscosity is not given"
    if known:
        heat = "included in film and inlet where it changes f by more than its share of the tolerance"
        heat = "isothermal (numerics.heat = 'off')" if scene.numerics.heat == "off" else heat
    return [*rows, f"heat: {heat}"]


def _motion(scene: Scene) -> list[str]:
    u = scene.motion.entrainment_speed
    ratio = scene.motion.slide_roll_ratio
    u1 = u * (1 - ratio / 2)
    u2 = u * (1 + ratio / 2)
    sliding = f"sliding speed {abs(u2 - u1):.4g} m/s" if ratio else "pure rolling: f is that of rolling alone"
    surfaces = f"surface speeds {u1:.4g} and {u2:.4g} m/s, {sliding}"
    return [] if scene.transient is not None else [surfaces]


FACTS = {"bodies": _bodies, "lubricant": _lubricant, "motion": _motion}  # what follows from the inputs of a section
