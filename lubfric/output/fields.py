"""Fields of a run as a file: fields.npz."""

import io

import numpy as np

from ..sampling import FrictionResult
from ..sharing import Prepared

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
        film, found = point.balance.film if point.balance else None, {}
        if point.deterministic is not None:
            result = point.deterministic.result
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


def npz_bytes(arrays: dict[str, np.ndarray]) -> bytes:
    """``arrays`` as a compressed ``.npz`` file."""
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # NumPy types allow_pickle, not the arrays
    return file.getvalue()
