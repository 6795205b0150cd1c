"""The EHL line contact by finite elements, full system, against `lubfric.solve_ehl` and a table."""

from __future__ import annotations

import numpy as np

from .. import plotting
from ..check import ABSOLUTE, AT_LEAST, AT_MOST, Check
from ..fem.ehl import solve_ehl
from ..fem.ehl_film import PENALTY
from ..rates import fitted_order
from .ehl_pair import COMPRESSIBLE, CONSTANT, Pair, make_contact, solved
from .ehl_show import fields, profiles, summary

POINTS = (
    (0.05, 5, CONSTANT),
    (0.5, 5, CONSTANT),
    (2, 5, CONSTANT),
    (5, 5, CONSTANT),
    (20, 5, CONSTANT),
    (100, 5, CONSTANT),
    (10, 10, CONSTANT),
    (50, 10, CONSTANT),
    (70, 10, CONSTANT),
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
TABLE_SOURCE = "separate finite-difference solver on nested meshes, inlet at -6 b"
SOLVER = "lubfric.solve_ehl, tolerance 3e-5"


def ehl(level: str):
    """Full-system finite elements (elastic body, Reynolds on its surface and load in one Newton iteration) beside
    `lubfric`.

    The two share the differential equations and nothing else. A square elastic body meshed with P2 triangles stands
    against the logarithmic kernel of a half-space, a weak form against fluxes through faces, and pressure >= 0 node by
    node on a fixed mesh against a grid that hangs on the rupture point. Contacts run from rigid (M = 0.05, film thirty
    times the Hertz width in the inlet) to 1.5 GPa. Differences of the films shrink as the finite-element mesh is
    refined, down to where the finite body (1e-5) and the tolerance of `lubfric` (3e-5) begin to show.
    """
    pairs = []
    for point in QUICK if level == "quick" else POINTS:
        pairs.append(solved(point, REFINEMENTS[level]))
        yield from point_checks(pairs[-1], level)
    yield summary(pairs)
    yield from convergence(pairs, level)
    yield profiles(pairs)
    yield from ringing()
    if level != "quick":
        yield from finite_body()
    yield from fields(next(p for p in pairs if p.point == (50, 10, CONSTANT)))


def point_checks(pair: Pair, level: str):
    """Flow film and smallest film against `lubfric` and the table."""
    s, k = pair.finest, pair.finest.contact.moes_film
    tolerance = 1e-2 if level == "quick" else 5e-3
    note = f"p_h = {s.contact.hertz_pressure / 1e9:.3f} GPa, {s.body.stiffness.shape[0]} degrees of freedom"
    yield Check(f"{pair.label}: flow film", s.flow_film / k, pair.line.flow_film / k, tolerance, SOLVER, note=note)
    yield Check(f"{pair.label}: smallest film", s.min_film / k, pair.line.min_film / k, tolerance, SOLVER, note=note)
    if pair.point in TABLE:
        smallest, flow = TABLE[pair.point]
        yield Check(f"{pair.label}: flow film, table", s.flow_film / k, flow, tolerance, TABLE_SOURCE)
        yield Check(f"{pair.label}: smallest film, table", s.min_film / k, smallest, tolerance, TABLE_SOURCE)


def convergence(pairs: list[Pair], level: str):
    """The film's difference from `lubfric` shrinks with the mesh."""
    series = {}
    for pair in pairs:
        sizes = [s.cell_length / s.contact.half_width for s in pair.solutions]
        series[pair.label] = (sizes, [pair.differences(s)[2] for s in pair.solutions], None)
        yield Check(
            f"{pair.label}: film difference, finest over coarsest",
            series[pair.label][1][-1] / series[pair.label][1][0],
            0.0,
            0.6 if level == "quick" else 0.35,
            SOLVER,
            AT_MOST,
        )
    if level != "quick":
        for L, order, source in (
            (5, 2.0, "rupture is found at a node of the mesh, where pressure is O(h²): order 2"),
            (10, 1.0, "the film has a kink under the pressure spike, which no mesh here resolves"),
        ):
            errors = [e for pair, (_, e, _) in zip(pairs, series.values(), strict=True) if pair.point[1] == L]
            mean = np.sqrt(np.mean(np.square(errors), axis=0))
            yield Check(
                f"order of the film difference, L = {L}, root mean square over contacts",
                fitted_order(0.5 ** np.arange(mean.size), mean),
                order,
                0.2,
                source,
                AT_LEAST,
            )
    for L in (5, 10):
        yield plotting.convergence(
            f"ehl_convergence_L{L}",
            f"Film of the full-system finite elements against lubfric at L = {L}, root mean square over the "
            "contact in flow films, against the smallest cell.",
            {pair.label: series[pair.label] for pair in pairs if pair.point[1] == L},
            "smallest cell / Hertz half-width",
            "film difference / flow film",
        )


def ringing():
    """Plain Galerkin and slope penalty on one coarse mesh at 2.6 GPa."""
    contact = make_contact(200, 10)
    canvas, ax = plotting.axes()
    variation = {}
    for label, penalty in (("Galerkin", 0.0), ("slope penalty", PENALTY)):
        s = solve_ehl(contact, refinements=0, fineness=1.0, penalty=penalty)[0]
        order = np.argsort(s.body.x)
        ax.plot(s.body.x[order], s.P[order], marker=".", label=label, linewidth=1.2)
        variation[label] = np.abs(np.diff(s.P[order])).sum() / 2
    ax.set(xlim=(-1.6, 1.3), xlabel="x / b", ylabel="p / p_h", title=f"M = 200, L = 10 on {s.body.line.N} points")
    ax.legend()
    for label, kind, bound in (("Galerkin", AT_LEAST, 2.0), ("slope penalty", AT_MOST, 1.6)):
        yield Check(
            f"half the total variation of pressure, {label}",
            variation[label],
            bound,
            0.0,
            "1 for one hump of height p_h, spike on top",
            kind,
            note="rings, as it must where nothing is added" if kind == AT_LEAST else "does not ring",
        )
    yield plotting.finish(
        "ehl_ringing",
        canvas,
        "Pressure on a coarse mesh: where viscosity leaves nothing but d(ρh)/dx, plain "
        "Galerkin rings; slope penalty does not.",
    )


def finite_body():
    """What a body of side D costs against a half-space: the same mesh near the contact, with D doubled."""
    sides = np.array([60.0, 120.0, 240.0, 480.0])
    contact = make_contact(20, 5)
    films = np.array(
        [[s.flow_film, s.min_film] for s in (solve_ehl(contact, refinements=1, side=side)[-1] for side in sides)]
    )
    limit = films[-1] + (films[-1] - films[-2]) / 3
    errors = np.abs(films / limit - 1)
    for name, error in zip(("flow film", "smallest film"), errors.T, strict=True):
        yield Check(
            f"finite body: order of the {name}'s error in b/D",
            fitted_order(1 / sides[:3], error[:3]),
            2.0,
            0.2,
            "curvature of the surface under the image of the load, O((b/D)²)",
            ABSOLUTE,
        )
        yield Check(f"finite body: {name}'s error with D = 60 b", error[0], 5e-4, 0.0, "small against 0.5 %", AT_MOST)
        yield Check(f"finite body: {name}'s error with D = 240 b, used here", error[2], 3e-5, 0.0, "likewise", AT_MOST)
    series = {
        name: (1 / sides[:3], error[:3], 2)
        for name, error in zip(("flow film", "smallest film"), errors.T, strict=True)
    }
    yield plotting.convergence(
        "ehl_body",
        "Error of the film from a square body of side D in place of a half-space, M = 20, "
        "L = 5, against the value extrapolated to an infinite body.",
        series,
        "b / D",
        "relative error of the film",
    )
