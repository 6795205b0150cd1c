"""The error where one patch stands for the surface: because the scene asks for it, or because a map was given."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..contact import measured, rough_bodies
from ..sharing import Balance, Solved, length_or_half, lengths_of
from .estimate import (
    AREAS,
    ORDER,
    Numerical,
    coefficient_error,
    dry_errors,
    field_errors,
    film_alone_errors,
    film_error,
    stress_error,
    uncertainty_of,
    why_not,
)
from .influence import BLOCK, LEAST_BLOCKS, BlockError
from .line_record import NOTHING, LineRecord, pooled, record
from .marginal import Marginal, marginal
from .missed import missed_share
from .response import Response, Slopes
from .sample import response_of
from .uncertainty import FieldErrors, Uncertainty, field_errors_of

NO_AREA = "contact areas need the scene's own grid here: fields=True, numerics.grid = 'given'"
UNKNOWN = "not known: {}"
PLASTIC = 3.0  # a relative change of the load or of the area on the plastic part, at most about
DOUBT = 2.0  # times the estimated error of the grid: of what is no share of f


def of_patch(
    prepared, speed: float, point: Solved, areas: dict[str, tuple[float, float]]
) -> tuple[Uncertainty, FieldErrors]:
    """Uncertainty and errors by field of a point on one patch. ``areas``: from `lubfric.sampling.patch_area`.

    If the patch is long enough for eight blocks along y, the standard error comes from these, as for a line. Of a
    mirrored map only half counts. There is no more of the surface to make.
    """
    balance = point.balance
    length = prepared.surface.size[1] / (2 if mirrored(prepared) else 1)
    correlation, why = correlation_along_y(prepared), ""
    response, gap_error, there = None, NOTHING, LineRecord(length, balance.contact_load)
    if balance.film is None:
        gap_error = BlockError(0.0, LEAST_BLOCKS)
    elif balance.contact_load > 0:
        response = _from_slope(point)
        long_enough = length >= LEAST_BLOCKS * BLOCK * correlation
        if balance.contact.fields is None:
            why = UNKNOWN.format("this contact has no places along y to compare")
        elif not long_enough:
            why = UNKNOWN.format(
                f"the patch holds {length / correlation:.2g} correlation lengths along y, an interval takes "
                f"{LEAST_BLOCKS * BLOCK:g} (numerics.sampling = 'line', or a map that is longer across the motion)"
            )
        else:
            response = response_of(prepared, speed, point.contact, balance)
            grid = point.contact.grid
            assert grid is not None  # of half-spaces: it has fields
            rows = grid.cells[1] // (2 if mirrored(prepared) else 1)
            there = record(
                point.contact, balance.contact, balance.contact_load, response.slopes, correlation, rows=slice(0, rows)
            )
            gap_error = there.gap
    return _told(prepared, point, response, gap_error, there, why, areas)


def _told(prepared, point: Solved, response, gap_error, there, why, areas):
    scene, balance = prepared.scene, point.balance
    found = balance.forces
    numerical, left = _numerical(prepared, point, response)
    relative, together = coefficient_error(numerical, found, response), pooled([there])
    known: dict[str, float] = {}
    if response is not None:
        finite = gap_error if math.isfinite(gap_error.error) else BlockError(0.0, 1)
        doubtful = replace(numerical, gap=DOUBT * numerical.gap)
        known = field_errors(balance, doubtful, finite, together, response)
        sampling = response.relative("coefficient", gap_error.error) if not why else math.nan
        if not math.isfinite(known.get(AREAS[0], math.nan)) and point.decision.grid_error is None:
            read = balance.contact.area_error / max(balance.contact.real_contact_area_fraction, 1e-300)
            known |= dict.fromkeys(AREAS, math.hypot(known["contact_load"], left.area, read))
            if balance.contact.plastic_area_fraction > 0:
                known["plastic_area_fraction"] = PLASTIC * math.hypot(known["contact_load"], read)
        known |= {name: math.hypot(known["contact_load"], error) for name, (_, error) in areas.items()}
        known |= {name: known.get(name, 0.0) + error for name, error in left.errors(found.shear).items()}
    elif balance.film is None:
        sampling, known = 0.0, dry_errors(together)
    else:
        sampling = missed_share(prepared, balance.film, found, correlation_along_y(prepared))
        known = film_alone_errors(film_error(point), found)
        gap_error, why = BlockError(0.0, ORDER), ""
        if not math.isfinite(sampling):
            why = UNKNOWN.format("the patch is too short along y to tell what contact it misses")
    uncertainty = uncertainty_of(
        found.coefficient, relative, sampling, gap_error, together, scene, notes=(why,) if why else ()
    )
    known["coefficient"] = relative if not math.isfinite(sampling) else math.hypot(relative, sampling)
    return uncertainty, field_errors_of(known, NO_AREA if point.decision.grid_error is not None else why_not(point))


def _numerical(prepared, point: Solved, response: Response | None) -> tuple[Numerical, Marginal]:
    """Errors of f by the grid, turned into errors of the gap. The same response turns them back. An interpolated area,
    and cells that these errors may open or close, count by the film's shear stress there."""
    balance, decision = point.balance, point.decision
    if response is None:
        return Numerical(film_error(point), 0.0, stress_error(balance.forces), 0.0), Marginal()
    film, volume = film_error(point), 2 * abs(balance.contact.volume_residual) * balance.contact.mean_film
    per_gap = response.per_gap("coefficient")
    grid = decision.grid_error / per_gap if decision.grid_error and per_gap > 0 else 0.0
    gap = volume + grid + balance.contact.gap_error
    left, total = marginal(prepared, point, gap + film * balance.contact.mean_film), abs(_friction(balance))
    shear = stress_error(balance.forces) + _by_area(balance) + ((left.couette + left.rolling) / total if total else 0.0)
    area = left.area if decision.grid_error is None else math.nan
    return Numerical(film, gap, shear, area, decision.deflection_left_out), left


def _by_area(balance: Balance) -> float:
    """Relative error of f by the error of an interpolated contact area, beside which the film is sheared."""
    error, total = balance.contact.area_error, abs(_friction(balance))
    if not error or not total:
        return 0.0
    open_ = max(1 - balance.contact.real_contact_area_fraction, error)
    return error / open_ * balance.forces.shear.felt / total


def _friction(balance: Balance) -> float:
    return balance.forces.boundary + balance.forces.shear.total


def _from_slope(point: Solved) -> Response:
    """The `Response` from the slope of the balance alone, without a solve. Films are taken to follow the load as rigid
    ones do, which is more than elastic ones do. f follows by its sensitivity to the gap (`Forces`)."""
    balance = point.balance
    film, total = balance.contact.mean_film, balance.contact_load + balance.film_load
    slope = balance.slope or 0.5 * balance.contact_load * balance.film_load / total**2
    split = -0.5 / (slope * film)
    share = balance.contact_load / total
    rates = {
        "coefficient": balance.gap_sensitivity / abs(split * film),
        "contact_load": share - 1,
        "boundary_force": share - 1,
        "film_load": share,
    }
    films = ("min_film", "central_film", "mean_gap", "shear_force", "couette_force", "rolling_force")
    return Response(Slopes(0.0, 0.0, 0.0), split, rates | dict.fromkeys(films, share))


def mirrored(prepared) -> bool:
    heights = prepared.surface.heights
    return (
        heights.shape[1] > 1
        and bool(np.array_equal(heights[:, :2], heights[:, :-3:-1]))
        and bool(np.array_equal(heights, heights[:, ::-1]))
    )


def correlation_along_y(prepared) -> float:
    """Correlation length [m] at 1/e: that of the scene, or of the map itself."""
    if prepared.lines is not None:
        return prepared.lines.lengths[1]
    scene = prepared.scene
    if not measured(scene) and not prepared.given:
        return max(lengths_of(rough)[1] for rough, _ in rough_bodies(scene))
    return length_or_half(prepared.surface, 1)
