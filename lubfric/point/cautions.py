"""What a reader of a converged result must know about its limits, measured on the result."""

from __future__ import annotations

from dataclasses import dataclass

from ..film.shear import ShearForce
from ..scene import Scene
from .balance import Balance

ROELANDS_LIMIT = 1e9  # Pa, about the pressure to which the law was fitted
FLUID_FRICTION = 0.15  # F_sh/F_H above which a Newtonian oil is beyond what any lubricant carries
STRIP_SHARE = 0.2  # of the mean gap that the undeformed cylinder may rise over the strip
THICK_FILM = 0.1  # of the radius: beyond it the gap is no parabola


@dataclass(frozen=True)
class Caution:
    """A limit of the model that a result has passed.

    what: the quantity, its value and limit in ``unit``; sentence: what the result then is; remedy: the scene key that
    helps (empty: none does).
    """

    what: str
    value: float
    limit: float
    unit: str
    sentence: str
    remedy: str = ""

    @property
    def text(self) -> str:
        """As in `Report.notes`."""
        return f"caution: {self.sentence}"


def cautions(scene: Scene, balance: Balance, shear: ShearForce) -> tuple[Caution, ...]:
    """Where a `Balance` and its `ShearForce` leave the range in which the model is meant to hold."""
    if balance.film is None:
        return ()
    found = (
        _pressure(scene, balance),
        _newtonian(scene, balance, shear),
        _strip(scene, balance),
        _thick(scene, balance),
    )
    return tuple(caution for caution in found if caution is not None)


def _pressure(scene: Scene, balance: Balance) -> Caution | None:
    peak = float(balance.film.pressure.max())
    if peak <= ROELANDS_LIMIT or scene.lubricant.viscosity_law == "constant":
        return None
    sentence = f"film pressure {peak / 1e9:.2g} GPa, where the viscosity law is an extrapolation"
    return Caution("film pressure", peak, ROELANDS_LIMIT, "Pa", sentence)


def _newtonian(scene: Scene, balance: Balance, shear: ShearForce) -> Caution | None:
    lubricant = scene.lubricant
    newtonian = lubricant.eyring_stress is None and lubricant.limiting_stress_coefficient is None
    if not newtonian or not shear.couette > FLUID_FRICTION * balance.film_load:
        return None
    value, remedy = shear.couette / balance.film_load, "lubricant.eyring_stress or a limiting stress"
    sentence = f"Newtonian shear gives the film a friction coefficient of {value:.2g}; choose {remedy}"
    return Caution("friction coefficient of the film", value, FLUID_FRICTION, "-", sentence, remedy)


def _strip(scene: Scene, balance: Balance) -> Caution | None:
    rise, gap = scene.bodies.half_width**2 / (6 * scene.bodies.radius), balance.contact.mean_gap
    own = scene.numerics.film_deflection == "hydrodynamic"
    if not own or balance.contact_load == 0 or rise <= STRIP_SHARE * gap:
        return None
    remedy = "numerics.film_deflection = 'scaled' or 'total'"
    sentence = (
        f"over the Hertz strip the undeformed cylinder rises {rise:.2g} m on average, not small against the mean gap "
        f"{gap:.2g} m; a film flattened by its own pressure alone then takes too much of the load (f does not tend to "
        f"f_b): see {remedy}"
    )
    return Caution("rise of the cylinder over the strip", rise, STRIP_SHARE * gap, "m", sentence, remedy)


def _thick(scene: Scene, balance: Balance) -> Caution | None:
    film, radius = balance.film.central_film, scene.bodies.radius
    if film <= THICK_FILM * radius:
        return None
    sentence = f"film {film:.2g} m is not thin against the radius {radius:.2g} m"
    return Caution("central film", film, THICK_FILM * radius, "m", sentence)
