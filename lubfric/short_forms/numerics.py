"""[numerics]: names that keys had before."""

from __future__ import annotations

from .pairs import only_one

BEFORE = {"ehl_tolerance": "film_tolerance"}
KEYS = tuple(BEFORE)


def resolve(given: dict, old) -> dict:
    """Fields of [numerics]; a key under its old name gets its present one."""
    for before, today in BEFORE.items():
        only_one("numerics", given, before, today)
    return {BEFORE.get(key, key): value for key, value in given.items()}
