"""Fields of a run as files: fields.npz, and contact_0.vtk ... for ParaView."""

import io
import json
import zlib
from collections.abc import Iterable
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from .._base import validate, write_whole
from ..errors import InputError
from ..estimate import FrictionResult
from ..models import ContactFields
from ..models.deterministic import Moment
from .contact_pictures import DrawnContact

# Fields of `lubfric.models.ContactFields`, all on the same cells.
FIELDS = ("heights", "pressure", "gap", "deflection", "film", "shear")

# Relative: a speed as a user reads it, of three digits; a choice: less misses speeds that a user rounds.
SAME_SPEED = 1e-3

OF_STRIP = ("x", "pressure", "gap", "fill", "shear", "dent", "touching", "rubbing", "wet")  # of a `DeterministicResult`


def fields_bytes(points: list[FrictionResult], half_width: float) -> bytes:
    """Return the fields of some speeds as arrays named ``<quantity>_<index>``, and ``speed`` and the ``half_width``
    of the Hertz strip; SI units.

    Of each point x, y and all fields of one solve, on the same cells; ``solve`` says which. Of the smooth film of load
    sharing x, thickness and pressure on its own nodes; of the first strip of the deterministic model all its fields, on
    the cells of the answer, under names that begin with ``strip_``.
    """
    arrays: dict[str, np.ndarray] = {
        "speed": np.array([point.speed for point in points]),
        "half_width": np.array(half_width),
    }
    for i, point in enumerate(points):
        film = point.smooth_film
        if film is not None:
            arrays |= {f"film_x_{i}": film.x, f"film_thickness_{i}": film.film_thickness}
            arrays[f"film_pressure_{i}"] = film.pressure
        if point.fields is not None:
            arrays |= {f"{name}_{i}": getattr(point.fields, name) for name in ("x", "y", *FIELDS)}
            arrays[f"solve_{i}"] = np.array(point.fields.solve)
            arrays[f"pressure_includes_film_{i}"] = np.array(point.fields.pressure_includes_film)
        strip = point.deterministic
        if strip is not None:
            arrays |= {f"strip_{name}_{i}": getattr(strip, name) for name in OF_STRIP}
            arrays[f"strip_spacing_{i}"] = np.array(strip.spacing)
    return npz_bytes(arrays)


def read_contact(path: Path, speed: float) -> DrawnContact:
    """Return the contact at one ``speed`` [m/s] of those whose fields `fields_bytes` put into the file ``path``.

    Raise `InputError` where the file does not hold it, or is damaged.
    """
    again = "run 'lubfric run' again"
    if not path.is_file():
        raise InputError(f"{path.parent} has no {path.name}; {again}")
    try:
        with open(path, "rb") as stream, np.load(stream) as file:
            arrays = dict(file)
    except (OSError, ValueError, EOFError, KeyError, BadZipFile, zlib.error) as error:
        raise InputError(f"{path} is damaged ({error}); {again}") from error
    if "half_width" not in arrays or "speed" not in arrays:
        raise InputError(f"{path} does not contain the contact of a steady run by this version; {again}")
    speeds = arrays["speed"]
    near = np.flatnonzero(np.isclose(speeds, speed, rtol=SAME_SPEED, atol=0.0))
    if near.size == 0:
        known = ", ".join(f"{each:.4g}" for each in speeds)
        raise InputError(
            f" = {speed:g} m/s: {path.name} has the fields at {known} m/s",
            "--contact",
            f"one of {known} m/s",
            f"run the scene again with 'lubfric run --fields {speed:g}'",
        )
    i = near[0]
    fields = None
    if f"pressure_includes_film_{i}" in arrays:
        of_point = {name: arrays[f"{name}_{i}"] for name in ("x", "y", *FIELDS)}
        fields = ContactFields(
            solve=str(arrays[f"solve_{i}"]),
            **of_point,
            pressure_includes_film=bool(arrays[f"pressure_includes_film_{i}"]),
        )
    return DrawnContact(
        speed=float(speeds[i]),
        half_width=float(arrays["half_width"]),
        fields=fields,
        has_film=f"film_x_{i}" in arrays,
    )


def vtk_bytes(point: FrictionResult) -> bytes:
    """Return height [m], pressure [Pa], gap [m], film thickness [m] and shear stress [Pa] of the cells of one
    solve; of load sharing the pressure of the smooth film [Pa], constant along the line.

    In the plane z = 0 (warp by "height" to see the surface).
    """
    fields = point.fields
    assert fields is not None
    names = {"height": "heights", "pressure": "pressure", "gap": "gap", "film_thickness": "film", "shear": "shear"}
    arrays = {name: getattr(fields, of) for name, of in names.items()}
    film = point.smooth_film
    if film is not None:
        pressure = np.interp(fields.x, film.x, film.pressure, left=0.0, right=0.0)
        arrays["film_pressure"] = np.repeat(pressure[:, None], fields.y.size, axis=1)
    return grid_bytes(fields.x, fields.y, arrays, f"U = {point.speed:g} m/s, {fields.solve}")


def write_moments(folder: Path | str, moments: Iterable[Moment]) -> None:
    """Write gap [m], pressure [Pa], height [m] and filled part of moments (`lubfric.models.deterministic.moments`) as
    moment_0000.vtk ... in ``folder``; and moments.vtk.series with their times [s], which ParaView plays."""
    home = validate.folder("folder", folder)
    files = []
    home.mkdir(parents=True, exist_ok=True)
    for number, moment in enumerate(moments):
        problem = moment.at.problem
        state = moment.at.state
        name = f"moment_{number:04d}.vtk"
        y = np.arange(moment.at.gap.shape[1]) * problem.spacing[1]
        fields = {"gap": moment.at.mass_balance.flow_gap, "pressure": state.pressure, "height": problem.heights}
        write_whole(home / name, grid_bytes(problem.x, y, fields | {"fill": state.fill}, f"t = {moment.time:g} s"))
        files.append({"name": name, "time": moment.time})
    write_whole(home / "moments.vtk.series", json.dumps({"file-series-version": "1.0", "files": files}).encode())


def grid_bytes(x: np.ndarray, y: np.ndarray, fields: dict[str, np.ndarray], title: str) -> bytes:
    """Return point data (nx, ny) on the grid ``x`` (nx,), ``y`` (ny,) [m]: legacy VTK format 3.0, big-endian binary."""
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
    """Return ``arrays`` as a compressed ``.npz`` file."""
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # NumPy types allow_pickle, not the arrays
    return file.getvalue()
