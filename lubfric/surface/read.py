"""Height maps from files: .npy, text matrix, .xyz points and X3P; some 40 formats of instruments through the optional
package SurfaceTopography."""

from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from .._base import validate, with_default_errors
from ..errors import InputError
from ..quantities import KEYS
from ..units import worded
from .header import LENGTH_UNITS
from .height_map import Surface
from .layout import kind_of_table, refuse_profile
from .prepare import BETTER, FORM_POWERS, advised_form, outliers
from .regrid import points
from .sdf import SDF_FIRST_WORDS as SDF
from .statistics import WHERE_GIVEN_UNIT_IS_WRONG, WHERE_UNIT_IS_WRONG, check_scale, check_slopes
from .surfer import BINARY as SURFER_BINARY
from .text import DECIMALS, read_text
from .x3p import read_x3p

MOST_MAP_BYTES = 2**31  # of any file; a choice, for memory
TEXT = (".txt", ".csv", ".asc", ".dat", ".xyz", ".prf", ".smd", ".grd")
OWN_GRID = {".x3p": read_x3p}  # formats that carry their grid and their units, and their readers
SUFFIXES = (".npy", *TEXT, *OWN_GRID)
ISO_TEXT = tuple(magic.encode("ascii") for magic in SDF)  # first bytes of an .sdf or .bcr file that is text
# of the formats that SurfaceTopography 1.27 knows; those that lubfric reads itself (.x3p, .xyz, text, .npy) are left
# out
INSTRUMENTS = (
    ".001 .002 .003 .004 .005 .al3d .apx .bcr .bcrf .cur .dat .datx .ezd .frt .gwy .h5 .hfm .hgt .ibw .jpk .lext .mat "
    ".mdt .mi .mnt .nc .nid .nms .npz .oir .opd .opdx .os3d .plu .plux .poir .qep .sdf .spm .stp .sur .tif .tiff .tmd "
    ".tom .top .vk3 .vk4 .vk6 .vk7 .xlsx .zip .zmg .zon"
).split()
HINT = "pip install 'lubfric[formats]'"


@with_default_errors
def read_surface(
    path: Any,
    *,
    level: bool = True,
    form: str = "plane",
    fill: bool = True,
    spacing: Any = None,
    unit: Any = None,
    decimal: str | None = None,
    missing_value: float | None = None,
) -> Surface:
    """Read a measured height map, remove its form, then fill the points that were not measured (the mask stays).

    ==================== ==================================================================
    .npy                 heights[ix, iy]; needs ``spacing``
    .txt .csv .asc .dat  a matrix: one line of the file is one x, unless its header says that x runs along the lines;
                         or points "x y z". Headers of Gwyddion, SPIP, Wyko and others give spacing and units
    .xyz                 lines "x y z" on a uniform grid, any order; omitted points are unmeasured
    .xyz .asc .txt       of Zygo MetroPro and Mx; points need the ``unit`` of their heights
    .sdf .bcr            ISO 25178-71 as text; in metres
    .grd                 Surfer as text (DSAA); needs ``unit``
    .x3p                 ISO 25178-72; x is the fast axis of the file and axis 0 here; metres
    .sur .al3d .opd ...  every format of SurfaceTopography (``lubfric[formats]``): its first channel
    ==================== ==================================================================

    docs/inputs.md has a table of what is read of each format and what is checked. What a header states is used, and an
    argument that contradicts it is refused. Lines above the table that state nothing are skipped; ``surface.notes``
    lists them all. A line that states another size than that of the table is refused. An empty cell, "nan", "Bad", "No
    Data", "---" and the like are unmeasured. A comma between digits is the decimal mark where semicolons, tabs or
    blanks separate. A profile is refused. Look at ``surface.describe()`` (size, Sq, max |z|/Sq, missing share) before
    you trust a file.

    Parameters
    ----------
    path : file
    level, fill : subtract the ``form`` of the measured points; fill the others harmonically
    form : "plane", "cylinder" (about x or y) or "quadratic", by least squares: the F-operation of ISO 25178-2
        (`Surface.filtered` has the S- and L-filters). A note of the surface gives the Sq that each form leaves
    spacing : (dx, dy) or one length [m], where the file does not carry its own
    unit : "m" (default), "mm", "um" or "µm", "nm" of the heights (and of x, y in a list of points), where the file
        names none. Several: (x and y, z) or (x, y, z)
    decimal : "." or ",", the decimal mark of a text file in which commas can be either
    missing_value : number for "not measured" in a .npy or text file, in the unit of the file, in addition to NaN

    Returns a `Surface`.

    Raises
    ------
    InputError : a file that is missing, truncated, of an unknown kind, inconsistent or hostile; a profile; words among
        the numbers; commas that can be read both ways; a title that names a unit which belongs to nothing when ``unit``
        is not given; infinite heights; points that are more than 15 % of the spacing off a uniform grid; spacing or
        unit that contradict the file, or that neither the file nor an argument gives; slopes that no surface has, since
        heights and spacing are then in different units
    """
    path, head = _opened(path)
    validate.choice("form", form, FORM_POWERS)
    if not level and form != "plane":
        raise InputError(f"form = {form!r} and level = {level!r}; allowed: form = 'plane' with level = False")
    if decimal is not None:
        validate.choice("decimal", decimal, DECIMALS)
    try:
        with np.errstate(all="ignore"):
            surface = _read(path, head, spacing, unit, decimal, missing_value)
            is_given = spacing is not None or unit is not None  # else the file alone says what its numbers are
            check_scale(surface, advice=WHERE_GIVEN_UNIT_IS_WRONG if is_given else WHERE_UNIT_IS_WRONG)
            return _prepared(replace(surface, source=path.name), level=level, fill=fill, form=form)
    except MemoryError:
        size = path.stat().st_size
        message = f"path = {str(path)!r} with {size:.3g} bytes does not fit into the memory that this process may use"
        raise InputError(message, recommendation="give a smaller part of the map, or allow more memory") from None


def _read(path: Path, head: bytes, spacing: Any, unit: Any, decimal: str | None, missing_value: Any) -> Surface:
    """Return the map in a file unchanged, by the reader of its format."""
    suffix = path.suffix.lower()
    binary = b"\0" in head and not head.startswith((b"\xff\xfe", b"\xfe\xff"))  # no text: .dat of an interferometer
    if head.startswith(SURFER_BINARY):
        message = f"path = {str(path)!r} is a binary grid of Surfer"
        raise InputError(message, recommendation="save it as a Surfer 6 text grid (DSAA)")
    if head.lstrip(b"\xef\xbb\xbf \r\n").startswith(ISO_TEXT):
        return _plain(path, ".txt", spacing, unit, decimal, missing_value)
    by_instrument = suffix in TEXT and binary or suffix not in SUFFIXES and suffix in INSTRUMENTS
    if by_instrument or suffix in OWN_GRID:
        _refuse(suffix, spacing=spacing, unit=unit, decimal=decimal, missing_value=missing_value)
        return _instrument(path) if by_instrument else OWN_GRID[suffix](path)
    if suffix in SUFFIXES:
        return _plain(path, suffix, spacing, unit, decimal, missing_value)
    others = f"with SurfaceTopography ({HINT}) {', '.join(INSTRUMENTS)}"
    message = f"path = {validate.shown(str(path))} has the unknown suffix {validate.shown(suffix)}"
    raise InputError(message, allowed=f"{', '.join(SUFFIXES)}, and {others}")


def _opened(path: Any) -> tuple[Path, bytes]:
    """Return the path and the first bytes of a file that is there, can be opened and is not too large."""
    path = validate.folder("path", path)
    if not path.is_file():
        raise InputError(f"path = {validate.shown(str(path))}: no such file")
    try:
        size = path.stat().st_size
        if size > MOST_MAP_BYTES:
            raise InputError(
                f"path = {validate.shown(str(path))} has {size:.3g} bytes", "", f"up to {MOST_MAP_BYTES:.3g}"
            )
        with path.open("rb") as file:
            return path, file.read(4096)
    except OSError as problem:
        raise InputError(f"path = {str(path)!r} cannot be read ({problem})") from None


def units_of(name: str, value: Any) -> tuple[str, str, str] | None:
    """Return the units of x, y and the heights: one for all, (x and y, heights), or all three; None for None."""
    if value is None:
        return None
    parts = list(value) if isinstance(value, (list, tuple)) else [value]
    if not 1 <= len(parts) <= 3:
        raise InputError(f" = {validate.shown(value)}", name, "one unit, (x and y, heights), or (x, y, heights)")
    words = [validate.choice(name, part, LENGTH_UNITS) for part in parts]
    return words[0], words[-2] if len(words) > 1 else words[0], words[-1]


def _plain(path: Path, suffix: str, spacing: Any, unit: Any, decimal: str | None, missing_value: Any) -> Surface:
    """Return the map of a file of text, or of an array of NumPy."""
    units = units_of("unit", unit)
    if spacing is not None:
        spacing = validate.spacing("spacing", spacing)
    if missing_value is not None:
        missing_value = validate.number("missing_value", missing_value, "(unit of the file)")
    if suffix == ".npy":
        _refuse(suffix, decimal=decimal)
        heights = _read_npy(path)
        kind = kind_of_table(path.name, heights)
        if kind == "profile":
            refuse_profile(path.name, heights, None, units)
        if kind == "points":
            message = f"path = {str(path)!r} contains points x y z on a grid, not a map of heights"
            raise InputError(message, recommendation="write them as text with the suffix .xyz")
        if missing_value is not None and heights.dtype.kind == "f":
            missing_value = float(heights.dtype.type(missing_value))  # in the precision of the file
        scale = LENGTH_UNITS["m" if units is None else units[2]]
        return _masked(path, heights.astype(float), scale, (missing_value,), spacing)
    table = read_text(path, points=suffix == ".xyz", decimal=decimal, units=units, spacing=spacing)
    missing = (missing_value, table.missing_value)
    return _masked(
        path,
        table.heights,
        table.height_scale,
        missing,
        table.spacing,
        notes=table.notes,
        unused_steps=table.unused_steps,
        unread_sizes=table.unread_sizes,
    )


def _refuse(suffix: str, **given: Any) -> None:
    for name, value in given.items():
        if value is not None:
            message = f" = {value!r} is given, and this {suffix} file states its own or has none"
            raise InputError(message, name, recommendation="omit it")


def _masked(
    path: Path,
    heights: np.ndarray,
    scale: float,
    missing_values: tuple[float | None, ...],
    spacing: Any,
    *,
    notes: tuple[str, ...] = (),
    unused_steps: str = "",
    unread_sizes: tuple[str, ...] = (),
) -> Surface:
    """Return the heights with their mask: NaN and the ``missing_values`` are unmeasured. `Surface` refuses infinite
    heights. ``unused_steps``: why steps of the file are not its spacing; ``unread_sizes``: lines that may state a
    missing spacing."""
    if spacing is None:
        unread = f"{' and '.join(unread_sizes)} may state it, but without a known name and unit"
        why = unread if unread_sizes else "the file does not state it"
        message = f"spacing of {path.name} is missing: {unused_steps or why}"
        raise InputError(message, allowed="one length or (dx, dy) in m (surface.spacing), dx from line to line")
    measured = ~np.isnan(heights)
    for value in missing_values:
        if value is not None:
            measured &= heights != value
            notes = (*notes, f"missing_value = {value:g}: {np.count_nonzero(heights == value)} points")
    infinite = np.argwhere(measured & np.isinf(heights))
    if infinite.size:
        i, j = infinite[0]
        more = f", and {len(infinite) - 1} more" if len(infinite) > 1 else ""
        message = f" = {heights[i, j]:g}{more}"
        raise InputError(
            message, f"heights[{i}, {j}] of {path.name}", "finite heights, and NaN where nothing was measured"
        )
    if not measured.any():
        raise InputError(f"heights: none of {heights.size} values is measured; allowed: measured heights in m")
    return Surface(np.where(measured, heights * scale, np.nan), spacing, mask=measured, notes=notes)


def _prepared(surface: Surface, *, level: bool, fill: bool, form: str) -> Surface:
    """Return the map without its ``form``, noted with what the other forms would leave, and filled."""
    if not level:
        flat = surface
        with suppress(InputError):  # points that fix no plane
            flat = surface.level()
        check_slopes(flat)
    if level:
        raw = surface
        left = raw.left_by()
        surface = raw.level(form)
        check_slopes(surface)
        words = ", ".join(
            f"{sq * 1e9:.4g} nm {f'without {name}' if name else 'as measured'}" for name, sq in left.items()
        )
        of_waves = raw.left_by(includes_outliers=False)
        advised = advised_form(of_waves)
        if of_waves[advised] < BETTER * of_waves[form]:
            words += f"; if a form is left in the map, give form = {advised!r}"
        surface = replace(surface, notes=(*surface.notes, f"Sq {words}", *_unusual_height(surface.sq)))
    surface = surface.fill() if fill else surface
    return _with_outliers_noted(surface) if fill and level else surface


def _unusual_height(sq: float) -> tuple[str, ...]:
    """Return a note of an ``sq`` [m] that machined surfaces do not have; () where they do."""
    low, high = KEYS["surface.sq"].usual
    if sq == 0 or low <= sq <= high:
        return ()
    return (
        f"Sq {worded(sq, 'm')} is unusual (machined surfaces: {worded(low, 'm')} to {worded(high, 'm')}); check the "
        "unit of the heights",
    )


def _with_outliers_noted(surface: Surface) -> Surface:
    """Return the map with a note of its isolated points, which scenes refuse."""
    count = np.count_nonzero(outliers(surface.heights, surface.mask, surface.periodic_axes) > 0)
    if not count:
        return surface
    stand = "1 isolated point stands above its" if count == 1 else f"{count} isolated points stand above their"
    note = f"{stand} neighbours; give surface.outliers in a scene to mask or keep them (docs/inputs.md)"
    return replace(surface, notes=(*surface.notes, note))


def _read_npy(path: Path) -> np.ndarray:
    """Read a .npy file. It is memory-mapped first, so that its header cannot request more than the file holds."""
    name = f"path = {str(path)!r}"
    try:
        data = np.load(path, mmap_mode="r", allow_pickle=False)
    except Exception as problem:  # the header is Python text: any error of its parser, or of the map made from it
        raise InputError(f"{name} is not a readable .npy array ({validate.shown(str(problem))})") from None
    if not isinstance(data, np.ndarray) or data.dtype.kind not in "iuf" or data.ndim != 2 or data.size == 0:
        message = f" holds {getattr(data, 'dtype', type(data))} of shape {getattr(data, 'shape', None)}"
        raise InputError(message, name, "real numbers with 2 axes [m]")
    points(f"{name}: shape", data.shape)
    return np.array(data)


def _instrument(path: Path) -> Surface:
    """Return the first height map of a file of an instrument unchanged, through the optional package
    SurfaceTopography: unmeasured points NaN, neither levelled nor filled. Its units are not always right (lateral
    units of .nms were found wrong by 1e6): compare ``surface.describe()`` with the instrument's report.

    Raises `InputError` without the package, for a file that it cannot read, for one that names no unit of length.
    """
    name = f"path = {str(path)!r}"
    package = validate.installed("SurfaceTopography", "formats")
    try:
        reader = package.open_topography(str(path))
        channels = [c.name for c in reader.channels]
        topography = reader.topography(channel_index=0)
        heights = topography.heights()
        sizes = topography.physical_sizes
        unit = topography.unit
    except Exception as problem:  # the package raises many kinds for files it cannot read
        message = f" cannot be read by SurfaceTopography ({type(problem).__name__}: {validate.shown(str(problem))})"
        raise InputError(message, name, recommendation="give a complete file of a format it knows") from problem
    if unit not in LENGTH_UNITS:
        raise InputError(
            f": heights are in {validate.shown(unit)}", name, f"a channel of heights in {', '.join(LENGTH_UNITS)}"
        )
    scale = LENGTH_UNITS[unit]
    heights = np.ma.filled(np.ma.asarray(heights, dtype=float), np.nan)
    if heights.ndim == 1:
        refuse_profile(path.name, heights[:, None] * scale, None, ("m", "m", "m"))
    if heights.ndim != 2 or not np.isfinite(heights).any() or sizes is None:
        raise InputError(f" holds {heights.shape} heights", name, "a map with measured points and its size")
    spacing = tuple(size / n * scale for size, n in zip(sizes, heights.shape))
    notes = [f"read by SurfaceTopography, in {unit}"]
    if len(channels) > 1:
        notes.append(f"channel {channels[0]}, the first of {len(channels)}")
    heights = heights * scale
    return Surface(heights, spacing, mask=~np.isnan(heights), source=path.name, notes=tuple(notes))
