"""One problem, complete: `Scene`."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, replace
from typing import Any

from .._base import validate
from ..errors import InputError
from ..film import LineContact
from ..oil import Lubricant
from .bodies import Bodies
from .change import changed_section
from .contact import ContactDomain
from .motion import Motion
from .numerics import Numerics
from .roughness import Roughness
from .shown import SceneShown
from .transient import Transient


@dataclass(frozen=True, repr=False)
class Scene(SceneShown):
    """One problem, complete: `lubfric.friction` and `lubfric.stribeck` take nothing else.

    Attributes
    ----------
    bodies, lubricant, motion, contact, numerics : the sections of a scene file (docs/scene.md)
    surface, counterface : the roughness of the two bodies (None: the other body is smooth). The sum of both is in
        contact
    transient : what changes in time, a `lubfric.Transient`, or None
    name : for titles
    """

    bodies: Bodies
    lubricant: Lubricant
    motion: Motion
    surface: Roughness
    contact: ContactDomain = field(default_factory=ContactDomain)
    numerics: Numerics = field(default_factory=Numerics)
    name: str = "unnamed"
    transient: Transient | None = None
    counterface: Roughness | None = None

    def __post_init__(self):
        if self.numerics.heat == "on" and not self.lubricant.heats:
            raise InputError(
                "numerics.heat = 'on' needs to know how the viscosity falls with the temperature; give an "
                "oil (lubricant.grade, "
                "nu40, oil) or lubricant.temperature [K] and temperature_coefficient [1/K], or heat = 'auto'"
            )

    def with_(self, **sections) -> Scene:
        """A copy with some fields of its sections replaced: ``scene.with_(bodies={"load": 10.0})``.

        The short forms of scene files may be used as well: ``scene.with_(lubricant={"temperature_celsius": 90})``.
        """
        changed = {}
        for section, values in sections.items():
            if section not in self.__dataclass_fields__:
                raise InputError(
                    f"scene has no section {section!r}{validate.nearest(section, self.__dataclass_fields__)}"
                    f"{_dotted(section, values)}"
                )
            changed[section] = changed_section(section, getattr(self, section), values)
        return replace(self, **changed)

    def with_keys(self, values: dict[str, Any]) -> Scene:
        """A copy with the ``values`` by "section.key", or by "section" for a whole one. All keys of a section act at
        once, in any order: a Hertz pressure is that with the radius given beside it."""
        whole = {key: value for key, value in values.items() if "." not in key}
        sections = {key: dict(value) for key, value in whole.items() if isinstance(value, dict)}
        for key, value in values.items():
            section, dot, field = key.partition(".")
            if dot:
                sections.setdefault(section, {})[field] = value
        ready = {key: value for key, value in whole.items() if not isinstance(value, dict)}
        return (self.with_(**ready) if ready else self).with_(**sections)

    def line_contact(self, speed: float) -> LineContact:
        """The smooth line contact of the whole load at ``speed`` [m/s], not 0."""
        bodies = self.bodies
        return LineContact(bodies.load / bodies.width, bodies.radius, bodies.e_prime, speed, self.lubricant)

    def to_toml(self) -> str:
        """The scene as the text of a scene file, which `lubfric.load_scene` reads back to the same numbers."""
        from .text import scene_as_toml

        return scene_as_toml(self)


def _dotted(key: str, value) -> str:
    """How to write what a dotted key, such as ``numerics.tolerance``, was meant to say."""
    section, _, name = key.partition(".")
    return f"; write with_({section}={{{name!r}: {validate.shown(value)}}})" if name else ""


def scene_as_dict(scene: Scene) -> dict:
    """The resolved scene as plain data (for ``result.json``)."""
    return asdict(scene)
