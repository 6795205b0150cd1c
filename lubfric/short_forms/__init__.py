"""Short forms of a scene: what stands on a drawing or an oil can becomes the fields of its sections.

Scene files and `Scene.with_` share them. `resolve` takes what was given for a section, and the section as it was (None
for a file). It returns the plain fields of the section.
"""

from __future__ import annotations

from . import bodies, lubricant, motion, numerics

SECTIONS = {"bodies": bodies, "lubricant": lubricant, "motion": motion, "numerics": numerics}


def short_keys(section: str) -> tuple[str, ...]:
    """Keys of a section that are no fields of it."""
    return SECTIONS[section].KEYS if section in SECTIONS else ()


def resolve(section: str, given: dict, old=None) -> dict:
    """Plain fields of ``section`` for what was ``given``; ``old``: the section to be changed, None for a new one.

    Raises `InputError` where two keys say the same thing, one is missing its partner, or a value is out of range.
    """
    return SECTIONS[section].resolve(dict(given), old) if section in SECTIONS else dict(given)
