"""The result of one operating point: `FrictionResult`."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .._base import Renamed, Shown, figures, packaged
from ..errors import InputError, Report
from ..models.deterministic import DeterministicResult
from ..models.load_sharing import Balance
from ..models.shared import (
    Decision,
    UnmodelledEffect,
    Validity,
)
from ..quantities import PointQuantities, described_in_doc, in_words
from .uncertainty import FieldErrors, Uncertainty


@described_in_doc
@dataclass(frozen=True, repr=False, kw_only=True)
class FrictionResult(Renamed, PointQuantities[float], Shown):
    """One operating point (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z).

    The residuals are relative. ``balance`` holds the fields: the film (``balance.film``, an `EHLResult`)
    and, for a cylinder in contact, the dry contact (``balance.contact.fields``, a `ContactResult`). On strips of
    the surface these are on the cells of the strips; ``fields=True`` gives the map's own.

    Attributes
    ----------
    report : of the solve
    uncertainty : of the coefficient: from solvers and grids, because a finite surface stands for all of it, and from
        the model (`Uncertainty`, docs/uncertainty.md)
    errors : relative errors of every other number (`FieldErrors`), for example ``errors.contact_load``
    decision : how much was modelled, and the numbers it was judged by; ``decision.text`` in words
    power_loss_interval : 95 % interval of the power loss [W], (low, high)
    validity : the assumptions that do not hold (`lubfric.Validity`). A severe one is there only where it was accepted
    unmodelled_effects : what the scene leaves out, the likely change of f by it (relative; NaN: not known), and what to do, the
        largest first; nothing that would change f by less than the tolerance (`lubfric.models.shared.unmodelled_effects`)
    methods : names of the methods that it rests on, where a paper stands behind them. ``cite()`` gives the papers
    heights : of the cells of the contact that was solved [m], (nx, ny), about their mean; None if there are none
    """

    report: Report
    uncertainty: Uncertainty
    errors: FieldErrors
    decision: Decision
    power_loss_interval: tuple[float, float] = (math.nan, math.nan)
    validity: tuple[Validity, ...] = ()
    unmodelled_effects: tuple[UnmodelledEffect, ...] = ()
    methods: tuple[str, ...] = ()
    balance: Balance | None = None
    heights: np.ndarray | None = None
    deterministic: DeterministicResult | None = None
    _RENAMED = {"lacks": "unmodelled_effects"}

    def without_fields(self) -> FrictionResult:
        """A copy with its numbers alone."""
        return replace(self, balance=None, heights=None, deterministic=None)

    def _facts(self) -> dict[str, str]:
        facts = in_words(self, ("speed", "coefficient", "contact_load", "film_load", "lambda_ratio"))
        facts["f"] = f"{self.coefficient:.5g}{_interval(self.uncertainty.interval)}"
        facts[""] = self.report.status
        if self.validity:
            facts["warnings"] = "; ".join(entry.what for entry in self.validity)
        return facts

    def cite(self) -> str:
        """The papers behind what was used for this result, one a line, the model's first."""
        return cited(self.methods)

    @property
    def shows_contact(self) -> bool:
        """Whether `pressure` and `gap` are available."""
        return self.deterministic is not None or (self.balance is not None and self.balance.contact.fields is not None)

    @property
    def x(self) -> np.ndarray:
        """Cells of the contact along the motion [m], (nx,), around the line of contact. Needs ``fields=True``."""
        return self._field("x")

    @property
    def y(self) -> np.ndarray:
        """Cells of the contact along the line [m], (ny,). Needs ``fields=True``."""
        whole = self.deterministic
        return np.arange(whole.pressure.shape[1]) * whole.spacing[1] if whole else self._field("y")

    @property
    def pressure(self) -> np.ndarray:
        """Pressure of the rough contact [Pa], (nx, ny); 0 where it is separated. Needs ``fields=True``."""
        return self._field("pressure")

    @property
    def gap(self) -> np.ndarray:
        """Gap of the rough contact [m], (nx, ny). Needs ``fields=True``, and contact."""
        return self._field("gap")

    def plot_contact(self, ax=None, rows=slice(None)):
        """The pressure of the rough contact in the plane, in some ``rows`` along the line; returns the axes. Needs
        ``fields=True``, and contact."""
        axes = figures.axes_or_new(ax)
        pressure = self.pressure[:, rows] / 1e9
        figures.field_image(axes, self.x, self.y[rows], pressure, "magma_r", "contact pressure (GPa)", vmin=0)
        axes.set_title(f"U = {self.speed:g} m/s, $F_C$ = {self.contact_load:.4g} N, $F_H$ = {self.film_load:.4g} N")
        return axes

    def _field(self, name: str) -> np.ndarray:
        source: Any = self.balance and self.balance.contact
        if self.deterministic is not None:
            source = self.deterministic
        elif name not in ("x", "y"):
            source = source and source.fields
        if getattr(source, name, None) is None:
            why = "it is separated" if self.contact_load == 0 else "it was not kept, or comes from a contact curve"
            raise InputError(f"this point has no {name} of its contact: {why}; solve one in contact with fields=True")
        return getattr(source, name)


def _interval(interval: tuple[float, float]) -> str:
    low, high = interval
    return f" ({low:.4g} to {high:.4g} at 95 %)" if np.isfinite(low) and np.isfinite(high) else ""


def cited(methods: Iterable[str]) -> str:
    """The papers of ``methods`` (keys of papers.toml), one a line, the model's first."""
    used = set(methods)
    return "\n".join(paper for name, paper in packaged(__package__, "papers.toml").items() if name in used)


def together(points) -> str:
    """The papers of several results, each once, one a line."""
    return cited(name for point in points for name in point.methods)
