"""Each constant of the contact search at half and at twice its value, on several surfaces.

    OMP_NUM_THREADS=1 python -m verification.campaigns.benchmarks.contact_constants [--cells 256] [--docs docs]

Periodic surfaces with exponential and Gaussian autocorrelation and self-affine ones (H = 0.8) at 50, 200 and 1000 MPa,
one with a hardness of 3 GPa, one with a free axis, two that start from the pressure of a third and of two thirds of the
load, and three that start from the contact at .85, .95 and .99 of the load, to tolerance 1e-4. Told are the
convolutions against those of the values as they are (geometric mean and worst case), and how many solves did not
converge.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable
from types import ModuleType

from ...types import Keywords
from ..constants import numbers_of

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import numpy as np

from lubfric import solve_contact
from lubfric.contact import candidate_cells, half_space, problem, refinement, search, solve
from lubfric.contact.problem import ContactStart

from . import page
from .rough import E_PRIME, surface

SPACING = 2e-6  # m, of the cells
MODULES = (candidate_cells, problem, refinement, search, solve)
# Parts of the load [-] whose contact, with its displacement, is the start.
NEIGHBOURS = (0.85, 0.95, 0.99)
KINDS = ("exponential", "gaussian", "self-affine")
# A constant, or several of one kind.
Constant = int | float | tuple["Constant", ...]
# surface, load [Pa], boundary, hardness [Pa], and the part of the load whose contact is the initial guess
ConstantCase = tuple[str, float, str | tuple[str, str], float | None, float]
# The solve of a case: its convolutions, and whether it converged.
CountedSolve = Callable[[], tuple[float, bool]]
COLUMNS = ("constant", "value", "halved: convolutions, mean and worst", "doubled")


def solvers(n: int) -> list[CountedSolve]:
    """Return functions that solve one case each and return (convolutions, converged)."""
    cases: list[ConstantCase] = [(kind, load, "periodic", None, 0.0) for kind in KINDS for load in (50e6, 200e6, 1e9)]
    cases += [("exponential", 200e6, "periodic", 3e9, 0.0), ("exponential", 200e6, ("free", "periodic"), None, 0.0)]
    warm: list[ConstantCase] = [("gaussian", 200e6, "periodic", None, share) for share in (1 / 3, 2 / 3, *NEIGHBOURS)]
    return [_solver(n, *case) for case in (*cases, *warm)]


def _solver(
    n: int, kind: str, load: float, boundary: str | tuple[str, str], hardness: float | None, begun: float
) -> CountedSolve:
    gap0 = -surface(kind, (n, n), SPACING, 34e-6, 240e-9)
    options: Keywords = {"operator": half_space(gap0.shape, SPACING, E_PRIME, boundary), "boundary": boundary}
    options |= {"hardness": hardness, "tolerance": 1e-4, "raise_on_failure": False}
    if begun:
        start = solve_contact(gap0, SPACING, E_PRIME, mean_pressure=begun * load, **options)
        is_neighbour = begun in NEIGHBOURS
        options["start"] = (
            ContactStart(pressure=start.pressure, displacement=start.displacement) if is_neighbour else start
        )

    def solve() -> tuple[float, bool]:
        report = solve_contact(gap0, SPACING, E_PRIME, mean_pressure=load, **options).report
        return report.evaluations, report.converged

    return solve


def scaled(value: Constant, factor: float) -> Constant:
    """Return a number, or each number of a tuple, times ``factor``; integers remain integers of at least one."""
    if isinstance(value, tuple):
        return tuple(scaled(v, factor) for v in value)
    return max(1, round(factor * value)) if isinstance(value, int) else factor * value


def solved_with(module: ModuleType, name: str, factor: float, solves: list[CountedSolve]) -> np.ndarray:
    """Return rows of the solves with a constant scaled wherever it was imported."""
    value = getattr(module, name)
    homes = [m for m in MODULES if getattr(m, name, None) is value]
    try:
        for home in homes:
            setattr(home, name, scaled(value, factor))
        return np.array([solve() for solve in solves], float)
    finally:
        for home in homes:
            setattr(home, name, value)


def words(rows: np.ndarray, usual: np.ndarray) -> str:
    """Return ratios to the usual rows."""
    ratio = rows[:, 0] / usual[:, 0]
    failed = int(np.count_nonzero(rows[:, 1] == 0))
    text = f"{np.exp(np.log(ratio).mean()):.2f}, {ratio.max():.2f}"
    return text + (f", {failed} not converged" if failed else "")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, default=256)
    page.add_option(parser)
    options = parser.parse_args()
    solves = solvers(options.cells)
    [solve() for solve in solves]
    rows = []
    for module, name in ((module, name) for module in MODULES for name, _ in numbers_of(module)):
        usual = solved_with(module, name, 1.0, solves)
        values = [words(solved_with(module, name, factor, solves), usual) for factor in (0.5, 2.0)]
        rows.append([f"`{module.__name__.rpartition('.')[2]}.{name}`", str(getattr(module, name)), *values])
        print(" | ".join(rows[-1]), flush=True)
    page.write("contact-constants", COLUMNS, rows, (parser, options))


if __name__ == "__main__":
    main()
