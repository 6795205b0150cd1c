"""Height maps as Zygo's programs MetroPro and Mx export them to text: points (format 1) and phases (format 2).

The layout is that of the files: a header of fixed lines up to one with "#", blocks of numbers that end with "#".
"""

from pathlib import Path

import numpy as np

from .._base import FloatArray
from ..errors import InputError
from .header import LENGTH_UNITS

POINTS_TITLE = "Zygo XYZ Data File"
PHASES_TITLE = "Zygo ASCII Data File"

# Lines of the header, at most: programs write 13 or 14. A choice: more searches files that are no maps.
LONGEST_HEADER = 40

# Lines of the header (from 0) with the size of the intensities, the size of the map, the optics, and the phase
# resolution. By definition of the format.
INTENSITIES = 2
SIZE = 3
OPTICS = 7
RESOLUTION_LINE = 10

# Counts of a phase in one wave, by the code of the phase resolution: by definition of the format.
COUNTS_OF_A_WAVE = {0: 4096, 1: 32768, 2: 131072}

# A phase from which on a point is unmeasured.
UNMEASURED_PHASE = 2147483640


def read_zygo(
    path: Path, text: str, units: tuple[str, str, str] | None
) -> tuple[FloatArray, tuple[float, float] | None, tuple[str, ...]]:
    """Return the heights[ix, iy] [m] of a file, NaN where unmeasured; its spacing [m], None where its camera was not
    calibrated; and notes. ``units``: as the caller gives them, because a list of points does not state that of its
    heights.

    Raises `InputError` for a file that is cut off or of another layout, and for a unit that is missing or not needed.
    """
    name = f"path = {str(path)!r}"
    lines = [line.strip() for line in text.splitlines()]
    try:
        end = lines.index("#", 0, LONGEST_HEADER)
        header = [line.split() for line in lines[:end]]
        x0, y0, nx, ny = (int(word) for word in header[SIZE][:4])
        optics = [float(word) for word in header[OPTICS][:7]]
        pitch = optics[6]
        resolution = int(header[RESOLUTION_LINE][0])
        intensities = int(header[INTENSITIES][2]) * int(header[INTENSITIES][3])
    except (ValueError, IndexError):
        message = f"{name} begins as a text file of Zygo, but its header has another layout"
        raise InputError(message, recommendation="export it from MetroPro or Mx again, or as .x3p or .datx") from None
    blocks = _blocks(lines[end + 1 :])
    if not (nx > 0 and ny > 0 and nx * ny <= len(text) and np.isfinite(optics).all() and pitch >= 0 and blocks):
        raise InputError(f"{name} is cut off, or states a map of {nx} x {ny} points with a pixel of {pitch:g} m")
    if text.startswith(POINTS_TITLE):
        if units is None:
            message = f"{name} is a list of points of Zygo, which does not state the unit of its heights"
            way = "give unit: MetroPro writes 'um'; Mx writes the unit that was set (for waves: export again in nm)"
            raise InputError(message, recommendation=way)
        heights = LENGTH_UNITS[units[2]] * _points(name, blocks[0], (x0, y0), (nx, ny))
        notes: tuple[str, ...] = (f"points of Zygo, heights in {units[2]} as given",)
    else:
        if units is not None:
            raise InputError(f"unit = {units[2]!r} is given, and {name} states its own", recommendation="omit it")
        waves = COUNTS_OF_A_WAVE.get(resolution)
        scale = optics[1] * optics[2] * optics[4]
        if waves is None or not scale > 0:
            message = f"{name} has the phase resolution {resolution} and {scale:g} m a wave"
            raise InputError(message, allowed=f"{', '.join(map(str, COUNTS_OF_A_WAVE))}, and a wave above 0")
        heights = scale / waves * _phases(name, blocks[-1], len(blocks) - 1, intensities, (nx, ny))
        notes = (f"phases of Zygo, {scale / waves:.6g} m each",)
    return heights, (pitch, pitch) if pitch > 0 else None, notes


def _blocks(lines: list[str]) -> list[list[str]]:
    """Return the lines of the blocks, each up to the "#" that ends it; what no "#" ends is cut off."""
    blocks: list[list[str]] = []
    block: list[str] = []
    for line in lines:
        if line == "#":
            blocks.append(block)
            block = []
        elif line:
            block.append(line)
    return [] if block else blocks


def _points(name: str, lines: list[str], origin: tuple[int, int], shape: tuple[int, int]) -> FloatArray:
    """Return the heights of lines "column row height", the last "No Data" where unmeasured."""
    words = " ".join(lines).replace("No Data", "nan").split()
    try:
        table = np.array(words, float).reshape(-1, 3)
        place = table[:, :2].astype(int)
    except ValueError:
        raise InputError(f"{name} has lines that are not: column, row, height or No Data") from None
    place -= np.where((place < np.array(shape)).all() and (place == 0).any(axis=0).all(), (0, 0), origin)
    inside = (place >= 0).all() and (place < np.array(shape)).all() and (table[:, :2] % 1 == 0).all()
    flat = place[:, 0] * shape[1] + place[:, 1]
    if not inside or np.unique(flat).size < flat.size:
        raise InputError(f"{name} has points twice, or outside of the {shape[0]} x {shape[1]} that it states")
    heights = np.full(shape[0] * shape[1], np.nan)
    heights[flat] = table[:, 2]
    return heights.reshape(shape)


def _phases(name: str, lines: list[str], before: int, intensities: int, shape: tuple[int, int]) -> FloatArray:
    """Return the phases of rows along x, after as many blocks as there are of ``intensities``."""
    try:
        phases = np.array(" ".join(lines).split(), float)
    except ValueError:
        raise InputError(f"{name} has phases that are not numbers") from None
    if phases.size != shape[0] * shape[1] or before > (intensities > 0):
        raise InputError(f"{name} has {phases.size} phases, and states {shape[0]} x {shape[1]}")
    return np.where(phases >= UNMEASURED_PHASE, np.nan, phases).reshape(shape[1], shape[0]).T
