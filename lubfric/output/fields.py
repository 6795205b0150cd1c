"""Fields of a run as files: fields.npz, and contact_0.vtk ... for ParaView."""

import io
import json
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from .._base import validate, write_whole
from ..estimate import FrictionResult
from ..models.deterministic import Moment
from ..models.shared import Prepared

OF_ONE_GAP = ("x", "pressure", "gap", "fill", "shear", "dent", "touching", "spots", "wet")  # of a DeterministicResult


def fields_bytes(prepared: Prepared, points: list[FrictionResult]) -> bytes:
    """Film and contact fields of some speeds: arrays named ``<quantity>_<index>``, and ``speed``; SI units.

    A point of the deterministic model has the fields of its first strip, on cells of its own (``spacing_<index>``).
    Another speed whose contact has other cells than the first one has their map and x under its index too.
    """
    arrays = {"speed": np.array([p.speed for p in points])}
    if any(point.deterministic is None for point in points):
        arrays |= _map_of(prepared, points[0])
    for i, point in enumerate(points):
        film = point.balance.film if point.balance else None
        found = {}
        if point.deterministic is not None:
            result = point.deterministic
            found = {name: getattr(result, name) for name in OF_ONE_GAP} | {"spacing": np.array(result.spacing)}
        elif film is not None:
            found = {"film_x": film.x, "film_thickness": film.film_thickness, "film_pressure": film.pressure}
        if point.deterministic is None and point.shows_contact:
            found |= {"contact_pressure": point.pressure, "gap": point.gap}
            if point.heights is not None and point.heights.shape != arrays["heights"].shape:
                found |= _map_of(prepared, point)
        arrays |= {f"{name}_{i}": array for name, array in found.items()}
    return npz_bytes(arrays)


def _map_of(prepared: Prepared, point: FrictionResult) -> dict[str, np.ndarray]:
    """Heights, cells and x of the contact of ``point``; those that were solved first where it shows none."""
    if point.heights is None or not point.shows_contact or point.deterministic is not None:
        surface = prepared.surface
        return {"heights": surface.heights, "spacing": np.array(surface.spacing), "contact_x": prepared.contact.x}
    spacing = np.array([point.x[1] - point.x[0], point.y[1] - point.y[0]])
    return {"heights": point.heights, "spacing": spacing, "contact_x": point.x}


def vtk_bytes(prepared: Prepared, point: FrictionResult) -> bytes:
    """Height [m], contact pressure [Pa], gap [m]; constant along the line: film thickness [m], film pressure [Pa].

    At the cells of the contact, in the plane z = 0 (warp by "height" to see the surface). ``point`` needs fields
    (``fields=True``) and contact, or the deterministic model. What a point does not have is left out.
    """
    x = point.x
    y = point.y
    fields = {}
    heights = prepared.surface.heights if point.heights is None else point.heights
    if heights.shape == (x.size, y.size):
        fields["height"] = heights - np.nanmean(heights)
    fields |= {"contact_pressure": point.pressure, "gap": point.gap}
    film = point.balance.film if point.balance else None
    if film is not None:
        pressure = np.interp(x, film.x, film.pressure, left=0.0, right=0.0)
        for name, values in (("film_thickness", film.film_at(x)), ("film_pressure", pressure)):
            fields[name] = np.repeat(values[:, None], y.size, axis=1)
    return grid_bytes(x, y, fields, f"U = {point.speed:g} m/s")


def write_moments(folder: Path | str, moments: Iterable[Moment]) -> None:
    """Gap [m], pressure [Pa], height [m] and filled part of moments (`lubfric.models.deterministic.moments`) as
    moment_0000.vtk ... in ``folder``; and moments.vtk.series with their times [s], which ParaView plays."""
    home = validate.folder("folder", folder)
    files = []
    home.mkdir(parents=True, exist_ok=True)
    for number, moment in enumerate(moments):
        problem = moment.at.problem
        state = moment.at.state
        name = f"moment_{number:04d}.vtk"
        y = np.arange(moment.at.gap.shape[1]) * problem.spacing[1]
        fields = {"gap": moment.at.balance.film, "pressure": state.pressure, "height": problem.heights}
        write_whole(home / name, grid_bytes(problem.x, y, fields | {"fill": state.fill}, f"t = {moment.time:g} s"))
        files.append({"name": name, "time": moment.time})
    write_whole(home / "moments.vtk.series", json.dumps({"file-series-version": "1.0", "files": files}).encode())


def grid_bytes(x: np.ndarray, y: np.ndarray, fields: dict[str, np.ndarray], title: str) -> bytes:
    """Point data (nx, ny) on the grid ``x`` (nx,), ``y`` (ny,) [m]: legacy VTK format 3.0, big-endian binary."""
    points = np.zeros((y.size, x.size, 3))
    points[..., 0] = x[None, :]
    points[..., 1] = y[:, None]
    parts = [
        f"# vtk DataFile Version 3.0\nlubfric, {title}, SI units\nBINARY\nDATASET STRUCTURED_GRID\n"
        f"DIMENSIONS {x.size} {y.size} 1\nPOINTS {x.size * y.size} double\n".encode(),
        _big_endian(points),
        f"\nPOINT_DATA {x.size * y.size}\n".encode(),
    ]
    for name, values in fields.items():
        parts += [f"SCALARS {name} double 1\nLOOKUP_TABLE default\n".encode(), _big_endian(values.T), b"\n"]
    return b"".join(parts)


def _big_endian(values: np.ndarray) -> bytes:
    return np.ascontiguousarray(values, dtype=">f8").tobytes()


def npz_bytes(arrays: dict[str, np.ndarray]) -> bytes:
    """``arrays`` as a compressed ``.npz`` file."""
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # NumPy types allow_pickle, not the arrays
    return file.getvalue()
