"""A study as tables for other tools; each tool is imported only when its table is asked for."""

from __future__ import annotations

import io
from importlib import import_module

import numpy as np

from .._base import table_bytes, whole_file, write_whole
from ..errors import InputError
from ..quantities import KEYS, QUANTITIES, described, heading
from .table_row import SPEED, UNUSED

UNCERTAINTY, LENGTH = "uncertainty_", "uncertainty_length"  # columns of the uncertainty, and the one in m


def to_xarray(result):
    """See `StudyResult.to_xarray`."""
    xarray = _tool("xarray")
    data = {name: (result.dims, values, _attributes(name, result)) for name, values in result.columns.items()}
    data["status"] = (result.dims, result.status.astype(str), {"long_name": "converged, or why there are no numbers"})
    data["validity"] = (result.dims, result.validity.astype(str), {"long_name": "assumptions that do not hold"})
    coords = {key: (dim, values, described(key, KEYS)) for key, (dim, values) in result.coords.items()}
    attributes = {"title": f"friction of {result.plan['name']}", "source": f"lubfric {result.plan['lubfric']}"}
    return xarray.Dataset(data, coords, attributes)


def to_frame(result):
    """See `StudyResult.to_frame`."""
    return _tool("pandas").DataFrame(columns_of(result))


def to_parquet(result, path) -> None:
    """See `StudyResult.to_parquet`."""
    frame = to_frame(result)
    _tool("pyarrow")
    buffer = io.BytesIO()
    frame.to_parquet(buffer)
    write_whole(path, buffer.getvalue())


def to_netcdf(result, path) -> None:
    """The Dataset of `to_xarray` as a NetCDF file, which appears whole."""
    data = to_xarray(result)
    _tool("netCDF4")
    with whole_file(path) as part:
        data.to_netcdf(part, engine="netcdf4")


def to_csv(result, path) -> None:
    """See `StudyResult.to_csv`."""
    write_whole(path, table_bytes({_heading(name): values for name, values in columns_of(result).items()}))


def columns_of(result) -> dict[str, np.ndarray]:
    """The columns of a table: the varied keys, the speed, the numbers, the status and the validity, one value for
    each point. Places that a curve did not need have no row."""
    shape, columns = result.status.shape, {}
    for key, (dim, values) in result.coords.items():
        along = [1] * len(shape)
        along[result.dims.index(dim)] = values.size
        columns[key] = np.broadcast_to(values.reshape(along), shape).ravel()
    numbers = {name: values.ravel() for name, values in result.columns.items()}
    words = {"status": result.status, "validity": result.validity}
    found = columns | numbers | {name: values.astype(str).ravel() for name, values in words.items()}
    used = result.status.ravel() != UNUSED
    return found if used.all() else {name: values[used] for name, values in found.items()}


def _attributes(name: str, result) -> dict[str, str]:
    if name.startswith(UNCERTAINTY):
        part = name.removeprefix(UNCERTAINTY)
        return {
            "units": "m" if name == LENGTH else "1",
            "long_name": f"uncertainty of the friction coefficient: {part}",
        }
    return described(name, KEYS if name == SPEED else QUANTITIES)


def _heading(name: str) -> str:
    if name.startswith(UNCERTAINTY):
        return f"{name} [m]" if name == LENGTH else f"{name} [-]"
    return heading(name) if name in KEYS | QUANTITIES else name


def check_tools(netcdf: bool, parquet: bool) -> None:
    """Raise `InputError` if a package that these tables need is missing."""
    for name in (*(("xarray", "netCDF4") if netcdf else ()), *(("pandas", "pyarrow") if parquet else ())):
        _tool(name)


def _tool(name: str):
    try:
        return import_module(name)
    except ImportError:
        raise InputError(f"this table needs the package {name}: pip install 'lubfric[study]'") from None
