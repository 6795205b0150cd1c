"""Hertz line contact on the finite-element layer, elastic and with a plastic limit, compared with
`lubfric.solve_contact`."""

from collections.abc import Iterator

import numpy as np

from lubfric.contact import ContactResult

from ...check import AT_LEAST, Check, Item, Table, bound, compared
from ...meshes import mesh_field
from ...types import FloatArray
from ..convergence import Series, convergence
from ..exact_contact import Line
from ..parts import pressed_cylinder
from ..solvers.compliance import Elastic
from ..solvers.contact import Contact, solve_contact
from ..solvers.layer import Layer, graded_mesh, make_layer
from ..solvers.triangles import von_mises

E_PRIME = 231e9  # Pa, E' of the paper's cylinder
RADIUS = 2e-3  # m, of the paper's cylinder
LINE_LOAD = 5.5 / 6e-3  # N/m, of the paper's cylinder
BODY = Elastic.from_e_prime(E_PRIME, 0.3)
B = float(np.sqrt(8 * LINE_LOAD * RADIUS / (np.pi * E_PRIME)))
PEAK = 2 * LINE_LOAD / (np.pi * B)
CAP = 0.7 * PEAK
LINE = Line(E_PRIME, RADIUS, B)
HERTZ = "Hertz line contact, closed form (Johnson 1985, Contact Mechanics, ch. 4)"
DRY = "lubfric.solve_contact"


def contact(level: str) -> Iterator[Item]:
    """A cylinder pressed on the elastic layer, against Hertz and against `lubfric.solve_contact`.

    The finite elements bring their own elasticity (plane strain, a layer, no kernel) and their own contact algorithm: a
    node is off, touching or at the cap, and each step solves the touching ones exactly. The layer is 40 half-widths
    thick, which raises the peak pressure by J b²/(4 d²) = 0.02 %. The study `layer` shows how it falls with the
    thickness.
    """
    yield from hertz(level)


def hertz_layer(depth: float, fine: float, degree: int) -> Layer:
    """Return a layer that is ``depth`` half-widths thick, with cells of ``fine`` half-widths below the contact."""
    mesh = graded_mesh(8 * depth * B, depth * B, 1.5 * B, fine * B, growth=4 * fine)
    return make_layer(mesh, BODY, degree=degree, strip=1.5 * B)


def press(layer: Layer, load: float = LINE_LOAD, limit: float | None = None) -> Contact:
    """Return a cylinder of RADIUS on the layer."""
    compliance = layer.compliance
    return solve_contact(
        lambda f: compliance @ f, layer.weights, layer.x**2 / (2 * RADIUS), load, limit=limit, tolerance=1e-9
    )


def difference(layer: Layer, values: FloatArray, expected: FloatArray) -> float:
    """Return relative difference of two pressures in the L2 norm over the surface."""
    return float(np.sqrt(layer.weights @ np.square(values - expected) / (layer.weights @ np.square(expected))))


def hertz_pressure(x: FloatArray, load: float) -> FloatArray:
    """Return Hertz pressure [Pa] of the cylinder on the half-space."""
    b = B * np.sqrt(load / LINE_LOAD)
    return 2 * load / (np.pi * b) * np.sqrt(np.maximum(1 - (x / b) ** 2, 0))


def half_width(x: FloatArray, pressure: FloatArray) -> float:
    """Return half-width where p² would vanish, from its slope against x² at more than 0.3 of the peak."""
    high = pressure > 0.3 * pressure.max()
    slope, top = np.polyfit(x[high] ** 2, pressure[high] ** 2, 1)
    return float(np.sqrt(-top / slope))


def hertz(level: str) -> Iterator[Item]:
    """Hertz pressure: the orders, and the finest mesh against the closed form and `lubfric`."""
    fines = 0.4 / 2.0 ** np.arange({"quick": 3, "default": 4, "full": 5}[level])
    rows = []
    series = []
    x, smooth = pressed_cylinder(LINE, 200)
    for degree in (2,) if level == "quick" else (1, 2):
        errors = []
        off = []
        for fine in fines:
            layer = hertz_layer(40, fine, degree)
            p = press(layer)
            errors.append(edge_mean_error(layer, fine))
            off.append(difference(layer, p.pressure, np.interp(layer.x, x, smooth.pressure[:, 0])))
            peak = p.pressure.max() / PEAK
            rows.append((f"P{degree}", layer.x.size, fine, errors[-1], off[-1], peak, p.report.iterations))
        check = f"Hertz line P{degree}: order of the pressure error"
        why = "an edge like a square root in some cell"
        series.append(
            Series(f"P{degree}", fines, errors=errors, order=1, check=check, tolerance=0.3, source=why, kind=AT_LEAST)
        )
    yield Check(
        "Hertz line P2: peak pressure", p.pressure.max(), expected=PEAK, tolerance=5e-3, source=HERTZ, unit="Pa"
    )
    yield Check(
        "Hertz line P2: half-width", half_width(layer.x, p.pressure), expected=B, tolerance=5e-3, source=HERTZ, unit="m"
    )
    allowed = 0.015 if level == "quick" else 5e-3
    yield bound("Hertz line P2: pressure difference to lubfric", off[-1], allowed, DRY, "L2")
    name = "Hertz line P2: the difference shrinks, finest over coarsest mesh"
    yield bound(name, off[-1] / off[0], 0.5, "refinement brings the two together")
    columns = ("element", "nodes", "cell / b", "error, Hertz", "difference, lubfric", "peak / Hertz", "iterations")
    yield Table("contact_hertz", "Cylinder on a layer 40 half-widths thick", columns, rows)
    caption = "Hertz line contact: error of the pressure in the L2 norm, relative, root mean square over five loads "
    caption += "that put the edge of the contact at different places of a cell."
    yield from convergence("contact_hertz", caption, series, "cell length / b", "relative pressure error")
    yield from capped_cylinder(layer, p, x, smooth, level)


def edge_mean_error(layer: Layer, fine: float) -> float:
    """Return relative L2 error of the pressure, rms over loads that move the edge of the contact through a cell."""
    errors = []
    for shift in np.arange(5) / 5:
        load = LINE_LOAD * (1 + fine * shift) ** 2 / (1 + fine) ** 2
        errors.append(difference(layer, press(layer, load).pressure, hertz_pressure(layer.x, load)))
    return float(np.sqrt(np.mean(np.square(errors))))


def capped_cylinder(layer: Layer, elastic: Contact, x: FloatArray, smooth: ContactResult, level: str) -> Iterator[Item]:
    """The cylinder with pressures cut at 0.7 of the Hertz peak, and the stress below the elastic one."""
    p = press(layer, limit=CAP)
    _, other = pressed_cylinder(LINE, 200, CAP)
    width = (x[1] - x[0]) * np.count_nonzero(other.pressure[:, 0] >= CAP)
    note = "cap 0.7 of the elastic peak; counts of whole cells on both sides"
    rows = [("width at the cap", "m", layer.weights @ p.saturated, width, 0.04 if level == "quick" else 0.015)]
    yield from compared("capped Hertz line", rows, DRY, note)
    off = difference(layer, p.pressure, np.interp(layer.x, x, other.pressure[:, 0]))
    allowed = 0.015 if level == "quick" else 5e-3
    yield bound("capped Hertz line: pressure difference to lubfric", off, allowed, DRY, "L2")
    sigma = layer.stress(elastic.pressure * layer.weights)
    data = dict(zip(("sigma_xx", "sigma_zz", "sigma_xz"), sigma), von_mises=von_mises(sigma, BODY.poisson))
    yield mesh_field("contact_line_stress", "Stress under the cylinder, Pa", layer.basis.mesh, data)
    yield from axis_stress(layer, sigma)


def axis_stress(layer: Layer, sigma: FloatArray) -> Iterator[Item]:
    """Stresses on the axis against the closed form."""
    x, z = layer.basis.mesh.p / B
    at = (np.abs(x) < 1e-9) & (z < -0.2) & (z > -3)
    root = np.sqrt(1 + z[at] ** 2)
    exact = -np.array([(1 + 2 * z[at] ** 2) / root + 2 * z[at], 1 / root])
    off = sigma[:2, at] / PEAK - exact
    even = off[0].mean()
    note = "depths of 0.2 to 3 half-widths, over the peak pressure, projected on the vertices"
    yield bound("Hertz line: axial stress on the axis", np.abs(off[1]).max(), 5e-3, HERTZ, note)
    note = f"less an even {even:.3f} of the peak, which the base holds back and which falls like b/d"
    yield bound("Hertz line: lateral stress on the axis", np.abs(off[0] - even).max(), 5e-3, HERTZ, note)
