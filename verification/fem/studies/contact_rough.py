"""A rough periodic patch on the finite-element layer, elastic and with a plastic limit, compared with
`lubfric.solve_contact`."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

import lubfric

from ...check import AT_LEAST, Item, Table, bound, compared
from ...types import BoolArray, FloatArray
from ..convergence import Series
from ..solvers.compliance import Elastic, missing
from ..solvers.contact import solve_contact
from ..solvers.layer3d import Layer3D, graded_levels, multigrid, solve
from ..solvers.layer_waves import fourier_compliance

E_PRIME = 231e9  # Pa, E' of two steel bodies
BODY = Elastic.from_e_prime(E_PRIME, 0.3)
BOX = 50e-6  # m, side of the patch
SQ = 100e-9  # m
MEAN_PRESSURE = 300e6  # Pa
CAP = 1.5e9  # Pa, hardness where cells yield
THICKNESS = 1.25  # of the box
DRY = "lubfric.solve_contact"
NODES = {"quick": (32, 64), "default": (32, 64, 128), "full": (32, 64, 128, 256)}
REFERENCE = {"quick": 256, "default": 512, "full": 1024}


def contact_rough(level: str) -> Iterator[Item]:
    """A rough periodic patch pressed on a layer of bricks, against `lubfric.solve_contact`.

    It is a box of 50 µm with waves down to a quarter of it. The layer is 1.25 boxes thick, and its longest wave is too
    stiff by 2e-5. How it nears the half-space with the thickness is shown. The contact is solved wave by wave. Its
    pressure is then put as a load on the assembled layer, where multigrid has to find the same gap. Contact areas are
    counts of nodes, which are too large by a part of a node along every edge. Both sides are corrected alike, by the
    length of the edges (Yastrebov, Anciaux & Molinari 2017, doi:10.1016/j.triboint.2017.04.023).
    """
    yield from rough(level)
    yield from thickness(level)
    yield from certified(level)


def roughness(x: FloatArray, y: FloatArray, seed: int = 2, waves: int = 4, slope: float = -1.8) -> FloatArray:
    """Return heights [m] of rms SQ: waves of random phase, 1 to ``waves`` in the box, of amplitude |n|^slope."""
    phases = np.random.default_rng(seed).uniform(0, 2 * np.pi, (waves + 1, 2 * waves + 1))
    total = np.zeros(np.broadcast_shapes(x.shape, y.shape))
    power = 0.0
    for i in range(waves + 1):
        for j in range(-waves, waves + 1):
            n = np.hypot(i, j)
            if not 1 <= n <= waves or (i == 0 and j < 0):
                continue
            total += n**slope * np.cos(2 * np.pi * (i * x + j * y) / BOX + phases[i, j])
            power += n ** (2 * slope) / 2
    return SQ * total / np.sqrt(power)


@dataclass(frozen=True)
class Patch:
    """Fields (nodes, nodes) of one rough contact, whichever solver they come from."""

    pressure: np.ndarray
    gap: np.ndarray
    weights: np.ndarray
    limit: float = np.inf

    @property
    def touching(self) -> np.ndarray:
        """Where there is pressure."""
        return self.pressure > 0

    @property
    def area(self) -> float:
        """Return the contact area over the box, corrected for complete nodes along its edges."""
        return corrected_area(self.touching)

    @property
    def plastic_area(self) -> float:
        """Share of the nodes at the cap. The pressure reaches it with a kink, for which no correction is known."""
        return float(np.mean(self.pressure >= (1 - 1e-9) * self.limit))

    @property
    def mean_gap(self) -> float:
        """Volume between the bodies over the area of the box [m]."""
        return float(np.sum(self.weights * np.maximum(self.gap, 0)) / np.sum(self.weights))


def corrected_area(mask: BoolArray) -> float:
    """Return share of the grid, less ``(pi - 1 + ln 2)/24`` spacings for every length of edge."""
    edges = sum(np.count_nonzero(mask != np.roll(mask, 1, axis)) for axis in (0, 1))
    return float(np.count_nonzero(mask) - (np.pi - 1 + np.log(2)) / 24 * edges) / mask.size


def layer_of(nodes: int, degree: int, depth: float = THICKNESS, layers: int | None = None) -> Layer3D:
    """Return the periodic layer under the box, ``depth`` boxes thick."""
    levels = graded_levels(depth * BOX, layers or nodes // (2 * degree), 6.0)
    return Layer3D(body=BODY, size=(BOX, BOX), levels=levels, shape=(nodes, nodes), degree=degree)


def press_patch(grid: Layer3D, limit: float | None = None) -> Patch:
    """Return the rough patch pressed on the layer."""
    weights = grid.weights
    solution = solve_contact(
        fourier_compliance(grid).displacement,
        weights.ravel(),
        -roughness(*grid.x).ravel(),
        MEAN_PRESSURE * BOX**2,
        limit=limit,
    )
    return Patch(
        solution.pressure.reshape(grid.shape),
        solution.gap.reshape(grid.shape),
        weights,
        np.inf if limit is None else limit,
    )


def half_space_patch(nodes: int, limit: float | None = None) -> Patch:
    """Return the contact of the patch by `lubfric`."""
    x = np.arange(nodes) * BOX / nodes
    solution = lubfric.solve_contact(
        -roughness(x[:, None], x[None]),
        BOX / nodes,
        E_PRIME,
        mean_pressure=MEAN_PRESSURE,
        hardness=limit,
        tolerance=1e-6,  # far below what is compared; with yielded cells the single-precision search ends near 1e-7
    )
    return Patch(solution.pressure, solution.gap, np.ones_like(solution.gap), np.inf if limit is None else limit)


def rough(level: str) -> Iterator[Item]:
    """The rough patch, elastic and capped, on several grids."""
    rows = []
    for name, limit in (("elastic", None), ("capped", CAP)):
        reference = half_space_patch(REFERENCE[level], limit)
        patches = [press_patch(layer_of(n, 2), limit) for n in NODES[level]]
        off = [patch_difference(p, reference) for p in patches]
        for by, p, o in (*(("finite elements", *each) for each in zip(patches, off)), ("lubfric", reference, 0.0)):
            rows.append((f"{name}, {by}", f"{p.gap.shape[0]}²", p.area, p.plastic_area, p.mean_gap / SQ, o))
        yield from patch_checks(name, patches, reference, off)
    caption = f"Rough patch, Sq = {SQ * 1e9:g} nm, box {BOX * 1e6:g} µm, mean pressure {MEAN_PRESSURE / 1e6:g} MPa, "
    caption += f"cap {CAP / 1e9:g} GPa; triquadratic bricks"
    columns = ("solver", "nodes", "contact area", "area at the cap", "mean gap / Sq", "pressure difference")
    yield Table("contact_rough", caption, columns, rows)


def at_nodes(values: FloatArray, nodes: int) -> np.ndarray:
    """Return the values on a finer grid at the nodes of a coarser one."""
    every = values.shape[0] // nodes
    return values[::every, ::every]


def patch_difference(p: Patch, reference: Patch) -> float:
    """Return relative L2 difference of the pressures at the nodes of the coarser grid."""
    other = at_nodes(reference.pressure, p.pressure.shape[0])
    return float(np.sqrt(np.sum(p.weights * (p.pressure - other) ** 2) / np.sum(p.weights * other**2)))


def patch_checks(name: str, patches: list[Patch], reference: Patch, off: list[float]) -> Iterator[Item]:
    """Compare area, mean gap and pressure with `lubfric`."""
    finest = patches[-1]
    nodes = patches[-1].gap.shape[0]
    label = f"rough patch, {name}, {nodes}²"
    other = f"{DRY}, {reference.gap.shape[0]}²"
    rows = [
        ("contact area", "1", finest.area, reference.area, 0.02),
        ("mean gap", "m", finest.mean_gap, reference.mean_gap, 5e-3),
        ("area at the cap", "1", finest.plastic_area, reference.plastic_area, 4 / nodes),
    ]
    yield from compared(label, rows if np.isfinite(finest.limit) else rows[:2], other)
    sizes = [1 / p.gap.shape[0] for p in patches]
    source = "edges like a square root, at places the grid does not know"
    yield Series(
        "",
        sizes,
        errors=off,
        order=1,
        check=f"{label}: order of the pressure difference",
        tolerance=0.4,
        source=source,
        kind=AT_LEAST,
    ).check_order()
    yield bound(f"{label}: pressure difference", off[-1], 2 / nodes, other, "L2")


def thickness(level: str) -> Iterator[Item]:
    """Mean gap of the rough patch against the thickness of the layer."""
    nodes = 32 if level == "quick" else 64
    reach = np.cumsum(BOX / nodes * 1.2 ** np.arange(20))  # the same levels near the surface, fewer or more below
    depths = reach[(reach > 0.25 * BOX) & (reach < 1.4 * BOX)] / BOX

    def gap(depth: float) -> float:
        levels = -np.append(reach[reach <= 1.001 * depth * BOX][::-1], 0)
        return press_patch(Layer3D(body=BODY, size=(BOX, BOX), levels=levels, shape=(nodes, nodes), degree=2)).mean_gap

    gaps = np.array([gap(d) for d in depths])
    thick = gap(reach[-1] / BOX)
    off = np.abs(gaps / thick - 1)
    stiff = np.array([missing(2 * np.pi * d, BODY.poisson) for d in depths])
    caption = f"Mean gap of the rough patch on layers, {nodes}² nodes, over that on {reach[-1] / BOX:.3g} boxes"
    columns = ("thickness / box", "mean gap / Sq", "relative change", "missing compliance of the longest wave")
    yield Table("contact_rough_thickness", caption, columns, list(zip(depths, gaps / SQ, off, stiff, strict=True)))
    chosen = np.argmin(np.abs(depths - THICKNESS))
    name = f"rough patch: change of the mean gap beyond {depths[chosen]:.3g} boxes"
    yield bound(name, off[chosen], 1e-4, "thickness study")
    near = (off > 1e-5) & (stiff < 0.1)
    name = "rough patch: change of the mean gap follows the missing compliance, exponent"
    yield Series(
        "",
        stiff[near],
        errors=off[near],
        order=1,
        check=name,
        tolerance=0.15,
        source="first order in what the layer lacks",
    ).check_order()


def certified(level: str) -> Iterator[Item]:
    """The contact that was solved wave by wave, as a load on the assembled layer: does it hold there as well?"""
    nodes = 32 if level == "quick" else 64
    grid = layer_of(nodes, 2 if level == "full" else 1, layers=nodes // 4)
    p = press_patch(grid)
    force = p.pressure * p.weights
    solved = solve(multigrid(grid), force, tolerance=1e-9)
    misfit = solved.surface - roughness(*grid.x)
    gap = misfit - np.average(misfit, weights=force)
    scale = np.ptp(solved.surface)
    note = f"{grid.unknowns} unknowns, {solved.report.iterations} iterations"
    source = "conjugate gradients with smoothed aggregation on the assembled layer"
    yield bound(f"rough patch, {nodes}², multigrid: penetration", -gap.min() / scale, 1e-7, source, note)
    opening = np.average(np.abs(gap), weights=force) / scale
    yield bound(f"rough patch, {nodes}², multigrid: complementarity", opening, 1e-7, source)
