"""The contact of one operating point as a file for ParaView: legacy VTK, a structured grid, binary."""

from __future__ import annotations

import numpy as np

from ..sampling import FrictionResult
from ..sharing import Prepared

FIELDS = ("height", "contact_pressure", "gap", "film_thickness", "film_pressure")


def vtk_bytes(prepared: Prepared, point: FrictionResult) -> bytes:
    """Height [m], contact pressure [Pa], gap [m]; constant along the line: film thickness [m], film pressure [Pa].

    At the cells of the contact, in the plane z = 0 (warp by "height" to see the surface). ``point`` needs fields
    (``fields=True``) and contact, or the deterministic model. What a point does not have is left out.
    """
    x, y = point.x, point.y
    shape = (x.size, y.size)
    found = {"contact_pressure": point.pressure, "gap": point.gap}
    if prepared.surface.shape == shape:
        found["height"] = prepared.surface.heights - np.nanmean(prepared.surface.heights)
    film = None if point.balance is None else point.balance.film
    if film is not None:
        found["film_thickness"] = np.repeat(film.film_at(x)[:, None], y.size, axis=1)
        pressure = np.interp(x, film.x, film.pressure, left=0.0, right=0.0)
        found["film_pressure"] = np.repeat(pressure[:, None], y.size, axis=1)
    return grid_bytes(x, y, {name: found[name] for name in FIELDS if name in found}, f"U = {point.speed:g} m/s")


def grid_bytes(x: np.ndarray, y: np.ndarray, fields: dict[str, np.ndarray], title: str) -> bytes:
    """Point data (nx, ny) on the grid ``x`` (nx,), ``y`` (ny,) [m], in the legacy VTK format 3.0, big-endian binary."""
    points = np.zeros((y.size, x.size, 3))
    points[..., 0], points[..., 1] = x[None, :], y[:, None]
    parts = [
        f"# vtk DataFile Version 3.0\nlubfric, {title}, SI units\nBINARY\nDATASET STRUCTURED_GRID\n"
        f"DIMENSIONS {x.size} {y.size} 1\nPOINTS {x.size * y.size} double\n".encode(),
        _big(points),
        f"\nPOINT_DATA {x.size * y.size}\n".encode(),
    ]
    for name, values in fields.items():
        parts += [f"SCALARS {name} double 1\nLOOKUP_TABLE default\n".encode(), _big(values.T), b"\n"]
    return b"".join(parts)


def _big(values: np.ndarray) -> bytes:
    return np.ascontiguousarray(values, dtype=">f8").tobytes()
