"""Everything that a scene file lacks, at once."""

from __future__ import annotations

from dataclasses import MISSING, fields
from typing import Any

from ..errors import InputError
from .roughness import NEEDED
from .short_forms import resolve

INSTEAD = {  # of a missing key
    "lubricant.viscosity": " in Pa s, or an oil: grade and viscosity_index, or nu40 and nu100, with its temperature",
    "bodies.radius": " in m, or radii of both bodies",
    "bodies.width": " in m",
    "bodies.load": " in N, or hertz_pressure in Pa",
    "bodies.boundary_friction_coefficient": " of the contact spots (some 0.1)",
    "bodies.e_prime": " in Pa, or material, or young_modulus and poisson_ratio",
    "motion.entrainment_speed": " in m/s, or surface_speeds of both bodies",
}


def check_complete(name: str, table: dict, needed: dict[str, Any], rough: tuple[str, ...]) -> None:
    """Raise `InputError` with everything that the ``table`` of scene ``name`` lacks.

    needed: the dataclass of every section that a scene must have, rough: which of them are a roughness. A section
    whose keys contradict each other is left to the check that says so.
    """
    lacking = []
    for section, kind in needed.items():
        told = _of_roughness if section in rough else _of_section
        lacking += told(section, kind, dict(table.get(section, {})))
    if lacking:
        raise InputError(f"scene {name} is not complete: {'; '.join(lacking)}")


def _of_section(section: str, kind, given: dict) -> list[str]:
    try:
        plain = resolve(section, given)
    except InputError:
        return []
    needed = [f.name for f in fields(kind) if f.default is MISSING and f.default_factory is MISSING]
    told = [f"{name!r}{INSTEAD.get(f'{section}.{name}', '')}" for name in needed if name not in plain]
    return [f"[{section}] needs {'; '.join(told)}"] if told else []


def _of_roughness(section: str, kind, given: dict) -> list[str]:
    complete = "file" in given or {"sq", "correlation_length"} <= set(given)
    return [] if complete else [f"[{section}] needs {NEEDED}"]
