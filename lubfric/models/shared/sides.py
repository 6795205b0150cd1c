"""The two sides of an error of f, towards 0 and away from it, and which of them is below f."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable
from typing import NamedTuple

import numpy as np


class Sides(NamedTuple):
    """An error of f ``towards`` 0 and ``away`` from it, relative or in f itself; NaN: not known. In records it is a
    plain tuple."""

    towards: float
    away: float

    @classmethod
    def of_ends(cls, below: float, above: float, f: float) -> Sides:
        """Return the sides of what reaches so far ``below`` and ``above`` ``f``."""
        return cls(below, above) if f >= 0 else cls(above, below)

    def below_and_above(self, f: float) -> tuple[float, float]:
        """Return how far they reach below and above ``f``."""
        return (self.towards, self.away) if f >= 0 else (self.away, self.towards)

    def capped(self) -> Sides:
        """Return these relative sides, towards 0 at most all of f."""
        return Sides(min(self.towards, 1.0), self.away)

    def at_least(self, least: float) -> Sides:
        """Return these sides, none of them below ``least``."""
        return Sides(max(self.towards, least), max(self.away, least))


# An error that is not known.
UNKNOWN_SIDES = Sides(math.nan, math.nan)


def added_sides(parts: Collection[tuple[float, float]]) -> Sides:
    """Return the root of the sum of the squares of the ``parts`` (`Sides`), on each side for itself."""
    return Sides(math.hypot(*(towards for towards, _ in parts)), math.hypot(*(away for _, away in parts)))


def added_changes(changes: Iterable[tuple[float, ...]]) -> tuple[float, float]:
    """Return how far the ranges of several inputs move f down and up, from the ``changes`` of f at the ends of each:
    the root of the sum of squares, in each direction for itself."""
    ends = [(min(0.0, *each), max(0.0, *each)) for each in changes]
    return math.hypot(*(down for down, _ in ends)), math.hypot(*(up for _, up in ends))


def below_and_above(f: np.ndarray, towards: np.ndarray, away: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return how far errors ``towards`` 0 and ``away`` from it reach below and above ``f``, of many points."""
    return np.where(f >= 0, towards, away), np.where(f >= 0, away, towards)
