"""Results as files: result.json, stribeck.csv, fields.npz."""

from __future__ import annotations

import csv
import json
import math
import platform
from dataclasses import asdict
from pathlib import Path

import numpy as np

from . import __version__
from .model import Model
from .scene import scene_as_dict
from .steady import FrictionResult
from .surface import rms_slope
from .sweep import QUANTITIES, StribeckResult

UNITS = {
    "speed": "m/s",
    "real_contact_area": "m2",
    "contact_load": "N",
    "film_load": "N",
    "shear_force": "N",
    "couette_force": "N",
    "rolling_force": "N",
    "boundary_force": "N",
    "min_film": "m",
    "central_film": "m",
    "mean_gap": "m",
    "flash_temperature_rise": "K",
    "film_temperature_rise": "K",
    "seconds": "s",
}


def write_json(path: Path, model: Model, curve: StribeckResult, seconds: float) -> None:
    """The record of a run: resolved input, versions, seed, timings, numbers and reports."""
    import scipy

    record = {
        "scene": scene_as_dict(model.scene),
        "surface": {
            "shape": model.surface.heights.shape,
            "spacing": model.surface.spacing,
            "statistics": _statistics(model.surface),
            "notes": list(model.surface.notes),
        },
        "versions": {
            "lubfric": __version__,
            "numpy": np.__version__,
            "scipy": scipy.__version__,
            "python": platform.python_version(),
        },
        "seed": model.scene.surface.seed if model.scene.surface.file is None else None,
        "seconds": seconds,
        "report": curve.report.as_dict(),
        "validity": list(curve.validity),
        "points": [_point(curve, i) for i in range(curve.speed.size)],
    }
    path.write_text(json.dumps(_plain(record), indent=1, allow_nan=False))


def write_csv(path: Path, curve: StribeckResult) -> None:
    """One row a speed, one column a quantity, the unit in the heading; the last column says what does not hold there."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow([*(f"{name} [{UNITS.get(name, '-')}]" for name in QUANTITIES), "validity"])
        texts = [" | ".join(entry.text for entry in curve.entries(i)) for i in range(curve.speed.size)]
        writer.writerows(zip(*(getattr(curve, name) for name in QUANTITIES), texts))


def read_csv(path: Path) -> dict[str, np.ndarray]:
    """The columns that `write_csv` wrote, by name."""
    with Path(path).open() as file:
        heading, *rows = list(csv.reader(file))
    columns = {name.split(" [")[0]: [row[i] for row in rows] for i, name in enumerate(heading)}
    return {name: np.array(column, str if name == "validity" else float) for name, column in columns.items()}


def write_fields(path: Path, model: Model, points: list[FrictionResult]) -> None:
    """Film and contact fields of some speeds: arrays named ``<quantity>_<index>``, and ``speed``."""
    arrays = {
        "speed": np.array([p.speed for p in points]),
        "heights": model.surface.heights,
        "spacing": np.array(model.surface.spacing),
        "contact_x": model.contact.x,
    }
    for i, point in enumerate(points):
        film, contact = point.balance.film, point.balance.contact.fields
        if film is not None:
            arrays |= {
                f"film_x_{i}": film.x,
                f"film_thickness_{i}": film.film_thickness,
                f"film_pressure_{i}": film.pressure,
            }
        if contact is not None:
            arrays |= {f"contact_pressure_{i}": contact.pressure, f"gap_{i}": contact.gap}
    np.savez_compressed(path, **arrays)


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
    if curve.points[index] is None:
        return {"speed": curve.speed[index], "error": str(curve.errors[index])} | told
    point = curve.points[index]
    return {name: getattr(point, name) for name in QUANTITIES} | {"report": point.report.as_dict()} | told


def _plain(value):
    """JSON types only: numpy scalars and tuples unpacked, NaN and infinity as null."""
    if isinstance(value, dict):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value
