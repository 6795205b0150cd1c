"""report.html of a fit: status, parameters with their intervals, what the data do not determine, tests, picture,
inputs."""

import math
import time
from collections.abc import Mapping
from html import escape
from typing import Any

import numpy as np

from .. import studies
from .._base import __version__
from ..models import title_of
from ..models.shared import LARGE_NUMERICAL_ERROR, percent, percent_or_less, sentence
from ..quantities import KEYS, counted, worded_value
from ..studies import FitResult
from ..units import converted, in_unit_of, interval_in_words, plain_number, printed, unit_of_largest, with_interval
from .curve_answer import model_in_words
from .effects_and_warnings import effects_table, warnings_and_notes
from .inputs import INPUT_SECTIONS
from .inputs_as_given import inputs_as_given
from .markup import Cell, bullets, number_cells, paragraphs, picture, table
from .methods import facts_table, scene_in_words
from .page import framed
from .status import status_kind
from .study_tables import MOST_ROWS

FIT_CAPTION = "Measured points and the fitted curve, and below the deviations of the points from it"

# What a measured Stribeck curve replaces.
MEASURED_SPEEDS = " The measured speeds take the place of those of the scene."

# What the status says of a pressure-viscosity coefficient that is neither given nor fitted.
ALPHA_IS_ESTIMATE = (
    " The pressure-viscosity coefficient is an estimate, and its error, which also affects the fitted parameters, is in "
    "no interval."
)

# What f is beside the measured points.
OF_POINTS = (
    "Measured f, fitted f with the 95 % interval that follows from those of the parameters, and the deviation of the "
    "measured f from the fitted one, relative to the measured f."
)


def fit_page(
    result: FitResult, contents: Mapping[str, bytes], *, given: Mapping[str, Any], record: Mapping[str, Any]
) -> bytes:
    """Return the page of a fit.

    Parameters
    ----------
    contents : pictures by the name of their file
    given : tables of the scene as the user wrote them
    record : command, checksums and seconds, for the last section
    """
    scene = result.scene
    (kind, status) = fit_status(result)
    about = (
        OF_POINTS
        if result.describes_data
        else f"{OF_POINTS} No interval is valid, because the fit does not describe the data."
    )
    shown = [picture(content, FIT_CAPTION) for name, content in contents.items() if name.endswith(".png")]
    return framed(
        "fit_report.html",
        "fit to measured friction",
        f"{scene_in_words(scene)}. {time.strftime('%Y-%m-%d %H:%M:%S UTC', time.gmtime())}, lubfric {__version__}.",
        dict(
            name=escape(scene.name),
            kind=kind,
            status=escape(status),
            answer=paragraphs(fit_answer(result)),
            parameters=_parameters_table(result),
            pictures="".join(shown),
            undetermined=bullets(
                [sentence(text) for text in result.identifiability],
                "The data determine every parameter within its bounds."
                if result.describes_data
                else "Not known, because the fit does not describe the data.",
            ),
            residuals=bullets(residuals_in_words(result)),
            warnings=_warnings(result),
            effects=_effects(result),
            about=about,
            speeds=MEASURED_SPEEDS if result.measured.over == studies.SPEED else "",
            points=_points_table(result),
            inputs="".join(
                inputs_as_given(scene, section, dict(given.get(section, {})), result.parameters)
                for section in INPUT_SECTIONS
            ),
            method=bullets(_method(result)),
            sources=bullets(result.cite().splitlines()),
            made=_made(record),
        ),
    )


def fit_status(result: FitResult) -> tuple[str, str]:
    """Return the kind of the status of a fit (`status_kind`), and the status in sentences."""
    undetermined = [_label(key) for key in result.undetermined]
    by_alpha = ALPHA_IS_ESTIMATE if result.error_of_alpha else ""
    if not result.report.converged:
        return "failed", "Not complete: the trust region did not end."
    if not result.describes_data:
        reason = "" if result.tests is None else result.tests.reason
        by_model = (
            "" if result.tests is None or not result.tests.is_within_model else f" {result.tests.model_as_cause}."
        )
        return "failed", f"The fit converged, but does not describe the data: {reason}.{by_model}{by_alpha}"
    head = "Converged: the fit describes the data."
    if result.tests is not None and result.tests.doubtful:
        head = "Converged: the fit may describe the data, but the residuals may be systematic."
    if undetermined:
        head += f" The data do not determine: {', '.join(undetermined)}."
    one_sided = [_label(key) for key in result.undetermined_sides if key not in result.undetermined]
    if one_sided:
        head += f" They determine only one end of the interval of: {', '.join(one_sided)}."
    known = result.model_error[np.isfinite(result.model_error)]
    is_inexact = bool(known.size) and float(known.max()) > LARGE_NUMERICAL_ERROR
    if is_inexact:
        head += f" The intervals of the parameters do not include the model-form error of f, up to {percent(float(known.max()))}."
    return status_kind(failed=False, inexact=is_inexact), f"{head}{by_alpha}"


def fit_answer(result: FitResult) -> list[str]:
    """Return the answer of a fit in sentences: the fitted values first."""
    values = "; ".join(f"{_label(key)} {_with_interval(result, key)}" for key in result.parameters)
    has_sample = result.describes_data and result.base.surface.sq != 0
    for_sample = "; the intervals are for this sample of the surface" if has_sample else ""
    measured = result.measured
    what = "speeds" if measured.over == studies.SPEED else "slide-roll ratios"
    sentences = [
        f"{values[0].upper()}{values[1:]}{for_sample}.",
        f"The fitted curve deviates from the {counted(measured.x.size, 'measured points')} of {measured.source}, over "
        f"{what}, by {percent_or_less(result.rms_deviation)} of the measured f (root mean square).",
    ]
    if not result.describes_data:
        return [*sentences, "No interval is valid, because the fit does not describe the data."]
    sentences.append("The intervals contain the scatter of the data and the numerical error of f.")
    return [*sentences, *(sentence(text) for text in (*result.correlations, *result.not_in_intervals))]


def _with_interval(result: FitResult, key: str) -> str:
    """Return the fitted value of ``key`` with its interval, where the data determine one."""
    value = result.values[key]
    (low, high) = result.intervals[key]
    unit = KEYS[key].unit if key in KEYS else "-"
    if key in result.undetermined:
        return f"is not determined (every value from {worded_value(key, low)} to {worded_value(key, high)} fits)"
    if not result.describes_data and key != OIL_TEMPERATURE:
        return f"is about {worded_value(key, float(f'{value:.{DIGITS_IF_REFUSED}g}'))}"
    if not low < value < high or key == OIL_TEMPERATURE:
        return f"= {worded_value(key, value)}"
    if one_sided := result.one_sided_in_words(key, DIGITS_IF_REFUSED):
        return f"is {one_sided}, at 95 % ({worded_value(key, float(f'{value:.{DIGITS_IF_REFUSED}g}'))} fits best)"
    return f"= {with_interval(value, low, high, unit=unit)}"


# Digits of a fitted value without a valid interval, or of the one end of its interval, in a sentence. A choice: more
# would promise what no interval does.
DIGITS_IF_REFUSED = 2

# The temperature of the oil, which is in °C where people read it.
OIL_TEMPERATURE = "lubricant.temperature"


def _label(key: str) -> str:
    """Return what a parameter is called."""
    return KEYS[key].label if key in KEYS else key.partition(".")[2].replace("_", " ")


def _parameters_table(result: FitResult) -> str:
    """Return the table of the parameters: values, intervals, bounds, and what f does with each."""
    moved = result.moved_by_surface
    rows = []
    for key, bounds in result.parameters.items():
        (low, high) = result.intervals[key]
        unit = KEYS[key].unit if key in KEYS else "-"
        interval = f"{worded_value(key, low)} to {worded_value(key, high)}"
        if key != OIL_TEMPERATURE and low < result.values[key] < high:
            interval = interval_in_words(low, high, unit, result.values[key])
        change = result.effects[key]
        move = moved[key]
        cells = [
            worded_value(key, result.values[key]) + (" (one of them)" if key in result.undetermined else ""),
            (result.one_sided_in_words(key, DIGITS_IF_REFUSED) or interval) if result.describes_data else "not valid",
            f"{worded_value(key, float(bounds.low))} to {worded_value(key, float(bounds.high))}",
            _determined(result, key),
            "not known" if math.isnan(change) else percent(change),
            "-"
            if not move or (key in result.profiles and result.profiles[key].is_flat)
            else in_unit_of(float(move), result.values[key], unit if key != OIL_TEMPERATURE else "K"),
        ]
        rows.append([Cell(text=_label(key), below=key), *number_cells(cells)])
    heads = [
        "parameter",
        "fitted value",
        "95 % interval",
        "bounds",
        "determined by the data",
        "change of f over the bounds",
        "standard deviation by another sample of the surface",
    ]
    return table(heads, rows)


def _determined(result: FitResult, key: str) -> str:
    """Return whether the data determine a parameter, in words."""
    if not result.describes_data:
        return "not known"
    if key in result.undetermined:
        return "no"
    sides = result.undetermined_sides.get(key, ())
    on_bound = ", on its bound" if key in result.at_bounds else ""
    return (f"no, not {' and '.join(sides)}" if sides else "yes") + on_bound


def residuals_in_words(result: FitResult) -> list[str]:
    """Return what the tests of the residuals of a fit found, in sentences."""
    tests = result.tests
    if tests is None:
        return ["The residuals were not tested."]
    lines = [sentence(text) for text in (tests.text, tests.note) if text]
    if math.isfinite(tests.size) and not tests.too_large:
        lines.append(
            f"The residuals are {tests.times_stated:.2g} times as large as the stated deviations (root mean square, "
            "with the degrees of freedom that the parameters leave)."
        )
    elif math.isnan(tests.size) and not tests.too_far:
        lines.append(
            f"The deviations of the points are not stated: {100 * tests.relative:.2g} % of f (root mean square) is a "
            "usual scatter of measurements."
        )
    return lines


def _warnings(result: FitResult) -> str:
    """Return the warnings of the points, and to which tolerance on f they refer where the fit set one."""
    of_tolerance = result.tolerance_in_words
    above = f"<p>{escape(sentence(of_tolerance))}</p>" if of_tolerance and result.validity else ""
    return above + warnings_and_notes(result.gathered)


def _effects(result: FitResult) -> str:
    """Return the table of the effects that are not modelled, at the point of the largest f."""
    if not result.points:
        return "<p>Not known.</p>"
    place = int(np.argmax(np.abs(result.predicted)))
    where = _place(result, place)
    return effects_table(result.points[place].unmodelled_effects, f"at {where}", " (largest f)")


def _place(result: FitResult, place: int) -> str:
    """Return where a measured point lies, as text."""
    x = float(result.measured.x[place])
    return plain_number(x, "m/s") if result.measured.over == studies.SPEED else f"slide-roll ratio {x:.3g}"


def _points_table(result: FitResult) -> str:
    """Return the table of the points: where, measured, fitted with its band, deviation, and the model."""
    measured = result.measured
    (low, high) = result.band
    is_speed = measured.over == studies.SPEED
    unit = unit_of_largest(measured.x.tolist(), "m/s") if is_speed else "-"
    heads = [f"speed [{printed(unit)}]" if is_speed else "slide-roll ratio", "measured f"]
    heads += ["stated standard deviation"] if measured.deviation is not None else []
    heads += ["fitted f", "95 % interval", "deviation", "model"]
    rows = []
    picked = np.unique(np.linspace(0, measured.x.size - 1, MOST_ROWS).round().astype(int))
    for i in picked.tolist():
        f = float(measured.coefficient[i])
        fitted = float(result.predicted[i])
        cells = [plain_number(converted(float(measured.x[i]), "m/s", unit) if is_speed else float(measured.x[i]))]
        cells.append(plain_number(f))
        cells += [plain_number(float(measured.deviation[i]), digits=2)] if measured.deviation is not None else []
        cells.append(plain_number(fitted))
        cells.append(interval_in_words(float(low[i]), float(high[i])) if result.describes_data else "not valid")
        cells.append(f"{100 * (1 - fitted / f):+.1f} %")
        cells.append(title_of(result.points[i].decision.model) if result.points else "-")
        rows.append(number_cells(cells))
    more = "" if len(rows) == measured.x.size else f"<p>{len(rows)} of {measured.x.size} points; fit.json has all.</p>"
    return table(heads, rows) + more


def _method(result: FitResult) -> list[str]:
    """Return how a fit was carried out, in sentences."""
    measured = result.measured
    scale = "the stated standard deviations" if measured.deviation is not None else "the measured f"
    rolling = "contain" if measured.rolling else "do not contain"
    search = (
        f"A search by the load-sharing model, {studies.starts_in_words(result.starts)}, found "
        "the minimum from which the fit began."
        if result.starts
        else "The fit began at the start alone, without a search over the bounds."
    )
    own = percent(result.base.numerics.tolerance)
    by_noise = (
        f", set by the fit from the noise of the data (numerics.tolerance: {own})" if result.tolerance_in_words else ""
    )
    models = ", ".join(
        dict.fromkeys(model_in_words(point.decision.basis, point.decision.model) for point in result.points)
    )
    return [
        f"Bounded least squares of the residuals, computed minus measured f over {scale}, by a trust region.",
        search,
        f"The fitted curve is solved at the fitted values: {models or 'model not known'} (numerics.model = "
        f"{result.base.numerics.model!r}), relative tolerance on f {percent(result.tolerance)}{by_noise}.",
        f"The measured coefficients {rolling} rolling friction.",
        "Curves that differ in the boundary friction coefficient alone follow from one solved balance.",
        "The 95 % intervals follow from the slopes of f at the fit, with Student's t. Curves towards the ends of a "
        "wide interval, with the other parameters fitted again, show where the sum of squares exceeds its limit; a "
        "parameter without effect on f at the fit is varied up to its bounds.",
    ]


def _made(record: Mapping[str, Any]) -> str:
    """Return the command, versions, checksums and the time of a fit."""
    import scipy

    versions = {"lubfric": __version__, "numpy": np.__version__, "scipy": scipy.__version__}
    rows = [
        *versions.items(),
        *((f"SHA-256 of {path}", checksum) for path, checksum in record["sha256"].items()),
        ("curves of the fit, without those of the search", record["curves"]),
        ("wall-clock time of the last call", plain_number(record["seconds"], "s")),
        ("processor time, all processes together, of the last call", plain_number(record["processor_seconds"], "s")),
    ]
    note = (
        f"<p><code>{escape(record['command'])}</code> computes the same numbers with the versions and files below. "
        "fitted.toml is the scene with the fitted values, fit.json the record; the folder keeps every solved point.</p>"
    )
    return note + facts_table(rows)
