"""Waves of small height at rest in the elastic film: the deterministic film beside finite elements.

How far a film flattens waves that move with a surface is published as one curve (C. H. Venner, F. Couhier, A. A.
Lubrecht & J. A. Greenwood, Tribology Series 32 (1997) 103-112, doi:10.1016/s0167-8922(08)70440-1). Here the waves rest
and the smooth body moves, which is another limit. It has a linear theory of its own, which `fem.ripple` solves on the
full-system finite elements. In a film of even thickness h and viscosity eta it is |h1|/A = 1/sqrt(1 + q²), with
q = 48 eta U/(E' k² h³): that is told beside it.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from lubfric.deterministic import lay_out, solve_point
from lubfric.film import LineContact
from lubfric.oil import Lubricant
from lubfric.surface.height_map import Surface

from ..check import ABSOLUTE, Check, Item, Table
from ..fem import ehl
from ..fem.fluid import Fluid
from ..fem.ripple import ripple

CELLS, HEIGHT = 1024, 0.002  # of 5 b; of the film
PRECISION = 1e-9
SOURCE = "linear response of full-system finite elements"
ALLOWED = 0.02  # of the height of the waves
COLUMNS = ("case", "wavelength/b", "kept: lubfric", "finite elements", "even film", "rms of the difference")


@dataclass(frozen=True)
class Case:
    """A smooth line contact in SI units; ``coefficient``: of pressure and viscosity (None: constant)."""

    name: str
    load: float
    radius: float
    e_prime: float
    speed: float
    viscosity: float
    coefficient: float | None

    @property
    def law(self) -> str:
        """The law of its viscosity."""
        return "constant" if self.coefficient is None else "roelands"

    @property
    def line(self) -> LineContact:
        """For lubfric."""
        oil = Lubricant(self.viscosity, self.coefficient or 0.0, self.law)
        return LineContact(self.load, self.radius, self.e_prime, self.speed, oil)

    @property
    def elements(self) -> ehl.LineContact:
        """For the finite elements."""
        fluid = Fluid(self.viscosity, self.law, self.coefficient or 0.0)
        return ehl.LineContact(self.load, self.radius, self.e_prime, self.speed, fluid)


SOFT = Case("soft, isoviscous", 2e4, 1e-2, 2e9, 0.5, 0.05, None)
STEEL = Case("steel, Roelands", 2e5, 1e-2, 2.3e11, 1.0, 0.04, 18e-9)
CASES = {
    "quick": (),
    "default": (SOFT, STEEL),
    "full": (SOFT, replace(SOFT, name="soft, Roelands", coefficient=10e-9), STEEL),
}
LENGTHS = (1.0, 0.5, 0.25)  # in half-widths


def waviness(level: str) -> Iterator[Item]:
    """Both responses over |x| < b/2, and what is left of the waves at x = 0."""
    rows = []
    for case in CASES[level]:
        for row in compared(case):
            rows.append((case.name, *row))
            name = f"{case.name}: waves of {row[0]:g} b at rest, rms of the film beside finite elements"
            yield Check(name, row[-1], 0.0, ALLOWED, SOURCE, ABSOLUTE, note="of their height")
    if rows:
        yield Table("waviness", "Waves of small height at rest: the part that the film keeps", COLUMNS, tuple(rows))


def compared(
    case: Case, lengths=LENGTHS, judged: Case | None = None, refinements: int = 2, fineness: float = 1.0
) -> Iterator[tuple[float, float, float, float, float]]:
    """Wavelength, |h1|/A at x = 0 by lubfric, finite elements (of ``judged``) and an even film; rms difference."""
    line = case.line
    b = line.half_width
    flat = Surface(np.zeros((64, 1)), (5 * b / CELLS,) * 2, periodic_axes=(True, True))
    smooth = lay_out(flat, line, sliding=2 * case.speed, boundary_friction=0.09, ends=(3 * b, 2 * b))
    base = solve_point(smooth, tolerance=PRECISION)
    solution = ehl.solve_ehl((judged or case).elements, refinements=refinements, fineness=fineness)[-1]
    near = np.flatnonzero(np.abs(base.x) < 0.5 * b)
    middle = near[np.argmin(np.abs(base.x[near]))]
    pick = solution.body.line.probes(base.x[None, near] / b)
    for length in lengths:
        mine = response(smooth, base, 2 * np.pi / (length * b))
        judge = pick @ ripple(solution, length * b).film
        rms = float(np.sqrt(np.mean(np.abs(mine[near] - judge) ** 2)))
        even = _even(case, length * b, float(base.gap[middle, 0]), float(base.pressure[middle, 0]))
        yield length, float(abs(mine[middle])), float(abs(judge[near == middle][0])), even, rms


def response(smooth, base, k: float) -> np.ndarray:
    """Change of the gap per height of exp(i k x), complex (nx,)."""
    height = HEIGHT * base.central_gap

    def change(wave):
        wavy = replace(smooth, heights=height * wave[:, None])
        return (solve_point(wavy, start=base.state, tolerance=PRECISION).gap - base.gap)[:, 0] / height

    return change(np.cos(k * base.x)) + 1j * change(np.sin(k * base.x))


def _even(case: Case, length: float, film: float, pressure: float) -> float:
    eta = float(case.elements.fluid.eta(pressure))
    q = 48 * eta * case.speed / (case.e_prime * (2 * np.pi / length) ** 2 * film**3)
    return float(1 / np.hypot(1, q))
