"""Files of instruments, through the optional package SurfaceTopography (about 40 formats)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .._base import validate
from ..errors import InputError
from .height_map import Surface

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "\N{MICRO SIGN}m": 1e-6, "\N{GREEK SMALL LETTER MU}m": 1e-6, "nm": 1e-9}

# of the formats that SurfaceTopography 1.27 knows; those that lubfric reads itself (.x3p, .xyz, text, .npy) are left
# out
SUFFIXES = tuple(
    f".{word}"
    for word in (
        "001 002 003 004 005 al3d apx bcr bcrf cur dat datx ezd frt gwy h5 hfm hgt ibw jpk lext mat mdt mi mnt nc nid "
        "nms npz oir opd opdx os3d plu plux poir qep sdf spm stp sur tif tiff tmd tom top vk3 vk4 vk6 vk7 xlsx zip "
        "zmg zon"
    ).split()
)
HINT = "pip install 'lubfric[formats]'"


def read_instrument(path: Path, channel: int, lateral_unit: str | None) -> Surface:
    """The height map as it stands: unmeasured points NaN, neither levelled nor filled.

    Raises `InputError` without the package, for a file that it cannot read, for one that names no unit of length.
    """
    name, open_topography = f"path = {str(path)!r}", _package(path)
    try:
        reader = open_topography(str(path))
        channels = [c.name for c in reader.channels]
        topography = reader.topography(channel_index=channel)
        heights, sizes, found = topography.heights(), topography.physical_sizes, topography.unit
    except Exception as problem:  # the package raises many kinds for files it cannot read
        said = f", channel {channel}, cannot be read by SurfaceTopography"
        why = f"({type(problem).__name__}: {validate.shown(str(problem))})"
        raise InputError(f"{said} {why}", name, way_out="give a complete file of a format it knows") from problem
    if found not in UNITS:
        raise InputError(f": heights are in {found!r}", name, f"a channel of heights in {', '.join(UNITS)}")
    heights = np.ma.filled(np.ma.asarray(heights, dtype=float), np.nan)
    if heights.ndim != 2 or not np.isfinite(heights).any():
        raise InputError(f" holds {heights.shape} heights", name, "a map with measured points")
    spacing = tuple(size / n * UNITS[lateral_unit or found] for size, n in zip(sizes, heights.shape))
    notes = [f"read by SurfaceTopography, heights in {found}, lateral in {lateral_unit or found}"]
    if len(channels) > 1:
        notes.append(f"channel {channel} ({channels[channel]}) of {len(channels)}")
    heights = heights * UNITS[found]
    return Surface(heights, spacing, mask=~np.isnan(heights), source=path.name, notes=tuple(notes))


def _package(path: Path):
    """SurfaceTopography's reader; imported here only, since that takes seconds and hundreds of MB."""
    import warnings

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of other packages, at their import
            from SurfaceTopography import open_topography
    except ImportError as problem:
        said = f"path = {str(path)!r} needs the package SurfaceTopography, which is not installed ({problem})"
        raise InputError(said, way_out=f"it is read after {HINT}; or convert it to .x3p") from None
    return open_topography
