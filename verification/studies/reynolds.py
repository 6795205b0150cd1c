"""Reynolds equation on a line: closed forms, rupture, piezoviscosity, and a wave Galerkin rings on."""

from __future__ import annotations

import numpy as np
import skfem

from .. import exact, plotting
from ..check import ABSOLUTE, AT_LEAST, AT_MOST, Check, Table
from ..fem.fluid import Fluid
from ..fem.reynolds import Problem, Solution, solve_refined, solve_reynolds
from ..rates import fitted_order

REFINEMENTS = {"quick": 3, "default": 5, "full": 6}
SLIDER = exact.Slider(viscosity=0.1, speed=1.0, length=0.01, inlet=2e-6, outlet=1e-6)
PARABOLA = exact.Parabola(viscosity=0.1, speed=1.0, radius=0.01, film_thickness=1e-6, inlet=-100.0)
AMBIENT = 1e5
GAS = exact.Slider(viscosity=1.8e-5, speed=200.0, length=0.01, inlet=4e-6, outlet=2e-6)


def reynolds(level: str):
    """The Reynolds solver of the finite-element side, for given films, against results that need no solver.

    A plane slider has a closed form for pressure, load and flow. Under a parabola the film ruptures; where it
    does is part of the solution, found by complementarity (p >= 0, no flow lost where p > 0). Barus and
    Roelands oils in a rigid gap follow exactly from the isoviscous pressure by the reduced pressure. Where
    density follows pressure, pressure is also carried along by the flow, and on a coarse mesh the plain
    Galerkin form rings: shown for a gas at a high bearing number, with the stabilised form beside it.
    """
    yield from slider(REFINEMENTS[level])
    yield from parabola(REFINEMENTS[level])
    yield from piezoviscous(REFINEMENTS[level] - 1)
    yield from ringing()


def slider(refinements: int):
    """A plane slider: orders of P1 and P2, load and flow."""
    source = "closed form, Rayleigh 1918, doi:10.1080/14786440108635730"
    series = {}
    for degree in (1, 2):
        mesh = skfem.MeshLine(np.linspace(0, SLIDER.length, 9))
        found = solve_refined(Problem(mesh, SLIDER.film, Fluid(SLIDER.viscosity), SLIDER.speed, degree), refinements)
        sizes = [SLIDER.length / s.problem.mesh.nelements for s in found]
        errors = [s.error(SLIDER.pressure) for s in found]
        series[f"P{degree}"] = (sizes, errors, degree + 1)
        yield Check(
            f"slider P{degree}: order of the pressure error",
            fitted_order(sizes[-3:], errors[-3:]),
            degree + 1,
            0.1,
            "element theory, L2 norm",
            ABSOLUTE,
        )
        yield Check(
            f"slider P{degree}: load",
            found[-1].load,
            SLIDER.load,
            10 * (sizes[-1] / SLIDER.length) ** (2 * degree),
            source,
            unit="N/m",
        )
        yield Check(
            f"slider P{degree}: flow",
            found[-1].inflow(0.0),
            SLIDER.flow,
            (sizes[-1] / SLIDER.length) ** (2 * degree),
            source,
            unit="m²/s",
        )
    yield plotting.convergence(
        "slider",
        "Plane slider: pressure error in the L2 norm, relative, against cell length. "
        "Dotted: the order element theory expects.",
        series,
        "cell length (m)",
        "relative pressure error",
    )


def parabola_mesh(cells: int, inlet: float = PARABOLA.inlet, shift: float = 0.0) -> skfem.MeshLine:
    """Cells that are fine where the film is thin, with the inlet to X = 2. ``shift`` moves the nodes by a part of a
    cell."""
    span = np.arcsinh(2) + np.arcsinh(-inlet)
    stretched = np.linspace(-np.arcsinh(-inlet), np.arcsinh(2) + shift * span / cells, cells + 1)
    return skfem.MeshLine(np.sinh(stretched) * PARABOLA.scale)


def parabola(refinements: int):
    """A parabolic film with a free rupture point: the constants of the rigid isoviscous cylinder.

    It is chance where in its cell the rupture point lies, so errors are root mean squares over shifted meshes.
    """
    e, series = PARABOLA, {}
    rows: list[tuple] = []
    for degree in (1, 2):
        runs = [
            solve_refined(
                Problem(parabola_mesh(50, shift=shift), e.film, Fluid(e.viscosity), e.speed, degree, cavitation=True),
                refinements,
            )
            for shift in np.arange(8) / 8
        ]
        errors = np.sqrt(np.mean([[s.error(e.pressure) ** 2 for s in found] for found in runs], axis=0))
        found = runs[0]
        sizes = [1 / s.problem.mesh.nelements for s in found]
        series[f"P{degree}"] = (sizes, errors, 2)
        rows += [
            (f"P{degree}", s.problem.mesh.nelements, float(error), *constants(s), s.report.iterations)
            for s, error in zip(found, errors, strict=True)
        ]
        yield from parabola_checks(found[-1], sizes, errors, degree)
    names = ("load/(ηUR/h₀)", "rupture x/√(2Rh₀)", "Couette/(ηΔu√(R/h₀))", "rolling/(ηuₛ√(R/h₀))")
    rows.append(("exact", "", "", *exact_constants(), ""))
    yield Table(
        "parabola",
        "Parabolic film flooded from X = -100 with Reynolds' outlet. With the inlet at infinity the "
        "four constants are 4.894968, 0.4751299, 2.848722 and 2.300538.",
        ("element", "cells", "pressure error", *names, "Newton steps"),
        rows,
    )
    yield plotting.convergence(
        "parabola",
        "Parabolic film: relative pressure error. Rupture is found at a node, "
        "where the true pressure is of order h², so order 2 is all that any element has.",
        series,
        "1 / cells",
        "relative pressure error",
    )
    yield parabola_figure()


def load_scale() -> float:
    """eta U R/h0 in N/m."""
    return PARABOLA.viscosity * PARABOLA.speed * PARABOLA.radius / PARABOLA.film_thickness


def couette_scale() -> float:
    """eta sqrt(R/h0) in N s/m^2."""
    return PARABOLA.viscosity * np.sqrt(PARABOLA.radius / PARABOLA.film_thickness)


def constants(s: Solution) -> tuple[float, float, float, float]:
    """Load, rupture point, Couette and rolling friction, without dimension. At rupture, U h is the flow."""
    e = PARABOLA
    film = s.inflow(s.problem.mesh.p.min()) / e.speed
    couette, rolling = s.friction(1.0)
    return (
        s.load / load_scale(),
        float(np.sqrt(film / e.film_thickness - 1)),
        couette / couette_scale(),
        rolling / (2 * e.speed * couette_scale()),
    )


def exact_constants() -> tuple[float, float, float, float]:
    """What `constants` should be."""
    e = PARABOLA
    return (e.load / load_scale(), e.exit, e.couette / couette_scale(), e.rolling / (2 * e.speed * couette_scale()))


def parabola_checks(finest: Solution, sizes, errors, degree: int):
    """Checks of one element on its finest mesh."""
    label, source = (f"parabola P{degree}", "closed form with Reynolds' outlet, inlet at X = -100 (Martin 1916)")
    names = ("load", "rupture point", "Couette friction", "rolling friction")
    # the Couette integral runs over whole cells under pressure; the last one is cut by the rupture point
    cell = np.sqrt(2) * np.diff(np.sort(finest.problem.mesh.p[0]))[-1] / PARABOLA.scale
    yield Check(
        f"{label}: order of the pressure error",
        fitted_order(sizes, errors),
        2.0,
        0.15,
        "rupture is held at a node, where the true pressure is O(h²): 2 for either element",
        ABSOLUTE,
    )
    for name, found, true in zip(names, constants(finest), exact_constants(), strict=True):
        if name == "Couette friction":
            yield Check(f"{label}: {name}", found, true, cell, source, ABSOLUTE, note="within the last cell")
        else:
            yield Check(f"{label}: {name}", found, true, {1: 60, 2: 6}[degree] * sizes[-1] ** 2, source)
    if degree == 2:
        yield Check(
            "parabola P2: load against the inlet at infinity",
            constants(finest)[0],
            4.8950,
            5e-4,
            "rigid isoviscous cylinder, Martin 1916",
            note="the inlet at X = -100 costs 2.5e-4",
        )


def parabola_figure():
    """Pressure on a coarse and a fine mesh beside the closed form, with the rupture point enlarged."""
    e = PARABOLA
    canvas, (wide, close) = plotting.axes(1, 2, width=7.2, height=3.4)
    x = np.linspace(-3, 2, 2001)[None] * e.scale
    for ax in (wide, close):
        ax.plot(x[0] / e.scale, e.pressure(x) / e.pressure_scale, "k-", label="closed form", linewidth=1)
    for cells, style in ((50, "o"), (200, ".")):
        coarse = solve_refined(Problem(parabola_mesh(cells), e.film, Fluid(e.viscosity), e.speed, cavitation=True), 0)[
            0
        ]
        order = np.argsort(coarse.problem.mesh.p[0])
        big_x, p = coarse.problem.mesh.p[0, order] / e.scale, coarse.at_vertices[order] / e.pressure_scale
        for ax in (wide, close):
            ax.plot(big_x, p, style, label=f"P1, {cells} cells", markersize=4)
    wide.set(xlim=(-3, 1), xlabel="x / √(2 R h₀)", ylabel="p h₀² / (12 η U √(2 R h₀))")
    close.set(xlim=(0.2, 0.7), ylim=(-0.002, 0.022), xlabel="x / √(2 R h₀)", title="rupture")
    close.axvline(e.exit, color="0.5", linewidth=0.8, linestyle=":")
    wide.legend()
    return plotting.finish(
        "parabola_pressure",
        canvas,
        "Pressure under a parabola, finite elements and closed form; right: "
        "the rupture point (dotted), which no mesh was told.",
    )


def piezoviscous(refinements: int):
    """Barus and Roelands oils in the parabolic gap, which are exact through the reduced pressure."""
    base = exact.Parabola(viscosity=0.04, speed=1.0, radius=0.01, film_thickness=1e-6, inlet=-10.0)
    peak = base.pressure(np.linspace(-2, 1, 200_001)[None] * base.scale).max()
    alpha = 0.99 / peak
    exponent, index = alpha * 1.96e8 / 0.6, 0.6
    fast = exact.Parabola(0.04, 60.0, 0.01, 1e-6, -10.0)
    strong = 2e-8
    cases = (
        ("Barus", base, Fluid(0.04, "barus", alpha), lambda q: exact.reduced_to_true(q, alpha)),
        (
            "Roelands, low pressure",
            base,
            Fluid(0.04, "roelands", alpha, index),
            lambda q: exact.roelands_to_true(q, exponent, index),
        ),
        (
            "Roelands, high pressure",
            fast_film(fast, strong, index),
            Fluid(0.04, "roelands", strong, index),
            lambda q: exact.roelands_to_true(q, strong * 1.96e8 / index, index),
        ),
    )
    for name, e, fluid, to_true in cases:
        s = solve_refined(Problem(parabola_mesh(100, -10.0), e.film, fluid, e.speed, 2, cavitation=True), refinements)[
            -1
        ]
        at = np.linspace(0, s.problem.mesh.nvertices - 1, 61).astype(int)
        true = to_true(e.pressure(s.problem.mesh.p[:, at]))
        error = np.abs(s.at_vertices[at] - true).max() / true.max()
        growth = float(fluid.log_viscosity(true.max()))
        yield Check(
            f"{name}: largest pressure error / peak",
            error,
            0.0,
            1.5e-4 * 4.0 ** (2 - refinements),
            "isoviscous closed form and the reduced pressure (Blok 1963)",
            AT_MOST,
            note=f"peak {true.max() / 1e9:.3f} GPa, viscosity up to e^{growth:.1f} times",
        )


def fast_film(e: exact.Parabola, alpha: float, index: float) -> exact.Parabola:
    """The same gap at the speed at which a Roelands oil reaches 0.5 GPa."""
    s = np.linspace(0, 5e8, 20_001)
    reduced = np.trapezoid(np.exp(-alpha * 1.96e8 / index * ((1 + s / 1.96e8) ** index - 1)), s)
    peak = e.pressure(np.linspace(-2, 1, 200_001)[None] * e.scale).max()
    return exact.Parabola(e.viscosity, e.speed * reduced / peak, e.radius, e.film_thickness, e.inlet)


def ringing():
    """Gas slider at bearing number 1080: Galerkin P1 rings on a coarse mesh, SUPG does not; both converge."""
    fluid = Fluid(GAS.viscosity, density_law="linear", bulk_modulus=AMBIENT)
    number = 12 * GAS.viscosity * GAS.speed * GAS.length / (AMBIENT * GAS.outlet**2)
    source = "isothermal gas slider (Harrison 1913) integrated upstream to 1e-9"
    canvas, ax = plotting.axes()
    fine = np.linspace(0, GAS.length, 2001)
    ax.plot(fine / GAS.length, exact.gas_slider(GAS, AMBIENT, fine) / AMBIENT, "k-", linewidth=1, label="exact")
    for label, stabilisation, style in (("Galerkin", "none", "o--"), ("SUPG", "supg", "s-")):
        sizes, errors, over = [], [], []
        for cells in (20, 1280, 2560):
            x = np.linspace(0, GAS.length, cells + 1)
            s = solve_reynolds(Problem(skfem.MeshLine(x), GAS.film, fluid, GAS.speed, stabilisation=stabilisation))
            true = exact.gas_slider(GAS, AMBIENT, x)
            sizes.append(GAS.length / cells)
            errors.append(s.error(lambda at: np.reshape(exact.gas_slider(GAS, AMBIENT, np.ravel(at[0])), at[0].shape)))
            over.append(np.abs(np.diff(s.at_vertices)).sum() / np.abs(np.diff(true)).sum() - 1)
            if cells == 20:
                ax.plot(x / GAS.length, s.at_vertices / AMBIENT, style, label=f"{label}, 20 cells", linewidth=1)
        rings = stabilisation == "none"
        yield Check(
            f"gas slider, {label}: excess variation on 20 cells",
            over[0],
            1.0 if rings else 0.0,
            0.0 if rings else 0.01,
            source,
            AT_LEAST if rings else AT_MOST,
            note="rings, as it must where nothing is added" if rings else "does not ring",
        )
        yield Check(
            f"gas slider, {label}: order of the pressure error",
            fitted_order(sizes[-2:], errors[-2:]),
            2.0,
            0.2,
            "element theory, L2 norm",
            ABSOLUTE,
        )
        yield Check(f"gas slider, {label}: finest pressure error", errors[-1], 0.0, 5e-3, source, AT_MOST)
    ax.set(xlabel="x / L", ylabel="gauge pressure / ambient", title=f"gas slider, bearing number {number:.0f}")
    ax.legend()
    yield plotting.finish(
        "ringing",
        canvas,
        "Isothermal gas under a plane slider on 20 cells. The density carries the "
        "pressure downstream: plain Galerkin rings, the streamline-upwind form does not.",
    )
