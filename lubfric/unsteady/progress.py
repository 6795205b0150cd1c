"""How far a run has come, and the state that a `Checkpoint` keeps of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..ehl.transient.bdf import Level, March
from ..rough.contract import ContactState
from .row import UNITS, moment
from .setup import Run
from .sharing import Contact


@dataclass
class Progress:
    """What grows while a run goes on."""

    march: March
    rows: list
    fields: list
    steps: int = 0
    rejected: int = 0
    worst: float = 0.0


def keep(run: Run, now: Progress, store, time, solution, advanced) -> None:
    """Add the output at ``time`` [s]: its row and its fields."""
    row = moment(
        run.sharing,
        time,
        run.sliding_speed(time),
        run.model.scene.bodies.boundary_friction_coefficient,
        solution,
        solution.payload,
        advanced,
        now.steps,
    )
    now.rows.append(np.array(list(row.values()), dtype=float))
    now.fields.append(np.concatenate([solution.terms.P, solution.terms.H]))
    if store:
        store.append(now.rows[-1], now.fields[-1])


def state_of(run: Run, now: Progress) -> dict:
    """All that `resume` needs, as plain numbers and arrays."""
    contact, closure = now.march.payload, now.march.payload.closure
    pressure = closure.pressure
    return {
        "outputs": len(now.rows),
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
                closure.mean_gap,
                closure.mean_film,
                closure.real_contact_area_fraction,
                closure.plastic_area_fraction,
            ]
        ),
        "contact_fraction": closure.contact_fraction,
        "contact_pressure": np.zeros((0, 0)) if pressure is None else pressure,
    }


def resume(run: Run, store) -> Progress | None:
    """The progress of an interrupted run, or None where there is none."""
    found = store.load() if store else None
    if found is None:
        return None
    state, rows, fields = found
    steps, rejected, worst, step = state["steps"]
    load, softness, gap, film, real, plastic = (float(v) for v in state["contact"])
    pressure = state["contact_pressure"]
    closure = ContactState(
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
    return Progress(
        March(levels, float(step), Contact(load, closure, softness)),
        list(rows),
        list(fields),
        int(steps),
        int(rejected),
        float(worst),
    )
