"""The quick answer: a few strips by the deterministic model on long cells, with the error that solved cases give them.

- `long_cells`: the cells, the solves, and the features of a strip on which its error depends.
- `calibrated_error`: the bias and the 95 % bounds of f by these features; calibration.toml has their numbers.
- `quick_model`: ``"quick"``, the model that answers by them, beside the balance of ``"paper"``.
"""

from .calibrated_error import error_models, widening
from .long_cells import (
    CELLS_IN_MOTION,
    CELLS_OF_THIN_FILM,
    THIN_BY_FILM,
    features,
    long_cells_in_motion,
    long_cells_of,
    map_coarsening_at_rest,
    map_coarsening_in_motion,
    numbers_of_strip,
    on_cells_along_x,
    solve_at_rest,
    solve_moving,
)
from .quick_model import QuickModel
