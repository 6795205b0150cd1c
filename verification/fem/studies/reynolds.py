"""Reynolds equation on a line: closed forms, rupture, piezoviscosity, and a wave Galerkin rings on."""

from collections.abc import Iterator

import numpy as np
import skfem

from ...check import ABSOLUTE, AT_LEAST, Check, Item, Table, bound, compared
from ...types import Law, TableRow
from .. import exact
from ..convergence import Series, convergence
from ..solvers.fluid import Fluid
from ..solvers.reynolds import ReynoldsProblem, ReynoldsSolution, solve_refined, solve_reynolds

REFINEMENTS = {"quick": 3, "default": 5, "full": 6}
SLIDER = exact.Slider(viscosity=0.1, speed=1.0, length=0.01, inlet=2e-6, outlet=1e-6)
PARABOLA = exact.Parabola(viscosity=0.1, speed=1.0, radius=0.01, film_thickness=1e-6, inlet=-100.0)
AMBIENT = 1e5  # Pa, pressure around the gas film
GAS = exact.Slider(viscosity=1.8e-5, speed=200.0, length=0.01, inlet=4e-6, outlet=2e-6)


def reynolds(level: str) -> Iterator[Item]:
    """The Reynolds solver of the finite-element side, for given films, compared with results that need no solver.

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


def slider(refinements: int) -> Iterator[Item]:
    """A plane slider: orders of P1 and P2, load and flow."""
    series = []
    for degree in (1, 2):
        mesh = skfem.MeshLine(np.linspace(0, SLIDER.length, 9))
        solution = solve_refined(
            ReynoldsProblem(
                mesh=mesh, film=SLIDER.film, fluid=Fluid(SLIDER.viscosity), speed=SLIDER.speed, degree=degree
            ),
            refinements,
        )
        sizes = [SLIDER.length / s.problem.mesh.nelements for s in solution]
        errors = [s.error(SLIDER.pressure) for s in solution]
        name = f"slider P{degree}"
        series.append(
            Series(
                f"P{degree}",
                sizes,
                errors=errors,
                order=degree + 1,
                check=f"{name}: order of the pressure error",
                tolerance=0.1,
                finest=3,
            )
        )
        allowed = (sizes[-1] / SLIDER.length) ** (2 * degree)
        rows = (
            ("load", "N/m", solution[-1].load, SLIDER.load, 10 * allowed),
            ("flow", "m²/s", solution[-1].inflow(0.0), SLIDER.flow, allowed),
        )
        yield from compared(name, rows, "closed form, Rayleigh 1918, doi:10.1080/14786440108635730")
    caption = "Plane slider: pressure error in the L2 norm, relative, against cell length. Dotted: the expected order."
    yield from convergence("slider", caption, series, "cell length (m)", "relative pressure error")


def parabola_mesh(cells: int, inlet: float = PARABOLA.inlet, shift: float = 0.0) -> skfem.MeshLine:
    """Return cells that are fine where the film is thin, up to X = 2. ``shift`` moves the nodes by a part of a cell."""
    span = np.arcsinh(2) + np.arcsinh(-inlet)
    stretched = np.linspace(-np.arcsinh(-inlet), np.arcsinh(2) + shift * span / cells, cells + 1)
    return skfem.MeshLine(np.sinh(stretched) * PARABOLA.scale)


def ruptured(
    e: exact.Parabola, mesh: skfem.MeshLine, degree: int, refinements: int, fluid: Fluid | None = None
) -> list[ReynoldsSolution]:
    """Return solutions with a free rupture point on a mesh and its refinements."""
    problem = ReynoldsProblem(
        mesh=mesh, film=e.film, fluid=fluid or Fluid(e.viscosity), speed=e.speed, degree=degree, cavitation=True
    )
    return solve_refined(problem, refinements)


def parabola(refinements: int) -> Iterator[Item]:
    """A parabolic film with a free rupture point: the constants of the rigid isoviscous cylinder.

    It is chance where in its cell the rupture point lies, so errors are root mean squares over shifted meshes.
    """
    e = PARABOLA
    series = []
    rows: list[TableRow] = []
    for degree in (1, 2):
        runs = [ruptured(e, parabola_mesh(50, shift=shift), degree, refinements) for shift in np.arange(8) / 8]
        errors = np.sqrt(np.mean([[s.error(e.pressure) ** 2 for s in result] for result in runs], axis=0))
        result = runs[0]
        sizes = [1 / s.problem.mesh.nelements for s in result]
        why = "rupture is held at a node, where the true pressure is O(h²): 2 for either element"
        check = f"parabola P{degree}: order of the pressure error"
        series.append(Series(f"P{degree}", sizes, errors=errors, order=2, check=check, tolerance=0.15, source=why))
        rows += [
            (f"P{degree}", s.problem.mesh.nelements, float(error), *constants(s), s.report.iterations)
            for s, error in zip(result, errors, strict=True)
        ]
        yield from parabola_checks(result[-1], sizes[-1], degree)
    names = ("load/(ηUR/h₀)", "rupture x/√(2Rh₀)", "Couette/(ηΔu√(R/h₀))", "rolling/(ηuₛ√(R/h₀))")
    rows.append(("exact", "", "", *exact_constants(), ""))
    caption = "Parabolic film flooded from X = -100 with Reynolds' outlet. With the inlet at infinity the constants "
    caption += "are 4.894968, 0.4751299, 2.848722 and 2.300538."
    yield Table("parabola", caption, ("element", "cells", "pressure error", *names, "Newton steps"), rows)
    caption = "Parabolic film: relative pressure error."
    yield from convergence("parabola", caption, series, "1 / cells", "relative pressure error")


def scaled(load: float, exit: float, couette: float, rolling: float) -> tuple[float, float, float, float]:
    """Return load, rupture point, Couette friction of unit sliding speed, and rolling friction, without dimension."""
    e = PARABOLA
    friction = e.viscosity * np.sqrt(e.radius / e.film_thickness)
    lift = e.viscosity * e.speed * e.radius / e.film_thickness
    return load / lift, float(exit), couette / friction, rolling / (2 * e.speed * friction)


def constants(s: ReynoldsSolution) -> tuple[float, float, float, float]:
    """Return the four numbers of a solution. At rupture, U h is the flow."""
    film = s.inflow(s.problem.mesh.p.min()) / PARABOLA.speed
    return scaled(s.load, np.sqrt(film / PARABOLA.film_thickness - 1), *s.friction(1.0))


def exact_constants() -> tuple[float, float, float, float]:
    """Return what `constants` should be."""
    return scaled(PARABOLA.load, PARABOLA.exit, PARABOLA.couette, PARABOLA.rolling)


def parabola_checks(finest: ReynoldsSolution, size: float, degree: int) -> Iterator[Item]:
    """Checks of one element on its finest mesh."""
    source = "closed form with Reynolds' outlet, inlet at X = -100 (Martin 1916)"
    result = constants(finest)
    true = exact_constants()
    near = {1: 60, 2: 6}[degree] * size**2
    for i, name in ((0, "load"), (1, "rupture point"), (3, "rolling friction")):
        yield Check(f"parabola P{degree}: {name}", result[i], expected=true[i], tolerance=near, source=source)
    # the Couette integral runs over whole cells under pressure; the last one is cut by the rupture point
    cell = np.sqrt(2) * np.diff(np.sort(finest.problem.mesh.p[0]))[-1] / PARABOLA.scale
    name = f"parabola P{degree}: Couette friction"
    yield Check(
        name, result[2], expected=true[2], tolerance=cell, source=source, kind=ABSOLUTE, note="within the last cell"
    )


def piezoviscous(refinements: int) -> Iterator[Item]:
    """Barus and Roelands oils in the parabolic gap, which are exact through the reduced pressure."""
    base = exact.Parabola(viscosity=0.04, speed=1.0, radius=0.01, film_thickness=1e-6, inlet=-10.0)
    index = 0.6
    strong = 2e-8
    alpha = 0.99 / base.pressure(np.linspace(-2, 1, 200_001)[None] * base.scale).max()

    def roelands(coefficient: float) -> tuple[Fluid, Law]:
        law = Fluid(0.04, viscosity_law="roelands", pressure_viscosity_coefficient=coefficient, roelands_index=index)
        return law, lambda q: exact.roelands_to_true(q, coefficient * 1.96e8 / index, index)

    cases = (
        (
            "Barus",
            base,
            Fluid(0.04, viscosity_law="barus", pressure_viscosity_coefficient=alpha),
            lambda q: exact.reduced_to_true(q, alpha),
        ),
        ("Roelands, low pressure", base, *roelands(alpha)),
        ("Roelands, high pressure", fast_film(base, strong, index), *roelands(strong)),
    )
    for name, e, fluid, to_true in cases:
        s = ruptured(e, parabola_mesh(100, -10.0), 2, refinements, fluid)[-1]
        at = np.linspace(0, s.problem.mesh.nvertices - 1, 61).astype(int)
        true = to_true(e.pressure(s.problem.mesh.p[:, at]))
        error = np.abs(s.at_vertices[at] - true).max() / true.max()
        growth = float(fluid.log_viscosity(true.max()))
        note = f"peak {true.max() / 1e9:.3f} GPa, viscosity up to e^{growth:.1f} times"
        source = "isoviscous closed form and the reduced pressure (Blok 1963)"
        yield bound(f"{name}: largest pressure error / peak", error, 1.5e-4 * 4.0 ** (2 - refinements), source, note)


def fast_film(e: exact.Parabola, alpha: float, index: float) -> exact.Parabola:
    """Return the problem of the gap at the speed at which a Roelands oil reaches 0.5 GPa."""
    s = np.linspace(0, 5e8, 20_001)
    reduced = np.trapezoid(np.exp(-alpha * 1.96e8 / index * ((1 + s / 1.96e8) ** index - 1)), s)
    peak = e.pressure(np.linspace(-2, 1, 200_001)[None] * e.scale).max()
    return exact.Parabola(
        viscosity=e.viscosity,
        speed=e.speed * reduced / peak,
        radius=e.radius,
        film_thickness=e.film_thickness,
        inlet=e.inlet,
    )


def ringing() -> Iterator[Item]:
    """Gas slider at bearing number 1080: Galerkin P1 rings on a coarse mesh, SUPG does not; both converge."""
    fluid = Fluid(GAS.viscosity, density_law="linear", bulk_modulus=AMBIENT)
    source = "isothermal gas slider (Harrison 1913) integrated upstream to 1e-9"
    for label, stabilisation in (("Galerkin", "none"), ("SUPG", "supg")):
        errors = []
        over = []
        cells = np.array([20, 1280, 2560])
        for count in cells:
            x = np.linspace(0, GAS.length, count + 1)
            s = solve_reynolds(
                ReynoldsProblem(
                    mesh=skfem.MeshLine(x), film=GAS.film, fluid=fluid, speed=GAS.speed, stabilisation=stabilisation
                )
            )
            true = exact.gas_slider(GAS, AMBIENT, x)
            errors.append(s.error(lambda at: np.reshape(exact.gas_slider(GAS, AMBIENT, np.ravel(at[0])), at[0].shape)))
            over.append(np.abs(np.diff(s.at_vertices)).sum() / np.abs(np.diff(true)).sum() - 1)
        name = f"gas slider, {label}"
        if stabilisation == "none":
            words = f"{name}: excess variation on 20 cells, which rings where nothing is added"
            yield Check(words, over[0], expected=1.0, tolerance=0.0, source=source, kind=AT_LEAST)
        else:
            yield bound(f"{name}: excess variation on 20 cells, which does not ring", over[0], 0.01, source)
        yield Series(
            label,
            1 / cells,
            errors=errors,
            order=2,
            check=f"{name}: order of the pressure error",
            tolerance=0.2,
            finest=2,
        ).check_order()
        yield bound(f"{name}: finest pressure error", errors[-1], 5e-3, source)
