"""The tables of the points of a curve, and its formula."""

import math
from html import escape

import numpy as np

from ..models.shared import percent_or_less, sentence
from ..quantities import COLUMNS
from ..scene import Scene
from ..studies import CurveResult, Law, StribeckResult
from ..units import beside_interval, converted, interval_in_words, unit_for, unit_of_largest, with_interval, worded
from .budget_bars import budget_labels
from .curve_answer import largest_error_of_points, model_of_point
from .describe import is_among
from .films_in_words import FILMS_AND_GAPS, LOADS, films_at_limit, note_on_touching
from .markup import ASPERITY_LOAD_RATIO, INTERVAL_OF_F, Cell, column_heading, number_cells, number_or_dash, table
from .operating_point import operating_point_of
from .rolling_part import cells_of_rolling, heading_of_rolling, is_tabled, negative_in_words, rolling_part

# columns of the operating table, after the swept quantity, f and its interval
OF_POINT = ("power_loss", "full_load_film", "lambda_ratio")
# Loads and friction forces of the table of details, with their headings.
FORCES = {
    "contact_load": "asperity load F_C [N]",
    "film_load": "film load F_H [N]",
    "boundary_force": "boundary force [N]",
    "couette_force": "viscous shear of the film [N]",
    "rolling_force": "rolling part of the film [N]",
}
# What these forces are together, and where the rolling part is from.
SUM_OF_FORCES = (
    "f times the load is the sum of the boundary force, the viscous shear and the rolling part. The rolling part is by "
    "the gradient of pressure and, with moving roughness, by the pressure on flanks, which scatters about 0."
)
# What follows the scene's own speed or ratio in the table of a curve.
OPERATING_POINT = " (operating point)"


def operating_table(scene: Scene, curve: CurveResult) -> str:
    """Return the table of all points: what was swept, f with its interval, and the numbers of the point. That of the
    scene's own speed or ratio is named where there are others."""
    swept = curve.SWEPT[0]
    names = (swept, *OF_POINT)
    values = {swept: getattr(curve, swept)} | {name: curve[name] for name in OF_POINT}
    units = {name: unit_for(values[name].tolist(), COLUMNS[name].unit) for name in names}
    shown = {name: converted(values[name], COLUMNS[name].unit, units[name]) for name in names}
    rolling = rolling_part(curve["rolling_resistance"], getattr(curve, "speed"))
    has_rolling = is_tabled(rolling, curve["power_loss"])
    (of_power, *of_others) = (column_heading(name, units[name]) for name in OF_POINT)
    of_rolling = [heading_of_rolling(units["power_loss"])] if has_rolling else []
    heads = [
        *(column_heading(swept, units[swept]), "f", INTERVAL_OF_F, of_power),
        *of_rolling,
        *of_others,
        ASPERITY_LOAD_RATIO,
    ]
    of_loss = converted(rolling, COLUMNS["power_loss"].unit, units["power_loss"])
    of_rolling_part = cells_of_rolling(of_loss, shown["power_loss"])
    rows = []
    for index, point in enumerate(curve.points):
        place = f"{shown[swept][index]:.4g}"
        if len(curve.points) > 1 and is_among(operating_point_of(scene, swept), [values[swept][index]]):
            place += OPERATING_POINT
        if point is None:
            why = Cell(text=str(curve.errors[index]), kind="warning", columns=len(heads) - 1)
            rows.append([*number_cells([place]), why])
            continue
        low, high = point.uncertainty.interval
        f = beside_interval(point.coefficient, low, high)
        interval = interval_in_words(low, high, value=point.coefficient)
        ratio = point.contact_load / (point.contact_load + point.film_load)
        loss = converted(np.array(point.power_loss_interval), COLUMNS["power_loss"].unit, units["power_loss"])
        numbers = [number_or_dash(shown[name][index]) for name in OF_POINT]
        numbers[OF_POINT.index("power_loss")] = with_interval(
            float(shown["power_loss"][index]), float(loss[0]), float(loss[1]), ""
        )
        if has_rolling:
            numbers.insert(OF_POINT.index("power_loss") + 1, of_rolling_part[index])
        rows.append(number_cells([place, f, interval, *numbers, f"{ratio:.3g}"]))
    at_limit = films_at_limit({name: curve[name] for name in LOADS})
    below_0 = negative_in_words(rolling) if has_rolling else ""
    beside = "".join(f"<p>{escape(text)}</p>" for text in (at_limit, below_0) if text)
    return f"<h2>Operating points</h2>{beside}{table(heads, rows)}"


def details_of_points(curve: CurveResult) -> str:
    """Return the uncertainty budget of every point and the model that solved it, folded."""
    swept = curve.SWEPT[0]
    unit = unit_of_largest(getattr(curve, swept).tolist(), COLUMNS[swept].unit)
    labels = budget_labels([point for point in curve.points if point is not None])
    rows = []
    for value, point in zip(converted(getattr(curve, swept), COLUMNS[swept].unit, unit), curve.points):
        if point is not None:
            words = point.uncertainty.budget_in_words
            parts = [words[name] for name in labels]
            forces = [getattr(point, name) for name in FORCES]
            lengths = [converted(getattr(point, name), "m", "nm") for name in ("mean_gap", "central_film", "min_film")]
            numbers = [number_or_dash(number) for number in (*forces, *lengths)]
            rows.append(number_cells([f"{value:.4g}", *parts, *numbers, model_of_point(point)]))
    heads = [
        column_heading(swept, unit),
        *(label.partition(" (")[0] for label in labels.values()),
        *FORCES.values(),
        "mean separation [nm]",
        "central separation [nm]",
        "smallest film [nm]",
        "model",
    ]
    touching = note_on_touching(point.min_film for point in curve.points if point is not None)
    notes = filter(None, (SUM_OF_FORCES, FILMS_AND_GAPS, touching, _error_of_loads(curve)))
    note = "".join(f"<p>{escape(text)}</p>" for text in notes)
    return f"<details><summary>Details of every point</summary>{note}{table(heads, rows)}</details>" if rows else ""


def _error_of_loads(curve: CurveResult) -> str:
    """Return the largest standard error of the asperity load in a sentence, and where it is; "" where none is known."""
    swept = curve.SWEPT[0]
    errors = {
        value: point.errors.contact_load * point.contact_load
        for value, point in zip(getattr(curve, swept).tolist(), curve.points)
        if point is not None and math.isfinite(point.errors.contact_load)
    }
    if not errors:
        return ""
    worst = max(errors, key=lambda value: errors[value])
    size = worded(float(f"{errors[worst]:.2g}"), "N")
    largest = f"up to {size} (at {worded(worst, COLUMNS[swept].unit)})" if len(errors) > 1 else size
    return (
        f"Asperity load and film load have a standard error of {largest}, by the scatter of the surface, by the "
        "cells, and by Eq. (8) where the load-sharing model answers. The error of f is smaller, because load that the asperities lose still causes friction in the film."
    )


def formula_of_curve(law: Law | str, curve: CurveResult) -> str:
    """Return the formula of a curve over the speed, or why it has none, folded; "" for any other curve."""
    if not law:
        return ""
    if isinstance(law, Law) and isinstance(curve, StribeckResult):
        deviation, within = (percent_or_less(error, before="at most ") for error in (law.largest, curve.between))
        fastest = law.ranges["speed"][1]
        warning = (
            f'<p class="warning">{escape(sentence(law.warning.removeprefix("warning: ")))}</p>' if law.warning else ""
        )
        text = (
            f"{warning}<p>The formula is for simulations of a machine; law.json and law.c (in C) contain it. It "
            f"deviates by {deviation} from the curve through the solved points, which adds {within} "
            f"between them to the errors of the points{largest_error_of_points(curve)}. Check "
            f"value: f = {law(fastest):.4g} at U = {fastest:.4g} m/s.</p><pre>{escape(law.text)}</pre>"
        )
    else:
        text = f"<p>{escape(sentence(f'no formula was fitted: {law}'))}</p>"
    return f"<details><summary>The curve as a formula</summary>{text}</details>"
