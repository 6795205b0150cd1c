"""How the two surfaces move."""

from __future__ import annotations

from dataclasses import dataclass

from .._base import Brief, validate

FASTEST = 1e6  # m/s
LARGEST_RATIO = 1e6  # slide-roll ratio


@dataclass(frozen=True, repr=False)
class Motion(Brief):
    """Speeds of the two surfaces. Surface 2 is the upper one, on which the shear is taken (paper, Eq. 12).

    Attributes
    ----------
    entrainment_speed : U = (u1 + u2)/2 [m/s]
    slide_roll_ratio : (u2 - u1)/U [-], kept while the entrainment speed varies along a Stribeck curve. 2: surface 1
        stands still, 0: pure rolling
    speeds : the entrainment speeds of the Stribeck curve [m/s]
    """

    entrainment_speed: float
    slide_roll_ratio: float = 2.0
    speeds: tuple[float, ...] = ()

    def __post_init__(self):
        validate.python_fields(self)
        for name, unit, most in (("entrainment_speed", "m/s", FASTEST), ("slide_roll_ratio", "(-)", LARGEST_RATIO)):
            value = validate.number(f"motion.{name}", getattr(self, name), unit, minimum=-most, maximum=most)
            object.__setattr__(self, name, value)
        none = isinstance(self.speeds, (list, tuple)) and not self.speeds
        speeds = () if none else validate.array("motion.speeds", self.speeds, "m/s", ndim=1)
        limits = {"minimum": -FASTEST, "maximum": FASTEST}
        checked = tuple(validate.number("motion.speeds", u, "m/s", **limits) for u in speeds)
        object.__setattr__(self, "speeds", checked)
