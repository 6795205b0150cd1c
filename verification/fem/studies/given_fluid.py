"""The contact of the deterministic film by finite elements that are given its fluid.

Where fluid keeps the bodies apart its pressure is handed over as a load on an elastic body of finite elements. What is
left of the load is carried where they touch, at the floor of the deterministic film: which cells those are, and under
what pressure, is found anew, with another compliance and another active set. As it is unique, both must
agree. The half-space of lubfric is averaged over its cells first (`load_sharing.cell_mean`), as the finite elements
are; what is left falls with their size.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

import lubfric
from lubfric.film import LineContact
from lubfric.models.deterministic import DeterministicResult, Problem, lay_out, reach, solve_point

from ...check import ABSOLUTE, Check, Item
from ...types import Keywords
from ..solvers.compliance import Elastic
from ..solvers.contact import Contact
from ..solvers.harmonic import Compliance, HarmonicStrip, compliance, press
from .load_sharing import cell_mean

SOURCE = "finite-element contact given the fluid"
WIDTH = 90e-6  # m, side of the surface
FINE = 256  # cells in a side on which the surface is made
LENGTH = 5e-6  # m, of its correlation
MORE = 1.02  # times the load, for the slope of the gap


@dataclass(frozen=True, kw_only=True)
class GivenFluidCase:
    """Cells over 90 µm, and across; speed [m/s]; floor [m]; hardness [Pa]; 2^fineness facets of elements in a cell."""

    cells: int
    across: int
    speed: float
    floor: float
    hardness: float | None
    fineness: int

    @property
    def name(self) -> str:
        """Its name."""
        plastic = "" if self.hardness is None else f", {self.hardness / 1e9:g} GPa"
        return f"{self.cells} x {self.across} cells, {self.speed:g} m/s, floor {1e9 * self.floor:g} nm{plastic}"


TOUCHING = GivenFluidCase(cells=64, across=64, speed=0.01, floor=20e-9, hardness=2.5e9, fineness=2)
DENTED = GivenFluidCase(cells=64, across=64, speed=3e-4, floor=1e-9, hardness=4e9, fineness=2)
CASES = {
    "quick": (),
    "default": (TOUCHING, DENTED),
    "full": (
        TOUCHING,
        replace(TOUCHING, hardness=None),
        DENTED,
        GivenFluidCase(cells=64, across=64, speed=1e-4, floor=1e-9, hardness=None, fineness=2),
    ),
}
RMS = 5e-3  # rms difference of the pressure that is allowed, over its rms; elements twice as long: 3 times
LOAD = 5e-3  # relative difference of the load at the same gap that is allowed
GAP = 5e-4  # relative difference of the gap that is allowed
MISPLACED = 0.1  # share of touching cells


def contact_given_fluid(level: str, contact: LineContact) -> Iterator[Item]:
    """Pressure and cells of the contact, its load at the same gap, and the gap of the film."""
    bodies: dict[tuple[int, ...], Compliance] = {}
    for case in CASES[level]:
        problem = laid(case, contact)
        grid = (*problem.heights.shape, case.fineness)
        if grid not in bodies:
            bodies[grid] = elements(problem, case.fineness)
        yield from compared(case, problem, solve_point(problem), bodies[grid])


def laid(case: GivenFluidCase, contact: LineContact) -> Problem:
    """Return the paper's roughness under ``contact`` at the case's speed, on an even number of cells along x."""
    shape = (FINE, FINE * case.across // case.cells)
    rough: Keywords = {"sq": 100e-9, "acf": "gaussian", "seed": 1}
    fine = lubfric.generate_surface(shape, WIDTH / FINE, correlation_length=LENGTH, **rough)
    surface = fine.resampled(shape=(case.cells, case.across))
    line = replace(contact, entrainment_speed=case.speed)
    upstream, downstream = reach(line, surface.sq)

    def over(ends: tuple[float, float]) -> Problem:
        sliding = 2 * case.speed
        laid = lay_out(surface, line, sliding=sliding, boundary_friction=0.09, hardness=case.hardness, ends=ends)
        return replace(laid, floor=case.floor)

    solution = over((upstream, downstream))
    if solution.x.size % 2:
        solution = over((upstream + surface.spacing[0], downstream))
    return replace(solution, operator=cell_mean(solution.operator))


def elements(problem: Problem, fineness: int) -> Compliance:
    """Return the elastic body under the grid of ``problem``."""
    body = Elastic.from_e_prime(problem.e_prime, 0.3)
    return compliance(HarmonicStrip(problem.heights.shape, problem.spacing, body, fineness=fineness))


def compared(case: GivenFluidCase, problem: Problem, solution: DeterministicResult, body: Compliance) -> Iterator[Item]:
    """Checks of one case."""
    mine = np.where(solution.touching, solution.pressure, 0.0)
    by_elements, load = contact_by_elements(problem, solution, body)
    judge = by_elements.pressure
    rms = np.sqrt(np.mean((judge - mine) ** 2) / np.mean(mine**2))
    share = mine.sum() / solution.pressure.sum()
    note = f"{np.count_nonzero(mine)} cells touch and carry {100 * share:.0f} %"
    yield Check(
        f"{case.name}: rms of the contact pressure",
        rms,
        expected=0.0,
        tolerance=RMS,
        source=SOURCE,
        kind=ABSOLUTE,
        note=note,
    )
    misplaced = np.count_nonzero((judge > 0) != (mine > 0)) / np.count_nonzero(mine)
    yield Check(
        f"{case.name}: cells of one contact alone, of all",
        misplaced,
        expected=0.0,
        tolerance=MISPLACED,
        source=SOURCE,
        kind=ABSOLUTE,
    )
    yield Check(
        f"{case.name}: load of the contact at the same gap",
        load,
        expected=1.0,
        tolerance=LOAD,
        source=SOURCE,
        note="relative",
    )
    apart = ~solution.touching & (judge == 0)
    gap = float((by_elements.gap + problem.floor)[apart].mean() / solution.gap[apart].mean())
    yield Check(
        f"{case.name}: mean gap of the film under the same load",
        gap,
        expected=1.0,
        tolerance=GAP,
        source=SOURCE,
        note="relative",
    )


def contact_by_elements(problem: Problem, solution: DeterministicResult, body: Compliance) -> tuple[Contact, float]:
    """Return the contact under what the fluid leaves of the load; and its load at the mean gap of ``solution``, over
    that."""
    fluid = np.where(solution.touching, 0.0, solution.pressure)
    left = problem.load - solution.inlet_load - fluid.sum() * problem.spacing[0] / fluid.shape[1]
    gap0 = problem.rigid_gap + np.where(solution.touching, 0.0, solution.dent) + body.apply(fluid) - problem.floor
    once, more = (press(body, gap0, n * left, hardness=problem.hardness) for n in (1.0, MORE))
    apart = (once.pressure == 0) & (more.pressure == 0) & ~solution.touching
    gap, thinner = (float(contact.gap[apart].mean()) for contact in (once, more))
    wanted = float(solution.gap[apart].mean()) - problem.floor
    return once, 1.0 + (MORE - 1.0) * (wanted - gap) / (thinner - gap)
