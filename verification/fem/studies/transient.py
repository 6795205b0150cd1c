"""The smooth contact in time: exact squeeze, a table, stops and reversals, jumps of every size."""

import itertools
import math
from collections.abc import Iterator
from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from lubfric import ConvergenceError
from lubfric.film import FilmProblem, solve_ehl
from lubfric.oil import Lubricant
from lubfric.scene import Constant, Harmonic, Ramp
from lubfric.scene import Table as History
from lubfric.time import (
    LineHistory,
    Memory,
    Progress,
    advance,
    make_fixed_grid,
    make_setting,
    solve_transient_ehl,
    symmetric_nodes,
)
from lubfric.time.film_setting import Setting

from ...check import AT_LEAST, Check, Item, Table, bound, compared
from ...types import Keywords, PlainRow, TableRow
from ..convergence import Series, convergence
from ..parts import E_PRIME, RADIUS, VISCOSITY, case_of, line_contact, the

SQUEEZE: Keywords = dict(
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
COARSE: Keywords = {"tolerance": 3e-3, "time_tolerance": 1e-4}
FIRST_STEPS = (1e-6, 1e-5, 1e-4, 1e-3, 1e-2)
HEAVIEST = 100.0  # M up to which every jump is solved; beyond, the table shows what failed
MATRIX = {
    "quick": ((0.1, 2), (10, 5)),
    "default": ((0.01, 1), (0.1, 2), (1, 5), (10, 5), (100, 10)),
    "full": ((0.01, 1), (0.1, 2), (1, 5), (10, 5), (20, 5), (100, 10), (500, 10)),
}


def transient(level: str) -> Iterator[Item]:
    """The squeeze term of Eq. (6), taken through time by BDF2, where something independent is known.

    A rigid cylinder that sinks into oil has a closed form. A contact whose speed is halved at once is compared, time by
    time, with a table from a separate solver, by both methods of `lubfric`. A contact that is stopped or reversed is
    left with squeeze alone. Last, speed and load jump tenfold up and down, with first steps over four decades. Every
    run must end at the steady state, or be reported as failed.
    """
    yield from squeeze(128 if level == "quick" else 256)
    yield from halved()
    yield from stopped()
    yield from reversal()
    yield from jumps(level)


def contact(M: float, L: float, density: str = "constant") -> tuple[PlainRow, FilmProblem, float]:
    """Return keywords, `FilmProblem` and time b/U (at least 3 film lengths) of a contact with these Moes numbers."""
    keywords = case_of(M, L, density=density)
    problem = FilmProblem(line_contact(keywords))
    return keywords, problem, max(problem.half_width, 3.0) * problem.length_unit / keywords["entrainment_speed"]


def step_history(value: float, factor: float) -> History:
    """Return a value that jumps by ``factor`` at once."""
    return History(times=(0.0, 0.0, 1e3), values=(value, factor * value, factor * value))


def squeeze(most: int) -> Iterator[Item]:
    """The exact law, and the orders in time and space, with up to ``most`` equal steps."""
    times = np.linspace(0, LONG, 21)
    history = solve_transient_ehl(**SQUEEZE, times=times, tolerance=1e-3, time_tolerance=1e-6)
    error = np.max(np.abs(history.min_film / (1e-6**-0.5 + RATE * times) ** -2 - 1))
    yield bound("rigid squeeze to a ninth of the film: largest error", error, 1e-3, LAW)
    counts = np.array([n for n in (16, 32, 64, 128, 256) if n <= most])
    films = [marched(0.5, n) for n in (*counts, 8 * most)]
    in_time = np.abs(np.array(films[:-1]) / films[-1] - 1)
    resolutions = (0.25, 0.5, 1.0, 2.0)
    in_space = np.abs([one_step(r) for r in resolutions])
    cells = np.array([setting(r).grid.n for r in resolutions])
    equal = "BDF2 at equal steps"
    series = [
        Series(
            "film, time step",
            1 / counts,
            errors=in_time,
            order=2,
            check="order in time",
            tolerance=0.2,
            source=equal,
            kind=AT_LEAST,
            finest=3,
        ),
        Series(
            "sinking speed, cells",
            1 / cells,
            errors=in_space,
            order=2,
            check="order in space",
            tolerance=0.3,
            source=LAW,
            kind=AT_LEAST,
            finest=3,
        ),
    ]
    caption = "Rigid squeeze: relative error of the film at the end against step (of the finest steps), of the sinking "
    caption += "speed against cells (of the exact law)."
    yield from convergence("squeeze_orders", caption, series, "1/number of steps or cells", "relative error")


def setting(resolution: float) -> Setting:
    """Return the rigid squeeze on a grid of a given resolution."""
    oil, load, radius, still, viscosity = (
        Lubricant(0.1, 0.0, viscosity_law="constant"),
        *map(Constant, (100.0, 0.01, 0.0, 0.1)),
    )
    made = make_setting(
        LineHistory(
            load=load,
            radius=radius,
            e_prime=2.2e17,
            speed=still,
            viscosity=viscosity,
            lubricant=oil,
            duration=LONG,
            initial_film=1e-6,
        ),
        3e-3,
    )
    edge = made.problem.half_width
    return replace(made, grid=make_fixed_grid(symmetric_nodes(resolution, (edge, edge), (0.1, 1.0))))


def marched(resolution: float, steps: int) -> float:
    """Return film after 0.3 of the squeeze in equal steps, in units of the film at the start."""
    made = setting(resolution)
    first = made.undeformed(1e-6)
    now = Progress(last_steps=(first,), next_step=LONG)
    system = SimpleNamespace(solve=made.solve, error_of=lambda solution, difference: 0.0)
    for k in range(steps):
        result = advance(replace(now, next_step=LONG), 0.3 * LONG * (k + 1) / steps, system, 1.0, 0.0)
        now = the(result, "step in time")
    return float(now.last_steps[-1].film.min())


def one_step(resolution: float) -> float:
    """Return relative error of the sinking speed in one backward Euler step: the law holds with the film at its end."""
    made = setting(resolution)
    step = 1e-2 * LONG
    first = made.undeformed(1e-6)
    h = made.solve(step, Memory(1 / step, first.film), first.z).terms.H.min() * made.problem.film_unit
    return float((1e-6 - h) / step / (2 * h**1.5 * RATE) - 1)


def halved() -> Iterator[Item]:
    """The speed halved at once at M = 20, L = 5."""
    keywords, problem, unit = contact(20, 5, "dowson-higginson")
    keywords["entrainment_speed"] = step_history(keywords["entrainment_speed"], 0.5)
    times = unit * np.array([row[0] for row in HALVED])
    rows = []
    source = "separate solver on nested meshes, X in [-4, 1.5]"
    history = solve_transient_ehl(**keywords, times=times)
    for i, (time, centre, smallest) in enumerate(HALVED):
        films = history.central_film[i] / problem.film_unit, history.min_film[i] / problem.film_unit
        rows.append((time, *films, centre, smallest))
        expected = (f"H(0) at T = {time:g}", centre), (f"H_min at T = {time:g}", smallest)
        checks = [(name, "1", value, wanted, 0.01) for value, (name, wanted) in zip(films, expected)]
        yield from compared("speed halved", checks, source)
    caption = "Speed halved at T = 0 (M = 20, L = 5, Dowson-Higginson density), films in units of the start."
    yield Table("halved", caption, ("T = U₀t/b", "H(0)", "H_min", "table H(0)", "table H_min"), rows)


def stopped() -> Iterator[Item]:
    """A contact brought to a stop. Light loads follow the squeeze law, and heavy ones trap their film."""
    keywords, _, unit = contact(0.05, 1)
    keywords |= {"viscosity_law": "constant", "pressure_viscosity_coefficient": 0.0, "e_prime": 1e4 * E_PRIME}
    keywords["entrainment_speed"] = step_history(keywords["entrainment_speed"], 0.0)
    history = solve_transient_ehl(**keywords, times=unit * np.linspace(0, 40, 41), time_tolerance=1e-6)
    exact = keywords["load_per_width"] / (6 * math.sqrt(2) * math.pi * VISCOSITY * RADIUS**1.5)
    slope = (history.min_film[-1] ** -0.5 - history.min_film[20] ** -0.5) / (history.time[-1] - history.time[20])
    yield Check("light contact stopped: rate of h^-1/2", slope, expected=exact, tolerance=3e-3, source=LAW)
    keywords, _, unit = contact(20, 5)
    keywords["entrainment_speed"] = step_history(keywords["entrainment_speed"], 0.0)
    history = solve_transient_ehl(**keywords, times=unit * np.geomspace(1e-2, 1e3, 41), **COARSE)
    centre = history.central_film / history.central_film[0]
    name = "heavy contact stopped: film left in the centre after 10 transits"
    source = "viscous entrapment: the film at the edge closes first and seals the centre (M = 20, L = 5, 0.4 GPa)"
    yield Check(
        name, np.interp(10 * unit, history.time, centre), expected=0.8, tolerance=0.0, source=source, kind=AT_LEAST
    )


def reversal() -> Iterator[Item]:
    """Speed through zero and back."""
    keywords, problem, unit = contact(5, 5)
    period = 20 * unit
    largest = keywords["entrainment_speed"]
    keywords["entrainment_speed"] = Harmonic(amplitude=largest, frequency=1 / period, phase=math.pi / 2)
    history = solve_transient_ehl(**keywords, times=period * np.linspace(0, 2.5, 201), **COARSE)
    change = np.max(np.abs(history.min_film[161:201] / history.min_film[81:121] - 1))
    yield bound("reversal: third cycle against the second", change, 5e-3, "a periodic run becomes periodic")
    wet = np.min(history.pressure[20] > 0)
    source = "pure squeeze has no cavity"
    yield Check(
        "no entrainment: film pressurised on both sides", wet, expected=1.0, tolerance=0.0, source=source, kind=AT_LEAST
    )


def jumps(level: str) -> Iterator[Item]:
    """Tenfold jumps, with first steps over four decades: the steady state, or a reported failure."""
    rows: list[TableRow] = []
    wrong = 0
    failed = 0
    for (M, L), name, factor in itertools.product(MATRIX[level], ("entrainment_speed", "load_per_width"), (0.1, 10.0)):
        loaded = name == "load_per_width"
        if loaded and factor > 1 and M >= 10:
            continue  # thousands of steps: a flat punch on a frozen film; raised over two transits below
        keywords, _, unit = contact(M, L)
        wait = (60.0 if loaded or factor < 1 else 20.0) * unit
        changed = keywords | {name: step_history(keywords[name], factor)}
        try:
            history = solve_transient_ehl(**changed, times=[wait], tolerance=5e-3, time_tolerance=3e-4)
        except ConvergenceError as error:
            failed += M <= HEAVIEST
            rows.append((M, L, f"{name} x {factor:g}", error.report.iterations, "reported failure", ""))
            continue
        steady = solve_ehl(**keywords | {name: factor * keywords[name]}, tolerance=3e-3)
        ratio = float(history.min_film[0] / steady.min_film)
        wrong += abs(ratio - 1) > 0.03 and M >= 1  # lighter contacts take longer to fill or drain
        rows.append((M, L, f"{name} x {factor:g}", history.report.iterations, "converged", ratio))
    caption = "Jumps at t = 0; smallest film after 20 to 60 transits over that of the steady solver (lighter "
    caption += "contacts, M < 1, have not converged yet)."
    yield Table("jumps", caption, ("M", "L", "jump", "steps", "outcome", "film/steady"), rows)
    name = "jumps that ended silently away from the steady state (M >= 1)"
    yield bound(name, wrong, 0.0, "lubfric.solve_ehl")
    yield bound(f"jumps reported as failed (M <= {HEAVIEST:g})", failed, 0.0, "all of these should be solved")
    yield from steps_and_ramp()


def steps_and_ramp() -> Iterator[Item]:
    """The first step makes no difference, and a load that rises over two transits ends in its steady film."""
    keywords, _, unit = contact(10, 5)
    slower = keywords | {"entrainment_speed": step_history(keywords["entrainment_speed"], 0.5)}
    films = [
        solve_transient_ehl(**slower, times=[2 * unit], tolerance=3e-3, first_step=step * unit).min_film[0]
        for step in FIRST_STEPS
    ]
    source = "the error control makes the first step irrelevant"
    yield bound("first steps over four decades: spread of the film", np.ptp(films) / films[0], 1e-3, source)
    load = keywords["load_per_width"]
    raised = keywords | {"load_per_width": Ramp(start=load, end=10 * load, until=2 * unit)}
    history = solve_transient_ehl(**raised, times=[60 * unit], tolerance=5e-3, time_tolerance=3e-4)
    steady = solve_ehl(**keywords | {"load_per_width": 10 * load}, tolerance=1e-3)
    rows = [("film", "m", history.min_film[0], steady.min_film, 0.01)]
    yield from compared("load raised tenfold over two transits at M = 10", rows, "lubfric.solve_ehl")
