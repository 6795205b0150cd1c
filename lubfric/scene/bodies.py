"""The line contact: two bodies, how they move, and the part of their contact that is resolved."""

import math
from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np

from .._base import Shown, validate
from ..errors import InputError
from ..film import hertz
from ..quantities import KEYS
from ..units import without_unit

# Keys of a scene that other rooms treat by themselves: f_b and the hardness, and the sliding in both of its forms.
BOUNDARY_FILM_KEY = "bodies.boundary_film"
BOUNDARY_FRICTION_KEY = "bodies.boundary_friction_coefficient"
HARDNESS_KEY = "bodies.hardness"
SLIDE_ROLL_RATIO_KEY = "motion.slide_roll_ratio"
SLIP_KEY = "motion.slip_percent"

# Boundary film [m] where a scene gives none: nearest to published shares of the load (docs/deterministic.md).
BOUNDARY_FILM = 20e-9

# Largest entrainment speed [m/s].
FASTEST = KEYS["motion.entrainment_speed"].most

# Largest slide-roll ratio [-].
LARGEST_RATIO = KEYS[SLIDE_ROLL_RATIO_KEY].most

# What a table of f_b may be over, and the unit of that.
FRICTION_OVER = {"sliding_speed": "m/s", "temperature": "K"}

MOST_CONTACT_CELLS = 2**26  # cells of a contact grid; a choice, for memory


def pair(name: str, value: tuple[float, float], unit: str) -> tuple[Any, ...]:
    """Return a list or tuple of two values, one for each body."""
    if not isinstance(value, (list, tuple)) or len(value) != 2:
        raise InputError(f" = {validate.shown(value)} must be a pair, one value a body [{unit}]", name)
    return tuple(value)


@dataclass(frozen=True)
class FrictionTable:
    """f_b [-] over the sliding speed [m/s] or over the temperature of the oil [K]; linear between rising points.

    over : "sliding_speed" or "temperature"; at, values : of the points. There is no value outside them.
    """

    over: str
    at: tuple[float, ...]
    values: tuple[float, ...]

    def __post_init__(self) -> None:
        validate.choice(f"{BOUNDARY_FRICTION_KEY} over", self.over, FRICTION_OVER)
        for name, unit, most in (
            ("at", FRICTION_OVER[self.over], FASTEST),
            ("values", "(-)", KEYS[BOUNDARY_FRICTION_KEY].most),
        ):
            numbers = validate.numbers(BOUNDARY_FRICTION_KEY, getattr(self, name), unit, most)
            object.__setattr__(self, name, tuple(numbers.tolist()))
        rising = all(a < b for a, b in zip(self.at, self.at[1:]))
        if not rising or not 2 <= len(self.at) == len(self.values) or min(*self.at, *self.values) < 0:
            allowed = "two lists of the same length, at least two numbers each, none below 0, the first list rising"
            raise InputError(f" = {self.values} at {self.at}, a table over {self.over}", BOUNDARY_FRICTION_KEY, allowed)

    def __call__(self, at: float) -> float:
        """Return f_b at a sliding speed [m/s] or a temperature [K]. Raises `InputError` outside the table."""
        unit = FRICTION_OVER[self.over]
        if not self.at[0] * (1 - 1e-9) <= at <= self.at[-1] * (1 + 1e-9):
            message = f", a table over {self.over}, has no value at {at:g} {unit}"
            raise InputError(
                message, BOUNDARY_FRICTION_KEY, f"{self.at[0]:g} to {self.at[-1]:g} {unit}", "make the table longer"
            )
        return float(np.interp(at, self.at, self.values))


def friction_of(given: Any) -> dict[str, Any]:
    """Return f_b, and its table if it is given as one: ``{ sliding_speed = [...], values = [...] }``, or over
    temperature."""
    table = None
    if isinstance(given, dict):
        over = next((key for key in FRICTION_OVER if key in given), None)
        if over is None or set(given) != {over, "values"}:
            ways = " or ".join(f"{{ {key} = [...], values = [...] }}" for key in FRICTION_OVER)
            raise InputError(f" = {validate.shown(given)}", BOUNDARY_FRICTION_KEY, ways)
        units = {over: FRICTION_OVER[over], "values": "-"}
        table = FrictionTable(
            over, *(without_unit(BOUNDARY_FRICTION_KEY, given[name], unit) for name, unit in units.items())
        )
        given = table.values[0]
    return {"boundary_friction_coefficient": given, "boundary_friction_table": table}


@dataclass(frozen=True, repr=False)
class Bodies(Shown):
    """The line contact: a cylinder on a plane, or the nominally flat strip under it.

    Attributes
    ----------
    radius : reduced radius R [m]
    width : length of the line B [m]
    load : total load F_T [N]
    e_prime : E' [Pa], 2/E' = (1-nu1²)/E1 + (1-nu2²)/E2
    hardness : plastic limit P_u of the contact pressure [Pa]; None: elastic
    boundary_friction_coefficient : f_b of the asperity contacts [-]; with a table, that at the scene's own speed
    boundary_friction_table : f_b over the sliding speed or the temperature, a `FrictionTable`, or None
    boundary_film : gap [m] below which the shear stress is f_b p, in the deterministic and the quick model; None:
        lubfric's own value; the error of f then contains half and twice this value
    conductivity : thermal conductivity of both bodies [W/(m K)], which conduct the heat of the film away (default:
        steel)
    volumetric_heat : rho c of both bodies [J/(m³ K)]
    """

    radius: float
    width: float
    load: float
    e_prime: float
    _: KW_ONLY
    boundary_friction_coefficient: float
    hardness: float | None = None
    boundary_film: float | None = None
    conductivity: tuple[float, float] = (46.0, 46.0)
    volumetric_heat: tuple[float, float] = (3.6e6, 3.6e6)
    boundary_friction_table: FrictionTable | None = None

    def __post_init__(self) -> None:
        validate.python_fields(self, "bodies")
        validate.in_range("bodies", self)
        if self.boundary_friction_table is not None:
            table = "a FrictionTable, by boundary_friction_coefficient = { sliding_speed = [...], values = [...] }"
            validate.instance("bodies.boundary_friction_table", self.boundary_friction_table, FrictionTable, table)
        if self.hardness is not None and self.mean_hertz_pressure >= self.hardness:
            message = (
                f" = {self.load:g} N is above the product of hardness and Hertz area: the bodies would yield everywhere"
            )
            most = self.hardness * 2 * self.half_width * self.width
            allowed = f"below {most:.4g} N (check the units of the load, the width, the radii and the hardness)"
            raise InputError(message, "bodies.load", allowed, also=("bodies.hardness",))
        for name, unit in (("conductivity", "W/(m K)"), ("volumetric_heat", "J/(m^3 K)")):
            both = pair(f"bodies.{name}", getattr(self, name), unit)
            object.__setattr__(self, name, tuple(validate.positive(f"bodies.{name}", v, unit) for v in both))

    def boundary_friction(self, sliding: float, temperature: float | None) -> float:
        """Return f_b [-] at a sliding speed [m/s] and a temperature of the oil [K]."""
        table = self.boundary_friction_table
        if table is None:
            return self.boundary_friction_coefficient
        place = abs(sliding) if table.over == "sliding_speed" else temperature
        if place is None:
            raise InputError(
                " is a table over the temperature", BOUNDARY_FRICTION_KEY, recommendation="give lubricant.temperature"
            )
        return table(place)

    @property
    def effusivity(self) -> tuple[float, float]:
        """sqrt(k rho c) of both bodies [J/(m^2 K s^0.5)]."""
        first, second = (math.sqrt(k * c) for k, c in zip(self.conductivity, self.volumetric_heat))
        return first, second

    @property
    def half_width(self) -> float:
        """Hertz half-width b [m] of the total load, b = sqrt(8 w R/(pi E'))."""
        return hertz.line_half_width(self.load / self.width, self.radius, self.e_prime)

    @property
    def strip_rise(self) -> float:
        """b²/(6 R) [m]: the mean rise of the undeformed cylinder over the Hertz strip."""
        return self.half_width**2 / (6 * self.radius)

    @property
    def mean_hertz_pressure(self) -> float:
        """F_T / (2 b B) [Pa]."""
        return self.load / self.width / (2 * self.half_width)


@dataclass(frozen=True, repr=False)
class Motion(Shown):
    """Speeds of the two surfaces. Surface 2 is the upper one, on which the shear is taken (paper, Eq. 12).

    Attributes
    ----------
    entrainment_speed : U = (u1 + u2)/2 [m/s]
    slide_roll_ratio : (u2 - u1)/U [-], kept while the entrainment speed varies along a Stribeck curve. 2: surface 1 is
        at rest, 0: pure rolling
    speeds : the entrainment speeds of the Stribeck curve [m/s]
    """

    entrainment_speed: float
    slide_roll_ratio: float = 2.0
    speeds: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        validate.python_fields(self, "motion")
        validate.in_range("motion", self)
        for name in ("entrainment_speed", "slide_roll_ratio"):
            object.__setattr__(self, name, float(getattr(self, name)) + 0.0)  # -0.0 is no direction
        if not isinstance(self.speeds, (list, tuple)):
            raise InputError(f" = {validate.shown(self.speeds)}", "motion.speeds", "a list of numbers in m/s")
        speeds = validate.numbers("motion.speeds", self.speeds, "m/s", FASTEST) if self.speeds else ()
        object.__setattr__(self, "speeds", tuple(float(u) for u in speeds))


@dataclass(frozen=True, repr=False)
class ContactDomain(Shown):
    """The part of the contact that is resolved, and how film and contact are compared on it.

    Attributes
    ----------
    geometry : "cylinder": free in x, periodic in y, under the film's own shape (paper, Sec. 3.2); "flat": nominally
        flat and periodic, the contact load spread over the Hertz strip (Sec. 3.1)
    region : area A of the volume balance, Eq. (8), under a cylinder: "hertz", the strip |x| <= b of the total load, or
        "box", the complete patch
    shape, spacing : (nx, ny) and (dx, dy) [m] of the contact grid. If they are omitted, a measured map keeps its own
        grid
    model : "half-space": every point of the surface may carry load, and deforms all others; "summits" or "patches":
        independent Hertz contacts (`lubfric.contact`)
    asperity_separation : how the film sets the separation of independent asperities: "volume" (Eq. 8 without
        deflection) or "mean-plane" (the mean film itself)
    """

    geometry: str = "cylinder"
    _: KW_ONLY
    region: str = "hertz"
    shape: tuple[int, int] | None = None
    spacing: float | tuple[float, float] | None = None
    model: str = "half-space"
    asperity_separation: str = "volume"

    def __post_init__(self) -> None:
        validate.python_fields(self, "contact")
        validate.in_range("contact", self)
        if self.geometry == "flat" and self.region != "hertz":
            message = f" = {self.region!r} does nothing with geometry = 'flat', whose patch represents the Hertz strip"
            raise InputError(message, "contact.region", "'hertz', or geometry = 'cylinder'")
        if self.model == "half-space" and self.asperity_separation != "volume":
            message = f" = {self.asperity_separation!r} does nothing with model = 'half-space'"
            raise InputError(message, "contact.asperity_separation", "'volume', or model = 'summits' or 'patches'")
        if self.shape is not None:
            if not isinstance(self.shape, (tuple, list)) or len(self.shape) != 2:
                message = f" = {validate.shown(self.shape)}"
                raise InputError(message, "contact.shape", "a pair (nx, ny) of whole numbers >= 1")
            cells = "contact.shape (cells of contact.spacing)"
            nx, ny = (validate.integer(cells, n, minimum=1) for n in self.shape)
            if nx * ny > MOST_CONTACT_CELLS:
                message = f" = {validate.shown(self.shape)} has {float(min(nx * ny, 10**300)):.3g} cells"
                raise InputError(message, "contact.shape", f"up to {MOST_CONTACT_CELLS:.3g}")
            object.__setattr__(self, "shape", (nx, ny))
        if self.spacing is not None:
            object.__setattr__(self, "spacing", lengths("contact.spacing", self.spacing))


def lengths(name: str, value: Any) -> float | tuple[float, float]:
    """Return one length [m], or the pair of those along x and y, checked."""
    both = validate.spacing(name, value)
    return both if isinstance(value, (list, tuple)) else both[0]
