"""Control variates of rolling contacts: the part of the variance of f between strips that each would leave.

``python -m verification.campaigns.moving_controls`` compares f of whole passes of strips, those of the references of
`moving_coverage`, with f of load sharing on the same maps, with what an attenuated map carries below the boundary film
when it is pressed dry at a fixed gap, and with the attenuated summits, the control in use.
"""

from . import extending

# isort: split
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import lubfric
from lubfric.models import prepare
from lubfric.models.deterministic import attenuated, bodies_of

from ..types import PlainRow
from . import table_file
from .calibration.case import Case
from .calibration.solve import load_sharing
from .moving_coverage.contacts import RollingContact, contacts
from .moving_coverage.table import FOLDER, REFERENCE_SEED, REFERENCES, with_seed

# Gap at which the attenuated map is pressed, over the smooth film: moving gaps are wider than the film by some .25 Sq.
PRESSED_AT = 1.25

FEWEST = 3  # strips of a contact: a scatter of fewer says nothing
TOLERANCE = 1e-4  # of the dry contacts


def controls(contact: RollingContact, seed: int) -> PlainRow:
    """Return the controls of the reference strip ``seed`` of ``contact``, with their processor times."""
    prepared = prepare(with_seed(contact, REFERENCE_SEED + seed))
    bodies = tuple(bodies_of(prepared, 0, contact.speed))
    case = Case(scene=contact.scene, bodies=bodies, speed=contact.speed, facts={"motion": "rolling"})
    return {"load sharing": load_sharing(case)["f"], "attenuated, pressed": pressed(contact, case)}


def pressed(contact: RollingContact, case: Case) -> float:
    """Return the mean pressure [Pa] on gaps below the boundary film of the attenuated map, pressed dry at a fixed
    gap."""
    bodies = contact.scene.bodies
    surface = attenuated(case.surface, bodies.half_width)
    film = contact.scene.line_contact(contact.speed).moes_film
    result = lubfric.solve_contact(
        -surface.heights, surface.spacing, bodies.e_prime, mean_gap=PRESSED_AT * film, tolerance=TOLERANCE
    )
    below = result.gap < bodies.boundary_film
    return float((result.pressure * below).mean())


def left(folder: Path = FOLDER) -> Iterator[PlainRow]:
    """Yield of each contact the part of the variance of f between strips that a control leaves, of which the slope is
    that of a fit over the same strips: the residual variance has a degree of freedom less."""
    rows = [row for row in table_file.rows(folder / REFERENCES) if row["kind"] == "strip" and not row["failure"]]
    for contact in contacts():
        strips = [row for row in rows if row["contact"] == contact.name]
        if len(strips) < FEWEST:
            continue
        f = np.array([float(row["plain"]) for row in strips])
        values = [controls(contact, int(row["seed"])) for row in strips]
        table = {name: np.array([value[name] for value in values]) for name in values[0]}
        yield {
            "contact": contact.name,
            "strips": len(strips),
            "scatter": float(f.std(ddof=1) / f.mean()),
            **{name: variance_left(f, control) for name, control in table.items()},
            "summits": float(np.mean([(float(row["error"]) / float(row["plain_error"])) ** 2 for row in strips])),
        }


def variance_left(f: np.ndarray, control: np.ndarray) -> float:
    """Return the part of the variance of ``f`` that a line in the ``control`` leaves, without bias; 1 where the control
    is constant."""
    if control.std() == 0:
        return 1.0
    correlation = float(np.corrcoef(f, control)[0, 1])
    return (1 - correlation**2) * (f.size - 1) / (f.size - 2)


def main() -> None:
    """Run the command."""
    extending.show(left())


if __name__ == "__main__":
    main()
