"""Mean gap against mean pressure of a nominally flat rough contact: one curve for every speed and lubricant."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .._base import FieldsOnly, validate
from .result import ContactResult
from .solve import solve_contact

LIGHTEST = 1e-6  # of the heaviest pressure: below it the light-load law of one asperity is used,
ENOUGH = 0.25  # and from where the gap is as near as this, in its accuracy, to that of first touch, which is exact
SPACING = 4.0  # pressure ratio between neighbouring nodes at first; its root on maps of
SMALL = 128**2  # cells and fewer, whose summits come into contact one by one, down to
HALVED = 0.25  # error of an interpolation between nodes half as far apart, of a smooth curve
FEW = 1e-3  # of the heaviest pressure, below which f does not feel the load
CELLS = 2  # that come into contact at a time
ROUNDS, FINEST = 5, 0.05  # of adding nodes; least ln(pressure ratio) that is halved
NOTHING = 1e-9  # of the lightest gap: below it the contact is full
MATTERS = 0.1  # share of the load on the contact above which f feels all of its relative error


@dataclass(frozen=True)
class ContactCurve(FieldsOnly):
    """Nodes of the curve, heaviest first: mean_pressure [Pa], mean_gap [m], area fractions [-].

    touching_gap [m]: mean gap at first contact. ``evaluations``: convolutions spent on all nodes. gap_error [m] (n -
    1,) and area_error [-] (n - 1,): estimated errors of the gap and of the contact area interpolated between two
    nodes.
    """

    mean_pressure: np.ndarray
    mean_gap: np.ndarray
    contact_area_fraction: np.ndarray
    plastic_area_fraction: np.ndarray
    touching_gap: float
    evaluations: int
    gap_error: np.ndarray
    area_error: np.ndarray

    def error_at(self, mean_pressure: float) -> float:
        """Estimated error [m] of the gap read at a mean pressure [Pa]."""
        return self._between(self.gap_error, self.touching_gap - float(self.mean_gap[-1]), mean_pressure)

    def area_error_at(self, mean_pressure: float) -> float:
        """Estimated error [-] of the contact area fraction read at a mean pressure [Pa]."""
        return self._between(self.area_error, float(self.contact_area_fraction[-1]), mean_pressure)

    def _between(self, errors, below: float, mean_pressure: float) -> float:
        """The one of ``errors`` between two nodes. Below the lightest node what is read and what is right lie between
        its value and that of first touch, which are ``below`` apart."""
        if not errors.size:
            return 0.0
        if mean_pressure < self.mean_pressure[-1]:
            return below
        lighter = int(np.searchsorted(-self.mean_pressure, -mean_pressure))
        return float(errors[lighter - 1]) if lighter > 0 else 0.0

    def at(self, mean_pressure: float) -> tuple[float, float, float]:
        """(mean gap, contact area fraction, plastic area fraction) at a mean pressure <= the heaviest.

        Between the nodes the gap, the logarithm of the area and the plastic share of the area are shape-preserving
        cubics in the logarithm of the pressure. Below the lightest node a single Hertz asperity carries: approach and
        area ~ p^(2/3).
        """
        pressure = validate.nonnegative("mean_pressure", mean_pressure, "Pa", maximum=float(self.mean_pressure[0]))
        gap, area, plastic = self.mean_gap, self.contact_area_fraction, self.plastic_area_fraction
        lightest = self.mean_pressure[-1]
        if pressure <= lightest:
            share = (pressure / lightest) ** (2 / 3)
            return self.touching_gap - share * (self.touching_gap - gap[-1]), share * area[-1], share * plastic[-1]
        values = self._read(math.log(pressure))
        touching = float(np.exp(values[1]))
        return float(values[0]), touching, float(values[2]) * touching

    @cached_property
    def _read(self):
        """(gap, logarithm of the area, plastic share of it) at a logarithm of the pressure between the nodes."""
        from scipy.interpolate import PchipInterpolator

        area = self.contact_area_fraction
        table = np.stack([self.mean_gap, np.log(area), self.plastic_area_fraction / area])[:, ::-1]
        return PchipInterpolator(np.log(self.mean_pressure[::-1]), table, axis=1)


def contact_curve(
    heights, spacing, e_prime, *, heaviest, hardness=None, tolerance=1e-4, accuracy=3e-3, operator=None
) -> ContactCurve:
    """Solve the periodic contact of ``heights`` [m] from the pressure ``heaviest`` [Pa] down.

    Each node starts from its heavier neighbour. Nodes are added between the first ones until three errors are within
    about ``accuracy``: the relative error of the interpolated mean gap; that of the load at a given gap, by its effect
    on the friction of a film that carries the rest of ``heaviest``; and that of the area that this film has. They are
    estimated from the errors at nodes that are left out of the interpolation (`ContactCurve.gap_error`). Most nodes are
    needed near full contact, where the gap falls by orders of magnitude, and on small maps, whose summits touch one by
    one. Raises what `lubfric.solve_contact` raises.
    """
    validate.positive("heaviest", heaviest, "Pa")
    validate.positive("accuracy", accuracy, "(-)")
    gap0 = np.max(heights) - heights
    touching_gap, small = float(gap0.mean()), gap0.size <= SMALL
    options = {"hardness": hardness, "tolerance": tolerance, "operator": operator}
    solved: dict[float, ContactResult] = {}

    def add(pressure: float, start: ContactResult | None) -> ContactResult:
        solved[pressure] = solve_contact(gap0, spacing, e_prime, mean_pressure=pressure, start=start, **options)
        return solved[pressure]

    pressure, last = float(heaviest), None
    while pressure >= LIGHTEST * heaviest:
        last = add(pressure, last)
        if len(solved) > 2 and touching_gap - last.mean_gap <= ENOUGH * accuracy * touching_gap:
            break
        pressure /= math.sqrt(SPACING) if small and pressure > FEW * heaviest else SPACING
    for _ in range(ROUNDS):
        nodes, gap, area, *_ = _table(solved)
        wide = _inaccurate(nodes, gap, area, accuracy, 0.5 if small else HALVED)
        for heavier, lighter in zip(nodes[:-1][wide], nodes[1:][wide]):
            add(float(np.sqrt(heavier * lighter)), solved[heavier])
        if not wide.any():
            break
    nodes, gap, area, plastic, work = _table(solved)
    errors = errors_between(nodes, gap), errors_between(nodes, area) + CELLS / gap0.size
    return ContactCurve(nodes, gap, area, plastic, touching_gap, int(work.sum()), *errors)


def _table(solved: dict[float, ContactResult]) -> np.ndarray:
    """Pressures, gaps, area and plastic fractions, and convolutions of all that was ``solved``, heaviest first."""
    return np.array(
        [
            (pressure, r.mean_gap, r.contact_area_fraction, r.plastic_area_fraction, r.report.evaluations)
            for pressure, r in sorted(solved.items(), reverse=True)
        ]
    ).T


def _inaccurate(pressure, gap, area, accuracy, halved) -> np.ndarray:
    """Intervals in which the interpolated gap, the load at that gap, or the area that is left to the film may be off by
    more than ``accuracy``. ``halved``: the error between two nodes, over that when one of them is left out."""
    log_pressure = np.log(pressure)
    missed = [np.pad(left_out(log_pressure, values), 1) for values in (gap, area)]
    error, of_area = (halved * np.maximum(off[1:], off[:-1]) for off in missed)
    middle, rate = np.sqrt(gap[1:] * gap[:-1]), -np.diff(gap) / np.diff(log_pressure)
    share = np.sqrt(pressure[1:] * pressure[:-1]) / pressure[0]
    felt = (1 - share) * np.minimum(share / MATTERS, 1.0)  # of f, by a relative error of the load
    allowed = np.minimum(middle, rate / np.maximum(felt, NOTHING))
    deep = middle <= NOTHING * gap[-1]
    off = (error > accuracy * allowed) | (of_area > accuracy * (1 - area[:-1]))
    return off & ~deep & (-np.diff(log_pressure) > FINEST)


def errors_between(pressure, values) -> np.ndarray:
    """Estimated error of ``values`` between neighbouring nodes: the largest error at the four nodes around when each is
    left out. A curve of few summits has kinks, next to which the interpolation may meet a single node by chance."""
    missed = np.zeros(pressure.size + 2)
    missed[2:-2] = left_out(np.log(pressure), values)
    return np.max([missed[i : missed.size - 3 + i] for i in range(4)], axis=0)


def left_out(x, y) -> np.ndarray:
    """Error |y - cubic without that node| at the inner nodes (n - 2,) of ``x`` (n,), which rises or falls, and ``y``
    (n,).

    The cubic keeps the shape: F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304,
    doi:10.1137/0905021, as in `scipy.interpolate.PchipInterpolator`. A slope depends on the neighbours alone. So
    leaving out one node changes one piece, and all of these pieces are found at once.
    """
    if x.size < 3:
        return np.zeros(0)
    step, rate = np.diff(x), np.diff(y) / np.diff(x)
    wide, mean = x[2:] - x[:-2], (y[2:] - y[:-2]) / (x[2:] - x[:-2])
    left, right = mean.copy(), mean.copy()
    if x.size > 3:
        left[1:] = _slope(step[:-2], rate[:-2], wide[1:], mean[1:])
        right[:-1] = _slope(wide[:-1], mean[:-1], step[2:], rate[2:])
        left[0] = _end_slope(wide[0], mean[0], step[2], rate[2])
        right[-1] = _end_slope(wide[-1], mean[-1], step[-3], rate[-3])
    t = step[:-1] / wide
    found = y[:-2] + (y[2:] - y[:-2]) * t**2 * (3 - 2 * t) + wide * t * (1 - t) * (left * (1 - t) - right * t)
    return np.abs(found - y[1:-1])


def _slope(step, rate, next_step, next_rate) -> np.ndarray:
    """Slope between two pieces: the weighted harmonic mean of their ``rate``, zero where y turns."""
    weight, next_weight = 2 * next_step + step, next_step + 2 * step
    same = rate * next_rate > 0
    safe, next_safe = np.where(same, rate, 1.0), np.where(same, next_rate, 1.0)
    return np.where(same, (weight + next_weight) / (weight / safe + next_weight / next_safe), 0.0)


def _end_slope(step: float, rate: float, next_step: float, next_rate: float) -> float:
    """Slope at an end, where a piece has one neighbour: from three points, as far as the shape allows."""
    slope = ((2 * step + next_step) * rate - step * next_rate) / (step + next_step)
    if np.sign(slope) != np.sign(rate):
        return 0.0
    turns = np.sign(rate) != np.sign(next_rate)
    return 3 * rate if turns and abs(slope) > 3 * abs(rate) else slope
