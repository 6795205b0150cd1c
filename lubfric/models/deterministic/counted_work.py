"""The work of Newton's method, counted in seconds of a usual core: from cells and steps alone, never from a clock."""

import math

# Seconds a cell of a Newton step without its linear system, measured on the 2.6 GHz core of the first campaigns.
NEWTON_STEP = 1.7e-6

# Seconds a cell of the LU factorisation, over log2 of the cells; the same core. Measured as `NEWTON_STEP`.
LU_FACTORISATION = 1.35e-7

# Seconds a cell of one iteration of GMRES; the same core. Measured as `NEWTON_STEP`.
GMRES_ITERATION = 1.9e-7

# Counted work [s] of the strips of a point and of their shorter cells, at most, whether the model is named or chosen;
# "auto" leaves a point whose first strip takes more to the quick model (docs/models.md).
MOST_WORK_OF_POINT = 120.0

# Least and largest processor time over counted work [-], about: of usual jobs on two machines (docs/measurements.md).
USUAL_PACES = (0.5, 1.0)


def work_of_steps(cells: float, steps: float, krylov: float = 0) -> float:
    """Return the work [s] of so many ``steps`` of Newton's method, with ``krylov`` iterations of GMRES in all."""
    return cells * (steps * (NEWTON_STEP + LU_FACTORISATION * math.log2(cells)) + krylov * GMRES_ITERATION)
