"""The differential-deflection method in time: the same banded Newton's method with a squeeze term.

Speed and load may change. The flow keeps its direction (towards +x), because the grid has one inlet. Where motion stops
or reverses, use `lubfric.time.solve_transient_ehl`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from .._base import validate
from ..errors import CONVERGED, ConvergenceError
from ..film import LineContact, Problem, cubic, smallest
from ..scene import History, checked_history
from ..time import FIRST_STEP, WET, Memory, Step, TransientFilm, checked_times, marched, plan_of, report_of
from .differential import solve_differential_deflection
from .differential_equations import NEAR, make_mesh
from .differential_newton import newton

TOLERANCE, MOST_STEPS = 1e-6, 40  # of Newton's method in a step


@dataclass(frozen=True)
class UniformSetting:
    """A contact whose load and speed change, on a uniform grid between the ends of ``domain`` [m] (a
    a solver of `lubfric.time.march`). In SI units; z holds pressures and films."""

    contact: LineContact  # as it is before t = 0
    load: History
    speed: History
    domain: tuple[float, float]
    nodes: int
    bandwidth: int

    @property
    def x(self) -> np.ndarray:
        """The nodes [m]."""
        return np.linspace(*self.domain, self.nodes)

    def problem(self, time: float) -> Problem:
        """The problem just before ``time`` [s]."""
        return Problem(
            replace(self.contact, load_per_width=self.load.before(time), entrainment_speed=self.speed.before(time))
        )

    def solve(self, time: float, memory: Memory, z: np.ndarray, payload: None = None) -> Step:
        """One implicit step (a solver of `lubfric.time.march`)."""
        problem, n = self.problem(time), self.nodes
        unit, film, pressure = problem.length_unit, problem.film_unit, problem.pressure_unit
        mesh = make_mesh(self.domain[0] / unit, self.domain[1] / unit, n, self.bandwidth, True)
        memory = Memory(memory.rate * unit / problem.contact.entrainment_speed, memory.film / film)
        found = newton(mesh, problem, z[:n] / pressure, z[n:] / film, TOLERANCE, MOST_STEPS, memory)
        stored = problem.density(found.P)[0] * found.H * film
        z = np.concatenate([found.P * pressure, found.H * film])
        return Step(status=found.status, film=stored, z=z)

    def error_of(self, solution: Step, difference: np.ndarray) -> float:
        """Root mean square of a difference of films over the pressurised film, relative to the film."""
        P = solution.z[: self.nodes]
        return math.sqrt(float(np.mean((difference / solution.film)[P > WET * P.max()] ** 2)))


def solve_differential_transient(
    *,
    load_per_width,
    entrainment_speed,
    times,
    domain: tuple[float, float],
    nodes: int = 1025,
    bandwidth: int = NEAR,
    time_tolerance: float = 1e-5,
    raise_on_failure: bool = True,
    **contact,
) -> TransientFilm:
    """Film of a smooth line contact in time by differential deflection, from the steady state before t = 0.

    Parameters
    ----------
    load_per_width, entrainment_speed : [N/m] and [m/s], numbers or histories, both > 0 at all times
    domain : first and last node [m]

    The other parameters are those of `solve_differential_deflection` (``contact``: radius, e_prime, viscosity and the
    further ones of the oil) and `solve_transient_ehl`. Each step is solved until the residuals of
    `lubfric.paper.differential_equations.measure` are <= 1e-6.

    Raises
    ------
    InputError : a value out of range, before any work
    ConvergenceError : a step failed for good; carries the films so far
    """
    times = checked_times(times)
    duration = float(times[-1])
    load = checked_history("load_per_width", load_per_width, "N/m", duration)
    speed = checked_history("entrainment_speed", entrainment_speed, "m/s", duration)
    validate.number("time_tolerance", time_tolerance, "(-)", minimum=1e-10, maximum=0.1)
    steady = solve_differential_deflection(
        load_per_width=load.before(0.0),
        entrainment_speed=speed.before(0.0),
        nodes=nodes,
        domain=domain,
        raise_on_failure=False,
        **contact,
    )
    setting = UniformSetting(steady.contact, load, speed, domain, nodes, bandwidth)
    x = setting.x
    z = np.concatenate([np.interp(x, steady.x, steady.pressure), cubic(steady.x, steady.film_thickness, x)])
    first = setting.solve(0.0, Memory(0.0, np.zeros(nodes)), z)
    if first.status != CONVERGED:
        raise ConvergenceError("differential deflection: no steady film to start from", steady.report, steady)
    result = _marched(setting, first, times, time_tolerance)
    if raise_on_failure:
        result.report.raise_if_failed(result)
    return result


def _marched(setting: UniformSetting, first: Step, times: np.ndarray, time_tolerance: float) -> TransientFilm:
    x, n = setting.x, setting.nodes
    width = math.hypot(setting.problem(0.0).half_width, 3.0) * setting.contact.length_unit
    step = FIRST_STEP * width / setting.speed.range(float(times[-1]))[1]
    plan = plan_of(times, (setting.load, setting.speed), step, time_tolerance)
    now, found, states = marched(setting, plan, first)
    P, H = (np.array([state.z[part] for state in states]).reshape(-1, n) for part in np.s_[:n, n:])
    parabola = x**2 / (2.0 * setting.contact.radius)
    return TransientFilm(
        np.array(found),
        x,
        P,
        H,
        np.array([smallest(x, h) for h in H]),
        np.array([float(cubic(x, h - parabola, np.zeros(1))[0]) for h in H]),
        np.trapezoid(P, x, axis=1) - 0.5 * x[0] * P[:, 0],  # with the tail |x|^-3
        report_of("transient by differential deflection, BDF2", plan, now, f"{n} nodes", {}),
    )
