"""At which points friction comes from sliding."""

from collections.abc import Mapping

import numpy as np


def is_by_sliding(columns: Mapping[str, np.ndarray]) -> np.ndarray:
    """Return at which points of a table f counts in its means, in the smallest f and in relative errors: a bool for
    each.

    Where rolling resistance makes most of f, as near the pitch point of a gear or at a small slide-roll ratio, the
    relative error of f says nothing, and the power loss is the number to look at. So the force by shear of film and
    asperity contacts has to exceed the rolling force. Where it does so nowhere, all points count, as in a study of rolling
    resistance.

    ``columns``: coefficient [-]; boundary_force, couette_force and rolling_force [N], without which all points count.
    """
    f = columns["coefficient"]
    if "couette_force" not in columns or "boundary_force" not in columns:
        return np.ones(f.shape, dtype=bool)
    by_shear = np.abs(columns["boundary_force"] + columns["couette_force"])
    slides = np.isnan(by_shear) | (by_shear > np.abs(np.nan_to_num(columns.get("rolling_force", np.zeros(f.shape)))))
    return slides if (slides & np.isfinite(f)).any() else np.ones(f.shape, dtype=bool)
