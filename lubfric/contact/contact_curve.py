"""Mean gap against mean pressure of a nominally flat rough contact: one curve for every speed and lubricant."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from .._base import FieldsOnly, validate
from .left_out import left_out
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
    1,) and area_error [-] (n - 1,): estimated errors of the gap and of the contact area interpolated between two nodes;
    empty if there is no interpolation error.
    """

    mean_pressure: np.ndarray
    mean_gap: np.ndarray
    contact_area_fraction: np.ndarray
    plastic_area_fraction: np.ndarray
    touching_gap: float
    evaluations: int
    gap_error: np.ndarray = field(default_factory=lambda: np.zeros(0))
    area_error: np.ndarray = field(default_factory=lambda: np.zeros(0))

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
    touching_gap, solved = float(gap0.mean()), {}

    def add(pressure, start):
        solved[pressure] = solve_contact(
            gap0,
            spacing,
            e_prime,
            mean_pressure=pressure,
            hardness=hardness,
            tolerance=tolerance,
            operator=operator,
            start=start,
        )
        return solved[pressure]

    pressure, start = float(heaviest), None
    while pressure >= LIGHTEST * heaviest:
        start = add(pressure, start)
        if len(solved) > 2 and touching_gap - start.mean_gap <= ENOUGH * accuracy * touching_gap:
            break
        one_by_one = gap0.size <= SMALL and pressure > FEW * heaviest
        pressure /= math.sqrt(SPACING) if one_by_one else SPACING
    for _ in range(ROUNDS):
        pressures = sorted(solved, reverse=True)
        gap, area = np.array([(solved[p].mean_gap, solved[p].contact_area_fraction) for p in pressures]).T
        wide = _inaccurate(np.array(pressures), gap, area, accuracy, 0.5 if gap0.size <= SMALL else HALVED)
        for heavier, lighter in zip(np.array(pressures)[:-1][wide], np.array(pressures)[1:][wide]):
            add(float(np.sqrt(heavier * lighter)), solved[heavier])
        if not wide.any():
            break
    return _curve(solved, touching_gap, CELLS / gap0.size)


def _inaccurate(pressure, gap, area, accuracy, halved) -> np.ndarray:
    """Intervals in which the interpolated gap, the load at that gap, or the area that is left to the film may be off by
    more than ``accuracy``. ``halved``: the error between two nodes, over that when one of them is left out."""
    log_pressure = np.log(pressure)
    error, of_area = (
        halved * np.maximum(missed[1:], missed[:-1]) for missed in (_missed(pressure, v) for v in (gap, area))
    )
    middle, rate = np.sqrt(gap[1:] * gap[:-1]), -np.diff(gap) / np.diff(log_pressure)
    share = np.sqrt(pressure[1:] * pressure[:-1]) / pressure[0]
    felt = (1 - share) * np.minimum(share / MATTERS, 1.0)  # of f, by a relative error of the load
    allowed = np.minimum(middle, rate / np.maximum(felt, NOTHING))
    deep = middle <= NOTHING * gap[-1]
    off = (error > accuracy * allowed) | (of_area > accuracy * (1 - area[:-1]))
    return off & ~deep & (-np.diff(log_pressure) > FINEST)


def _missed(pressure, values) -> np.ndarray:
    """Error of the interpolated ``values`` at each node when that node is left out."""
    missed = np.zeros(pressure.size)
    missed[1:-1] = left_out(np.log(pressure[::-1]), values[::-1])[::-1]
    return missed


def errors_between(pressure, values) -> np.ndarray:
    """Estimated error of ``values`` between neighbouring nodes: the largest error at the four nodes around when each is
    left out. A curve of few summits has kinks, next to which the interpolation may meet a single node by chance."""
    missed = _missed(pressure, values)
    near = np.maximum(missed[1:], missed[:-1])
    return np.maximum(near, np.maximum(np.append(missed[2:], 0.0), np.append(0.0, missed[:-2])))


def _curve(solved: dict, touching_gap: float, steps: float) -> ContactCurve:
    """The curve through what was ``solved``, by pressure. ``steps``: in which the contact area grows, a few cells at a
    time."""
    pressures = sorted(solved, reverse=True)
    results = [solved[p] for p in pressures]
    gap, area, plastic, work = np.array(
        [(r.mean_gap, r.contact_area_fraction, r.plastic_area_fraction, r.report.evaluations) for r in results]
    ).T
    nodes = np.array(pressures)
    return ContactCurve(
        nodes,
        gap,
        area,
        plastic,
        touching_gap,
        int(work.sum()),
        errors_between(nodes, gap),
        errors_between(nodes, area) + steps,
    )
