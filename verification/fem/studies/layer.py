"""The elastic layer by finite elements against its exact compliance, and its approach to the half-space."""

from collections.abc import Iterator

import numpy as np
from skfem import MeshTri

from ...check import Check, Item, Table, bound, compared
from ..convergence import Series, convergence
from ..solvers.compliance import Elastic, curvature_number, half_space_compliance, layer_compliance, missing
from ..solvers.layer import Layer, graded_mesh, make_layer
from ..solvers.layer3d import Layer3D, graded_levels, multigrid, rigid_body_modes, solve
from ..solvers.layer_waves import fourier_compliance

BODY = Elastic.from_e_prime(231e9, 0.3)
WAVE = 20e-6  # wavelength in m
K = 2 * np.pi / WAVE
SOURCE = "exact compliance of a bonded layer, Carbone & Mangialardi 2008, doi:10.1016/j.jmps.2007.05.009"
CELLS = {"quick": (8, 16, 32), "default": (8, 16, 32, 64), "full": (8, 16, 32, 64, 128)}
MULTIGRID = {"quick": 16, "default": 32, "full": 64}
HALF_WIDTH = 5e-6  # of the narrow load, m


def layer(level: str) -> Iterator[Item]:
    """An elastic layer on a rigid base by finite elements: does it give the compliance it should?

    It is two-dimensional (triangles, factorised) and three-dimensional (bricks; assembled and solved by multigrid, and
    eliminated wave by wave). Both are held against the exact compliance of a bonded layer, which the tests check with
    an integration of the equations of elasticity through the depth. The energy of a wave converges at twice the degree
    of the element. Then comes the approach to the half-space that `lubfric` assumes. It is exponential for a wave. It
    is linear without bound for the mean, which a gap never sees because the approach takes it up. It goes with 1/d² for
    the shape under a narrow load, which decides how thick a layer has to be under a Hertz contact.
    """
    yield from plane_orders(level)
    yield from plane_finite(level)
    yield from brick_orders(level)
    yield from assembled(level)
    yield from approach(level)
    yield from narrow(level)


def plane_wave(cells: int, degree: int, depth: float = 0.5, body: Elastic = BODY) -> tuple[float, float]:
    """Return (compliance seen by the energy of a cosine, largest error of a displacement over its amplitude).

    ``depth`` is the thickness in wavelengths.
    """
    rows = max(4, round(depth * cells))
    mesh = MeshTri.init_tensor(np.linspace(-WAVE / 2, WAVE / 2, cells + 1), np.linspace(-depth * WAVE, 0, rows + 1))
    result = make_layer(mesh, body, degree=degree)
    pressure = np.cos(K * result.x)
    moved = result.displacement(pressure * result.weights)
    exact = layer_compliance(K, depth * WAVE, body)
    energy = (result.weights * pressure) @ moved / ((result.weights * pressure) @ pressure)
    return float(energy), float(np.abs(moved / exact - pressure).max())


def plane_orders(level: str) -> Iterator[Item]:
    """Plane strain: orders of P1 and P2 on one wave."""
    exact = layer_compliance(K, WAVE / 2, BODY)
    series = []
    source = "element theory, energy of a smooth load"
    for degree, cells in ((1, 2 * np.array(CELLS[level])), (2, np.array(CELLS[level]))):
        values = [plane_wave(n, degree) for n in cells]
        energy = np.abs([f[0] / exact - 1 for f in values])
        name = f"plane layer P{degree}"
        order = 2 * degree
        check = f"{name}: order of the compliance"
        series.append(
            Series(
                f"P{degree}",
                WAVE / cells,
                errors=energy,
                order=order,
                check=check,
                tolerance=0.2,
                source=source,
                finest=2,
            )
        )
        if degree == 2:  # for P1 the two coincide
            series.append(Series("P2, nodes", WAVE / cells, errors=[f[1] for f in values], order=degree + 1))
        allowed = {1: 40, 2: 60}[degree] / cells[-1] ** order
        yield from compared(name, [("compliance at kd = π", "m/Pa", values[-1][0], float(exact), allowed)], SOURCE)
    caption = "Plane-strain layer, half a wavelength thick: relative error of the compliance of a wave, from its "
    caption += "energy, and for P2 largest error of a displacement at a node."
    yield from convergence("layer_plane", caption, series, "cell length (m)", "relative error")


def plane_finite(level: str) -> Iterator[Item]:
    """Plane strain at several depths and Poisson's ratios."""
    rows = []
    cells = 24 if level == "quick" else 48
    for poisson in (0.0, 0.3, 0.45):
        body = Elastic.from_e_prime(BODY.e_prime, poisson)
        for s in (0.3, 1.0, 3.0) if level == "quick" else (0.3, 1.0, 3.0, 6.0):
            depth = s / (2 * np.pi)
            result = plane_wave(cells, 2, depth, body)[0]
            exact = float(layer_compliance(K, depth * WAVE, body))
            rows.append((poisson, s, result, exact, abs(result / exact - 1)))
    columns = ("Poisson's ratio", "kd", "finite elements (m/Pa)", "exact (m/Pa)", "relative error")
    yield Table("layer_finite", f"Compliance of a bonded layer, P2, {cells} cells per wavelength", columns, rows)
    worst = max(r[-1] for r in rows)
    yield bound("plane layer: worst of several depths and Poisson's ratios", worst, 500 / cells**4, SOURCE)
    thin = make_layer(MeshTri.init_tensor(np.linspace(-0.5, 0.5, 5), np.linspace(-0.3, 0, 4)), BODY)
    pressed = [("uniform pressure", "m/Pa", thin.displacement(thin.weights).mean(), 0.3 / BODY.oedometric, 1e-9)]
    yield from compared("plane layer", pressed, "compression without lateral strain")


def brick(nodes: int, degree: int, depth: float = 1.0, layers: int | None = None) -> Layer3D:
    """Return a square period of one wavelength, ``depth`` wavelengths thick."""
    levels = graded_levels(depth * WAVE, layers or nodes // degree, 4.0)
    return Layer3D(body=BODY, size=(WAVE, WAVE), levels=levels, shape=(nodes, nodes), degree=degree)


def brick_orders(level: str) -> Iterator[Item]:
    """Three dimensions: orders of trilinear and triquadratic bricks on a wave askew to the grid."""
    exact = layer_compliance(K * np.sqrt(5), WAVE, BODY)
    series = []
    source = "element theory, energy of a smooth load"
    for degree in (1, 2):
        nodes = 2 * np.array(CELLS[level] if degree == 1 or level == "full" else CELLS[level][:-1])
        errors = []
        for n in nodes:
            grid = brick(n, degree)
            x, y = grid.x
            pressure = np.cos(K * (x + 2 * y))
            force = pressure * grid.weights
            energy = np.sum(fourier_compliance(grid).displacement(force) * force) / np.sum(pressure * force)
            errors.append(abs(energy / exact - 1))
        check = f"layer of bricks Q{degree}: order of the compliance"
        series.append(
            Series(
                f"Q{degree}",
                WAVE / nodes,
                errors=errors,
                order=2 * degree,
                check=check,
                tolerance=0.2,
                source=source,
                finest=2,
            )
        )
    name = f"layer of bricks Q2: compliance of a wave askew, {nodes[-1]}² nodes"
    yield bound(name, errors[-1], 1e-3, SOURCE)
    caption = "Three-dimensional layer, one wavelength thick: error of the compliance of the wave (1, 2)."
    yield from convergence("layer_bricks", caption, series, "node spacing (m)", "relative error of the compliance")


def assembled(level: str) -> Iterator[Item]:
    """The assembled layer by multigrid against the same layer wave by wave, and the effect of the rigid-body modes."""
    n = MULTIGRID[level]
    rows = []
    for degree in (1, 2):
        grid = brick(n, degree, layers=n // (4 * degree))
        force = np.random.default_rng(7).standard_normal(grid.shape) * grid.weights
        waves = fourier_compliance(grid).displacement(force)
        modes = rigid_body_modes(grid)
        spaces = {"rigid-body modes": modes} | ({"translations": modes[:, :3]} if degree == 1 else {})
        for name, space in spaces.items():
            solved = solve(multigrid(grid, space), force, tolerance=1e-9, max_iterations=300)
            off = float(np.abs(solved.surface - waves).max() / np.abs(waves).max())
            rows.append((f"Q{degree}", grid.unknowns, name, solved.report.iterations, solved.report.residual, off))
        first_row = next(r for r in rows if r[0] == f"Q{degree}")
        name = f"Q{degree}, {n}² nodes: multigrid against wave by wave"
        source = "the same layer, another elimination"
        yield bound(name, first_row[-1], 1e-7, source, f"{first_row[1]} unknowns, {first_row[3]} iterations to 1e-9")
    name = "Q1: iterations with rigid-body modes over those with translations alone"
    yield bound(name, rows[0][3] / rows[1][3], 0.9, "smoothed aggregation needs the near-null space")
    caption = "Conjugate gradients with smoothed aggregation on the assembled layer under random forces"
    columns = ("element", "unknowns", "near-null space", "iterations", "residual", "largest difference, wave by wave")
    yield Table("layer_multigrid", caption, columns, rows)


def approach(level: str) -> Iterator[Item]:
    """How a wave on the layer nears the same wave on the half-space."""
    depths = np.arange(0.5, 5.1 if level == "quick" else 7.1, 0.5)
    nu = BODY.poisson
    cells = {"quick": 32, "default": 48, "full": 64}[level]

    def missing_compliance(cells_deep: float) -> float:
        return float(1 - plane_wave(cells, 2, cells_deep)[0] / half_space_compliance(K, BODY))

    values = np.array([missing_compliance(s / (2 * np.pi)) for s in depths])
    exact = np.array([missing(s, nu) for s in depths])
    polynomial = (4 * depths**2 + 4 * depths + 2 * (5 - 12 * nu + 8 * nu**2)) / (3 - 4 * nu)
    floor = abs(missing_compliance(2.0))
    far = (depths >= 3) & (exact > 100 * floor)
    exponent = np.polyfit(depths[far], np.log(np.abs(values[far]) / polynomial[far]), 1)[0]
    source = "expansion of the exact compliance, q(kd) exp(-2 kd)"
    yield Check(
        "wave on a thick layer: exponent of the approach to the half-space",
        exponent,
        expected=-2,
        tolerance=0.02,
        source=source,
    )
    worst = np.max(np.abs(values - exact))
    allowed = {"quick": 5e-5, "default": 1e-5, "full": 3e-6}[level]
    note = "1 - C/C(half-space), absolute"
    yield bound("wave on a layer: worst departure of the missing compliance", worst, allowed, SOURCE, note)


def bending(result: Layer) -> float:
    """Return curvature that a layer adds under a narrow load, over ``4 w/(pi E' b^2)``; for a thick layer it is J
    (b/d)^2.

    The pressure is ``p0 (1 - X^2)^1.5`` with X = x/b. A half-space sinks under it by ``(p0 b/E')(X^4 - 3 X^2)`` and a
    constant (from ``PV integral sqrt(1 - s^2) U_n(s)/(x - s) ds = pi T_(n+1)(x)``). The rest is fitted.
    """
    big = result.x / HALF_WIDTH
    b = HALF_WIDTH
    force = np.maximum(1 - big**2, 0) ** 1.5 * result.weights
    extra = result.displacement(force) - b / BODY.e_prime * (big**4 - 3 * big**2)
    inside = np.abs(big) < 1
    curvature = 2 * np.polynomial.Polynomial.fit(big[inside], extra[inside], 4).convert().coef[2]
    return float(curvature / (4 * (3 * np.pi / 8) * b / (np.pi * BODY.e_prime)))


def narrow(level: str) -> Iterator[Item]:
    """The shape of the surface under a narrow load, with periodic and with free sides: 1/d² and its coefficient."""
    b = HALF_WIDTH
    depths = b * np.array([5, 10, 20] if level == "quick" else [5, 10, 20, 40])
    deepest = 2 * depths[-1]
    fine = b / 20

    def at(depth: float, sides: str = "periodic") -> float:
        mesh = graded_mesh(8 * depth, depth, 1.5 * b, fine)
        return bending(make_layer(mesh, BODY, strip=1.5 * b, sides=sides))

    # depths are powers of two apart, the meshes near the load alike: their error drops out of differences
    base = at(deepest)
    number = curvature_number(BODY.poisson)
    values = np.array([at(d) - base for d in depths])
    inverse = b**2 * (depths**-2.0 - deepest**-2.0)
    source = "expansion of the exact compliance for a load narrow against d"
    check = "narrow load: order in 1/d of the extra curvature"
    note = f"differences to a layer of {deepest / b:g} b"
    yield Series(
        "", np.sqrt(inverse), errors=values, order=2, check=check, tolerance=0.05, source=source, note=note, finest=3
    ).check_order()
    name = f"narrow load: extra curvature from d = {deepest / b:g} b to {depths[-1] / b:g} b"
    source = f"J b²/d², J = {number:.4f} by quadrature"
    yield Check(
        name, values[-1], expected=number * inverse[-1], tolerance=0.02, source=source, note="in units of 4w/(πE'b²)"
    )
    name = "narrow load, d = 10 b, width 8 d: curvature with free sides over periodic ones"
    yield Check(
        name,
        (at(depths[1], "free") - base) / values[1],
        expected=1,
        tolerance=0.01,
        source="sides so far do not matter",
    )
