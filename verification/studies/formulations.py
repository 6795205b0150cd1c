"""The contact formulations of the paper against the load-controlled default: agreement, work, time."""

from __future__ import annotations

import statistics
import time

import numpy as np

import lubfric
from lubfric.contact import solve_contact
from lubfric.halfspace import half_space
from lubfric.paper.contact import alternating, single_loop

from ..check import AT_MOST, Check, Table

E_PRIME, RADIUS, SPACING, SQ = 231e9, 2e-3, 1e-6, 1e-7
BOUNDARIES = {"flat": ("periodic", "periodic"), "cylinder": ("free", "periodic"), "ball": ("free", "free")}
COUNTS = {"quick": 64, "default": 128, "full": 256}
HARDNESS, TOLERANCE, AGREEMENT = 2e9, 1e-6, 1e-4
PAPER = "Akchurin et al. 2015, Appendix 2 and Sec. 2.2, doi:10.1007/s11249-015-0536-z"
METHODS = {
    "single loop": lambda case: single_loop(*case.given, **case.options),
    "single loop, as printed": lambda case: single_loop(
        *case.given, form="printed", max_iterations=1000, **case.options
    ),
    "single loop, stop on Eq. (23)": lambda case: single_loop(*case.given, stop="separation", **case.options),
    "alternating, root": lambda case: alternating(*case.given, **case.options),
    "alternating, repeated": lambda case: alternating(*case.given, update="repeat", **case.options),
}
MUST_AGREE = ("single loop", "alternating, root")


class Case:
    """A rough contact that is solved at a given load. Its volume over the area A is then given instead."""

    def __init__(self, shape: str, hardness: float | None, count: int):
        self.name = f"{shape}, {'elastic' if hardness is None else 'plastic'}"
        z = lubfric.generate_surface(
            (count, count), SPACING, sq=SQ, correlation_length=6e-6, acf="gaussian", seed=3
        ).heights
        x = (np.arange(count) - (count - 1) / 2) * SPACING
        b = count * SPACING / 6
        film, area, pressure = self._body(shape, x, b, z.shape)
        operator = half_space(z.shape, SPACING, E_PRIME, BOUNDARIES[shape])
        self.load = {"hardness": hardness, "boundary": BOUNDARIES[shape], "operator": operator}
        self.shape, self.pressure = film - z, pressure
        self.direct = self.by_load()
        volume = np.sum(area * np.maximum(self.direct.gap, 0)) / area.sum()
        self.given = (z, film + volume - np.sum(area * film) / area.sum(), SPACING, E_PRIME)
        self.options = self.load | {"weight": area, "tolerance": TOLERANCE, "raise_on_failure": False}

    @staticmethod
    def _body(shape, x, b, grid):
        if shape == "flat":
            return np.zeros(grid), np.ones(grid), 300e6
        if shape == "cylinder":
            line = np.repeat(x[:, None], grid[1], axis=1)
            return (
                line**2 / (2 * RADIUS),
                (abs(line) <= b) * 1.0,
                b**2 * np.pi * E_PRIME / (8 * RADIUS * x.size * SPACING),
            )
        square = x[:, None] ** 2 + x**2
        return (
            square / (2 * RADIUS),
            (square <= b**2) * 1.0,
            2 / 3 * b**3 * E_PRIME / RADIUS / (x.size * SPACING) ** 2,
        )

    def by_load(self):
        """The load-controlled default."""
        return solve_contact(
            self.shape, SPACING, E_PRIME, mean_pressure=self.pressure, tolerance=TOLERANCE, **self.load
        )


def formulations(level: str):
    """The same contacts solved for a given load, and by the paper's methods for the volume that this solution holds.

    There are three boundary conditions, elastic and with a plastic limit, cold starts, and a tolerance of 1e-6 on the
    residuals of the returned pressure. The printed algorithm and the test of Eq. (23) are tabulated with what they
    reach: "converged" is said only of residuals computed from the returned pressure. The cylinder is then closed both
    ways: contact solved at F_T - F_H and volume balanced, or film imposed and loads balanced.
    """
    rows = []
    for shape in BOUNDARIES:
        for hardness in (None, HARDNESS):
            case = Case(shape, hardness, COUNTS[level])
            seconds, direct = _timed(case.by_load)
            rows.append(_row(case, "load-controlled (default)", direct, 0.0, seconds))
            for name, method in METHODS.items():
                seconds, found = _timed(lambda method=method, case=case: method(case))
                difference = float(
                    np.linalg.norm(found.pressure - case.direct.pressure) / np.linalg.norm(case.direct.pressure)
                )
                rows.append(_row(case, name, found, difference, seconds))
                if name in MUST_AGREE:
                    yield Check(
                        f"{name}: {case.name}",
                        difference,
                        0.0,
                        AGREEMENT,
                        "load-controlled contact solve",
                        AT_MOST,
                        note=found.report.message,
                        seconds=seconds,
                    )
    yield Table(
        "formulations",
        f"Contact formulations, {COUNTS[level]} x {COUNTS[level]} cells, cold start, tolerance 1e-6. {PAPER}",
        ("case", "method", "status", "iterations", "convolutions", "residual", "relative L2 of pressure", "seconds"),
        tuple(rows),
    )
    yield from closures(level)


def closures(level: str):
    """Both closures of the model on the paper's cylinder."""
    scene = lubfric.load_scene("paper").with_(numerics={"tolerance": 1e-4, "sampling": "patch", "model": "full"})
    rows = []
    for speed in (1e-4, 1e-3, 1e-2) if level != "quick" else (1e-3,):
        points = {}
        for closure in ("load", "separation"):
            seconds, point = _timed(
                lambda c=closure, u=speed: lubfric.friction(scene.with_(numerics={"closure": c}), u), 1
            )
            points[closure] = point
            rows.append((speed, closure, point.coefficient, point.film_load, point.report.evaluations, seconds))
        yield Check(
            f"closures agree on the coefficient at {speed:g} m/s",
            points["separation"].coefficient,
            points["load"].coefficient,
            3e-4,
            "load-controlled balance",
        )
        yield Check(
            f"closures agree on F_H at {speed:g} m/s",
            points["separation"].film_load,
            points["load"].film_load,
            2e-3,
            "load-controlled balance",
            unit="N",
        )
    yield Table(
        "closures",
        "The paper's cylinder closed both ways (numerics.closure), cold starts",
        ("speed [m/s]", "closure", "coefficient", "F_H [N]", "evaluations", "seconds"),
        tuple(rows),
    )


def _timed(work, repeats: int = 3):
    seconds = []
    for _ in range(repeats):
        begun = time.perf_counter()
        result = work()
        seconds.append(time.perf_counter() - begun)
    return statistics.median(seconds), result


def _row(case, name, found, difference, seconds) -> tuple:
    r = found.report
    return (
        case.name,
        name,
        r.status,
        r.iterations,
        round(r.evaluations),
        float(f"{r.residual:.2g}"),
        float(f"{difference:.2g}"),
        round(seconds, 4),
    )
