"""The inputs of a scene that a publication states beside its methods."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from ..film import line_peak_pressure
from ..oil import Lubricant, Oil
from ..quantities import COLUMNS, KEYS, worded_value
from ..samples import rough_bodies
from ..scene import BOUNDARY_FILM, HISTORIES, Roughness, Scene, materials_of
from ..surface import Surface
from ..units import worded

# Methods by which a pressure-viscosity coefficient is estimated (`lubfric.oil.Oil.pressure_viscosity_coefficient`).
ESTIMATED_BY = ("gold", "so-klaus")

# Key of the pressure-viscosity coefficient.
ALPHA_KEY = "lubricant.pressure_viscosity_coefficient"


# What the asperities of a `lubfric.scene.ContactDomain.model` are; of the half-space they are the cells of the map.
ASPERITIES_TO_QUOTE = {
    "summits": ("independent asperities, one at each summit of the map, with the radius of its mean curvature there",),
    "patches": (
        "independent asperities, one at each patch of the map above the separation, with the radius of its area",
    ),
}


def inputs_to_quote(
    scene: Scene,
    maps: Sequence[Surface] = (),
    *,
    has_given_map: bool = False,
    has_sampling_error: bool = True,
    takes_boundary_film: bool = True,
) -> tuple[str, ...]:
    """Return the roughness, the load, the lubricant, the boundary friction and the sliding of ``scene``, each with its
    unit and its range as text, as far as it has them; what changes in time as its range over the run. ``maps``: of its
    rough bodies, before they are extended (`lubfric.samples.Sample.maps_before_extension`); ``has_given_map``: whether
    maps were given in place of those of the scene; ``has_sampling_error``: whether that of f is known at some point;
    ``takes_boundary_film``: as of the model (`lubfric.models.Model`)."""
    texts = [*roughness_to_quote(scene, maps, has_given_map=has_given_map)]
    if scene.numerics.sampling == "patch":
        texts.append("one patch of the surface in place of strips")
        texts += [] if has_sampling_error else ["sampling error of f not known"]
    lubricated = lubricated_contact_to_quote(scene, takes_boundary_film=takes_boundary_film)
    return (*texts, *dry_contact_to_quote(scene), *lubricated)


def dry_contact_to_quote(scene: Scene) -> Iterator[str]:
    """Yield the load, the radius, the modulus and the hardness of ``scene``, as `inputs_to_quote`."""
    bodies = scene.bodies
    histories = scene.transient
    yield _in_time(scene, "load", "load", bodies.load)
    yield f"length of the line contact {worded(bodies.width, 'm')}"
    yield _in_time(scene, "radius", "reduced radius", bodies.radius)
    if histories is None or (histories.load is None and histories.radius is None):
        peak = line_peak_pressure(bodies.load / bodies.width, bodies.radius, bodies.e_prime)
        yield f"peak Hertz pressure {worded(peak, 'Pa')}"
    if materials := materials_of(bodies):
        yield "material of the bodies " + " and ".join(dict.fromkeys(materials))
    yield f"reduced modulus E' {worded(bodies.e_prime, 'Pa')}, where 2/E' = (1 - ν1²)/E1 + (1 - ν2²)/E2"
    if bodies.hardness is None:
        yield "elastic asperities, without a plastic limit"
    else:
        yield f"plastic limit of the contact pressure {worded(bodies.hardness, 'Pa')}{_range(scene, 'bodies.hardness')}"
    yield from ASPERITIES_TO_QUOTE.get(scene.contact.model, ())


def lubricated_contact_to_quote(scene: Scene, *, takes_boundary_film: bool = True) -> Iterator[str]:
    """Yield the lubricant, the boundary friction and the sliding of ``scene``, as `inputs_to_quote`."""
    bodies = scene.bodies
    histories = scene.transient
    yield from _lubricant(scene)
    yield (
        f"boundary friction coefficient {worded(bodies.boundary_friction_coefficient, '-')}"
        f"{_range(scene, 'bodies.boundary_friction_coefficient')}"
    )
    if bodies.boundary_film is None and takes_boundary_film:
        yield f"boundary film {worded(BOUNDARY_FILM, 'm')} (the default of lubfric)"
    elif bodies.boundary_film is not None:
        film = f"boundary film {worded(bodies.boundary_film, 'm')}{_range(scene, 'bodies.boundary_film')}"
        yield film if takes_boundary_film else f"{film}, which limits the interval of f alone"
    if histories is not None:
        turns = (
            ""
            if histories.rotational_speed is None
            else f" at {60 * histories.rotational_speed:.4g} revolutions per minute"
        )
        yield f"run in time over {worded(histories.duration, 's')}{turns}"
        yield _in_time(scene, "speed", "entrainment speed", scene.motion.entrainment_speed)
    if histories is not None and histories.sliding is not None:
        yield _in_time(scene, "sliding", "sliding speed", 0.0)
    else:
        yield (
            f"slide-roll ratio {worded(scene.motion.slide_roll_ratio, '-')}{_range(scene, 'motion.slide_roll_ratio')}"
        )


def span_to_quote(name: str, values: Sequence[float], unit: str) -> str:
    """Return the range of ``values`` in the SI ``unit`` as text after their ``name``: "entrainment speeds 0.1 to 3
    m/s"."""
    low = min(values)
    high = max(values)
    if low == high:
        return f"{name} {worded(low, unit)}"
    return f"{name} {worded((low, high), unit).replace(' and ', ' to ')}"


def varied_to_quote(key: str, values: Sequence[object]) -> str:
    """Return the range of what a study varies under a ``key`` as text; its ``values`` where they are no numbers."""
    quantity = KEYS.get(key) or COLUMNS.get(key)
    name = key if quantity is None else quantity.label
    numbers = [value for value in values if isinstance(value, (int, float)) and not isinstance(value, bool)]
    if len(numbers) < len(values) or not numbers:
        return f"{name} {', '.join(map(str, values))}"
    if key == "lubricant.temperature":
        return f"{name} {worded_value(key, min(numbers))} to {worded_value(key, max(numbers))}"
    return span_to_quote(name, numbers, "-" if quantity is None else quantity.unit)


def _in_time(scene: Scene, history: str, name: str, constant: float) -> str:
    """Return what a ``history`` of the scene changes, after its ``name``, as its range over the run; the ``constant``
    where it changes nothing."""
    key = HISTORIES[history]
    unit = KEYS[key].unit if key in KEYS else "m/s"
    changing = getattr(scene.transient, history, None)
    if scene.transient is None or changing is None:
        return f"{name} {worded(constant, unit)}{_range(scene, key)}"
    return span_to_quote(name, changing.range(scene.transient.duration), unit)


def _range(scene: Scene, key: str) -> str:
    """Return the range to which the value of a ``key`` is known, as text behind it; "" where it is exact."""
    for name, low, high in scene.ranges:
        if name == key:
            return f" (range {worded((low, high), KEYS[key].unit).replace(' and ', ' to ')})"
    return ""


def roughness_to_quote(scene: Scene, maps: Sequence[Surface] = (), *, has_given_map: bool = False) -> Iterator[str]:
    """Yield the roughness of ``scene``; arguments as of `inputs_to_quote`."""
    if has_given_map:
        yield "height map given as an array"
        return
    bodies = rough_bodies(scene)
    measured = dict(zip((name for _, name in bodies), maps)) if len(maps) == len(bodies) else {}
    for rough, section in bodies:
        name = "" if section == "surface" else " of the counterface"
        if rough.file is not None:
            yield f"height map{name} {Path(rough.file).name}{_map_in_words(rough, measured.get(section))}"
        if rough.sq is not None:
            nominal = "" if rough.sk is None else "nominal "
            yield f"{nominal}Sq{name} {worded(rough.sq, 'm')}{_range(scene, f'{section}.sq')}"
        if rough.file is None:
            yield from _generated(rough, name)
    if scene.counterface is None:
        yield "smooth counterface"


def _map_in_words(rough: Roughness, surface: Surface | None) -> str:
    """Return how a map was prepared, and if the ``surface`` before its extension is known its size and Sq, as text."""
    facts = []
    if surface is not None:
        (nx, ny) = surface.shape
        (lx, ly) = surface.size
        facts += [f"{nx} x {ny} points, {lx * 1e6:.4g} x {ly * 1e6:.4g} µm", f"Sq {worded(surface.sq, 'm')}"]
    facts.append(f"form removed: {rough.form}")
    if rough.outliers == "mask":
        facts.append("outliers masked")
    if surface is not None and surface.missing_fraction > 0:
        facts.append(f"{100 * surface.missing_fraction:.2g} % of the points unmeasured or masked, and filled")
    if rough.extension == "mirror":
        facts.append("extended by its mirror image")
    return f" ({', '.join(facts)})"


def _generated(rough: Roughness, name: str) -> Iterator[str]:
    """Yield how a map was generated; ``name``: of the body, behind each quantity."""
    if rough.correlation_length is not None:
        length = worded(rough.correlation_length, "m")
        yield f"correlation length{name} {length} ({rough.acf} autocorrelation)"
    yield f"height map{name} generated with the seed {rough.seed}"


def _of_measured_oils(lubricant: Lubricant) -> str:
    """Return that the pressure-viscosity coefficient is estimated, with its range, as text; "" where it is given."""
    if lubricant.oil is None or lubricant.temperature is None:
        return ""
    estimate = lubricant.oil.pressure_viscosity_coefficient(lubricant.temperature)
    if estimate.method not in ESTIMATED_BY:
        return ""
    ends = worded((estimate.low, estimate.high), "1/Pa").replace(" and ", " to ")
    return f" (estimated; the range of measured oils, {ends}, is not in the interval of f)"


def _name(oil: Oil) -> str:
    """Return the grade or the name of ``oil``, or else the viscosities that it is given by, as text."""
    given = oil.given_keys
    if "grade" in given or not {"nu40", "nu100"} <= {*given}:
        return str(given.get("grade", oil.name))
    named = "" if oil.name == Oil.name else f"{oil.name}, "
    return f"{named}{worded(given['nu40'], 'm2/s')} at 40 °C and {worded(given['nu100'], 'm2/s')} at 100 °C"


def _lubricant(scene: Scene) -> Iterator[str]:
    lubricant = scene.lubricant
    oil = lubricant.oil
    if oil is not None:
        yield f"lubricant {_name(oil)} ({oil.base})"
        if "viscosity_table" not in oil.given_keys:  # which may not have 40 and 100 °C
            yield f"viscosity index {oil.index:.4g}"
    if lubricant.temperature is not None:
        yield f"oil temperature {worded_value('lubricant.temperature', lubricant.temperature)}"
    if oil is not None and lubricant.temperature is not None:
        yield f"density {worded(oil.density_at(lubricant.temperature), 'kg/m³')}"
    yield _in_time(scene, "viscosity", "viscosity", lubricant.viscosity)
    if lubricant.viscosity_law != "constant":
        alpha = worded(lubricant.pressure_viscosity_coefficient, "1/Pa")
        yield f"pressure-viscosity coefficient {alpha}{_range(scene, ALPHA_KEY) or _of_measured_oils(lubricant)}"
    if lubricant.inlet_length is not None:
        yield f"lubricant from {worded(lubricant.inlet_length, 'm')} upstream of the middle on"
    if lubricant.inlet_film is not None:
        yield f"film on the surfaces of {worded(lubricant.inlet_film, 'm')} in the inlet"
    if lubricant.eyring_stress is not None:
        yield f"Eyring stress {worded(lubricant.eyring_stress, 'Pa')}{_range(scene, 'lubricant.eyring_stress')}"
    if lubricant.carreau is not None:
        (stress, exponent) = lubricant.carreau
        yield f"critical stress {worded(stress, 'Pa')} and exponent {exponent:.4g} of Carreau's law"
    if lubricant.limit is not None:
        yield (
            f"limiting stress {worded(lubricant.limiting_stress_offset, 'Pa')} + "
            f"{lubricant.limiting_stress_coefficient:.4g} times the pressure"
        )
