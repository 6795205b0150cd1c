"""Reynolds equation on a surface: manufactured solutions, finite width, rupture, Gmsh meshes."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
import skfem

from .. import exact, plotting
from ..check import ABSOLUTE, AT_MOST, Check, Table
from ..fem.fluid import Fluid, slope
from ..fem.reynolds import Problem, Solution, solve_refined, solve_reynolds
from ..meshes import mesh_field, read_gmsh, read_vtu, write_gmsh, write_vtu
from ..rates import fitted_order

KINDS = {"line": skfem.MeshLine, "triangle": skfem.MeshTri, "quadrilateral": skfem.MeshQuad}
REFINEMENTS = {"quick": 2, "default": 3, "full": 4}
LENGTH, WIDTH = 0.01, 0.006
VISCOSITY, SPEED, INLET, OUTLET = 0.1, 1.0, 2e-6, 1e-6


def reynolds_surface(level: str):
    """The Reynolds solver on surfaces, triangles and quadrilaterals of first and second order.

    A manufactured pressure in a compressible Roelands oil exercises every term of the weak form, and each element must
    show its own order. A pad with an exponential film has an exact series for any width, between the infinitely wide
    and the infinitely narrow pad. A parabolic film of infinite width must repeat the line, and one of finite width
    shows the rupture line bend. The last check solves on a mesh that went through a Gmsh file.
    """
    yield from manufactured(REFINEMENTS[level])
    yield from finite_width(REFINEMENTS[level])
    yield from parabolic(REFINEMENTS[level])
    yield from files()


class Manufactured:
    """``P sin(pi x/L) sin(pi y/B)`` (a line has no second factor), in an oil that thickens and compresses."""

    fluid = Fluid(VISCOSITY, "roelands", 2e-8, 0.65, "dowson_higginson")
    peak = 1.5e8

    def __init__(self, dimension: int):
        self.wave = np.pi / np.array([LENGTH, WIDTH][:dimension])

    def film(self, x):
        """Film [m], sloping in x and bent in y."""
        return 1e-6 * (2 - x[0] / LENGTH + (0.3 * np.cos(2 * x[1] / WIDTH) if len(self.wave) > 1 else 0.0))

    def film_slope(self, x):
        """Gradient of the film."""
        along = -1e-6 / LENGTH + 0 * x[0]
        if len(self.wave) == 1:
            return np.array([along])
        return np.array([along, -0.6e-6 / WIDTH * np.sin(2 * x[1] / WIDTH)])

    def pressure(self, x):
        """The pressure to be found, Pa."""
        return self.peak * np.prod([np.sin(k * a) for k, a in zip(self.wave, x, strict=True)], axis=0)

    def gradient(self, x):
        """Gradient of the pressure [Pa/m]."""
        shape = [
            [
                (k * np.cos(k * a) if i == j else np.sin(k * a))
                for j, (k, a) in enumerate(zip(self.wave, x, strict=True))
            ]
            for i in range(len(self.wave))
        ]
        return self.peak * np.array([np.prod(s, axis=0) for s in shape])

    def source(self, x):
        """``-div(D grad p) + d(rho U h)/dx`` worked out by hand, with D = rho h^3/(12 eta)."""
        p, dp, h, dh, f = self.pressure(x), self.gradient(x), self.film(x), self.film_slope(x), self.fluid
        mobility = f.rho(p) * h**3 / (12 * f.eta(p))
        stiffening = slope(f.rho, p) / f.rho(p) - slope(f.log_viscosity, p)
        spread = mobility * (-(self.wave**2).sum() * p + stiffening * (dp * dp).sum(0) + 3 / h * (dh * dp).sum(0))
        return -spread + SPEED * (slope(f.rho, p) * dp[0] * h + f.rho(p) * dh[0])


def box(kind: str, cells: int, width: float = WIDTH, length: float = LENGTH) -> skfem.Mesh:
    """A mesh of 0..length, on surfaces times -width/2..width/2."""
    x = np.linspace(0, length, cells + 1)
    if kind == "line":
        return skfem.MeshLine(x)
    return KINDS[kind].init_tensor(x, np.linspace(-width / 2, width / 2, cells + 1))


def manufactured(refinements: int):
    """The order of all six elements, and of the stabilised form."""
    series, rows = {}, []
    for kind in KINDS:
        case = Manufactured(1 if kind == "line" else 2)
        for degree, stabilisation in ((1, "none"), (1, "supg"), (2, "none")):
            label = f"{kind} P{degree}" if kind != "quadrilateral" else f"{kind} Q{degree}"
            label += " SUPG" if stabilisation == "supg" else ""
            mesh = box(kind, 8)
            if kind != "line":
                mesh = mesh.translated((0.0, WIDTH / 2))
            found = solve_refined(
                Problem(mesh, case.film, case.fluid, SPEED, degree, case.source, stabilisation=stabilisation),
                refinements,
            )
            errors = [s.error(case.pressure) for s in found]
            sizes = [LENGTH / (8 * 2**i) for i in range(refinements + 1)]
            order = fitted_order(sizes[-2:], errors[-2:])
            rows += [
                (label, 8 * 2**i, e, s.report.iterations) for i, (e, s) in enumerate(zip(errors, found, strict=True))
            ]
            if stabilisation == "none":
                series[label] = (sizes, errors, degree + 1)
            yield Check(
                f"manufactured, {label}: order of the pressure error",
                order,
                degree + 1,
                0.15,
                "element theory, L2 norm",
                ABSOLUTE,
            )
    yield Table(
        "manufactured",
        "Manufactured pressure: relative L2 error.",
        ("element", "cells a side", "error", "Newton steps"),
        rows,
    )
    yield plotting.convergence(
        "manufactured",
        "Manufactured pressure of 150 MPa in a compressible Roelands oil: relative "
        "error in the L2 norm against cell length.",
        series,
        "cell length (m)",
        "relative pressure error",
    )


def finite_width(refinements: int):
    """Pads of all widths against the series, which runs between the two limits."""
    source = "separation of variables, exact series (verification.exact.ExponentialPad)"
    ratios, found = (0.05, 0.2, 1.0, 5.0, 20.0), []
    for ratio in ratios:
        e = exact.ExponentialPad(VISCOSITY, SPEED, LENGTH, ratio * LENGTH, INLET, OUTLET)
        s = solve_refined(Problem(edged(e), e.film, Fluid(VISCOSITY), SPEED, 2), refinements - 1)[-1]
        found.append(s.load)
        yield Check(
            f"exponential pad, width/length {ratio:g}: load",
            s.load,
            e.load,
            1e-5 * 8.0 ** (2 - refinements),
            source,
            unit="N",
        )
        yield Check(
            f"exponential pad, width/length {ratio:g}: pressure error",
            s.error(e.pressure),
            0.0,
            6e-4 * 4.0 ** (2 - refinements),
            source,
            AT_MOST,
        )
        if ratio == 1.0:
            pad = s
    e = exact.ExponentialPad(VISCOSITY, SPEED, LENGTH, 0.02 * LENGTH, INLET, OUTLET)
    narrow = solve_refined(Problem(edged(e), e.film, Fluid(VISCOSITY), SPEED, 2), refinements - 1)[-1]
    yield Check(
        "exponential pad, width/length 0.02: load / narrow limit",
        narrow.load / e.narrow_load,
        1.0,
        0.03,
        "infinitely narrow pad (Michell 1905, Ocvirk 1952)",
        note="the ends take a part of the order of width/length",
    )
    sides = Problem(
        box("quadrilateral", 8),
        e.film,
        Fluid(VISCOSITY),
        SPEED,
        2,
        open_boundary=lambda x: (x[0] > 1e-9) & (x[0] < LENGTH - 1e-9),
    )
    wide = solve_refined(sides, refinements)[-1]
    yield Check(
        "exponential pad, closed sides: load / width",
        wide.load / WIDTH,
        e.wide_load,
        1e-4 * 8.0 ** (1 - refinements),
        "infinitely wide pad, quadrature",
        unit="N/m",
    )
    yield width_figure(ratios, found)
    yield mesh_field(
        "pad",
        "Pad as wide as long: pressure (Pa), film (m), difference to the exact pressure (Pa)",
        pad.problem.mesh,
        {
            "pressure": pad.at_vertices,
            "film_thickness": pad.problem.film(pad.problem.mesh.p),
            "difference": pad.at_vertices - exact_pad().pressure(pad.problem.mesh.p),
        },
    )


def exact_pad() -> exact.ExponentialPad:
    """The exact pad that is as wide as it is long."""
    return exact.ExponentialPad(VISCOSITY, SPEED, LENGTH, LENGTH, INLET, OUTLET)


def edged(e: exact.ExponentialPad) -> skfem.MeshQuad:
    """A mesh of the pad with its lines crowded at the four edges, more so along the longer side."""

    def crowded(length, other):
        strength = np.clip(1.5 * np.log10(max(length / other, 1.0)) * 1.6, 0.5, 4.0)
        s = np.linspace(-1, 1, 17)
        return length * (1 + np.tanh(strength * s) / np.tanh(strength)) / 2

    return skfem.MeshQuad.init_tensor(crowded(e.length, e.width), crowded(e.width, e.length) - e.width / 2)


def width_figure(ratios, loads):
    """Load over width between the limits."""
    canvas, ax = plotting.axes()
    fine = np.geomspace(0.03, 40, 80)
    pads = [exact.ExponentialPad(VISCOSITY, SPEED, LENGTH, r * LENGTH, INLET, OUTLET) for r in fine]
    unit = pads[0].wide_load
    ax.loglog(fine, [p.load / p.width / unit for p in pads], "k-", linewidth=1, label="exact series")
    ax.loglog(fine, [p.narrow_load / p.width / unit for p in pads], ":", label="infinitely narrow")
    ax.axhline(1.0, color="C1", linestyle=":", label="infinitely wide")
    ax.loglog(
        ratios, np.array(loads) / (np.array(ratios) * LENGTH) / unit, "o", color="C2", label="finite elements, Q2"
    )
    ax.set(xlabel="width / length", ylabel="load per width / that of the infinitely wide pad", ylim=(3e-4, 3))
    ax.legend()
    return plotting.finish("width", canvas, "Load of a pad with an exponential film (2:1) against its width.")


def parabolic(refinements: int):
    """Rupture on a surface: infinite width repeats the line, finite width bends the rupture line."""
    e = exact.Parabola(VISCOSITY, SPEED, 0.01, 1e-6, -10.0)
    x = np.sinh(np.linspace(-np.arcsinh(10), np.arcsinh(2), 25)) * e.scale
    for kind, degree in (("triangle", 1), ("quadrilateral", 1), ("triangle", 2), ("quadrilateral", 2)):
        mesh = KINDS[kind].init_tensor(x, np.linspace(0, 4, 9) * e.scale)
        wide = Problem(
            mesh,
            e.film,
            Fluid(VISCOSITY),
            SPEED,
            degree,
            cavitation=True,
            open_boundary=lambda at: (at[0] > x[0] + 1e-9) & (at[0] < x[-1] - 1e-9),
        )
        s = solve_refined(wide, refinements - 1)[-1]
        yield Check(
            f"parabola on {kind}s of degree {degree}, infinitely wide: load per width",
            s.load / (4 * e.scale),
            e.load,
            {1: 0.0125, 2: 6e-4}[degree] * 4.0 ** (2 - refinements),
            "closed form with Reynolds' outlet (Martin 1916)",
            unit="N/m",
        )
    mesh = skfem.MeshQuad.init_tensor(x, np.linspace(-2, 2, 17) * e.scale)
    s = solve_refined(Problem(mesh, e.film, Fluid(VISCOSITY), SPEED, cavitation=True), refinements)[-1]
    other = Problem(mesh.to_meshtri(), e.film, Fluid(VISCOSITY), SPEED, 2, cavitation=True)
    yield Check(
        "parabola of finite width: load on quadrilaterals",
        s.load,
        solve_refined(other, refinements - 1)[-1].load,
        0.1 * 4.0**-refinements,
        "triangles of degree 2",
        unit="N",
    )
    fed, lost = s.reaction[s.reaction > 0].sum(), -s.reaction[s.reaction < 0].sum()
    yield Check(
        "parabola of finite width: flow in and out",
        fed,
        lost,
        1e-7,
        "conservation of mass",
        unit="m³/s",
        note="over all edges and the ruptured part",
    )
    yield rupture_figure(s, e)


def rupture_figure(s: Solution, e: exact.Parabola):
    """Pressure and the ruptured part on the surface."""
    canvas, ax = plotting.axes(width=6.4, height=4.2)
    points, p = s.problem.mesh.p / e.scale, s.at_vertices / e.pressure_scale
    shown = ax.tripcolor(
        *points, s.problem.mesh.to_meshtri().t.T, p, shading="gouraud", cmap="viridis", rasterized=True
    )
    ax.tricontour(*points, s.problem.mesh.to_meshtri().t.T, p, levels=[1e-3 * p.max()], colors="w", linewidths=1)
    ax.axvline(e.exit, color="w", linestyle=":")
    ax.set(xlim=(-2, 1), xlabel="x / √(2 R h₀)", ylabel="y / √(2 R h₀)", aspect="equal")
    ax.grid(False)
    canvas.colorbar(shown, ax=ax, label="p h₀² / (12 η U √(2 R h₀))", shrink=0.8)
    return plotting.finish(
        "rupture",
        canvas,
        "Pressure under a parabola with open sides at y = ±2. White line: a thousandth "
        "of the peak; dotted: where a film of infinite width ruptures.",
        "png",
    )


def files():
    """A Gmsh mesh is read and solved on; a VTU field comes back as it went out."""
    e, source = exact_pad(), "exact series of the pad"
    mesh = skfem.MeshTri.init_tensor(np.linspace(0, LENGTH, 41), np.linspace(-LENGTH / 2, LENGTH / 2, 41))
    with tempfile.TemporaryDirectory() as folder:
        path = write_gmsh(Path(folder) / "pad.msh", mesh.p.T, {"triangle": mesh.t.T})
        points, cells, _ = read_gmsh(path)
        copy = skfem.MeshTri(points[:, :2].T, cells["triangle"].T)
        s = solve_reynolds(Problem(copy, e.film, Fluid(VISCOSITY), SPEED, 2))
        field = mesh_field("pad", "", copy, {"pressure": s.at_vertices})
        back = read_vtu(write_vtu(Path(folder) / "pad.vtu", field))
    yield Check("mesh from a Gmsh file: load", s.load, e.load, 1e-5, source, unit="N")
    yield Check(
        "VTU round trip: largest change of a pressure",
        np.abs(back.point_data["pressure"] - s.at_vertices).max(),
        0.0,
        0.0,
        "the field that was written",
        ABSOLUTE,
        unit="Pa",
    )
