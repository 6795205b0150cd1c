"""Curves as tables: stribeck.csv, traction.csv."""

from __future__ import annotations

import numpy as np

from .._base import table_bytes
from ..quantities import heading
from ..sampling import UncertaintyCurve
from .sweep_points import QUANTITIES


def csv_bytes(curve) -> bytes:
    """The table of a `StribeckResult`: one row a speed, one column a quantity, the unit in the heading. The last
    columns say which assumptions are violated there, and how sure f is."""
    columns = {name: getattr(curve, name) for name in QUANTITIES}
    return curve_table(curve, columns | uncertainty_columns(curve.uncertainty))


def curve_table(curve, columns: dict[str, np.ndarray]) -> bytes:
    """``columns`` of a curve under their headings, the violated assumptions at each point, and how sure f is."""
    named = {heading(name): values for name, values in columns.items()}
    return table_bytes(named | {"validity": curve.told, "uncertainty": list(curve.uncertainty.text)})


def uncertainty_columns(found: UncertaintyCurve) -> dict[str, np.ndarray]:
    """The numbers of an `UncertaintyCurve` as columns of a table, the interval as its two ends."""
    return {
        "interval_low": found.interval[:, 0],
        "interval_high": found.interval[:, 1],
        "numerical_error": found.numerical,
        "sampling_error": found.sampling,
        "line_scatter": found.line_scatter,
        "participation": found.participation,
        "line_length": found.length,
        "model_form_error": found.model_form,
    }
