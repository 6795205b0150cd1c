"""The outputs of a run so far, and the state that a `Checkpoint` keeps of it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ..ehl.transient.active_set import StepSolution
from ..march.bdf import Progress
from .moment import moment
from .sharing import Sharing


@dataclass
class Outputs:
    """One row of numbers and one of fields (pressures and films) for each output time."""

    rows: list[np.ndarray] = field(default_factory=list)
    fields: list[np.ndarray] = field(default_factory=list)


def keep(sharing: Sharing, outputs: Outputs, store, now: Progress, solution: StepSolution) -> None:
    """Add the output at the time of ``now``: its row and its fields."""
    sharing.prepared.contact.check(solution.payload.state)
    row = moment(sharing, solution, now)
    outputs.rows.append(np.array(list(row.values()), dtype=float))
    outputs.fields.append(np.concatenate([solution.terms.P, solution.terms.H]))
    if store:
        store.append(outputs.rows[-1], outputs.fields[-1])


def state_of(now: Progress) -> Progress:
    """All that a resume needs: ``now``, without what the next step makes again."""
    contact = now.payload
    bare = replace(contact, state=replace(contact.state, fields=None, y=None))
    return replace(now, payload=bare, solution=None)


def resume(store) -> tuple[Progress, Outputs] | None:
    """Progress and outputs of an interrupted run, or None where there is none."""
    found = store.load() if store else None
    if found is None:
        return None
    now, rows, fields = found
    return now, Outputs(rows, fields)
