"""How exactly a scene is solved, and by which methods."""

from dataclasses import KW_ONLY, dataclass
from typing import Any, Self

from .._base import Shown, packaged, validate
from ..errors import InputError
from . import budget

MOST_THREADS = 1024  # of a transform. A convention: more than a machine has

# A value of ``model`` in version 0.2.0, which is still accepted, for the model "quick".
FORMER_NAME_OF_QUICK = "load-sharing"


@dataclass(frozen=True, repr=False)
class Numerics(Shown):
    """Tolerances, models and methods of a solve. Tolerances are relative.

    Attributes
    ----------
    tolerance : on the friction coefficient. The tolerances of film, contact and balance follow from it if they are
        omitted (`tolerance_of`)
    film_tolerance, contact_tolerance, balance_tolerance : of the parts; None: from ``tolerance``
    sampling : the surface that is solved: "strips", as many of the scene's roughness as ``sampling_tolerance`` needs
        (docs/uncertainty.md); "patch", the one patch of ``contact.shape``
    sampling_tolerance : target of the relative standard error of f by the finite sample of the surface
    model_tolerance : target of the relative model-form error of f, at 95 %
    film_deflection : which pressure deforms the film: the total load, by Johnson's scaled modulus E' F_H/F_T
        ("scaled"); its own ("hydrodynamic", the paper)
    model : "paper": film and contact share the load, Eq. (8), with the friction of Eq. (9) on a smooth film;
        "deterministic": the deterministic model (docs/deterministic.md); "quick": that model on a few strips of
        long cells, with a calibrated error; "auto": the cheapest that is within ``model_tolerance``
        (docs/uncertainty.md)
    grid : "auto": cells of the contact as long as the tolerance allows; "given": the scene's own
    heat : whether the heat of inlet, film and surfaces is modelled: "auto" (if it matters, and the lubricant states how
        its viscosity falls with the temperature), "on", "off"
    accept : True: results outside the range of the model are returned and marked, instead of refused
    cavitated_shear : "none", or "striated": shear of the streamers behind the rupture
    max_work : counted work [s of a usual core] that one point may take. Where a point would take
        more, "auto" answers by a cheaper model that is solved, with its interval, and any other model is refused. A run
        in time, or `lubfric.run_in`, ends there with its results so far. None: ten times the estimate of `lubfric
        info`, at least 120 s; no limit for `lubfric.run_in`
    workers : threads of the Fourier transforms
    """

    tolerance: float = 0.01
    _: KW_ONLY
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
    max_work: float | None = None

    def __new__(cls, *args: object, **given: bool | float | str | None) -> Self:
        refuse_dropped(given)
        return super().__new__(cls)

    def __post_init__(self) -> None:
        if self.model == FORMER_NAME_OF_QUICK:
            object.__setattr__(self, "model", "quick")
        validate.python_fields(self, "numerics")
        validate.in_range("numerics", self)
        validate.integer("numerics.workers", self.workers, minimum=1, maximum=MOST_THREADS)
        validate.boolean("numerics.accept", self.accept)

    def tolerance_of(self, part: str) -> float:
        """Return the relative tolerance of a part, as given or as it follows from ``tolerance``: of the EHL "film" (its
        error enters F_H, and so f, about one to one), of the "contact" solve, and of the "balance" of load and
        volume."""
        share, most = budget.OF_PARTS[part]
        return getattr(self, f"{part}_tolerance") or min(share * self.tolerance, most)


def refuse_dropped(given: dict[str, Any]) -> None:
    """Raise `InputError` for a key of [numerics], or a value of one, that there is no more; it says what to do."""
    dropped = packaged(__package__, "other_words.toml")["dropped"]["numerics"]
    for key, value in given.items():
        recommendation = dropped.get(f"{key} = {validate.shown(value)}") or dropped.get(key)
        if recommendation:
            raise InputError(
                f" = {validate.shown(value)} was removed", f"numerics.{key}", recommendation=recommendation
            )
