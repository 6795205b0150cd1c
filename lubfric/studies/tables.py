"""Studies as tables for other tools, each imported only when its table is made; curves and studies drawn."""

from __future__ import annotations

import io
from collections.abc import Collection, Container, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.interpolate import PchipInterpolator

from .._base import FloatArray, __version__, figures, files, table_bytes, validate, write_whole
from ..errors import InputError
from ..models import MODELS, title_of
from ..models.shared import half_width_of_error
from ..quantities import COLUMNS, KEYS, Quantity, axis_label, described, heading, worded_value
from ..scene import SLIDE_ROLL_RATIO_KEY
from ..units import ZERO_CELSIUS, converted, unit_of_largest, worded
from .choose import errors_of_gaps
from .interpolate import Interpolant, through
from .operating_points import INTERVAL_COLUMNS, ORDERED_BY
from .plan import StudyPlan
from .points import MODEL, SPEED, STATUS, UNUSED, VALIDITY

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

    from .._base.tables import Columns

# Parts of the interval that are drawn by themselves: column, line.
OF_INTERVAL = (("model_error", "--"), ("sampling_error", ":"))

BAND = "95 % interval"


# Opacity of a band of intervals. A choice, by looking at the figures.
BAND_ALPHA = 0.2

# Width [pt] and opacity of the edges of bands over each other. A choice, by looking at the figures.
BAND_EDGE_WIDTH = 0.8
BAND_EDGE_ALPHA = 0.6

# Distance of the bars of two curves at one speed, of the length of the curve. A choice, by looking at the figures.
BAR_STEP = 0.012

# Lines of operating points, at most. A choice, by looking at the figures.
MOST_OF_POINTS = 10

# Symbols that are the end of the label of a quantity, by the label.
SYMBOL_AT_END = {"root mean square height Sq": "Sq"}

# Quantities of operating points that jump, or have a minimum, where the direction of sliding changes.
OF_SLIDING = "coefficient", "power_loss"

# Name of the line where the sliding speed is 0.
NO_SLIDING = "no sliding"

# Points of a line between solved ones. A choice, by looking at the figures.
LINE_POINTS = 200

# Relative error of f between the points up to which a curve is drawn as a line or given as a formula. A choice: it
# would not be seen.
DRAWN_ERROR = 0.05

# Relative error of f between the points up to which f is interpolated there, and beyond which it is not known. A
# convention.
LARGEST_BETWEEN = 0.5

# Column of a curve for the axis of its picture, in place of the speed.
OVER_X = "x"

# Markers of points of simpler models, as large as the filled ones that they cover. A choice, by looking at the figures.
HOLLOW_MARKERS = ("o", "s")

# Width and height of the picture of a map [inch]. A choice, by looking at the figures.
MAP_SIZE = (7.0, 5.0)

# Values along both axes of a map from which it is drawn by contours. A choice, by looking at the figures.
CONTOUR_VALUES = 6


def to_xarray(result: Any) -> Any:
    """Return an `xarray.Dataset`: a dimension for each varied key, units and long names as attributes. Needs the
    ``study`` extra."""
    xarray = validate.installed("xarray", "study")
    data = {name: (result.dims, values, described(name)) for name, values in result.columns.items()}
    data[STATUS] = (result.dims, result.status.astype(str), {"long_name": "converged, or why there are no numbers"})
    data[MODEL] = (result.dims, result.model.astype(str), {"long_name": "model that answered"})
    data[VALIDITY] = (result.dims, result.validity.astype(str), {"long_name": "assumptions that do not hold"})
    coords = {key: (dim, values, described(key)) for key, (dim, values) in result.coords.items()}
    attributes = {"title": f"friction of {result.plan.scene.name}", "source": f"lubfric {__version__}"}
    return xarray.Dataset(data, coords, attributes)


def to_frame(result: Any) -> Any:
    """Return a tidy `pandas.DataFrame`: one row a point. Needs the ``study`` extra."""
    return validate.installed("pandas", "study").DataFrame(columns_of_study(result))


def to_parquet(result: Any, path: str | Path) -> None:
    """Write the table of `to_frame` as a Parquet file. Needs the ``study`` extra."""
    frame = to_frame(result)
    buffer = io.BytesIO()
    validate.installed("pyarrow", "study")
    frame.to_parquet(buffer)
    write_whole(path, buffer.getvalue())


def to_netcdf(result: Any, path: str | Path) -> None:
    """Write the Dataset of `to_xarray` as a NetCDF file, which appears complete. Needs the ``study`` extra."""
    data = to_xarray(result)
    validate.installed("netCDF4", "study")
    with files.whole_file(path) as part:
        data.to_netcdf(part, engine="netcdf4")


def to_csv(result: Any, path: str | Path) -> None:
    """Write one row for each point, with units in the headings; nothing beyond the standard library is needed. The
    bytes follow from the inputs: the times of the solves are in the other tables."""
    columns = {name: values for name, values in columns_of_study(result).items() if name != "seconds"}
    write_whole(path, table_bytes({heading(name): values for name, values in columns.items()}))


def columns_of_study(result: Any) -> dict[str, np.ndarray]:
    """Return the columns of a table: the varied keys, the speed, the numbers, the status, the model and the validity,
    one value for each point. Places that a curve did not need have no row."""
    shape = result.status.shape
    columns = {}
    for key, (dim, values) in result.coords.items():
        along = [1] * len(shape)
        along[result.dims.index(dim)] = values.size
        columns[key] = np.broadcast_to(values.reshape(along), shape)
    texts = {STATUS: result.status, MODEL: result.model, VALIDITY: result.validity}
    columns |= result.columns | {name: values.astype(str) for name, values in texts.items()}
    used = result.status != UNUSED
    return {name: values[used] for name, values in columns.items()}


def plot_points(result: Any, quantity: str = "coefficient", ax: Axes | None = None, **style: Any) -> Axes:
    """Draw a number of the operating points of a study with its 95 % interval over their position, angle or time, or
    over their number; one line for each combination of what else is varied. Returns the axes.

    ``style``: of the lines, as of `lubfric.StribeckResult.plot`. Points without a position are not joined: rows of a
    table have no order. The lines of f and of the power loss are broken where the direction of sliding changes, as at
    the pitch point of a gear: f jumps there, and the power loss falls to that of rolling.
    """
    from matplotlib.ticker import MaxNLocator

    style = figures.line_style(style, ("quantity", "ax", "label"))
    axes = figures.axes_or_new(ax)
    coordinate = next((name for name in ORDERED_BY if name in result.coords), None)
    count = result.status.shape[-1]
    over = np.arange(1.0, count + 1.0) if coordinate is None else result.coords[coordinate][1]
    over, label_over = _in_people_units(over, coordinate) if coordinate else (over, "operating point")
    order = np.argsort(over, kind="stable")
    unit = unit_of_largest(result[quantity].ravel().tolist(), COLUMNS[quantity].unit)
    times = converted(1.0, COLUMNS[quantity].unit, unit)
    indices = list(np.ndindex(*result.status.shape[:-1]))[:MOST_OF_POINTS]
    for index in indices:
        values = times * result[quantity][index][order]
        sliding = _sliding_speeds(result, index)[order] if quantity in OF_SLIDING else np.zeros(0)
        turns = np.flatnonzero(np.diff(np.sign(sliding))) + 1  # before these points the direction changes
        ends = turns if coordinate else np.arange(1, count)  # before these a line ends
        named = figures.plain_words(label(result.plan, (*index, slice(None)))) if len(indices) > 1 else None
        line_style: dict[str, Any] = {"marker": "o", "ms": 3, "lw": 1.2, "label": named or COLUMNS[quantity].label}
        line_style |= {"color": figures.BLUE} if len(indices) == 1 else {}
        (line,) = axes.plot(np.insert(over[order], ends, np.nan), np.insert(values, ends, np.nan), **line_style | style)
        if quantity in INTERVAL_COLUMNS:
            low, high = (times * result[name][index][order] for name in INTERVAL_COLUMNS[quantity])
            known: dict[str, Any] = {"label": BAND} if index == indices[-1] and np.isfinite(low).any() else {}
            along, *sides = [np.insert(array, ends, np.nan) for array in (over[order], low, high)]
            axes.fill_between(along, sides[0], sides[1], color=line.get_color(), alpha=0.2, lw=0, **known)
            for alone in _lone(ends, order.size):  # no line or band shows the interval of such a point
                axes.vlines(over[order][alone], low[alone], high[alone], color=line.get_color(), alpha=0.4, lw=3)
    if coordinate and quantity in OF_SLIDING:
        first = _sliding_speeds(result, indices[0])[order]
        for number, place in enumerate(places_without_sliding(over[order], first)):
            axes.axvline(place, color=figures.GREY, lw=1.0, ls=":", label=None if number else NO_SLIDING)
    axes.set(xlabel=label_over, ylabel=axis_label(quantity, unit))
    if coordinate is None:
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    figures.key_above(axes, 2)
    return axes


def _sliding_speeds(result: Any, index: tuple[int, ...]) -> np.ndarray:
    """Return u2 - u1 [m/s] of the operating points at the position ``index`` along the other axes; 0 where no ratio is
    varied."""
    speeds = np.array(result.plan.point_speeds)
    if SLIDE_ROLL_RATIO_KEY in result.coords:
        dim, ratios = result.coords[SLIDE_ROLL_RATIO_KEY]
        if dim == result.dims[-1]:
            return speeds * ratios
        return speeds * ratios[index[result.dims.index(dim)]]
    return 0.0 * speeds


def places_without_sliding(over: np.ndarray, sliding: np.ndarray) -> list[float]:
    """Return where a ``sliding`` speed (n,) ``over`` places in ascending order is 0: between two points of opposite
    directions by linear interpolation, and at points where it is 0, of several one after the other the first and the
    last. None where nothing slides anywhere."""
    places = [
        float(over[i] - sliding[i] * (over[i + 1] - over[i]) / (sliding[i + 1] - sliding[i]))
        for i in np.flatnonzero(sliding[:-1] * sliding[1:] < 0)
    ]
    still = sliding == 0
    if still.all():
        return []
    sides = np.pad(still, 1)
    ends = np.flatnonzero(still & ~(sides[:-2] & sides[2:]))
    return sorted([*places, *over[ends].tolist()])


def pairs_around_reversals(result: Any, index: tuple[int, ...]) -> list[tuple[int, int]]:
    """Return the pairs of operating points, by their place in the table from 0, that are neighbours over the position,
    angle or time and slide in opposite directions, at the position ``index`` along the other axes."""
    coordinate = next((name for name in ORDERED_BY if name in result.coords), None)
    if coordinate is None:
        return []
    order = np.argsort(result.coords[coordinate][1], kind="stable")
    sliding = _sliding_speeds(result, index)[order]
    return [(int(order[i]), int(order[i + 1])) for i in np.flatnonzero(sliding[:-1] * sliding[1:] < 0)]


def _lone(ends: np.ndarray, count: int) -> list[int]:
    """Return the places of ``count`` points that are alone between the breaks before ``ends``."""
    first = [0, *ends.tolist()]
    return [a for a, b in zip(first, [*first[1:], count]) if b - a == 1 and count > 1]


def _in_people_units(values: np.ndarray, name: str) -> tuple[np.ndarray, str]:
    """Return the values of the column ``name`` in a common unit, and the label of their axis."""
    unit = unit_of_largest(values.tolist(), COLUMNS[name].unit)
    return values * converted(1.0, COLUMNS[name].unit, unit), axis_label(name, unit)


def name_of(key: str) -> str:
    """Return what the axis of a ``key`` without a unit is called."""
    return COLUMNS[key].label if key in COLUMNS else key.rpartition(".")[2].replace("_", " ")


def shown_numbers(key: str, values: np.ndarray) -> tuple[np.ndarray, str]:
    """Return the ``values`` [SI] of a ``key`` in a unit of people, and the label of their axis; a temperature in °C."""
    if key == "lubricant.temperature":
        return values - float(ZERO_CELSIUS), axis_label("lubricant.temperature_celsius")
    if key not in KEYS and key not in COLUMNS:
        return values, name_of(key)
    si = KEYS[key].unit if key in KEYS else COLUMNS[key].unit
    unit = unit_of_largest(np.asarray(values, dtype=float).ravel().tolist(), si)
    return np.asarray(converted(values, si, unit)), axis_label(key, unit)


def place_in_words(plan: StudyPlan, index: tuple[Any, ...], speed: float) -> str:
    """Return where a point lies, as text: the values of what is varied, and its ``speed`` [m/s]."""
    return ", ".join(filter(None, (label(plan, index), f"speed {worded(speed, 'm/s')}")))


def label(plan: StudyPlan, index: tuple[Any, ...], *, uses_symbols: bool = False) -> str:
    """Return what is varied at the position ``index`` along the axes of a study, as text; ``uses_symbols``: as in the
    key of a picture, "Sq = 50 nm" where the label of a quantity ends with its symbol (`SYMBOL_AT_END`)."""
    places = dict(zip(plan.dims, index))
    along = {
        key: values[places[dim]]
        for key, (dim, values) in plan.coords.items()
        if key != SPEED and isinstance(places.get(dim), int)
    }
    kinds = {key: COLUMNS.get(key, Quantity("-", key.rpartition(".")[2])) for key in along}
    names = {
        key: f"{symbol} =" if uses_symbols and (symbol := SYMBOL_AT_END.get(kind.label)) else kind.label
        for key, kind in kinds.items()
    }
    return ", ".join(f"{names[key]} {worded_value(key, along[key].item())}" for key in kinds)


def check_tools(*, netcdf: bool, parquet: bool) -> None:
    """Raise `InputError` if a package that these tables need is missing."""
    for name in (*(("xarray", "netCDF4") if netcdf else ()), *(("pandas", "pyarrow") if parquet else ())):
        validate.installed(name, "study")


def interval_band(
    ax: Axes,
    over: np.ndarray,
    columns: Columns | dict[str, FloatArray],
    line: Sequence[FloatArray] | None = None,
    *,
    has_parts: bool = True,
    as_bars: bool = False,
    color: Any = figures.BLUE,
    others: int = 0,
) -> list[Line2D]:
    """Draw the intervals of f as one band ``over`` speeds or ratios, if ``columns`` have them, with thin lines for what
    the model and the finite surface leave by themselves, unless not ``has_parts``; ``as_bars``: as a bar at each point
    instead. ``line``: (speeds, f) of a smooth curve to draw the band about. ``color``: of all of it. ``others``: number
    of curves on the axes already; all bands have edges then.
    Returns the thin lines."""
    from matplotlib.colors import to_rgba

    unknown = np.full(over.shape, np.nan)
    f = columns["coefficient"]
    x, y = (over, f) if line is None else line

    def at(error: np.ndarray) -> np.ndarray:
        """Return ``error`` at x, by monotone cubics between the points, which never overshoot them."""
        if line is None or np.count_nonzero(np.isfinite(error)) < 2:
            return error if line is None else np.full(np.shape(x), np.nan)
        good = np.isfinite(error)
        return PchipInterpolator(np.log(over[good]), error[good], extrapolate=False)(np.log(x))

    moves = np.where(f == 0, np.nan, f)
    low, high = (at(columns.get(f"interval_{end}", unknown) / moves - 1) for end in ("low", "high"))
    if not np.isfinite(low).any():
        if "interval_low" in columns:
            ax.fill([], [], fill=False, ec=color, ls="--", lw=0.8, label=f"{BAND} not known")  # a band without ends
        return []
    known = np.isfinite(columns.get("model_error", unknown)[np.isfinite(f)])
    band = BAND
    if not known.any():
        band += ", without model-form error"
    elif not known.all():
        band += ", model-form error where known"
    if as_bars:
        lengths = f - columns["interval_low"], columns["interval_high"] - f
        ax.errorbar(
            _beside(over, others, is_ratio="ratio" in columns),
            f,
            yerr=lengths,
            fmt="none",
            ecolor=color,
            elinewidth=0.8,
            capsize=2.5,
            label=band,
        )
        return []
    ends = y * (1 + low), y * (1 + high)
    wide, *sides = figures.widened(x, *ends)
    drawn_band = ax.fill_between(wide, sides[0], sides[1], fc=to_rgba(color, BAND_ALPHA), lw=0, label=band)
    drawn_band.set_gid(BAND)
    for each in ax.collections if others else ():
        if each.get_gid() == BAND:  # of this curve and of the others
            (red, green, blue, _) = np.asarray(each.get_facecolor())[0].tolist()
            each.set(edgecolor=(red, green, blue, BAND_EDGE_ALPHA), linewidth=BAND_EDGE_WIDTH)
    freedom = columns.get("sampling_freedom", unknown)
    of_sample = [half_width_of_error(*pair) for pair in zip(columns.get("sampling_error", unknown), freedom)]
    at_95 = dict(columns) | {"sampling_error": np.array(of_sample)}
    drawn: list[Line2D] = []
    for name, dashes in OF_INTERVAL if has_parts else ():
        error = at(at_95.get(name, unknown))
        towards, away = (at(columns.get(f"{name}_{end}", unknown)) for end in ("low", "high"))
        towards, away = (np.where(np.isfinite(side), side, error) for side in (towards, away))
        if np.nanmax(error, initial=0.0) > 0:
            thin: dict[str, Any] = {"color": color, "lw": 0.6, "ls": dashes}
            within = np.maximum(y * (1 - towards), ends[0]), np.minimum(y * (1 + away), ends[1])  # a part of the whole
            wide, *sides = figures.widened(x, *within)
            label_of_error = f"{name.partition('_')[0].replace('model', 'model-form')} error alone"
            drawn += ax.plot(wide, sides[0], **thin)
            drawn += ax.plot(wide, sides[1], **thin, label=label_of_error)
    return drawn


def _beside(over: FloatArray, others: int, *, is_ratio: bool) -> FloatArray:
    """Return places of bars a little beside the points that are ``over`` speeds or ratios, such that they do not cover
    those of the ``others``."""
    if is_ratio:
        return over + others * BAR_STEP * (np.nanmax(over) - np.nanmin(over))
    return over * (over.max() / over.min()) ** (others * BAR_STEP)


@dataclass(frozen=True, kw_only=True)
class FrictionLines:
    """The lines of a drawn curve: of ``f``, of its ``parts``, and the thin ones of single ``errors`` in its band."""

    f: Line2D
    parts: tuple[Line2D, ...]
    errors: tuple[Line2D, ...]


def friction_over_speed(
    axes: Axes,
    columns: Mapping[str, np.ndarray],
    *,
    has_parts: bool = True,
    as_bars: bool = False,
    has_interval: bool = True,
    without: Container[str] = (),
    others: int = 0,
    models: Collection[str] = (),
    **style: Any,
) -> FrictionLines:
    """Draw friction over the magnitude of the speed with its parts and its intervals (``has_parts``, ``as_bars``,
    ``others``: as of `interval_band`; ``has_interval``: whether there are any; ``without``: names of parts that are
    omitted; ``style``: of the line of f), by the ``columns`` of a `lubfric.StribeckResult`. Between two points where f
    is known to `DRAWN_ERROR` its line is solid, and dashed up to `LARGEST_BETWEEN`. ``models``: as of
    `mark_models`. A column `OVER_X` takes the place of the speed on the axis. Points that failed, and rest, are omitted."""
    good = np.isfinite(columns["coefficient"]) & (columns["speed"] != 0)
    order = np.flatnonzero(good)[np.argsort(np.abs(columns["speed"][good]))]
    c = {name: column[order] for name, column in columns.items()}
    speed = np.abs(c["speed"])
    x = c.get(OVER_X, speed)
    load = c["contact_load"] + c["film_load"]
    curve = _interpolant(c)
    of_gaps = np.full(1, np.inf) if curve is None else errors_of_gaps(curve)
    line = _line(curve) if curve is not None and of_gaps.max() <= LARGEST_BETWEEN else None
    color = style.get("color", figures.BLUE)
    errors: list[Line2D] = []
    if has_interval:
        about = line and (_x_at(line[0], speed, x), line[1])
        errors = interval_band(axes, x, c, about, has_parts=has_parts, as_bars=as_bars, color=color, others=others)
    if curve is not None and line is not None:
        is_whole = bool({"ls", "linestyle"} & set(style)) or of_gaps.max() <= DRAWN_ERROR
        gap = np.clip(np.searchsorted(curve.samples.speed, line[0], side="right") - 1, 0, of_gaps.size - 1)
        is_uncertain = (of_gaps > DRAWN_ERROR)[gap] & (not is_whole)
        shown = (np.where(is_uncertain, np.nan, line[1]), *line[2:])
        fine = _x_at(line[0], speed, x)
        (f, *of_parts) = figures.friction_lines(axes, fine, shown, without=without, **style)
        if is_uncertain.any():
            joined = np.convolve(is_uncertain, (1, 1, 1), "same") > 0  # with the ends of the solid pieces
            dashed: dict[str, Any] = {"ls": "--", "color": color, "lw": f.get_linewidth()}
            axes.plot(fine, np.where(joined, line[1], np.nan), **dashed)
            axes.plot([], [], ls="--", color=figures.GREY, label=figures.INTERPOLATED_BETWEEN)
        axes.plot(x, c["coefficient"], "o", ms=4, color=color)
    else:
        parts = c["coefficient"], c["boundary_force"] / load, c["shear_force"] / load
        if speed.size > 1:  # a dotted line joins the points, and is no curve
            axes.plot(x, parts[0], ls=style.get("ls", ":"), color=color, label=figures.NOT_BETWEEN)
        points = {"marker": "o", "ms": 4} | style | {"ls": ""}
        (f, *of_parts) = figures.friction_lines(axes, x, parts, without=without, **points)
    mark_models(axes, x, c, color, models)
    axes.set(xscale="log", xlabel=figures.speed_label(c["speed"]), ylabel=figures.FRICTION_LABEL)
    figures.plain_ticks(axes.xaxis)
    axes.set_ylim(bottom=min(0.0, 1.1 * float(c["coefficient"].min(initial=0.0))))
    figures.key_above(axes)
    return FrictionLines(f=f, parts=tuple(of_parts), errors=tuple(errors))


def _x_at(at: FloatArray, speed: FloatArray, x: FloatArray) -> FloatArray:
    """Return the place on the axis of speeds ``at`` between the solved ones, (n,), that are at ``x``."""
    if x is speed:
        return at
    return np.exp(PchipInterpolator(np.log(speed), np.log(x))(np.log(at)))


def mark_models(
    axes: Axes, x: FloatArray, columns: Mapping[str, np.ndarray], color: Any, models: Collection[str] = ()
) -> None:
    """Make those points at ``x`` hollow that the ``columns`` state to be of a simpler model than others of the picture.
    ``models``: names of the models of other curves in it."""
    of_points = columns.get(MODEL, np.full(x.shape, ""))
    by_cost = [model.name for model in MODELS if model.name in {*models, *of_points.tolist()}]
    for name, marker in zip(by_cost[:-1], HOLLOW_MARKERS):
        chosen = of_points == name
        if chosen.any():
            hollow: dict[str, Any] = {"ls": "", "marker": marker, "ms": 4, "mfc": "w", "mec": color, "zorder": 2.5}
            axes.plot(x[chosen], columns["coefficient"][chosen], **hollow, label=title_of(name))


def _interpolant(columns: dict[str, np.ndarray]) -> Interpolant | None:
    """Return the curve through the points in ``columns``; None where there is none."""
    try:
        return through(columns)
    except (InputError, KeyError):  # too few of them, both directions, or a table without what the curve needs
        return None


def _line(curve: Interpolant) -> tuple[np.ndarray, ...]:
    """Return (speeds, f, its two parts) on the ``curve`` through the points."""
    fine = np.geomspace(curve.samples.speed[0], curve.samples.speed[-1], 2 * LINE_POINTS)
    contact = curve.boundary(fine)
    film = curve.film(fine)
    return fine, contact + film, contact, film


def plot_map(
    path: Path,
    study: Any,
    across: str,
    up: str,
    title: str = "",
    quantity: str = "coefficient",
    *,
    size: tuple[float, float] = MAP_SIZE,
) -> None:
    """Draw ``quantity`` of a `StudyResult` as contours over two of its keys, for example ``"speed"`` and
    ``"motion.slide_roll_ratio"``, each in a unit in which its largest value is 1 or more.

    ``size``: width and height [inch]. Points that have no number are marked. Raises `InputError` unless the two keys
    are its only dimensions, and numbers of which there are two at least.
    """
    coords = study.coords
    for key in (across, up):
        if key not in coords:
            raise InputError(f"{key!r} is not varied in this study; allowed: {', '.join(coords)}")
    dims = [coords[up][0], coords[across][0]]
    longer = [d for d, n in zip(study.dims, study.status.shape) if n > 1 and d not in dims]
    if longer or dims[0] == dims[1]:
        raise InputError(f"a map needs two dimensions, this study varies {', '.join(study.dims)} as well")
    axes = [study.dims.index(d) for d in dims]
    values = np.moveaxis(study[quantity], axes, (0, 1)).reshape(*(study.status.shape[a] for a in axes))
    (x, x_label), (y, y_label) = (shown_numbers(key, _numbers(key, coords[key][1])) for key in (across, up))
    values, x, y = values[np.argsort(y)][:, np.argsort(x)], np.sort(x), np.sort(y)
    figure = figures.new_figure(figsize=size)
    ax = figure.subplots()
    bar = figures.FRICTION_LABEL if quantity == "coefficient" else axis_label(quantity)
    if min(values.shape) < CONTOUR_VALUES:
        _table_of(ax, x, y, values, bar)
    else:
        known = np.ma.masked_invalid(values)
        shown = ax.contourf(x, y, known, levels=16, cmap="viridis")
        ax.contour(x, y, known, levels=16, colors="w", linewidths=0.4)
        rows, places = np.nonzero(~np.isfinite(values))
        if rows.size:
            ax.plot(x[places], y[rows], "x", color=figures.RED, label="no answer")
            ax.legend(frameon=False)
        figures.log_if_wide(ax, "x", x)
        figures.log_if_wide(ax, "y", y)
        figure.colorbar(shown, label=bar)
    ax.set(xlabel=x_label, ylabel=y_label, title=title)
    figure.savefig(path, dpi=150)


def _table_of(ax: Axes, x: FloatArray, y: FloatArray, values: FloatArray, bar: str) -> None:
    """Draw few values (ny, nx) as a table of colours with their numbers: contours would say more than is known."""
    image = ax.imshow(values, origin="lower", aspect="auto", cmap="viridis")
    ax.grid(visible=False)
    middle = 0.5 * (np.nanmin(values) + np.nanmax(values))
    for (row, column), value in np.ndenumerate(values):
        known = np.isfinite(value)
        colour = figures.RED
        if known:
            colour = "k" if value > middle else "w"
        ax.text(column, row, f"{value:.3g}" if known else "no answer", ha="center", va="center", color=colour)
    ax.set_xticks(range(x.size), [f"{value:.4g}" for value in x])
    ax.set_yticks(range(y.size), [f"{value:.4g}" for value in y])
    ax.figure.colorbar(image, ax=ax, label=bar)


def _numbers(key: str, values: np.ndarray) -> np.ndarray:
    """Return the values [SI] of a key along one axis of a map."""
    if values.dtype.kind != "f" or np.unique(values).size < max(2, values.size):
        raise InputError(f"{key} = {', '.join(map(str, values))}; an axis of a map takes two or more different numbers")
    return values
