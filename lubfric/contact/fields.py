"""Single-precision fields of a search. They are processed block by block, so that a block stays in the cache from one
pass to the next."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

BLOCK = 16384  # cells
HUGE = np.float32(1e20)  # times any pressure: beyond all others


@dataclass
class Fields:
    """One value a cell, on one axis. Pressures are in units of the mean one in contact, gaps in units of their scale.

    - ``lower``, ``upper`` (None: no hardness): least and largest change of the pressure.
    - ``gap``: that under the ``known`` change; ``change``: the known change and the part that is still to be convolved.
    - ``weight``: 1 on free cells, else 0; ``residue``: that of the gap on them; ``before``: the residue from which the
      ``direction`` was made.
    - ``trial``: the change to aim at.
    """

    lower: np.ndarray
    gap: np.ndarray
    change: np.ndarray
    known: np.ndarray
    direction: np.ndarray
    weight: np.ndarray
    residue: np.ndarray
    before: np.ndarray
    trial: np.ndarray
    upper: np.ndarray | None = None

    def each(self, function) -> dict:
        """``function`` of every field, by name."""
        every = ((f.name, self.__dict__[f.name]) for f in fields(Fields))
        return {name: function(values) for name, values in every if values is not None}

    def without(self, mean: np.float32) -> None:
        """Take its ``mean`` off the direction, and all of it where cells are not free."""
        self.direction -= mean
        self.direction *= self.weight

    def narrow(self, kept) -> None:
        """Keep only the positions ``kept`` from now on. Fields are cut one after the other, so that old ones are freed
        soon."""
        for name in self.each(len):
            self.__dict__[name] = self.__dict__[name].take(kept)

    def blocks(self) -> list[Block]:
        """The fields again as `Block`s, in order."""
        spare = [np.empty(min(BLOCK, self.gap.size), kind) for kind in (np.float32, np.float32, bool, bool)]
        return [
            Block(
                **self.each(lambda values: values[part]),
                part=part,
                spare=tuple(values[: part.stop - part.start] for values in spare),
            )
            for part in parts(self.gap.size)
        ]


@dataclass(kw_only=True)
class Block(Fields):
    """The fields of the cells ``part``, with ``spare`` room for two arrays of numbers and two of flags, shared by all
    blocks."""

    part: slice
    spare: tuple

    def aimed(self, aim) -> float:
        """Set the trial to ``aim`` within the limits; returns its sum."""
        np.maximum(aim, self.lower, out=self.trial)
        if self.upper is not None:
            np.minimum(self.trial, self.upper, out=self.trial)
        return float(self.trial.sum())

    def move(self, answer, step: float, gain: float) -> None:
        """Add the part ``step`` of the change, which stands in the residue, and ``gain`` times the ``answer`` of the
        gap to it. What is cut to the limits stays pending."""
        part = self.spare[0]
        self.known += np.multiply(self.residue, np.float32(step), out=part)
        self.gap += np.multiply(answer, np.float32(gain), out=part)
        np.maximum(self.known, self.lower, out=self.change)
        np.subtract(self.trial, self.lower, out=part)  # cells that the trial unloads stay so: without branches
        part *= HUGE
        part += self.lower
        np.minimum(self.change, part, out=self.change)
        if self.upper is not None:
            np.minimum(self.change, self.upper, out=self.change)
            np.copyto(self.change, self.upper, where=self.trial >= self.upper)

    def movable(self) -> int:
        """Cells whose trial is between the limits."""
        flag = np.greater(self.trial, self.lower, out=self.spare[2])
        if self.upper is not None:
            flag &= self.trial < self.upper
            flag &= self.weight > 0
        return int(np.count_nonzero(flag))


def parts(size: int) -> list[slice]:
    """Blocks of an axis."""
    return [slice(begin, min(begin + BLOCK, size)) for begin in range(0, size, BLOCK)]


def begun(gap, lower, upper) -> Fields:
    """The fields at the start: no change yet."""
    zero = {name: np.zeros(gap.size, gap.dtype) for name in ("change", "known", "direction", "before")}
    room = {name: np.empty_like(gap) for name in ("weight", "residue", "trial")}
    return Fields(lower=lower, gap=gap, upper=upper, **zero, **room)
