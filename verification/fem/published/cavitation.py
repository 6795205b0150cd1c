"""Films that rupture and fill again, compared with a closed form and the pressures of Bertocchi and others."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.optimize import newton

from lubfric.contact import half_space
from lubfric.film import LineContact
from lubfric.models.deterministic import solve_point
from lubfric.models.deterministic.problem import Problem
from lubfric.models.deterministic.state import FLUID, RUPTURED, State
from lubfric.oil import Lubricant

from ... import plotting
from ...check import Figure, Item
from ...plotting import Curve
from .. import references
from . import against

DEEP = 100e-6  # m: the gap around the pad; so deep that the pressure there is nearly 0
CURVATURE = 1.0  # m, radius: the parabola of the model is taken off the pad
RIGID = 1e18  # Pa, E': nothing deflects
PLACES = (0.6, 0.75, 0.9)  # of the length, behind the pocket
LAWS = ("constant", "dowson-higginson")
GRIDS = {"narrow": ((100, 21), (200, 41)), "wide": ((200, 1), (400, 1))}  # cells that fit the pocket
AMBIENT = 0.1  # MPa outside theirs; ours has the pressure of rupture there
Profile = tuple[np.ndarray, np.ndarray]  # x over the length, p in MPa on the middle line


@dataclass(frozen=True)
class Pad:
    """A `references.Pocket` on cells: pressures rise from 0 at its first face, and fall to 0 in the middle of its last
    cells."""

    pocket: references.Pocket
    cells: tuple[int, int]
    density: str = "constant"

    def problem(self, load: float) -> Problem:
        """Return the pad as the model has it, with the gap at the end of the pad left open. ``load`` [N/m]."""
        (nx, ny) = self.cells
        p = self.pocket
        dx = p.length / (nx - 0.5)
        dy = p.width / max(ny - 1, 1)
        x = (np.arange(nx) + 0.5) * dx
        y = (np.arange(ny) - (ny - 1) / 2) * dy
        gap = np.full((nx + 1, ny + (ny > 1)), DEEP)
        gap[:nx, :ny] = p.wedge(x)[:, None]
        gap[:nx, :ny] += p.depth * (p.inside(x)[:, None] & (2 * np.abs(y) < p.across - 1e-9))
        alpha, law = (p.alpha, "barus") if p.alpha else (0.0, "constant")
        oil = Lubricant(p.viscosity, alpha, viscosity_law=law, density_law=self.density)
        x = (np.arange(nx + 1) + 0.5) * dx
        heights = (x**2 / (2 * CURVATURE))[:, None] - (gap - p.end)
        operator = half_space(gap.shape, (dx, dy), RIGID, ("free", "periodic"))
        return Problem(
            line=LineContact(
                load_per_width=load, radius=CURVATURE, e_prime=RIGID, entrainment_speed=p.speed, lubricant=oil
            ),
            sliding=0.0,
            x=x,
            heights=heights,
            operator=operator,
            boundary_friction=0.1,
            floor=1e-12,
        )

    def solved(self, load: float) -> tuple[float, Profile]:
        """Return gap at the end of the pad [m], and the pressure, from an even one."""
        problem = self.problem(load)
        on = problem.rigid_gap < DEEP / 2
        p = np.where(on, load / self.pocket.length, 0.0)
        kind = np.where(on, FLUID, RUPTURED).astype(np.int8)
        start = State(
            pressure=p,
            fill=np.ones_like(p),
            dent=np.zeros_like(p),
            kind=kind,
            yielded=np.zeros(p.shape, bool),
            approach=self.pocket.end,
        )
        solution = solve_point(problem, start=start, tolerance=1e-6)
        middle = solution.pressure[:-1, self.cells[1] // 2]
        return solution.state.approach, (problem.x[:-1] / self.pocket.length, middle / 1e6)

    def at_its_gap(self, load: float) -> Profile:
        """Return the pressure at the given gap; ``load`` is a guess."""
        load = newton(lambda w: self.solved(w)[0] / self.pocket.end - 1, load, x1=1.1 * load, tol=1e-4 * load)
        return self.solved(load)[1]


def cavitation(level: str) -> Iterator[Item]:
    """A rigid pad whose film ruptures in a pocket and fills again, by the deterministic model's solver.

    All values are extrapolated to first order from two grids, one with cells twice as long. Compared with the closed
    form, the error of lubfric is the change from one grid to the other, or one cell for the place where the film fills
    again. Behind Bertocchi's pockets it is half that change and half the difference between two laws of density: the
    value of lubfric is their mean, because the published density is between them. The ambient pressure, which lubfric
    does not contain, is added.
    """
    for pocket in references.BANDS:
        yield from band(pocket)
    for name, pocket in references.BERTOCCHI.items():
        cells = GRIDS[name]
        results = {(law, n): Pad(pocket, cells[n], law).at_its_gap(pocket.load) for law in LAWS for n in (0, 1)}
        at = {key: np.interp(PLACES, *profile) for key, profile in results.items()}
        fine, coarse = (np.mean([at[law, n] for law in LAWS], axis=0) for n in (1, 0))
        laws = np.abs(at["constant", 1] - at["dowson-higginson", 1]) / 2
        own_errors = np.hypot(laws, np.abs(fine - coarse) / 2) + AMBIENT
        for place, ours, error, theirs in zip(PLACES, 2 * fine - coarse, own_errors, pocket.pressures):
            label = f"{name} pocket, pressure at {place:g} of the length"
            yield against("bertocchi", label, ours, theirs, error / ours, "MPa", error=0.02 + AMBIENT / theirs)
        yield drawn(name, pocket, results)


def band(pocket: references.Pocket) -> Iterator[Item]:
    """A pocket as wide as the pad, with the load of the closed form."""
    load, refill, peak = references.refilled(pocket)
    (coarse, (_, low)), (fine, (x, p)) = (Pad(pocket, (n, 1)).solved(load) for n in (800, 1600))
    again = x[(x > pocket.begins / pocket.length) & (p > 0)][0] * pocket.length
    for what, unit, ours, error, theirs in (
        ("gap", "m", 2 * fine - coarse, abs(fine - coarse), pocket.end),
        ("refilling", "m", again, (x[1] - x[0]) * pocket.length, refill),
        ("highest pressure", "MPa", 2 * p.max() - low.max(), abs(p.max() - low.max()), peak / 1e6),
    ):
        name = f"band {pocket.depth / pocket.end:g} gaps deep: {what}"
        yield against("fowell", name, ours, theirs, error / ours, unit)


def drawn(name: str, pocket: references.Pocket, results: dict[tuple[str, int], Profile]) -> Figure:
    """Return pressures on the middle line."""
    curves: list[Curve] = [(*results[law, 1], "-", f"lubfric, density: {law}") for law in LAWS]
    curves.append((PLACES, pocket.pressures, "ko", "Bertocchi", [0.02 * p + AMBIENT for p in pocket.pressures]))
    caption = f"Pressure over a pad with a pocket in which the film ruptures ({name})"
    return plotting.chart(name, caption, curves, xlabel="x over the length of the pad", ylabel="pressure (MPa)")
