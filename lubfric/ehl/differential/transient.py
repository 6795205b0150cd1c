"""The differential-deflection method in time: the same banded Newton with a squeeze term.

Speed and load may change; the flow keeps its direction (towards +x), because the grid has one inlet. Where
motion stops or reverses use `lubfric.ehl.transient.solve_transient_ehl`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ... import validate
from ...errors import ConvergenceError
from ...history.read import check_history, history
from ...lubricant import Lubricant
from ...report import CONVERGED, STAGNATED, Report
from ..problem import Problem
from ..result import cubic, smallest
from ..transient.bdf import Level, March, advance, restarted
from ..transient.solve import FIRST_STEP, SHORTEST, WET, TransientFilm, checked_times, stops_and_jumps
from .equations import Squeeze
from .mesh import NEAR, Mesh, make_mesh
from .newton import newton
from .solve import solve_differential_deflection


@dataclass(frozen=True)
class _Step:
    """A solved step in SI units: z holds pressures and films."""

    status: str
    z: np.ndarray
    film: np.ndarray
    payload: None = None


def solve_differential_transient(
    *,
    load_per_width,
    radius: float,
    e_prime: float,
    entrainment_speed,
    viscosity: float,
    pressure_viscosity_coefficient: float,
    times,
    domain: tuple[float, float],
    viscosity_law: str = "roelands",
    density: str = "constant",
    nodes: int = 1025,
    bandwidth: int = NEAR,
    time_tolerance: float = 1e-5,
    raise_on_failure: bool = True,
) -> TransientFilm:
    """Film of a smooth line contact in time by differential deflection, from the steady state before t = 0.

    load_per_width [N/m] and entrainment_speed [m/s] (both > 0 at all times) are numbers or histories;
    ``domain``: first and last node [m]; the rest as in `solve_differential_deflection` and
    `solve_transient_ehl`. Each step is solved until the residuals of
    `lubfric.ehl.differential.equations.measure` are <= 1e-6. Raises `InputError` before any work,
    `ConvergenceError` with the films so far when a step fails for good.
    """
    times = checked_times(times)
    load, speed = history("load_per_width", load_per_width), history("entrainment_speed", entrainment_speed)
    duration = float(times[-1])
    check_history("load_per_width", "N/m", load, duration, positive=True)
    check_history("entrainment_speed", "m/s", speed, duration, positive=True)
    validate.number("time_tolerance", time_tolerance, "(-)", minimum=1e-10, maximum=0.1)
    lubricant = Lubricant(viscosity, pressure_viscosity_coefficient, viscosity_law, density)
    start = solve_differential_deflection(
        load_per_width=load.before(0.0),
        radius=radius,
        e_prime=e_prime,
        entrainment_speed=speed.before(0.0),
        viscosity=viscosity,
        pressure_viscosity_coefficient=pressure_viscosity_coefficient,
        viscosity_law=viscosity_law,
        density=density,
        nodes=nodes,
        domain=domain,
        raise_on_failure=False,
    )
    problem = Problem(load.before(0.0), radius, e_prime, speed.before(0.0), lubricant)

    def solve(time, memory, z, _=None) -> _Step:
        now = replace(problem, load=load.before(time), speed=speed.before(time))
        return _solve(_mesh(now, domain, nodes, bandwidth), now, memory.rate, memory.film, z)

    x = np.linspace(*domain, nodes)
    z = np.concatenate([np.interp(x, start.x, start.pressure), cubic(start.x, start.film_thickness, x)])
    first = _solve(_mesh(problem, domain, nodes, bandwidth), problem, 0.0, np.zeros(nodes), z)
    if first.status != CONVERGED:
        raise ConvergenceError("differential deflection: no steady film to start from", start.report, start)
    result = _march(x, first, times, (load, speed), solve, time_tolerance, problem)
    if raise_on_failure:
        result.report.raise_if_failed(result)
    return result


def _mesh(problem: Problem, domain, nodes: int, bandwidth: int) -> Mesh:
    unit = problem.length_unit
    return make_mesh(domain[0] / unit, domain[1] / unit, nodes, bandwidth, True)


def _solve(mesh: Mesh, problem: Problem, rate: float, past: np.ndarray, z: np.ndarray) -> _Step:
    n = mesh.size
    rate = rate * problem.length_unit / problem.speed
    squeeze = Squeeze(rate, rate * past / problem.film_unit)
    found = newton(mesh, problem, z[:n] / problem.pressure_unit, z[n:] / problem.film_unit, 1e-6, 40, squeeze)
    film = problem.density(found.P)[0] * found.H * problem.film_unit
    return _Step(found.status, np.concatenate([found.P * problem.pressure_unit, found.H * problem.film_unit]), film)


def _march(x, first: _Step, times, histories, solve, tolerance, problem: Problem) -> TransientFilm:
    n, duration = x.size, float(times[-1])
    fastest = histories[1].range(duration)[1]
    opening = FIRST_STEP * math.hypot(problem.half_width, 3.0) * problem.length_unit / fastest

    def error_of(solution, difference):
        P = solution.z[:n]
        return math.sqrt(float(np.mean((difference / solution.film)[P > WET * P.max()] ** 2)))

    march = March((Level(0.0, first.film, first.z),), opening)
    outputs = [(0.0, first.z)] if times[0] == 0.0 else []
    stops, jumps = stops_and_jumps(histories, times, duration)
    count, rejected, worst, status = 0, 0, 0.0, CONVERGED
    for stop in stops:
        while march.time < stop and status == CONVERGED:
            step = advance(march, stop, solve, error_of, tolerance, SHORTEST * duration)
            if step is None:
                status = STAGNATED
                break
            march, count, rejected, worst = (
                step.march,
                count + 1,
                rejected + step.rejected,
                max(worst, step.error),
            )
            if march.time == stop and np.any(times == stop):
                outputs.append((stop, step.solution.z))
            if march.time in jumps:
                march = restarted(march, opening)
    report = Report(
        "transient by differential deflection, BDF2",
        status,
        count,
        worst,
        1.0,
        {"step": worst},
        evaluations=count + rejected,
        notes=(f"{n} nodes, {rejected} steps rejected",),
    )
    P, H = (np.array([z[part] for _, z in outputs]) for part in (slice(None, n), slice(n, None)))
    centre = [float(cubic(x, h - x**2 / (2.0 * problem.radius), np.zeros(1))[0]) for h in H]
    load = np.trapezoid(P, x, axis=1) - 0.5 * x[0] * P[:, 0]  # with the tail |x|^-3
    return TransientFilm(
        np.array([t for t, _ in outputs]),
        x,
        P,
        H,
        np.array([smallest(x, h) for h in H]),
        np.array(centre),
        load,
        report,
    )
