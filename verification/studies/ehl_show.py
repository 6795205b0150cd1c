"""What the study of the EHL line contact shows: table, figures, fields."""

from __future__ import annotations

import numpy as np

from .. import plotting
from ..check import Field, Table
from ..meshes import mesh_field
from .ehl_pair import Pair


def summary(pairs: list[Pair]) -> Table:
    """The table of every contact on every mesh."""
    rows: list[tuple] = []
    for pair in pairs:
        k = pair.finest.contact.moes_film
        for s in pair.solutions:
            flow, smallest, film = pair.differences(s)
            rows.append(
                (
                    pair.label,
                    round(s.contact.hertz_pressure / 1e9, 3),
                    s.body.stiffness.shape[0],
                    s.body.line.N,
                    s.report.iterations,
                    s.report.residual,
                    s.flow_film / k,
                    s.min_film / k,
                    f"{100 * flow:+.4f} %",
                    f"{100 * smallest:+.4f} %",
                    f"{100 * film:.4f} %",
                )
            )
        rows.append(
            (
                pair.label,
                "",
                "lubfric",
                pair.line.x.size,
                pair.line.report.iterations,
                pair.line.report.residual,
                pair.line.flow_film / k,
                pair.line.min_film / k,
                "",
                "",
                f"{pair.seconds:.1f} s",
            )
        )
    return Table(
        "ehl",
        "Films in Moes' units (h/R)/sqrt(U1) on every mesh and by lubfric; differences relative to lubfric; "
        "film: root mean square over the contact in flow films; in the row of lubfric the time that finite "
        "elements took.",
        (
            "contact",
            "p_h (GPa)",
            "unknown displacements",
            "points on the line",
            "Newton steps",
            "residual",
            "flow film",
            "smallest film",
            "flow film, difference",
            "smallest film, difference",
            "film, difference",
        ),
        rows,
    )


def profiles(pairs: list[Pair]):
    """Pressure and film of both solvers, one panel for each contact."""
    columns = min(3, len(pairs))
    rows = -(-len(pairs) // columns)
    canvas, grid = plotting.axes(rows, columns, width=3.4 * columns, height=2.9 * rows, squeeze=False)
    for ax in grid.flat[len(pairs) :]:
        ax.set_axis_off()
    for pair, ax in zip(pairs, grid.flat, strict=False):
        s, b, k = pair.finest, pair.finest.contact.half_width, pair.line.flow_film
        edge = s.layout.edges[1] * b
        x = np.linspace(-2.2 * edge, 1.4 * edge, 1500)
        p, h = s.at(x)
        ax.plot(
            x / b, p / s.contact.hertz_pressure, color="C0", label="p/p_h, finite elements", linewidth=2.5, alpha=0.5
        )
        ax.plot(
            pair.line.x / b, pair.line.pressure / s.contact.hertz_pressure, "k-", linewidth=0.8, label="p/p_h, lubfric"
        )
        ax.plot(x / b, h / k / 2, color="C1", label="h/(2 flow film), finite elements", linewidth=2.5, alpha=0.5)
        ax.plot(x / b, pair.line.film_at(x) / k / 2, "k--", linewidth=0.8, label="h/(2 flow film), lubfric")
        ax.set(xlim=(x[0] / b, x[-1] / b), ylim=(0, 1.25), title=f"{pair.label}", xlabel="x / b")
    grid.flat[0].legend(fontsize=6.5, loc="upper left")
    return plotting.finish(
        "ehl_profiles",
        canvas,
        "Pressure and film of both solvers on the finest mesh. The pressure spike is no converged quantity of either.",
    )


def fields(pair: Pair):
    """VTU files of the body and of both solutions on the line, and a picture of the stress."""
    s, c = pair.finest, pair.finest.contact
    mesh = s.body.basis.mesh
    xx, zz, xz = s.body.stress(s.displacement) * c.hertz_pressure
    yy = 0.3 * (xx + zz)
    mises = np.sqrt(((xx - zz) ** 2 + (zz - yy) ** 2 + (yy - xx) ** 2) / 2 + 3 * xz**2)
    moved = s.body.everywhere(s.displacement)[s.body.basis.nodal_dofs].T * c.film_unit
    scaled = mesh.translated((0.0, 0.0)).scaled((c.half_width, c.half_width))
    yield mesh_field(
        "ehl_body",
        f"{pair.label}: displacement (m) and stress (Pa) of the body that stands for both",
        scaled,
        {
            "displacement": np.pad(moved, ((0, 0), (0, 1))),
            "stress_xx": xx,
            "stress_zz": zz,
            "stress_xz": xz,
            "von_mises": mises,
        },
    )
    yield line_field(pair)
    yield stress_figure(pair, mises / c.hertz_pressure)


def line_field(pair: Pair) -> Field:
    """Both solutions on the line and their difference."""
    s = pair.finest
    x = np.sort(s.body.line.mesh.p[0])[1:-1] * s.contact.half_width
    x = x[(x >= pair.line.x[0]) & (x <= pair.line.x[-1])]
    p, h = s.at(x)
    other_p, other_h = np.interp(x, pair.line.x, pair.line.pressure), pair.line.film_at(x)
    cells = np.column_stack([np.arange(x.size - 1), np.arange(1, x.size)])
    return Field(
        "ehl_line",
        f"{pair.label}: pressure (Pa) and film (m) by finite elements and lubfric, and the difference",
        x[:, None],
        {"line": cells},
        {
            "pressure": p,
            "film_thickness": h,
            "pressure_lubfric": other_p,
            "film_thickness_lubfric": other_h,
            "pressure_difference": p - other_p,
            "film_thickness_difference": h - other_h,
        },
    )


def stress_figure(pair: Pair, mises: np.ndarray):
    """Von Mises stress below the contact, and the mesh."""
    mesh = pair.solutions[0].body.basis.mesh
    fine = pair.finest.body.basis.mesh
    canvas, (left, right) = plotting.axes(1, 2, width=8.4, height=3.6)
    drawn = left.tripcolor(*fine.p, fine.t.T, mises, shading="gouraud", cmap="viridis", rasterized=True)
    left.set(
        xlim=(-2.5, 2.5),
        ylim=(-3, 0.05),
        aspect="equal",
        xlabel="x / b",
        ylabel="z / b",
        title="von Mises stress / p_h",
    )
    canvas.colorbar(drawn, ax=left, shrink=0.85)
    right.triplot(*mesh.p, mesh.t.T, color="0.3", linewidth=0.4)
    right.set(xlim=(-5, 5), ylim=(-6, 0.2), aspect="equal", xlabel="x / b", title="coarsest mesh")
    for ax in (left, right):
        ax.grid(False)
    return plotting.finish(
        "ehl_stress",
        canvas,
        f"{pair.label}: stress in the elastic body on the finest mesh, and the coarsest "
        "mesh near the contact (the body is 240 b wide and deep).",
        "png",
    )
