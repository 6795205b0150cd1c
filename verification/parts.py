"""Parts of a result and of a model that a study counts on. A part that is missing ends the study in words."""

from typing import TypeVar

from lubfric.contact import ContactResult, ContactState, HalfSpaceContact
from lubfric.film import EHLResult
from lubfric.sampling import FrictionResult
from lubfric.sharing import Prepared

T = TypeVar("T")


def the(part: T | None, name: str) -> T:
    """``part``; raises ValueError where there is none."""
    if part is None:
        raise ValueError(f"this study needs a {name}, and there is none")
    return part


def film(result: FrictionResult) -> EHLResult:
    """The smooth film of a point with entrainment."""
    return the(the(result.balance, "balance").film, "film")


def contact(result: FrictionResult) -> ContactState:
    """The rough contact of a point."""
    return the(result.balance, "balance").contact


def contact_fields(result: FrictionResult) -> ContactResult:
    """Pressure and gap on the contact grid, of a point in contact."""
    return the(contact(result).fields, "contact with fields")


def half_space(model: Prepared) -> HalfSpaceContact:
    """The rough contact of a scene under a cylinder, on a height map."""
    if not isinstance(model.contact, HalfSpaceContact):
        raise TypeError(f"this study needs a contact of half-spaces, not {type(model.contact).__name__}")
    return model.contact
