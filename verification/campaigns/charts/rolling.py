"""The chart of rolling contacts: error of f against time for load sharing, for a strip of moving roughness over a whole
pass, in tight steps as in version 0.2.0 and in economical ones, and for the default, with the control of its summits.

Load sharing is solved here. The others are the rows of the campaign ``moving_coverage``, with its reference. An error is
the root mean square over surfaces of other seeds; a time is that of one strip, without ranges of inputs.
"""

import time

import numpy as np

import lubfric

from .. import table_file
from ..moving_coverage.table import ANSWERS, FOLDER, REFERENCES, RollingContact, contacts, covered, with_seed
from .measure import point, quartiles

SEEDS = {True: (1,), False: (1, 2, 3)}
WAYS = {"strip": "whole pass, economical steps", "tight": "whole pass, tight steps (0.2.0)"}
MODELS = {"load-sharing": "load sharing, calibrated", "paper": "load sharing, Eqs. (8), (9)"}


def cases(*, quick: bool) -> dict[str, tuple[RollingContact, float, bool]]:
    """The contacts of the campaign that have a reference so far, with it."""
    known = {row["contact"]: row["reference"] for row in covered()}
    chosen = [contact for contact in contacts() if contact.name in known]
    return {contact.name: (contact, known[contact.name], quick) for contact in chosen}


def measured(case: tuple[RollingContact, float, bool]) -> list[dict]:
    """Return the points of one contact."""
    contact, truth, quick = case
    points = []

    def add(method: str, setting: str, f: list[float], seconds: list[float], *, default: bool = False) -> None:
        off = float(np.sqrt(np.mean([(value / truth - 1) ** 2 for value in f])))
        points.append(point(contact.name, method, setting, off, quartiles(seconds), apart=True, default=default))

    for model, name in MODELS.items():
        values = []
        seconds = []
        for seed in SEEDS[quick]:
            begun = time.process_time()
            values.append(lubfric.friction(with_seed(contact, seed), contact.speed, model=model).coefficient)
            seconds.append(time.process_time() - begun)
        add(name, "default tolerances", values, seconds)
    solved = [
        row for row in table_file.rows(FOLDER / REFERENCES) if row["contact"] == contact.name and not row["failure"]
    ]
    for kind, name in WAYS.items():
        strips = [row for row in solved if row["kind"] == kind]
        if strips:
            f = [float(row["plain"] or row["f"]) for row in strips]
            add(name, f"{len(strips)} surfaces", f, [float(row["seconds"]) for row in strips])
    answers = [
        row for row in table_file.rows(FOLDER / ANSWERS) if row["contact"] == contact.name and not row["failure"]
    ]
    f = [float(row["f"]) for row in answers]
    add("default", f"{len(answers)} surfaces", f, [float(row["seconds"]) for row in answers], default=True)
    return points
