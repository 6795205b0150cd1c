"""The loaded cylinder of a dry line contact, in numbers: `LoadedCylinder`."""

from __future__ import annotations

from dataclasses import dataclass

from ..film import hertz


@dataclass(frozen=True, kw_only=True)
class LoadedCylinder:
    """A cylinder pressed onto a plane, both elastic.

    Attributes
    ----------
    radius : reduced radius R [m]
    width : length B of the line [m]
    load : total load F_T [N] on that width
    e_prime : E' [Pa], 2/E' = (1 - nu1²)/E1 + (1 - nu2²)/E2
    hardness : limit of the contact pressure [Pa]; None: elastic
    """

    radius: float
    width: float
    load: float
    e_prime: float
    hardness: float | None = None

    @property
    def half_width(self) -> float:
        """Return the Hertz half-width b [m] of the total load, b = sqrt(8 w R/(pi E'))."""
        return hertz.line_half_width(self.load / self.width, self.radius, self.e_prime)

    @property
    def hertz_area(self) -> float:
        """Return the area 2 b B [m²] of the Hertz strip."""
        return 2 * self.half_width * self.width
