"""Heat of a strip by the deterministic model, and the error of f by it.

The heat of the inlet is in its film (`lubfric.models.shared.film_lubricant`). That of film and surfaces lowers the
shear stress. Each column of cells along y has walls of one temperature, which the mean heat of its cells makes, and
every cell has the stress between these walls.

The walls follow from two solves for one film of the mean pressure and gap of each column. The stress of such a film is
smaller than the mean stress of the cells, because thin places have most of the stress. So the second solve counts the
stress of the film by the ratio of the two.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..._base import FloatArray
from ...film import FilmHeat, heated_film, heated_stress
from ...scene import Scene
from ..shared import Heat, inlet_at, peclet_at, percent_or_less, surroundings
from .result import DeterministicResult

# Factor on the film by heat below which only Eq. (8) was checked.
LEAST_FILM = 0.7

# Solves for the temperature of the walls [-]: the third one changes the largest rise by 1.3 % at most on nine strips of
# 0.9 GPa (Sq 100 to 300 nm, slide-roll ratio 2), the second one by 6 %.
WALL_SOLVES = 2

# Relative change of f by heat beyond which only Eq. (8) was checked.
MOST_CHANGE = 0.2


def heat_of_strips(scene: Scene, results: Sequence[DeterministicResult]) -> Heat:
    """Return the mean `Heat` of the strips whose ``results`` these are, on equal cells."""
    heats = [strip_heat(scene, result) for result in results]
    films = [heat.heated for heat in heats if heat.heated is not None]
    if not films:
        return heats[0]
    mean = replace(
        films[0],
        stress=np.mean([film.stress for film in films], axis=0),
        wall=np.mean([film.wall for film in films], axis=0),
        film_rise=np.mean([film.film_rise for film in films], axis=0),
    )
    return replace(heats[0], change=float(np.mean([heat.change for heat in heats])), heated=mean)


def strip_heat(scene: Scene, result: DeterministicResult) -> Heat:
    """Return the `Heat` of ``result``: ``change`` is the share of f that the temperatures of film and surfaces take
    away."""
    inlet, used = inlet_at(scene, result.speed)
    sliding = abs(scene.motion.slide_roll_ratio * result.speed)
    if inlet is None or sliding == 0:
        return Heat(inlet=inlet, is_used=used)
    wet = result.wet
    (film, hot) = _heated_cells(scene, result)
    lost = float(((result.shear - hot) * wet).mean(axis=1).sum()) * result.spacing[0]
    change = lost / max(abs(result.coefficient) * result.load, 1e-300)
    return Heat(inlet=inlet, is_used=used, change=change, heated=film, peclet=peclet_at(scene, result.speed))


def _heated_cells(scene: Scene, result: DeterministicResult) -> tuple[FilmHeat, FloatArray]:
    """Return the temperatures of ``result`` at its columns, and the size of the shear stress [Pa] (nx, ny) of the
    heated film in its cells."""
    lubricant = scene.lubricant
    sliding = abs(scene.motion.slide_roll_ratio * result.speed)
    wet = result.wet
    count = wet.sum(axis=1)
    weights = np.where(count[:, None] > 0, wet / np.maximum(count, 1)[:, None], 1 / wet.shape[1])
    mean_pressure = (result.pressure * weights).sum(axis=1)
    mean_gap = (result.gap * weights).sum(axis=1)
    boundary_stress = (result.shear * result.rubbing).mean(axis=1)
    around = surroundings(scene, result.speed, wet.mean(axis=1), boundary_stress)
    for _ in range(WALL_SOLVES):
        film = heated_film(lubricant, result.x, mean_pressure, mean_gap, around)
        walls = film.wall[:, None]
        hot, rise = (np.abs(each) for each in heated_stress(lubricant, result.pressure, result.gap, sliding, walls))
        heat_of_cells = (hot * wet).mean(axis=1)
        around = replace(around, wet=heat_of_cells / np.abs(film.stress))
    return replace(film, film_rise=(rise * weights).sum(axis=1)), hot


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
