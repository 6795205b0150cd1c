"""Height maps from files: .npy, text matrix, .xyz points and X3P; some 40 formats of instruments through the optional
package SurfaceTopography."""

import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np

from .._base import validate
from ..errors import InputError
from .height_map import Surface
from .prepare import FORMS
from .regrid import points
from .statistics import check_slopes
from .text import DECIMALS, UNITS, read_matrix, read_points
from .x3p import read_x3p

TEXT = (".txt", ".csv", ".asc", ".dat", ".xyz")
OWN_GRID = {".x3p": read_x3p}  # formats that carry their grid and their units, and their readers
SUFFIXES = (".npy", *TEXT, *OWN_GRID)
BETTER = 0.9  # of Sq: a form that leaves less than that is worth a word
# of the formats that SurfaceTopography 1.27 knows; those that lubfric reads itself (.x3p, .xyz, text, .npy) are left
# out
INSTRUMENTS = (
    ".001 .002 .003 .004 .005 .al3d .apx .bcr .bcrf .cur .dat .datx .ezd .frt .gwy .h5 .hfm .hgt .ibw .jpk .lext .mat "
    ".mdt .mi .mnt .nc .nid .nms .npz .oir .opd .opdx .os3d .plu .plux .poir .qep .sdf .spm .stp .sur .tif .tiff .tmd "
    ".tom .top .vk3 .vk4 .vk6 .vk7 .xlsx .zip .zmg .zon"
).split()
HINT = "pip install 'lubfric[formats]'"


def read_surface(
    path, *, level=True, form="plane", fill=True, spacing=None, unit=None, decimal=None, missing_value=None
) -> Surface:
    """Read a measured height map, take off its form, then fill what was not measured (the mask stays).

    ==================== ==================================================================
    .npy                 heights[ix, iy]; needs ``spacing``
    .txt .csv .asc .dat  one line of the file is one x; blanks, tabs, commas or semicolons between
                         values; needs ``spacing``, or a line ``# spacing = dx dy`` (m)
    .xyz                 lines "x y z" on a uniform grid, any order; points left out are unmeasured
    .x3p                 ISO 25178-72; x is the fast axis of the file and axis 0 here; metres
    .sur .al3d .opd ...  every format of SurfaceTopography (``lubfric[formats]``): its first channel
    ==================== ==================================================================

    In a text file, lines that start with # are skipped, and so are titles without numbers above the table (which are
    noted in ``surface.notes``). Headings with one number are read where they name the steps along X and Y with their
    unit ("Step X [um];1.0"), and skipped otherwise. An empty cell is unmeasured. A comma between digits is the decimal
    mark where semicolons, tabs or blanks separate.
    Look at ``surface.describe()`` (size, Sq, max |z|/Sq, missing share) before you trust a file.

    Parameters
    ----------
    path : file
    level, fill : subtract the ``form`` of the measured points; fill the others harmonically
    form : "plane", "cylinder" (about x or y) or "quadratic", by least squares: the F-operation of ISO 25178-2
        (`Surface.filtered` has the S- and L-filters). A note of the surface tells the Sq that each form leaves
    spacing : (dx, dy) or one length [m], only for files that do not carry their own
    unit : "m" (default), "mm", "um" or "µm", "nm" of the heights (and of x, y in .xyz); only where the file names none
    decimal : "." or ",", the decimal mark of a text file in which commas can be either
    missing_value : number for "not measured" in a .npy or text file, in the unit of the file, beside NaN

    Returns a `Surface`.

    Raises
    ------
    InputError : a file that is missing, truncated, of an unknown kind, inconsistent or hostile; words among the
        numbers; commas that can be read both ways; a title that names a unit when ``unit`` is not given; infinite
        heights; non-uniform spacing; spacing given twice or not at all; a levelled map with slopes that no surface has,
        since heights and spacing are then in different units
    """
    path, head = _opened(path)
    validate.choice("form", form, FORMS)
    if not level and form != "plane":
        raise InputError(f"form = {form!r} and level = {level!r}; allowed: form = 'plane' with level = False")
    if decimal is not None:
        validate.choice("decimal", decimal, DECIMALS)
    suffix = path.suffix.lower()
    binary = b"\0" in head and not head.startswith((b"\xff\xfe", b"\xfe\xff"))  # no text: .dat of an interferometer
    by_instrument = suffix in TEXT and binary or suffix not in SUFFIXES and suffix in INSTRUMENTS
    if by_instrument or suffix in OWN_GRID:
        _refuse(suffix, spacing=spacing, unit=unit, decimal=decimal, missing_value=missing_value)
        surface = _instrument(path) if by_instrument else OWN_GRID[suffix](path)
    elif suffix in SUFFIXES:
        surface = _plain(path, suffix, spacing, unit, decimal, missing_value)
    else:
        others = f"with SurfaceTopography ({HINT}) {', '.join(INSTRUMENTS)}"
        said = f"path = {str(path)!r} has the unknown suffix {suffix!r}"
        raise InputError(said, allowed=f"{', '.join(SUFFIXES)}, and {others}")
    return _prepared(replace(surface, source=path.name), level, fill, form)


def _opened(path) -> tuple[Path, bytes]:
    """The path and the first bytes of a file that is there and can be opened."""
    path = validate.folder("path", path)
    if not path.is_file():
        raise InputError(f"path = {validate.shown(str(path))}: no such file")
    try:
        with path.open("rb") as file:
            return path, file.read(4096)
    except OSError as problem:
        raise InputError(f"path = {str(path)!r} cannot be read ({problem})") from None


def _plain(path, suffix, spacing, unit, decimal, missing_value) -> Surface:
    scale = UNITS[validate.choice("unit", "m" if unit is None else unit, UNITS)]
    if missing_value is not None:
        missing_value = validate.number("missing_value", missing_value, "(unit of the file)")
    if suffix == ".xyz":
        _refuse(suffix, spacing=spacing)
        heights, (dx, dy), notes = read_points(path, decimal, unit)
        return _masked(heights, scale, missing_value, (dx * scale, dy * scale), notes)
    if suffix == ".npy":
        _refuse(suffix, decimal=decimal)
        heights = _read_npy(path)
        own = None
        notes = ()
        with np.errstate(over="ignore"):
            if heights.dtype.kind == "f" and missing_value is not None:
                missing_value = float(heights.dtype.type(missing_value))  # in the precision of the file
            heights = heights.astype(float)
    else:
        heights, own, notes = read_matrix(path, decimal, unit)
    if own is not None:
        _refuse(suffix, spacing=spacing)
    elif spacing is None:
        why = next((note for note in notes if note.startswith("steps of")), "the file does not carry it")
        said = f"spacing of {path.name} is missing: {why}"
        raise InputError(said, allowed="one length or (dx, dy) in m (surface.spacing), dx from line to line")
    return _masked(heights, scale, missing_value, spacing if own is None else own, notes)


def _refuse(suffix, **given) -> None:
    for name, value in given.items():
        if value is not None:
            said = f" = {value!r} is given, and this {suffix} file carries its own or has none"
            raise InputError(said, name, way_out="leave it out")


def _masked(heights, scale, missing_value, spacing, notes) -> Surface:
    """The heights with their mask: NaN and ``missing_value`` are unmeasured. `Surface` refuses infinite heights."""
    measured = ~np.isnan(heights)
    if missing_value is not None:
        measured &= heights != missing_value
        notes = (*notes, f"missing_value = {missing_value:g}: {np.count_nonzero(heights == missing_value)} points")
    if not measured.any():
        raise InputError(f"heights: none of {heights.size} values is measured; allowed: measured heights in m")
    return Surface(np.where(measured, heights * scale, np.nan), spacing, mask=measured, notes=notes)


def _prepared(surface, level, fill, form) -> Surface:
    """The map without its ``form``, noted with what the other forms would leave, and filled."""
    if level:
        left, surface = surface.left_by(), surface.level(form)
        check_slopes(surface)
        words = ", ".join(f"{sq * 1e9:.4g} nm {f'without {name}' if name else 'as it is'}" for name, sq in left.items())
        least = min(left, key=lambda name: left[name])
        if left[least] < BETTER * left[form]:
            words += f"; a form is left in it? give form = {least!r}"
        surface = replace(surface, notes=(*surface.notes, f"Sq {words}"))
    return surface.fill() if fill else surface


def _read_npy(path) -> np.ndarray:
    """Read a .npy file. It is memory-mapped first, so that its header cannot ask for more than the file holds."""
    name = f"path = {str(path)!r}"
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            data = np.load(path, mmap_mode="r", allow_pickle=False)
    except Exception as problem:  # the header is Python text: any error of its parser, or of the map made from it
        raise InputError(f"{name} is not a readable .npy array ({validate.shown(str(problem))})") from None
    if not isinstance(data, np.ndarray) or data.dtype.kind not in "iuf" or data.ndim != 2 or data.size == 0:
        said = f" holds {getattr(data, 'dtype', type(data))} of shape {getattr(data, 'shape', None)}"
        raise InputError(said, name, "real numbers with 2 axes [m]")
    points(f"{name}: shape", data.shape)
    return np.array(data)


def _instrument(path: Path) -> Surface:
    """The first height map of a file of an instrument as it stands, through the optional package SurfaceTopography:
    unmeasured points NaN, neither levelled nor filled. Its units are not always right (lateral units of .nms were found
    wrong by 1e6): compare ``surface.describe()`` with the instrument's report.

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
        found = topography.unit
    except Exception as problem:  # the package raises many kinds for files it cannot read
        said = f" cannot be read by SurfaceTopography ({type(problem).__name__}: {validate.shown(str(problem))})"
        raise InputError(said, name, way_out="give a complete file of a format it knows") from problem
    if found not in UNITS:
        raise InputError(f": heights are in {found!r}", name, f"a channel of heights in {', '.join(UNITS)}")
    heights = np.ma.filled(np.ma.asarray(heights, dtype=float), np.nan)
    if heights.ndim != 2 or not np.isfinite(heights).any():
        raise InputError(f" holds {heights.shape} heights", name, "a map with measured points")
    spacing = tuple(size / n * UNITS[found] for size, n in zip(sizes, heights.shape))
    notes = [f"read by SurfaceTopography, in {found}"]
    if len(channels) > 1:
        notes.append(f"channel {channels[0]}, the first of {len(channels)}")
    heights = heights * UNITS[found]
    return Surface(heights, spacing, mask=~np.isnan(heights), source=path.name, notes=tuple(notes))
