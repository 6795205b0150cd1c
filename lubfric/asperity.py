"""The deterministic asperity model: every asperity an independent Hertz contact with a rigid flat.

The yardstick of Akchurin et al. 2015, Sec. 3.1 (doi:10.1007/s11249-015-0536-z), which leaves open what an
asperity is. Two definitions are in use and both are here:

- "summits": points higher than their 8 neighbours; 1/R is the mean of the two second differences
  at the point (J. A. Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295 (1966) 300-319,
  doi:10.1098/rspa.1966.0242; summit count as P. R. Nayak, J. Lubr. Technol. 93 (1971) 398-407,
  doi:10.1115/1.3451608).
- "patches": 8-connected regions above the separation, each replaced by the paraboloid of the same base
  area A and height delta, R = A/(2 pi delta) (M. A. Masen, M. B. de Rooij, D. J. Schipper, Wear 258 (2005)
  339).

Asperities do not interact: the load of one does not depend on where the others are. Valid for sparse, small
contacts (delta << R); summits depend on the grid wherever the surface has no second derivative.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from . import validate
from .asperity_definitions import FINDERS
from .errors import ConvergenceError, InputError
from .report import CONVERGED, STAGNATED, Report
from .roots import increasing_root

DEFINITIONS = tuple(FINDERS)
SCAN = 1.25  # ratio between neighbouring approaches of the scan for a load
SCAN_RANGE = (1e-5, 1.0)  # of the height range: down to the deepest valley


@dataclass(frozen=True)
class AsperityResult:
    """All contacts at one separation. Arrays have one entry for each contact.

    Attributes
    ----------
    separation : height of the flat [m], one number or (nx, ny)
    load : on the whole map [N]
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

    definition: str
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


def asperity_contact(
    heights, spacing, e_prime, *, separation, definition="summits", hardness=None, periodic=True
) -> AsperityResult:
    """Contact of a rough surface with a rigid flat at a given separation, by independent Hertz contacts.

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
    heights, spacing, periodic = _checked(heights, spacing, e_prime, definition, hardness, periodic)
    try:
        flat = np.broadcast_to(np.asarray(separation, dtype=float), heights.shape)
    except (TypeError, ValueError):
        raise InputError(f"separation must be a number or an array of shape {heights.shape} in m") from None
    validate.array("separation", flat, "m", ndim=2)
    find = FINDERS[definition](heights, spacing, periodic)
    return _loaded(find, flat, separation, spacing, e_prime, hardness, definition)


def contact_law(heights, spacing, e_prime, *, definition="summits", hardness=None, periodic=True):
    """separation [m] -> `AsperityResult`, as `asperity_contact`, with the summits looked for only once."""
    heights, spacing, periodic = _checked(heights, spacing, e_prime, definition, hardness, periodic)
    find = FINDERS[definition](heights, spacing, periodic)

    def at(separation):
        flat = np.broadcast_to(np.asarray(separation, dtype=float), heights.shape)
        return _loaded(find, flat, separation, spacing, e_prime, hardness, definition)

    return at


def separation_for_load(
    heights,
    spacing,
    e_prime,
    *,
    mean_pressure,
    definition="summits",
    hardness=None,
    periodic=True,
    tolerance=1e-3,
    raise_on_failure=True,
) -> AsperityResult:
    """The separation at which independent asperities carry a given load.

    Parameters
    ----------
    heights, spacing, e_prime, definition, hardness, periodic : as in `asperity_contact`
    mean_pressure : load over the area of the map [Pa]
    tolerance : relative, on the load
    raise_on_failure : False returns the closest result with its report

    Returns
    -------
    AsperityResult

    Raises
    ------
    InputError : a value out of range
    ConvergenceError : the model cannot carry the load, or jumps over it; carries report and the closest result

    Notes
    -----
    The flat comes down. Each approach to the highest point is 25 % longer than the last, and none goes below the
    deepest valley. When the load is reached, that step is searched (Chandrupatla). The search stops when ``|load -
    target|/target <= tolerance``. The load of summits is continuous and falls with the separation. That of patches
    jumps where cells join (a tolerance of 1e-3 suits some hundred contacts). It also has a largest value, because
    patches grow together.
    """
    heights, spacing, periodic = _checked(heights, spacing, e_prime, definition, hardness, periodic)
    target = validate.positive("mean_pressure", mean_pressure, "Pa")
    validate.number("tolerance", tolerance, "(-)", above=0.0, maximum=0.5)
    find, top, span = FINDERS[definition](heights, spacing, periodic), heights.max(), float(np.ptp(heights))
    if span == 0:
        raise InputError("heights are all equal: no asperities; allowed: a rough surface in m")

    def excess(approach, _=None):
        flat = np.broadcast_to(top - approach, heights.shape)
        result = _loaded(find, flat, float(top - approach), spacing, e_prime, hardness, definition)
        return result.mean_pressure / target - 1, result

    before, count = 0.0, 0
    best = excess(0.0)[1]
    for approach in span * np.geomspace(*SCAN_RANGE, _scan_count()):
        value, result = excess(approach)
        count += 1
        best = result if result.load > best.load else best
        if value >= 0:
            root = increasing_root(
                excess,
                0.5 * (before + approach),
                step=0.25 * (approach - before),
                bounds=(before, approach),
                tolerance=tolerance,
            )
            return _found(root, count, tolerance, raise_on_failure)
        before = approach
    report = Report(
        "asperity separation",
        STAGNATED,
        count,
        1 - best.mean_pressure / target,
        tolerance,
        evaluations=count,
        notes=(f"{definition} carry {best.mean_pressure:.4g} Pa at most",),
    )
    result = replace(best, report=report)
    if raise_on_failure:
        message = (
            f"{definition} cannot carry a mean pressure of {target:.4g} Pa: at most "
            f"{best.mean_pressure:.4g} Pa, at separation {best.separation:.4g} m"
        )
        raise ConvergenceError(message, report, result)
    return result


def _scan_count() -> int:
    return 1 + math.ceil(math.log(SCAN_RANGE[1] / SCAN_RANGE[0]) / math.log(SCAN))


def _found(root, count, tolerance, raise_on_failure) -> AsperityResult:
    status = CONVERGED if root.status == CONVERGED else STAGNATED
    report = Report(
        "asperity separation",
        status,
        len(root.history),
        abs(root.value),
        tolerance,
        residuals={"load": abs(root.value)},
        history=root.history,
        evaluations=count + len(root.history),
    )
    result = replace(root.payload, report=report)
    if raise_on_failure:
        report.raise_if_failed(result)
    return result


def _checked(heights, spacing, e_prime, definition, hardness, periodic):
    heights = validate.array("heights", heights, "m", ndim=2)
    validate.positive("e_prime", e_prime, "Pa")
    validate.choice("definition", definition, DEFINITIONS)
    if hardness is not None:
        validate.positive("hardness", hardness, "Pa")
    pair = (periodic, periodic) if np.ndim(periodic) == 0 else tuple(periodic)
    return heights, validate.spacing("spacing", spacing), (bool(pair[0]), bool(pair[1]))


def _loaded(find, flat, separation, spacing, e_prime, hardness, definition) -> AsperityResult:
    index, overlap, radius = find(flat)
    area = math.pi * radius * overlap
    force = 2 / 3 * e_prime * np.sqrt(radius) * overlap**1.5
    plastic = np.zeros(overlap.size)
    if hardness is not None:
        ratio = np.minimum(hardness * area / (1.5 * force), 1.0)  # P_u/p0
        force = np.where(ratio < 1, hardness * area * (1 - ratio**2 / 3), force)
        plastic = area * (1 - ratio**2)
    whole = flat.size * spacing[0] * spacing[1]
    return AsperityResult(
        definition=definition,
        separation=separation,
        load=float(force.sum()),
        mean_pressure=float(force.sum() / whole),
        contact_area=float(area.sum()),
        contact_area_fraction=float(area.sum() / whole),
        plastic_area_fraction=float(plastic.sum() / whole),
        contacts=overlap.size,
        index=index,
        overlap=overlap,
        radii=radius,
        forces=force,
    )
