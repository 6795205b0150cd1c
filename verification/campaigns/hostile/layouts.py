"""Maps and curves as metrologists and rigs export them, in random layouts: each is read as what it is, or refused.

A case that reads something else than what was written raises `MisreadError`, which counts as a raw error. The classes
are the functions of `KINDS`.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

import lubfric

from ...types import Keywords, Option
from .case import HostileCase

# Spacing of the maps along x and y [m].
STEPS = (0.5e-6, 0.8e-6)

# Units of lengths in the files, and their values [m].
UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "\u00b5m": 1e-6, "nm": 1e-9}

# Units of speeds in the files, and their values [m/s].
SPEED_UNITS = {"m/s": 1.0, "mm/s": 1e-3, "um/s": 1e-6, "cm/s": 1e-2, "m/min": 1.0 / 60.0}

# Marks of a point that was not measured.
MARKS = ("No Data", "NoData", "BAD", "Bad", "---", "-", "*", "***", "NaN", "n/a", "#N/A", "null", "1.#QNAN", "#NV", "")

Draw = np.random.Generator
Write = Callable[[Path], object]


class MisreadError(Exception):
    """A file was read as something else than what was written into it."""


def rough_map(draw: Draw) -> np.ndarray:
    """Return smooth random heights (nx, ny) [m]."""
    shape = tuple(int(n) for n in draw.integers(8, 30, 2))
    waves = draw.uniform(0.05, 0.25, (6, 2))
    phases = draw.uniform(0.0, 2.0 * np.pi, 6)
    i, j = np.indices(shape)
    z = sum(np.sin(2 * np.pi * (u * i + v * j) + phase) for (u, v), phase in zip(waves, phases))
    return np.asarray(4e-8 * z)


def lines_of(table: np.ndarray, separator: str, mark: str = "nan", *, comma: bool = False) -> str:
    """Return a table as text; NaN as ``mark``."""
    rows = [separator.join(mark if np.isnan(value) else f"{value:.9e}" for value in row) for row in table]
    text = "\n".join(rows) + "\n"
    return text.replace(".", ",") if comma else text


def read_map(path: Path, heights: np.ndarray | None, **given: Option) -> str:
    """Read the map at ``path``. Raise `MisreadError` where it is not ``heights`` (None: where it is anything)."""
    surface = lubfric.read_surface(path, level=False, fill=False, **given)
    if heights is None:
        raise MisreadError(f"{path.name} is read as a map of {surface.shape}")
    same = surface.shape == heights.shape and np.allclose(
        surface.heights, heights, rtol=1e-5, atol=1e-12, equal_nan=True
    )
    if not same or not np.allclose(surface.spacing, STEPS, rtol=0.02):
        raise MisreadError(f"{path.name}: shape {surface.shape}, spacing {surface.spacing}, Sq {surface.sq:.3g} m")
    return surface.describe()


def plain_matrix(draw: Draw, folder: Path) -> str:
    """Return a matrix with any separator, decimal mark and encoding."""
    z = rough_map(draw)
    unit = str(draw.choice(list(UNITS)))
    separator = str(draw.choice(["\t", ";", " ", "   ", "; "]))
    text = lines_of(z / UNITS[unit], separator, comma=bool(draw.random() < 0.4))
    path = folder / f"map{draw.choice(['.txt', '.csv', '.asc', '.dat'])}"
    path.write_bytes(text.encode(str(draw.choice(["utf-8", "utf-8-sig", "utf-16", "cp1252"]))))
    return read_map(path, z, spacing=STEPS, unit=unit)


def header_of(draw: Draw, z: np.ndarray, unit: str) -> str:
    """Return statements of a header in random order and spelling."""
    lateral = str(draw.choice(list(UNITS)))
    mark = str(draw.choice([": ", " = ", ";", "\t"]))
    statements = [
        f"Step X [{lateral}]{mark}{STEPS[0] / UNITS[lateral]:.8g}",
        f"Step Y [{lateral}]{mark}{STEPS[1] / UNITS[lateral]:.8g}",
        f"X points{mark}{z.shape[0]}",
        f"Y points{mark}{z.shape[1]}",
        f"Z unit{mark}{unit}",
        "Operator: J. Doe",
        "Date: 2026-11-20 10:11:12",
        "Comment: run 3, part 7",
    ]
    begin = str(draw.choice(["", "# ", "#"]))
    return "".join(f"{begin}{statements[place]}\n" for place in draw.permutation(len(statements)))


def header(draw: Draw, folder: Path) -> str:
    """Return a header in any order above a matrix whose lines run along x or along y; a square table is not decided by
    it."""
    z = rough_map(draw)[:, :7]
    unit = str(draw.choice(list(UNITS)))
    table = z.T if draw.random() < 0.5 else z
    path = folder / "map.txt"
    path.write_text(header_of(draw, z, unit) + lines_of(table / UNITS[unit], "\t"), encoding="utf-8")
    return read_map(path, z)


def contradiction(draw: Draw, folder: Path) -> str:
    """Return a spacing or a unit that the header contradicts, two lines that do, or a header of another table."""
    z = rough_map(draw)
    unit = str(draw.choice(["m", "mm", "nm"]))
    text = header_of(draw, z, unit)
    given: Keywords = {}
    kind = int(draw.integers(4))
    if kind == 0:
        given["spacing"] = (10 * STEPS[0], 10 * STEPS[1])
    elif kind == 1:
        given["unit"] = "um"
    elif kind == 2:
        text += "Step X [um]: 7.5\n"
    else:
        text += f"X points: {z.shape[0] + 1}\n"
    path = folder / "map.txt"
    path.write_text(text + lines_of(z.T / UNITS[unit], "\t"), encoding="utf-8")
    return read_map(path, None, **given)


def points(draw: Draw, folder: Path) -> str:
    """Return points x y z in any order, with a unit for each column, from the file or the caller."""
    z = rough_map(draw)
    i, j = np.indices(z.shape).reshape(2, -1)
    lateral, unit = (str(draw.choice(list(UNITS))) for _ in range(2))
    scales = [UNITS[lateral], UNITS[lateral], UNITS[unit]]
    table = np.stack([i * STEPS[0], j * STEPS[1], z.ravel()], axis=1) / scales
    heads = [f"X [{lateral}];Y [{lateral}];Z [{unit}]\n", f"x/{lateral} y/{lateral} z/{unit}\n", ""]
    heads += [f"# x ({lateral}), y ({lateral}), z ({unit})\n", f"X;Y;Z\n{lateral};{lateral};{unit}\n"]
    head = str(draw.choice(heads))
    given: Keywords = {} if head else {"unit": (lateral, unit)}
    path = folder / f"map{draw.choice(['.xyz', '.txt', '.csv', '.dat', '.asc'])}"
    text = head + lines_of(table[draw.permutation(len(table))], str(draw.choice([";", "\t", "  "])))
    path.write_text(text, encoding="utf-8")
    return read_map(path, z, **given)


def profile(draw: Draw, folder: Path) -> str:
    """Return a stylus trace: one column, a row, x and z, with an index, two traces; it is no map."""
    z = np.resize(rough_map(draw).ravel(), int(draw.integers(50, 400))) * 1e6
    x = np.arange(z.size) * STEPS[0] * 1e3
    tables = [z[:, None], z[None], np.stack([x, z], 1), np.stack([x, z, z], 1), np.stack([np.arange(z.size), x, z], 1)]
    table = tables[int(draw.integers(len(tables)))]
    suffix = str(draw.choice([".txt", ".csv", ".dat", ".npy"]))
    path = folder / f"trace{suffix}"
    if suffix == ".npy":
        np.save(path, table)
    else:
        path.write_text(lines_of(table, ";"))
    return read_map(path, None, spacing=STEPS, unit="um")


def coordinates(draw: Draw, folder: Path) -> str:
    """Return coordinates in the first row, the first column, or both."""
    z = rough_map(draw)
    lateral, unit = (str(draw.choice(list(UNITS))) for _ in range(2))
    table = np.zeros((z.shape[0] + 1, z.shape[1] + 1))
    table[0, 1:] = np.arange(z.shape[1]) * STEPS[1] / UNITS[lateral] + draw.choice([0.0, 3.25])
    table[1:, 0] = np.arange(z.shape[0]) * STEPS[0] / UNITS[lateral]
    table[1:, 1:] = z / UNITS[unit]
    kind = int(draw.integers(3))
    path = folder / "map.csv"
    path.write_text(lines_of((table, table[1:], table[:, 1:])[kind], ";"))
    return read_map(path, z, spacing=STEPS, unit=unit)


def missing(draw: Draw, folder: Path) -> str:
    """Return points that were not measured, marked in one of many ways."""
    z = rough_map(draw)
    z[draw.random(z.shape) < 0.08] = np.nan
    mark = str(draw.choice(MARKS))
    path = folder / "map.csv"
    path.write_text(lines_of(z * 1e6, str(draw.choice([";", "\t", ","])), mark))
    return read_map(path, z, spacing=STEPS, unit="um")


def odd_rows(draw: Draw, folder: Path) -> str:
    """Return a line that is too short or too long, a word, a footer, a second heading."""
    lines = lines_of(rough_map(draw) * 1e6, ";").splitlines()
    place = int(draw.integers(1, len(lines)))
    kind = int(draw.integers(5))
    if kind == 0:
        lines[place] = lines[place].rpartition(";")[0]
    elif kind == 1:
        lines[place] += ";1.0"
    elif kind == 2:
        lines[place] = f"word;{lines[place].partition(';')[2]}"
    else:
        lines.insert(len(lines) if kind == 3 else place, "End of data" if kind == 3 else "Channel 2")
    path = folder / "map.csv"
    path.write_text("\n".join(lines) + "\n")
    return read_map(path, None, spacing=STEPS, unit="um")


def rig_curve(draw: Draw, folder: Path) -> str:
    """Return a curve of a rig: preamble, units in the headings or below them, ramps, decimal commas, any encoding."""
    count = int(draw.integers(3, 9))
    unit = str(draw.choice(list(SPEED_UNITS)))
    speed = np.sort(10 ** draw.uniform(-3, 0, count))
    friction = draw.uniform(0.01, 0.15, count)
    separator = str(draw.choice([";", "\t", ",", "   "]))
    ramp = np.concatenate([np.arange(count), np.arange(count)[:: -1 if draw.random() < 0.5 else 1]])
    order = ramp if draw.random() < 0.4 and ramp[count] == count - 1 else np.arange(count)
    headings = [["Speed [%s]" % unit, "CoF", "Load [N]"], ["Speed", "CoF", "Load"]]
    below = bool(draw.random() < 0.5)
    text = "Operator: A. B.\nDate;2026-11-20\nDisc, ball\n"[: int(draw.choice([0, 16, 40]))]
    text = text[: text.rfind("\n") + 1] + separator.join(headings[below]) + "\n"
    text += separator.join([unit, "-", "N"]) + "\n" if below else ""
    rows = "".join(f"{speed[k] / SPEED_UNITS[unit]:.8g}{separator}{friction[k]:.8g}{separator}5\n" for k in order)
    text += rows.replace(".", ",") if separator != "," and draw.random() < 0.4 else rows
    path = folder / "rig.csv"
    path.write_bytes(text.encode(str(draw.choice(["utf-8", "utf-8-sig", "cp1252", "utf-16"]))))
    measured = lubfric.read_measured(path, speed="Speed", coefficient="CoF")
    expected = np.sort(speed[order])
    if measured.x.shape != expected.shape or not np.allclose(measured.x, expected, rtol=1e-6):
        raise MisreadError(f"speeds {measured.x} in place of {expected}")
    if not np.allclose(np.sort(measured.coefficient), np.sort(friction[order]), rtol=1e-6):
        raise MisreadError(f"coefficients {measured.coefficient}")
    return f"{measured.x.size} points"


def iso_text(draw: Draw, folder: Path) -> str:
    """Return ISO 25178-71 or BCR as text: any number of heights in a line, any scale."""
    z = rough_map(draw)
    z[draw.random(z.shape) < 0.05] = np.nan
    scale = 10.0 ** -int(draw.integers(0, 10))
    fields = {"ManufacID": "lab", "CreateDate": "010120261200", "NumPoints": z.shape[0], "NumProfiles": z.shape[1]}
    fields |= {"Xscale": STEPS[0], "Yscale": STEPS[1], "Zscale": scale, "Zresolution": -1, "Compression": 0}
    text = f"{draw.choice(['aISO-1.0', 'aISO-2.0', 'aBCR-1.0'])}\n"
    text += "".join(f"{name.ljust(int(draw.integers(20)))} = {value}\n" for name, value in fields.items()) + "*\n"
    words = ["BAD" if np.isnan(value) else f"{value / scale:.9e}" for value in z.T.ravel()]
    width = int(draw.integers(1, 40))
    text += "\n".join(" ".join(words[k : k + width]) for k in range(0, len(words), width)) + "\n*\n"
    text += str(draw.choice(["*\n", "", "Comment = 3 ; x\n*\n", "<Name> a * b </Name>\n*\n"]))
    path = folder / f"map{draw.choice(['.sdf', '.bcr', '.txt', '.asc'])}"
    path.write_text(text.replace("\n", str(draw.choice(["\n", "\r\n"]))), newline="")
    return read_map(path, z)


def surfer_grid(draw: Draw, folder: Path) -> str:
    """Return a text grid of Surfer with its origin anywhere, in any units."""
    z = rough_map(draw)
    z[draw.random(z.shape) < 0.05] = np.nan
    lateral, unit = (str(draw.choice(list(UNITS))) for _ in range(2))
    ends = []
    for count, step in zip(z.shape, STEPS):
        low = float(draw.uniform(-1, 1)) * count * step
        ends.append(f"{low / UNITS[lateral]:.12g} {(low + (count - 1) * step) / UNITS[lateral]:.12g}")
    values = z.T / UNITS[unit]
    text = f"DSAA\n{z.shape[0]} {z.shape[1]}\n{ends[0]}\n{ends[1]}\n{np.nanmin(values):.6g} {np.nanmax(values):.6g}\n"
    for row in np.where(np.isnan(values), 1.70141e38, values):
        text += " ".join(f"{value:.9g}" for value in row) + "\n" + "\n" * int(draw.integers(2))
    path = folder / f"map{draw.choice(['.grd', '.txt', '.dat'])}"
    path.write_text(text)
    return read_map(path, z, unit=(lateral, unit))


def unit_elsewhere(draw: Draw, folder: Path) -> str:
    """Return lengths whose unit another line states, in any order of the lines."""
    kind = int(draw.integers(3))
    z = rough_map(draw)
    if kind == 1:
        z = z[:, :7]  # a square table does not say along which axis its lines run
    lateral, unit = (str(draw.choice(list(UNITS))) for _ in range(2))
    nx, ny = z.shape
    steps = [step / UNITS[lateral] for step in STEPS]
    lines = [f"x-pixels: {nx}", f"y-pixels: {ny}", f"x-unit: {lateral}", f"y-unit: {lateral}", f"z-unit: {unit}"]
    if kind == 0:
        lines += [f"x-length: {nx * steps[0]:.9g}", f"y-length: {ny * steps[1]:.9g}"]
    elif kind == 1:
        lines += [f"Step X = {steps[0]:.9g}", f"Step Y = {steps[1]:.9g}"]
    else:
        lines = [f"NX = {nx}", f"NY = {ny}", f"Scale X = {steps[0]:.9g}", f"Scale Y = {steps[1]:.9g}"]
        lines += [f"Unit X = {lateral}", f"Unit Y = {lateral}", f"Unit Data = {unit}"]
    begin = "# " if kind == 0 else ""
    text = "".join(f"{begin}{lines[place]}\n" for place in draw.permutation(len(lines)))
    path = folder / f"map{draw.choice(['.txt', '.asc'])}"
    path.write_text(text + lines_of(z.T / UNITS[unit], "\t"), encoding="utf-8")
    return read_map(path, z)


def sign(draw: Draw, folder: Path) -> str:
    """Return a header that says that the heights are inverted."""
    z = rough_map(draw)
    words = ["Inverted: Yes", "inverted = 1", "Replica: true", "Z axis positive down", "Inversion; on", "Depth (um)"]
    head = header_of(draw, z, "um") + f"{draw.choice(words)}\n"
    path = folder / "map.txt"
    path.write_text(head + lines_of(z.T * 1e6, "\t"), encoding="utf-8")
    return read_map(path, None)


def thousands(draw: Draw, folder: Path) -> str:
    """Return numbers with a mark for thousands."""
    z = np.rint(rough_map(draw) * 1e9) + 10 ** int(draw.integers(4, 6))
    mark = str(draw.choice([",", "'", " ", "\u00a0", "\u2009", "_"]))
    path = folder / "map.csv"
    path.write_text("\n".join(";".join(f"{v:,.0f}".replace(",", mark) for v in row) for row in z), encoding="utf-8")
    return read_map(path, None, spacing=STEPS, unit="nm")


READ = (  # each must be read
    plain_matrix,
    header,
    points,
    coordinates,
    missing,
    rig_curve,
    iso_text,
    surfer_grid,
    unit_elsewhere,
)
REFUSED = (contradiction, profile, odd_rows, sign, thousands)  # each must be refused
KINDS = (*READ, *REFUSED)


def cases(draw: Draw, count: int) -> Iterator[HostileCase]:
    """Yield ``count`` cases: in turn one of each class."""
    for number in range(count):
        kind = KINDS[number % len(KINDS)]
        seed = int(draw.integers(2**31))
        yield HostileCase("layout", f"{kind.__name__} {seed}", _run(kind, seed), kind in READ)


def _run(kind: Callable[[Draw, Path], str], seed: int) -> Write:
    def run(folder: Path) -> object:
        try:
            return kind(np.random.default_rng(seed), folder)
        except lubfric.InputError as error:
            if kind in READ:
                raise MisreadError(f"refused: {error}") from None
            raise

    return run
