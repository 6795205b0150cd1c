"""What the study of the EHL line contact shows: table, figures, fields."""

from __future__ import annotations

import numpy as np

from .. import plotting
from ..check import Table
from ..fem.ehl_body import POISSON
from ..fem.triangles import von_mises
from ..meshes import mesh_field
from .ehl import Pair

SOLVED = ("contact", "p_h (GPa)", "unknown displacements", "points on the line", "Newton steps", "residual")
FILMS = ("flow film", "smallest film", "flow film, difference", "smallest film, difference", "film, difference")


def summary(pairs: list[Pair]) -> Table:
    """The table of every contact on every mesh."""
    rows: list[tuple] = []
    for pair in pairs:
        k, line = pair.finest.contact.moes_film, pair.line
        for s in pair.solutions:
            mesh = (round(s.contact.hertz_pressure / 1e9, 3), s.body.stiffness.shape[0], s.body.line.N)
            off = [f"{100 * d:+.4f} %" for d in pair.differences(s)]
            solve = (s.report.iterations, s.report.residual)
            rows.append((pair.label, *mesh, *solve, s.flow_film / k, s.min_film / k, *off))
        solve = (line.x.size, line.report.iterations, line.report.residual)
        films = (line.flow_film / k, line.min_film / k)
        rows.append((pair.label, "", "lubfric", *solve, *films, "", "", f"{pair.seconds:.1f} s"))
    caption = "Films in Moes' units (h/R)/sqrt(U1) on every mesh and by lubfric; differences relative to lubfric; "
    caption += "film: "
    caption += "root mean square over the contact in flow films; in the row of lubfric the time that finite elements "
    caption += "took."
    return Table("ehl", caption, (*SOLVED, *FILMS), rows)


def profiles(pairs: list[Pair]):
    """Pressure and film of both solvers, one panel for each contact."""
    columns = min(3, len(pairs))
    rows = -(-len(pairs) // columns)
    canvas, grid = plotting.axes(rows, columns, width=3.4 * columns, height=2.9 * rows, squeeze=False)
    for ax in grid.flat[len(pairs) :]:
        ax.set_axis_off()
    for pair, ax in zip(pairs, grid.flat, strict=False):
        s, b, k = pair.finest, pair.finest.contact.half_width, 2 * pair.line.flow_film
        edge, unit = s.layout.edges[1] * b, s.contact.hertz_pressure
        x = np.linspace(-2.2 * edge, 1.4 * edge, 1500)
        p, h = s.at(x)
        thick, thin = {"linewidth": 2.5, "alpha": 0.5}, {"linewidth": 0.8}
        ax.plot(x / b, p / unit, color="C0", label="p/p_h, finite elements", **thick)
        ax.plot(pair.line.x / b, pair.line.pressure / unit, "k-", label="p/p_h, lubfric", **thin)
        ax.plot(x / b, h / k, color="C1", label="h/(2 flow film), finite elements", **thick)
        ax.plot(x / b, pair.line.film_at(x) / k, "k--", label="h/(2 flow film), lubfric", **thin)
        ax.set(xlim=(x[0] / b, x[-1] / b), ylim=(0, 1.25), title=f"{pair.label}", xlabel="x / b")
    grid.flat[0].legend(fontsize=6.5, loc="upper left")
    caption = "Pressure and film of both solvers on the finest mesh. The pressure spike is no converged quantity of "
    caption += "either."
    return plotting.finish("ehl_profiles", canvas, caption)


def fields(pair: Pair):
    """A VTU file of the body, and a picture of its stress."""
    s, c = pair.finest, pair.finest.contact
    mesh = s.body.basis.mesh
    stress = s.body.stress(s.displacement) * c.hertz_pressure
    mises = von_mises(stress, POISSON)
    moved = s.body.everywhere(s.displacement)[s.body.basis.nodal_dofs].T * c.film_unit
    data = dict(zip(("stress_xx", "stress_zz", "stress_xz"), stress, strict=True), von_mises=mises)
    caption = f"{pair.label}: displacement (m) and stress (Pa) of the body that stands for both"
    scaled = mesh.scaled((c.half_width, c.half_width))
    yield mesh_field("ehl_body", caption, scaled, {"displacement": np.pad(moved, ((0, 0), (0, 1)))} | data)
    yield stress_figure(pair, mises / c.hertz_pressure)


def stress_figure(pair: Pair, mises: np.ndarray):
    """Von Mises stress below the contact, and the mesh."""
    mesh, fine = pair.solutions[0].body.basis.mesh, pair.finest.body.basis.mesh
    canvas, (left, right) = plotting.axes(1, 2, width=8.4, height=3.6)
    drawn = left.tripcolor(*fine.p, fine.t.T, mises, shading="gouraud", cmap="viridis", rasterized=True)
    left.set(xlim=(-2.5, 2.5), ylim=(-3, 0.05), ylabel="z / b", title="von Mises stress / p_h")
    canvas.colorbar(drawn, ax=left, shrink=0.85)
    right.triplot(*mesh.p, mesh.t.T, color="0.3", linewidth=0.4)
    right.set(xlim=(-5, 5), ylim=(-6, 0.2), title="coarsest mesh")
    for ax in (left, right):
        ax.set(aspect="equal", xlabel="x / b")
        ax.grid(False)
    caption = f"{pair.label}: stress in the elastic body on the finest mesh, and the coarsest mesh near the contact "
    return plotting.finish("ehl_stress", canvas, caption + "(the body is 240 b wide and deep).", "png")
