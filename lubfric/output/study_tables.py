"""The tables of the points of a study."""

import math
from collections.abc import Sequence
from html import escape

import numpy as np

from ..models.shared import LEAST_STATED_RISE, GatheredTexts, numbers_in_words, peak_hertz_pressure, percent
from ..quantities import COLUMNS, GIVEN_DIGITS, worded_value
from ..scene import SLIDE_ROLL_RATIO_KEY, SOURCES, Scene, budget
from ..studies import INTERVAL_COLUMNS, StudyResult, columns_of_study, name_of
from ..units import (
    ZERO_CELSIUS,
    beside_interval,
    converted,
    interval_in_words,
    plain_number,
    printed,
    unit_for,
    with_interval,
    worded,
)
from .markup import ASPERITY_LOAD_RATIO, INTERVAL_OF_F, NUMBER, Cell, number_cells, table
from .rolling_part import cells_of_rolling, heading_of_rolling, is_tabled, negative_in_words, rolling_part
from .study_points import error_in_words, parts_of_error, scene_of_each

# Rows of the table of a report, about; study.csv has all.
MOST_ROWS = 60
# Numbers whose smallest and largest value the answer of a study has.
ANSWERED = ("coefficient", "power_loss")
# Numbers of the table of a report, each in a unit of people, with the ends of their interval where they have one.
REPORTED_NUMBERS: dict[str, tuple[str, str] | None] = {
    **INTERVAL_COLUMNS,
    "lambda_ratio": None,
    ASPERITY_LOAD_RATIO: None,
}
# Parts of the error of f that differ from point to point.
OWN_PARTS = ("numerical", "sampling")
# Films of the folded table of details: in the other one they would make it wider than a window. A choice.
FOLDED_FILMS = ("full_load_film", "central_film", "min_film")
# Style of cells that would wrap in a table of many columns: intervals of f, and numbers with their interval.
UNBROKEN = "white-space: nowrap"
# Digits of what is varied, which is exact. A choice: a smaller value makes neighbours alike.
CELL_DIGITS = 4
# Digits of the smaller of the asperity load ratio and the film load ratio, which are known to some percent, as f. A
# choice: more shows digits that are not known.
RATIO_DIGITS = 2
# Keys of the oil that change its viscosity, beside those of its temperature, of which a study shows it.
OF_VISCOSITY = ("lubricant", *(f"lubricant.{name}" for name in ("temperature", "temperature_celsius", *SOURCES)))
VISCOSITY_OF_OIL = "lubricant.viscosity"
# Digits of a temperature rise, which is that of few strips at one moment, and varies up to threefold (docs/glossary.md).
RISE_DIGITS = 2
RISE_NOTE = (
    "The temperature rises have no stated error. The deterministic and the quick model compute them for the solved "
    "strips at one moment. The rise of the film varies up to threefold between strips and moments, so steps from point to point "
    "are partly scatter. f includes the effect of heat, and the interval of f its error."
)
# Columns of a table of operating points from which others follow, and these.
DERIVED_COLUMNS = {
    ("u1", "u2"): (SLIDE_ROLL_RATIO_KEY, "speed"),
    ("sliding_speed",): (SLIDE_ROLL_RATIO_KEY,),
    ("R1", "R2"): ("bodies.radius",),
}


def table_of_points(result: StudyResult, rows: int, warnings: Sequence[GatheredTexts]) -> str:
    """Return the points of a study with what is varied, the numbers `REPORTED_NUMBERS`, each column in one unit, and
    the numbers of their ``warnings`` in the report."""
    columns = columns_of_study(result)
    columns[ASPERITY_LOAD_RATIO] = columns["contact_load"] / (columns["contact_load"] + columns["film_load"])
    count = len(next(iter(columns.values())))
    picked = _picked(columns, rows)
    scenes = scene_of_each(result)
    heads = ["no."]
    cells: list[list[str]] = [[f"{row + 1}" for row in picked]]
    omitted = {*_constant(result, count), *_derived(result)}
    for name in (name for name in result.coords if name not in omitted):
        (head, column) = _column(result, columns, name, picked)
        heads.append(head)
        cells.append(column)
    if VISCOSITY_OF_OIL not in result.coords and any(name in OF_VISCOSITY for name in result.coords):
        columns[VISCOSITY_OF_OIL] = np.array([scene.lubricant.viscosity for scene in scenes])
        (head, column) = _column(result, columns, VISCOSITY_OF_OIL, picked)
        heads.append(head)
        cells.append(column)
    inputs_alone = len(heads)
    place_of_interval = -1
    for name in REPORTED_NUMBERS:
        (head, column) = _column(result, columns, name, picked)
        if name != "coefficient":
            heads.append(head)
            cells.append(column)
            if name == "power_loss":
                cells += _rolling_column(columns, picked, heads)
            continue
        heads += [head, INTERVAL_OF_F]
        place_of_interval = len(heads) - 1
        cells += _friction_and_interval(columns, picked, [scenes[row] for row in picked])
    if any(each.numbers for each in warnings):
        heads.append("warnings")
        cells.append([_numbers_of_warnings(warnings, row + 1) for row in picked])
    failures = set(result.failures)
    body = []
    for row, status in zip(zip(*cells), columns["status"][picked].tolist()):
        numbers = row[:inputs_alone] if status in failures else row
        line = [_number_cell(text, is_interval=i == place_of_interval) for i, text in enumerate(numbers)]
        if status in failures:
            line.append(Cell(text=status, kind="warning", columns=len(heads) - inputs_alone))
        body.append(line)
    rolling = rolling_part(columns["rolling_resistance"], columns["speed"])[picked]
    loss = columns["power_loss"][picked]
    below_0 = negative_in_words(rolling) if is_tabled(rolling, loss) else ""
    return table(heads, body) + (f"<p>{escape(below_0)}</p>" if below_0 else "")


def _rolling_column(columns: dict[str, np.ndarray], picked: np.ndarray, heads: list[str]) -> list[list[str]]:
    """Return the cells of the rolling resistance in the power loss at the points that are ``picked``, and append its
    heading to ``heads``; none where it is a small part of the loss at all of them."""
    rolling = rolling_part(columns["rolling_resistance"], columns["speed"])[picked]
    loss = columns["power_loss"][picked]
    if not is_tabled(rolling, loss):
        return []
    si = COLUMNS["power_loss"].unit
    unit = unit_for(loss.tolist(), si)
    heads.append(heading_of_rolling(unit))
    return [cells_of_rolling(*(converted(values, si, unit) for values in (rolling, loss)))]


def _number_cell(text: str, *, is_interval: bool) -> Cell:
    """Return a cell of a number, or of an interval, which is not broken."""
    return Cell(text=text, kind=NUMBER, style=UNBROKEN if is_interval or "(" in text else "")


def _numbers_of_warnings(warnings: Sequence[GatheredTexts], point: int) -> str:
    """Return the numbers of the ``warnings`` that hold at a ``point``, as text."""
    return ", ".join(str(number) for number, each in enumerate(warnings, 1) if point in each.numbers) or "-"


def _friction_and_interval(
    columns: dict[str, np.ndarray], picked: np.ndarray, scenes: Sequence[Scene]
) -> tuple[list[str], list[str]]:
    """Return f at the points that are ``picked``, of these ``scenes``, and its 95 % intervals, these in as many digits as show their width;
    f in as many as show its numerical and sampling errors, as the others are largely common to the points."""
    values = columns["coefficient"][picked].tolist()
    low, high = (columns[end][picked].tolist() for end in INTERVAL_COLUMNS["coefficient"])
    rows = list(zip(values, low, high))
    parts = parts_of_error(columns, picked, scenes)
    own = (np.abs(columns["coefficient"][picked]) * np.hypot(*(parts[name].largest for name in OWN_PARTS))).tolist()
    f = ["-" if np.isnan(row[0]) else beside_interval(*_narrower(*row, error)) for row, error in zip(rows, own)]
    return f, [interval_in_words(first, last, value=value) for value, first, last in rows]


def _narrower(value: float, low: float, high: float, error: float) -> tuple[float, float, float]:
    """Return a ``value`` with the ends of its interval, or with those of its own ``error`` where these are closer."""
    is_narrower = 0.0 < 2.0 * error < high - low
    return (value, value - error, value + error) if is_narrower else (value, low, high)


def _column(
    result: StudyResult, columns: dict[str, np.ndarray], name: str, picked: np.ndarray
) -> tuple[str, list[str]]:
    """Return the heading of the column ``name`` with its unit, and its cells at the points that are ``picked``."""
    values = columns[name][picked] if name in columns else np.full(picked.size, np.nan)
    quantity = COLUMNS.get(name)
    head = name if name == ASPERITY_LOAD_RATIO else name_of(name)
    if values.dtype.kind != "f":
        return head, [worded_value(name, value) for value in values.tolist()]
    if name == "lubricant.temperature":
        return f"{head} [°C]", [f"{value:.4g}" for value in values - float(ZERO_CELSIUS)]
    si = quantity.unit if quantity else "-"
    unit = unit_for(values.tolist(), si)
    head += f" [{printed(unit)}]" if printed(unit) else ""
    pair = REPORTED_NUMBERS.get(name)
    low, high = (columns[end][picked] if pair else np.full(values.size, np.nan) for end in pair or ("", ""))
    if name == ASPERITY_LOAD_RATIO:
        return head, [_ratio_cell(value) for value in values.tolist()]
    digits = CELL_DIGITS if name in result.coords else CELL_DIGITS - 1
    digits = GIVEN_DIGITS if name in result.plan.coordinates else digits
    return head, [_cell(*numbers, si, unit, digits) for numbers in zip(values, low, high)]


def _cell(value: float, low: float, high: float, si: str, unit: str, digits: int) -> str:
    """Return a number in ``unit``, with its interval if that is known; else to so many ``digits``."""
    if not np.isfinite(value):
        return "-"
    shown, *ends = (converted(float(number), si, unit) for number in (value, low, high))
    if np.isfinite(low) and np.isfinite(high):
        return with_interval(shown, ends[0], ends[1], "")
    return plain_number(shown, digits=digits)


def _ratio_cell(ratio: float) -> str:
    """Return the part of the load on asperities, in decimals that show two digits of the smaller part of the load."""
    smaller = min(ratio, 1.0 - ratio)
    if not smaller > 0:
        return _cell(ratio, np.nan, np.nan, "-", "-", RATIO_DIGITS)
    decimals = RATIO_DIGITS - 1 - math.floor(math.log10(smaller))
    return plain_number(ratio, digits=RATIO_DIGITS) if smaller == ratio else f"{ratio:.{decimals}f}"


def _rise_cell(rise: float) -> str:
    """Return a temperature ``rise`` [K]; "< 0.1" for a small one."""
    if 0 < rise < LEAST_STATED_RISE:
        return f"< {LEAST_STATED_RISE:g}"
    return _cell(rise, np.nan, np.nan, "K", "K", RISE_DIGITS)


def _constant(result: StudyResult, count: int) -> list[str]:
    """Return what is varied by name alone: it has one value at all of ``count`` points."""
    return [name for name, (_, values) in result.coords.items() if count > 1 and np.unique(values).size == 1]


def _derived(result: StudyResult) -> list[str]:
    """Return what is varied that follows from other columns of a table of operating points, which are shown instead."""
    return [
        name
        for name in result.coords
        if any(name in derived and set(given) <= set(result.coords) for given, derived in DERIVED_COLUMNS.items())
    ]


def _picked(columns: dict[str, np.ndarray], rows: int) -> np.ndarray:
    """Return which of the points in ``columns`` a table of about so many ``rows`` shows: some evenly, and those of the
    answer."""
    count = len(next(iter(columns.values())))
    evenly = np.linspace(0, count - 1, rows).round().astype(int)
    known = [columns[name] for name in ANSWERED if np.isfinite(columns[name]).any()]
    ends = [find(values) for values in known for find in (np.nanargmin, np.nanargmax)]
    return np.unique([*evenly, *ends])


def folded_details(result: StudyResult, rows: int) -> str:
    """Return a folded table of the points with what follows from other columns, films, the peak Hertz pressure,
    temperatures, and the parts of the error of f."""
    columns = columns_of_study(result)
    picked = _picked(columns, rows)
    scenes = scene_of_each(result)
    constant = _constant(result, len(scenes))
    derived = [_column(result, columns, name, picked) for name in _derived(result) if name not in constant]
    derived += [_column(result, columns, name, picked) for name in FOLDED_FILMS]
    parts = parts_of_error(columns, picked, [scenes[row] for row in picked])
    rises = [columns[name][picked] for name in ("flash_temperature_rise", "film_temperature_rise")]
    body = []
    for i, row in enumerate(picked):
        cells = [f"{row + 1}", *(texts[i] for _, texts in derived), worded(peak_hertz_pressure(scenes[row]), "Pa")]
        cells += [_rise_cell(float(rise[i])) for rise in rises]
        f = float(columns["coefficient"][row])
        cells += [error_in_words(part, i, f) for part in parts.values()]
        body.append(number_cells(cells))
    heads = [
        "no.",
        *(head for head, _ in derived),
        "peak Hertz pressure",
        "flash temperature rise [K]",
        "film temperature rise [K]",
    ]
    heads += parts
    about = "Films, pressure, temperature, and parts of the error of f at 95 %, of every point of the table"
    notes = [RISE_NOTE] if np.isfinite(rises[1]).any() else []
    notes += why_no_rises(result)
    note = f"<p>{escape(' '.join(notes))}</p>" if notes else ""
    return f"<details><summary>{about}</summary>{note}{table(heads, body)}</details>"


def why_no_rises(result: StudyResult) -> list[str]:
    """Return at which solved points of a study the temperature rises are not computed, why, and how to get them, a
    sentence or two for each reason."""
    columns = columns_of_study(result)
    missing = np.isfinite(columns["coefficient"]) & np.isnan(columns["flash_temperature_rise"])
    scenes = scene_of_each(result)
    reasons: dict[str, list[int]] = {}
    for i in np.flatnonzero(missing).tolist():
        reasons.setdefault(_why_no_rise(scenes[i], float(columns["speed"][i])), []).append(i + 1)
    solved = np.flatnonzero(np.isfinite(columns["coefficient"])) + 1
    return [
        f"{'At all points' if len(numbers) == len(solved) > 1 else numbers_in_words(numbers, len(missing))} the "
        f"temperature rises are not computed: {reason}."
        for reason, numbers in reasons.items()
    ]


def _why_no_rise(scene: Scene, speed: float) -> str:
    """Return why the temperature rises of a point of ``scene`` at ``speed`` [m/s] are not computed, and how to get
    them."""
    if scene.numerics.heat == "off":
        return "numerics.heat = 'off' neglects the heat; 'on' computes them"
    if not scene.lubricant.heats:
        return (
            "the lubricant does not state how its viscosity falls with the temperature; give lubricant.temperature and "
            "temperature_coefficient, or an oil (grade, nu40, oil)"
        )
    if speed == 0 or scene.motion.slide_roll_ratio == 0:
        return "nothing slides there, so no heat of sliding arises"
    if scene.numerics.heat == "auto":
        return (
            "numerics.heat = 'auto' computes them only where the heat of film and surfaces changes f by more than its "
            f"share of numerics.tolerance, {percent(budget.HEAT * scene.numerics.tolerance)}; numerics.heat = 'on' "
            "computes them at all points that slide"
        )
    return "the film is outside the range of the formulas of its heat"
