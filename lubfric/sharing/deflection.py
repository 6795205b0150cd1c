"""Which pressure deflects the film: its own where that is within the tolerance, else that of the whole load.

A film that only its own pressure deflects is too thick. The excess is about the mean rise of the undeformed cylinder
over the Hertz strip, b²/(6R), times the film's share of the load. Johnson's modulus has the right limit f -> f_b. It
changes f by at most about ``rise/gap min(2.2 s, 1.2)``, with s the sensitivity of f to the film. On 1,233 random scenes
of 60 MPa to 1.2 GPa, Sq 10 nm to 1 µm, the change was at most 0.97 times this estimate where the estimate is 0.2 to 5
%, and at most 0.44 % where it is below 0.5 %.
"""

from __future__ import annotations

import math
from dataclasses import replace

from ..errors import LubfricError
from ..scene import budget
from .adapt import Solved, solved
from .balance import Balance
from .prepared import Prepared

PER_SENSITIVITY, AT_MOST = 2.2, 1.2
CERTAIN = 3.0  # times the limit: beyond it by the loose solve, the film's own pressure is not tried
LOOSE = {"film_deflection": "hydrodynamic", "tolerance": 0.1, "model": "auto", "grid": "auto", "heat": "off"}
SENSIBLE = 0.3  # above it the estimate is no number to quote


def own_pressure_error(scene, balance: Balance) -> float:
    """Upper estimate of the relative change of f when the whole load deflects the film, and not its own pressure
    alone."""
    return own_pressure_film_error(scene, balance) * balance.forces.sensitivity


def own_pressure_film_error(scene, balance: Balance) -> float:
    """The relative error of the film that changes f by `own_pressure_error`."""
    if balance.contact_load == 0:
        return 0.0
    rise = scene.bodies.strip_rise / max(balance.contact.mean_gap, 1e-300)
    return rise * min(PER_SENSITIVITY, AT_MOST / max(balance.forces.sensitivity, 1e-300))


def solved_as_deflected(
    prepared: Prepared, speed: float, start: Balance | None = None, *, given_grid: bool = False
) -> tuple[Prepared, Solved]:
    """``prepared`` with the deflection of its film, and its solution (`solved`). The deflection is the scene's or,
    where that is "auto", the one that the tolerance needs.

    The neighbour ``start``, or else a loose solve, may be far beyond the share of a film's own pressure. Then the whole
    load is tried first, and kept if its own solution confirms that. The choice does not depend on ``start``.
    """

    def by(option: str, start: Balance | None) -> tuple[Prepared, Solved]:
        chosen = deflected_by(prepared, option)
        return chosen, solved(chosen, speed, start, given_grid=given_grid)

    scene = prepared.scene
    if scene.numerics.film_deflection != "auto":
        return prepared, solved(prepared, speed, start, given_grid=given_grid)
    limit = budget.DEFLECTION * scene.numerics.tolerance
    error, start = _expected_error(prepared, speed, start)
    if error > CERTAIN * limit:
        chosen, found = by("scaled", start)
        if start is not None:
            error, start = own_pressure_error(scene, found.balance), found.balance
        if error > CERTAIN * limit:
            return chosen, _told(chosen.scene, found, error, limit)
    chosen, found = by("hydrodynamic", start)
    error = own_pressure_error(scene, found.balance)
    if error > limit:
        chosen, found = by("scaled", found.balance)
    return chosen, _told(chosen.scene, found, error, limit)


def _told(scene, found: Solved, error: float, limit: float) -> Solved:
    """``found``, solved with the deflection of ``scene``: the choice is noted in its decision where film and contact
    share the load, and what it leaves out of the film."""
    option, balance = scene.numerics.film_deflection, found.balance
    if balance.film is None or balance.contact_load == 0:
        return found
    left = own_pressure_film_error(scene, balance) if option == "hydrodynamic" else 0.0
    told = in_words(error, limit, option)
    return replace(found, decision=replace(found.decision, deflection=told, deflection_left_out=left))


def _expected_error(prepared: Prepared, speed: float, start: Balance | None) -> tuple[float, Balance | None]:
    """`own_pressure_error` of a neighbour or, without one, of a loose solve, and its balance. Where the loose solve
    fails, infinite and None: that says nothing about the point itself."""
    if speed == 0:
        return 0.0, start
    if start is not None and start.film is not None:
        return own_pressure_error(prepared.scene, start), start
    try:
        found = solved(_loose(prepared), speed).balance
    except LubfricError:
        return math.inf, None
    return own_pressure_error(prepared.scene, found), found


def _loose(prepared: Prepared) -> Prepared:
    """Solve ``prepared``, deflected by the film's own pressure, to a loose tolerance that is enough for the choice."""
    return replace(prepared, scene=prepared.scene.with_(numerics=LOOSE))


def deflected_by(prepared: Prepared, option: str) -> Prepared:
    """``prepared`` with its film deflected by the pressure that ``option`` names; contact and map are the same."""
    return replace(prepared, scene=prepared.scene.with_(numerics={"film_deflection": option}))


def in_words(error: float, limit: float, option: str) -> str:
    """The choice for `Decision.text`."""
    if option == "hydrodynamic":
        return f"deflection: by the film's own pressure, at most {100 * error:.2g} % of f < {100 * limit:.2g} % budget"
    if error == math.inf:
        return "deflection: by the whole load (scaled modulus), the safer choice: the solve that was to choose failed"
    share = f"{100 * error:.2g} %" if error < SENSIBLE else "far more"
    return (
        "deflection: by the whole load (scaled modulus); by the film's own pressure alone f may be off by "
        f"{share} > {100 * limit:.2g} % budget"
    )
