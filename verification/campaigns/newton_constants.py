"""``python -m verification.campaigns.newton_constants [NAME ...]``: what the constants of Newton's method decide.

Every number of `MODULES` (or those whose name begins with NAME) is halved and doubled, alone, and the films of `FILMS`
are solved again. A row says by how much the counted work changes, in all and at most, by how much f changes at most,
and which films have no solution then. The work is counted from cells, factorisations and iterations, so that a loaded
machine shows the same.
"""

import importlib
import math
import sys
from collections.abc import Callable
from dataclasses import dataclass
from itertools import islice

import lubfric
from lubfric.film import LineContact
from lubfric.models.deterministic import (
    Moment,
    Problem,
    RoughBody,
    lay_out,
    moments,
    solve_point,
    travelling,
    work_of_steps,
)
from lubfric.oil import Lubricant

from .constants import Changed, constants, scaled

ROOM = "lubfric.models.deterministic"
MODULES = tuple(f"{ROOM}.{name}" for name in ("solve", "newton", "linear"))

# Factors on a constant.
FACTORS = (0.5, 2.0)

# Residual to which a film is solved [-]: that of a strip.
TOLERANCE = 3e-3

# Factorisations of a film, at most [-]: one that takes more counts as not solved.
MOST = 300

# Steps in time of the moving film, and the residual of each [-].
STEPS = 4
STEP_TOLERANCE = 5e-3

# Change of f over f below which a row reports none [-]: what the tolerance leaves.
SAME = 1e-3


@dataclass(frozen=True)
class Film:
    """What one film took: its friction ``f`` (NaN: not solved) and the counted ``work`` [s of a usual core]."""

    f: float
    work: float


def at_rest(problem: Problem, *, from_half: bool = False) -> Film:
    """Solve ``problem`` from the dry contact, or from the film at 1.5 times its speed."""
    start = solve_point(problem.at_speed(1.5 * problem.speed), tolerance=TOLERANCE).state if from_half else None
    try:
        result = solve_point(problem, start=start, tolerance=TOLERANCE, most=MOST)
    except lubfric.ConvergenceError as error:
        assert error.report is not None
        return Film(math.nan, work_of_steps(problem.heights.size, error.report.iterations, error.report.evaluations))
    report = result.report
    return Film(result.coefficient, work_of_steps(problem.heights.size, report.iterations, report.evaluations))


def in_motion(problem: Problem, body: RoughBody) -> Film:
    """Follow the roughness of ``problem``, that of ``body``, for `STEPS` from the film at rest."""
    start = solve_point(problem, tolerance=TOLERANCE).state
    step = problem.spacing[0] / problem.speed
    passing = moments(travelling(problem, [body]), step, start=start, tolerance=STEP_TOLERANCE, shift=1)
    followed: list[Moment] = []
    try:
        followed.extend(islice(passing, 1, 1 + STEPS))
    except lubfric.ConvergenceError:
        return Film(math.nan, math.nan)
    size = problem.heights.size
    work = sum(work_of_steps(size, moment.work.factorisations, moment.work.krylov) for moment in followed)
    return Film(sum(moment.result.coefficient for moment in followed) / STEPS, work)


def films() -> dict[str, Callable[[], Film]]:
    """Return the films by name: light and heavy contacts, thick and thin films, a soft one, a start nearby, motion."""
    oil = Lubricant(0.02, 1.8e-8, eyring_stress=5e6, limiting_stress_coefficient=0.06)
    fine = lubfric.generate_surface((64, 32), 4e-6, sq=150e-9, correlation_length=10e-6, acf="gaussian", seed=3)

    def heavy(speed: float) -> Problem:
        line = LineContact(load_per_width=160e3, radius=6e-3, e_prime=231e9, entrainment_speed=speed, lubricant=oil)
        return lay_out(fine, line, sliding=0.1 * speed, boundary_friction=0.12)

    plain = Lubricant(0.36, 2.5e-8)
    light_map = lubfric.generate_surface((48, 48), 3.6e-6, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=4)

    def light(load: float, speed: float) -> Problem:
        line = LineContact(load_per_width=load, radius=2e-3, e_prime=231e9, entrainment_speed=speed, lubricant=plain)
        return lay_out(light_map, line, sliding=2 * speed, boundary_friction=0.09)

    soft_oil = Lubricant(0.0475, 1.16e-8, eyring_stress=5e6)
    soft_map = lubfric.generate_surface((64, 48), 12e-6, sq=276e-9, correlation_length=48e-6, acf="gaussian", seed=2)
    soft_line = LineContact(
        load_per_width=11200.0, radius=9.4e-3, e_prime=19.2e9, entrainment_speed=2.6e-3, lubricant=soft_oil
    )
    soft = lay_out(soft_map, soft_line, sliding=5e-3, boundary_friction=0.1, hardness=1.8e8, map_coarsening=(2, 2))
    rolling = heavy(1.0)
    return {
        "light, mixed": lambda: at_rest(light(917.0, 0.03)),
        "light, thin": lambda: at_rest(light(917.0, 0.003)),
        "20 kN/m, thin": lambda: at_rest(light(18e3, 0.01)),
        "1 GPa, mixed": lambda: at_rest(heavy(0.3)),
        "1 GPa, thin": lambda: at_rest(heavy(0.03)),
        "1 GPa, from 1.5 U": lambda: at_rest(heavy(0.1), from_half=True),
        "soft, thin": lambda: at_rest(soft),
        "1 GPa, rolling": lambda: in_motion(rolling, RoughBody(fine, 0.95)),
    }


def solved() -> dict[str, Film]:
    """Return all films, solved, by name."""
    return {name: solve() for name, solve in films().items()}


def line(base: dict[str, Film], rows: dict[str, Film]) -> str:
    """Return in words what the films ``rows`` take compared with ``base``."""
    lost = [name for name, row in rows.items() if math.isnan(row.f) and not math.isnan(base[name].f)]
    ratios = {name: row.work / base[name].work - 1 for name, row in rows.items() if not math.isnan(row.work)}
    total = sum(row.work for row in rows.values() if not math.isnan(row.work))
    total /= sum(base[name].work for name in ratios)
    at = max(ratios, key=lambda name: abs(ratios[name]))
    changes = {name: row.f / base[name].f - 1 for name, row in rows.items() if not math.isnan(row.f / base[name].f)}
    moved = max(changes, key=lambda name: abs(changes[name]))
    words = f"work {100 * (total - 1):+.0f} %, at most {100 * ratios[at]:+.0f} % ({at})"
    if abs(changes[moved]) > SAME:
        words += f", f {100 * changes[moved]:+.2g} % ({moved})"
    return words + (f", not solved: {', '.join(lost)}" if lost else "")


def main() -> None:
    """Print a row for every constant and factor."""
    prefixes = tuple(sys.argv[1:]) or tuple(f"{module}." for module in MODULES)
    base = solved()
    for name, film in base.items():
        print(f"{name}: f {film.f:.5g}, work {film.work:.3g} s", flush=True)
    for module, name, value in constants(prefixes):
        if module not in MODULES:
            continue
        importlib.import_module(module)
        for factor in FACTORS:
            if value == 1 and factor < 1 and isinstance(value, int):  # half of one cell or step
                continue
            try:
                with Changed(module, name, scaled(value, factor)):
                    words = line(base, solved())
            except Exception as error:  # noqa: BLE001  # a value that nothing allows is a result here
                words = f"{type(error).__name__}: {str(error)[:60]}"
            print(f"{module.rpartition('.')[2]}.{name} = {value} x {factor}: {words}", flush=True)


if __name__ == "__main__":
    main()
