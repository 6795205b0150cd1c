"""Observed orders of convergence: measured, checked and drawn."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import KW_ONLY, dataclass

import numpy as np
from scipy.optimize import brentq

from ..check import ABSOLUTE, Check, Figure, Item
from ..plotting import finish, panel
from ..types import FloatArray


def fitted_order(sizes: Sequence[float] | FloatArray, errors: Sequence[float] | FloatArray) -> float:
    """Return slope of the least-squares line through ``(log h, log e)``.

    Raises ValueError unless there are at least two finite values > 0: an order fitted to others means nothing.
    """
    for name, values in (("sizes", sizes), ("errors", errors)):
        a = np.asarray(values, dtype=float)
        if a.ndim != 1 or a.size < 2 or not np.all(np.isfinite(a) & (a > 0)):
            raise ValueError(f"{name} = {a}; an order needs at least two finite values > 0")
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


def order_of_three(sizes: Sequence[float], values: Sequence[float]) -> float:
    """Return the order p of values v + c h^p on three meshes of ever smaller cells h; NaN unless .2 < p < 6."""
    (coarse, middle, fine) = (float(value) for value in values)

    def mismatch(order: float) -> float:
        ratio = (sizes[0] ** order - sizes[1] ** order) / (sizes[1] ** order - sizes[2] ** order)
        return float(ratio - (coarse - middle) / (middle - fine))

    low = 0.2
    high = 6.0
    return brentq(mismatch, low, high) if mismatch(low) * mismatch(high) < 0 else math.nan


def extrapolated_by(order: float, sizes: Sequence[float], values: Sequence[FloatArray | float]) -> FloatArray:
    """Return the value at no cell size of the last two ``values``, whose error falls with ``order`` of the cell."""
    return values[-1] + (values[-1] - values[-2]) / ((sizes[-2] / sizes[-1]) ** order - 1)


@dataclass(frozen=True)
class Series:
    """Errors on ever finer meshes.

    label : in the picture
    sizes, errors : of every mesh
    order : expected; None where none is known
    check : name of the check on the order; "" where it is only drawn
    tolerance, source, kind, note : of that check
    finest : how many of the last meshes count for it; 0: all
    """

    label: str
    sizes: Sequence[float] | np.ndarray
    errors: Sequence[float] | np.ndarray
    _: KW_ONLY
    order: float | None = None
    check: str = ""
    tolerance: float = 0.0
    source: str = "element theory, L2 norm"
    kind: str = ABSOLUTE
    note: str = ""
    finest: int = 0

    def check_order(self) -> Check:
        """Compare the observed order with the expected one."""
        if self.order is None:
            raise ValueError(f"series {self.label!r} has no expected order to be checked")
        order = fitted_order(self.sizes[-self.finest :], self.errors[-self.finest :])
        return Check(
            self.check,
            order,
            expected=self.order,
            tolerance=self.tolerance,
            source=self.source,
            kind=self.kind,
            note=self.note,
            grade="B",
        )


def convergence(name: str, caption: str, series: Sequence[Series], size: str, error: str) -> Iterator[Item]:
    """The checks on the orders, and the picture of all series against ``size``."""
    for each in series:
        if each.check:
            yield each.check_order()
    yield picture(name, caption, series, size, error)


def picture(name: str, caption: str, series: Sequence[Series], size: str, error: str) -> Figure:
    """Return errors against mesh size, log-log, each with its fitted order and a dotted line of the expected one."""
    canvas, ax = panel(6.4, 3.6 + 0.2 * ((len(series) + 1) // 2))
    for each in series:
        sizes = np.asarray(each.sizes, dtype=float)
        errors = np.asarray(each.errors, dtype=float)
        text = f"{each.label}: order {fitted_order(sizes, errors):.2f}"
        text += "" if each.order is None else f" (expected {each.order:g})"
        (line,) = ax.loglog(sizes, errors, "o-", label=text)
        if each.order is not None:
            finest = np.argmin(sizes)
            expected = errors[finest] * (sizes / sizes[finest]) ** each.order
            ax.loglog(sizes, expected, ":", color=line.get_color(), linewidth=1.0)
    ax.set(xlabel=size, ylabel=error)
    canvas.legend(loc="outside lower center", ncols=1 if len(series) == 1 else 2, frameon=False)
    return finish(name, canvas, caption)
