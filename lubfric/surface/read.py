"""Height maps from files: .npy, text matrix, .xyz points and X3P; others through an optional package."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from .. import validate
from ..errors import InputError
from .height_map import Surface
from .prepare import FORMS
from .table import DECIMALS
from .text import read_matrix, read_points
from .x3p import read_x3p

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
SUFFIXES = (".npy", ".txt", ".csv", ".asc", ".dat", ".xyz", ".x3p")


def read_surface(path, *, level=True, form="plane", fill=True, spacing=None, unit=None, decimal=None) -> Surface:
    """Read a measured height map; take off its form, then fill what was not measured (the mask stays).

    ==================== ==================================================================
    .npy                 heights[ix, iy]; needs ``spacing``
    .txt .csv .asc .dat  one line of the file is one x; blanks, tabs, commas or semicolons between
                         values; needs ``spacing``, or a line ``# spacing = dx dy`` (m)
    .xyz                 lines "x y z" on a uniform grid, any order; points left out are unmeasured
    .x3p                 ISO 25178-72; x is the fast axis of the file and axis 0 here; metres
    ==================== ==================================================================

    Parameters
    ----------
    path : file
    level, fill : subtract the ``form`` of the measured points; fill the others harmonically
    form : "plane", or "quadratic" (second order: cylinder or paraboloid too); least squares
    spacing : (dx, dy) or one length [m], only for files that do not carry their own
    unit : "m" (default), "mm", "um" or "nm" of the heights (and of x, y in .xyz); not for .x3p
    decimal : "." or ",", the decimal mark of a text file in which commas can be either

    Text: lines that start with # and titles without numbers above the table are skipped (the latter noted in
    ``surface.notes``). A comma between digits is the decimal mark where semicolons, tabs or blanks separate.
    NaN means unmeasured. Raises `InputError` for a file that is missing, truncated, of an unknown kind,
    inconsistent or hostile, for words among the numbers, commas that can be read both ways, a title that names a unit
    when ``unit`` is not given, infinite heights, non-uniform spacing and spacing given twice or not at all.
    Nothing is printed: look at ``surface.describe()`` (size, Sq, missing share) before trusting a file.
    """
    path = Path(path)
    _check_form(level, form)
    if not path.is_file():
        raise InputError(f"path = {str(path)!r}: no such file")
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError(
            f"path = {str(path)!r} has the unknown suffix {suffix!r}; allowed: "
            f"{', '.join(SUFFIXES)} (lubfric.surface.read_instrument_file reads others)"
        )
    if decimal is not None:
        validate.choice("decimal", decimal, DECIMALS)
    if suffix == ".x3p":
        _refuse(suffix, spacing=spacing, unit=unit, decimal=decimal)
        surface = read_x3p(path)
    else:
        surface = _plain(path, suffix, spacing, unit, decimal)
    return _prepared(replace(surface, source=path.name), level, fill, form)


def _plain(path, suffix, spacing, unit, decimal) -> Surface:
    scale = UNITS[validate.choice("unit", "m" if unit is None else unit, UNITS)]
    notes = ()
    if suffix == ".xyz":
        _refuse(suffix, spacing=spacing)
        heights, own, notes = read_points(path, decimal, unit)
        return _masked(heights * scale, (own[0] * scale, own[1] * scale), notes)
    if suffix == ".npy":
        _refuse(suffix, decimal=decimal)
        heights, own = _read_npy(path), None
    else:
        heights, own, notes = read_matrix(path, decimal, unit)
    if own is not None:
        _refuse(suffix, spacing=spacing)
    elif spacing is None:
        raise InputError(
            f"spacing of {path.name} is missing: the file does not carry it; allowed: one length or (dx, dy) in m"
        )
    return _masked(heights * scale, spacing if own is None else own, notes)


def _refuse(suffix, **given) -> None:
    for name, value in given.items():
        if value is not None:
            raise InputError(
                f"{name} = {value!r} is given, and this {suffix} file carries its own or has "
                "none; allowed: leave it out"
            )


def _masked(heights, spacing, notes=()) -> Surface:
    """NaN is unmeasured; infinite heights are refused by `Surface`."""
    measured = ~np.isnan(heights)
    if not measured.any():
        raise InputError(f"heights: all {heights.size} values are NaN; allowed: measured heights in m")
    return Surface(heights, spacing, mask=measured, notes=notes)


def _check_form(level, form) -> None:
    validate.choice("form", form, FORMS)
    if not level and form != FORMS[0]:
        raise InputError(f"form = {form!r} and level = {level!r}; allowed: form = {FORMS[0]!r} with level = False")


def _prepared(surface, level, fill, form) -> Surface:
    if level:
        surface = surface.level(form)
    return surface.fill() if fill else surface


def _read_npy(path) -> np.ndarray:
    """Memory-mapped first, so that a header cannot ask for more than the file holds."""
    try:
        data = np.load(path, mmap_mode="r", allow_pickle=False)
    except (ValueError, OSError, EOFError, SyntaxError, TypeError, OverflowError) as problem:
        raise InputError(f"path = {str(path)!r} is not a readable .npy array ({problem})") from None
    if not isinstance(data, np.ndarray) or data.dtype.kind not in "iuf" or data.ndim != 2 or data.size == 0:
        raise InputError(
            f"path = {str(path)!r} holds {getattr(data, 'dtype', type(data))} of shape "
            f"{getattr(data, 'shape', None)}; allowed: real numbers with 2 axes [m]"
        )
    return np.array(data, dtype=float)


def read_instrument_file(path, *, channel=0, lateral_unit=None, level=True, form="plane", fill=True) -> Surface:
    """Other instrument formats (.sur, .al3d, .opd, ...) through the optional package SurfaceTopography.

    Slow to import (seconds, hundreds of MB), hence only here. Its units are not always right (lateral
    units of .nms were found wrong by 1e6): compare ``surface.describe()`` with the instrument's report.
    ``lateral_unit`` ("m", "mm", "um", "nm") overrules the unit of x and y that the reader found.
    ``level``, ``form`` and ``fill`` as in `read_surface`; ``channel`` is the index of the height channel.
    Raises `InputError` for a file it cannot read or a unit it does not know; ImportError when the package
    is not installed.
    """
    path = Path(path)
    _check_form(level, form)
    if not path.is_file():
        raise InputError(f"path = {str(path)!r}: no such file")
    channel = validate.integer("channel", channel, minimum=0)
    if lateral_unit is not None:
        validate.choice("lateral_unit", lateral_unit, UNITS)
    from SurfaceTopography import open_topography

    try:
        topography = open_topography(str(path)).topography(channel_index=channel)
    except Exception as problem:  # the package raises many kinds for files it cannot read
        raise InputError(f"path = {str(path)!r} cannot be read by SurfaceTopography ({problem})") from problem
    found = "um" if topography.unit in ("µm", "μm") else topography.unit
    vertical = UNITS[validate.choice("unit found in the file", found, UNITS)]
    lateral = UNITS[lateral_unit or found]
    heights = np.ma.filled(np.ma.asarray(topography.heights(), dtype=float), np.nan) * vertical
    spacing = tuple(size / n * lateral for size, n in zip(topography.physical_sizes, heights.shape))
    note = f"read by SurfaceTopography, heights in {found}, lateral in {lateral_unit or found}"
    surface = replace(_masked(heights, spacing), source=path.name, notes=(note,))
    return _prepared(surface, level, fill, form)
