"""What the lines above a table of heights say: numbers of points, steps, extents, units, the mark of a missing point.

Programs of instruments write such lines in their own words and order. They are read as statements, each some words, a
number or two, and a unit; the words decide what the statement is about. Two statements that contradict each other, or
the table below, are an `InputError`.
"""

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from .._base import validate
from ..errors import InputError
from ..units import UNITS as KINDS
from ..units import spelled

LENGTH_UNITS = {name: KINDS["m"][spelled(name)] for name in ("m", "mm", "um", "µm", "μm", "nm")}  # both signs of micro
UNIT_WORDS = {"mm": "mm", "um": "um", "µm": "um", "μm": "um", "micron": "um", "microns": "um", "nm": "nm", "m": "m"}
UNIT_WORDS |= {"millimeter": "mm", "millimeters": "mm", "micrometer": "um", "micrometers": "um", "nanometer": "nm"}
UNIT_WORDS |= {"nanometers": "nm", "metre": "m", "meter": "m", "meters": "m", "cm": "cm", "in": "in", "inch": "in"}

# m of a unit: by definition (SI; the inch since 1959).
LENGTHS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "cm": 1e-2, "in": 0.0254}

# Characters of a line that is read as statements; a longer one is a title. A choice: more reads titles as statements.
LONGEST_STATEMENT = 400

# Relative difference up to which two statements of one length agree. A choice: they are printed to few digits.
SAME_LENGTH = 0.01

# Gwyddion translates the words of its text export; SurfaceTopography has the same list.
WIDTH_WORDS = {"width", "šířka", "breite", "anchura", "largeur", "larghezza", "幅", "폭", "largura", "ширина"}
HEIGHT = {"height", "výška", "höhe", "altura", "hauteur", "altezza", "高さ", "높이", "высота"}
VALUE_UNIT = {"value", "values", "hodnot", "einheiten", "unités", "valore", "値の単位", "값", "valor", "измерения"}
UNIT = {"unit", "units", "einheit", "단위", "単位"}
STEP_WORDS = {
    "step",
    "steps",
    "spacing",
    "increment",
    "pitch",
    "pixel",
    "pixelsize",
    "cellsize",
    "interval",
    "dx",
    "dy",
    "schrittweite",
    "schritt",
    "abstand",
    "punktabstand",
    "pixelabstand",
    "pixelgröße",
}
SCALE = "scale "  # begins the name of a step that only Nova calls so
CALIBRATION = {"calibration", "justierung", "캘리브레이션"}  # "XY calibration" of Keyence: the step of x and y
COUNT_WORDS = {
    "horizontal",
    "vertical",
    "horizont",
    "vertikal",
    "가로",
    "세로",
    "points",
    "pixels",
    "size",
    "samples",
    "number",
    "no",
    "num",
    "n",
    "resolution",
    "count",
    "res",
    "anzahl",
    "punkte",
    "messpunkte",
    "punktzahl",
}
POINT_WORDS = {"points", "pixels", "punkte", "messpunkte", "punktzahl"}
VALUE_WORDS = {"samples", "values", "werte"}  # points, where they are so many per line
COLUMN_WORDS = {"columns", "cols", "ncols", "ncolumns", "column", "numcols", "spalten", "spaltenzahl"}
LINE_WORDS = {"rows", "nrows", "lines", "profiles", "numrows", "nlines", "zeilen", "zeilenzahl", "profilzahl"}
PER_WORDS = {"per", "pro", "je"}
ONE_LINE_WORDS = {"line", "profile", "row", "zeile", "profil"}
EXTENT_WORDS = {"length", "range", "extent", "size", "scan", "width", "field"}
EXTENT_WORDS |= {"länge", "messlänge", "ausdehnung", "bereich", "breite", "höhe"}
# Words of lines that do not state the lateral grid: a step of time, a place of the stage.
NO_GRID_WORDS = {"time", "speed", "date", "zeit", "geschwindigkeit", "datum"}
NO_GRID_WORDS |= {"position", "stage", "offset", "origin", "center", "centre", "start", "shift", "mitte", "ort"}
MISSING_WORDS = {"nodata", "missing", "invalid", "void", "undefined", "bad"}
AXES = {"x": "x", "y": "y", "z": "z", "dx": "x", "dy": "y", "nx": "x", "ny": "y", "xres": "x", "yres": "y"}
AXES |= {"horizontal": "x", "vertical": "y", "xscale": "x", "yscale": "y", "zscale": "z"}
AXES |= {"horizont": "x", "vertikal": "y", "가로": "x", "세로": "y"}
DOWN = {"down", "downward", "downwards"}
INVERTED = {"inverted", "invert", "inversion", "replica"}
TRUE = {"yes", "true", "on", "ja", "oui", "1"}

_DIGITS = r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?"
_STATED_NUMBER = re.compile(_DIGITS)
_GLUED = re.compile(rf"({_DIGITS})([a-zµμ]+)")  # '10µm'
_MARKED = re.compile(r"[\[(]\s*([^\[\]()\s]{1,12})\s*[\])]|/(mm|um|µm|μm|nm|m)(?![\w/])")  # '[um]', '/mm'
_PER_POINT = re.compile(r"(?<![a-zµμ])(mm|um|µm|μm|nm|m)\s?/\s?(?:pixel|px|point|pt|sample)s?(?!\w)", re.I)  # of a step
_OF_AXIS = re.compile(r"(?<![^\W_])([xyz])_(?=(?:mm|um|µm|μm|nm|m)(?![^\W_]))", re.I)  # 'X_mm'
_UNIT = "\x01"  # before a word that a bracket or a slash marks as a unit
_BETWEEN = re.compile(r"[\s:=;：\"'|<>#{}]+|,(?!\d)|(?<!\d),")
_WORDS = re.compile(r"[A-Z]{2,}(?![a-z])|[A-Z]?[^\W\d_A-Z]+|[A-Z]")  # of 'numCols', 'x-length', 'Pixel_size'


@dataclass(frozen=True, kw_only=True)
class Statement:
    """Some words of a line with the numbers and the unit that follow them."""

    words: tuple[str, ...]
    numbers: tuple[float, ...]
    unit: str | None
    line: int
    text: str

    def worded(self) -> str:
        """Return where and how the file states it."""
        return f"line {self.line} {self.text[:60]!r}"


@dataclass(frozen=True, kw_only=True)
class Stated:
    """The value of one quantity (lengths in m where ``unit`` is given) and the line that states it."""

    value: float
    unit: str | None
    line: int
    text: str

    def worded(self) -> str:
        """Return where and how the file states it."""
        return f"line {self.line} {self.text[:60]!r}"


def contradiction(name: str, quantity: str, old: Statement | Stated, new: Statement | Stated) -> InputError:
    """Return the error of a file of which two lines contradict each other."""
    message = f"file {name} contradicts itself about {quantity}: {old.worded()} and {new.worded()}"
    return InputError(message, recommendation="remove the wrong line")


@dataclass(kw_only=True)
class Header:
    """What the lines around a table state, by quantity: "nx", "ny", "columns", "lines", "dx", "dy", "width", "height",
    "z unit", "xy unit", "z factor", "missing"."""

    name: str
    program: str = ""
    stated: dict[str, Stated] = field(default_factory=dict)
    unitless: dict[str, Statement] = field(default_factory=dict)
    sizes: dict[str, Statement] = field(default_factory=dict)  # "width", "height": counts, or lengths without a unit
    lines_read: set[int] = field(default_factory=set)

    def state_lateral(self, quantity: str, statement: Statement, value: float, length: float | None) -> None:
        """Keep a step or an extent in units of ``length`` [m]; without one, until all lines are read."""
        if length is not None:
            self.state(quantity, statement, value * length)
            return
        old = self.unitless.setdefault(quantity, statement)
        if old.numbers != statement.numbers:
            raise contradiction(self.name, quantity, old, statement)

    def state(self, quantity: str, statement: Statement, value: float, unit: str | None = None) -> None:
        """Keep the ``value`` of a ``quantity``. Raise `InputError` where another line states another one."""
        new = Stated(value=value, unit=unit, line=statement.line, text=statement.text)
        old = self.stated.get(quantity)
        if old is not None and (old.unit != new.unit or not math.isclose(old.value, new.value, rel_tol=SAME_LENGTH)):
            raise contradiction(self.name, quantity, old, new)
        self.stated.setdefault(quantity, new)
        self.lines_read.add(statement.line)

    def value(self, quantity: str) -> float | None:
        """Return the value of a ``quantity``, or None where no line states it."""
        stated = self.stated.get(quantity)
        return None if stated is None else stated.value


def statements(number: int, text: str) -> list[Statement]:
    """Return the statements of one line: words, the numbers behind them, and their unit."""
    if len(text) > LONGEST_STATEMENT:
        return []
    if step := _PER_POINT.search(text):  # 'XY calibration 270 nm/pixel', 'Resolution X[um/pixel] 1.0'
        text = f"pixel {_PER_POINT.sub(step[1], text)}"
    marked = _MARKED.sub(lambda match: f" {_UNIT}{match[1] or match[2]} ", text)
    made: list[Statement] = []
    words: list[str] = []
    numbers: list[float] = []
    unit: str | None = None
    axis: list[str] = []

    def end() -> None:
        nonlocal axis
        spoken = tuple(words)
        if spoken or numbers:
            made.append(Statement(words=spoken, numbers=tuple(numbers), unit=unit, line=number, text=text.strip()))
        if not axis:
            axis = [word for word in words if word in ("x", "y")]

    tokens = [token for token in _BETWEEN.split(marked) if token]
    for place, token in enumerate(tokens):
        glued = _GLUED.fullmatch(token)
        follows = tokens[place + 1] if place + 1 < len(tokens) else ""
        if _STATED_NUMBER.fullmatch(token):
            numbers.append(float(token.replace(",", ".")))
        elif glued and glued[2] in UNIT_WORDS:
            numbers.append(float(glued[1].replace(",", ".")))
            unit = UNIT_WORDS[glued[2]]
        elif token.startswith(_UNIT):
            if unit is None:
                unit = UNIT_WORDS.get(token[1:].lower(), token[1:])
        elif numbers and unit is None and token.lower().rstrip(".") in UNIT_WORDS:
            unit = UNIT_WORDS[token.lower().rstrip(".")]
        elif numbers and token.lower() in ("x", "×", "by", "*", "/") and _STATED_NUMBER.match(follows):
            continue
        else:
            if numbers:
                end()
                words = list(axis)
                numbers = []
                unit = None
            words += [word.lower() for word in _WORDS.findall(token)]
    end()
    return made


def read_header(name: str, lines: Iterable[tuple[int, str]]) -> Header:
    """Return what the ``lines`` (number in the file, text) above a table state."""
    header = Header(name=name)
    for number, text in lines:
        if "Digital Surf" in text or "MountainsMap" in text:
            header.program = "MountainsMap"
        if re.match(r"#?\s*File Format\s*=\s*ASCII\s*$", text):
            header.program = "SPIP"
        for statement in statements(number, text):
            _file(header, statement)
    if {"width", "height"} <= set(header.stated) and "z unit" in header.stated and not header.program:
        header.program = "Gwyddion"
    _resolve_unitless(header)
    if header.program == "SPIP" and "z unit" not in header.stated and "z factor" in header.stated:
        factor = header.stated["z factor"]  # Bit2nm
        header.stated["z unit"] = Stated(value=LENGTHS["nm"], unit="nm", line=factor.line, text=factor.text)
    return header


def _resolve_unitless(header: Header) -> None:
    """State the lengths that their own lines give no unit, where another line does, or the program is SPIP (nm)."""
    unit = LENGTHS["nm"] if header.program == "SPIP" else None
    unit = header.value("xy unit") or unit
    if unit is None:
        return
    nova = "z unit" in header.stated and re.match(r"Unit Data\b", header.stated["z unit"].text)
    for quantity, statement in header.unitless.items():
        step = {SCALE + "x": "dx", SCALE + "y": "dy"}.get(quantity, quantity)
        if step == quantity or nova:  # the text export of Nova says "Scale X = 0.5" of a step
            value = statement.numbers[-1 if quantity == "dy" else 0]
            header.state(step, statement, value * unit)
    if nova and not header.program:
        header.program = "Nova"
    header.unitless.clear()


def steps_in_unit(header: Header, unit: float) -> tuple[float | None, float | None]:
    """Return the (dx, dy) that lines state without a unit, if they were in this one [m]; None where none does."""
    steps = []
    for quantity, place in (("dx", 0), ("dy", -1)):
        statement = header.unitless.get(quantity)
        steps.append(None if statement is None else statement.numbers[place] * unit)
    return steps[0], steps[1]


def _refuse_inverted(header: Header, statement: Statement) -> None:
    """Raise `InputError` for a line that says that the heights fall out of the material."""
    words = set(statement.words)
    spoken = words - set(UNIT_WORDS)
    inverted = words & INVERTED and (words & TRUE or statement.numbers == (1.0,))
    if inverted or "positive" in words and words & DOWN or spoken == {"depth"} and not statement.numbers:
        message = f"file {header.name}: {statement.worded()} does not define the sign of the heights"
        recommendation = "remove the line where heights rise out of the material; else change their sign and remove it"
        raise InputError(message, recommendation=recommendation)


def _file(header: Header, statement: Statement) -> None:
    """Put a ``statement`` into the ``header`` as the quantity that its words name, if they name one."""
    _refuse_inverted(header, statement)
    words = set(statement.words)
    axes = {AXES[word] for word in statement.words if word in AXES}
    axis = axes.pop() if len(axes) == 1 else ""
    length = LENGTHS.get(statement.unit or "")
    numbers = statement.numbers
    if not numbers:
        if len(axes) < 2 and len(_MARKED.findall(statement.text)) < 2:
            _unit_alone(header, statement, words, axis)
        return
    value = numbers[0]
    if "voidpixels" in words or {"void", "pixels"} <= words:
        if value:
            header.state("missing", statement, value)
        return
    if "data" in words and "no" in words or words & MISSING_WORDS and "value" in words or "nodata" in words:
        header.state("missing", statement, value)
    elif "bit2nm" in statement.text.lower():
        header.state("z factor", statement, numbers[-1])
    elif axis == "z" and words & {"scale", "factor", "zscale"} or {"conversion", "factor", "height"} <= words:
        header.state("z factor", statement, value)
        if length is not None:
            header.state("z unit", statement, length, statement.unit)
    elif len(numbers) == 1 and _is_whole(value) and length is None and (words & COLUMN_WORDS or _is_per_line(words)):
        header.state("columns", statement, value)
    elif len(numbers) == 1 and _is_whole(value) and length is None and _is_of_lines(words):
        header.state("lines", statement, value)
    elif len(numbers) == 1 and _is_whole(value) and length is None and axis in ("x", "y") and _counts(words):
        header.state("n" + axis, statement, value)
    elif axis in ("x", "y") and statement.words == ("scale", axis) and len(numbers) == 1 and length is None:
        header.state_lateral(SCALE + axis, statement, value, None)
    elif length is not None and words & CALIBRATION and "xy" in words and len(numbers) == 1:
        header.state("dx", statement, value * length)
        header.state("dy", statement, value * length)
    elif words & STEP_WORDS and axis in ("x", "y") and len(numbers) == 1:
        header.state_lateral("d" + axis, statement, value, length)
    elif words & STEP_WORDS and axis == "" and axes in (set(), {"x", "y"}) and len(numbers) <= 2 and _is_square(words):
        header.state_lateral("dx", statement, value, length)
        header.state_lateral("dy", statement, numbers[-1], length)
    elif axis in ("x", "y") and words & EXTENT_WORDS and len(numbers) == 1:
        header.state_lateral("width" if axis == "x" else "height", statement, value, length)
    elif length is not None and not axis and len(numbers) == 1 and words & (WIDTH_WORDS | HEIGHT) and len(words) == 1:
        header.state("width" if words & WIDTH_WORDS else "height", statement, value * length)
    elif length is None and not axis and len(numbers) == 1 and words & (WIDTH_WORDS | HEIGHT) and len(words) == 1:
        header.sizes.setdefault("width" if words & WIDTH_WORDS else "height", statement)
    elif length is not None and not axis and len(numbers) == 2 and words & {"size", "range", "area", "field"}:
        header.state("width", statement, value * length)
        header.state("height", statement, numbers[1] * length)


def _unit_alone(header: Header, statement: Statement, words: set[str], axis: str) -> None:
    """File a statement without a number: a unit of the heights, or of the coordinates."""
    last = next((word for word in reversed(statement.words) if word in UNIT_WORDS), None)
    unit = statement.unit or (UNIT_WORDS[last] if last and words & (UNIT | VALUE_UNIT | {"data"}) else None)
    spoken = words - set(UNIT_WORDS)
    about_heights = axis == "z" or spoken & VALUE_UNIT or spoken & (HEIGHT | {"heights", "z", "elevation"})
    lateral = axis in ("x", "y") or spoken & {"lateral", "xy"}
    if "data" in spoken and spoken & (UNIT | {"z"}):
        about_heights = True
    if last and spoken <= UNIT | {"in", "all"}:  # a line 'um', or 'units: um'
        unit = UNIT_WORDS[last]
        about_heights = True
    if unit is None and about_heights and spoken & {"heights", "height", "z"}:
        unit = UNIT_WORDS[last] if last else None  # 'heights in nm'
    if unit is None and about_heights and spoken & (UNIT | VALUE_UNIT):
        _, mark, stated = re.sub("[:：]", "=", statement.text).partition("=")
        unit = stated.strip() or None if mark else None
    if unit is None:
        return
    if about_heights and not lateral:
        if unit not in LENGTHS:
            message = f"file {header.name}, line {statement.line} {statement.text[:60]!r}: values are in {unit!r}"
            raise InputError(message, allowed=f"heights in {', '.join(LENGTHS)}")
        header.state("z unit", statement, LENGTHS[unit], unit)
    elif lateral and spoken & UNIT and unit in LENGTHS:
        header.state("xy unit", statement, LENGTHS[unit], unit)


def _counts(words: set[str]) -> bool:
    return bool(words & COUNT_WORDS or words & {"nx", "ny", "xres", "yres"})


def _is_per_line(words: set[str]) -> bool:
    """Return whether the words name the points in a line: 'points per profile', 'Punkte je Zeile'."""
    return bool(words & PER_WORDS and words & ONE_LINE_WORDS and words & (POINT_WORDS | VALUE_WORDS))


def _is_of_lines(words: set[str]) -> bool:
    """Return whether the words name the number of lines: 'rows', 'Zeilen', 'Anzahl Profile'."""
    return bool(words & LINE_WORDS or {"anzahl", "profile"} <= words)


def names_size(statement: Statement) -> bool:
    """Return whether a statement names a number of points, a step or an extent of the lateral grid, and a number."""
    words = set(statement.words)
    axes = {AXES[word] for word in words if word in AXES}
    if not statement.numbers or words & NO_GRID_WORDS or "z" in axes:
        return False
    if axes:
        return bool(words & (COUNT_WORDS | STEP_WORDS | EXTENT_WORDS) or statement.unit in LENGTHS)
    if words & HEIGHT and len(words) > 1:  # 'step height'
        return False
    is_count = words & (POINT_WORDS | COLUMN_WORDS) or _is_of_lines(words) or _is_per_line(words)
    return bool(is_count or words & STEP_WORDS or len(words) == 1 and words & (WIDTH_WORDS | HEIGHT))


def directions_by_sizes(
    header: Header, lines: int, columns: int, spacing: tuple[float, float] | None
) -> tuple[set[bool], list[Statement]]:
    """Return which directions of x (True: along a line of the file) agree with the width and the height that lines
    state without a unit, and these lines. Both are counts; or lengths in any unit, where the ``spacing`` [m] is
    known."""
    stated = {name: header.sizes.get(name) or header.unitless.get(name) for name in ("width", "height")}
    sizes = {name: statement for name, statement in stated.items() if statement is not None}
    if not sizes:
        return {True, False}, []
    shapes = {True: (columns, lines), False: (lines, columns)}
    numbers = [None if (statement := stated[name]) is None else statement.numbers[0] for name in ("width", "height")]
    units = [LENGTHS[name] for name in ("m", "mm", "um", "nm")]
    fitting = {across for across, shape in shapes.items() if _are_all_equal(numbers, shape)}
    if not fitting and spacing is not None:
        fitting = {
            across
            for across, shape in shapes.items()
            if any(_are_extents(numbers, shape, [step / unit for step in spacing]) for unit in units)
        }
    return fitting, list(sizes.values())


def _are_all_equal(numbers: Sequence[float | None], counts: tuple[int, int]) -> bool:
    return all(number is None or number == count for number, count in zip(numbers, counts))


def _are_extents(numbers: Sequence[float | None], counts: tuple[int, int], steps: Sequence[float]) -> bool:
    """Return whether numbers are so many steps, or one less."""
    return all(
        number is None or any(math.isclose(number, n * step, rel_tol=SAME_LENGTH) for n in (count, count - 1))
        for number, count, step in zip(numbers, counts, steps)
    )


def column_units(titles: Iterable[tuple[int, str]], columns: int = 3) -> tuple[tuple[str, str, str], str] | None:
    """Return the units of three columns x, y, z that a title names, 'X [mm]; Y [mm]; Z [um]', 'X_mm Y_mm Z_um' or
    'mm; mm; um', and the title; None where none does. One unit represents all three only in a title that says 'units'.
    Of the two ``columns`` of a profile the first one's represents x and y."""
    for _, text in titles:
        if len(text) > LONGEST_STATEMENT:
            continue
        apart = _OF_AXIS.sub(r"\1 ", text)
        marked = _MARKED.sub(lambda match: f" {_UNIT}{match[1] or match[2]} ", apart)
        tokens = [token.lstrip(_UNIT).lower() for token in _BETWEEN.split(marked) if token]
        units = [UNIT_WORDS[token] for token in tokens if token in UNIT_WORDS]
        if len(units) == columns and not any(_STATED_NUMBER.fullmatch(token) for token in tokens):
            return (units[0], units[columns - 2], units[-1]), text
        if len(units) == 1 and {"units", "unit"} & set(tokens) and not {"x", "y", "z"} & set(tokens):
            return (units[0], units[0], units[0]), text
    return None


def _is_square(words: set[str]) -> bool:
    """Return whether the words name a step of the lateral grid, not of time or of heights."""
    return bool(words & {"pixel", "pixelsize", "cellsize", "spacing", "pitch", "lateral"})


def _is_whole(value: float) -> bool:
    return value == int(value) and value >= 1 if math.isfinite(value) else False


@dataclass(frozen=True, kw_only=True)
class TablePlacement:
    """How a table of ``lines`` x ``columns`` numbers lies in the plane.

    ``across``: True where x runs along a line of the file, so that the table has to be turned. ``steps``: (dx, dy) [m],
    None where no line states them. ``either``: the steps hold, but not which of them is along the lines.
    """

    across: bool
    steps: tuple[float, float] | None
    either: bool
    notes: tuple[str, ...]


def grid_of(
    header: Header, lines: int, columns: int, *, directions: frozenset[bool] = frozenset((True, False))
) -> TablePlacement:
    """Return how a table lies in the plane, by its ``header``. Raise `InputError` where they contradict each other.

    directions : of x that the sizes without a unit leave (`directions_by_sizes`); one alone decides what nothing else
        does
    """
    _agree(header, "columns", columns, "numbers in a line")
    _agree(header, "lines", lines, "lines")
    across, known = _direction(header, lines, columns)
    if not known and len(directions) == 1:
        across = True in directions
        known = True
    counts = (columns, lines) if across else (lines, columns)
    steps: list[float | None] = []
    for axis, extent, count in zip("xy", ("width", "height"), counts):
        step = header.value("d" + axis)
        length = header.value(extent)
        if length is not None:
            by_extent = length / count
            if step is None:
                step = by_extent
            elif not by_extent * (1 - SAME_LENGTH) <= step <= length / max(count - 1, 1) * (1 + SAME_LENGTH):
                parts = f"{header.stated['d' + axis].worded()} and {header.stated[extent].worded()}"
                message = f"file {header.name}: {count} points along {axis} do not agree with {parts}"
                raise InputError(message, recommendation="remove the wrong line")
        steps.append(step)
    dx, dy = steps
    notes = []
    if across and known:
        notes.append("x runs along the lines of the file")
    if dx is None or dy is None:
        return TablePlacement(across=across and known, steps=None, either=False, notes=tuple(notes))
    either = not known and not math.isclose(dx, dy, rel_tol=1e-9)
    if header.program:
        notes.append(f"header in the form of {header.program}")
    pair = validate.spacing("spacing in the header", (dx, dy))
    return TablePlacement(across=across and known, steps=pair, either=either, notes=tuple(notes))


def _direction(header: Header, lines: int, columns: int) -> tuple[bool, bool]:
    """Return whether x runs along a line of the file, and whether the header decides that."""
    nx = header.value("nx")
    ny = header.value("ny")
    if nx is not None or ny is not None:
        along = (nx in (None, columns)) and (ny in (None, lines))
        down = (nx in (None, lines)) and (ny in (None, columns))
        if not along and not down:
            where = " and ".join(header.stated[q].worded() for q in ("nx", "ny") if q in header.stated)
            message = f"file {header.name}: the table has {lines} lines of {columns} numbers, and its header {where}"
            raise InputError(message, recommendation="give the whole file, or remove the wrong lines")
        if along != down:
            return along, True
        if header.program:
            return True, True
    if not header.program and {"width", "height"} <= set(header.stated):
        return not _goes_only_down(header, lines, columns), True
    if header.program or {"columns", "lines"} & set(header.stated):
        return True, True
    return False, False


def _goes_only_down(header: Header, lines: int, columns: int) -> bool:
    """Return whether the stated steps and extents agree only where each line of the file is one x."""
    steps = [header.value("dx"), header.value("dy")]
    if steps[0] is None or steps[1] is None:
        return False
    extents = [header.value("width"), header.value("height")]
    known = [steps[0], steps[1]]
    along = _are_extents(extents, (columns, lines), known)
    return not along and _are_extents(extents, (lines, columns), known)


def _agree(header: Header, quantity: str, count: int, what: str) -> None:
    stated = header.stated.get(quantity)
    if stated is not None and stated.value != count:
        message = f"file {header.name}: the table has {count} {what}, and its header {stated.worded()}"
        raise InputError(message, recommendation="give the whole file, or remove the wrong line")
