"""Parts of a result and of a model that a study counts on. A part that is missing ends the study in words."""

from __future__ import annotations

from typing import TypeVar

from lubfric.contact import HalfSpaceContact
from lubfric.contact.result import ContactResult
from lubfric.sampling import FrictionResult
from lubfric.sharing import Decision, Lubricated, Prepared

T = TypeVar("T")


def the(part: T | None, name: str) -> T:
    """``part``; raises ValueError where there is none."""
    if part is None:
        raise ValueError(f"this study needs a {name}, and there is none")
    return part


def balance(result: FrictionResult) -> Lubricated:
    """The balance of a point with entrainment, which has a film."""
    return the(the(result.balance, "balance").lubricated, "film")


def contact_fields(result: FrictionResult) -> ContactResult:
    """Pressure and gap on the contact grid, of a point that was solved with ``fields=True``."""
    return the(the(result.balance, "balance").contact.fields, "contact with fields")


def decision(result: FrictionResult) -> Decision:
    """What was modelled, and how far."""
    return the(result.decision, "decision")


def half_space(model: Prepared) -> HalfSpaceContact:
    """The rough contact of a scene under a cylinder, on a height map."""
    if not isinstance(model.contact, HalfSpaceContact):
        raise TypeError(f"this study needs a contact of half-spaces, not {type(model.contact).__name__}")
    return model.contact
