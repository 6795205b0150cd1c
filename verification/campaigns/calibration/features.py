"""What the quick answer knows of a case: its map by the deterministic model on long cells."""

import time

from lubfric.models.quick import factors_of_long_cells, numbers_of_strip, solve_at_rest, solve_moving

from .case import Case


def quick(case: Case) -> dict[str, float]:
    """Return the numbers of the strip of ``case`` on long cells, and the processor time [s] that it takes."""
    begun = time.process_time()
    facts = case.facts
    (nx, ny) = case.surface.shape
    lengths = (facts["length_x"], facts["length_y"])
    factors = factors_of_long_cells(case.scene, case.surface.spacing, ny, lengths)
    if facts["motion"] == "rolling":
        pair = solve_moving(case.scene, case.bodies, case.speed, factors)
    else:
        pair = solve_at_rest(case.scene, case.surface, case.speed, factors)
    return numbers_of_strip(pair) | {"seconds": time.process_time() - begun}
