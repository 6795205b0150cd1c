"""Named materials of bodies (materials.toml)."""

from typing import Any

from .._base import packaged, validate
from ..film import composite_modulus
from .bodies import Bodies, pair


def fields_of_materials(names: Any, *_: Any) -> dict[str, Any]:
    """Return fields of `Bodies` of one or two named materials."""
    known = packaged(__package__, "materials.toml")
    both = (names, names) if isinstance(names, str) else pair("bodies.material", names, "names")
    first, second = (known[validate.choice("bodies.material", name, known)] for name in both)
    moduli = [m[name] for m in (first, second) for name in ("young_modulus", "poisson_ratio")]
    return {
        "e_prime": composite_modulus(*moduli),
        "conductivity": (first["conductivity"], second["conductivity"]),
        "volumetric_heat": tuple(m["density"] * m["specific_heat"] for m in (first, second)),
    }


def materials_of(bodies: Bodies) -> tuple[str, ...]:
    """Return the names of the materials that both ``bodies`` have, () where their moduli and their heat are not those of
    named ones."""
    known = packaged(__package__, "materials.toml")
    for first in known:
        for second in known:
            fields = fields_of_materials((first, second))
            if all(getattr(bodies, name) == value for name, value in fields.items()):
                return first, second
    return ()
