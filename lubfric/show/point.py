"""An operating point for eyes: its numbers in a line, its fields where a user looks for them, its contact drawn."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import InputError
from ..report import Report
from .cite import cited
from .shown import Shown


class PointShown(Shown):
    """What `lubfric.FrictionResult`, whose fields these are, shows."""

    speed: float
    coefficient: float
    contact_load: float
    film_load: float
    film_to_roughness_ratio: float
    inlet_film_factor: float
    report: Report
    validity: tuple[Any, ...]
    balance: Any
    deterministic: Any
    uncertainty: Any
    decision: Any
    methods: tuple[str, ...]

    def _facts(self) -> dict[str, str]:
        facts = {
            "U": f"{self.speed:.4g} m/s",
            "f": f"{self.coefficient:.5g}{_interval(self.uncertainty.interval)}",
            "F_C": f"{self.contact_load:.4g} N",
            "F_H": f"{self.film_load:.4g} N",
            "lambda": f"{self.film_to_roughness_ratio:.3g}",
            "": self.report.status,
        }
        if self.validity:
            facts["cautions"] = "; ".join(entry.what for entry in self.validity)
        return facts

    def cite(self) -> str:
        """The papers behind what was used for this result, one a line, the model's first."""
        return cited(self.methods)

    @property
    def shows_contact(self) -> bool:
        """Whether `pressure` and `gap` are there."""
        return self.deterministic is not None or (self.balance is not None and self.balance.contact.fields is not None)

    @property
    def x(self) -> np.ndarray:
        """Cells of the contact along the motion [m], (nx,), around the line of contact. Needs ``fields=True``."""
        if self.deterministic is not None:
            return self.deterministic.result.x
        return self._kept("x", None if self.balance is None else self.balance.contact.x)

    @property
    def y(self) -> np.ndarray:
        """Cells of the contact along the line [m], (ny,). Needs ``fields=True``."""
        if self.deterministic is not None:
            whole = self.deterministic.result
            return np.arange(whole.pressure.shape[1]) * whole.spacing[1]
        return self._kept("y", None if self.balance is None else self.balance.contact.y)

    @property
    def pressure(self) -> np.ndarray:
        """Pressure of the rough contact [Pa], (nx, ny); 0 where it is separated. Needs ``fields=True``."""
        if self.deterministic is not None:
            return self.deterministic.result.pressure
        return self._fields("pressure").pressure

    @property
    def gap(self) -> np.ndarray:
        """Gap of the rough contact [m], (nx, ny). Needs ``fields=True``, and contact."""
        if self.deterministic is not None:
            return self.deterministic.result.gap
        return self._fields("gap").gap

    def plot_contact(self, ax=None):
        """The pressure of the rough contact in the plane; returns the axes. Needs ``fields=True``, and contact."""
        from .axes import pressure_axes

        return pressure_axes(self, ax)

    def _kept(self, name: str, found: np.ndarray | None) -> np.ndarray:
        if found is None:
            raise InputError(
                f"this point keeps no {name}; allowed: lubfric.friction(..., fields=True) under a cylinder"
            )
        return found

    def _fields(self, name: str) -> Any:
        if self.balance is None or self.balance.contact.fields is None:
            why = (
                "it is separated"
                if self.contact_load == 0
                else "its fields were not kept, or come from a contact curve"
            )
            raise InputError(
                f"this point has no {name} of its contact: {why}; allowed: a point in contact, with fields=True"
            )
        return self.balance.contact.fields


def _interval(interval: tuple[float, float]) -> str:
    low, high = interval
    return f" ({low:.4g} to {high:.4g} at 95 %)" if np.isfinite(low) and np.isfinite(high) else ""
