"""One problem, complete: `Scene`."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import KW_ONLY, dataclass, field, fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from .._base import Shown, validate
from ..errors import InputError
from ..film import LineContact
from ..oil import Lubricant
from ..quantities import worded_value
from .bodies import BOUNDARY_FILM_KEY, Bodies, ContactDomain, Motion
from .comments import comments_of
from .history import History
from .numerics import Numerics
from .plausible import doubtful_values
from .roughness import LENGTH_KEYS, Roughness
from .sections import ROUGH_SECTIONS, SECTIONS, changed_section, ranges_of
from .short_forms import fields_of, fields_of_key
from .transient import HISTORY_KINDS, Transient

# Keys of [motion] that state the sliding.
SLIDING_KEYS = {"slide_roll_ratio", "slip_percent", "surface_speeds"}
LONGEST_NAME = 500  # characters of the name of a scene; a choice: longer ones fill a title
VALUES_OF_RESOLVED_GAP = (  # key, the values that the deterministic model takes, why no other
    ("contact.geometry", ("cylinder",), ""),
    ("contact.model", ("half-space",), ""),
    ("contact.region", ("hertz",), " (there is no volume balance; means are over the Hertz strip)"),
    ("numerics.film_deflection", ("scaled", "hydrodynamic"), " (no smooth film is deflected)"),
    ("numerics.cavitated_shear", ("none",), ""),
)
# Keys that a scene may leave out, and models then take a value of their own in a range that counts in the interval of f
# (`ModelAnswer.not_given`).
ASSUMED_IN_A_RANGE = (BOUNDARY_FILM_KEY,)
# Pa: least limit at ambient pressure in the deterministic model. Oils have some 1 MPa; with .1, .01 and .001 MPa f of
# the scene "paper" at .03 m/s is .058, .064 and .071, and with 0 the inlet has no viscosity. A choice below what oils
# have.
LEAST_OFFSET = 1e4


@dataclass(frozen=True, repr=False)
class Scene(Shown):
    """The complete description of a contact, for `lubfric.friction` and `lubfric.stribeck`.

    Attributes
    ----------
    bodies, lubricant, motion, contact, numerics : the sections of a scene file (docs/scene.md)
    surface, counterface : the roughness of the two bodies (None: the other body is smooth). The sum of both is in
        contact
    transient : what changes in time, a `lubfric.Transient`, or None
    name : for titles
    ranges : (section.key, lowest, highest) of the values that are known to a range only; f is reported for both ends.
        Those of a correlation length are pairs where it is one
    doubtful : (section.key, value as written) of values outside their usual range, and of a sliding that may have been
        meant as a percentage instead of a ratio, or the reverse. It affects no number
    """

    bodies: Bodies
    lubricant: Lubricant
    motion: Motion
    _: KW_ONLY
    surface: Roughness
    contact: ContactDomain = field(default_factory=ContactDomain)
    numerics: Numerics = field(default_factory=Numerics)
    name: str = "unnamed"
    transient: Transient | None = None
    counterface: Roughness | None = None
    ranges: tuple[tuple[str, Any, Any], ...] = ()
    doubtful: tuple[tuple[str, Any], ...] = field(default=(), compare=False)

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or _has_surrogates(self.name) or len(self.name) > LONGEST_NAME:
            allowed = f"words of up to {LONGEST_NAME} whole characters (no surrogates)"
            raise InputError(f" = {validate.shown(self.name)}", "name", allowed)
        if self.numerics.heat == "on" and not self.lubricant.heats:
            by_numbers = "lubricant.temperature [K] and temperature_coefficient [1/K]"
            ways = f"give an oil (lubricant.grade, nu40, oil) or {by_numbers}, or heat = 'auto'"
            message = " = 'on' needs the temperature coefficient of the viscosity"
            raise InputError(message, "numerics.heat", recommendation=ways)
        sliding = self.motion.slide_roll_ratio * self.motion.entrainment_speed
        friction = self.bodies.boundary_friction(sliding, self.lubricant.temperature)
        if friction != self.bodies.boundary_friction_coefficient:
            object.__setattr__(self, "bodies", replace(self.bodies, boundary_friction_coefficient=friction))
        length = self.lubricant.inlet_length
        half_width = self.bodies.half_width
        if self.transient is not None and self.lubricant.shear_modulus is not None:
            message = f" = {self.lubricant.shear_modulus:g} Pa cannot be combined with [transient]"
            raise InputError(
                message, "lubricant.shear_modulus", recommendation="omit it: runs in time have no elastic shear"
            )
        if self.transient is not None and self.lubricant.inlet_film is not None:
            message = " cannot be combined with lubricant.inlet_film"
            raise InputError(
                message,
                "transient",
                recommendation="omit inlet_film for a flooded inlet, or give lubricant.inlet_length: half the height "
                "of a piston ring, or the length at which full_load_film of the scene without [transient] is the "
                "arriving film",
            )
        if length is not None and length <= half_width:
            message = f" = {length:g} m lies inside the dry contact, where no film begins"
            raise InputError(message, "lubricant.inlet_length", f"more than its half-width {half_width:.4g} m")
        for name, low, high in self.ranges:
            section, _, key = name.partition(".")
            value = value_of(self, name)
            if not _is_within(value, low, high) or low == high:
                message = f" = {validate.shown(value)} in {validate.shown(low)} to {validate.shown(high)}"
                forms = "" if name in LENGTH_KEYS else "[low, high] or "
                allowed = f"{forms}[value, low, high], with the value between both ends"
                raise InputError(message, name, allowed)
            for end in (low, high):
                replace(getattr(self, section), **{key: end})  # refuses an end that is no value of it

    def with_(self, **sections: Any) -> Scene:
        """Return a copy with some fields of its sections replaced: ``scene.with_(bodies={"load": 10.0})``.

        The short forms of scene files may be used as well: ``scene.with_(lubricant={"temperature_celsius": 90})``.
        """
        new: dict[str, Any] = {}
        ranges: dict[str, tuple[Any, Any] | None] = {}
        for section, values in sections.items():
            if section not in self.__dataclass_fields__:
                near = validate.nearest(section, self.__dataclass_fields__)
                (first, _, key) = section.partition(".")
                recommendation = f"; write with_({first}={{{key!r}: {validate.shown(values)}}})" if key else ""
                raise InputError(f"scene has no section {section!r}{near}{recommendation}")
            new[section] = changed_section(section, getattr(self, section), values)
            if section in SECTIONS:
                ranges |= ranges_of(section, values)
        made = replace(self, **new, ranges=())
        made = replace(made, doubtful=self._doubtful_with(sections, made))
        kept = {name: ends for name, *ends in self.ranges if value_of(made, name) == value_of(self, name)}
        return replace(made, ranges=as_ranges(kept | ranges))

    def _doubtful_with(self, sections: dict[str, Any], made: Scene) -> tuple[tuple[str, Any], ...]:
        """Return what is doubtful of the scene ``made`` of this one by ``sections``: what was, where it did not change,
        and what is given. A slide-roll ratio is set by traction curves too, a slip in percent by users alone."""
        changed = {section: dict(values) for section, values in sections.items() if isinstance(values, dict)}
        given = {
            field
            for section, values in changed.items()
            for key in values
            for field in fields_of_key(f"{section}.{key}")
        }
        for key in SLIDING_KEYS - {"slip_percent"}:
            changed.get("motion", {}).pop(key, None)
        kept = [
            (name, written)
            for name, written in self.doubtful
            if given.isdisjoint(fields_of_key(name)) and _stated_by(made, name) == _stated_by(self, name)
        ]
        new = [row for section, values in changed.items() for row in doubtful_values(section, values)]
        return tuple(dict.fromkeys(kept + new))

    def at_ends(self) -> Iterator[tuple[str, Scene, Scene]]:
        """Yield each key that is known to a range only, and the scene at both ends of it."""
        for name, *ends in self.ranges:
            low, high = (replace(self, ranges=()).with_keys({name: end}) for end in ends)
            yield name, low, high

    def at_speed(self, speed: float) -> Scene:
        """Return the scene with the f_b that it has at ``speed`` [m/s]."""
        table = self.bodies.boundary_friction_table
        moves = table is not None and table.over == "sliding_speed"
        return self.with_(motion={"entrainment_speed": speed}) if moves else self

    def with_keys(self, values: dict[str, Any]) -> Scene:
        """Return a copy with the ``values`` by "section.key", or by "section" for a whole one. All keys of a section
        are applied together, in any order: a Hertz pressure refers to the radius given with it."""
        sections = {key: value for key, value in values.items() if "." not in key and not isinstance(value, dict)}
        parts: dict[str, dict[str, Any]] = {}
        for key, value in values.items():
            section, dot, name = key.partition(".")
            if key not in sections:
                parts.setdefault(section, {}).update({name: value} if dot else value)
        return self.with_(**sections).with_(**parts)

    def line_contact(self, speed: float) -> LineContact:
        """Return the smooth line contact of the total load at ``speed`` [m/s], not 0. Shear thins its flow, by the law
        of the lubricant."""
        bodies = self.bodies
        sliding = self.motion.slide_roll_ratio * abs(speed)
        return LineContact(
            load_per_width=bodies.load / bodies.width,
            radius=bodies.radius,
            e_prime=bodies.e_prime,
            entrainment_speed=speed,
            lubricant=self.lubricant,
            sliding=sliding,
        )

    def to_toml(self, folder: str | Path | None = None) -> str:
        """Return the complete scene as the text of a scene file, which `lubfric.load_scene` reads back to the same
        numbers.

        Defaults are written, and what is None is omitted. A ``surface.file`` is written with its complete path, or
        relative to the ``folder`` of the scene file where that is given; and an oil as it was given. Comments have its
        numbers at the temperature, the names of materials, and values of lubfric's own that no key states. Raises
        `InputError` for a history that scene files do not have.
        """
        lines = [f"name = {toml_value(self.name)}"]
        for section in SECTIONS:
            part = getattr(self, section)
            if part is None:
                continue
            lines += ["", f"[{section}]"]
            is_rough = section in ROUGH_SECTIONS
            keys = part.applicable if is_rough else {f.name: getattr(part, f.name) for f in fields(part)}
            if keys.get("limiting_stress_coefficient", 0.0) is None:
                del keys["limiting_stress_offset"]  # refused where it does nothing
            if keys.get("oil") is not None:
                oil = keys.pop("oil")  # in place of the numbers that follow from it
                followed = fields_of(oil, keys["temperature"]) | {"temperature": ...}
                others = {key: value for key, value in keys.items() if followed.get(key, ...) != value}
                keys = oil.given_keys | {"density_law": keys["density_law"]} | others
            table = keys.pop("boundary_friction_table", None)
            if table is not None:
                keys["boundary_friction_coefficient"] = {table.over: table.at, "values": table.values}
            for name, low, high in self.ranges:
                if name.partition(".")[0] == section:
                    keys[name.partition(".")[2]] = (value_of(self, name), low, high)
            if "file" in keys:
                keys["file"] = _map_in_words(keys["file"], folder)
            keys = {key: value for key, value in keys.items() if value is not None and value != ()}
            lines += [f"{key} = {toml_value(value)}" for key, value in keys.items()]
            lines += [f"# {comment}" for comment in comments_of(section, part, keys)]
        return "\n".join(lines) + "\n"

    def _facts(self) -> dict[str, str]:
        rough = self.surface
        sq = "" if rough.sq is None else f"Sq {rough.sq:.4g} m"
        return {
            "": self.name,
            "R": f"{self.bodies.radius:.4g} m",
            "load": f"{self.bodies.load:.4g} N on {self.bodies.width:.4g} m",
            "viscosity": f"{self.lubricant.viscosity:.4g} Pa s",
            "U": f"{self.motion.entrainment_speed:.4g} m/s",
            "surface": " ".join(part for part in (rough.file or "generated", sq) if part),
        }


def _has_surrogates(text: str) -> bool:
    """Return whether there are surrogates in ``text``, which no file in UTF-8 holds."""
    return any("\ud800" <= mark <= "\udfff" for mark in text)


def _map_in_words(file: str | Path, folder: str | Path | None) -> str:
    """Return the path of a map as a scene file in ``folder`` has it: relative to that folder, with / on all systems;
    complete without a folder, and from another drive."""
    if folder is not None:
        with suppress(ValueError):  # another drive
            return Path(os.path.relpath(Path(file).resolve(), Path(folder).resolve())).as_posix()
    return str(Path(file).absolute())


def toml_value(value: Any) -> str:
    """Return ``value`` as TOML has it, a history as the table of its fields. Raises `InputError` for what has no form
    there."""
    if isinstance(value, History):
        kind = next((kind for kind, known in HISTORY_KINDS.items() if type(value) is known), None)
        if kind is None:
            message = f"a history of type {type(value).__name__} has no form in a scene file"
            raise InputError(message, allowed=", ".join(HISTORY_KINDS))
        return toml_value({"kind": kind} | vars(value))
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        if _has_surrogates(value):  # a path
            raise InputError(f"{ascii(value)} is not Unicode, and a scene file cannot hold it; rename it")
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")  # the one control that JSON lets stand
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{name} = {toml_value(part)}' for name, part in value.items())} }}"
    return f"[{', '.join(toml_value(part) for part in value)}]"


def value_of(scene: Scene, name: str) -> Any:
    """Return the value of the key ``name`` (section.key); None where the scene has no such section."""
    section, _, key = name.partition(".")
    part = getattr(scene, section)
    return None if part is None else getattr(part, key)


def inputs_not_given(scene: Scene) -> tuple[str, ...]:
    """Return the keys (section.key) of `ASSUMED_IN_A_RANGE` that ``scene`` does not give."""
    return tuple(key for key in ASSUMED_IN_A_RANGE if value_of(scene, key) is None)


def _stated_by(scene: Scene, name: str) -> tuple[Any, ...]:
    """Return the values that the key ``name`` (section.key) states: of its fields, else of the whole section."""
    section = getattr(scene, name.partition(".")[0])
    fields_of_section = [field.partition(".")[2] for field in fields_of_key(name)]
    values = tuple(getattr(section, key) for key in fields_of_section if hasattr(section, key))
    return values or (section,)


def _is_within(value: Any, low: Any, high: Any) -> bool:
    """Return whether ``value`` is from ``low`` to ``high``, of pairs each part."""
    (values, lows, highs) = (np.atleast_1d(np.asarray(each, float)) for each in (value, low, high))
    return values.shape == lows.shape == highs.shape and bool(np.all((lows <= values) & (values <= highs)))


def as_ranges(ends: dict[str, Any]) -> tuple[tuple[str, Any, Any], ...]:
    """Return `Scene.ranges` of the ends by name, None where a value has no range."""
    return tuple((name, *ends[name]) for name in sorted(ends) if ends[name] is not None)


def why_gap_not_resolved(scene: Scene, *, has_one_map_for_all_bodies: bool = False) -> str:
    """Return the first key of ``scene`` that the deterministic model does not take, and what it takes, as text; "" if
    it takes all. ``has_one_map_for_all_bodies``: whether one map was given to `lubfric.prepare` for all bodies."""
    refusals = _not_taken(scene, has_one_map_for_all_bodies=has_one_map_for_all_bodies)
    return next(
        (f"{_stated(name, value)} (the deterministic model allows {instead})" for name, value, instead in refusals), ""
    )


def _stated(name: str, value: Any) -> str:
    """Return a key with its ``value`` as text, a number with its unit."""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return f"{name} = {worded_value(name, value) if is_number else repr(value)}"


def check_resolved_gap(scene: Scene, *, has_one_map_for_all_bodies: bool = False) -> None:
    """Raise `InputError` for keys that the deterministic model does not take. ``has_one_map_for_all_bodies``: as in
    `why_gap_not_resolved`."""
    for name, value, instead in _not_taken(scene, has_one_map_for_all_bodies=has_one_map_for_all_bodies):
        message = f" = {value!r} cannot be combined with numerics.model = 'deterministic'"
        raise InputError(message, name, f"{instead}, or numerics.model = 'paper'")


def moving_bodies(scene: Scene) -> list[tuple[str, float]]:
    """Return the sections of the rough bodies, each with its speed over U: surface 1 - s/2, counterface 1 + s/2, s the
    slide-roll ratio."""
    half = 0.5 * scene.motion.slide_roll_ratio
    bodies = ("surface", 1 - half, scene.surface), ("counterface", 1 + half, scene.counterface)
    return [(name, speed) for name, speed, rough in bodies if rough is not None and rough.sq != 0.0]


def has_moving_roughness(scene: Scene) -> bool:
    """Return whether roughness moves through the film."""
    return any(speed != 0 for _, speed in moving_bodies(scene))


def has_generated_roughness(scene: Scene) -> bool:
    """Return whether roughness is generated, by its correlation length."""
    sections = (scene.surface, scene.counterface)
    return any(section is not None and section.correlation_length is not None for section in sections)


def _not_taken(scene: Scene, *, has_one_map_for_all_bodies: bool) -> Iterator[tuple[str, Any, str]]:
    """Yield each input of ``scene`` that the model of the resolved gap does not take: its key, its value and what is
    allowed."""
    for name, allowed, why in VALUES_OF_RESOLVED_GAP:
        section, _, key = name.partition(".")
        value = getattr(getattr(scene, section), key)
        if value not in allowed:
            yield name, value, f"{', '.join(map(repr, allowed))}{why}"
    if scene.transient is not None and scene.numerics.heat == "on":
        yield "numerics.heat", "on", "'auto', 'off' (in time the model is isothermal)"
    if scene.transient is not None and scene.lubricant.inlet_length is not None:
        yield (
            "lubricant.inlet_length",
            scene.lubricant.inlet_length,
            "none in a run in time, where its inlet is flooded",
        )
    limit = scene.lubricant.limit
    offset = scene.lubricant.limiting_stress_offset
    if limit is not None and offset < LEAST_OFFSET:
        instead = (
            f"at least {LEAST_OFFSET:g} Pa: a film whose limit is 0 at ambient pressure has no viscosity in its inlet"
        )
        yield "lubricant.limiting_stress_offset", offset, instead
    bodies = moving_bodies(scene)
    if len({u for _, u in bodies}) > 1 and has_one_map_for_all_bodies:
        yield "counterface", "a second rough body", "at a slide-roll ratio other than 0 a map of its own"
    lubricant = scene.lubricant
    if lubricant.shear_modulus is not None:
        yield "lubricant.shear_modulus", lubricant.shear_modulus, "none, as it has no elastic shear at small slip"
