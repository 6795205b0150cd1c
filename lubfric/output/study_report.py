"""report.html of a study: status, answer, pictures, a table of its points, what was varied, inputs."""

import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from html import escape

import numpy as np

from .._base import FloatArray, __version__
from ..estimate import PARTS
from ..models.shared import (
    Assumption,
    GatheredTexts,
    UnmodelledEffect,
    alpha_of_points_in_words,
    first_sentence,
    half_width_of_error,
    is_near_zero,
    numbers_in_words,
    peak_hertz_pressure,
    percent,
    percent_of_sides,
    sentence,
    sides_in_f,
    unmodelled_effects,
)
from ..quantities import CHOICES, COLUMN_OF_ERROR, COLUMNS, RADII_OF_SURFACES, counted, worded_value
from ..samples import is_measured, requests_patch
from ..scene import SLIDE_ROLL_RATIO_KEY, Scene, budget, has_moving_roughness, inputs_not_given
from ..studies import (
    DURATION,
    INTERVAL_COLUMNS,
    ORDERED_BY,
    POSITION,
    UNUSED,
    StudyPlan,
    StudyResult,
    columns_of_study,
    label,
    main_effects,
    mean_over_cycle,
    name_of,
    place_in_words,
    scenes_of,
)
from ..time import may_move_roughness
from ..units import (
    ZERO_CELSIUS,
    converted,
    interval_in_words,
    plain_number,
    printed,
    unit_of_largest,
    with_interval,
    worded,
)
from .best_designs import best_lines, best_table
from .inputs import INPUT_SECTIONS, inputs
from .missed_tolerances import MissedTolerance, missed_tolerances
from .page import framed
from .report import (
    GAP_OF_TOUCHING,
    INTERVAL_OF_F,
    NO_WARNINGS,
    effects_table,
    films_at_limit,
    folded_notes,
    is_gap_of_touching,
    methods_to_quote,
    names_of_inputs,
    orders_of_magnitude,
    picture,
    scene_in_words,
    shortfalls,
    status_kind,
    table,
)

# Rows of the table of a report, about; study.csv has all.
MOST_ROWS = 60

# Points of a study at which the effects that are not modelled are computed for its answer, at most. A choice: some ms each.
MOST_CHECKED_EFFECTS = 500

# Numbers whose smallest and largest value the answer of a study has.
ANSWERED = ("coefficient", "power_loss")

# Heading of the column of the asperity load ratio.
ASPERITY_LOAD_RATIO = "asperity load ratio F_C/F_T"

# Numbers of the table of a report, each in a unit of people, with the ends of their interval where they have one.
REPORTED_NUMBERS: dict[str, tuple[str, str] | None] = {
    **INTERVAL_COLUMNS,
    "full_load_film": None,
    "lambda_ratio": None,
    "central_film": None,
    "min_film": None,
    ASPERITY_LOAD_RATIO: None,
}

# Styles of cells that would wrap into three lines in a table of many columns: intervals of f, and numbers with their interval.
UNBROKEN = ' style="white-space: nowrap"'
TWO_LINES = ' style="min-width: 9em"'

# Digits of what is varied, which is exact. A choice: less makes neighbours alike.
CELL_DIGITS = 4
# Digits of numbers whose error is not stated: the asperity load ratio is known to some percent, as f. A choice: more
# shows digits that are not known.
DIGITS_WITHOUT_ERROR = {ASPERITY_LOAD_RATIO: 2}
# Digits of a temperature rise, which is that of one strip at one moment, and varies up to threefold (docs/glossary.md).
RISE_DIGITS = 2
RISE_NOTE = (
    "The temperature rises have no stated error. The deterministic and the quick model compute them for one strip at one moment. The "
    "rise of the film varies up to threefold between strips and moments, so steps from point to point are partly scatter. f includes "
    "the effect of heat, and the interval of f its error."
)

# What f is at a point where nothing slides, and why the power loss there is not f times a speed.
IN_PURE_ROLLING = (
    "Nothing slides there: f is the rolling part of the force on one surface. The power loss comes from the rolling resistance of "
    "both surfaces; in their sum, the pressure on the flanks of moving roughness, which is part of f, cancels"
)

# Where the points are listed that a sentence has no room for.
ALL_IN_TABLE = " The column validity of study.csv has all of them."

# Columns of a table of operating points from which others follow, and these.
DERIVED_COLUMNS = {
    ("u1", "u2"): (SLIDE_ROLL_RATIO_KEY, "speed"),
    ("sliding_speed",): (SLIDE_ROLL_RATIO_KEY,),
    ("R1", "R2"): ("bodies.radius",),
}

# What the mean power loss of a path of contact is.
OF_TOOTH_PAIR = "It is that of one tooth pair; for a gear, multiply it by the contact ratio."

# Combinations of what is varied beside operating points whose means are reported, at most. A choice: more makes a table
# of a text.
MOST_MEANS = 6
CAPTION = "The results of the study"

# Errors of f whose tolerances a list names the points of.
OF_TOLERANCES = (Assumption.NUMERICAL_ERROR, Assumption.SAMPLING_ERROR, Assumption.MODEL_FORM_ERROR)


@dataclass(frozen=True, kw_only=True)
class PartOfError:
    """A part of the error of f at some points, relative, at 95 %, (n,).

    Attributes
    ----------
    largest : of both sides
    towards, away : towards 0 and away from it; NaN where both sides are ``largest``
    """

    largest: FloatArray
    towards: FloatArray
    away: FloatArray


def study_page(result: StudyResult, contents: dict[str, bytes], answer: list[str]) -> bytes:
    """Return the page of a study. ``contents``: pictures by the name of their file; ``answer``: lines of text."""
    import scipy

    warnings = numbered_warnings(result)
    notes = [each.text_without_head for each in result.gathered if each.is_note]
    rows = min(MOST_ROWS, result.status.size)
    size = result.status.size
    about = (
        "no. is the row of study.csv, which has all numbers."
        if rows == size
        else f"About {rows} of {size} points, evenly spread, and those of the answer. No. is the row of study.csv, which has all."
    )
    about += (
        " The last column of this table has the numbers of the warnings above."
        if any(each.numbers for each in warnings)
        else ""
    )
    about += "".join(f" {text}" for text in (films_at_limit(columns_of_study(result)),) if text)
    about += why_no_intervals(result)
    if any(is_gap_of_touching(film) for film in np.ravel(result["min_film"])):
        about += f" {sentence(f'a smallest film of 1 nm is {GAP_OF_TOUCHING}')}"
    return framed(
        "study_report.html",
        "study of a lubricated line contact",
        f"{time.strftime('%Y-%m-%d %H:%M:%S UTC', time.gmtime())}, lubfric {__version__}",
        dict(
            name=escape(result.plan.scene.name),
            version=__version__,
            numpy=np.__version__,
            scipy=scipy.__version__,
            key=result.plan.keys[0][:16],
            kind=status_kind(failed=result.failed > 0, inexact=_largely_inexact(result) + len(_missed(result))),
            status=escape(study_status(result)),
            answer="".join(
                f'<p class="{"answer" if i == 0 else ""}">{escape(line)}</p>' for i, line in enumerate(answer)
            ),
            pictures="".join(picture(content, CAPTION) for name, content in contents.items() if name.endswith(".png")),
            warnings=_counts_as_paragraph(result)
            + (_list([each.text for each in warnings], kind="ol") if warnings else f"<p>{NO_WARNINGS}</p>")
            + folded_notes(_list(notes), len(notes)),
            best=best_table(result),
            about=about,
            table=_table(result, rows, warnings) + _details(result, rows) + _effects_table(result),
            varied=_list([_range(key, values) for key, (_, values) in result.coords.items()]),
            inputs=common_inputs(result),
            sources=methods_to_quote(_common_facts(result), result) + _list(result.cite().splitlines()),
        ),
    )


def _common_facts(result: StudyResult) -> list[str]:
    """Return contact and oil in a line; none where the study varies one of their inputs."""
    varied = {key.partition(".")[0] for key in result.coords}
    return [] if varied & {"bodies", "lubricant", *RADII_OF_SURFACES} else [scene_in_words(result.plan.scene)]


def _counts_as_paragraph(result: StudyResult) -> str:
    counts = counts_of_warnings(result)
    return f"<p>{escape(sentence(counts))}</p>" if counts else ""


def numbered_warnings(result: StudyResult) -> list[GatheredTexts]:
    """Return the warnings of a study, one for all points that share the reason: doubts about its plain numbers, which are of no
    point, then the assumptions that do not hold somewhere."""
    warnings = [GatheredTexts(statement=sentence(note)) for note in result.plan.notes]
    return [*warnings, *(each for each in result.gathered if not each.is_note)]


def counts_of_warnings(result: StudyResult) -> str:
    """Return at how many points of a study there are warnings and notes, as its tables have them, and what these are; "" where
    there are none."""
    noted = {number for each in result.gathered if each.is_note for number in each.numbers}
    if not result.with_warnings and not noted:
        return ""
    notes = (
        f", notes at {len(noted)} (the interval of f covers what they say, or nothing is to be done)" if noted else ""
    )
    where = f"warnings at {result.with_warnings} of {counted(result.solved, 'points')}{notes}"
    return f"{where}; study.csv has them in the column validity"


def warning_lines(result: StudyResult) -> list[str]:
    """Return how many points have warnings and notes, and each reason of a warning with its points and the worst value, in a line each."""
    counts = counts_of_warnings(result)
    if not counts:
        return []
    heads = [first_sentence(each.text) for each in result.gathered if not each.is_note]
    full = ", and report.html has them in full with what to do"
    return [f"{counts}{full}{':' if heads else '.'}", *(f"  {head[:1].lower()}{head[1:]}" for head in heads)]


def tolerance_lines(result: StudyResult) -> list[str]:
    """Return which points miss the tolerance of the numerical error, of the sampling error, and of the model-form error."""
    lines = [
        each.text_without_head
        for each in result.gathered
        if each.violation is not None and each.is_note and each.violation.assumption in OF_TOLERANCES
    ]
    return [f"{line}{'' if line.startswith('At point') else ALL_IN_TABLE}" for line in lines]


def why_no_intervals(result: StudyResult) -> str:
    """Return at which points of a study the interval of f is not known, and, of a patch, how long it is there and at the other
    points; "" where all intervals are known."""
    columns = columns_of_study(result)
    solved = np.isfinite(columns["coefficient"])
    unknown = solved & np.isnan(columns["interval_low"])
    if not unknown.any():
        return ""
    known = solved & ~unknown
    text = f" The interval of f is not known at {counted(int(unknown.sum()), 'points')}"
    apart = []
    for name in result.coords:
        here, there = (list(dict.fromkeys(columns[name][where].tolist())) for where in (unknown, known))
        if known.any() and not set(here) & set(there):
            values = ", ".join(worded_value(name, value) if isinstance(value, float) else str(value) for value in here)
            apart.append(f"{COLUMNS[name].label if name in COLUMNS else name} {values}")
    text += f" ({'; '.join(apart)})" if apart else ""
    scene = result.plan.scene
    if not requests_patch(scene):
        return f"{text}."
    shape = scene.contact.shape
    spacing = scene.contact.spacing
    varies = any(name.startswith("contact") for name in result.coords)
    text += ", because the single patch is too short there for a sampling error"
    if has_moving_roughness(scene) and known.any() and shape is not None and spacing is not None and not varies:
        length = shape[0] * float(np.broadcast_to(spacing, 2)[0])
        widths = length / np.array([each.bodies.half_width for each in _scene_of_each(result)])
        text += (
            f". It is {_ends(widths[unknown])} half-widths of the Hertz strip long along the motion there, and "
            f"{_ends(widths[known])} at the points with an interval"
        )
    way = "a larger map" if is_measured(scene) else "numerics.sampling = 'strips' or a larger contact.shape"
    return f"{text}. Give {way} for an interval; 'lubfric run' of such a point states how much is missing."


def _ends(values: np.ndarray) -> str:
    """Return the ends of the range of ``values`` as text."""
    return " to ".join(dict.fromkeys(f"{end:.3g}" for end in (values.min(), values.max())))


def common_inputs(result: StudyResult | StudyPlan) -> str:
    """Return the tables of the inputs that are the same at all points of a study or its plan: all but those that are
    varied."""
    varied = {*result.coords, "motion.entrainment_speed", "motion.speeds"}
    whole_sections = {key for key in varied if "." not in key}
    parts = []
    scene, *others = _scenes_at_ends(result if isinstance(result, StudyPlan) else result.plan)
    for section in INPUT_SECTIONS:
        everywhere = [{(key, text, note) for _, text, key, note in inputs(other, section)} for other in others]
        rows = [
            f'<td>{escape(label_)}</td><td>{escape(text)}{escape(note)}</td><td class="key">{escape(key)}</td>'
            for label_, text, key, note in inputs(scene, section)
            if key not in varied and section not in whole_sections
            if all((key, text, note) in alike for alike in everywhere)
        ]
        if section not in whole_sections:
            rows += [
                f'<td>{escape(key.partition(".")[2].replace("_", " "))}</td><td>{escape(value)}</td><td class="key">{key}</td>'
                for key in CHOICES
                if key.startswith(f"{section}.") and key not in varied
                if len({getattr(getattr(each, section), key.partition(".")[2], None) for each in (scene, *others)}) == 1
                if isinstance(value := getattr(getattr(scene, section), key.partition(".")[2], None), str)
            ]
        if section == "lubricant" and scene.lubricant.oil is not None and section not in whole_sections:
            names = {"" if each.lubricant.oil is None else each.lubricant.oil.name for each in (scene, *others)}
            rows += [f"<td>oil</td><td>{escape(name)}</td><td></td>" for name in names if len(names) == 1]
        parts.append(f"<h3>{section}</h3>{table(['quantity', 'value', 'key'], rows)}" if rows else "")
    return "".join(parts)


def _scenes_at_ends(plan: StudyPlan) -> list[Scene]:
    """Return the scene of the first point of a ``plan``, and those at the ends of the range of each number that is varied:
    what follows from it, as the viscosity from a temperature, differs there."""
    first = {axis.name: axis.values[0] for axis in plan.axes}
    corners = [first]
    for axis in plan.axes:
        for column in zip(*axis.values):
            is_number = all(isinstance(value, (int, float)) for value in column)
            ends = (min, max) if is_number else ()
            corners += [first | {axis.name: axis.values[column.index(end(column))]} for end in ends]
        corners.append(first | {axis.name: axis.values[-1]})
    scenes = []
    for corner in corners:
        axes = tuple(replace(axis, values=(corner[axis.name],)) for axis in plan.axes)
        scenes += list(scenes_of(plan.scene, axes))
    return scenes


def study_status(result: StudyResult) -> str:
    """Return in a sentence how many points of a study are solved, and the most frequent failures."""
    total = counted(result.solved, "points")
    if not result.failed:
        head = f"{'The point is' if result.solved == 1 else f'All {total} are'} solved."
        if _largely_inexact(result) == 0:
            head = f"Converged: {head[0].lower()}{head[1:]}"
        unknown = int(np.isnan(result["interval_low"][np.isfinite(result["coefficient"])]).sum())
        warned = orders_of_magnitude(result["numerical_error"].ravel().tolist())
        sentences = shortfalls(_missed(result), unknown, result.solved, lambda row: f"at point {row + 1}")
        return " ".join((*warned, head, *sentences))
    failed = Counter(result.failures)
    reasons = "; ".join(f"{count} x {reason.removesuffix('.')}" for reason, count in failed.most_common(3))
    return f"Not complete: {result.solved - result.failed} of {total} solved. Failures: {reasons}."


def _missed(result: StudyResult) -> list[MissedTolerance]:
    return list(missed_tolerances(columns_of_study(result), _scene_of_each(result)))


def _largely_inexact(result: StudyResult) -> int:
    """Return at how many points of a study the numerical error of f is a warning."""
    return sum(
        any(each.assumption == Assumption.NUMERICAL_ERROR and not each.is_note for each in violations)
        for violations in result.violations.flat
    )


def _range(key: str, values: np.ndarray) -> str:
    """Return the values of a key in a line: all if they are few, else their range."""
    label = name_of(key)
    if values.dtype.kind == "f" and values.size > 6:
        ends = " to ".join(dict.fromkeys(worded_value(key, float(value)) for value in (values.min(), values.max())))
        return f"{label}: {ends}" if " to " not in ends else f"{label}: {values.size} values, {ends}"
    if values.dtype.kind == "f" and key in COLUMNS and COLUMNS[key].unit not in ("-", "K"):
        unit = unit_of_largest(values.tolist(), COLUMNS[key].unit)
        numbers = dict.fromkeys(f"{converted(value, COLUMNS[key].unit, unit):.4g}" for value in values.tolist())
        return f"{label}: {', '.join(numbers)} {printed(unit)}"
    shown = dict.fromkeys(worded_value(key, v.item()) if values.dtype.kind == "f" else str(v) for v in values[:6])
    return f"{label}: {', '.join(shown)}{', ...' if values.size > 6 else ''}"


def _table(result: StudyResult, rows: int, warnings: Sequence[GatheredTexts]) -> str:
    """Return the points of a study with what is varied, the numbers `REPORTED_NUMBERS`, each column in one unit, and the numbers
    of their ``warnings`` in the report."""
    columns = columns_of_study(result)
    columns[ASPERITY_LOAD_RATIO] = columns["contact_load"] / (columns["contact_load"] + columns["film_load"])
    count = len(next(iter(columns.values())))
    picked = _picked(columns, rows)
    heads = ["no."]
    cells: list[list[str]] = [[f"{row + 1}" for row in picked]]
    omitted = {*_constant(result, count), *_derived(result)}
    for name in (name for name in result.coords if name not in omitted):
        (head, column) = _column(result, columns, name, picked)
        heads.append(head)
        cells.append(column)
    inputs_alone = len(heads)
    for name in REPORTED_NUMBERS:
        (head, column) = _column(result, columns, name, picked)
        if name != "coefficient":
            heads.append(head)
            cells.append(column)
            continue
        heads += [head, INTERVAL_OF_F]
        cells += _friction_and_interval(columns, picked)
    if any(each.numbers for each in warnings):
        heads.append("warnings")
        cells.append([_numbers_of_warnings(warnings, row + 1) for row in picked])
    why = f'<td colspan="{len(heads) - inputs_alone}" class="warning">'
    failures = set(result.failures)
    body = []
    for row, status in zip(zip(*cells), columns["status"][picked].tolist()):
        numbers = row[:inputs_alone] if status in failures else row
        texts = "".join(_number_cell(head, text) for head, text in zip(heads, numbers))
        body.append(f"{texts}{why}{escape(status)}</td>" if status in failures else texts)
    return table(heads, body)


def _number_cell(head: str, text: str) -> str:
    """Return a cell of a number in the column with this ``head``."""
    style = TWO_LINES if "(" in text else ""
    style = UNBROKEN if head == INTERVAL_OF_F else style
    return f'<td class="number"{style}>{escape(text)}</td>'


def _numbers_of_warnings(warnings: Sequence[GatheredTexts], point: int) -> str:
    """Return the numbers of the ``warnings`` that hold at a ``point``, as text."""
    return ", ".join(str(number) for number, each in enumerate(warnings, 1) if point in each.numbers) or "-"


def _friction_and_interval(columns: dict[str, np.ndarray], picked: np.ndarray) -> tuple[list[str], list[str]]:
    """Return f at the points that are ``picked`` and its 95 % intervals, each in as many digits as the interval shows."""
    values = columns["coefficient"][picked].tolist()
    low, high = (columns[end][picked].tolist() for end in INTERVAL_COLUMNS["coefficient"])
    rows = list(zip(values, low, high))
    f = ["-" if np.isnan(row[0]) else with_interval(*row).partition(" (")[0] for row in rows]
    return f, [interval_in_words(first, last, value=value) for value, first, last in rows]


def _column(
    result: StudyResult, columns: dict[str, np.ndarray], name: str, picked: np.ndarray
) -> tuple[str, list[str]]:
    """Return the heading of the column ``name`` with its unit, and its cells at the points that are ``picked``."""
    values = columns[name][picked] if name in columns else np.full(picked.size, np.nan)
    quantity = COLUMNS.get(name)
    head = name if name == ASPERITY_LOAD_RATIO else name_of(name)
    if values.dtype.kind != "f":
        return head, [str(value) for value in values]
    if name == "lubricant.temperature":
        return f"{head} [°C]", [f"{value:.4g}" for value in values - float(ZERO_CELSIUS)]
    si = quantity.unit if quantity else "-"
    unit = unit_of_largest(values.tolist(), si)
    head += f" [{printed(unit)}]" if printed(unit) else ""
    pair = REPORTED_NUMBERS.get(name)
    low, high = (columns[end][picked] if pair else np.full(values.size, np.nan) for end in pair or ("", ""))
    digits = CELL_DIGITS if name in result.coords else DIGITS_WITHOUT_ERROR.get(name, CELL_DIGITS - 1)
    return head, [_cell(*numbers, si, unit, digits) for numbers in zip(values, low, high)]


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


def _details(result: StudyResult, rows: int) -> str:
    """Return a folded table of the points with what follows from other columns, the peak Hertz pressure, temperatures, and
    the parts of the error of f."""
    columns = columns_of_study(result)
    picked = _picked(columns, rows)
    scenes = _scene_of_each(result)
    constant = _constant(result, len(scenes))
    derived = [_column(result, columns, name, picked) for name in _derived(result) if name not in constant]
    parts = _parts_of_error(columns, picked, [scenes[row] for row in picked])
    rises = [columns[name][picked] for name in ("flash_temperature_rise", "film_temperature_rise")]
    body = []
    for i, row in enumerate(picked):
        cells = [f"{row + 1}", *(texts[i] for _, texts in derived), worded(peak_hertz_pressure(scenes[row]), "Pa")]
        cells += [_cell(rise[i], np.nan, np.nan, "K", "K", RISE_DIGITS) for rise in rises]
        f = float(columns["coefficient"][row])
        cells += [_error_in_words(part, i, f) for part in parts.values()]
        body.append("".join(f'<td class="number">{escape(text)}</td>' for text in cells))
    heads = [
        "no.",
        *(head for head, _ in derived),
        "peak Hertz pressure",
        "flash temperature rise [K]",
        "film temperature rise [K]",
    ]
    heads += parts
    about = "Pressure, temperature, and parts of the error of f at 95 %, of every point of the table"
    notes = [RISE_NOTE] if np.isfinite(rises[1]).any() else []
    notes += why_no_rises(result)
    note = f"<p>{escape(' '.join(notes))}</p>" if notes else ""
    return f"<details><summary>{about}</summary>{note}{table(heads, body)}</details>"


def _error_in_words(error: PartOfError, place: int, f: float) -> str:
    """Return a relative ``error`` of ``f`` at a ``place`` of its arrays as text, with both sides where they differ; in f itself
    where that is near 0."""
    largest, towards, away = (float(values[place]) for values in (error.largest, error.towards, error.away))
    if is_near_zero(f, largest):
        return f"{sides_in_f((towards, away), largest, f)} in f"
    return percent_of_sides((towards, away), largest)


def why_no_rises(result: StudyResult) -> list[str]:
    """Return at which solved points of a study the temperature rises are not computed, why, and how to get them, a sentence or
    two for each reason."""
    columns = columns_of_study(result)
    missing = np.isfinite(columns["coefficient"]) & np.isnan(columns["flash_temperature_rise"])
    scenes = _scene_of_each(result)
    reasons: dict[str, list[int]] = {}
    for i in np.flatnonzero(missing).tolist():
        reasons.setdefault(_why_no_rise(scenes[i], float(columns["speed"][i])), []).append(i + 1)
    solved = np.flatnonzero(np.isfinite(columns["coefficient"])) + 1
    return [
        f"{'At all points' if len(numbers) == len(solved) > 1 else numbers_in_words(numbers, len(missing))} the temperature rises are "
        f"not computed: {reason}."
        for reason, numbers in reasons.items()
    ]


def _why_no_rise(scene: Scene, speed: float) -> str:
    """Return why the temperature rises of a point of ``scene`` at ``speed`` [m/s] are not computed, and how to get them."""
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
            "numerics.heat = 'auto' computes them only where the heat of film and surfaces changes f by more than its share of "
            f"numerics.tolerance, {percent(budget.HEAT * scene.numerics.tolerance)}; numerics.heat = 'on' computes them at all points "
            "that slide"
        )
    return "the film is outside the range of the formulas of its heat"


def _parts_of_error(
    columns: Mapping[str, np.ndarray], index: np.ndarray | tuple[int, ...], scenes: Sequence[Scene]
) -> dict[str, PartOfError]:
    """Return the parts of the error of f at an ``index`` of the ``columns``, by what they are called.

    Columns hold no text, so the inputs that are not given, whose range changes f, are those of the ``scenes`` there; where
    f does not depend on them, they are no part.
    """

    def at_index(name: str) -> FloatArray:
        values = columns.get(name)
        return np.full(len(scenes), np.nan) if values is None else np.atleast_1d(values[index])

    columns_of = {name: COLUMN_OF_ERROR[part.quantity] for name, part in PARTS.items()}
    parts = {
        name: PartOfError(largest=at_index(column), towards=at_index(f"{column}_low"), away=at_index(f"{column}_high"))
        for name, column in columns_of.items()
    }
    of_sample = zip(parts["sampling"].largest, at_index("sampling_freedom"))
    at_95 = np.array([half_width_of_error(error, float(n)) for error, n in of_sample])
    parts["sampling"] = replace(parts["sampling"], largest=at_95)
    missing = names_of_inputs(key for scene in scenes for key in inputs_not_given(scene))
    labels = {"not given": f"{missing} not given"}
    return {labels.get(name, name): part for name, part in parts.items() if name != "not given" or part.largest.any()}


def _picked(columns: dict[str, np.ndarray], rows: int) -> np.ndarray:
    """Return which of the points in ``columns`` a table of about so many ``rows`` shows: some evenly, and those of the answer."""
    count = len(next(iter(columns.values())))
    evenly = np.linspace(0, count - 1, rows).round().astype(int)
    known = [columns[name] for name in ANSWERED if np.isfinite(columns[name]).any()]
    ends = [find(values) for values in known for find in (np.nanargmin, np.nanargmax)]
    return np.unique([*evenly, *ends])


def _scene_of_each(result: StudyResult) -> list[Scene]:
    """Return the scene of each point of `columns_of_study`."""
    curves = result.plan.scenes
    each = result.status.size // len(curves)
    return [curves[i // each] for i in np.flatnonzero(result.status.ravel() != UNUSED)]


def _alpha_line(result: StudyResult) -> list[str]:
    """Return at which points the range of an estimated pressure-viscosity coefficient is not in the interval of f, and by how much
    it changes f, in a sentence; none where there are no such points."""
    known = np.flatnonzero(np.isfinite(columns_of_study(result)["coefficient"]))
    rows = known[:: max(1, -(-known.size // MOST_CHECKED_EFFECTS))]
    effects = {row + 1: each for row, each in zip(rows.tolist(), _effects_at(result, rows.tolist()))}
    text = alpha_of_points_in_words(effects, len(effects))
    some = f" Checked at {rows.size} of {known.size} points." if text and rows.size < known.size else ""
    return [f"{text}{some}"] if text else []


def _effects_at(result: StudyResult, rows: Sequence[int]) -> Iterator[tuple[UnmodelledEffect, ...]]:
    """Yield the effects that are not modelled at each of the ``rows`` of `columns_of_study`, where f is known."""
    columns = columns_of_study(result)
    scenes = _scene_of_each(result)
    for i in rows:
        scene = scenes[i]
        numbers = {
            name: abs(float(columns[name][i])) for name in ("coefficient", "speed", "boundary_force", "central_film")
        }
        ratio = float(columns["film_to_roughness_ratio"][i])
        sq = numbers["central_film"] / ratio if np.isfinite(ratio) and ratio > 0 else 0.0
        known = numbers["boundary_force"] / scene.bodies.load, numbers["coefficient"]
        yield unmodelled_effects(scene, sq, numbers["speed"], known, includes_motion=may_move_roughness(scene))


def _effects_table(result: StudyResult) -> str:
    """Return the table of the effects that are not modelled, where |f| is largest; "" where no f is known."""
    if not np.isfinite(result["coefficient"]).any():
        return ""
    row = int(np.nanargmax(np.abs(columns_of_study(result)["coefficient"])))
    (effects,) = _effects_at(result, [row])
    place = f"at point {row + 1}, of the largest f"
    return f"<h3>Effects not modelled, {place}</h3>{effects_table(effects, place)}"


def _cell(value: float, low: float, high: float, si: str, unit: str, digits: int) -> str:
    """Return a number in ``unit``, with its interval if that is known; else to so many ``digits``."""
    if not np.isfinite(value):
        return "-"
    shown, *ends = (converted(float(number), si, unit) for number in (value, low, high))
    if np.isfinite(low) and np.isfinite(high):
        return with_interval(shown, ends[0], ends[1], "")
    return plain_number(shown, digits=digits)


def _list(lines: list[str], kind: str = "ul") -> str:
    return f"<{kind}>{''.join(f'<li>{escape(line)}</li>' for line in lines)}</{kind}>"


# Share of the variance below which the end of its interval is written as 0. A convention.
LEAST_STATED_SHARE = 1e-3


def answer_lines(result: StudyResult) -> list[str]:
    """Return the answer of a study in sentences: what the inputs do to f, the best design at the operating conditions, of operating
    points the means over the cycle, and the smallest and the largest f and power loss with intervals and places."""
    rows = [*_main_effects_line(result), *best_lines(result)]
    if result.paired:
        rows += _mean_lines(result)
    for name, (low_name, high_name) in INTERVAL_COLUMNS.items():
        values = result.columns.get(name)
        if values is None or not np.isfinite(values).any():
            continue
        what = {"coefficient": "friction coefficient"}.get(name, COLUMNS[name].label)
        for word, find in {"smallest": np.nanargmin, "largest": np.nanargmax}.items():
            index = tuple(map(int, np.unravel_index(int(find(np.abs(values))), values.shape)))
            low, high = (float(result[end][index]) for end in (low_name, high_name))
            shown = with_interval(float(values[index]), low, high, unit=COLUMNS[name].unit)
            unknown = "" if np.isfinite(low) else " (interval not known)"
            why = ""
            if name == "coefficient" and not _slides(result, index):
                why = f". {IN_PURE_ROLLING}"
            rows.append(f"The {word} {what} is {shown}{unknown}, at {point_in_words(result, index)}{why}.")
    by_alpha = _alpha_line(result)
    return [*rows, *by_alpha, *_budget_line(result)]


def _main_effects_line(result: StudyResult) -> list[str]:
    """Return what the inputs that are varied do to f, each by itself, in a sentence; none where that is not known."""
    effects = main_effects(result)
    if not effects:
        return []
    trends = {-1: ["on average f falls with it"], 0: [], 1: ["on average f rises with it"]}
    words = []
    for key, effect in effects.items():
        low, high = (f"{100 * end:.2g}" if end >= LEAST_STATED_SHARE else "0" for end in effect.interval)
        known = [f"{low} to {high} %"] if np.isfinite(effect.interval).all() and low != high else []
        details = ", ".join([*known, *trends[effect.slope]])
        words.append(f"{name_of(key)} {percent(effect.share)}" + (f" ({details})" if details else ""))
    within = (
        ", with its range within the errors of f at 95 %" if np.isfinite([*effects.values()][0].interval).all() else ""
    )
    return [
        f"Part of the variance of ln f that each input alone explains{within}: {'; '.join(words)}. The remaining part comes "
        "from combinations of inputs."
    ]


def _budget_line(result: StudyResult) -> list[str]:
    """Return the relative errors of f at its largest value in a sentence; none where f or its interval is not known."""
    f = np.abs(result["coefficient"])
    f = np.where(np.isfinite(result["interval_low"]), f, np.nan)
    if not np.isfinite(f).any():
        return []
    index = tuple(map(int, np.unravel_index(int(np.nanargmax(f)), f.shape)))
    curves = result.plan.scenes
    scene = curves[int(np.ravel_multi_index(index, f.shape)) * len(curves) // f.size]
    parts = _parts_of_error(result.columns, index, [scene])
    size = float(result["coefficient"][index])
    words = ", ".join(f"{name} {_error_in_words(part, 0, size)}" for name, part in parts.items())
    place = point_in_words(result, index).partition(":")[0]
    some = "" if np.isfinite(result["interval_low"]).all() else " with an interval"
    return [f"The relative errors of the largest f{some}, at {place}, each at 95 %, are: {words}."]


def point_in_words(result: StudyResult, index: tuple[int, ...]) -> str:
    """Return where a point lies, as text; an operating point by its number in the tables and its coordinate alone."""
    return result.place(index) if result.chosen else planned_point_in_words(result.plan, index)


def planned_point_in_words(plan: StudyPlan, index: tuple[int, ...]) -> str:
    """Return where a point of a ``plan`` lies that does not choose its speeds, as `point_in_words`."""
    number = int(np.ravel_multi_index(index, plan.shape)) + 1
    if not plan.paired:
        return f"point {number}: {place_in_words(plan, index, plan.point_speed(index))}"
    known = (name for name in ORDERED_BY if name in plan.coords)
    place = "".join(f" ({name} {_coordinate(name, plan.coords[name][1], index[-1])})" for name in known)
    return f"point {number}{place}"


def _coordinate(name: str, values: np.ndarray, index: int) -> str:
    """Return one of the ``values`` of a coordinate in the unit that all have in common."""
    unit = unit_of_largest(values.tolist(), COLUMNS[name].unit)
    return f"{converted(float(values[index]), COLUMNS[name].unit, unit):.4g} {printed(unit)}"


def _slides(result: StudyResult, index: tuple[int, ...]) -> bool:
    """Return whether the surfaces slide at a point."""
    if SLIDE_ROLL_RATIO_KEY not in result.coords:
        return result.plan.scene.motion.slide_roll_ratio != 0
    dim, ratios = result.coords[SLIDE_ROLL_RATIO_KEY]
    return bool(ratios[index[result.dims.index(dim)]] != 0)


def _mean_lines(result: StudyResult) -> list[str]:
    """Return the mean power loss and f over the operating points in a sentence, for each combination of what else is
    varied (at most `MOST_MEANS`)."""
    of_tooth_pair = f" {OF_TOOTH_PAIR}" if POSITION in result.coords else ""
    weighed = "weighted by the duration" if "duration" in result.coords else "all with the same weight"
    rows = []
    for index in list(np.ndindex(*result.status.shape[:-1]))[:MOST_MEANS]:
        where = f" for {place}" if (place := label(result.plan, (*index, slice(None)))) else ""
        low, high = (float(np.asarray(end)[index]) for end in result.mean_interval("power_loss"))
        mean = float(np.asarray(result.mean("power_loss"))[index])
        text = _mean_in_words(mean, low, high, "W")
        rows.append(f"The mean power loss of the operating points, {weighed}, is {text}{where}.{of_tooth_pair}")
        rows.append(_mean_friction(result, index, where))
    others = int(np.prod(result.status.shape[:-1], dtype=int)) - MOST_MEANS
    if others > 0:
        rows.append(
            f'The means of {others} other combinations are not listed; in Python, study.mean("power_loss") has all.'
        )
    return rows


def _mean_in_words(mean: float, low: float, high: float, unit: str) -> str:
    """Return a mean in the SI ``unit`` with its interval, or why it is not known."""
    if not np.isfinite(mean):
        return "not known, as points failed"
    return with_interval(mean, low, high, unit=unit) + ("" if np.isfinite(low) else " (interval not known)")


def _mean_friction(result: StudyResult, index: tuple[int, ...], where: str) -> str:
    """Return the mean magnitude of f over the operating points in a sentence. Where f changes its sign, as at the pitch
    point of a gear, a mean with the sign would say nothing."""
    f = result["coefficient"][index]
    ends = np.abs([result[name][index] for name in INTERVAL_COLUMNS["coefficient"]])
    crosses = result["interval_low"][index] * result["interval_high"][index] < 0
    low = np.where(crosses, 0.0, ends.min(axis=0))
    durations = np.array(result.plan.coordinates.get(DURATION, np.ones(f.shape[-1])))
    mean, least, most = (mean_over_cycle(values, durations) for values in (np.abs(f), low, ends.max(axis=0)))
    what = "mean friction coefficient" if not (f < 0).any() else "mean magnitude of the friction coefficient"
    text = _mean_in_words(mean, least, most, "-")
    return f"The {what} is {text}{where}."
