"""The smooth contact in time: exact squeeze, a table, stops and reversals, jumps of every size."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np

from lubfric import ConvergenceError
from lubfric.film import LineContact, Problem, solve_ehl
from lubfric.oil import Lubricant
from lubfric.paper import solve_differential_transient
from lubfric.scene import Constant, Harmonic, Ramp
from lubfric.scene import Table as History
from lubfric.time import (
    ContactHistory,
    Level,
    Memory,
    Progress,
    advance,
    make_fixed_grid,
    make_setting,
    solve_transient_ehl,
    symmetric_nodes,
)

from .. import plotting
from ..check import AT_LEAST, AT_MOST, Check, Table
from ..parts import the
from ..rates import fitted_order

SQUEEZE: dict[str, Any] = dict(
    load_per_width=100.0,
    radius=0.01,
    e_prime=2.2e17,
    entrainment_speed=0.0,
    viscosity=0.1,
    viscosity_law="constant",
    initial_film=1e-6,
)
RATE = 100.0 / (6 * math.sqrt(2) * math.pi * 0.1 * 0.01**1.5)
LONG = 2 / (math.sqrt(1e-6) * RATE)
LAW = "rigid cylinder, pure normal squeeze: h^-1/2 grows by w t/(6 sqrt(2) pi eta R^1.5)"
HALVED = (
    (0, 3.081, 2.567),
    (0.5, 3.079, 2.301),
    (1, 3.076, 2.119),
    (2, 2.490, 1.982),
    (3, 1.963, 1.939),
    (5, 1.914, 1.621),
)
FIRST_STEPS = (1e-6, 1e-5, 1e-4, 1e-3, 1e-2)
HEAVIEST = 100.0  # M up to which every jump is solved; beyond, the table shows what failed
MATRIX = {
    "quick": ((0.1, 2), (10, 5)),
    "default": ((0.01, 1), (0.1, 2), (1, 5), (10, 5), (100, 10)),
    "full": ((0.01, 1), (0.1, 2), (1, 5), (10, 5), (20, 5), (100, 10), (500, 10)),
}


def transient(level: str):
    """The squeeze term of Eq. (6), taken through time by BDF2, where something independent is known.

    A rigid cylinder that sinks into oil has a closed form. A contact whose speed is halved at once is compared, time by
    time, with a table from a separate solver, by both methods of `lubfric`. A contact that is stopped or reversed is
    left with squeeze alone. Last, speed and load jump tenfold up and down, with first steps over four decades. Every
    run must end at the steady state, or be reported as failed.
    """
    yield from squeeze(level)
    yield from halved()
    yield from stopped()
    yield from reversal()
    yield from jumps(level)


def contact(M: float, L: float, density: str = "constant"):
    """Keywords, `Problem` and time b/U (at least 3 film lengths) of a contact with these Moes numbers."""
    e, r, alpha, eta = 2.2e11, 0.01, 2.2e-8, 0.0358
    number = (L / (alpha * e)) ** 4
    speed = number * e * r / (2 * eta)
    oil = Lubricant(eta, alpha, "roelands", density)
    problem = Problem(LineContact(M * e * r * math.sqrt(number), r, e, speed, oil))
    keywords: dict[str, Any] = dict(
        load_per_width=problem.contact.load_per_width,
        radius=r,
        e_prime=e,
        entrainment_speed=speed,
        viscosity=eta,
        pressure_viscosity_coefficient=alpha,
        density_law=density,
    )
    return keywords, problem, max(problem.half_width, 3.0) * problem.length_unit / speed


def step_history(value: float, factor: float, at: float = 0.0) -> History:
    """A value that jumps by ``factor``."""
    before = () if at == 0.0 else (0.0,)
    return History(times=(*before, at, at, 1e3), values=(value,) * (len(before) + 1) + (factor * value,) * 2)


def squeeze(level: str):
    """The exact law, and the orders in time and space."""
    times = np.linspace(0, LONG, 21)
    found = solve_transient_ehl(**SQUEEZE, times=times, tolerance=1e-3, time_tolerance=1e-6)
    error = np.max(np.abs(found.min_film / (1e-6**-0.5 + RATE * times) ** -2 - 1))
    yield Check("rigid squeeze to a ninth of the film: largest error", error, 0.0, 1e-3, LAW, AT_MOST)
    counts = (16, 32, 64, 128, 256)
    films = [marched(0.5, n) for n in (*counts, 2048)]
    in_time = np.abs(np.array(films[:-1]) / films[-1] - 1)
    yield Check(
        "order in time",
        fitted_order(1 / np.array(counts[-3:]), in_time[-3:]),
        2,
        0.2,
        "BDF2 at equal steps",
        AT_LEAST,
    )
    resolutions = (0.25, 0.5, 1.0, 2.0)
    in_space = np.abs([one_step(r) for r in resolutions])
    cells = [setting(r).grid.n for r in resolutions]
    yield Check("order in space", fitted_order(1 / np.array(cells[-3:]), in_space[-3:]), 2, 0.3, LAW, AT_LEAST)
    yield plotting.convergence(
        "squeeze_orders",
        "Rigid squeeze: relative error of the film at the end against step (of "
        "the finest steps), of the sinking speed against cells (of the exact law).",
        {
            "film, time step": (1 / np.array(counts), in_time, 2),
            "sinking speed, cells": (1 / np.array(cells), in_space, 2),
        },
        "1/number of steps or cells",
        "relative error",
    )


def setting(resolution: float):
    """The rigid squeeze on a grid of a given resolution."""
    line = ContactHistory(
        Constant(100.0),
        Constant(0.01),
        2.2e17,
        Constant(0.0),
        Constant(0.1),
        Lubricant(0.1, 0.0, "constant"),
        LONG,
        1e-6,
    )
    made = make_setting(line, 3e-3)
    edge = made.problem.half_width
    return replace(made, grid=make_fixed_grid(symmetric_nodes(resolution, (edge, edge), (0.1, 1.0))))


def marched(resolution: float, steps: int) -> float:
    """Film after 0.3 of the squeeze in equal steps, in units of the film at the start."""
    made = setting(resolution)
    first = made.undeformed(1e-6)
    now = Progress((Level(0.0, first.film, first.z),), LONG)
    for k in range(steps):
        found = advance(
            replace(now, step=LONG),
            0.3 * LONG * (k + 1) / steps,
            SimpleNamespace(solve=made.solve, error_of=lambda solution, difference: 0.0),
            1.0,
            0.0,
        )
        now = the(found, "step in time")
    return float(now.levels[-1].film.min())


def one_step(resolution: float) -> float:
    """Relative error of the sinking speed in one backward Euler step, in which the law holds with the film
    at its end."""
    made, step = setting(resolution), 1e-2 * LONG
    first = made.undeformed(1e-6)
    h = made.solve(step, Memory(1 / step, first.film), first.z).terms.H.min() * made.problem.film_unit
    return float((1e-6 - h) / step / (2 * h**1.5 * RATE) - 1)


def halved():
    """The speed halved at once at M = 20, L = 5, by both methods."""
    keywords, problem, unit = contact(20, 5, "dowson-higginson")
    b = problem.half_width * problem.length_unit
    keywords["entrainment_speed"] = step_history(keywords["entrainment_speed"], 0.5)
    times = unit * np.array([row[0] for row in HALVED])
    rows, source = [], "separate solver on nested meshes, X in [-4, 1.5]"
    runs = {
        "complementarity": solve_transient_ehl(**keywords, times=times),
        "differential deflection": solve_differential_transient(**keywords, times=times, domain=(-4 * b, 1.5 * b)),
    }
    for method, found in runs.items():
        for i, (time, centre, smallest) in enumerate(HALVED):
            values = found.central_film[i] / problem.film_unit, found.min_film[i] / problem.film_unit
            rows.append((method, time, *values, centre, smallest))
            for name, value, expected in zip(("H(0)", "H_min"), values, (centre, smallest), strict=True):
                yield Check(f"speed halved, {method}: {name} at T = {time:g}", value, expected, 0.01, source)
    yield Table(
        "halved",
        "Speed halved at T = 0 (M = 20, L = 5, Dowson-Higginson density), films in units of the start.",
        ("method", "T = U₀t/b", "H(0)", "H_min", "table H(0)", "table H_min"),
        tuple(rows),
    )
    found, canvas_axes = runs["complementarity"], plotting.axes(height=3.6)
    canvas, ax = canvas_axes
    for i, (time, *_) in enumerate(HALVED):
        ax.plot(found.x / b, found.film_thickness[i] / problem.film_unit, label=f"T = {time:g}")
    ax.set(xlim=(-2, 1.4), ylim=(1, 5), xlabel="x/b", ylabel="H (units of the start)")
    ax.legend(ncols=2)
    yield plotting.finish(
        "halved_films",
        canvas,
        "The thinner film made by the slower inlet travels through the contact at the speed of the surfaces.",
    )


def stopped():
    """A contact brought to a stop. Light loads follow the squeeze law, and heavy ones trap their film."""
    canvas, (left, right) = plotting.axes(1, 2, width=8.0, height=3.4)
    keywords, problem, unit = contact(0.05, 1)
    keywords |= {
        "viscosity_law": "constant",
        "pressure_viscosity_coefficient": 0.0,
        "e_prime": 1e4 * keywords["e_prime"],
        "entrainment_speed": step_history(keywords["entrainment_speed"], 0.0),
    }
    found = solve_transient_ehl(**keywords, times=unit * np.linspace(0, 40, 41), time_tolerance=1e-6)
    exact = keywords["load_per_width"] / (6 * math.sqrt(2) * math.pi * keywords["viscosity"] * 0.01**1.5)
    slope = (found.min_film[-1] ** -0.5 - found.min_film[20] ** -0.5) / (found.time[-1] - found.time[20])
    yield Check("light contact stopped: rate of h^-1/2", slope, exact, 3e-3, LAW)
    left.plot(found.time / unit, (found.min_film / found.min_film[0]) ** -0.5, label="computed")
    left.plot(found.time / unit, 1 + exact * found.time * found.min_film[0] ** 0.5, ":", label="law from the start")
    left.set(xlabel="time/(transit)", ylabel="(h/h₀)^-1/2", title="M = 0.05, rigid")
    left.legend()
    keywords, problem, unit = contact(20, 5)
    keywords["entrainment_speed"] = step_history(keywords["entrainment_speed"], 0.0)
    found = solve_transient_ehl(
        **keywords, times=unit * np.geomspace(1e-2, 1e3, 41), tolerance=3e-3, time_tolerance=1e-4
    )
    yield Check(
        "heavy contact stopped: film left in the centre after 10 transits",
        np.interp(10 * unit, found.time, found.central_film) / found.central_film[0],
        0.8,
        0.0,
        "viscous entrapment: the film at the edge closes first and seals the centre (M = 20, L = 5, 0.4 GPa)",
        AT_LEAST,
    )
    left_over = found.central_film / found.central_film[0], found.min_film / found.min_film[0]
    right.semilogx(found.time / unit, left_over[0], label="centre")
    right.semilogx(found.time / unit, left_over[1], label="smallest")
    right.set(xlabel="time/(transit)", ylabel="film/film at the start", title="M = 20, L = 5", ylim=(0, 1.1))
    right.legend()
    yield plotting.finish(
        "stopped",
        canvas,
        "Entrainment stopped at once. Left: a light contact follows the rigid law as soon as "
        "its cavity has gone. Right: in a heavy one the edges close first and seal a pocket.",
    )


def reversal():
    """Speed through zero and back."""
    keywords, problem, unit = contact(5, 5)
    period = 20 * unit
    keywords["entrainment_speed"] = Harmonic(
        amplitude=keywords["entrainment_speed"], frequency=1 / period, phase=math.pi / 2
    )
    found = solve_transient_ehl(
        **keywords, times=period * np.linspace(0, 2.5, 201), tolerance=3e-3, time_tolerance=1e-4
    )
    first, second = found.min_film[81:121], found.min_film[161:201]
    yield Check(
        "reversal: third cycle against the second",
        np.max(np.abs(second / first - 1)),
        0.0,
        5e-3,
        "a periodic run becomes periodic",
        AT_MOST,
    )
    wet = (found.pressure > 0) * 1.0
    yield Check(
        "no entrainment: film pressurised on both sides",
        wet[20].min(),
        1.0,
        0.0,
        "pure squeeze has no cavity",
        AT_LEAST,
    )
    canvas, ax = plotting.axes(height=3.6)
    ax.plot(found.time / period, found.central_film / problem.film_unit, label="H(0)")
    ax.plot(found.time / period, found.min_film / problem.film_unit, label="H_min")
    ax.plot(found.time / period, np.abs(np.cos(2 * np.pi * found.time / period)), ":", label="|U|/U_max")
    ax.set(xlabel="cycles", ylabel="film (units of the largest speed)", ylim=(0, None))
    ax.legend()
    yield plotting.finish(
        "reversal",
        canvas,
        "Reciprocating at M = 5, L = 5. At U = 0 squeeze keeps part of the film; the smallest "
        "film follows the reversal by the time the thin film takes to cross the contact.",
    )


def jumps(level: str):
    """Tenfold jumps, with first steps over four decades: the steady state, or a reported failure."""
    rows: list[tuple] = []
    wrong = failed = 0
    cases = [
        ("entrainment_speed", 0.1),
        ("entrainment_speed", 10.0),
        ("load_per_width", 0.1),
        ("load_per_width", 10.0),
    ]
    for M, L in MATRIX[level]:
        keywords, _, unit = contact(M, L)
        for name, factor in cases:
            if name == "load_per_width" and factor > 1 and M >= 10:
                continue  # thousands of steps: a flat punch on a frozen film; raised over two transits below
            value = keywords[name]
            wait = 60.0 if name == "load_per_width" or factor < 1 else 20.0
            try:
                found = solve_transient_ehl(
                    **keywords | {name: step_history(value, factor)},
                    times=[wait * unit],
                    tolerance=5e-3,
                    time_tolerance=3e-4,
                )
            except ConvergenceError as error:
                failed += M <= HEAVIEST
                rows.append((M, L, f"{name} x {factor:g}", error.report.iterations, "reported failure", ""))
                continue
            steady = solve_ehl(**keywords | {name: factor * value}, tolerance=3e-3)
            ratio = found.min_film[0] / steady.min_film
            wrong += abs(ratio - 1) > 0.03 and M >= 1  # lighter contacts take longer to fill or drain
            rows.append((M, L, f"{name} x {factor:g}", found.report.iterations, "converged", float(ratio)))
    yield Table(
        "jumps",
        "Jumps at t = 0; smallest film after 20 to 60 transits over that of the steady solver (lighter "
        "contacts, M < 1, are still on their way).",
        ("M", "L", "jump", "steps", "outcome", "film/steady"),
        tuple(rows),
    )
    yield Check(
        "jumps that ended silently away from the steady state (M >= 1)",
        wrong,
        0,
        0.0,
        "lubfric.solve_ehl",
        AT_MOST,
    )
    yield Check(
        f"jumps reported as failed (M <= {HEAVIEST:g})", failed, 0, 0.0, "all of these should be solved", AT_MOST
    )
    keywords, _, unit = contact(10, 5)
    keywords["entrainment_speed"] = step_history(keywords["entrainment_speed"], 0.5)
    films = [
        solve_transient_ehl(**keywords, times=[2 * unit], tolerance=3e-3, first_step=f * unit).min_film[0]
        for f in FIRST_STEPS
    ]
    yield Check(
        "first steps over four decades: spread of the film",
        np.ptp(films) / films[0],
        0.0,
        1e-3,
        "the error control makes the first step irrelevant",
        AT_MOST,
    )
    ramp = Ramp(start=keywords["load_per_width"], end=10 * keywords["load_per_width"], until=2 * unit)
    heavy = contact(10, 5)[0]
    found = solve_transient_ehl(
        **heavy | {"load_per_width": ramp}, times=[60 * unit], tolerance=5e-3, time_tolerance=3e-4
    )
    steady = solve_ehl(**heavy | {"load_per_width": 10 * heavy["load_per_width"]}, tolerance=1e-3)
    yield Check(
        "load raised tenfold over two transits at M = 10: film",
        found.min_film[0],
        steady.min_film,
        0.01,
        "lubfric.solve_ehl",
        unit="m",
    )
