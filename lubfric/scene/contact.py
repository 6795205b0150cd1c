"""The part of the contact that is resolved."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .._base import Brief, validate
from ..errors import InputError

GEOMETRIES = ("cylinder", "flat")
REGIONS = ("hertz", "box")
LARGEST = 2**26  # cells of a contact grid
CONTACT_MODELS = ("half-space", "summits", "patches")
ASPERITY_SEPARATIONS = ("volume", "mean-plane")


@dataclass(frozen=True, repr=False)
class ContactDomain(Brief):
    """The part of the contact that is resolved, and how film and contact are compared on it.

    Attributes
    ----------
    geometry : "cylinder": free in x, periodic in y, under the film's own shape (paper, Sec. 3.2); "flat": nominally
        flat and periodic, the contact load spread over the Hertz strip (Sec. 3.1)
    region : area A of the volume balance, Eq. (8), under a cylinder: "hertz", the strip |x| <= b of the total load, or
        "box", the whole patch
    shape, spacing : (nx, ny) and (dx, dy) [m] of the contact grid. If they are left out, a measured map keeps its own
        grid
    model : "half-space": every point of the surface may carry load, and deforms all others; "summits" or "patches":
        independent Hertz contacts (`lubfric.contact`)
    asperity_separation : how the film sets the separation of independent asperities: "volume" (Eq. 8 without
        deflection) or "mean-plane" (the mean film itself)
    """

    geometry: str = "cylinder"
    region: str = "hertz"
    shape: tuple[int, int] | None = None
    spacing: float | tuple[float, float] | None = None
    model: str = "half-space"
    asperity_separation: str = "volume"

    def __post_init__(self):
        validate.python_fields(self)
        validate.choice("contact.model", self.model, CONTACT_MODELS)
        validate.choice("contact.asperity_separation", self.asperity_separation, ASPERITY_SEPARATIONS)
        validate.choice("contact.geometry", self.geometry, GEOMETRIES)
        validate.choice("contact.region", self.region, REGIONS)
        self._check_use()
        if self.shape is not None:
            if not isinstance(self.shape, (tuple, list)) or len(self.shape) != 2:
                raise InputError(
                    f"contact.shape = {validate.shown(self.shape)} must be a pair (nx, ny) of whole numbers >= 1"
                )
            object.__setattr__(
                self,
                "shape",
                tuple(validate.integer("contact.shape (cells of contact.spacing)", n, minimum=1) for n in self.shape),
            )
            cells = math.prod(self.shape)
            if cells > LARGEST:
                raise InputError(
                    f"contact.shape = {validate.shown(self.shape)} has {float(min(cells, 10**300)):.3g} cells; "
                    f"allowed: up to {LARGEST:.3g}"
                )
        if self.spacing is not None:
            pair = validate.spacing("contact.spacing", self.spacing)
            object.__setattr__(self, "spacing", pair if isinstance(self.spacing, (list, tuple)) else pair[0])

    def _check_use(self) -> None:
        """Raise `InputError` for a value that would do nothing."""
        if self.geometry == "flat" and self.region != "hertz":
            told = f" = {self.region!r} does nothing with geometry = 'flat', whose patch stands for the Hertz strip"
            raise InputError(told, "contact.region", "'hertz', or geometry = 'cylinder'")
        if self.model == "half-space" and self.asperity_separation != "volume":
            told = f" = {self.asperity_separation!r} does nothing with model = 'half-space'"
            raise InputError(told, "contact.asperity_separation", "'volume', or model = 'summits' or 'patches'")
