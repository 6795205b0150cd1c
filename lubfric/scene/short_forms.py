"""Short forms of a scene: the numbers on a drawing or an oil can become the fields of its sections.

Scene files and `Scene.with_` share them. `resolve` takes what was given for a section, and the section as it was (None
for a file). It returns the plain fields of the section.
"""

from __future__ import annotations

from .._base import python_value
from . import short_bodies as bodies
from . import short_lubricant as lubricant
from . import short_motion as motion

SECTIONS = {"bodies": bodies, "lubricant": lubricant, "motion": motion}


def short_keys(section: str) -> tuple[str, ...]:
    """Keys of a section that are not fields of it."""
    return SECTIONS[section].KEYS if section in SECTIONS else ()


def resolve(section: str, given: dict, old=None) -> dict:
    """Plain fields of ``section`` from what was ``given``; ``old``: the section to be changed, None for a new one.

    Raises `InputError` if two keys say the same thing, one lacks its partner, or a value is out of range.
    """
    given = {key: python_value(value) for key, value in given.items()}
    return SECTIONS[section].resolve(given, old) if section in SECTIONS else given
