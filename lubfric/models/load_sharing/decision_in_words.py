"""What was modelled by load sharing, as text."""

import math

from ...contact import RoughContact
from ...samples import Cells
from ...scene import Scene, budget
from ..shared import Decision, percent_or_less
from .balance import Balance


def decision_of(
    scene: Scene,
    rough_contact: RoughContact,
    balance: Balance,
    *,
    clearance: float,
    cells: Cells,
    strips: int,
    change_by_cells: float,
) -> Decision:
    """Return the decision of the paper's model behind ``balance`` on ``rough_contact``.

    ``clearance`` [Sq]: between the film and the highest summits, NaN in contact; ``cells``: of the strips; others are
    fields of `Decision`.
    """
    tolerance = scene.numerics.tolerance
    film = balance.film
    grid = rough_contact.grid
    touching = math.isnan(clearance)
    notes = balance.notes
    heat = ""
    if film is not None:
        heat = balance.forces.heat.text(tolerance)
        if (error := balance.forces.quadrature) > budget.SHEAR_SUM * tolerance:
            of_f = percent_or_less(error, 1)
            text = f"the film's friction is not resolved (a pressure spike?): estimated error {of_f} of f"
            notes = (*notes, text)
    return Decision(
        film_in_words=f"none, {balance.why_no_film}" if film is None else "full EHL",
        contact_in_words=rough_contact.name if touching else f"none, clearance {clearance:.2g} Sq",
        tolerance=tolerance,
        film_tolerance=0.0 if balance.settings is None else balance.settings.film_tolerance,
        shape=grid if touching else None,
        heat_in_words=heat,
        notes=notes,
        coarsening=cells.coarsening,
        cell_size=cells.spacing if touching else None,
        strips=strips,
        change_by_cells=change_by_cells,
    )
