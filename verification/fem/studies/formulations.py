"""The contact formulations of the paper against the load-controlled default: agreement, work, time."""

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

import lubfric
from lubfric.contact import ContactResult, half_space
from lubfric.contact.solve import solve_contact
from lubfric.paper import alternating, single_loop

from ...campaigns.charts.measure import interleaved
from ...check import AT_MOST, Check, Item, Table
from ...types import Keywords, TableRow

E_PRIME = 231e9  # Pa, E' of the paper's cylinder
RADIUS = 2e-3  # m, of the paper's cylinder, and of the ball
SPACING = 1e-6  # m, of the cells
SQ = 1e-7  # m
BOUNDARIES = {"flat": ("periodic", "periodic"), "cylinder": ("free", "periodic"), "ball": ("free", "free")}
COUNTS = {"quick": 64, "default": 128, "full": 256}
HARDNESS = 2e9  # Pa
TOLERANCE = 1e-6  # that every formulation is asked for
AGREEMENT = 1e-4  # rms difference of the pressures that is allowed, over their rms
PAPER = "Akchurin et al. 2015, Appendix 2 and Sec. 2.2, doi:10.1007/s11249-015-0536-z"
METHODS: dict[str, Callable[..., ContactResult]] = {
    "single loop": single_loop,
    "single loop, as printed": partial(single_loop, form="printed", max_iterations=1000),
    "single loop, stop on Eq. (23)": partial(single_loop, stop="separation"),
    "alternating, root": alternating,
    "alternating, repeated": partial(alternating, update="repeat"),
}
DIRECT = "load-controlled (default)"
MUST_AGREE = ("single loop", "alternating, root")
COLUMNS = ("case", "method", "status", "iterations", "convolutions", "residual", "relative L2 of pressure", "seconds")


class FormulationCase:
    """A rough contact that is solved at a given load. Its volume over the area A is then given instead."""

    def __init__(self, shape: str, hardness: float | None, count: int):
        self.name = f"{shape}, {'elastic' if hardness is None else 'plastic'}"
        roughness: Keywords = {"sq": SQ, "correlation_length": 6e-6, "acf": "gaussian", "seed": 3}
        z = lubfric.generate_surface((count, count), SPACING, **roughness).heights
        x = (np.arange(count) - (count - 1) / 2) * SPACING
        film, area, pressure = body(shape, x, count * SPACING / 6)
        operator = half_space(z.shape, SPACING, E_PRIME, BOUNDARIES[shape])
        self.load: Keywords = {"hardness": hardness, "boundary": BOUNDARIES[shape], "operator": operator}
        self.shape = film - z
        self.pressure = pressure
        self.direct = self.by_load()
        volume = np.sum(area * np.maximum(self.direct.gap, 0)) / area.sum()
        self.given = (z, film + volume - np.sum(area * film) / area.sum(), SPACING, E_PRIME)
        self.options: Keywords = self.load | {"weight": area, "tolerance": TOLERANCE, "raise_on_failure": False}

    def by_load(self) -> ContactResult:
        """Return the load-controlled default."""
        options: Keywords = {"mean_pressure": self.pressure, "tolerance": TOLERANCE}
        return solve_contact(self.shape, SPACING, E_PRIME, **options, **self.load)


def body(shape: str, x: np.ndarray, b: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Return undeformed shape [m], the area A (1 inside) and the mean pressure [Pa] with contact half-width or radius
    b."""
    if shape == "flat":
        return np.zeros((x.size, x.size)), np.ones((x.size, x.size)), 300e6
    if shape == "cylinder":
        square = np.repeat(x[:, None] ** 2, x.size, axis=1)
        pressure = b**2 * np.pi * E_PRIME / (8 * RADIUS * x.size * SPACING)
    else:
        square = x[:, None] ** 2 + x**2
        pressure = 2 / 3 * b**3 * E_PRIME / RADIUS / (x.size * SPACING) ** 2
    return square / (2 * RADIUS), (square <= b**2) * 1.0, pressure


def formulations(level: str) -> Iterator[Item]:
    """Solve contacts for a given load, and by the paper's methods for the volume that this solution holds.

    There are three boundary conditions, elastic and with a plastic limit, cold starts, and a tolerance of 1e-6 on the
    residuals of the returned pressure. The printed algorithm and the test of Eq. (23) are tabulated with what they
    reach: "converged" is said only of residuals computed from the returned pressure.
    """
    rows = []
    repeats = 1 if level == "quick" else 3
    for case in (
        FormulationCase(shape, hardness, COUNTS[level]) for shape in BOUNDARIES for hardness in (None, HARDNESS)
    ):
        calls = {DIRECT: case.by_load}
        calls |= {name: partial(method, *case.given, **case.options) for name, method in METHODS.items()}
        solved = interleaved(calls, repeats)
        direct = solved[DIRECT][0]
        for name, (result, (seconds, *_)) in solved.items():
            off = float(np.linalg.norm(result.pressure - direct.pressure) / np.linalg.norm(direct.pressure))
            rows.append(row(case, name, result, off, seconds))
            if name in MUST_AGREE:
                source = "load-controlled contact solve"
                note = result.report.message
                about: Keywords = {"note": note, "seconds": seconds}
                yield Check(
                    f"{name}: {case.name}", off, expected=0.0, tolerance=AGREEMENT, source=source, kind=AT_MOST, **about
                )
    caption = f"Contact formulations, {COUNTS[level]} x {COUNTS[level]} cells, cold start, tolerance 1e-6. {PAPER}"
    yield Table("formulations", caption, COLUMNS, rows)


def row(case: FormulationCase, name: str, result: ContactResult, off: float, seconds: float) -> TableRow:
    """Return a line of the table."""
    r = result.report
    residuals = float(f"{r.residual:.2g}"), float(f"{off:.2g}")
    return (case.name, name, r.status, r.iterations, round(r.evaluations), *residuals, round(seconds, 4))
