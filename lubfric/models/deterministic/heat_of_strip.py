"""Heat of a strip by the deterministic model, and the error of f by it.

The heat of the inlet is in its film (`lubfric.models.shared.film_lubricant`). That of film and surfaces lowers the
shear stress: the walls are as hot as the means over its columns make them, and every cell has the stress between such
walls.
"""

import numpy as np

from ...film import heated_film, heated_stress
from ...scene import Scene
from ..shared import Heat, inlet_at, peclet_at, percent_or_less, surroundings
from .result import DeterministicResult

# Factor on the film by heat below which only Eq. (8) was checked.
LEAST_FILM = 0.7

# Relative change of f by heat beyond which only Eq. (8) was checked.
MOST_CHANGE = 0.2


def strip_heat(scene: Scene, result: DeterministicResult) -> Heat:
    """Return the `Heat` of ``result``: ``change`` is the share of f that the temperatures of film and surfaces take
    away."""
    inlet, used = inlet_at(scene, result.speed)
    sliding = abs(scene.motion.slide_roll_ratio * result.speed)
    if inlet is None or sliding == 0:
        return Heat(inlet=inlet, is_used=used)
    wet = result.wet
    cells = result.wet.sum(axis=1)
    covered = np.where(cells[:, None] > 0, wet / np.maximum(cells, 1)[:, None], 1 / wet.shape[1])
    p, h = ((field * covered).sum(axis=1) for field in (result.pressure, result.gap))
    around = surroundings(scene, result.speed, wet.mean(axis=1), (result.shear * result.rubbing).mean(axis=1))
    film = heated_film(scene.lubricant, result.x, p, h, around)
    hot = np.abs(heated_stress(scene.lubricant, result.pressure, result.gap, sliding, film.wall[:, None])[0])
    lost = float(((result.shear - hot) * wet).mean(axis=1).sum()) * result.spacing[0]
    change = lost / max(abs(result.coefficient) * result.load, 1e-300)
    return Heat(inlet=inlet, is_used=used, change=change, heated=film, peclet=peclet_at(scene, result.speed))


def warmed(scene: Scene, numbers: dict[str, float], heat: Heat) -> dict[str, float]:
    """Return ``numbers`` of a point, by name, whose shear stress is isothermal, with ``heat``. It takes its share of f
    from the sliding part of the film's force, or from the rolling part where that is less."""
    f = numbers["coefficient"]
    lost = abs(f) * heat.change * scene.bodies.load
    part = "couette_force" if lost <= numbers["couette_force"] else "rolling_force"
    return numbers | {
        "coefficient": f - lost / scene.bodies.load,
        "shear_force": numbers["shear_force"] - lost,
        part: numbers[part] - lost,
        "inlet_film_factor": heat.inlet_film_factor,
        "flash_temperature_rise": heat.flash,
        "film_temperature_rise": heat.film_rise,
    }


def why_too_hot(heat: Heat | None) -> str:
    """Return why ``heat`` is more than was checked for the deterministic model, as text; "" if it is not, or not known
    (None)."""
    if heat is None:
        return ""
    factor = heat.film_factor
    change = heat.change
    if factor >= LEAST_FILM and change <= MOST_CHANGE:
        return ""
    return (
        f"heat reduces the film to {factor:.2g} of its thickness, and f by {percent_or_less(change)}; the deterministic "
        f"model was checked down to {LEAST_FILM:g}, and up to {100 * MOST_CHANGE:g} %"
    )


def too_hot_in_words() -> str:
    """Return the heat from which `why_too_hot` has a reason, as text."""
    return (
        f"heat changes f by more than {100 * MOST_CHANGE:g} % or the film by more than {100 * (1 - LEAST_FILM):.0f} %"
    )
