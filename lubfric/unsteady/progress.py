"""The outputs of a run so far, and the state that a `Checkpoint` keeps of it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..march.bdf import Level, March
from ..march.course import Progress
from ..rough.contract import ContactState
from .moment import UNITS, moment
from .setup import Run
from .sharing import Contact


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


def state_of(run: Run, outputs: Outputs, now: Progress) -> dict:
    """All that `resume` needs, as plain numbers and arrays."""
    contact, state = now.march.payload, now.march.payload.state
    pressure = state.pressure
    return {
        "outputs": len(outputs.rows),
        "row_size": len(UNITS),
        "field_size": 2 * (run.sharing.setting.grid.n + 1),
        "steps": np.array([now.steps, now.rejected, now.worst, now.march.step]),
        "level_times": np.array([level.time for level in now.march.levels]),
        "level_films": np.array([level.film for level in now.march.levels]),
        "level_z": np.array([level.z for level in now.march.levels]),
        "contact": np.array(
            [
                contact.load,
                contact.softness,
                state.mean_gap,
                state.mean_film,
                state.real_contact_area_fraction,
                state.plastic_area_fraction,
            ]
        ),
        "contact_fraction": state.contact_fraction,
        "contact_pressure": np.zeros((0, 0)) if pressure is None else pressure,
    }


def resume(run: Run, store) -> tuple[Progress, Outputs] | None:
    """Progress and outputs of an interrupted run, or None where there is none."""
    found = store.load() if store else None
    if found is None:
        return None
    state, rows, fields = found
    steps, rejected, worst, step = state["steps"]
    load, softness, gap, film, real, plastic = (float(v) for v in state["contact"])
    pressure = state["contact_pressure"]
    contact = ContactState(
        gap,
        film,
        run.sharing.patch.x,
        state["contact_fraction"],
        real,
        plastic,
        pressure=pressure if pressure.size else None,
    )
    levels = tuple(
        Level(float(t), y, z) for t, y, z in zip(state["level_times"], state["level_films"], state["level_z"])
    )
    march = March(levels, float(step), Contact(load, contact, softness))
    return Progress(march, int(steps), int(rejected), float(worst)), Outputs(list(rows), list(fields))
