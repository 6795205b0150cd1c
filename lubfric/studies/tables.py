"""A study as tables for other tools, each imported only when its table is asked for; and its curves drawn."""

from __future__ import annotations

import io
from importlib import import_module

import numpy as np

from .._base import axes_or_new, plain_words, table_bytes, whole_file, write_whole
from ..errors import InputError
from ..quantities import KEYS, described, heading
from .rows import SPEED, STATUS, UNUSED, VALIDITY

MOST, NAMED, FINE = 50, 10, 200  # lines, lines with a label, points of a line between solved ones


def to_xarray(result):
    """An `xarray.Dataset`: a dimension for each varied key, units and long names as attributes. Needs the ``study``
    extra."""
    xarray = _tool("xarray")
    data = {name: (result.dims, values, described(name)) for name, values in result.columns.items()}
    data[STATUS] = (result.dims, result.status.astype(str), {"long_name": "converged, or why there are no numbers"})
    data[VALIDITY] = (result.dims, result.validity.astype(str), {"long_name": "assumptions that do not hold"})
    coords = {key: (dim, values, described(key)) for key, (dim, values) in result.coords.items()}
    attributes = {"title": f"friction of {result.plan['name']}", "source": f"lubfric {result.plan['lubfric']}"}
    return xarray.Dataset(data, coords, attributes)


def to_frame(result):
    """A tidy `pandas.DataFrame`: one row a point. Needs the ``study`` extra."""
    return _tool("pandas").DataFrame(_table(result))


def to_parquet(result, path) -> None:
    """The table of `to_frame` as a Parquet file. Needs the ``study`` extra."""
    frame, buffer = to_frame(result), io.BytesIO()
    _tool("pyarrow")
    frame.to_parquet(buffer)
    write_whole(path, buffer.getvalue())


def to_netcdf(result, path) -> None:
    """The Dataset of `to_xarray` as a NetCDF file, which appears whole. Needs the ``study`` extra."""
    data = to_xarray(result)
    _tool("netCDF4")
    with whole_file(path) as part:
        data.to_netcdf(part, engine="netcdf4")


def to_csv(result, path) -> None:
    """One row a point, the unit in the heading; nothing beyond the standard library needed."""
    write_whole(path, table_bytes({heading(name): values for name, values in _table(result).items()}))


def _table(result) -> dict[str, np.ndarray]:
    """The columns of a table: the varied keys, the speed, the numbers, the status and the validity, one value for
    each point. Places that a curve did not need have no row."""
    shape, columns = result.status.shape, {}
    for key, (dim, values) in result.coords.items():
        along = [1] * len(shape)
        along[result.dims.index(dim)] = values.size
        columns[key] = np.broadcast_to(values.reshape(along), shape)
    columns |= result.columns | {STATUS: result.status.astype(str), VALIDITY: result.validity.astype(str)}
    used = result.status != UNUSED
    return {name: values[used] for name, values in columns.items()}


def plot(result, ax=None, **style):
    """f over speed, a line for each curve (at most 50 of them, evenly picked), on ``ax`` or new axes, which are
    returned; ``style``: of the lines. Where speeds were chosen, the lines are interpolated."""
    from matplotlib import colormaps

    axes, indices = axes_or_new(ax), list(np.ndindex(*result.status.shape[:-1]))
    picked = np.unique(np.linspace(0, len(indices) - 1, min(MOST, len(indices))).astype(int))
    for index, colour in zip((indices[i] for i in picked), colormaps["viridis"](np.linspace(0.0, 0.9, picked.size))):
        own = {"color": colour, "lw": 1.0} | style
        if picked.size <= NAMED:
            own = {"label": plain_words(_label(result, index))} | own
        speed = np.abs(result.columns[SPEED][index] if result.chosen else result.coords[SPEED][1])
        f, curve = result.columns["coefficient"][index], result.curve(index) if result.chosen else None
        good = np.flatnonzero(np.isfinite(f) & (speed > 0))
        good = good[np.argsort(speed[good])]
        if curve is None:
            axes.plot(speed[good], f[good], "o-", ms=3, **own)
            continue
        fine = np.geomspace(speed[good][0], speed[good][-1], FINE)
        axes.plot(fine, curve.at(fine), **own)
        axes.plot(speed[good], f[good], "o", ms=3, color=own["color"])
    axes.set(xscale="log", xlabel="entrainment speed U (m/s)", ylabel="friction coefficient (-)")
    if 1 < picked.size <= NAMED:
        axes.legend(frameon=False)
    axes.set_title(f"{plain_words(result.plan['name'])}: {picked.size} of {len(indices)} curves")
    return axes


def _label(result, index) -> str:
    words = []
    for key, (dim, values) in result.coords.items():
        if key != SPEED:
            value, unit = values[index[result.dims.index(dim)]], KEYS[key].unit if key in KEYS else "-"
            text = f"{value:.4g}" if isinstance(value, float) else str(value)
            words.append(f"{key.rpartition('.')[2]} {text}{'' if unit == '-' else ' ' + unit}")
    return ", ".join(words)


def check_tools(netcdf: bool, parquet: bool) -> None:
    """Raise `InputError` if a package that these tables need is missing."""
    for name in (*(("xarray", "netCDF4") if netcdf else ()), *(("pandas", "pyarrow") if parquet else ())):
        _tool(name)


def _tool(name: str):
    try:
        return import_module(name)
    except ImportError:
        raise InputError(f"this table needs the package {name}: pip install 'lubfric[study]'") from None
