"""Comments of a scene file: numbers that follow from its keys, and values of lubfric's own in place of keys that it
omits."""

from collections.abc import Collection, Iterator
from typing import Any

from ..oil import Oil
from ..quantities import KEYS
from . import budget
from .bodies import BOUNDARY_FILM, Bodies
from .materials import materials_of
from .numerics import Numerics
from .short_forms import fields_of

VALUE_OF_LUBFRIC = "not given: the value of lubfric"
BY_OIL = "by the oil"


def comments_of(section: str, part: Any, written: Collection[str]) -> Iterator[str]:
    """Return the comments of a ``section`` of a scene, ``part``, whose keys ``written`` are in the file."""
    if section == "bodies":
        return comments_of_bodies(part)
    if section == "lubricant" and part.oil is not None:
        return comments_of_oil(part.oil, part.temperature, written)
    return comments_of_numerics(part) if section == "numerics" else iter(())


def comments_of_bodies(bodies: Bodies) -> Iterator[str]:
    """Yield the comments of [bodies]: the materials that its numbers belong to, and the boundary film."""
    if materials := materials_of(bodies):
        names = " and ".join(dict.fromkeys(materials))
        yield f"e_prime, conductivity and volumetric_heat are those of the material {names}"
    if bodies.boundary_film is None:
        reason = (
            f"{VALUE_OF_LUBFRIC}; a key here would remove its range, half to twice the value, from the interval of f"
        )
        yield _comment("bodies.boundary_film", BOUNDARY_FILM, reason)
    if bodies.hardness is None:
        yield "hardness is not given: elastic asperities, without a plastic limit"


def comments_of_oil(oil: Oil, temperature: float, written: Collection[str]) -> Iterator[str]:
    """Yield the comments of [lubricant]: the numbers of an ``oil`` at the ``temperature`` [K] whose keys are not
    ``written``."""
    density = {"density": oil.density_15, "density_slope": oil.density_fall}
    for key, value in {**fields_of(oil, temperature), **density}.items():
        if isinstance(value, float) and key not in written:
            yield _comment(f"lubricant.{key}", value, BY_OIL)


def comments_of_numerics(numerics: Numerics) -> Iterator[str]:
    """Yield the comments of [numerics]: the tolerances that follow from ``tolerance``."""
    for part in budget.OF_PARTS:
        if getattr(numerics, f"{part}_tolerance") is None:
            yield _comment(f"numerics.{part}_tolerance", numerics.tolerance_of(part), "by tolerance")


def _comment(key: str, value: float, reason: str) -> str:
    """Return the comment of a ``key`` that is not written: "viscosity = 0.0275 [Pa s] (by the oil)"."""
    unit = f" [{KEYS[key].unit}]" if key in KEYS else ""
    return f"{key.partition('.')[2]} = {value!r}{unit} ({reason})"
