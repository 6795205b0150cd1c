"""One assumption of the model that does not hold."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import ValidityError


@dataclass(frozen=True)
class Validity:
    """An assumption of the model that does not hold.

    Attributes
    ----------
    what : the quantity, in words
    value, limit : where it stands and how far the model goes, both in ``unit``
    consequence : what that does to the result
    remedy : what to change
    severe : True: the coefficient means nothing, and a `ValidityError` is raised unless accepted. False: a caution
    """

    what: str
    value: float
    limit: float
    unit: str
    consequence: str
    remedy: str
    severe: bool = False

    def __post_init__(self):
        for name, kind in (("value", float), ("limit", float), ("severe", bool)):
            object.__setattr__(self, name, kind(getattr(self, name)))

    @property
    def text(self) -> str:
        """One sentence; "caution: ..." or "not valid: ..."."""
        head = "not valid" if self.severe else "caution"
        unit = f" {self.unit}" if self.unit else ""
        side = "above" if self.value > self.limit else "below"
        numbers = (
            f"{self.value:.3g}{unit}, {side} {self.limit:.3g}{unit}"
            if math.isfinite(self.limit)
            else f"{self.value:.3g}{unit}"
        )
        return f"{head}: {self.what} {numbers}: {self.consequence}; {self.remedy}"


def refused(entries: tuple[Validity, ...], accept: bool, result=None) -> None:
    """Raise `ValidityError` with ``result`` where one of ``entries`` is severe, unless ``accept``."""
    severe = [entry for entry in entries if entry.severe]
    if severe and not accept:
        raise ValidityError(
            "; ".join(entry.text for entry in severe) + " (numerics.accept = true overrides)", tuple(severe), result
        )
