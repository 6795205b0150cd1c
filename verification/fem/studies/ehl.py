"""The EHL line contact by finite elements, full system, against `lubfric.solve_ehl` and a table."""

import time
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

import lubfric

from ...check import AT_LEAST, Check, Field, Item, Table, bound, compared
from ...meshes import mesh_field
from ...types import TableRow
from ..convergence import Series, convergence, picture
from ..parts import case_of
from ..published.friction import force
from ..solvers.ehl import EHLSolution, LineContact, solve_ehl
from ..solvers.ehl_body import POISSON
from ..solvers.ehl_film import PENALTY
from ..solvers.thinned_film import Law, solve_thinned
from ..solvers.triangles import von_mises

CONSTANT = "constant"
COMPRESSIBLE = "dowson-higginson"
POINTS = (
    *((M, 5, CONSTANT) for M in (0.05, 0.5, 2, 5, 20, 100)),
    *((M, 10, CONSTANT) for M in (10, 50, 70)),
    (20, 5, COMPRESSIBLE),
)
QUICK = ((2, 5, CONSTANT), (50, 10, CONSTANT))
REFINEMENTS = {"quick": 1, "default": 2, "full": 3}
# (smallest film, flow film) in Moes' units of an independent solver on nested meshes, inlet at -6 half-widths
TABLE: dict[tuple[float, float, str], tuple[float, float]] = {
    (5, 5, CONSTANT): (3.105, 4.082),
    (20, 5, CONSTANT): (2.572, 3.423),
    (100, 5, CONSTANT): (2.061, 2.758),
    (10, 10, CONSTANT): (4.153, 5.491),
    (50, 10, CONSTANT): (3.436, 4.587),
    (20, 5, COMPRESSIBLE): (2.568, 3.509),
}
THINNED = ((20, 10, Law(5e5), 2.0), (20, 10, Law(2e5, 0.6), 0.0), (50, 10, Law(3e5, 0.5), 1.0))
SOLVED = ("contact", "p_h (GPa)", "unknown displacements", "points on the line", "Newton steps", "residual")
FILMS = ("flow film", "smallest film", "flow film, difference", "smallest film, difference", "film, difference")
TABLE_SOURCE = "separate finite-difference solver on nested meshes, inlet at -6 b"
SOLVER = "lubfric.solve_ehl, tolerance 3e-5"


def ehl(level: str) -> Iterator[Item]:
    """Compare full-system finite elements (elastic body, Reynolds on its surface and load in one Newton iteration)
    with `lubfric`.

    Both solve the same differential equations, and have nothing else in common: a square elastic body meshed with P2
    triangles or the logarithmic kernel of a half-space, a weak form or fluxes through faces, pressure >= 0 node by node
    on a fixed mesh or a grid that ends at the rupture point. Contacts run from rigid (M = 0.05, film thirty times the
    Hertz width in the inlet) to 1.5 GPa. Differences of the films decrease as the finite-element mesh is refined, down
    to the errors of the finite body (1e-5) and of `lubfric` (3e-5). The last part has three films of shear-thinning
    fluids, with the profile across them integrated by different methods.
    """
    pairs = []
    for point in QUICK if level == "quick" else POINTS:
        pairs.append(solved(point, REFINEMENTS[level]))
        yield from point_checks(pairs[-1], level)
    yield summary(pairs)
    yield from differences(pairs, level)
    yield from ringing()
    if level != "quick":
        yield from finite_body()
        yield from thinned()
    yield body_field(next(p for p in pairs if p.point == (50, 10, CONSTANT)))


@dataclass(frozen=True)
class Pair:
    """One contact solved both ways: on all finite-element meshes, coarsest first, and by `lubfric`."""

    point: tuple[float, float, str]
    solutions: list[EHLSolution]
    line: lubfric.EHLResult
    seconds: float

    @property
    def finest(self) -> EHLSolution:
        """The solution on the finest mesh."""
        return self.solutions[-1]

    @property
    def label(self) -> str:
        """Return M, L, and the density law where it has an effect, as text."""
        M, L, density = self.point
        return f"M = {M:g}, L = {L:g}" + ("" if density == CONSTANT else ", compressible")

    def differences(self, s: EHLSolution) -> tuple[float, float, float]:
        """Return relative differences of flow film and smallest film, and the root mean square of that of the film over
        the contact, in flow films.

        The contact reaches here to 1.2 times the place where the film is expected to rupture.
        """
        width = 1.2 * s.layout.edges[1] * s.contact.half_width
        x = np.linspace(-width, width, 2001)
        off = float(np.sqrt(np.mean((s.at(x)[1] - self.line.film_at(x)) ** 2))) / self.line.flow_film
        return s.flow_film / self.line.flow_film - 1, s.min_film / self.line.min_film - 1, off


def thinned() -> Iterator[Item]:
    """Films that shear makes up to twice as thin, one mesh finer than the coarsest."""
    for M, L, law, ratio in THINNED:
        c = case_of(M, L)
        sliding = ratio * c["entrainment_speed"]
        _, fem = solve_thinned(LineContact.of(c), law, sliding)
        eyring = law.critical if law.exponent is None else None
        carreau = None if law.exponent is None else (law.critical, law.exponent)
        ours = lubfric.solve_ehl(**c, tolerance=1e-3, sliding=sliding, eyring_stress=eyring, carreau=carreau)
        rows = [
            ("flow film", "m", fem.flow_film, ours.flow_film, 1e-3),
            ("smallest film", "m", fem.min_film, ours.min_film, 1e-2),
        ]
        name = f"Eyring {law.critical:g} Pa" if carreau is None else f"Carreau {law.critical:g} Pa, {law.exponent:g}"
        yield from compared(f"M = {M}, L = {L}, {name}, slide-roll ratio {ratio:g}", rows, "lubfric.solve_ehl, 1e-3")


def solved(point: tuple[float, float, str], refinements: int) -> Pair:
    """Return both solvers on one contact."""
    M, L, density = point
    case = case_of(M, L, density=density)
    start = time.perf_counter()
    solutions = solve_ehl(LineContact.of(case), refinements=refinements)
    seconds = time.perf_counter() - start
    return Pair(point, solutions, lubfric.solve_ehl(**case, tolerance=3e-5), seconds)


def point_checks(pair: Pair, level: str) -> Iterator[Item]:
    """Flow film and smallest film against `lubfric` and the table."""
    s = pair.finest
    k = pair.finest.contact.moes_film
    allowed = 1e-2 if level == "quick" else 5e-3
    note = f"p_h = {s.contact.hertz_pressure / 1e9:.3f} GPa, {s.body.stiffness.shape[0]} degrees of freedom"
    rows = [
        ("flow film", "1", s.flow_film / k, pair.line.flow_film / k, allowed),
        ("smallest film", "1", s.min_film / k, pair.line.min_film / k, allowed),
        ("rolling force", "N/m", s.rolling, force(pair.line, pair.line.line.lubricant, 1e-9).rolling, allowed),
    ]
    yield from compared(pair.label, rows, SOLVER, note)
    if pair.point in TABLE:
        smallest, flow = TABLE[pair.point]
        rows = [
            ("flow film, table", "1", s.flow_film / k, flow, allowed),
            ("smallest film, table", "1", s.min_film / k, smallest, allowed),
        ]
        yield from compared(pair.label, rows, TABLE_SOURCE)


def summary(pairs: list[Pair]) -> Table:
    """Return the table of every contact on every mesh."""
    rows: list[TableRow] = []
    for pair in pairs:
        k = pair.finest.contact.moes_film
        line = pair.line
        for s in pair.solutions:
            mesh = (round(s.contact.hertz_pressure / 1e9, 3), s.body.stiffness.shape[0], s.body.line.N)
            off = [f"{100 * d:+.4f} %" for d in pair.differences(s)]
            work = (s.report.iterations, s.report.residual)
            rows.append((pair.label, *mesh, *work, s.flow_film / k, s.min_film / k, *off))
        solve = (line.x.size, line.report.iterations, line.report.residual)
        films = (line.flow_film / k, line.min_film / k)
        rows.append((pair.label, "", "lubfric", *solve, *films, "", "", f"{pair.seconds:.1f} s"))
    caption = (
        "Films in Moes' units (h/R)/sqrt(U1) on every mesh and by lubfric; differences relative to lubfric; film: "
    )
    caption += "root mean square over the contact in flow films; in the row of lubfric the time of finite elements."
    return Table("ehl", caption, (*SOLVED, *FILMS), rows)


def body_field(pair: Pair) -> Field:
    """Return displacement and stress of the body."""
    s = pair.finest
    c = pair.finest.contact
    stress = s.body.stress(s.displacement) * c.hertz_pressure
    moved = s.body.everywhere(s.displacement)[s.body.basis.nodal_dofs].T * c.film_unit
    data = dict(zip(("stress_xx", "stress_zz", "stress_xz"), stress, strict=True), von_mises=von_mises(stress, POISSON))
    caption = f"{pair.label}: displacement (m) and stress (Pa) of the body that represents both"
    scaled = s.body.basis.mesh.scaled((c.half_width, c.half_width))
    return mesh_field("ehl_body", caption, scaled, {"displacement": np.pad(moved, ((0, 0), (0, 1)))} | data)


def differences(pairs: list[Pair], level: str) -> Iterator[Item]:
    """The film's difference from `lubfric` shrinks with the mesh."""
    series: dict[float, list[Series]] = {5: [], 10: []}
    for pair in pairs:
        sizes = [s.cell_length / s.contact.half_width for s in pair.solutions]
        errors = [pair.differences(s)[2] for s in pair.solutions]
        series[pair.point[1]].append(Series(pair.label, sizes, errors=errors))
        name = f"{pair.label}: film difference, finest over coarsest"
        yield bound(name, errors[-1] / errors[0], 0.6 if level == "quick" else 0.35, SOLVER)
    for L, order, source in (
        (5, 2.0, "rupture is found at a node of the mesh, where pressure is O(h²): order 2"),
        (10, 1.0, "the film has a kink under the pressure spike, which no mesh here resolves"),
    ):
        if level != "quick":
            mean = np.sqrt(np.mean(np.square([list(s.errors) for s in series[L]]), axis=0))
            name = f"order of the film difference, L = {L}, root mean square over contacts"
            yield Series(
                "",
                0.5 ** np.arange(mean.size),
                errors=mean,
                order=order,
                check=name,
                tolerance=0.2,
                source=source,
                kind=AT_LEAST,
            ).check_order()
        caption = f"Film of the full-system finite elements against lubfric at L = {L}, root mean square over the "
        caption += "contact in flow films, against the smallest cell."
        words = "smallest cell / Hertz half-width", "film difference / flow film"
        yield picture(f"ehl_convergence_L{L}", caption, series[L], *words)


def ringing() -> Iterator[Item]:
    """Plain Galerkin and slope penalty on one coarse mesh at 2.6 GPa."""
    contact = LineContact.of(case_of(200, 10))
    variation = {}
    for label, penalty in (("Galerkin", 0.0), ("slope penalty", PENALTY)):
        s = solve_ehl(contact, refinements=0, fineness=1.0, penalty=penalty)[0]
        order = np.argsort(s.body.x)
        variation[label] = np.abs(np.diff(s.P[order])).sum() / 2
    name = "half the total variation of pressure"
    source = "1 for one hump of height p_h, spike on top"
    note = "rings, as it must where nothing is added"
    yield Check(
        f"{name}, Galerkin", variation["Galerkin"], expected=2.0, tolerance=0.0, source=source, kind=AT_LEAST, note=note
    )
    yield bound(f"{name}, slope penalty", variation["slope penalty"], 1.6, source, "does not ring")


def finite_body() -> Iterator[Item]:
    """What a body of side D costs against a half-space: the same mesh near the contact, with D doubled."""
    sides = np.array([60.0, 120.0, 240.0, 480.0])
    values = [solve_ehl(LineContact.of(case_of(20, 5)), refinements=1, side=side)[-1] for side in sides]
    films = np.array([[s.flow_film, s.min_film] for s in values])
    errors = np.abs(films / (films[-1] + (films[-1] - films[-2]) / 3) - 1)
    series = []
    for name, error in zip(("flow film", "smallest film"), errors.T, strict=True):
        check = f"finite body: order of the {name}'s error in b/D"
        source = "curvature of the surface under the image of the load, O((b/D)²)"
        series.append(
            Series(name, 1 / sides[:3], errors=error[:3], order=2.0, check=check, tolerance=0.2, source=source)
        )
        yield bound(f"finite body: {name}'s error with D = 60 b", error[0], 5e-4, "small against 0.5 %")
        yield bound(f"finite body: {name}'s error with D = 240 b, used here", error[2], 3e-5, "likewise")
    caption = "Error of the film from a square body of side D in place of a half-space, M = 20, L = 5, against the "
    caption += "value extrapolated to an infinite body."
    yield from convergence("ehl_body", caption, series, "b / D", "relative error of the film")
