"""The length of a Newton step: two limits keep the film physical."""

from __future__ import annotations

import numpy as np

VISCOSITY_STEP = 3.0  # largest change of ln(eta) in one step
FILM_STEP = 0.7  # largest share of the film (or the flux) that one step may remove


def step_length(log_viscosity_change: np.ndarray, film_loss: float) -> float:
    """The part of a step to take, 0 to 1. It follows from two effects of the whole step: the change of ln(eta) at the
    nodes, and ``film_loss``, the largest fraction of the film (or flux) that it removes."""
    change = float(np.max(np.abs(log_viscosity_change)))
    length = 1.0 if change <= VISCOSITY_STEP else VISCOSITY_STEP / change
    return length if film_loss * length <= FILM_STEP else FILM_STEP / film_loss
