"""Reynolds equation on a surface: manufactured solutions, finite width, rupture."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np
import skfem

from ...check import Check, Item, Table, bound, compared
from ...meshes import mesh_field
from ...types import BoolArray, FloatArray
from .. import exact
from ..convergence import Series, convergence
from ..solvers.fluid import Fluid, slope
from ..solvers.reynolds import ReynoldsProblem, ReynoldsSolution, solve_refined

if TYPE_CHECKING:
    from skfem.element.discrete_field import DiscreteField
    from skfem.mesh.mesh_quad_1 import MeshQuad1
    from skfem.mesh.mesh_tri_1 import MeshTri1


KINDS = {"line": skfem.MeshLine, "triangle": skfem.MeshTri, "quadrilateral": skfem.MeshQuad}
REFINEMENTS = {"quick": 2, "default": 3, "full": 4}
LENGTH = 0.01  # m, of the pad along the motion
WIDTH = 0.006  # m, of the pad
VISCOSITY = 0.1  # Pa s
SPEED = 1.0  # m/s, mean of both surfaces
INLET = 2e-6  # m, film at the inlet
OUTLET = 1e-6  # m, film at the outlet


def reynolds_surface(level: str) -> Iterator[Item]:
    """The Reynolds solver on surfaces, triangles and quadrilaterals of first and second order.

    A manufactured pressure in a compressible Roelands oil exercises every term of the weak form, and each element must
    show its own order. A pad with an exponential film has an exact series for any width, between the infinitely wide
    and the infinitely narrow pad. A parabolic film of infinite width must repeat the line, and one of finite width
    shows the rupture line bend.
    """
    yield from manufactured(REFINEMENTS[level])
    yield from finite_width(REFINEMENTS[level])
    yield from parabolic(REFINEMENTS[level])


class Manufactured:
    """``P sin(pi x/L) sin(pi y/B)`` (a line has no second factor), in an oil that thickens and compresses."""

    fluid = Fluid(
        VISCOSITY,
        viscosity_law="roelands",
        pressure_viscosity_coefficient=2e-8,
        roelands_index=0.65,
        density_law="dowson-higginson",
    )
    peak = 1.5e8

    def __init__(self, dimension: int):
        self.wave = np.pi / np.array([LENGTH, WIDTH][:dimension])

    def film(self, x: FloatArray) -> FloatArray:
        """Return film [m], sloping in x and bent in y."""
        return 1e-6 * (2 - x[0] / LENGTH + (0.3 * np.cos(2 * x[1] / WIDTH) if len(self.wave) > 1 else 0.0))

    def film_slope(self, x: FloatArray) -> FloatArray:
        """Return gradient of the film."""
        along = -1e-6 / LENGTH + 0 * x[0]
        if len(self.wave) == 1:
            return np.array([along])
        return np.array([along, -0.6e-6 / WIDTH * np.sin(2 * x[1] / WIDTH)])

    def pressure(self, x: DiscreteField | FloatArray) -> FloatArray:
        """Return the pressure to be found, Pa."""
        return self.peak * np.prod([np.sin(k * a) for k, a in zip(self.wave, x, strict=True)], axis=0)

    def gradient(self, x: FloatArray) -> FloatArray:
        """Return gradient of the pressure [Pa/m]."""
        sines = np.array([np.sin(k * a) for k, a in zip(self.wave, x, strict=True)])
        slopes = np.array([k * np.cos(k * a) for k, a in zip(self.wave, x, strict=True)])
        return self.peak * (slopes if len(self.wave) == 1 else slopes * sines[::-1])

    def source(self, x: FloatArray) -> FloatArray:
        """Return ``-div(D grad p) + d(rho U h)/dx`` derived by hand, with D = rho h^3/(12 eta)."""
        p = self.pressure(x)
        dp = self.gradient(x)
        h = self.film(x)
        dh = self.film_slope(x)
        f = self.fluid
        mobility = f.rho(p) * h**3 / (12 * f.eta(p))
        stiffening = slope(f.rho, p) / f.rho(p) - slope(f.log_viscosity, p)
        spread = mobility * (-(self.wave**2).sum() * p + stiffening * (dp * dp).sum(0) + 3 / h * (dh * dp).sum(0))
        return -spread + SPEED * (slope(f.rho, p) * dp[0] * h + f.rho(p) * dh[0])


def box(kind: str, cells: int, width: float = WIDTH, length: float = LENGTH) -> skfem.Mesh:
    """Return a mesh of 0..length, on surfaces times -width/2..width/2."""
    x = np.linspace(0, length, cells + 1)
    if kind == "line":
        return skfem.MeshLine(x)
    return KINDS[kind].init_tensor(x, np.linspace(-width / 2, width / 2, cells + 1))


def manufactured(refinements: int) -> Iterator[Item]:
    """The order of all six elements, and of the stabilised form."""
    series = []
    rows = []
    sizes = [LENGTH / (8 * 2**i) for i in range(refinements + 1)]
    for kind in KINDS:
        case = Manufactured(1 if kind == "line" else 2)
        mesh = box(kind, 8) if kind == "line" else box(kind, 8).translated((0.0, WIDTH / 2))
        for degree, form in ((1, "none"), (1, "supg"), (2, "none")):
            label = f"{kind} {'Q' if kind == 'quadrilateral' else 'P'}{degree}{' SUPG' if form == 'supg' else ''}"
            problem = ReynoldsProblem(
                mesh=mesh,
                film=case.film,
                fluid=case.fluid,
                speed=SPEED,
                degree=degree,
                source=case.source,
                stabilisation=form,
            )
            solution = solve_refined(problem, refinements)
            errors = [s.error(case.pressure) for s in solution]
            rows += [(label, round(LENGTH / h), e, s.report.iterations) for h, e, s in zip(sizes, errors, solution)]
            check = f"manufactured, {label}: order of the pressure error"
            series.append(Series(label, sizes, errors=errors, order=degree + 1, check=check, tolerance=0.15, finest=2))
    columns = ("element", "cells a side", "error", "Newton steps")
    yield Table("manufactured", "Manufactured pressure: relative L2 error.", columns, rows)
    caption = "Manufactured pressure of 150 MPa in a compressible Roelands oil: relative error in the L2 norm."
    yield from convergence("manufactured", caption, series, "cell length (m)", "relative pressure error")


def pad(ratio: float) -> exact.ExponentialPad:
    """Return the exact pad with this ratio of width to length."""
    return exact.ExponentialPad(
        viscosity=VISCOSITY, speed=SPEED, length=LENGTH, width=ratio * LENGTH, inlet=INLET, outlet=OUTLET
    )


def finite_width(refinements: int) -> Iterator[Item]:
    """Pads of all widths against the series, which runs between the two limits."""

    def solved(e: exact.ExponentialPad) -> ReynoldsSolution:
        return solve_refined(
            ReynoldsProblem(mesh=edged(e), film=e.film, fluid=Fluid(VISCOSITY), speed=SPEED, degree=2), refinements - 1
        )[-1]

    source = "separation of variables, exact series (verification.fem.exact.ExponentialPad)"
    results = {ratio: solved(pad(ratio)) for ratio in (0.05, 0.2, 1.0, 5.0, 20.0)}
    for ratio, s in results.items():
        name = f"exponential pad, width/length {ratio:g}"
        e = pad(ratio)
        yield from compared(name, [("load", "N", s.load, e.load, 1e-5 * 8.0 ** (2 - refinements))], source)
        yield bound(f"{name}: pressure error", s.error(e.pressure), 6e-4 * 4.0 ** (2 - refinements), source)
    e = pad(0.02)
    source = "infinitely narrow pad (Michell 1905, Ocvirk 1952)"
    note = "the ends take a part of the order of width/length"
    name = "exponential pad, width/length 0.02: load"
    yield Check(name, solved(e).load, expected=e.narrow_load, tolerance=0.03, source=source, unit="N", note=note)

    def side(x: FloatArray) -> BoolArray:
        return (x[0] > 1e-9) & (x[0] < LENGTH - 1e-9)

    closed = ReynoldsProblem(
        mesh=box("quadrilateral", 8), film=e.film, fluid=Fluid(VISCOSITY), speed=SPEED, degree=2, open_boundary=side
    )
    load = solve_refined(closed, refinements)[-1].load / WIDTH
    allowed = 1e-4 * 8.0 ** (1 - refinements)
    rows = [("load / width", "N/m", load, e.wide_load, allowed)]
    yield from compared("exponential pad, closed sides", rows, "infinitely wide pad, quadrature")
    s = results[1.0].problem.mesh
    p = results[1.0].at_vertices
    data = {"pressure": p, "film_thickness": e.film(s.p), "difference": p - pad(1.0).pressure(s.p)}
    caption = "Pad as wide as long: pressure (Pa), film (m), difference to the exact pressure (Pa)"
    yield mesh_field("pad", caption, s, data)


def edged(e: exact.ExponentialPad) -> skfem.MeshQuad:
    """Return a mesh of the pad with its lines crowded at the four edges, more so along the longer side."""

    def crowded(length: float, other: float) -> FloatArray:
        strength = np.clip(1.5 * np.log10(max(length / other, 1.0)) * 1.6, 0.5, 4.0)
        s = np.linspace(-1, 1, 17)
        return length * (1 + np.tanh(strength * s) / np.tanh(strength)) / 2

    return skfem.MeshQuad.init_tensor(crowded(e.length, e.width), crowded(e.width, e.length) - e.width / 2)


def parabolic(refinements: int) -> Iterator[Item]:
    """Rupture: infinite width repeats the line; finite width agrees on both kinds of cells and loses no mass."""
    e = exact.Parabola(viscosity=VISCOSITY, speed=SPEED, radius=0.01, film_thickness=1e-6, inlet=-10.0)
    x = np.sinh(np.linspace(-np.arcsinh(10), np.arcsinh(2), 25)) * e.scale

    def solved(
        mesh: MeshQuad1 | MeshTri1, degree: int, refinements: int, side: Callable[[FloatArray], BoolArray] | None = None
    ) -> ReynoldsSolution:
        problem = ReynoldsProblem(
            mesh=mesh,
            film=e.film,
            fluid=Fluid(VISCOSITY),
            speed=SPEED,
            degree=degree,
            cavitation=True,
            open_boundary=side,
        )
        return solve_refined(problem, refinements)[-1]

    def side(at: FloatArray) -> BoolArray:
        return (at[0] > x[0] + 1e-9) & (at[0] < x[-1] - 1e-9)

    for kind, degree in (("triangle", 1), ("quadrilateral", 1), ("triangle", 2), ("quadrilateral", 2)):
        s = solved(KINDS[kind].init_tensor(x, np.linspace(0, 4, 9) * e.scale), degree, refinements - 1, side)
        allowed = {1: 0.0125, 2: 6e-4}[degree] * 4.0 ** (2 - refinements)
        rows = [("load per width", "N/m", s.load / (4 * e.scale), e.load, allowed)]
        name = f"parabola on {kind}s of degree {degree}, infinitely wide"
        yield from compared(name, rows, "closed form with Reynolds' outlet (Martin 1916)")
    mesh = skfem.MeshQuad.init_tensor(x, np.linspace(-2, 2, 17) * e.scale)
    s = solved(mesh, 1, refinements)
    other = solved(mesh.to_meshtri(), 2, refinements - 1)
    name = "parabola of finite width"
    rows = [("load on quadrilaterals", "N", s.load, other.load, 0.1 * 4.0**-refinements)]
    yield from compared(name, rows, "triangles of degree 2")
    fed = s.reaction[s.reaction > 0].sum()
    lost = -s.reaction[s.reaction < 0].sum()
    note = "over all edges and the ruptured part"
    yield from compared(name, [("flow in and out", "m³/s", fed, lost, 1e-7)], "conservation of mass", note)
