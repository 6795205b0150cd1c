"""report.html of a study: status, answer, pictures, a table of its points, what was varied, inputs."""

import base64
import time
from collections import Counter
from html import escape
from importlib.resources import files
from string import Template

import numpy as np

from .._base import __version__
from ..quantities import COLUMNS, counted, worded_value
from ..studies import StudyResult, columns_of_study
from ..units import converted, printed, unit_for
from .report import style_sheet

# Rows of the table of a report; study.csv has all.
MOST_ROWS = 60

# Numbers of the table of a report, each in a unit of people, with the ends of their interval where they have one.
SHOWN = {
    "coefficient": ("uncertainty_low", "uncertainty_high"),
    "power_loss": ("power_loss_low", "power_loss_high"),
    "full_load_film": None,
    "lambda_ratio": None,
    "contact_load": None,
}


def study_page(result: StudyResult, contents: dict[str, bytes], answer: list[str]) -> bytes:
    """Return the page of a study. ``contents``: pictures by the name of their file; ``answer``: lines of text."""
    import scipy

    failed = Counter(result.failures)
    status = f"{counted(result.solved, 'points')}, {result.solved - result.failed} of them solved"
    if result.failed:
        reasons = "; ".join(f"{count} x {reason}" for reason, count in failed.most_common(3))
        status = f"{result.failed} of {counted(result.solved, 'points')} failed: {reasons}"
    entries = Counter(entry for cell in result.validity.flat if cell for entry in cell.split(" | "))
    warnings = [f"{entry} ({counted(count, 'points')})" for entry, count in entries.most_common()]
    rows = min(MOST_ROWS, result.status.size)
    page = Template((files(__package__) / "study_report.html").read_text(encoding="utf-8")).substitute(
        name=escape(result.plan.scene.name),
        style=style_sheet(),
        date=time.strftime("%Y-%m-%d %H:%M:%S UTC", time.gmtime()),
        version=__version__,
        numpy=np.__version__,
        scipy=scipy.__version__,
        key=result.plan.keys[0][:16],
        kind="failed" if result.failed else "",
        status=escape(status),
        answer="".join(f"<p>{escape(line)}</p>" for line in answer),
        pictures="".join(_picture(content) for name, content in contents.items() if name.endswith(".png")),
        warnings=_list(warnings) if warnings else "<p>Every assumption that is checked holds at all points.</p>",
        about=f"{rows} of {counted(result.status.size, 'points')}, spread evenly; study.csv has all of them.",
        table=_table(result, rows),
        varied=_list([_range(key, values) for key, (_, values) in result.coords.items()]),
        scene=escape(result.plan.scene.to_toml()),
        sources="",
    )
    return page.encode()


def _range(key: str, values: np.ndarray) -> str:
    """The values of a key in a line: all if they are few, else their range."""
    label = COLUMNS[key].label if key in COLUMNS else key
    if values.dtype.kind == "f" and values.size > 6:
        ends = " to ".join(worded_value(key, float(value)) for value in (values.min(), values.max()))
        return f"{label}: {values.size} values, {ends}"
    shown = (worded_value(key, v.item()) if values.dtype.kind == "f" else str(v) for v in values[:6])
    return f"{label}: {', '.join(shown)}{', ...' if values.size > 6 else ''}"


def _table(result: StudyResult, rows: int) -> str:
    """The points of a study with what is varied, and the numbers `SHOWN`, each column in one unit."""
    columns = columns_of_study(result)
    count = len(next(iter(columns.values())))
    picked = np.unique(np.linspace(0, count - 1, rows).round().astype(int))
    heads = []
    cells: list[list[str]] = []
    for name in (*result.coords, *SHOWN):
        values = columns[name][picked] if name in columns else np.full(picked.size, np.nan)
        quantity = COLUMNS.get(name)
        heads.append(quantity.label if quantity else name)
        if values.dtype.kind != "f":
            cells.append([str(value) for value in values])
            continue
        unit = unit_for(values.tolist(), quantity.unit) if quantity else "-"
        heads[-1] += f" [{unit}]" if unit not in ("-", "") else ""
        pair = SHOWN.get(name)
        low, high = (columns[end][picked] if pair else np.full(values.size, np.nan) for end in pair or ("", ""))
        si = quantity.unit if quantity else "-"
        cells.append([_cell(*numbers, si, unit) for numbers in zip(values, low, high)])
    status = columns["status"][picked]
    body = "".join(
        f"<tr>{''.join(f'<td class=number>{escape(text)}</td>' for text in row)}<td>{escape(str(state))[:60]}</td></tr>"
        for row, state in zip(zip(*cells), status)
    )
    head = "".join(f"<th>{escape(text)}</th>" for text in (*heads, "status"))
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _cell(value: float, low: float, high: float, si: str, unit: str) -> str:
    """A number in ``unit``, with its interval if that is known."""
    if not np.isfinite(value):
        return "-"
    shown, *ends = (f"{converted(float(number), si, unit):.4g}" for number in (value, low, high))
    return f"{shown} ({ends[0]} to {ends[1]})" if np.isfinite(low) and np.isfinite(high) else shown


def _picture(content: bytes) -> str:
    return f'<figure><img alt="" src="data:image/png;base64,{base64.b64encode(content).decode()}"></figure>'


def _list(lines: list[str]) -> str:
    return f"<ul>{''.join(f'<li>{escape(line)}</li>' for line in lines)}</ul>"


def _three_digits(value: float, unit: str) -> str:
    """A number in a unit of people, to three digits."""
    name = unit_for([value], unit)
    return f"{converted(value, unit, name):.3g} {printed(name)}".rstrip()


def answer_lines(result: StudyResult) -> list[str]:
    """Return the least and the largest f and power loss of a study, with intervals and places; of operating points also
    the means over the cycle."""
    rows = []
    for name, pair in (("coefficient", SHOWN["coefficient"]), ("power_loss", SHOWN["power_loss"])):
        values = result.columns.get(name)
        if values is None or not np.isfinite(values).any():
            continue
        symbol = {"coefficient": "f"}.get(name, COLUMNS[name].label)
        for word, find in {"least": np.nanargmin, "largest": np.nanargmax}.items():
            index = tuple(map(int, np.unravel_index(int(find(values)), values.shape)))
            low, high = (float(result[end][index]) for end in pair or ())
            shown, *ends = (_three_digits(float(v), COLUMNS[name].unit) for v in (values[index], low, high))
            within = f", {ends[0]} to {ends[1]} at 95 %" if np.isfinite(low) else ", error not known"
            rows.append(f"{word} {symbol} = {shown}{within}, at {result.place(index)}")
    if result.paired:
        means = np.atleast_1d(result.mean("power_loss"))
        weighed = "weighed by the duration" if "duration" in result.coords else "of all points alike"
        shown = ", ".join(_three_digits(float(mean), "W") if np.isfinite(mean) else "not known" for mean in means[:6])
        rows.append(f"mean power loss {weighed}: {shown}")
    return rows
