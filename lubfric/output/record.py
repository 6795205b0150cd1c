"""The record of a run, result.json: resolved input, versions, numbers and reports; and arrays as a file."""

from __future__ import annotations

import io
import platform
from dataclasses import asdict

import numpy as np

from .._base import __version__
from ..quantities import NUMBERS
from ..scene import Scene, scene_as_dict
from ..sharing import Prepared
from ..studies import StribeckResult
from ..surface import Surface, rms_slope


def curve_record(prepared: Prepared, curve: StribeckResult, seconds: float) -> dict:
    """The record of a curve: resolved input, versions, seed, timings, numbers and reports."""
    surface = prepared.surface
    statistics = {name: getattr(surface, name) for name in ("sq", "sa", "ssk", "sku", "missing_fraction")}
    statistics["rms_slope"] = dict(zip(("x", "y", "total"), rms_slope(surface)))
    return made_of(prepared.scene, surface, statistics=statistics) | {
        "seed": prepared.scene.surface.seed if prepared.scene.surface.file is None else None,
        "seconds": seconds,
        "report": curve.report.as_dict(),
        "validity": list(curve.validity),
        "points": [_point(curve, i) for i in range(curve.speed.size)],
    }


def made_of(scene: Scene, surface: Surface, **described: object) -> dict:
    """The beginning of every record of a run: the resolved input, the map (and how it is ``described``), versions."""
    import scipy

    map_ = {"shape": surface.heights.shape, "spacing": surface.spacing, **described, "notes": list(surface.notes)}
    versions = {"lubfric": __version__, "numpy": np.__version__, "scipy": scipy.__version__}
    versions["python"] = platform.python_version()
    return {"scene": scene_as_dict(scene), "surface": map_, "versions": versions}


def _point(curve: StribeckResult, index: int) -> dict:
    """The numbers of a point, the error of f in words too, and the errors of the other numbers; or why there are
    none."""
    point, violated = curve.points[index], {"validity": [asdict(entry) for entry in curve.entries(index)]}
    if point is None:
        return {"speed": curve.speed[index], "error": str(curve.errors[index])} | violated
    return {name: getattr(point, name) for name in NUMBERS} | {
        "uncertainty": asdict(point.uncertainty) | {"text": point.uncertainty.text},
        "errors": asdict(point.errors),
        "report": point.report.as_dict(),
        **violated,
    }


def npz_bytes(arrays: dict[str, np.ndarray]) -> bytes:
    """``arrays`` as a compressed ``.npz`` file."""
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # NumPy types allow_pickle, not the arrays
    return file.getvalue()
