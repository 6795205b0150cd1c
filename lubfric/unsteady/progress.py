"""The outputs of a run so far, and the state that a `Checkpoint` keeps of it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ..march.course import Progress
from .moment import moment
from .setup import Run


@dataclass
class Outputs:
    """One row of numbers and one of fields (pressures and films) for each output time."""

    rows: list[np.ndarray] = field(default_factory=list)
    fields: list[np.ndarray] = field(default_factory=list)


def keep(run: Run, outputs: Outputs, store, now: Progress, solution) -> None:
    """Add the output at the time of ``now``: its row and its fields."""
    in_time = run.in_time
    run.sharing.patch.check(solution.payload.state)
    row = moment(run.sharing, in_time.at(now.time), in_time.sliding(now.time), solution, now)
    outputs.rows.append(np.array(list(row.values()), dtype=float))
    outputs.fields.append(np.concatenate([solution.terms.P, solution.terms.H]))
    if store:
        store.append(outputs.rows[-1], outputs.fields[-1])


def state_of(now: Progress) -> Progress:
    """All that a resume needs: ``now``, without what the next step makes again."""
    contact = now.march.payload
    bare = replace(contact, state=replace(contact.state, fields=None, y=None))
    return replace(now, march=replace(now.march, payload=bare), solution=None)


def resume(store) -> tuple[Progress, Outputs] | None:
    """Progress and outputs of an interrupted run, or None where there is none."""
    found = store.load() if store else None
    if found is None:
        return None
    now, rows, fields = found
    return now, Outputs(list(rows), list(fields))
