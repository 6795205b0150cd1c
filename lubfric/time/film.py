"""`solve_transient_ehl`: the smooth line contact in time, where the film carries the total load."""

from dataclasses import dataclass

import numpy as np

from .._base import FloatArray, validate
from ..errors import CONVERGED, ConvergenceError, InputError, Report, returned
from ..film import smallest
from ..oil import Lubricant
from ..scene import Harmonic, Ramp, Table, checked_history
from .film_setting import NODE_FACTORS, TIME_SHARE, LineHistory, Setting, make_setting, steady_start
from .march import Plan, Residual, Step, checked_times, grid_residual, initial_progress, plan_of, report_of, steps


@dataclass(frozen=True, kw_only=True)
class TransientFilm:
    """Film over time, in SI units.

    Attributes
    ----------
    time, x : (nt,) [s], (nx,) [m]
    pressure, film_thickness : (nt, nx) [Pa], [m]
    min_film, central_film : (nt,) [m] the smallest film, and the film at x = 0
    load : (nt,) [N/m] what the film carries, with the tails of the inlet
    """

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
    load_per_width: float | Harmonic,
    radius: float | Ramp,
    e_prime: float,
    entrainment_speed: float | Table,
    viscosity: float,
    times: FloatArray | list[float],
    pressure_viscosity_coefficient: float = 0.0,
    viscosity_law: str = "roelands",
    density_law: str = "constant",
    initial_film: float | None = None,
    inlet_length: float | None = None,
    tolerance: float = 1e-3,
    time_tolerance: float | None = None,
    first_step: float | None = None,
    raise_on_failure: bool = True,
) -> TransientFilm:
    """Solve the film of a smooth line contact whose load, radius, speed or viscosity change in time.

    Parameters
    ----------
    load_per_width, radius, viscosity : [N/m], [m], [Pa s], all > 0; numbers or histories (`lubfric.scene`)
    entrainment_speed : [m/s], any sign, also 0; a number or a history
    e_prime [Pa], pressure_viscosity_coefficient [1/Pa], viscosity_law, density_law : see `lubfric.Lubricant`
    times : output times [s], increasing, the first >= 0; a step ends at each
    inlet_length : distance [m] upstream at which the lubricant begins, with p = 0 there; None: fully flooded
    initial_film : start at t = 0 from the undeformed parabola at this height [m], full of lubricant without pressure;
        None: from the steady state of the values before t = 0
    tolerance, time_tolerance : relative error of the film by the grid, 1e-5 to 0.1, and in a step (None: 1 % of it)
    first_step : [s] after the start and every jump (None: 1e-3 of a passage of the contact)

    ``report.residuals``: the largest accepted local error ("step") and the error of the grid at the steady start
    ("grid"), each over its tolerance. Raises `InputError` before any work, and `ConvergenceError` with the films so far
    when the shortest step fails or there is no accurate steady start. Equations: `lubfric.time.film_equations`.
    """
    times = checked_times(times)
    tolerance = validate.number("tolerance", tolerance, "(-)", minimum=1e-5, maximum=0.1)
    time_tolerance = TIME_SHARE * tolerance if time_tolerance is None else time_tolerance
    validate.number("time_tolerance", time_tolerance, "(-)", minimum=1e-10, maximum=0.1)
    for name, given, unit in (("first_step", first_step, "s"), ("initial_film", initial_film, "m")):
        if given is not None:
            validate.positive(name, given, unit)
    duration = float(times[-1])
    eta = checked_history("viscosity", viscosity, "Pa s", duration)
    line_history = LineHistory(
        load=checked_history("load_per_width", load_per_width, "N/m", duration),
        radius=checked_history("radius", radius, "m", duration),
        e_prime=validate.positive("e_prime", e_prime, "Pa"),
        speed=checked_history("entrainment_speed", entrainment_speed, "m/s", duration, positive=False),
        viscosity=eta,
        lubricant=Lubricant(
            eta.at(0.0),
            pressure_viscosity_coefficient,
            viscosity_law=viscosity_law,
            density_law=density_law,
            inlet_length=inlet_length,
        ),
        duration=duration,
        initial_film=initial_film,
    )
    setting, start, residuals = _start(line_history, tolerance)
    changing = line_history.speed, line_history.load, line_history.radius, line_history.viscosity
    plan = plan_of(times, changing, first_step or setting.first_step, time_tolerance)
    result = _marched(setting, start, plan, residuals)
    return returned(result, raise_on_failure=raise_on_failure)


def _start(line_history: LineHistory, tolerance: float) -> tuple[Setting, Step, dict[str, Residual]]:
    """Return the setting, state at t = 0 and residual of its grid. The grid is refined until a steady start meets the
    tolerance."""
    if line_history.initial_film is not None:
        setting = make_setting(line_history, tolerance)
        return setting, setting.undeformed(line_history.initial_film), {}
    if line_history.speed.before(0.0) == 0.0:
        message = " = 0 m/s before t = 0 carries no steady film"
        raise InputError(message, "entrainment_speed", recommendation="give initial_film > 0 m, or a speed")
    for finer in NODE_FACTORS:
        setting = make_setting(line_history, tolerance, finer=finer)
        start, error = steady_start(setting)
        if error <= tolerance:
            break
    if start.status != CONVERGED:
        raise ConvergenceError("transient: no steady film on the grid of the run to start from")
    return setting, start, {"grid": grid_residual(error / tolerance)}


def _marched(setting: Setting, start: Step, plan: Plan, residuals: dict[str, Residual]) -> TransientFilm:
    now = initial_progress(start, plan)
    outputs = [(0.0, start.terms)] if plan.times[0] == 0.0 else []
    for now in steps(setting, plan, now):
        if now.at_output:
            outputs.append((now.time, now.solution.terms))
    p = setting.problem
    x = setting.grid.x
    H, P = (np.array([getattr(terms, name) for _, terms in outputs]).reshape(-1, x.size) for name in "HP")
    return TransientFilm(
        time=np.array([time for time, _ in outputs]),
        x=x * p.length_unit,
        pressure=P * p.pressure_unit,
        film_thickness=H * p.film_unit,
        min_film=np.array([smallest(x, h) for h in H]) * p.film_unit,
        central_film=H[:, x.size // 2] * p.film_unit,
        load=np.array([terms.carried for _, terms in outputs]) * setting.load_unit,
        report=report_of("transient line-contact EHL, BDF2", plan, now, f"{setting.grid.n} cells", residuals),
    )
