"""From the error of a gap to `Uncertainty` and to the errors of all reported quantities."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..sharing import Balance, Forces, Solved
from .grid_pair import gap_left, mean_of, second_order
from .influence import BlockError
from .line_record import Pooled
from .response import Response
from .uncertainty import FEW, FieldErrors, Uncertainty, field_errors_of, interval, percent, too_few

FILMS = ("min_film", "central_film", "mean_gap", "film_to_roughness_ratio")
SHEAR = ("shear_force", "couette_force", "rolling_force")
HEAT = ("inlet_film_factor", "flash_temperature_rise", "film_temperature_rise")
AREAS = ("real_contact_area_fraction", "real_contact_area")
ORDER = 30  # degrees of freedom given to an error that is not counted from blocks


@dataclass(frozen=True)
class Numerical:
    """The errors of solvers and grids.

    - ``film``: of the film, relative.
    - ``gap``: of the mean gap at given load [m], by the closing of the volume and by the grid of the contact.
    - ``shear``: of the film's shear stress, by its sum and by the heat left out of it, relative to f.
    - ``area``: of the contact area, relative (NaN: not known).
    - ``deflection``: of the film, relative, by the choice of the pressure that deflects it.
    """

    film: float
    gap: float
    shear: float
    area: float
    deflection: float = 0.0


def numerical_errors(point: Solved, volume_residual: float, grid_gap: float, area: float) -> Numerical:
    """The `Numerical` errors of a balance that is closed to ``volume_residual``.

    ``grid_gap`` [m]: how much the contact grid may still change the mean gap; ``area``: relative error of the contact
    area.
    """
    balance = point.balance
    volume = 2 * abs(volume_residual) * balance.contact.mean_film if balance.contact_load > 0 else 0.0
    left_out = point.decision.deflection_left_out
    return Numerical(film_error(point), volume + grid_gap, stress_error(balance.forces), area, left_out)


def film_error(point: Solved) -> float:
    """Estimated relative error of the film: by what its level leaves out, and by its grid."""
    film = point.balance.film
    if film is None:
        return 0.0
    residuals = film.report.residuals
    return max(residuals.get("discretisation", 0.0), residuals.get("domain", 0.0)) + point.decision.left_out.total


def stress_error(found: Forces) -> float:
    """Estimated relative error of f by the film's shear stress: its sum over nodes, and the heat left out of it."""
    return found.quadrature + found.heat.left_out


def coefficient_error(numerical: Numerical, found: Forces, response: Response | None) -> float:
    """Estimated relative error of f by solvers and grids: the sum of its parts, as if all had the same sign."""
    gap = response.relative("coefficient", numerical.gap) if response is not None else 0.0
    return found.sensitivity * (numerical.film + numerical.deflection) + gap + numerical.shear


def field_errors(balance: Balance, numerical: Numerical, gap_error: BlockError, together: Pooled, response):
    """Relative errors where there is contact, by the names of `FrictionResult`: the root of the sum of squares of the
    standard error by the surface and the estimated error by solvers and grids.

    An error of the gap changes the division of the load, and everything with it (`Response.rates`). Films also have the
    error of the film solve. Their deflection by another pressure changes the mean gap only by the load of the contact,
    about in proportion. The area also has the scatter of its blocks at given load, and what its grid may change.
    """
    film, mean_film = numerical.film + numerical.deflection, balance.contact.mean_film
    own = math.hypot(gap_error.error, numerical.gap + numerical.film * mean_film)
    gap = math.hypot(gap_error.error, numerical.gap + film * mean_film)
    errors = {name: response.relative(name, gap) for name in response.rates or ()}
    errors["film_to_roughness_ratio"] = errors.get("central_film", 0.0)
    for name in FILMS:
        errors[name] = errors.get(name, 0.0) + film
    if numerical.deflection:
        by_load = errors.get("contact_load", 0.0) - response.relative("contact_load", own)
        errors["mean_gap"] = response.relative("mean_gap", own) + numerical.film + by_load
    for name in HEAT:
        errors[name] = errors.get(name, 0.0) + numerical.film
    for name, of_sums in shear_errors(balance.forces, film).items():
        errors[name] = errors.get(name, 0.0) + of_sums
    load = balance.contact_load / together.contact_load if together.contact_load else 0.0
    for name, value, error, slope in (
        (AREAS[0], together.area_fraction, together.area.error, response.slopes.area),
        (AREAS[1], together.touched_length, together.touched.error, response.slopes.touched),
    ):
        if value == 0:
            errors[name] = math.nan
            continue
        by_load = slope * load * together.contact_load / value * errors.get("contact_load", 0.0)
        errors[name] = math.hypot(by_load, error / value, numerical.area)
    if together.plastic_fraction > 0:  # a count of spots
        changed = balance.contact.plastic_area_fraction / together.plastic_fraction - 1
        errors["plastic_area_fraction"] = math.hypot(together.participation**-0.5, changed)
    return errors


def dry_errors(together: Pooled) -> dict[str, float]:
    """Errors without entrainment: the contact carries the whole load, so only the areas scatter."""
    pairs = ((together.area_fraction, together.area.error), (together.touched_length, together.touched.error))
    areas = {name: error / value if value > 0 else math.nan for name, (value, error) in zip(AREAS, pairs)}
    return areas | dict.fromkeys(("contact_load", "film_load", "boundary_force", *SHEAR), 0.0)


def film_alone_errors(film: float, found: Forces) -> dict[str, float]:
    """Errors without contact: everything depends on the film, whose relative error is ``film``."""
    return dict.fromkeys((*FILMS, *HEAT), film) | shear_errors(found, film) | {"film_load": 0.0}


def shear_errors(found: Forces, film: float) -> dict[str, float]:
    """Relative errors of the film's friction and its parts, by the relative error ``film`` of the film and by the sums
    over its nodes. The rolling part is a small difference of large numbers, so its error is large."""
    shear = found.shear
    rolling = film * max(abs(shear.rolling), shear.rolling_parts)
    parts = {
        "shear_force": (shear.total, film * abs(shear.couette) + rolling),
        "couette_force": (shear.couette, film * abs(shear.couette)),
        "rolling_force": (shear.rolling, rolling),
    }
    heat = found.heat.left_out * abs(found.boundary + shear.total)
    cold = {"shear_force": heat, "couette_force": heat, "rolling_force": 0.0}
    sums = shear.quadrature
    return {n: (error + sums + cold[n]) / abs(value) if value else 0.0 for n, (value, error) in parts.items()}


def uncertainty_of(
    coefficient: float,
    numerical: float,
    sampling: float,
    error: BlockError,
    together: Pooled,
    scene,
    area_needed=1.0,
    notes=(),
) -> Uncertainty:
    """`Uncertainty` of f from its relative errors. ``error`` gives the degrees of freedom; its text begins with
    ``notes``."""
    asked, notes = scene.numerics.sampling_tolerance, [*notes]
    if sampling > asked and area_needed > 1:
        times = float(f"{area_needed:.2g}")
        notes.append(f"the map ends before the {percent(asked)} asked: that would take about {times:g} times its area")
    elif sampling > asked:
        notes.append(f"more than the {percent(asked)} asked")
    if too_few(together.participation, sampling, asked):
        notes.append(
            f"few spots carry the load (participation {together.participation:.2g}, below {FEW:g}): the interval "
            "is too narrow more often than it says"
        )
    width = scene.bodies.width
    return Uncertainty(
        numerical=numerical,
        sampling=sampling,
        interval=interval(coefficient, numerical, sampling, error.freedom),
        line_scatter=sampling * math.sqrt(together.length / width),
        participation=together.participation,
        length=together.length,
        freedom=float(error.freedom),
        tolerance=asked,
        area_needed=area_needed,
        notes=tuple(notes),
    )


def of_line(scene, line) -> tuple[Uncertainty, FieldErrors]:
    """Uncertainty and errors by field of a `LineFound`."""
    found = line.point.balance.forces
    rest = gap_left(line.grid) + line.unshared
    if line.response is not None:
        rest += second_order(line.grid, line.response.split)
    area = mean_of(line.grid, "area_left", 0.0) / math.sqrt(max(len(line.grid), 1))
    numerical = numerical_errors(line.point, line.first.contact.volume_residual, rest, area)
    relative = coefficient_error(numerical, found, line.response)
    if line.response is None:  # separated
        sampling = line.missed
        error, errors = BlockError(0.0, ORDER), film_alone_errors(numerical.film, found)
    elif not line.response.rates:
        sampling, error, errors = 0.0, BlockError(0.0, ORDER), dry_errors(line.together)
    else:
        sampling, error = line.response.relative("coefficient", line.gap_error.error), line.gap_error
        errors = field_errors(line.point.balance, numerical, error, line.together, line.response)
    notes: tuple[str, ...] = ()
    if not math.isfinite(sampling):
        sampling, notes = math.nan, ("the map is too short along y, or holds too few windows, for a standard error",)
    needed = (sampling / scene.numerics.sampling_tolerance) ** 2 if line.map_ends else 1.0
    needed = 1.0 if needed < 1 else needed  # NaN where the error is not known
    known = uncertainty_of(found.coefficient, relative, sampling, error, line.together, scene, needed, notes)
    return known, field_errors_of(errors | {"coefficient": math.hypot(relative, sampling)}, why_not(line.point))


def why_not(point: Solved) -> str:
    """Why the error of a quantity is not told."""
    if point.balance.film is None:
        return "no entrainment: there is no film"
    if point.balance.contact_load == 0:
        return "no contact was met: it has no relative error"
    return "there was none of it, or too little to tell"
