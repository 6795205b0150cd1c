"""A film that is deflected by its own pressure and by that of the contact: both are found together at one division of
the load.

The film is solved under an imposed line pressure (`lubfric.solve_ehl`). The surface is pressed under this film less the
deflection by the imposed pressure, because the contact adds its own deflection. The imposed pressure is a Hertz
semi-ellipse with the load of the contact. It tilts and bends the Hertz strip as the contact's pressure, mean over y,
does (`spread_of`). For a smooth cylinder that is exact. It leaves out the waves that single asperities of a finite
patch add to the mean, because a film of smooth surfaces cannot follow them (`departure` measures these). A nominally
flat contact has no distribution along x: its semi-ellipse covers the strip of the total load.

Centre and half-width are found as a fixed point: film under the contact's pressure -> contact under that film -> its
pressure, with Anderson's mixing (D. G. Anderson, J. ACM 12 (1965) 547-560, doi:10.1145/321296.321305).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import ITERATION_LIMIT, ConvergenceError, Report
from ..film import hat_kernel
from ..scene import Scene
from .operating_point import OperatingPoint, Start, Trial

NODES, STRIP = 49, 65  # of a semi-ellipse; points across the Hertz strip at which deflections are compared
MOST, MEMORY = 40, 3  # steps of the fixed point, and how many of them the next one is made from
TIGHTEST = 1e-4  # the contact's own tolerance allows no less
WIDEST = 4.0  # half-width of a semi-ellipse, in those of the strip


@dataclass(frozen=True)
class Ellipse:
    """``line_load`` [N/m] spread like Hertz's pressure over ``half_width`` [m] about ``centre`` [m]."""

    line_load: float
    centre: float
    half_width: float

    @property
    def nodes(self) -> tuple[np.ndarray, np.ndarray]:
        """Positions [m] and pressures [Pa] of the same load, linear in between."""
        angle = np.linspace(-np.pi / 2, np.pi / 2, NODES)
        x, p = self.centre + self.half_width * np.sin(angle), np.cos(angle)
        p[0] = p[-1] = 0.0
        return x, p * (self.line_load / np.trapezoid(p, x))


def film_and_contact(point: OperatingPoint, film_load: float, contact_load: float, last: Start) -> Trial:
    """Film and contact of ``film_load`` and ``contact_load`` [N], each found under the pressure of the other.

    Starts from ``last``. Stops when `mismatch` <= half the tighter tolerance of film and volume, or 1e-4; raises
    `ConvergenceError` with a report after 40 steps.
    """
    scene = point.scene
    line_load, half_width = contact_load / scene.bodies.width, scene.bodies.half_width
    if point.contact.nominally_flat:
        return point.trial(film_load, contact_load, last, Ellipse(line_load, 0.0, half_width).nodes)
    used = _first(last.film, line_load, half_width)
    tolerance = max(0.5 * min(point.settings.balance_tolerance, point.settings.film_tolerance), TIGHTEST)
    history: list[float] = []
    steps: list[tuple[Ellipse, np.ndarray]] = []
    while len(history) < MOST:
        found = point.trial(film_load, contact_load, last, used.nodes)
        last = found
        spread = spread_of(scene, found.contact, line_load)
        apart = deflection(scene, *spread.nodes) - deflection(scene, *used.nodes)
        history.append(float(np.max(np.abs(apart))) / found.contact.mean_film)
        if history[-1] <= tolerance:
            return found
        steps = [*steps, (spread, apart)][-MEMORY:]
        used = _mixed(steps)
    report = Report(
        "film and contact under each other's pressure",
        ITERATION_LIMIT,
        MOST,
        history[-1],
        tolerance,
        {"deflection": history[-1]},
        tuple(history),
        MOST,
    )
    raise ConvergenceError(report.message, report, (found.film, found.contact))


def residuals(scene: Scene, found: Trial) -> dict[str, float]:
    """`mismatch`, for the report of a balance."""
    return {"deflection": mismatch(scene, found.film, found.contact)}


def notes(scene: Scene, found: Trial) -> tuple[str, ...]:
    """`departure` in words, for the report of a balance."""
    if found.contact.fields is None:
        return ()
    left_out = 100 * departure(scene, found.contact, found.contact_load / scene.bodies.width)
    return (
        "film deflected by the total pressure; single asperities bend the gap by "
        f"{left_out:.2g} % of the mean film more, which the semi-ellipse of their pressure leaves out",
    )


def mismatch(scene, film, contact) -> float:
    """Largest difference across the Hertz strip, up to a constant, between the deflections by the contact's pressure
    and by the pressure with which the film was solved, relative to the mean film: the error of h in its equation."""
    if film is None or film.imposed is None or contact.pressure is None:
        return 0.0
    imposed = film.imposed
    found = spread_of(scene, contact, imposed.load)
    apart = deflection(scene, *found.nodes) - deflection(scene, imposed.x, imposed.pressure)
    return float(np.max(np.abs(apart))) / contact.mean_film


def departure(scene, contact, line_load: float) -> float:
    """What the semi-ellipse leaves out: the rms difference across the strip between the deflections by the contact's
    pressure, mean over y, and by its semi-ellipse, relative to the mean film."""
    if contact.pressure is None:
        return 0.0
    pressure, step = contact.pressure.mean(axis=1), contact.x[1] - contact.x[0]
    x = np.concatenate([[contact.x[0] - step], contact.x, [contact.x[-1] + step]])
    apart = deflection(scene, x, np.pad(pressure, 1)) - deflection(scene, *spread_of(scene, contact, line_load).nodes)
    return float(np.sqrt(np.mean(apart**2))) / contact.mean_film


def spread_of(scene, contact, line_load: float) -> Ellipse:
    """The semi-ellipse of ``line_load`` whose deflection across the strip |x| <= b has the same linear and quadratic
    Chebyshev coefficients as that of a contact's pressure, both to second order in centre/b.

    With s = x/b, -ln|s - s'| = ln 2 + sum 2/n T_n(s) t_n(s'), where t_n = T_n for |s'| <= 1, and sign(s')^n (|s'| -
    sqrt(s'² - 1))^n beyond. So the coefficients are the means m_n of t_n over the load, n = 1, 2. A semi-ellipse inside
    the strip has m1 = c/b, m2 = 2 c²/b² + a²/(2 b²) - 1. One that covers the strip has, by its parabolic deflection, m1
    = b c/a², m2 = -b²/(2 a²).
    """
    b, step = scene.bodies.half_width, contact.x[1] - contact.x[0]
    share = contact.pressure.sum(axis=1)
    s, share = contact.x / b, share / share.sum()
    beyond = np.abs(s) > 1
    near = np.where(beyond, np.sign(s) * (np.abs(s) - np.sqrt(np.maximum(s * s - 1, 0.0))), s)
    m1 = float(share @ near)
    m2 = float(share @ np.where(beyond, near**2, 2 * s * s - 1 + (step / b) ** 2 / 6)) - 2 * m1**2
    if m2 <= -0.5:
        return Ellipse(line_load, b * m1, b * (2 * (m2 + 1)) ** 0.5)
    wide = min(-0.5 / min(m2, -1e-9), WIDEST**2)
    return Ellipse(line_load, b * m1 * wide, b * wide**0.5)


def deflection(scene, x, pressure) -> np.ndarray:
    """Deflection [m] across the Hertz strip, less its mean, by a piecewise linear pressure [Pa] on nodes ``x`` [m]."""
    b = scene.bodies.half_width
    found = hat_kernel(np.linspace(-1.0, 1.0, STRIP), x / b) @ pressure * (b / scene.bodies.e_prime)
    return found - found.mean()


def _first(film, line_load: float, half_width: float) -> Ellipse:
    if film is None or film.imposed is None:
        return Ellipse(line_load, 0.0, half_width)
    imposed = film.imposed
    return Ellipse(line_load, 0.5 * float(imposed.x[0] + imposed.x[-1]), 0.5 * float(imposed.x[-1] - imposed.x[0]))


def _mixed(steps) -> Ellipse:
    """The next semi-ellipse: the mix of the last steps that, if they were linear, would leave the smallest mismatch; no
    narrower than half the last."""
    (last, apart), before = steps[-1], steps[:-1]
    if not before:
        return last
    changes = np.array([apart - b for _, b in before]).T
    weights = np.linalg.lstsq(changes, apart, rcond=1e-6)[0]
    centre = last.centre - sum(w * (last.centre - f.centre) for w, (f, _) in zip(weights, before))
    half_width = last.half_width - sum(w * (last.half_width - f.half_width) for w, (f, _) in zip(weights, before))
    return Ellipse(last.line_load, centre, max(half_width, 0.5 * last.half_width))
