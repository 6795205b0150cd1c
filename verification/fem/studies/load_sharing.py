"""Film, rough contact and their load sharing by finite elements, compared with `lubfric.friction`."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

import lubfric
from lubfric.contact import HalfSpace
from lubfric.models import prepare
from lubfric.models.shared import Prepared

from ... import plotting
from ...check import AT_LEAST, ComparedRow, Field, Figure, Item, Table, compared
from ...types import Keywords
from .. import parts
from ..convergence import Series, convergence
from ..solvers.compliance import Elastic
from ..solvers.ehl import LineContact
from ..solvers.harmonic import Compliance, HarmonicStrip, compliance
from ..solvers.sharing import Bodies, SharedLoad, share_load

LENGTH = 44.8e-6  # of the patch, both ways
CORRELATION = 4e-6  # m, where the autocorrelation of the heights falls to 1/e
SPEEDS = (0.001, 0.01, 0.03)  # m/s
TIGHT = {  # the model of the finite elements: no more and no less
    "film_tolerance": 1e-4,
    "balance_tolerance": 1e-6,
    "film_deflection": "hydrodynamic",
    "heat": "off",
    "model": "paper",
    "sampling": "patch",
    "grid": "given",
    "accept": True,
}
STEP = 0.1  # of the trapezoidal rule in `twice_integrated`: its error is below 1e-15
POINTS = 200  # of that rule on each side of zero
SOURCE = "film and contact by finite elements, own root finder"


# cells along a side, refinements of the film's mesh, facets per cell as a power of 2, speeds [m/s]
LEVELS = {
    "quick": ((16, 32), 0, 1, (0.01,)),
    "default": ((16, 32, 64), 1, 1, SPEEDS),
    "full": ((16, 32, 64, 128), 2, 0, SPEEDS),
}
# of coefficient, F_H, mean gap on the finest grid; the measured differences fall with the cell (below)
TOLERANCE = {"quick": (3e-3, 1.2e-2, 5e-3), "default": (3e-3, 5e-3, 3e-3), "full": (3e-3, 5e-3, 3e-3)}
COLUMNS = ("U (m/s)", "cells", "by", "f", "F_C (N)", "F_H (N)", "mean gap (nm)", "area", "Couette (N)", "rolling (N)")


def load_sharing(level: str) -> Iterator[Item]:
    """Coefficient, contact load and film load of the paper's cylinder, computed twice with nothing in common.

    It is Tables 1 and 2 of the paper on a patch of 45 x 45 µm (Gaussian roughness of 100 nm, correlation length 4 µm),
    coarse enough for finite elements. *Film*: full-system finite elements (elastic body of 240 half-widths, Reynolds on
    its surface) against lubfric's half-space and Newton's method. *Contact*: P2 elements in the section with waves
    along the line and an active set, against lubfric's Bessel kernel and conjugate gradient. *Balance and
    friction*: another root finder and other integrals. Both sides get the same heights on the same cells and the same
    meaning of a displacement, its mean over a cell. lubfric's own is at cell centres. Here it is given a kernel of
    means, which is written for this comparison (`cell_mean`). What is left is the error of the finite elements.
    """
    grids, refinements, fineness, speeds = LEVELS[level]
    points: list[Point] = []
    for cells in grids:
        heights = rough(grids[-1], cells)
        body = strip(cells, fineness)
        coarser = {p.speed: p.fem.log_load_ratio for p in points}
        points += [both(speed, heights, body, refinements, coarser.get(speed)) for speed in speeds]
    finest = points[-len(speeds) :]
    for p in finest:
        note = f"{p.cells} x {p.cells} cells of {LENGTH / p.cells * 1e6:.2f} µm"
        yield from compared(f"{p.speed:g} m/s", rows_of(p.main, p.fem, TOLERANCE[level]), SOURCE, note)
    yield side_by_side(points)
    yield from approach(points, grids)
    shown = next(p for p in finest if p.speed == 0.01)
    yield pressure_field(shown)
    yield pressure_figure(shown)


@dataclass(frozen=True)
class Point:
    """One operating point by both programs."""

    cells: int
    speed: float
    fem: SharedLoad
    main: lubfric.FrictionResult

    def difference(self, name: str) -> float:
        """Return relative difference of a number that both have."""
        return float(abs(getattr(self.main, name) / getattr(self.fem, name) - 1))


def scene() -> lubfric.Scene:
    """Return the paper's cylinder, everything modelled on the grid given."""
    return lubfric.load_scene("paper").with_(numerics=TIGHT | {"tolerance": 1e-4})


def elastic() -> Elastic:
    """Return the elastic body that represents both."""
    return Elastic.from_e_prime(scene().bodies.e_prime, 0.3)


def rough(finest: int, cells: int) -> np.ndarray:
    """Return one surface of ``finest`` squared cells, averaged in blocks."""
    rough_surface = scene().surface
    block = finest // cells
    made: Keywords = {
        "sq": rough_surface.sq,
        "acf": rough_surface.acf,
        "correlation_length": CORRELATION,
        "seed": rough_surface.seed,
    }
    surface = lubfric.generate_surface((finest, finest), LENGTH / finest, **made)
    return surface.heights.reshape(cells, block, cells, block).mean(axis=(1, 3))


@lru_cache(maxsize=3)
def strip(cells: int, fineness: int, across: float | None = None) -> Compliance:
    """Return the patch on so many cells each way, which are ``across`` (m) long along y (None: as along x)."""
    return compliance(
        HarmonicStrip((cells, cells), (LENGTH / cells, across or LENGTH / cells), elastic(), fineness=fineness)
    )


def both(speed: float, heights: np.ndarray, body: Compliance, refinements: int, known: float | None) -> Point:
    """Return one speed by both methods. The finite-element root starts from no knowledge of the other's, but from the
    ln(F_H/F_C) that was ``known`` on coarser cells."""
    s = scene()
    cell = LENGTH / heights.shape[0]
    bodies = cylinder(s, speed, body, heights)
    guess, step = (0.0, 1.0) if known is None else (known, 0.05)
    solution = share_load(bodies, refinements=min(refinements, 1), guess=guess, step=step)
    if refinements > 1:
        solution = share_load(bodies, refinements=refinements, guess=solution.log_load_ratio, step=0.01)
    model = averaged(prepare(s, lubfric.Surface(heights, (cell, cell))))
    return Point(heights.shape[0], speed, solution, lubfric.friction(model, speed, fields=True))


def cylinder(s: lubfric.Scene, speed: float, body: Compliance, heights: np.ndarray) -> Bodies:
    """Return the scene for the finite elements, which get nothing of it but its numbers."""
    b = s.bodies
    sliding = s.motion.slide_roll_ratio * speed
    hardness = b.hardness or math.inf
    return Bodies(
        contact=whole(s, speed),
        width=b.width,
        compliance=body,
        heights=heights,
        hardness=hardness,
        boundary_friction=b.boundary_friction_coefficient,
        sliding=sliding,
    )


def whole(s: lubfric.Scene, speed: float) -> LineContact:
    """Return the smooth contact under the total load."""
    return LineContact.of(parts.case_of_scene(s, s.bodies.load, speed) | vars(s.lubricant))


def averaged(model: Prepared) -> Prepared:
    """Return the model with displacements that are means over cells along x, as those of the finite elements are."""
    contact = parts.half_space(model)
    averages = replace(contact, operator=cell_mean(contact.operator))
    return prepare(model.scene, model.surface, contact=averages)


def cell_mean(operator: HalfSpace) -> HalfSpace:
    """Return the operator with displacements that are means over each cell along x, under pressures uniform in each
    cell.

    A line load that varies as exp(i k y) deflects a half-space by (4/(pi E')) K0(k |x|), and by -(4/(pi E')) ln|x|
    where k = 0. Integrated over one cell and averaged over another, that is a second difference of its second
    antiderivative. u of a line load along y is 0 at the length of the patch, which is the level that lubfric takes.
    """
    (nx, ny) = operator.shape
    (dx, dy) = operator.spacing
    k = 2 * np.pi * np.arange(1, ny // 2 + 1) / (ny * dy)
    away = np.arange(nx + 1) * dx
    waves = twice_integrated(away[:, None] * k) / k**2
    size = np.maximum(away, np.finfo(float).tiny)
    line = -(size**2) * (np.log(size / (nx * dx)) / 2 - 0.75)
    folded = np.column_stack([line, waves])  # about the cell itself: even
    below = np.vstack([folded[1], folded[:-2]])
    kernel = 4 / (np.pi * operator.e_prime) * (folded[1:] - 2 * folded[:-1] + below) / dx
    kernel[0, 1:] += 4 / (np.pi * operator.e_prime) * np.pi / k  # the kink at 0 of the part that decays
    mirrored = np.zeros((operator.padded[0], kernel.shape[1]))
    mirrored[:nx] = kernel
    mirrored[-nx + 1 :] = kernel[:0:-1]
    return replace(operator, symbol=np.ascontiguousarray(np.fft.rfft(mirrored, axis=0).real))


def twice_integrated(z: np.ndarray) -> np.ndarray:
    """Return the function whose second derivative is K0(z), zero far away: ∫ exp(-z cosh t)/cosh² t dt, t > 0."""
    values = 0.5 * np.exp(-z)
    for growth in np.cosh(STEP * np.arange(1, POINTS)):
        values += np.exp(-z * growth) / growth**2
    return STEP * values


def rows_of(main: lubfric.FrictionResult, fem: SharedLoad, allowed: tuple[float, float, float]) -> list[ComparedRow]:
    """Return the results of both programs. The asperity load is the total load less the film load."""
    return [
        ("coefficient", "1", main.coefficient, fem.coefficient, allowed[0]),
        ("F_H", "N", main.film_load, fem.film_load, allowed[1]),
        ("mean gap", "m", main.mean_gap, fem.mean_gap, allowed[2]),
        ("shear force", "N", main.shear_force, fem.shear, allowed[1]),
    ]


def side_by_side(points: list[Point]) -> Table:
    """Return every number of both programs."""
    rows = []
    for p in points:
        f = p.fem
        m = p.main
        by_elements = (f.coefficient, f.contact_load, f.film_load, f.mean_gap * 1e9, f.area, f.couette, f.rolling)
        loads = (m.coefficient, m.contact_load, m.film_load)
        forces = (m.couette_force, m.rolling_force)
        rows.append((p.speed, p.cells, "finite elements", *by_elements))
        rows.append((p.speed, p.cells, "lubfric", *loads, m.mean_gap * 1e9, m.real_contact_area_fraction, *forces))
    caption = "Load sharing side by side; the area is the share of the Hertz strip in contact."
    return Table("load_sharing", caption, COLUMNS, rows)


def approach(points: list[Point], grids: tuple[int, ...]) -> Iterator[Item]:
    """Differences against cell size, with their orders."""
    # µm
    sizes = [1e6 * LENGTH / n for n in grids]
    series = []
    for label, name in (("coefficient", "coefficient"), ("F_H", "film_load"), ("mean gap", "mean_gap")):
        errors = [max(p.difference(name) for p in points if p.cells == n) for n in grids]
        series.append(Series(label, sizes, errors=errors))
    why = "finite elements as fine as the cells: at least first order at the edges of asperity contacts"
    name = "difference in mean gap: order in the cell size"
    yield replace(series[-1], order=1.0, check=name, tolerance=0.3, source=why, kind=AT_LEAST).check_order()
    caption = "Differences between lubfric and the finite-element model (largest over the speeds) against the cell of "
    caption += "the contact grid."
    yield from convergence("load_sharing_convergence", caption, series, "cell (µm)", "relative difference")


def pressure_field(p: Point) -> Field:
    """Return contact pressure and gap of both."""
    edges = np.linspace(-LENGTH / 2, LENGTH / 2, p.cells + 1)
    x, y = np.meshgrid(edges, edges, indexing="ij")
    corner = np.arange((p.cells + 1) ** 2).reshape(p.cells + 1, -1)
    quads = np.stack([corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]], axis=-1).reshape(-1, 4)
    contact = parts.contact_fields(p.main)
    pressed = parts.the(p.fem.pressed, "dry contact")
    values = {"pressure": pressed.pressure, "pressure_lubfric": contact.pressure}
    values |= {"gap": pressed.gap, "gap_lubfric": contact.gap}
    caption = f"Contact pressure (Pa) and gap (m) at {p.speed:g} m/s by finite elements and lubfric"
    data = {name: [v.ravel()] for name, v in values.items()}
    return Field(
        "load_sharing", caption, points=np.column_stack([x.ravel(), y.ravel()]), cells={"quad": quads}, cell_data=data
    )


def pressure_figure(p: Point) -> Figure:
    """Return contact pressure of both and the film's pressure of both."""
    canvas, (left, middle, right) = plotting.axes(1, 3, width=9.6, height=3.4)
    half = LENGTH / 2 * 1e6
    contact = parts.contact_fields(p.main)
    by_elements = parts.the(p.fem.pressed, "dry contact").pressure
    shown = {"origin": "lower", "extent": (-half, half, -half, half), "cmap": "magma_r", "vmin": 0}
    for ax, pressure, title in ((left, by_elements, "finite elements"), (middle, contact.pressure, "lubfric")):
        image = ax.imshow(pressure.T / 1e9, vmax=by_elements.max() / 1e9, **shown)
        ax.set(title=title, xlabel="x (µm)", xlim=(-half / 2, half / 2))
        ax.grid(visible=False)
    left.set_ylabel("y (µm)")
    canvas.colorbar(image, ax=(left, middle), label="contact pressure (GPa)", shrink=0.85)
    film = p.fem.film
    line = parts.film(p.main)
    x = np.linspace(-60e-6, 40e-6, 400)
    right.plot(x * 1e6, film.at(x)[0] / 1e6, label="finite elements")
    right.plot(line.x * 1e6, line.pressure / 1e6, "--", label="lubfric")
    right.set(xlim=(-60, 40), xlabel="x (µm)", ylabel="film pressure (MPa)", title="film")
    right.legend()
    caption = f"{p.speed:g} m/s: contact pressure (middle half of the patch) and film pressure by the two methods."
    return plotting.finish("load_sharing_pressure", canvas, caption, "png")
