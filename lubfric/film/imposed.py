"""A line pressure that deflects the film but is not carried by it, such as that of asperities in contact."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from .._base import array
from ..errors import InputError

FLATTEST = 1e8  # radius of a seat, in radii of the cylinder
FLAT_WINDOW = 0.8  # of the Hertz half-width of all the load: a film that reaches so far sees the edges of the flat


@dataclass(frozen=True)
class LinePressure:
    """Piecewise linear pressure [Pa] between the nodes ``x`` [m], ascending; zero outside, where it may jump."""

    x: np.ndarray
    pressure: np.ndarray

    @property
    def load(self) -> float:
        """Load of the whole pressure [N/m]."""
        return float(np.sum(0.5 * (self.pressure[1:] + self.pressure[:-1]) * np.diff(self.x)))

    def mirrored(self) -> LinePressure:
        """The same pressure, seen from the other side."""
        return LinePressure(-self.x[::-1], self.pressure[::-1])


@dataclass(frozen=True)
class Seat:
    """A cylinder that approximates the gap which an imposed pressure leaves: ``radius`` R and ``modulus`` E' (ratios to
    the real ones) about ``centre`` [m].

    The film in that gap, and the dry contact of the film's own load, are roughly those of this cylinder. It only serves
    to make grids and starts.
    """

    centre: float = 0.0
    radius: float = 1.0
    modulus: float = 1.0


def find_seats(problem) -> tuple[Seat, ...]:
    """The seats of a `Problem`, the likelier one first; a single one if no pressure is imposed.

    One seat is flat: it has Johnson's modulus, E' times the film's share of the load. The other is curved. Over a
    window
    x - x0| <= s the gap G = x²/2R + imposed deflection is close to a parabola where the Chebyshev mean of G' is zero.
    Its curvature is k = 2/(pi s) ∫ sin(t) G'(x0 + s sin t) dt. A dry contact of the half-width s then carries what a
    cylinder of the radius 1/k does (K. L. Johnson, Contact Mechanics, 1985, Sec. 2.7). The window is that of contact
    and film, s² = b² + 2 h/k.
    """
    if problem.imposed is None:
        return (Seat(),)
    from scipy.optimize import brentq

    imposed, radius = problem.imposed, problem.contact.radius
    wide = problem.flat_half_width * problem.length_unit
    reach = max(2.0 * wide + math.hypot(*_window(problem, 1.0)), float(np.abs(imposed.x).max()))
    x = reach * np.sinh(np.linspace(-6.0, 6.0, 1201)) / 50.0
    slope = x / radius + line_deflection(x, imposed.x, imposed.pressure)[1] / problem.contact.e_prime
    sine = np.sin((np.arange(64) + 0.5) * (math.pi / 64) - math.pi / 2)

    def slopes(centre, window):
        return np.interp(centre + window * sine, x, slope)

    def centre_of(window):
        return brentq(lambda centre: slopes(centre, window).sum(), -reach, reach, xtol=1e-6 * wide)

    def ratio_of(window):
        curvature = float(slopes(centre_of(window), window) @ sine) / 32.0 / window
        return min(1.0 / (radius * curvature), FLATTEST) if curvature > 0 else FLATTEST

    def surplus(log_window):
        return log_window - math.log(math.hypot(*_window(problem, ratio_of(math.exp(log_window)))))

    load = problem.contact.load_per_width
    window = math.exp(brentq(surplus, math.log(1e-4 * wide), math.log(2.0 * reach), xtol=1e-2))
    flat = Seat(0.5 * float(imposed.x[0] + imposed.x[-1]), 1.0, load / (load + imposed.load))
    curved = Seat(centre_of(window), ratio_of(window))
    return (curved, flat) if window < FLAT_WINDOW * wide else (flat, curved)


def _window(problem, ratio: float) -> tuple[float, float]:
    """Half-width [m] of the dry contact and length [m] of the film on a cylinder of ``ratio`` radii."""
    seated = replace(problem, seat=Seat(0.0, ratio))
    return (
        seated.seat_half_width * problem.length_unit,
        math.sqrt(2.0 * seated.film_guess * ratio) * problem.length_unit,
    )


def line_pressure(value) -> LinePressure | None:
    """The pressure ``value`` = (x [m], pressure [Pa]), checked, without the nodes far from any pressure. None if the
    pressure is zero."""
    if value is None:
        return None
    if isinstance(value, LinePressure):
        value = value.x, value.pressure
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        raise InputError(f"imposed_pressure = {type(value).__name__}; allowed: None or a pair (x [m], pressure [Pa])")
    x = array("imposed_pressure[0]", value[0], "m", ndim=1)
    pressure = array("imposed_pressure[1]", value[1], "Pa", ndim=1)
    if x.size != pressure.size or x.size < 2 or not np.all(np.diff(x) > 0.0):
        raise InputError(
            f"imposed_pressure has {x.size} positions and {pressure.size} pressures; allowed: as many of "
            "each, at least 2, the positions [m] ascending"
        )
    if pressure.min() < 0.0:
        raise InputError(f"imposed_pressure falls to {pressure.min():.4g} Pa; allowed: 0 and above")
    loaded = np.flatnonzero(pressure)
    if loaded.size == 0:
        return None
    used = slice(max(loaded[0] - 1, 0), loaded[-1] + 2)
    return LinePressure(x[used], pressure[used])


def line_deflection(points: np.ndarray, nodes: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """-(4/pi) ∫ p(x') ln|x - x'| dx' of a piecewise linear p, and its derivative by x, exact, at ``points`` (n,).

    p'' is a spike at every kink, and a double one at each of the two jumps at the ends. Let G(s) = s²/2 ln|s| - 3/4 s²,
    so that G'' = ln|s|. The integral is the sum of G times the kinks and of G' times the jumps. Beside a jump the
    derivative is infinite. A point on an end node with a pressure gets the finite part of its neighbourhood.
    """
    slope = np.diff(values) / np.diff(nodes)
    kinks = np.diff(slope, prepend=0.0, append=0.0)
    s = points[:, None] - nodes[None, :]
    log = np.log(np.where(s == 0.0, 1.0, np.abs(s)))
    first = s * (log - 1.0)
    value = (s * s * (0.5 * log - 0.75)) @ kinks + values[0] * first[:, 0] - values[-1] * first[:, -1]
    derivative = first @ kinks + values[0] * log[:, 0] - values[-1] * log[:, -1]
    return -4.0 / math.pi * value, -4.0 / math.pi * derivative
