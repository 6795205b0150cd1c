"""The chart of rolling contacts: error of f against time of one point, by version 0.2.0, by the default of today, by a
strip of moving roughness over a whole pass, by the quick model, and by load sharing.

The quick model and load sharing are solved here. The default and the whole pass are the rows of the campaign
``moving_coverage``, with its reference, which has cells half as long. The answers of version 0.2.0 (commit 28b80684,
`BEFORE`) were solved by `levels_of` of that version on the same scenes with ``numerics.model = "deterministic"``. An
error is the root mean square over surfaces of other seeds; a time is that of one answer, without ranges of inputs but
for the models solved here.
"""

import time
from pathlib import Path

import numpy as np

import lubfric

from ...types import PlainRow
from .. import table_file
from ..moving_coverage.contacts import RollingContact, contacts
from ..moving_coverage.table import ANSWERS, FOLDER, REFERENCES, coefficient_of, judged_answers, with_seed
from .measure import point, quartiles

SEEDS = {True: (1,), False: (1, 2, 3)}
BEFORE = Path(__file__).with_name("version_0_2_0.csv")
MODELS = {"quick": "quick model", "paper": 'load sharing ("paper")'}


def cases(*, quick: bool) -> dict[str, tuple[RollingContact, float, bool]]:
    """Return the contacts of the campaign that have a reference so far, with it."""
    known = {answer.contact.name: answer.reference.coefficient for answer in judged_answers()}
    chosen = [contact for contact in contacts() if contact.name in known]
    return {contact.name: (contact, known[contact.name], quick) for contact in chosen}


def measured(case: tuple[RollingContact, float, bool]) -> list[PlainRow]:
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
    rows = _rows_of(FOLDER / REFERENCES, contact)
    strips = [row for row in rows if row["kind"] == "strip"]
    f = [float(row["plain"] or row["f"]) for row in strips]
    add("whole pass of one strip", f"{len(strips)} surfaces", f, [float(row["seconds"]) for row in strips])
    before = _rows_of(BEFORE, contact)
    if before:
        f = [float(row["f"]) for row in before]
        add("default of version 0.2.0", f"{len(f)} surfaces", f, [float(row["seconds"]) for row in before])
    answers = _rows_of(FOLDER / ANSWERS, contact)
    f = [coefficient_of(row) for row in answers]
    add("default", f"{len(answers)} surfaces", f, [float(row["seconds"]) for row in answers], default=True)
    return points


def _rows_of(file: Path, contact: RollingContact) -> list[dict[str, str]]:
    """Return the rows of ``contact`` in a table, without those that have no answer."""
    return [row for row in table_file.rows(file) if row["contact"] == contact.name and not row["failure"]]
