"""One contact problem, checked before any work; pressures that carry its load, and the zero level of its gap."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .._base import BoolArray, FloatArray, IntArray, validate
from ..errors import InputError
from .operator import HalfSpace, half_space

# Cells along an axis below which it is not halved. Halved and doubled by `python -m
# verification.campaigns.benchmarks.contact_constants`.
LEAST_HALVED_CELLS = 24
# Tolerance of a coarse grid [-], which only gives a start. A choice: a smaller value costs time on the coarse grid, a
# larger one on the fine one. Half and twice this value change f by less than .01 % and the work by up to 1 % less
# (constants.csv).
START_TOLERANCE = 1e-2
# Iterations on a coarse grid, at most. A choice: a bound.
COARSE_ITERATIONS = 60
# Newton steps for a shift before every other one halves the bracket. A choice: it changes the time alone.
NEWTON = 12
# Pressure over E' [-] that no start has. A choice: a start beyond it is a slip of units.
ABSURD = 1e6


@dataclass(frozen=True, kw_only=True)
class ContactProblem:
    """One contact problem: gap0 [m] (nx, ny) with its minimum at zero and its rms ``roughness`` [m], deflection
    operator, hardness [Pa] (inf: elastic), and when to stop.

    ``offset`` [m] was subtracted from the caller's gap0: heights around zero keep the most digits near first touch.
    """

    gap0: np.ndarray
    offset: float
    roughness: float
    operator: HalfSpace
    hardness: float
    tolerance: float
    max_iterations: int

    def coarsened(self) -> ContactProblem | None:
        """Return the same problem on cells twice as long (mean gap0) along every axis that can be halved; None if there
        is none."""
        operator = self.operator
        fx, fy = (
            2 if kept % 2 == 0 and padded % 4 == 0 and kept >= 2 * LEAST_HALVED_CELLS else 1
            for kept, padded in zip(operator.shape, operator.padded)
        )
        if fx == fy == 1:
            return None
        parts = [self.gap0[i::fx, j::fy] for i in range(fx) for j in range(fy)]
        return replace(
            self,
            gap0=np.mean(parts, axis=0),
            operator=operator.coarsened((fx, fy)).single,
            tolerance=START_TOLERANCE,
            max_iterations=COARSE_ITERATIONS,
        )


@dataclass(frozen=True, kw_only=True)
class TrialContact:
    """A pressure [Pa] with its displacement and gap [m] (nx, ny) and its approach [m].

    ``scale`` [m]: the length in which residuals are measured; complementarity and penetration: the residuals. All have
    the precision of the operator used.
    """

    pressure: np.ndarray
    displacement: np.ndarray
    gap: np.ndarray
    approach: float
    scale: float
    residuals: dict[str, float]

    @property
    def residual(self) -> float:
        """Return the worst residual."""
        return max(self.residuals.values())

    @property
    def mean_gap(self) -> float:
        """Return the mean of the gap [m] over all cells, zero where bodies overlap."""
        return float(np.maximum(self.gap, 0.0).mean())


def contact_problem(
    gap0: ArrayLike,
    spacing: float | tuple[float, float],
    e_prime: float | None,
    hardness: float | None = None,
    boundary: str | tuple[str, str] = ("periodic", "periodic"),
    tolerance: float = 1e-6,
    operator: HalfSpace | None = None,
    max_iterations: int = 2000,
) -> ContactProblem:
    """Check a problem; builds the operator if none is given, else checks that it fits."""
    if hasattr(gap0, "heights"):
        raise InputError(
            "gap0 is a height map, not an array; give gap0 = -surface.heights in m (heights point out of "
            "the body: the gap is smallest at summits), plus the shape of bodies that are not flat"
        )
    gap0 = validate.array("gap0", gap0, "m", ndim=2)
    hardness = math.inf if hardness is None else validate.positive("hardness", hardness, "Pa")
    tolerance = validate.number("tolerance", tolerance, "(-)", minimum=1e-14, maximum=0.1)
    max_iterations = validate.integer("max_iterations", max_iterations, minimum=0)
    if operator is None:
        operator = half_space(gap0.shape, spacing, e_prime, boundary)
    else:
        required = {
            "shape": gap0.shape,
            "spacing": validate.spacing("spacing", spacing),
            "e_prime": validate.positive("e_prime", e_prime, "Pa"),
            "boundary": (boundary, boundary) if isinstance(boundary, str) else tuple(boundary),
        }
        for name, value in required.items():
            if (built := getattr(operator, name)) != value:
                message = f"operator was built for {name} = {built}, the contact has {value}"
                raise InputError(message, recommendation="they must be the same")
    offset = float(gap0.min())
    gap0 = gap0 - offset if offset else gap0
    return ContactProblem(
        gap0=gap0,
        offset=offset,
        roughness=float(gap0.std()),
        operator=operator,
        hardness=hardness,
        tolerance=tolerance,
        max_iterations=max_iterations,
    )


def on_grid(name: str, value: Any, shape: tuple[int, int], unit: str) -> np.ndarray:
    """Return a number, one for each x, (nx,), or one for each cell, on all cells of ``shape``."""
    try:
        field = np.asarray(value, dtype=float)
        field = np.broadcast_to(field[:, None] if field.ndim == 1 else field, shape)
    except (TypeError, ValueError):
        raise InputError(f"{name} has shape {np.shape(value)}; allowed: a number, (nx,) or {shape} [{unit}]") from None
    return validate.array(name, field, unit, ndim=2)


@dataclass(frozen=True, kw_only=True)
class ContactStart:
    """The ``pressure`` [Pa] (nx, ny) that a solve starts from, and its ``displacement`` [m] by the operator of the
    solve, where that is known."""

    pressure: np.ndarray
    displacement: np.ndarray | None = None


def starting_point(problem: ContactProblem, start: object) -> ContactStart | None:
    """Return the start from an earlier result, or from a pressure field, limited to the hardness; None without a
    pressure. Of an earlier result only the pressure counts, as a caller may have changed it: what has to be trusted is
    given as a `ContactStart`."""
    if start is None:
        return None
    pressure = validate.array("start", getattr(start, "pressure", start), "Pa", ndim=2)
    if pressure.shape != problem.gap0.shape:
        raise InputError(f"start has shape {pressure.shape}; allowed: {problem.gap0.shape}, the shape of gap0")
    limit = ABSURD * problem.operator.e_prime
    if pressure.min() < 0 or pressure.max() > limit:
        message = f"start has pressures from {pressure.min():g} to {pressure.max():g} Pa"
        raise InputError(message, allowed=f"0 to {limit:g} Pa")
    if not pressure.any():
        return None
    if isinstance(start, ContactStart) and pressure.max() <= problem.hardness:
        return start
    limited = np.minimum(pressure, problem.hardness)
    return ContactStart(pressure=np.ascontiguousarray(limited))  # the solver writes through ravel()


def with_load(pressure: FloatArray, load: float, hardness: float) -> np.ndarray:
    """Return ``clip(pressure + s, 0, hardness)`` with the shift s at which the sum is ``load``.

    This is the Euclidean projection, for 0 <= load <= hardness size. Newton's method works on the piecewise linear sum,
    inside a shrinking bracket, so it is exact once the right piece is found. What remains is the rounding error of a
    pressure far above the load. A last factor removes it; cells at the hardness stay there.
    """
    upper = min(hardness, load) - pressure.min()
    lower = -pressure.max()
    shift = 0.0
    for attempt in range(200):
        result = np.clip(pressure + shift, 0.0, hardness)
        missing = load - result.sum()
        if abs(missing) <= 4e-16 * load:
            break
        lower, upper = (shift, upper) if missing > 0 else (lower, shift)
        movable = np.count_nonzero((result > 0) & (result < hardness))
        newton = shift + missing / movable if movable else np.nan
        if newton == shift:
            break
        halve = attempt > NEWTON and attempt % 2 or not lower <= newton <= upper
        shift = 0.5 * (lower + upper) if halve else newton
    if not result.any() and load > 0:  # a load below the rounding of the highest pressure: one cell bears it
        result[np.argmax(pressure)] = min(load, hardness)
    elastic = result < hardness
    carried = result[elastic].sum()
    if carried > 0:
        result[elastic] *= (load - (result.sum() - carried)) / carried
        np.clip(result, 0.0, hardness, out=result)
    return result


def rescaled(pressure: FloatArray, load: float, hardness: float) -> np.ndarray:
    """Return ``pressure`` times a factor, yielded cells left as they are, and then `shifted` to carry ``load``."""
    loaded = np.flatnonzero(pressure > 0)
    values = pressure.ravel()[loaded]
    factor = np.where(values < hardness, load / values.sum(), 1.0)
    return _placed(pressure.shape, loaded, np.minimum(values * factor, hardness), load, hardness)


def shifted(pressure: FloatArray, load: float, hardness: float) -> np.ndarray:
    """Return ``pressure`` with its elastic cells shifted by the same amount, within 0..hardness, so that it carries
    ``load``. If those cells cannot do it, all loaded cells are shifted, else all cells.

    This is a start for another load. Spots of contact grow and shrink at their edges, and their pressure changes as
    under a flat punch. That is nearer to an even change than to one in proportion.
    """
    loaded = np.flatnonzero(pressure > 0)
    return _placed(pressure.shape, loaded, pressure.ravel()[loaded], load, hardness)


def _placed(shape: tuple[int, int], loaded: IntArray, values: FloatArray, load: float, hardness: float) -> np.ndarray:
    """Return the field of ``shape`` with these ``values``, `shifted`, on its cells ``loaded``."""
    field = np.zeros(shape)
    elastic = values < hardness
    for movable in (elastic, np.ones_like(elastic)):
        share = load - values[~movable].sum()
        if 0 < share <= hardness * np.count_nonzero(movable):
            values[movable] = with_load(values[movable], share, hardness)
            field.ravel()[loaded] = values
            return field
    if 0 < load <= hardness * field.size:
        field.ravel()[loaded] = values
        return with_load(field, load, hardness)
    return np.full(shape, load / field.size)


def dot(a: FloatArray, b: FloatArray) -> float:
    """Sum of products, on this thread alone: BLAS threads would fight those of the transforms."""
    return float(np.einsum("i,i", a.ravel(), b.ravel()))


def zero_level(
    height: FloatArray, yielded: BoolArray, elastic: BoolArray | None = None, otherwise: float = 0.0
) -> float:
    """Return the approach [m] at which the mean gap over the ``elastic`` cells is zero, from the ``height`` of the gap.

    If no cell is elastic, it is halfway between the highest ``yielded`` cell and the lowest other one; if no cell is
    loaded at all, ``otherwise``. elastic, yielded: flags.
    """
    if elastic is not None and elastic.any():
        return dot(height, elastic.astype(height.dtype)) / np.count_nonzero(elastic)
    if not yielded.any():
        return otherwise
    highest = float(height[yielded].max())
    return 0.5 * (highest + (highest if yielded.all() else float(height[~yielded].min())))
