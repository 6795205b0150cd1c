"""Curves of a study between their points."""

from __future__ import annotations

import numpy as np

from .. import validate
from ..curve.interpolate import Interpolant, Samples, knee_of
from .adaptive import FEWEST
from .table_row import CLEARANCE, SPEED


def coefficient_at(result, speed) -> np.ndarray:
    """See `StudyResult.at`."""
    speeds = validate.array("speed", np.atleast_1d(speed), "m/s", ndim=1)
    found = np.full((*result.status.shape[:-1], speeds.size), np.nan)
    for index in np.ndindex(*found.shape[:-1]):
        curve = curve_of(result, index)
        if curve is not None:
            known, at = curve.samples.speed, np.abs(speeds)
            inside = (at >= known[0] * (1 - 1e-9)) & (at <= known[-1] * (1 + 1e-9))
            found[index][inside] = curve.at(at[inside])
    return found[..., 0] if np.ndim(speed) == 0 else found


def lift_offs(result) -> np.ndarray:
    """See `StudyResult.lift_off`."""
    found = np.full(result.status.shape[:-1], np.nan)
    for index in np.ndindex(*found.shape):
        curve = curve_of(result, index)
        if curve is not None and curve.lift_off is not None:
            found[index] = curve.lift_off
    return found


def curve_of(result, index) -> Interpolant | None:
    """The curve at one position along the axes, or None where fewer than three of its points are solved."""
    columns = {name: values[index] for name, values in result.columns.items()}
    speed = np.abs(columns[SPEED] if result.chosen else result.coords[SPEED][1])
    good = np.flatnonzero(np.isfinite(columns["coefficient"]) & (speed > 0))
    good = good[np.argsort(speed[good])]
    if good.size < FEWEST or np.unique(speed[good]).size < good.size:
        return None
    part = {name: values[good] for name, values in columns.items()}
    total = part["contact_load"] + part["film_load"]
    boundary = part["boundary_force"] / total
    found = Samples(
        speed=speed[good],
        share=part["contact_load"] / total,
        boundary=boundary,
        film=part["coefficient"] - boundary,
        thickness=part["film_to_roughness_ratio"],
        clearance=part[CLEARANCE],
    )
    return Interpolant(found, knee_of(found))
