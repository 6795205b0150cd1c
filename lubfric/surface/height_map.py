"""A height map with its spacing, its measured points, and the record of its making."""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import KW_ONLY, dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base import FloatArray, FrozenArrays, Shown, figures, validate
from ..errors import InputError
from ..quantities import counted
from . import prepare, regrid, statistics
from .bearing import Bearing, bearing
from .labels import check_labels

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HIGHEST = 1e3  # m, of any height; a choice: no surface has it, a slip of units may
LEAST_CELLS = 5  # of the nesting index of a filter: fewer do not resolve the weights, a choice


@dataclass(frozen=True, eq=False, repr=False)
class Surface(FrozenArrays, Shown):
    """Heights on a uniform grid. x, the direction of motion, is axis 0. Every method returns a new map.

    Attributes
    ----------
    heights : (nx, ny) [m], upwards, at most 1 km; read-only. Unmeasured points are NaN until `fill` is called. The unit
        and the coordinates of an `xarray.DataArray` have to agree with metres and ``spacing``
    spacing : (dx, dy) [m]; one number means equal
    mask : (nx, ny), True where measured, also after filling. None: everywhere, or where a masked array is not masked
    periodic_axes : whether the map continues smoothly onto itself along x and along y
    source, seed, notes : where it came from, and everything that was done to it
    used_parts : those of the ``notes`` of a sum that say how much of each of its maps is in it
    limited_by : the body, "surface" or "counterface", whose map limits a sum along x and along y; "": neither

    Raises
    ------
    InputError : arrays that are not 2-D, values that are not finite at measured points, a mask of another shape or with
        no point, a spacing that is not positive
    """

    heights: FloatArray
    spacing: tuple[float, float]
    _: KW_ONLY
    mask: np.ndarray | None = None
    periodic_axes: tuple[bool, bool] = (False, False)
    source: str = ""
    seed: int | None = None
    notes: tuple[str, ...] = ()
    used_parts: tuple[str, ...] = ()
    limited_by: tuple[str, str] = ("", "")

    def __post_init__(self) -> None:
        check_labels(self.heights, validate.spacing("spacing", self.spacing))
        heights = validate.real_array("heights", self.heights, "m").copy()
        mask = _mask(self.mask, self.heights, heights.shape)
        if np.ma.is_masked(self.heights):
            heights[np.ma.getmaskarray(self.heights)] = np.nan
        measured = validate.array("heights", heights if mask is None else np.where(mask, heights, 0.0), "m", ndim=2)
        largest = float(np.abs(measured).max())
        if largest > HIGHEST:
            ways = (
                "check their unit (unit = 'nm' or 'um' of a file), or give missing_value, if they stand for 'not "
                "measured'"
            )
            raise InputError(f" = {largest:g} m is out of range", "heights, the largest", f"up to {HIGHEST:g} m", ways)
        object.__setattr__(self, "heights", heights)
        object.__setattr__(self, "mask", mask)
        object.__setattr__(self, "spacing", validate.spacing("spacing", self.spacing))
        along = validate.pair("periodic_axes", self.periodic_axes, validate.boolean, "true or false")
        object.__setattr__(self, "periodic_axes", along)
        object.__setattr__(self, "notes", tuple(self.notes))
        object.__setattr__(self, "used_parts", tuple(self.used_parts))
        object.__setattr__(self, "limited_by", tuple(self.limited_by))
        super().__post_init__()

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
        """Fraction of the points that were not measured, whether filled since or not."""
        return 0.0 if self.mask is None else 1.0 - np.count_nonzero(self.mask) / self.mask.size

    @property
    def measured(self) -> np.ndarray:
        """The heights [m] of the measured points, one axis."""
        return self.heights.ravel() if self.mask is None else self.heights[self.mask]

    @cached_property
    def sq(self) -> float:
        """Root mean square height [m] about the mean, of the measured points."""
        return float(self.measured.std())

    def describe(self) -> str:
        """Return one line: size, points, Sq, Ra, Rz, Ssk, Sk, Spk, Svk, largest height over Sq, missing share,
        source."""
        (lx, ly) = self.size
        (nx, ny) = self.shape
        (rz, length) = statistics.rz(self)
        curve = self.bearing()
        is_wavy = rz < 2 * self.sa  # of one evaluation Rz is at least 2 Ra
        waves = ", without the longer waves that Sq and Ra contain" if is_wavy else ""
        rz_in_words = f"{rz * 1e9:.4g} nm (mean height within lengths of {length * 1e3:.3g} mm{waves})"
        if math.isnan(rz):
            rz_in_words = f"not known (the spacing is too long for a sampling length of {length * 1e3:.3g} mm)"
        skewness = f"Ssk {self.ssk:.3g}, " if self.sq > 0 else ""
        text = (
            f"{nx} x {ny} points, {lx * 1e6:.4g} x {ly * 1e6:.4g} µm, Sq {self.sq * 1e9:.4g} nm, "
            f"Ra {self.sa * 1e9:.4g} nm (whole map), Rz {rz_in_words}, {skewness}"
            f"Sk {curve.sk * 1e9:.4g} nm, Spk {curve.spk * 1e9:.4g} nm, Svk {curve.svk * 1e9:.4g} nm, "
            f"max |z|/Sq {self.largest_ratio:.3g}, {100 * self.missing_fraction:.3g} % missing"
        )
        return f"{self.source}: {text}" if self.source else text

    def plot(self, ax: "Axes | None" = None) -> Axes:
        """Draw the heights in the plane, on ``ax`` or new axes, which are returned. The colours leave out single
        spikes, which the title then states."""
        axes = figures.axes_or_new(ax, "compressed")
        x, y = (np.arange(count) * step for count, step in zip(self.shape, self.spacing))
        z = (self.heights - np.nanmean(self.heights)) * 1e9
        (low, high) = np.nanpercentile(z, (0.5, 99.5))
        least = np.nanmin(z)
        most = np.nanmax(z)
        reach = 0.4 * (high - low)  # to some four times Sq, were the heights normally distributed
        ends = {"vmin": max(least, low - reach), "vmax": min(most, high + reach)}
        clipped = least < ends["vmin"], most > ends["vmax"]
        extend = {(True, True): "both", (True, False): "min", (False, True): "max"}.get(clipped, "neither")
        figures.field_image(axes, x, y, z, "cividis", "height (nm)", extend, **ends)
        axes.set_xlabel("x (µm)")
        axes.set_ylabel(axes.get_ylabel().replace(", along the line", ""))
        ends_in_words = f"\nlowest {least:.4g}, highest {most:.4g} nm" if any(clipped) else ""
        axes.set_title(f"Sq = {self.sq * 1e9:.4g} nm{ends_in_words}")
        return axes

    def _facts(self) -> dict[str, str]:
        return {"": self.describe()}

    def level(self, form: str = "plane") -> Surface:
        """Subtract the least-squares ``form`` of the measured points: "plane", "cylinder" (about x or y) or "quadratic"
        (a paraboloid, and a cylinder about any axis)."""
        validate.choice("form", form, prepare.FORM_POWERS)
        fitted, slopes, curvatures = prepare.fitted_form(self.heights, self.mask, self.spacing, form)
        note = f"levelled: slopes {slopes[0]:.3e}, {slopes[1]:.3e}"
        if form != "plane":
            note += f" and curvatures {curvatures[0]:.3e}, {curvatures[1]:.3e} 1/m"
        return self._with(self.heights - fitted, f"{note} removed")

    def left_by(self, *, includes_outliers: bool = True) -> dict[str, float]:
        """Return Sq [m] that each form of `level` would leave, and that of the unchanged map (""). A form that the
        points do not fix is omitted.

        ``includes_outliers``: False for the Sq without isolated points (`without_outliers`), behind which a form may
        hide; with them where too few points are measured to find them.
        """
        surface = self
        if not includes_outliers:
            with suppress(InputError):
                surface = self.level().without_outliers()
        left = {"": surface.sq}
        for form in prepare.FORM_POWERS:
            with suppress(InputError):
                left[form] = surface.level(form).sq
        return left

    def fill(self) -> Surface:
        """Fill unmeasured points with the harmonic surface through their neighbours (level first).

        No filled height lies outside the range of the points around it. Raises `InputError` when more than half is
        missing. The mask still distinguishes measured from filled points.
        """
        if self.mask is None:
            return self
        filled = prepare.harmonic_fill(self.heights, self.mask, self.spacing)
        return self._with(
            filled, f"filled: {counted(int(np.count_nonzero(~self.mask)), 'unmeasured points')}, harmonically"
        )

    def without_outliers(self) -> Surface:
        """Make outliers unmeasured points. Level before, fill after; `lubfric.surface.outliers` has the rule."""
        mask = np.ones(self.shape, bool) if self.mask is None else self.mask
        more = True
        while more:
            filled = prepare.harmonic_fill(self.heights, mask, self.spacing)
            outlying = prepare.outliers(filled, mask, self.periodic_axes) != 0
            mask = mask & ~outlying
            more = outlying.any()
        was_measured = np.isfinite(self.heights) if self.mask is None else self.mask  # filled points are no outliers
        lost = self.heights[was_measured & ~mask]
        count = lost.size
        above = np.count_nonzero(lost > np.median(self.measured))
        around = f"{prepare.WINDOW} x {prepare.WINDOW} points around"
        sides = f", {above} above and {count - above} below them" if count else ""
        note = f"outliers masked: {count or 'none'} (over {prepare.OUTLIER_LIMIT:g} deviations off {around}{sides})"
        masked = self._with(np.where(mask, self.heights, np.nan), note, mask=mask)
        if not count:
            return masked
        note += f", which takes Sq from {self.sq * 1e9:.4g} to {masked.sq * 1e9:.4g} nm"
        return replace(masked, notes=(*self.notes, note))

    def filtered(self, *, s: float | None = None, l: float | None = None) -> Surface:
        """Apply the areal Gaussian filters of ISO 16610-61 with nesting indices ``s`` and ``l`` [m] (None: not used),
        in this order.

        S-filter: waves shorter than ``s`` are taken out; L-filter: waves longer than ``l``. Level first (F-operation:
        `level`), fill after it. Raises `InputError` for an index of fewer than 5 cells
        or longer than the map, and for s >= l.
        """
        limits = {"minimum": LEAST_CELLS * max(self.spacing), "maximum": min(self.size)}
        s, l = (
            None if index is None else validate.number(name, index, "m", **limits)
            for name, index in (("s_filter", s), ("l_filter", l))
        )
        if s is not None and l is not None and s >= l:
            message = f"s_filter = {s:g} m and l_filter = {l:g} m remove all waves"
            raise InputError(message, recommendation="give an s_filter below l_filter")
        new = self
        if s is not None:
            new = new._with(new._mean(s), f"S-filter: waves shorter than {s:.4e} m taken out")
        if l is not None:
            new = new._with(new.heights - new._mean(l), f"L-filter: waves longer than {l:.4e} m taken out")
        return new

    def _mean(self, index: float) -> np.ndarray:
        return prepare.gaussian_mean(self.heights, self.mask, self.spacing, self.periodic_axes, index)

    def scaled(self, *, sq: float) -> Surface:
        """Return the heights about their mean, multiplied so that Sq is ``sq`` [m]."""
        target = validate.nonnegative("sq", sq, "m")
        now = self.sq
        if now <= prepare.LEFT_BY_FORM * np.abs(self.measured).max():
            raise InputError("sq of the surface = 0 m: a flat surface cannot be scaled; allowed: above 0 m")
        mean = self.measured.mean()
        return self._with((self.heights - mean) * (target / now), f"scaled from Sq {now:.4e} m to {target:.4e} m")

    def transposed(self) -> Surface:
        """Return the map with x and y exchanged: run across the lay instead of along it."""
        mask = None if self.mask is None else self.mask.T
        turned: dict[str, Any] = {
            "spacing": self.spacing[::-1],
            "mask": mask,
            "periodic_axes": self.periodic_axes[::-1],
        }
        return self._with(self.heights.T, "x and y exchanged", **turned)

    def periodic(self, *, axes: tuple[bool, bool] = (True, True)) -> Surface:
        """Make the map periodic along the chosen axes: the map and its mirror image, twice as long. Heights and slopes
        keep their statistics, the lay is reflected."""
        new = self._filled("periodic")
        for axis in range(2):
            if axes[axis] and not new.periodic_axes[axis]:
                new = regrid.mirrored(new, axis)
        return new

    def cropped(self, shape: Sequence[int], start: Sequence[int] | None = None) -> Surface:
        """Return ``shape`` points from index ``start`` (default: centred); no longer periodic where cut."""
        shape = regrid.pair("shape", shape)
        first = tuple((n - m) // 2 for n, m in zip(self.shape, shape)) if start is None else tuple(start)
        for axis in range(2):
            if not 0 <= first[axis] <= self.shape[axis] - shape[axis]:
                message = f" = {shape[axis]} points from {first[axis]} is outside the map"
                raise InputError(message, f"shape[{axis}]", f"within 0..{self.shape[axis]}")
        cut = tuple(slice(s, s + n) for s, n in zip(first, shape))
        mask = None if self.mask is None else self.mask[cut]
        periodic_axes_left = tuple(p and n == m for p, n, m in zip(self.periodic_axes, self.shape, shape))
        return self._with(
            self.heights[cut], f"cropped to {shape} from {first}", mask=mask, periodic_axes=periodic_axes_left
        )

    def resampled(
        self, *, shape: tuple[int, int] | None = None, spacing: float | tuple[float, float] | None = None
    ) -> Surface:
        """Return the map of this area on another grid; give ``shape`` (extent kept) or ``spacing`` [m] (a remainder of
        less than one cell is cut off). Periodic axes by Fourier series (exact for a band-limited map), others as
        averages over the new cells; see `regrid.resample_axis`."""
        if (shape is None) == (spacing is None):
            raise InputError("resampled needs exactly one of shape (points) and spacing (m)")
        new = self._filled("resampled")
        points = (None, None) if shape is None else regrid.pair("shape", shape)
        steps = (None, None) if spacing is None else validate.spacing("spacing", spacing)
        for axis in range(2):
            new = regrid.resampled(new, axis, points[axis], steps[axis])
        return new

    def patch(self, shape: tuple[int, int], spacing: float | tuple[float, float] | None = None) -> Surface:
        """Return exactly ``shape`` points at ``spacing`` [m] (default: its own) for a contact grid. Axes that are
        periodic are repeated as often as needed; others are cut, and must be long enough."""
        shape = regrid.pair("shape", shape)
        new = self._filled("patch")
        if spacing is not None:
            new = new.resampled(spacing=spacing)
        for axis in range(2):
            new = regrid.fitted(new, axis, shape[axis])
        return new

    def _with(self, heights: FloatArray, note: str, **changed: Any) -> Surface:
        return replace(self, heights=heights, notes=(*self.notes, note), **changed)

    def _filled(self, purpose: str) -> Surface:
        if not np.isfinite(self.heights).all():
            message = f"{100 * self.missing_fraction:.3g} % of the heights are unmeasured (NaN)"
            raise InputError(f"{message}; {purpose} takes none: call level() and fill() first")
        return self

    def combined(self, other: Surface) -> Surface:
        """Return the sum of this map and that of the body that faces it; see `regrid.combined`."""
        validate.instance("other", other, Surface, "a Surface")
        return regrid.combined(self, other)

    def continued(self, length: float) -> Surface:
        """Return the map, made at least ``length`` [m] long along x. A shorter one is followed by its mirror image, and
        so on, and is periodic along x then."""
        length = validate.positive("length", length, "m")
        if self.size[0] * (1 + 1e-9) >= length:
            return self
        new = self.periodic(axes=(True, False))
        count = new.shape[0] * math.ceil(length / new.size[0] * (1 - 1e-9))
        regrid.points("continued", (count, new.shape[1]))
        return regrid.fitted(new, 0, count)

    # statistics of the measured points, by the functions of lubfric.surface.statistics
    largest_ratio = property(statistics.largest_ratio)
    sa = property(statistics.sa)
    ssk = property(statistics.ssk)
    sku = property(statistics.sku)
    correlation_length = statistics.correlation_length

    def bearing(self) -> Bearing:
        """Return Sk, Spk, Svk, Smr1 and Smr2 of the measured points (ISO 25178-2, `lubfric.surface.bearing`)."""
        return bearing(self.measured)

    @property
    def sk(self) -> float:
        """Core height Sk [m]."""
        return self.bearing().sk

    @property
    def spk(self) -> float:
        """Reduced peak height Spk [m]."""
        return self.bearing().spk

    @property
    def svk(self) -> float:
        """Reduced dale height Svk [m]."""
        return self.bearing().svk


def _mask(given: Any, heights: Any, shape: tuple[int, ...]) -> np.ndarray | None:
    """Return a copy of the mask ``given``, without the points that a masked array masks. None where every point is
    measured."""
    measured = np.ones(shape, bool) if given is None else np.array(given)
    if measured.dtype.kind != "b" or measured.shape != shape:
        message = f" has shape {measured.shape} and type {measured.dtype}"
        raise InputError(message, "mask", f"true (measured) and false in shape {shape}")
    if np.ma.is_masked(heights):
        measured &= ~np.ma.getmaskarray(heights)
    if measured.size and not measured.any():
        raise InputError(f"mask has 0 measured points of {measured.size}; allowed: at least 1")
    return None if measured.all() else measured
