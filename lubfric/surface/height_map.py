"""A height map with its spacing, what was measured of it, and how it came to be."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .. import validate
from ..errors import InputError
from . import prepare, statistics


@dataclass(frozen=True, eq=False)
class Surface:
    """Heights on a uniform grid; x, the direction of motion, is axis 0. Every method returns a new map.

    heights : (nx, ny) [m], upwards. Read-only. Unmeasured points are NaN until `fill` is called.
    spacing : (dx, dy) [m]; one number means equal.
    mask : (nx, ny) True where measured, also after filling; None: everywhere.
    periodic_axes : whether the map continues smoothly onto itself along x and along y.
    source, seed, notes : where it came from and everything that was done to it.

    Raises `InputError` for arrays that are not 2-D, values that are not finite at measured points,
    a mask of another shape or with no point, a spacing that is not positive.
    """

    heights: np.ndarray
    spacing: tuple[float, float]
    mask: np.ndarray | None = None
    periodic_axes: tuple[bool, bool] = (False, False)
    source: str = ""
    seed: int | None = None
    notes: tuple[str, ...] = ()

    def __post_init__(self):
        mask = self.mask
        if mask is None:
            heights = validate.array("heights", self.heights, "m", ndim=2).copy()
        else:
            heights = np.array(self.heights, dtype=float)
            mask = np.array(mask, dtype=bool)
            if mask.shape != heights.shape or not mask.any():
                raise InputError(
                    f"mask has shape {mask.shape} and {np.count_nonzero(mask)} measured points; "
                    f"allowed: shape {heights.shape} and at least one point"
                )
            validate.array("heights", np.where(mask, heights, 0.0), "m", ndim=2)
            if mask.all():
                mask = None
            else:
                mask.flags.writeable = False
        heights.flags.writeable = False
        object.__setattr__(self, "heights", heights)
        object.__setattr__(self, "mask", mask)
        object.__setattr__(self, "spacing", validate.spacing("spacing", self.spacing))
        object.__setattr__(self, "periodic_axes", tuple(bool(p) for p in self.periodic_axes))

    @property
    def shape(self) -> tuple[int, int]:
        """(nx, ny)."""
        return self.heights.shape

    @property
    def size(self) -> tuple[float, float]:
        """(nx dx, ny dy) [m]."""
        return self.shape[0] * self.spacing[0], self.shape[1] * self.spacing[1]

    @property
    def missing_fraction(self) -> float:
        """Share of the points that was not measured (whether filled since or not)."""
        return 0.0 if self.mask is None else 1.0 - np.count_nonzero(self.mask) / self.mask.size

    @property
    def measured(self) -> np.ndarray:
        """The heights [m] of the measured points, one axis."""
        return self.heights.ravel() if self.mask is None else self.heights[self.mask]

    @property
    def sq(self) -> float:
        """Root mean square height [m] about the mean, of the measured points."""
        return float(self.measured.std())

    def describe(self) -> str:
        """One line: size, points, Sq, missing share, source."""
        (lx, ly), (nx, ny) = self.size, self.shape
        text = (
            f"{nx} x {ny} points, {lx * 1e6:.4g} x {ly * 1e6:.4g} um, Sq {self.sq * 1e9:.4g} nm, "
            f"{100 * self.missing_fraction:.3g} % missing"
        )
        return f"{self.source}: {text}" if self.source else text

    def level(self, form: str = "plane") -> Surface:
        """Subtract the least-squares "plane" of the measured points, or "quadratic" (cylinder, paraboloid)."""
        validate.choice("form", form, prepare.FORMS)
        fitted, slopes, curvatures = prepare.fitted_form(self.heights, self.mask, self.spacing, form)
        note = f"levelled: slopes {slopes[0]:.3e}, {slopes[1]:.3e}"
        if form == "quadratic":
            note += f" and curvatures {curvatures[0]:.3e}, {curvatures[1]:.3e} 1/m"
        return self._with(self.heights - fitted, f"{note} removed")

    def fill(self) -> Surface:
        """Fill unmeasured points with the harmonic surface through their neighbours (level first).

        No filled height lies outside the range of the points around it. Raises `InputError` when
        more than half is missing. The mask still tells measured from filled.
        """
        if self.mask is None:
            return self
        filled = prepare.harmonic_fill(self.heights, self.mask, self.spacing)
        return self._with(filled, f"filled: {np.count_nonzero(~self.mask)} unmeasured points, harmonically")

    def scaled(self, *, sq: float) -> Surface:
        """Heights about their mean, multiplied so that Sq is ``sq`` [m]."""
        target, now = validate.nonnegative("sq", sq, "m"), self.sq
        if now == 0:
            raise InputError("sq of the surface = 0 m: a flat surface cannot be scaled; allowed: above 0 m")
        mean = self.measured.mean()
        return self._with((self.heights - mean) * (target / now), f"scaled from Sq {now:.4e} m to {target:.4e} m")

    def transposed(self) -> Surface:
        """x and y exchanged: run across the lay instead of along it."""
        return replace(
            self,
            heights=self.heights.T,
            spacing=self.spacing[::-1],
            mask=None if self.mask is None else self.mask.T,
            periodic_axes=self.periodic_axes[::-1],
            notes=(*self.notes, "x and y exchanged"),
        )

    def periodic(self, edge: str = "mirror", *, axes: tuple[bool, bool] = (True, True)) -> Surface:
        """Make the map continue onto itself along the chosen axes; see `prepare.close_axis`.

        edge "mirror": the map and its mirror image, twice as long (even number of points; heights
        and slopes keep their statistics, the lay is reflected). edge "window": the last tenth is
        blended over the first, one tenth shorter (no mirror image, Sq kept for independent ends).
        """
        validate.choice("edge", edge, prepare.EDGES)
        new = self._filled("periodic")
        for axis in range(2):
            if axes[axis] and not new.periodic_axes[axis]:
                new = new._closed(edge, axis, None)
        return new

    def cropped(self, shape, start=None) -> Surface:
        """``shape`` points from index ``start`` (default: centred); no longer periodic where cut."""
        shape = prepare.pair("shape", shape)
        start = tuple((n - m) // 2 for n, m in zip(self.shape, shape)) if start is None else tuple(start)
        for axis in range(2):
            if not 0 <= start[axis] <= self.shape[axis] - shape[axis]:
                raise InputError(
                    f"shape[{axis}] = {shape[axis]} points from {start[axis]} is outside "
                    f"the map; allowed: within 0..{self.shape[axis]}"
                )
        cut = tuple(slice(s, s + n) for s, n in zip(start, shape))
        periodic = tuple(p and n == m for p, n, m in zip(self.periodic_axes, self.shape, shape))
        return replace(
            self,
            heights=self.heights[cut],
            mask=None if self.mask is None else self.mask[cut],
            periodic_axes=periodic,
            notes=(*self.notes, f"cropped to {shape} from {start}"),
        )

    def resampled(self, *, shape=None, spacing=None) -> Surface:
        """The same area on another grid; give ``shape`` (extent kept) or ``spacing`` [m] (a rest of
        less than one cell is cut off). Periodic axes by Fourier series (exact for a band-limited
        map), others as averages over the new cells; see `prepare.resample_axis`."""
        if (shape is None) == (spacing is None):
            raise InputError("resampled needs exactly one of shape (points) and spacing (m)")
        new = self._filled("resampled")
        shape = (None, None) if shape is None else prepare.pair("shape", shape)
        spacing = (None, None) if spacing is None else validate.spacing("spacing", spacing)
        for axis in range(2):
            new = new._resampled(axis, shape[axis], spacing[axis])
        return new

    def patch(self, shape, spacing=None, *, edge=(None, None)) -> Surface:
        """Exactly ``shape`` points at ``spacing`` [m] (default: its own) for a contact grid.

        Axes that are periodic are repeated as often as needed; others must be long enough. ``edge``
        per axis: "mirror" or "window" makes the patch periodic along it, None leaves it cut.
        """
        shape, new = prepare.pair("shape", shape), self._filled("patch")
        edge = (edge, edge) if edge is None or isinstance(edge, str) else tuple(edge)
        if spacing is not None:
            new = new.resampled(spacing=spacing)
        for axis in range(2):
            new = new._fitted(axis, shape[axis], edge[axis])
        return new

    def _with(self, heights, note) -> Surface:
        return replace(self, heights=heights, notes=(*self.notes, note))

    def _filled(self, purpose) -> Surface:
        if not np.isfinite(self.heights).all():
            raise InputError(
                f"{100 * self.missing_fraction:.3g} % of the heights are unmeasured (NaN); "
                f"allowed for {purpose}: none, call level() and fill() first"
            )
        return self

    def _changed(self, axis, heights, note, *, step=None, closed=None, mask=None) -> Surface:
        """A copy with new heights along one axis, and whatever else changes with them."""
        spacing, periodic = list(self.spacing), list(self.periodic_axes)
        spacing[axis] = spacing[axis] if step is None else step
        periodic[axis] = periodic[axis] if closed is None else closed
        return replace(
            self,
            heights=heights,
            spacing=tuple(spacing),
            mask=mask,
            periodic_axes=tuple(periodic),
            notes=(*self.notes, note),
        )

    def _closed(self, edge, axis, count) -> Surface:
        heights = prepare.close_axis(self.heights, axis, edge, count)
        mask = None if self.mask is None else prepare.close_mask(self.mask, axis, edge, count)
        note = f"made periodic along {'xy'[axis]}: {edge}"
        return self._changed(axis, heights, note, closed=True, mask=mask)

    def _resampled(self, axis, count, step) -> Surface:
        n, old = self.shape[axis], self.spacing[axis]
        closed = self.periodic_axes[axis]
        if count is None:
            exact = n * old / step
            count = int(np.floor(exact * (1 + 1e-9)))
            closed = closed and abs(exact - round(exact)) < 1e-6
        else:
            step = n * old / count
        if count < 1:
            raise InputError(f"spacing[{axis}] = {step:g} m is longer than the map; allowed: up to {n * old:g} m")
        if count == n and abs(step / old - 1) < 1e-9:
            return self
        heights = prepare.resample_axis(self.heights, axis, count, step / old, closed)
        note = f"resampled along {'xy'[axis]} from {n} points at {old:.4e} m to {count} at {step:.4e} m"
        if self.mask is not None:
            note += f" (mask dropped, {100 * self.missing_fraction:.3g} % was unmeasured)"
        return self._changed(axis, heights, note, step=step, closed=closed)

    def _fitted(self, axis, count, edge) -> Surface:
        if edge is not None:
            validate.choice("edge", edge, prepare.EDGES)
        n = self.shape[axis]
        if count == n and (edge is None or self.periodic_axes[axis]):
            return self
        if self.periodic_axes[axis] and (edge is None or count % n == 0):
            pick = np.arange(count) % n
            mask = None if self.mask is None else np.take(self.mask, pick, axis)
            return self._changed(
                axis,
                np.take(self.heights, pick, axis),
                closed=count % n == 0,
                mask=mask,
                note=f"repeated along {'xy'[axis]} from {n} to {count} points",
            )
        need = count if edge is None else prepare.points_to_close(count, edge)
        if need > n:
            raise InputError(
                f"patch of {count} points along {'xy'[axis]} needs {need} points of the map "
                f"({need * self.spacing[axis]:g} m); allowed: up to {n} "
                f"({self.size[axis]:g} m), or a periodic map"
            )
        shape = list(self.shape)
        shape[axis] = need
        cut = self.cropped(shape)
        return cut if edge is None else cut._closed(edge, axis, count)

    # statistics of the measured points, by the functions of lubfric.surface.statistics
    sa = property(statistics.sa)
    ssk = property(statistics.ssk)
    sku = property(statistics.sku)
