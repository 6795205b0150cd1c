"""The film that would carry the total load, with closed forms, and the lambda ratio of it."""

import math

from ..scene import Scene


def full_load_numbers(scene: Scene, speed: float, sq: float, inlet_film_factor: float) -> dict[str, float]:
    """Return the full-load film thickness [m] and the lambda ratio at ``speed`` [m/s] on roughness of ``sq`` [m], by
    the names of their columns.

    The film is that of Moes' formula, as much thinner as starvation and shear thinning make it with closed forms, and
    as ``inlet_film_factor`` (NaN: not known) makes it. Both are NaN without entrainment; the ratio of smooth surfaces
    is infinite.
    """
    if speed == 0:
        return {"full_load_film": math.nan, "lambda_ratio": math.nan}
    factor = 1.0 if math.isnan(inlet_film_factor) else inlet_film_factor
    film = scene.line_contact(speed).expected_film_with(factor)
    return {"full_load_film": film, "lambda_ratio": film / sq if sq > 0 else math.inf}
