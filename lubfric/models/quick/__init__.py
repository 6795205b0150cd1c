"""The quick model: a few strips by the deterministic model on long cells, with the error that solved cases give them.

- `long_cells`: the cells, a strip on them, and its features, on which its error depends.
- `calibrated_error`: the bias and the 95 % bounds of f by these features; calibration.toml has their numbers.
- `strips_on_long_cells`: how many strips, their f without its bias, and its bounds.
- `quick_model`: ``"quick"``, the model that answers by them, or by the balance of ``"paper"``.
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
    numbers_for_features,
    on_cells_along_x,
    solve_at_rest,
    solve_moving,
)
from .quick_model import QuickModel
from .strips_on_long_cells import quick_answer_of, solve_on_long_cells
