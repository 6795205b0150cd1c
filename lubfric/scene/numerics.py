"""How exactly a scene is solved, and by which methods."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .._base import Brief, validate
from ..errors import InputError
from . import budget

MOST_THREADS = 1024
OPTIONS = {
    "model": ("auto", "load-sharing", "deterministic"),
    "film_deflection": ("scaled", "hydrodynamic"),
    "grid": ("auto", "given"),
    "sampling": ("strips", "patch"),
    "heat": ("auto", "on", "off"),
    "cavitated_shear": ("none", "striated"),
}
DROPPED = {  # keys, and values of keys, that there were before: what to do instead
    "closure": "leave it out: film and contact always share the load as in Eq. (8)",
    "closure = 'one-way'": "leave it out, or give numerics.model = 'deterministic', which has one gap and one pressure",
    "closure = 'separation'": "leave it out; lubfric.paper has the paper's closure as contact solvers",
    "film_level": "leave it out: the film is always the full one (EHL)",
    "contact_level": "leave it out: contact.geometry says which contact is solved",
    "ehl_tolerance": "its name is numerics.film_tolerance",
    "model = 'full'": "leave it out, and give numerics.tolerance a smaller value",
    "film_deflection = 'auto'": "leave it out, or give 'scaled' or 'hydrodynamic'",
    "film_deflection = 'total'": "leave it out: with 'scaled' too the whole load deflects the film",
    "sampling = 'line'": "leave it out, or give 'strips'",
}


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
    sampling : the surface that is solved: "strips", as many of the scene's roughness as ``sampling_tolerance``
        needs (docs/uncertainty.md); "patch", the one patch of ``contact.shape``
    sampling_tolerance : standard error of f that a finite surface may leave
    model_tolerance : relative error of f that the model may leave, at 95 %
    film_deflection : which pressure deforms the film: the whole load, by Johnson's scaled modulus E' F_H/F_T
        ("scaled"); its own ("hydrodynamic", the paper)
    model : "load-sharing": film and contact share the load, Eq. (8); "deterministic": one gap and one pressure
        (docs/deterministic.md); "auto": the cheapest that is within ``model_tolerance`` (docs/uncertainty.md)
    grid : "auto": cells of the contact as long as the tolerance allows; "given": the scene's own
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
    film_deflection: str = "scaled"
    model: str = "auto"
    grid: str = "auto"
    sampling: str = "strips"
    sampling_tolerance: float = 0.02
    model_tolerance: float = 0.05
    heat: str = "auto"
    accept: bool = False

    def __new__(cls, *args, **given):
        refuse_dropped(given)
        return super().__new__(cls)

    def __post_init__(self):
        validate.python_fields(self, "numerics")
        for name, options in OPTIONS.items():
            validate.choice(f"numerics.{name}", getattr(self, name), options)
        validate.number("numerics.tolerance", self.tolerance, "(-)", minimum=1e-4, maximum=0.2)
        validate.number("numerics.sampling_tolerance", self.sampling_tolerance, "(-)", minimum=1e-3, maximum=0.5)
        validate.number("numerics.model_tolerance", self.model_tolerance, "(-)", minimum=1e-3, maximum=1.0)
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


def refuse_dropped(given: dict[str, Any]) -> None:
    """Raise `InputError` for a key of [numerics], or a value of one, that there is no more; it says what to do."""
    for key, value in given.items():
        way_out = DROPPED.get(f"{key} = {validate.shown(value)}") or DROPPED.get(key)
        if way_out:
            raise InputError(f" = {validate.shown(value)} is not there any more", f"numerics.{key}", way_out=way_out)
