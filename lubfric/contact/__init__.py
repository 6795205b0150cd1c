"""Dry frictionless contact of a rough half-space with a rigid flat: elastic or elastic-perfectly-plastic."""

from .result import ContactResult
from .solve import solve_contact

__all__ = ["ContactResult", "solve_contact"]
