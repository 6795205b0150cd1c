"""Results as the contents of files: result.json, fields.npz."""

from __future__ import annotations

import io
import platform
from dataclasses import asdict

import numpy as np

from .._base import __version__, plain
from ..sampling import FrictionResult
from ..scene import Scene, scene_as_dict
from ..sharing import Prepared, on_cells_of
from ..studies import QUANTITIES, StribeckResult
from ..surface import Surface, rms_slope


def curve_record(prepared: Prepared, curve: StribeckResult, seconds: float) -> dict:
    """The record of a run in plain JSON types: resolved input, versions, seed, timings, numbers and reports."""
    record = made_of(prepared.scene, prepared.surface, statistics=_statistics(prepared.surface)) | {
        "seed": prepared.scene.surface.seed if prepared.scene.surface.file is None else None,
        "seconds": seconds,
        "report": curve.report.as_dict(),
        "validity": list(curve.validity),
        "points": [_point(curve, i) for i in range(curve.speed.size)],
    }
    return plain(record)


def made_of(scene: Scene, surface: Surface, **described: object) -> dict:
    """The beginning of every record of a run: the resolved input, the map (and how it is ``described``), versions."""
    import scipy

    map_ = {"shape": surface.heights.shape, "spacing": surface.spacing, **described, "notes": list(surface.notes)}
    versions = {"lubfric": __version__, "numpy": np.__version__, "scipy": scipy.__version__}
    versions["python"] = platform.python_version()
    return {"scene": scene_as_dict(scene), "surface": map_, "versions": versions}


def fields_bytes(prepared: Prepared, points: list[FrictionResult]) -> bytes:
    """Film and contact fields of some speeds: arrays named ``<quantity>_<index>``, and ``speed``.

    A speed whose contact was solved on other cells than those of ``prepared`` has their map and x under its index too.
    """
    arrays = {"speed": np.array([p.speed for p in points])} | _map_of(prepared, "")
    solved = [(point.balance, point.line) for point in points if point.balance is not None]
    for i, (balance, line) in enumerate(solved):
        film, contact = balance.film, balance.contact.fields
        its = on_cells_of(prepared, line)
        if its is not prepared:
            arrays |= _map_of(its, f"_{i}")
        if film is not None:
            arrays |= {
                f"film_x_{i}": film.x,
                f"film_thickness_{i}": film.film_thickness,
                f"film_pressure_{i}": film.pressure,
            }
        if contact is not None:
            arrays |= {f"contact_pressure_{i}": contact.pressure, f"gap_{i}": contact.gap}
    return npz_bytes(arrays)


def _map_of(prepared: Prepared, end: str) -> dict[str, np.ndarray]:
    found = (prepared.surface.heights, np.array(prepared.surface.spacing), prepared.contact.x)
    return {f"{name}{end}": array for name, array in zip(("heights", "spacing", "contact_x"), found)}


def npz_bytes(arrays: dict[str, np.ndarray]) -> bytes:
    """``arrays`` as a compressed ``.npz`` file."""
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # NumPy types allow_pickle, not the arrays
    return file.getvalue()


def _statistics(surface) -> dict:
    return {
        "sq": surface.sq,
        "sa": surface.sa,
        "ssk": surface.ssk,
        "sku": surface.sku,
        "rms_slope": dict(zip(("x", "y", "total"), rms_slope(surface))),
        "missing_fraction": surface.missing_fraction,
    }


def _point(curve: StribeckResult, index: int) -> dict:
    told = {"validity": [asdict(entry) for entry in curve.entries(index)]}
    point = curve.points[index]
    if point is None:
        return {"speed": curve.speed[index], "error": str(curve.errors[index])} | told
    known = {
        "uncertainty": asdict(point.uncertainty) | {"text": point.uncertainty.text},
        "errors": asdict(point.errors),
    }
    return {name: getattr(point, name) for name in QUANTITIES} | known | {"report": point.report.as_dict()} | told
