"""What the quick model knows of a case: its map by the deterministic model on long cells."""

import time

from lubfric.models.quick import (
    CELLS_IN_MOTION,
    CELLS_OF_THIN_FILM,
    long_cells_of,
    map_coarsening_at_rest,
    numbers_for_features,
    solve_at_rest,
    solve_moving,
)

from .case import Case

# Cells along x in a correlation length on which a case is solved, by motion: at rest those of the model alone; where
# the roughness moves both that it chooses from.
PER_LENGTH = {"rest": (0.0,), "rolling": (CELLS_IN_MOTION[0], CELLS_OF_THIN_FILM)}


def quick(case: Case, per_length: float) -> dict[str, float]:
    """Return the numbers of the strip of ``case`` on long cells, of which so many along x are in a correlation length
    (at rest it does not count); ``film_at_rest``: the number by which the model chooses them; ``seconds``: processor
    time [s]."""
    begun = time.process_time()
    facts = case.facts
    lengths = (facts["length_x"], facts["length_y"])
    if facts["motion"] == "rolling":
        cells = long_cells_of(case.scene, case.bodies, case.speed, lengths=lengths, per_length=per_length)
        pair = solve_moving(case.scene, cells, case.speed)
        film_at_rest = cells.by_film
    else:
        map_coarsening = map_coarsening_at_rest(
            case.scene, spacing=case.surface.spacing, rows=case.surface.shape[1], lengths=lengths
        )
        pair = solve_at_rest(case.scene, case.surface, case.speed, map_coarsening=map_coarsening)
        film_at_rest = 0.0
    numbers = numbers_for_features(pair, lengths[0], is_smooth=facts["acf"] == "gaussian")
    return numbers | {"film_at_rest": film_at_rest, "seconds": time.process_time() - begun}
