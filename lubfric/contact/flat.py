"""The nominally flat contact (paper, Sec. 3.1): one curve of mean gap against mean pressure, of the half-space or of
independent asperities, for every speed and lubricant, under the film of the Hertz strip."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base import FieldsOnly, FloatArray, validate
from ..errors import ConvergenceError, InputError
from .asperity import find_asperities
from .cylinder import LoadedCylinder
from .operator import HalfSpace, half_space
from .refinement import ContactResult
from .rough_contract import ContactState, RoughContact, centred_axis, weighted_mean
from .solve import solve_contact

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator


# Mean pressure over the heaviest [-] below which the light-load law of one asperity is used. A choice: a smaller value
# costs further nodes.
LIGHT_LAW_PRESSURE = 1e-6
# Distance of the gap from that of first touch, over the accuracy [-], at which lighter nodes end: first touch is exact.
# A choice: a quarter of the error that is allowed.
TOUCH_DISTANCE = 0.25
# Ratio of the pressures of neighbouring nodes at first [-]; small maps have its root. A choice: where nodes are too far
# apart, some are added between them. Half and twice this value change f by less than .1 % and the work by up to 13 %
# (constants.csv).
SPACING = 4.0
# Cells of a small map, whose summits come into contact one by one. A choice: larger costs nodes.
SMALL_MAP = 128**2
# Error of an interpolation between nodes half as far apart, over that before [-], of a smooth curve. It follows from an
# error of second order.
HALVED = 0.25
# Mean pressure over the heaviest [-] below which f does not depend on the load. A choice: f changes by as much,
# relative, at most.
NEGLIGIBLE_PRESSURE = 1e-3
# Cells that come into contact at a time, by which the contact area of a map is uncertain. A choice: one is the least
# that there can be.
CELLS_AT_A_TIME = 2
# Rounds of adding nodes, at most. A choice: a bound; each halves the distance of nodes.
NODE_ROUNDS = 5
# Distance of two nodes in ln(pressure) [-] that is not halved any more.
CLOSEST_NODES = 0.05
# Gap over the lightest one [-] below which the contact is full. A choice, near rounding.
CLOSED_GAP = 1e-9
# Asperity load ratio [-] above which a relative error of the load is one of f. A choice: below it the error weighs less
# in proportion. Half and twice this value change f by less than .01 % and the work by up to 4 % (constants.csv).
LOAD_ERROR_MATTERS = 0.1

# Points across the strip at which the film is averaged. A choice: the film is known to fewer digits.
FILM_POINTS = 512
# Columns of the strip that state where it touches: evenly. A choice: the fewest that have a width.
TOUCHING_COLUMNS = 2
# Approaches over the height range [-] at which the load of independent asperities is found. A choice: their distances
# of .2 to 10 % bound the error of an interpolation.
CURVE_APPROACHES = np.concatenate([np.geomspace(1e-4, 0.2, 80), np.linspace(0.2, 1.0, 81)[1:]])


@dataclass(frozen=True, kw_only=True)
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

    def errors_at(self, mean_pressure: float) -> tuple[float, float]:
        """Return the estimated errors of the gap [m] and of the contact area fraction [-] read at a mean pressure [Pa].
        Below the lightest node what is read and what is right lie between its value and that of first touch."""
        lighter = int(np.searchsorted(-self.mean_pressure, -mean_pressure))
        if not self.gap_error.size or lighter == 0:
            return 0.0, 0.0
        if mean_pressure < self.mean_pressure[-1]:
            return self.touching_gap - float(self.mean_gap[-1]), float(self.contact_area_fraction[-1])
        return float(self.gap_error[lighter - 1]), float(self.area_error[lighter - 1])

    def at(self, mean_pressure: float) -> tuple[float, float, float]:
        """Return (mean gap, contact area fraction, plastic area fraction) at a mean pressure <= the heaviest.

        Between the nodes the gap, the logarithm of the area and the plastic share of the area are shape-preserving
        cubics in the logarithm of the pressure. Below the lightest node a single Hertz asperity carries: approach and
        area ~ p^(2/3).
        """
        pressure = validate.nonnegative("mean_pressure", mean_pressure, "Pa", maximum=float(self.mean_pressure[0]))
        gap = self.mean_gap
        area = self.contact_area_fraction
        plastic = self.plastic_area_fraction
        lightest = self.mean_pressure[-1]
        if pressure <= lightest:
            share = (pressure / lightest) ** (2 / 3)
            return self.touching_gap - share * (self.touching_gap - gap[-1]), share * area[-1], share * plastic[-1]
        values = self._read(math.log(pressure))
        area_there = float(np.exp(values[1]))
        return float(values[0]), area_there, float(values[2]) * area_there

    @cached_property
    def _read(self) -> PchipInterpolator:
        """Return (gap, logarithm of the area, plastic share of it) at a logarithm of the pressure between the nodes."""
        from scipy.interpolate import PchipInterpolator

        area = self.contact_area_fraction
        table = np.stack([self.mean_gap, np.log(area), self.plastic_area_fraction / area])[:, ::-1]
        return PchipInterpolator(np.log(self.mean_pressure[::-1]), table, axis=1)


def contact_curve(
    heights: FloatArray,
    spacing: float | tuple[float, float],
    e_prime: float,
    *,
    heaviest: float,
    hardness: float | None = None,
    tolerance: float = 1e-4,
    accuracy: float = 3e-3,
    operator: HalfSpace | None = None,
) -> ContactCurve:
    """Solve the periodic contact of ``heights`` [m] from the pressure ``heaviest`` [Pa] down.

    Each node starts from its heavier neighbour. Nodes are added between the first ones until three errors are within
    about ``accuracy``: the relative error of the interpolated mean gap; that of the load at a given gap, by its effect
    on the friction of a film that carries the rest of ``heaviest``; and that of the area that this film has. They are
    estimated from the errors at nodes that are omitted from the interpolation (`ContactCurve.gap_error`). Most nodes
    are needed near full contact, where the gap falls by orders of magnitude, and on small maps, whose summits touch
    one by one. Raises what `lubfric.solve_contact` raises.
    """
    validate.positive("heaviest", heaviest, "Pa")
    validate.positive("accuracy", accuracy, "(-)")
    gap0 = np.max(heights) - heights
    touching_gap = float(gap0.mean())
    small = gap0.size <= SMALL_MAP
    options: dict[str, Any] = {"hardness": hardness, "tolerance": tolerance, "operator": operator}
    solved: dict[float, ContactResult] = {}

    def add(pressure: float, start: ContactResult | None) -> ContactResult:
        solved[pressure] = solve_contact(gap0, spacing, e_prime, mean_pressure=pressure, start=start, **options)
        return solved[pressure]

    pressure = float(heaviest)
    last = None
    while pressure >= LIGHT_LAW_PRESSURE * heaviest:
        last = add(pressure, last)
        if len(solved) > 2 and touching_gap - last.mean_gap <= TOUCH_DISTANCE * accuracy * touching_gap:
            break
        pressure /= math.sqrt(SPACING) if small and pressure > NEGLIGIBLE_PRESSURE * heaviest else SPACING
    for _ in range(NODE_ROUNDS):
        nodes, gap, area, *_ = _table(solved)
        wide = _inaccurate(nodes, gap, area, accuracy, 0.5 if small else HALVED)
        for heavier, lighter in zip(nodes[:-1][wide], nodes[1:][wide]):
            add(float(np.sqrt(heavier * lighter)), solved[heavier])
        if not wide.any():
            break
    nodes, gap, area, plastic, work = _table(solved)
    return ContactCurve(
        mean_pressure=nodes,
        mean_gap=gap,
        contact_area_fraction=area,
        plastic_area_fraction=plastic,
        touching_gap=touching_gap,
        evaluations=int(work.sum()),
        gap_error=errors_between(nodes, gap),
        area_error=errors_between(nodes, area) + CELLS_AT_A_TIME / gap0.size,
    )


def _table(solved: dict[float, ContactResult]) -> np.ndarray:
    """Return the pressures, gaps, area and plastic fractions, and convolutions of all that was ``solved``, heaviest
    first."""
    rows = [
        (pressure, r.mean_gap, r.contact_area_fraction, r.plastic_area_fraction, r.report.evaluations)
        for pressure, r in sorted(solved.items(), reverse=True)
    ]
    return np.array(rows).T


def _inaccurate(pressure: FloatArray, gap: FloatArray, area: FloatArray, accuracy: float, halved: float) -> np.ndarray:
    """Return the intervals in which the interpolated gap, the load at that gap, or the area that is left to the film
    may be off by more than ``accuracy``. ``halved``: the error between two nodes, over that when one of them is
    omitted."""
    log_pressure = np.log(pressure)
    left_out_errors = [np.pad(left_out(log_pressure, values), 1) for values in (gap, area)]
    error, of_area = (halved * np.maximum(each[1:], each[:-1]) for each in left_out_errors)
    middle = np.sqrt(gap[1:] * gap[:-1])
    rate = -np.diff(gap) / np.diff(log_pressure)
    share = np.sqrt(pressure[1:] * pressure[:-1]) / pressure[0]
    effect = (1 - share) * np.minimum(share / LOAD_ERROR_MATTERS, 1.0)  # of f, by a relative error of the load
    allowed = np.minimum(middle, rate / np.maximum(effect, CLOSED_GAP))
    deep = middle <= CLOSED_GAP * gap[-1]
    is_inaccurate = (error > accuracy * allowed) | (of_area > accuracy * (1 - area[:-1]))
    return is_inaccurate & ~deep & (-np.diff(log_pressure) > CLOSEST_NODES)


def errors_between(pressure: FloatArray, values: FloatArray) -> np.ndarray:
    """Return the estimated error of ``values`` between neighbouring nodes: the largest error at the four nodes around
    when each is omitted. A curve of few summits has kinks, next to which the interpolation may meet a single node
    by chance."""
    left_out_errors = np.zeros(pressure.size + 2)
    left_out_errors[2:-2] = left_out(np.log(pressure), values)
    return np.max([left_out_errors[i : left_out_errors.size - 3 + i] for i in range(4)], axis=0)


def left_out(x: FloatArray, y: FloatArray) -> np.ndarray:
    """Return the error |y - cubic without that node| at the inner nodes (n - 2,) of ``x`` (n,), which rises or falls,
    and ``y`` (n,).

    The cubic keeps the shape: F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304,
    doi:10.1137/0905021. It is that of ``scipy.interpolate.PchipInterpolator``, by its two nodes on each side.
    """
    if x.size < 3:
        return np.zeros(0)
    x = x if x[0] < x[-1] else -x
    step = np.diff(x)
    rate = np.diff(y) / step
    wide = x[2:] - x[:-2]
    steep = (y[2:] - y[:-2]) / wide
    first = steep.copy()  # slopes of the cubic at the nodes before and after the omitted one
    last = steep.copy()
    if x.size > 3:
        first[1:] = _slope_between(step[:-2], wide[1:], rate[:-2], steep[1:])
        first[0] = _slope_at_end(wide[0], step[2], steep[0], rate[2])
        last[:-1] = _slope_between(wide[:-1], step[2:], steep[:-1], rate[2:])
        last[-1] = _slope_at_end(wide[-1], step[-3], steep[-1], rate[-3])
    t = step[:-1] / wide
    of_values = y[:-2] * (1 + 2 * t) * (1 - t) ** 2 + y[2:] * t**2 * (3 - 2 * t)
    of_slopes = wide * (first * t * (1 - t) ** 2 - last * t**2 * (1 - t))
    return np.abs(of_values + of_slopes - y[1:-1])


def _slope_between(before: FloatArray, after: FloatArray, rate: FloatArray, next_rate: FloatArray) -> np.ndarray:
    """Return the slope at a node between two steps ``before`` and ``after`` it, along which ``y`` changes at ``rate``
    and at ``next_rate``: their weighted harmonic mean; 0 at an extremum."""
    product = rate * next_rate
    mean = (2 * after + before) * next_rate + (after + 2 * before) * rate
    rises_on = product > 0
    return np.where(rises_on, 3 * (before + after) * product / np.where(rises_on, mean, 1.0), 0.0)


def _slope_at_end(step: float, next_step: float, rate: float, next_rate: float) -> float:
    """Return the slope at the first node: that of a parabola, limited to keep the shape."""
    slope = ((2 * step + next_step) * rate - step * next_rate) / (step + next_step)
    if slope * rate <= 0:
        return 0.0
    return 3 * rate if rate * next_rate <= 0 and abs(slope) > 3 * abs(rate) else slope


def asperity_curve(
    heights: FloatArray,
    spacing: tuple[float, float],
    e_prime: float,
    *,
    heaviest: float,
    definition: str,
    reading: str,
    hardness: float | None = None,
) -> ContactCurve:
    """Return the mean gap against mean pressure of independent asperities on a periodic map, from first touch on.

    ``reading``: "volume" or "mean-plane" (see the module) of heights [m] about their mean. The flat comes down until
    it carries ``heaviest`` [Pa]. If the model cannot carry that, the flat comes down to the deepest valley (to the
    mean plane for "mean-plane"), and the curve ends at the largest pressure. Patches that grow together carry less
    than before; such nodes are omitted, so that the pressure rises along the curve. The search ends below half of the
    largest pressure.
    """
    asperities = find_asperities(heights, spacing, e_prime, definition=definition, hardness=hardness)
    top = float(heights.max())
    span = float(np.ptp(heights))
    nodes: list[tuple[float, float, float, float]] = []
    for approach in span * CURVE_APPROACHES:
        contact = asperities(top - approach)
        gap = _curve_gap(heights, top - approach, reading)
        if gap <= 0:
            break
        if contact.load > 0 and (not nodes or contact.mean_pressure > nodes[-1][0]):
            nodes.append(
                (contact.mean_pressure, gap, min(contact.contact_area_fraction, 1.0), contact.plastic_area_fraction)
            )
        if nodes and (nodes[-1][0] >= heaviest or contact.mean_pressure < 0.5 * nodes[-1][0]):
            break
    if not nodes:
        raise InputError(
            f"contact.model = {definition!r}: the map of {heights.shape[0]} x {heights.shape[1]} points has none; give "
            "a map with points above all of their neighbours, or contact.model = 'half-space'"
        )
    pressure, gap, area, plastic = np.array(nodes[::-1]).T
    return ContactCurve(
        mean_pressure=pressure,
        mean_gap=gap,
        contact_area_fraction=area,
        plastic_area_fraction=plastic,
        touching_gap=_curve_gap(heights, top, reading),
        evaluations=0,
        gap_error=errors_between(pressure, gap),
        area_error=errors_between(pressure, area),
    )


def _curve_gap(heights: FloatArray, separation: float, reading: str) -> float:
    return float(np.maximum(separation - heights, 0.0).mean()) if reading == "volume" else float(separation)


@dataclass(frozen=True, kw_only=True)
class FlatContact(RoughContact):
    """Roughness spread evenly over the Hertz strip of the total load.

    x [m] (nx,), weight (nx,): points across the strip, and the part of it that each represents; area [m^2] of the
    strip: a load divided by it is a mean pressure of the curve; columns [m]: where it is said to touch.
    """

    curve: ContactCurve
    x: np.ndarray
    weight: np.ndarray
    area: float
    columns: np.ndarray

    def close(
        self, film: np.ndarray, load: float, start: ContactState | None = None, shape: np.ndarray | None = None
    ) -> ContactState:
        """Read from the curve; ``start`` and ``shape`` are not needed. Raises `ConvergenceError` for a load that the
        contact model of the curve cannot carry."""
        pressure = load / self.area
        heaviest = float(self.curve.mean_pressure[0])
        if pressure > heaviest * (1 + 1e-12):
            raise ConvergenceError(f"the contact model carries {self.capacity:.4g} N at most; the load is {load:.4g} N")
        gap, area, plastic = self.curve.at(min(pressure, heaviest))
        gap_error, area_error = self.curve.errors_at(pressure)
        return ContactState(
            mean_gap=gap,
            mean_film=weighted_mean(film, self.weight),
            x=self.columns,
            contact_fraction=np.full(self.columns.size, area),
            real_contact_area_fraction=area,
            plastic_area_fraction=plastic,
            gap_error=gap_error,
            area_error=area_error,
        )

    def over_strip(self, half_width: float, before: float) -> FlatContact:
        """Return the contact with its load spread over the other strip."""
        ratio = half_width / before
        return replace(self, x=ratio * self.x, area=ratio * self.area, columns=ratio * self.columns)

    @property
    def name(self) -> str:
        return "flat periodic curve"

    @property
    def capacity(self) -> float:
        return float(self.curve.mean_pressure[0] * self.area)


def flat_contact(
    heights: np.ndarray,
    spacing: tuple[float, float],
    cylinder: LoadedCylinder,
    *,
    model: str = "half-space",
    asperity_separation: str = "volume",
    tolerance: float = 1e-4,
    accuracy: float = 3e-3,
    workers: int = 1,
) -> FlatContact:
    """Return the flat contact of a periodic rough surface that spreads over the Hertz strip of a loaded cylinder.

    Parameters
    ----------
    heights : (nx, ny) [m] about their mean, periodic along both axes
    spacing : (dx, dy) [m] of the cells
    cylinder : the `LoadedCylinder`, whose Hertz strip bears the load
    model : "half-space", or "summits" or "patches" (`asperity_contact`)
    asperity_separation : how independent asperities read the gap: "volume" or "mean-plane" (`asperity_curve`)
    tolerance, accuracy : of the curve of the half-space (`contact_curve`)
    workers : threads of the Fourier transforms
    """
    half_width = cylinder.half_width
    area = cylinder.hertz_area
    e_prime = cylinder.e_prime
    hardness = cylinder.hardness
    heaviest = cylinder.load / area
    if model == "half-space":
        curve = contact_curve(
            heights,
            spacing,
            e_prime,
            heaviest=heaviest,
            hardness=hardness,
            tolerance=tolerance,
            accuracy=accuracy,
            operator=half_space(heights.shape, spacing, e_prime, workers=workers),
        )
    else:
        curve = asperity_curve(
            heights,
            spacing,
            e_prime,
            heaviest=heaviest,
            hardness=hardness,
            definition=model,
            reading=asperity_separation,
        )
    # The film is averaged over points that are even in the angle t, x = -b cos(t): a thin film opens over less than a
    # hundredth of the strip, at its ends.
    angle = (np.arange(FILM_POINTS) + 0.5) * (np.pi / FILM_POINTS)
    columns = centred_axis(TOUCHING_COLUMNS, 2 * half_width / TOUCHING_COLUMNS)
    return FlatContact(curve=curve, x=-half_width * np.cos(angle), weight=np.sin(angle), area=area, columns=columns)
