"""What is asked: bodies, lubricant, motion, roughness and numerics, typed, frozen and validated."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from . import validate
from .analytic import hertz
from .errors import InputError
from .history.plan import Transient
from .lubricant import Lubricant
from .plausible import told_slips
from .roughness import Roughness, as_given, counterface, named
from .short_forms import resolve, short_keys

GEOMETRIES = ("cylinder", "flat")
REGIONS = ("hertz", "box")
LARGEST = 2**26  # cells of a contact grid
FASTEST = 1e6  # m/s
MOST_THREADS = 1024
CAVITATED_SHEAR = ("none", "striated")
CONTACT_MODELS = ("half-space", "summits", "patches")
ASPERITY_SEPARATIONS = ("volume", "mean-plane")
HEATS = ("auto", "on", "off")
CLOSURES = ("load", "separation", "one-way")
FILM_DEFLECTIONS = ("auto", "hydrodynamic", "scaled", "total")
MODELS = ("auto", "full", "deterministic")
FILM_LEVELS = ("auto", "none", "isoviscous", "piezoviscous", "ehl")
CONTACT_LEVELS = ("auto", "none", "flat", "semi-periodic")
GRIDS = ("auto", "given")
SAMPLINGS = ("line", "patch")


@dataclass(frozen=True)
class Bodies:
    """The line contact: a cylinder on a plane, or the nominally flat strip under it.

    radius [m] reduced radius; width [m] length of the line; load [N] total load F_T;
    e_prime [Pa] with 2/E' = (1-nu1^2)/E1 + (1-nu2^2)/E2; hardness [Pa] plastic limit P_u of the
    contact pressure (None: elastic); boundary_friction_coefficient f_b [-] of the contact spots.
    conductivity [W/(m K)] and volumetric_heat rho c [J/(m^3 K)] of both bodies, which carry the heat of the film away
    (steel).
    """

    radius: float
    width: float
    load: float
    e_prime: float
    boundary_friction_coefficient: float
    hardness: float | None = None
    conductivity: tuple[float, float] = (46.0, 46.0)
    volumetric_heat: tuple[float, float] = (3.6e6, 3.6e6)

    def __post_init__(self):
        validate.positive("bodies.radius", self.radius, "m", minimum=1e-9, maximum=1e3)
        validate.positive("bodies.width", self.width, "m", minimum=1e-9, maximum=1e3)
        validate.positive("bodies.load", self.load, "N", minimum=1e-12, maximum=1e12)
        validate.number("bodies.e_prime", self.e_prime, "Pa", minimum=1e3, maximum=1e13)
        validate.nonnegative(
            "bodies.boundary_friction_coefficient", self.boundary_friction_coefficient, "(-)", maximum=10.0
        )
        if self.hardness is not None:
            validate.positive("bodies.hardness", self.hardness, "Pa", minimum=1.0, maximum=1e14)
            if self.mean_hertz_pressure >= self.hardness:
                raise InputError(
                    f"bodies.load = {self.load:g} N is above hardness x Hertz area; allowed: below "
                    f"{self.hardness * 2 * self.half_width * self.width:g} N"
                )

        for name, unit in (("conductivity", "W/(m K)"), ("volumetric_heat", "J/(m^3 K)")):
            both = getattr(self, name)
            if not isinstance(both, (tuple, list)) or len(both) != 2:
                raise InputError(f"bodies.{name} = {both!r} must be a pair, one value a body [{unit}]")
            object.__setattr__(self, name, tuple(validate.positive(f"bodies.{name}", v, unit) for v in both))

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
    def mean_hertz_pressure(self) -> float:
        """F_T / (2 b B) [Pa]."""
        return hertz.line_mean_pressure(self.load / self.width, self.radius, self.e_prime)


@dataclass(frozen=True)
class Motion:
    """Speeds of the two surfaces.

    entrainment_speed U = (u1 + u2)/2 [m/s]; slide_roll_ratio (u2 - u1)/U [-], kept while the
    entrainment speed varies along a Stribeck curve. Surface 2 is the upper one, on which the shear
    is taken (paper, Eq. 12). 2: surface 1 stands still, 0: pure rolling. speeds [m/s]: the entrainment
    speeds of the Stribeck curve.
    """

    entrainment_speed: float
    slide_roll_ratio: float = 2.0
    speeds: tuple[float, ...] = ()

    def __post_init__(self):
        for name, unit, most in (("entrainment_speed", "m/s", FASTEST), ("slide_roll_ratio", "(-)", 1e6)):
            value = validate.number(f"motion.{name}", getattr(self, name), unit, minimum=-most, maximum=most)
            object.__setattr__(self, name, value)
        speeds = () if len(self.speeds) == 0 else validate.array("motion.speeds", self.speeds, "m/s", ndim=1)
        limits = {"minimum": -FASTEST, "maximum": FASTEST}
        checked = tuple(validate.number("motion.speeds", u, "m/s", **limits) for u in speeds)
        object.__setattr__(self, "speeds", checked)


@dataclass(frozen=True)
class Patch:
    """The part of the contact that is resolved, and how the two models meet on it.

    geometry "cylinder": free in x, periodic in y, under the film's own shape (paper, Sec. 3.2);
    "flat": nominally flat and periodic, the contact load spread over the Hertz strip (Sec. 3.1).
    region: area A of the volume balance, Eq. (8): "hertz" (the strip |x| <= b of the total load)
    or "box" (the whole patch). shape (nx, ny) and spacing (dx, dy) [m] of the contact grid; a
    measured map keeps its own grid where they are left out.
    model: "half-space" (every point of the surface, with interaction), or independent Hertz contacts of
    "summits" or "patches" (`lubfric.asperity`); asperity_separation: how the film sets the separation of
    these, "volume" (Eq. 8 without deflection) or "mean-plane" (the mean film itself).
    """

    geometry: str = "cylinder"
    region: str = "hertz"
    shape: tuple[int, int] | None = None
    spacing: float | tuple[float, float] | None = None
    model: str = "half-space"
    asperity_separation: str = "volume"

    def __post_init__(self):
        validate.choice("contact.model", self.model, CONTACT_MODELS)
        validate.choice("contact.asperity_separation", self.asperity_separation, ASPERITY_SEPARATIONS)
        validate.choice("contact.geometry", self.geometry, GEOMETRIES)
        validate.choice("contact.region", self.region, REGIONS)
        if self.shape is not None:
            if not isinstance(self.shape, (tuple, list)) or len(self.shape) != 2:
                raise InputError(
                    f"contact.shape = {validate.shown(self.shape)} must be a pair (nx, ny) of whole numbers >= 1"
                )
            object.__setattr__(
                self, "shape", tuple(validate.integer("contact.shape", n, minimum=1) for n in self.shape)
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


@dataclass(frozen=True)
class Numerics:
    """Relative tolerances. ``tolerance`` is the one on the friction coefficient; the others follow
    from it where they are left out (see `film_tolerance` and its neighbours).

    closure: "load" (contact solved at F_T - F_H, volume balanced) or "separation" (the paper's way: film imposed
    on the contact, loads balanced). film_deflection: of the film's own pressure ("hydrodynamic", the paper) or
    of the whole load, by Johnson's scaled modulus E' F_H/F_T ("scaled") or of film and contact pressure ("total");
    "auto": the first where that changes f by less than its share of the tolerance, else the second.

    What is modelled: "auto" takes no more than the tolerance needs (docs/levels.md). model "full": everything, on the
    scene's own grid; "deterministic": one gap and one pressure instead of load sharing (docs/deterministic.md).
    film_level, contact_level, grid: a level given by name instead. heat: of inlet, film and surfaces, "auto" (where it
    matters and the lubricant says how its viscosity falls with the temperature), "on", "off". accept: results outside
    the range of the model are returned, marked, instead of refused.

    What surface it is modelled with: sampling "line", a line of the scene's roughness as long as the standard error
    ``sampling_tolerance`` of f asks, relative (docs/uncertainty.md); "patch", the one patch of ``contact.shape``.
    """

    tolerance: float = 0.01
    ehl_tolerance: float | None = None
    contact_tolerance: float | None = None
    balance_tolerance: float | None = None
    cavitated_shear: str = "none"
    workers: int = 1
    closure: str = "load"
    film_deflection: str = "auto"
    model: str = "auto"
    film_level: str = "auto"
    contact_level: str = "auto"
    grid: str = "auto"
    sampling: str = "line"
    sampling_tolerance: float = 0.02
    heat: str = "auto"
    accept: bool = False

    def __post_init__(self):
        for name, options in (
            ("model", MODELS),
            ("film_level", FILM_LEVELS),
            ("contact_level", CONTACT_LEVELS),
            ("grid", GRIDS),
            ("sampling", SAMPLINGS),
            ("heat", HEATS),
        ):
            validate.choice(f"numerics.{name}", getattr(self, name), options)
        validate.choice("numerics.closure", self.closure, CLOSURES)
        validate.choice("numerics.film_deflection", self.film_deflection, FILM_DEFLECTIONS)
        if self.film_deflection == "total":
            for name, allowed in (("closure", ("load",)), ("film_level", ("auto", "none", "ehl"))):
                if getattr(self, name) not in allowed:
                    raise InputError(
                        f"numerics.{name} = {getattr(self, name)!r} does not go with film_deflection = 'total'; "
                        f"allowed: {', '.join(map(repr, allowed))}"
                    )
        validate.number("numerics.tolerance", self.tolerance, "(-)", minimum=1e-4, maximum=0.2)
        validate.number("numerics.sampling_tolerance", self.sampling_tolerance, "(-)", minimum=1e-3, maximum=0.5)
        for name in ("ehl_tolerance", "contact_tolerance", "balance_tolerance"):
            if getattr(self, name) is not None:
                validate.number(f"numerics.{name}", getattr(self, name), "(-)", above=0, maximum=0.2)
        validate.choice("numerics.cavitated_shear", self.cavitated_shear, CAVITATED_SHEAR)
        validate.integer("numerics.workers", self.workers, minimum=1, maximum=MOST_THREADS)
        validate.boolean("numerics.accept", self.accept)

    @property
    def forced_film_level(self) -> str:
        """Film level given by name, by ``model = "full"`` or by the total deflection, which rigid films have none of;
        "auto" where it is to be chosen."""
        numerical = self.model == "full" or self.film_deflection == "total"
        return "ehl" if numerical and self.film_level == "auto" else self.film_level

    @property
    def film_tolerance(self) -> float:
        """Of the EHL film: a film error enters F_H, and so f, about one to one."""
        return self.ehl_tolerance or min(0.3 * self.tolerance, 0.01)

    @property
    def pressure_tolerance(self) -> float:
        """Of the contact solve."""
        return self.contact_tolerance or min(1e-2 * self.tolerance, 1e-4)

    @property
    def volume_tolerance(self) -> float:
        """Of the closing of load and volume."""
        return self.balance_tolerance or min(5e-2 * self.tolerance, 1e-3)


@dataclass(frozen=True)
class Scene:
    """One problem, complete: `lubfric.friction` and `lubfric.stribeck` take nothing else.

    surface, counterface: the roughness of the two bodies (None: the other one is smooth); the sum of both is in
    contact.
    """

    bodies: Bodies
    lubricant: Lubricant
    motion: Motion
    surface: Roughness
    contact: Patch = field(default_factory=Patch)
    numerics: Numerics = field(default_factory=Numerics)
    name: str = "unnamed"
    transient: Transient | None = None
    counterface: Roughness | None = None

    def __post_init__(self):
        if self.numerics.heat == "on" and not self.lubricant.heats:
            raise InputError(
                "numerics.heat = 'on' needs to know how the viscosity falls with the temperature; allowed: an "
                "oil (lubricant.grade, "
                "nu40, oil) or lubricant.temperature [K] and temperature_coefficient [1/K], or heat = 'auto'"
            )

    def with_(self, **sections) -> Scene:
        """A copy with fields of sections replaced: ``scene.with_(bodies={"load": 10.0})``.

        The short forms of scene files serve as well: ``scene.with_(lubricant={"temperature_celsius": 90})``.
        """
        changed = {}
        for section, values in sections.items():
            if section not in self.__dataclass_fields__:
                raise InputError(
                    f"scene has no section {section!r}{validate.nearest(section, self.__dataclass_fields__)}"
                )
            changed[section] = _changed(section, getattr(self, section), values)
        return replace(self, **changed)

    def to_toml(self) -> str:
        """The scene as the text of a scene file, which `lubfric.load_scene` reads back to the same numbers."""
        from .scene_text import scene_as_toml

        return scene_as_toml(self)


def _changed(section: str, old: Any, values: Any) -> Any:
    """``old`` with the fields in the dict ``values``, or ``values`` itself where it is of the section's type."""
    kinds: dict[str, type] = {"name": str, "transient": Transient, "counterface": Roughness}
    kind: Any = kinds.get(section, type(old))
    if isinstance(values, kind) or (section in ("transient", "counterface") and values is None):
        return values
    if section == "counterface" and old is None and isinstance(values, dict):
        return counterface(values)
    if not isinstance(values, dict) or not isinstance(old, kind) or kind is str:
        by_field = "a dict of its fields, or " if kind is not str and old is not None else ""
        shown = repr(values) if isinstance(values, (str, float, int)) else f"a {type(values).__name__}"
        raise InputError(f"{section} = {shown}; allowed: {by_field}a {kind.__name__}")
    allowed = (*old.__dataclass_fields__, *short_keys(section))
    for key in values:
        if key not in allowed:
            raise InputError(
                f"{section} has no field {key!r}{validate.nearest(key, allowed)}; allowed: {', '.join(allowed)}"
            )
    if isinstance(old, Roughness):
        values = as_given(old, values)
    with told_slips(section, values), named(section):
        return replace(old, **resolve(section, values, old))


def scene_as_dict(scene: Scene) -> dict:
    """The resolved scene as plain data (for ``result.json``)."""
    return asdict(scene)
