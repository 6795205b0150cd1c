"""The table of some outputs of a run in time."""

from collections.abc import Mapping

import numpy as np

from ..quantities import COLUMNS, counted
from ..scene import Scene
from ..time import TransientResult, in_motion
from ..units import beside_interval, converted, interval_in_words, unit_of_largest
from .history_answer import have_lambda_ratio, named_outputs
from .markup import ASPERITY_LOAD_RATIO, INTERVAL_OF_F, column_heading, number_cells, number_or_dash, table

# Columns of the table of a run in time: before f, or after it.
OF_OUTPUT = {
    "time": "before",
    "angle_of_rotation": "before",
    "entrainment_speed": "before",
    "sliding_speed": "before",
    "load": "before",
    "friction_force": "after",
    "power_loss": "after",
    "full_load_film": "after",
    "lambda_ratio": "after",
    "min_film": "after",
}
# Rows of the table of a run in time, about. A choice, for a table that can be read.
HISTORY_ROWS = 13
# Quantities whose change over time decides of which outputs that table has rows. A choice: what a user puts into a run,
# and f.
CHANGING = ("entrainment_speed", "sliding_speed", "load", "coefficient")
# Part of the change of a run that is below it. A choice: above the differences of moments that repeat one another.
SAME_CHANGE = 1e-3
# A number smaller than this times the largest of its column is 0 in a table: frequencies are written with nine digits.
# A choice: any number between rounding and a digit shown does.
TABLE_ROUNDING = 1e-8


def history_table(scene: Scene, result: TransientResult) -> str:
    """Return the table of some outputs of a run of ``scene`` in time, more of them where it changes fast, and of those that its
    answer names."""
    count = result.time.size
    if count < 2:
        return ""
    c = result.columns
    rows_at = sorted({*evenly_by_change(c, min(HISTORY_ROWS, count)), *named_outputs(scene, result)})
    moving = in_motion(c)
    has_ratio = have_lambda_ratio(scene, result)
    units = {name: unit_of_largest(c[name].tolist(), COLUMNS[name].unit) for name in OF_OUTPUT}
    shown = {name: converted(c[name], COLUMNS[name].unit, unit) for name, unit in units.items()}
    shown |= {
        name: np.where(moving, shown[name], 0.0)
        for name in ("entrainment_speed", "sliding_speed", "friction_force", "power_loss")
    }
    shown |= {name: np.where(has_ratio, shown[name], np.nan) for name in ("full_load_film", "lambda_ratio")}
    without_angle = not np.isfinite(c["angle_of_rotation"]).any()
    omitted = {"angle_of_rotation"} if without_angle else set()
    before = [name for name in OF_OUTPUT if OF_OUTPUT[name] == "before" and name not in omitted]
    after = [name for name in OF_OUTPUT if OF_OUTPUT[name] == "after"]
    heads = [column_heading(name, units[name]) for name in before]
    heads += [
        "f",
        INTERVAL_OF_F + (", without model-form error" if result.model_form_unknown else ""),
        *(column_heading(name, units[name]) for name in after),
        ASPERITY_LOAD_RATIO,
    ]
    rows = []
    for index in rows_at:
        low = c["interval_low"][index]
        high = c["interval_high"][index]
        f = beside_interval(float(c["coefficient"][index]), low, high)
        interval = interval_in_words(low, high, value=float(c["coefficient"][index]))
        ratio = number_or_dash(float(c["contact_load"][index] / c["load"][index]))
        numbers = [number_or_dash(_rounded(shown[name], index)) for name in after]
        if not moving[index]:
            f = "at rest"
            interval = "-"
        time = f"{shown['time'][index]:.5g}"  # two outputs differ
        others = [number_or_dash(_rounded(shown[name], index)) for name in before if name != "time"]
        rows.append(number_cells([time, *others, f, interval, *numbers, ratio]))
    about = (
        f"{len(rows)} of {counted(count, 'outputs')}, chosen by the change of speed, load and f, with those that "
        "the answer names;"
    )
    films = (
        " The full-load film is that of smooth surfaces under the total load; the smallest film is solved under the "
        "part of the load that the film carries, so it may be thicker."
        if (c["contact_load"] > 0).any()
        else ""
    )
    return f"<h2>Operating points</h2><p>{about} history.csv has all of them.{films}</p>{table(heads, rows)}"


def evenly_by_change(columns: Mapping[str, np.ndarray], count: int) -> list[int]:
    """Return the indices of about so many outputs of a run, the first and the last among them, between which `CHANGING`
    quantities change by about the same: moments that repeat another one are left out."""
    steps = np.zeros(columns["time"].size - 1)
    for name in CHANGING:
        values = np.nan_to_num(columns[name])
        steps += np.abs(np.diff(values)) / max(
            float(np.ptp(values)), TABLE_ROUNDING * float(np.abs(values).max(initial=1.0))
        )
    change = np.append(0.0, np.cumsum(steps))
    if not change[-1] > 0:
        return [0, change.size - 1]
    places = np.searchsorted(change, np.linspace(0.0, change[-1], count) * (1.0 - SAME_CHANGE))
    return sorted({0, *places.tolist(), change.size - 1})


def _rounded(values: np.ndarray, index: int) -> float:
    """Return one of ``values``; 0 where it is below the rounding errors of the largest."""
    value = float(values[index])
    return 0.0 if abs(value) < TABLE_ROUNDING * float(np.nanmax(np.abs(values), initial=0.0)) else value
