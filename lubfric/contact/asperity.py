"""Load and area of all asperities at a separation, and the separation at which they carry a load."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .._base import FloatArray, increasing_root, validate, with_default_errors
from ..errors import CONVERGED, STAGNATED, InputError, Report, returned
from .asperity_find import FINDERS
from .problem import on_grid

DEFINITIONS = tuple(FINDERS)
# Approaches [-] over the height range at which the load is looked at, each 25 % longer, down to the deepest valley. A
# choice: fewer may miss a load that falls again between two of them.
TRIAL_APPROACHES = np.geomspace(1e-5, 1.0, 53)


@dataclass(frozen=True, kw_only=True)
class AsperityResult:
    """All contacts at one separation. Arrays have one entry for each contact.

    Attributes
    ----------
    separation : height of the flat [m], one number or (nx, ny)
    load : on the complete map [N]
    mean_pressure : load over the area of the map [Pa]
    contact_area : sum of pi a² [m²], and contact_area_fraction of the map [-]
    plastic_area_fraction : where the pressure is at the hardness [-]
    contacts : how many
    index : their highest grid points, (contacts, 2)
    overlap : delta [m], (contacts,)
    radii : R [m], (contacts,)
    forces : [N], (contacts,)
    report : of the search, when the load was given
    """

    separation: float | np.ndarray
    load: float
    mean_pressure: float
    contact_area: float
    contact_area_fraction: float
    plastic_area_fraction: float
    contacts: int
    index: np.ndarray
    overlap: np.ndarray
    radii: np.ndarray
    forces: np.ndarray
    report: Report | None = None


def find_asperities(
    heights: FloatArray,
    spacing: float | tuple[float, float],
    e_prime: float,
    *,
    definition: str = "summits",
    hardness: float | None = None,
    periodic: bool | tuple[bool, bool] = True,
) -> Callable[..., AsperityResult]:
    """Return the function that gives the contact of a height map at a separation, a number or (nx, ny); arguments as in
    `asperity_contact`. Summits are looked for only once."""
    heights = validate.array("heights", heights, "m", ndim=2)
    e_prime = validate.positive("e_prime", e_prime, "Pa")
    validate.choice("definition", definition, DEFINITIONS)
    if hardness is not None:
        hardness = validate.positive("hardness", hardness, "Pa")
    is_periodic = validate.pair("periodic", periodic, validate.boolean, "True or False")
    spacing = validate.spacing("spacing", spacing)
    find = FINDERS[definition](heights, spacing, is_periodic)
    map_area = heights.size * spacing[0] * spacing[1]

    def at(separation: FloatArray) -> AsperityResult:
        """Return the sums over the asperities at a ``separation`` [m] of the surfaces, one number or one for each
        cell."""
        index, overlap, radius = find(np.broadcast_to(np.asarray(separation, dtype=float), heights.shape))
        area = math.pi * radius * overlap
        force = 2 / 3 * e_prime * np.sqrt(radius) * overlap**1.5
        plastic = np.zeros(overlap.size)
        if hardness is not None:
            ratio = np.minimum(hardness * area / (1.5 * force), 1.0)  # P_u/p0
            force = np.where(ratio < 1, hardness * area * (1 - ratio**2 / 3), force)
            plastic = area * (1 - ratio**2)
        return AsperityResult(
            separation=separation,
            load=float(force.sum()),
            mean_pressure=float(force.sum() / map_area),
            contact_area=float(area.sum()),
            contact_area_fraction=float(area.sum() / map_area),
            plastic_area_fraction=float(plastic.sum() / map_area),
            contacts=overlap.size,
            index=index,
            overlap=overlap,
            radii=radius,
            forces=force,
        )

    return at


@with_default_errors
def asperity_contact(
    heights: FloatArray,
    spacing: float | tuple[float, float],
    e_prime: float,
    *,
    separation: float | FloatArray,
    definition: str = "summits",
    hardness: float | None = None,
    periodic: bool | tuple[bool, bool] = True,
) -> AsperityResult:
    """Return the contact of a rough surface with a rigid flat at a given separation, by independent Hertz contacts.

    Parameters
    ----------
    heights : (nx, ny) [m], upwards
    spacing : (dx, dy) or one length [m]
    e_prime : E' [Pa], ``2/E' = sum (1 - nu²)/E``
    separation : height of the flat [m], in the same coordinate as ``heights``; for heights about their mean it is the
        distance of the undeformed mean planes. One number, or (nx, ny) under a curved film
    definition : "summits" or "patches"
    hardness : the pressure of every contact is cut off at this value [Pa]; None: elastic
    periodic : whether neighbours wrap around, one value or one for each axis. A summit needs all 8 neighbours

    Returns
    -------
    AsperityResult

    Raises
    ------
    InputError : a value out of range

    Notes
    -----
    An overlap delta on a radius R carries ``F = (2/3) E' sqrt(R) delta^1.5`` over ``pi a² = pi R delta`` (Hertz 1882).
    A Hertz pressure of peak p0 that is cut off at P_u leaves ``F = P_u pi a² (1 - s²/3)``, ``s = P_u/p0 < 1``.
    """
    contact_at = find_asperities(heights, spacing, e_prime, definition=definition, hardness=hardness, periodic=periodic)
    separation = validate.in_plain("separation", separation, "m")
    field = on_grid("separation", separation, np.shape(heights), "m")
    return contact_at(field if np.ndim(separation) else separation)


@with_default_errors
def separation_for_load(
    heights: FloatArray,
    spacing: float | tuple[float, float],
    e_prime: float,
    *,
    mean_pressure: float,
    definition: str = "summits",
    hardness: float | None = None,
    periodic: bool = True,
    tolerance: float = 1e-3,
    raise_on_failure: bool = True,
) -> AsperityResult:
    """Return the separation at which independent asperities carry a given load.

    The flat comes down in steps, each 25 % longer than the last, at most to the deepest valley. When the load is
    reached, the last step is searched (Chandrupatla), until ``|load - target|/target <= tolerance``. The load of
    summits is continuous and falls with the separation. That of patches jumps where cells join (1e-3 suits some hundred
    contacts), and has a largest value, because patches grow together.

    Parameters
    ----------
    heights, spacing, e_prime, definition, hardness, periodic : as in `asperity_contact`
    mean_pressure : load over the area of the map [Pa]
    tolerance, raise_on_failure : relative, on the load; False returns the closest result with its report

    Returns
    -------
    AsperityResult

    Raises
    ------
    InputError : a value out of range
    ConvergenceError : the model cannot carry the load, or jumps over it; carries report and the closest result
    """
    contact_at = find_asperities(heights, spacing, e_prime, definition=definition, hardness=hardness, periodic=periodic)
    target = validate.positive("mean_pressure", mean_pressure, "Pa")
    tolerance = validate.number("tolerance", tolerance, "(-)", above=0.0, maximum=0.5)
    if np.ptp(heights) == 0:
        raise InputError("heights are all equal: no asperities; give a rough surface in m")
    best, scanned, history = _closest(contact_at, float(np.max(heights)), float(np.ptp(heights)), target, tolerance)
    error = abs(best.mean_pressure / target - 1)
    most = f"at most {best.mean_pressure:.4g} Pa, at separation {best.separation:.4g} m"
    advice = "" if history else f"{definition} cannot carry a mean pressure of {target:.4g} Pa: {most}"
    status = CONVERGED if error <= tolerance else STAGNATED
    left = {"load": error}
    steps = len(history) or scanned
    evaluations = scanned + len(history)
    report = Report(
        "asperity separation",
        status,
        iterations=steps,
        residual=error,
        tolerance=tolerance,
        residuals=left,
        history=history,
        evaluations=evaluations,
        advice=advice,
    )
    return returned(replace(best, report=report), raise_on_failure=raise_on_failure)


def _closest(
    contact_at: Callable[..., Any], top: float, span: float, target: float, tolerance: float
) -> tuple[AsperityResult, int, tuple[float, ...]]:
    """Return the `AsperityResult` whose mean pressure is closest to ``target`` [Pa], of those that are ``contact_at``
    at separations from the ``top`` down over the ``span`` of the heights [m]; the number of approaches scanned, and the
    errors of the search in the last of them; none if the asperities carry less at every approach (then: the most)."""

    def excess(approach: float, _: AsperityResult | None = None) -> tuple[float, AsperityResult]:
        result = contact_at(float(top - approach))
        return result.mean_pressure / target - 1, result

    before = 0.0
    best = excess(0.0)[1]
    for scanned, approach in enumerate(span * TRIAL_APPROACHES, start=1):
        value, result = excess(approach)
        if value >= 0:
            middle = 0.5 * (before + approach)
            step = 0.25 * (approach - before)
            bounds = (before, approach)
            root = increasing_root(excess, middle, step=step, bounds=bounds, tolerance=tolerance)
            return root.payload, scanned, root.history
        before = approach
        best = max(best, result, key=lambda at: at.load)
    return best, len(TRIAL_APPROACHES), ()
