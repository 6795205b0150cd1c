"""Observed orders of convergence."""

from __future__ import annotations

import numpy as np


def orders(sizes, errors) -> np.ndarray:
    """Orders between successive meshes, ``log(e_i/e_{i+1}) / log(h_i/h_{i+1})``: one fewer than there are meshes."""
    log_size, log_error = np.log(positive("sizes", sizes)), np.log(positive("errors", errors))
    return np.diff(log_error) / np.diff(log_size)


def fitted_order(sizes, errors) -> float:
    """Slope of the least-squares line through ``(log h, log e)``."""
    return float(np.polyfit(np.log(positive("sizes", sizes)), np.log(positive("errors", errors)), 1)[0])


def positive(name: str, values) -> np.ndarray:
    """Raise ValueError unless there are at least two finite values > 0: an order fitted to others means nothing."""
    a = np.asarray(values, dtype=float)
    if a.ndim != 1 or a.size < 2 or not np.all(np.isfinite(a) & (a > 0)):
        raise ValueError(f"{name} = {a}; an order needs at least two finite values > 0")
    return a
