"""`solve_transient_ehl`: the smooth line contact in time, the film carrying the whole load."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ... import validate
from ...errors import ConvergenceError, InputError
from ...history.read import check_history, history
from ...lubricant import Lubricant
from ...report import CONVERGED, ITERATION_LIMIT, STAGNATED, Report
from ..result import smallest
from .active_set import solve_step
from .bdf import March, advance, restarted
from .setting import (
    FINER,
    LineContact,
    Setting,
    discretisation,
    make_setting,
    parabola,
    steady_start,
)
from .squeeze import Memory

FIRST_STEP = 1e-3  # of the time in which the surfaces pass the contact, after a start or a jump
SHORTEST = 1e-11  # of the duration: below it a step has failed for good
WET = 1e-3  # of the largest pressure: where the error of the film counts
TIME_SHARE = 0.01  # of the tolerance: default for the local error of a step


@dataclass(frozen=True)
class TransientFilm:
    """Film over time, SI units: time (nt,), x (nx,), pressure and film_thickness (nt, nx); min_film,
    central_film (nt,): smallest film and film at x = 0; load (nt,) [N/m]: what the film carries, with the
    inlet tails."""

    time: np.ndarray
    x: np.ndarray
    pressure: np.ndarray
    film_thickness: np.ndarray
    min_film: np.ndarray
    central_film: np.ndarray
    load: np.ndarray
    report: Report


def solve_transient_ehl(
    *,
    load_per_width,
    radius,
    e_prime: float,
    entrainment_speed,
    viscosity,
    times,
    pressure_viscosity_coefficient: float = 0.0,
    viscosity_law: str = "roelands",
    density: str = "constant",
    initial_film: float | None = None,
    tolerance: float = 1e-3,
    time_tolerance: float | None = None,
    first_step: float | None = None,
    raise_on_failure: bool = True,
) -> TransientFilm:
    """Film of a smooth line contact whose load, radius, speed or viscosity change in time.

    Parameters
    ----------
    load_per_width [N/m], radius [m], viscosity [Pa s] (all > 0), entrainment_speed [m/s] (any sign, also
        0): numbers or histories (`lubfric.history`)
    e_prime [Pa]; pressure_viscosity_coefficient [1/Pa]; viscosity_law, density : see
    `lubfric.lubricant.Lubricant`
    times : output times [s], increasing, the first >= 0; a step ends at each
    initial_film : start at t = 0 from the undeformed parabola at this height [m], full of lubricant
        without pressure; None: from the steady state of the values before t = 0
    tolerance : asked of the grid, relative to the film; 1e-5 to 0.1
    time_tolerance : largest local error of the film in a step, relative (None: 0.01 x tolerance)
    first_step : [s] after the start and every jump (None: 1e-3 of a passage of the contact)

    Equations, cavitation and residuals: `squeeze` and `active_set` beside this module; time: `bdf`.
    report.residuals: "step", the largest accepted local error, and "grid", the grid error of the smallest and
    central film of the steady start (where there is one), each over its tolerance.

    Raises `InputError` before any work, `ConvergenceError` with the films so far when the shortest step
    fails or the steady start is not found or not accurate enough.
    """
    times = checked_times(times)
    tolerance = validate.number("tolerance", tolerance, "(-)", minimum=1e-5, maximum=0.1)
    time_tolerance = (
        TIME_SHARE * tolerance
        if time_tolerance is None
        else validate.number("time_tolerance", time_tolerance, "(-)", minimum=1e-10, maximum=0.1)
    )
    given = {
        "load_per_width": (load_per_width, "N/m"),
        "radius": (radius, "m"),
        "entrainment_speed": (entrainment_speed, "m/s"),
        "viscosity": (viscosity, "Pa s"),
    }
    found = {name: history(name, value) for name, (value, _) in given.items()}
    for name, (_, unit) in given.items():
        check_history(name, unit, found[name], float(times[-1]), positive=name != "entrainment_speed")
    speed = found["entrainment_speed"]
    if initial_film is not None:
        validate.positive("initial_film", initial_film, "m")
    elif speed.before(0.0) == 0.0:
        raise InputError(
            "entrainment_speed = 0 m/s before t = 0 carries no steady film; allowed: initial_film > 0 m, or a speed"
        )
    lubricant = Lubricant(found["viscosity"].at(0.0), pressure_viscosity_coefficient, viscosity_law, density)
    contact = LineContact(
        found["load_per_width"],
        found["radius"],
        validate.positive("e_prime", e_prime, "Pa"),
        speed,
        found["viscosity"],
        lubricant,
        float(times[-1]),
        initial_film,
    )
    setting, start, grid_error = _start(contact, tolerance)
    result = _run(setting, start, grid_error / tolerance, times, time_tolerance, first_step or default_step(setting))
    if raise_on_failure:
        result.report.raise_if_failed(result)
    return result


def default_step(setting: Setting) -> float:
    """The step [s] after a start or a jump."""
    contact = setting.contact
    fastest = max(abs(u) for u in contact.speed.range(contact.duration))
    width = math.hypot(setting.problem.half_width, 3.0) * setting.problem.length_unit
    return FIRST_STEP * (min(width / fastest, contact.duration) if fastest else contact.duration)


def film_error(setting: Setting, solution, difference: np.ndarray) -> float:
    """Root mean square over the pressurised film of a difference of films, relative to the film."""
    P = solution.terms.P
    weights = setting.grid.weights * (P > WET * P.max())
    return math.sqrt(float(weights @ (difference / solution.film) ** 2 / max(weights.sum(), 1e-300)))


def stops_and_jumps(histories, times, duration: float) -> tuple[list[float], set[float]]:
    """Where steps end, and which of these are jumps."""
    jumps = {t for h in histories for t in h.jumps(duration)}
    return sorted({*times, *jumps, *(t for h in histories for t in h.stops(duration))}), jumps


def checked_times(times) -> np.ndarray:
    times = validate.array("times", times, "s", ndim=1)
    if times[0] < 0.0 or np.any(np.diff(times) <= 0.0) or times[-1] <= 0.0:
        raise InputError("times must increase from 0 s or later to a time above 0 s; allowed: 0 <= t1 < t2 < ... in s")
    return times


def _run(setting: Setting, start, grid, times, time_tolerance, first_step) -> TransientFilm:
    contact, duration = setting.contact, float(times[-1])
    outputs = [(0.0, start)] if times[0] == 0.0 else []
    march = March((setting.level(0.0, start),), first_step)
    stops, jumps = stops_and_jumps((contact.speed, contact.load, contact.radius, contact.viscosity), times, duration)
    count, rejected, worst, status = 0, 0, 0.0, CONVERGED

    def solve(time, memory, z, _):
        return setting.step(time, memory, z)

    def error_of(solution, difference):
        return film_error(setting, solution, difference)

    for stop in stops:
        while march.time < stop and status == CONVERGED:
            step = advance(march, stop, solve, error_of, time_tolerance, SHORTEST * duration)
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
                outputs.append((stop, step.solution))
            if march.time in jumps:
                march = restarted(march, first_step)
    residuals = {"step": worst} | ({} if math.isnan(grid) else {"grid": grid})
    if status == CONVERGED and max(residuals.values()) > 1.0:
        status = ITERATION_LIMIT
    notes = (
        f"{setting.grid.n} cells, {rejected} steps rejected",
        *((f"stopped at t = {march.time:.6g} s: the shortest step failed",) if status != CONVERGED else ()),
    )
    report = Report(
        "transient line-contact EHL, BDF2",
        status,
        count,
        max(residuals.values()),
        1.0,
        residuals,
        evaluations=count + rejected,
        notes=notes,
    )
    return _collect(setting, outputs, report)


def _start(contact: LineContact, tolerance: float):
    """(setting, state at t = 0, grid error), the grid refined until a steady start is as accurate as
    asked."""
    if contact.initial_film is not None:
        setting = make_setting(contact, tolerance)
        grid = setting.grid
        return (
            setting,
            solve_step(
                grid,
                setting.problem,
                setting.conditions(0.0),
                Memory(0.0, np.zeros(grid.n + 1)),
                parabola(setting, contact.initial_film),
                max_steps=0,
            ),
            math.nan,
        )
    for finer in FINER:
        setting = make_setting(contact, tolerance, finer=finer)
        start = steady_start(setting)
        if start.status == CONVERGED:
            error = discretisation(setting, start)
            if error <= tolerance or finer == FINER[-1]:
                return setting, start, error
    raise ConvergenceError("transient: no steady film on the grid of the run to start from")


def _collect(setting: Setting, outputs, report: Report) -> TransientFilm:
    p, x = setting.problem, setting.grid.x
    H = np.array([s.terms.H for _, s in outputs]).reshape(-1, x.size)
    P = np.array([s.terms.P for _, s in outputs]).reshape(-1, x.size)
    return TransientFilm(
        np.array([t for t, _ in outputs]),
        x * p.length_unit,
        P * p.pressure_unit,
        H * p.film_unit,
        np.array([smallest(x, h) for h in H]) * p.film_unit,
        H[:, x.size // 2] * p.film_unit,
        np.array([s.terms.carried for _, s in outputs]) * p.e_prime * p.film_unit,
        report,
    )
