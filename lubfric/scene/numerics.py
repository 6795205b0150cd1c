"""How exactly a scene is solved, and by which methods."""

from __future__ import annotations

from dataclasses import dataclass

from .._base import Brief, validate
from ..errors import InputError
from . import budget

MOST_THREADS = 1024
CAVITATED_SHEAR = ("none", "striated")
HEATS = ("auto", "on", "off")
CLOSURES = ("load", "separation", "one-way")
FILM_DEFLECTIONS = ("auto", "hydrodynamic", "scaled", "total")
MODELS = ("auto", "full", "deterministic")
FILM_LEVELS = ("auto", "none", "isoviscous", "piezoviscous", "ehl")
CONTACT_LEVELS = ("auto", "none", "flat", "semi-periodic")
GRIDS = ("auto", "given")
SAMPLINGS = ("line", "patch")


@dataclass(frozen=True)
class Tolerances:
    """Relative tolerances: of the EHL film (its error enters F_H, and so f, about one to one), of the contact solve,
    and of the closing of load and volume."""

    film: float
    contact: float
    balance: float


@dataclass(frozen=True, repr=False)
class Numerics(Brief):
    """How exactly a scene is solved, and what is modelled. Tolerances are relative.

    Attributes
    ----------
    tolerance : on the friction coefficient. The tolerances of film, contact and balance follow from it if they are left
        out (`tolerances`)
    film_tolerance, contact_tolerance, balance_tolerance : of the parts; None: from ``tolerance``
    sampling : the surface that is solved: "line", a line of the scene's roughness as long as ``sampling_tolerance``
        needs (docs/uncertainty.md); "patch", the one patch of ``contact.shape``
    sampling_tolerance : standard error of f that a finite line may leave
    closure : "load": contact solved at F_T - F_H, volume balanced; "separation": the paper's way, film imposed on the
        contact, loads balanced; "one-way": one film in the dry contact's own gap
    film_deflection : which pressure deforms the film: its own ("hydrodynamic", the paper); the whole load, by Johnson's
        scaled modulus E' F_H/F_T ("scaled"); film and contact pressure ("total"). "auto": the first if the second
        changes f by less than its share of the tolerance, else the second
    model : "auto": no more than the tolerance needs (docs/levels.md); "full": everything, on the scene's own grid;
        "deterministic": one gap and one pressure instead of load sharing (docs/deterministic.md)
    film_level, contact_level, grid : a level given by name instead of "auto"
    heat : whether the heat of inlet, film and surfaces is modelled: "auto" (if it matters, and the lubricant says how
        its viscosity falls with the temperature), "on", "off"
    accept : True: results outside the range of the model are returned and marked, instead of refused
    cavitated_shear : "none", or "striated": shear of the streamers behind the rupture
    workers : threads of the Fourier transforms
    """

    tolerance: float = 0.01
    film_tolerance: float | None = None
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
        validate.python_fields(self)
        for name, options in (
            ("model", MODELS),
            ("film_level", FILM_LEVELS),
            ("contact_level", CONTACT_LEVELS),
            ("grid", GRIDS),
            ("sampling", SAMPLINGS),
            ("heat", HEATS),
            ("closure", CLOSURES),
            ("film_deflection", FILM_DEFLECTIONS),
            ("cavitated_shear", CAVITATED_SHEAR),
        ):
            validate.choice(f"numerics.{name}", getattr(self, name), options)
        if self.film_deflection == "total":
            for name, allowed in (("closure", ("load",)), ("film_level", ("auto", "none", "ehl"))):
                if getattr(self, name) not in allowed:
                    raise InputError(
                        f"numerics.{name} = {getattr(self, name)!r} does not go with film_deflection = 'total'; "
                        f"allowed: {', '.join(map(repr, allowed))}"
                    )
        validate.number("numerics.tolerance", self.tolerance, "(-)", minimum=1e-4, maximum=0.2)
        validate.number("numerics.sampling_tolerance", self.sampling_tolerance, "(-)", minimum=1e-3, maximum=0.5)
        for name in ("film_tolerance", "contact_tolerance", "balance_tolerance"):
            if getattr(self, name) is not None:
                validate.number(f"numerics.{name}", getattr(self, name), "(-)", above=0, maximum=0.2)
        validate.integer("numerics.workers", self.workers, minimum=1, maximum=MOST_THREADS)
        validate.boolean("numerics.accept", self.accept)

    @property
    def tolerances(self) -> Tolerances:
        """The tolerances of the parts, as given or as they follow from ``tolerance``."""
        asked = self.tolerance
        return Tolerances(
            film=self.film_tolerance or min(budget.FILM_GRID * asked, budget.FIRST_FILM),
            contact=self.contact_tolerance or min(budget.CONTACT * asked, budget.FIRST_CONTACT),
            balance=self.balance_tolerance or min(budget.BALANCE * asked, budget.FIRST_VOLUME),
        )
