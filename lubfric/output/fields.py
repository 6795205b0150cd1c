"""Files of a run beside its table and pictures: fields.npz, contact_0.vtk ... for ParaView, and report.html, a page
that needs no other file."""

from __future__ import annotations

import base64
import io
from html import escape

import numpy as np

from ..quantities import short_label
from ..sampling import FrictionResult
from ..sharing import Prepared

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2rem; border-bottom: 1px solid #ccc; }
table { border-collapse: collapse; font-size: 0.85rem; }
td, th { padding: 0.15rem 0.7rem; text-align: left; vertical-align: top; }
tbody tr:nth-child(odd) { background: #f4f4f4; } td.number { text-align: right; font-variant-numeric: tabular-nums; }
img { max-width: 100%; } .warning { color: #b3392f; }
"""
COLUMNS = (
    *("speed", "coefficient", "contact_load", "film_load"),
    *("central_film", "film_to_roughness_ratio", "real_contact_area_fraction"),
)
OF_ONE_GAP = ("x", "pressure", "gap", "fill", "shear", "dent", "touching", "spots", "wet")  # of a DeterministicResult


def fields_bytes(prepared: Prepared, points: list[FrictionResult]) -> bytes:
    """Film and contact fields of some speeds: arrays named ``<quantity>_<index>``, and ``speed``; SI units.

    A point of the deterministic model has the fields of its first strip, on cells of its own (``spacing_<index>``).
    Another speed whose contact has other cells than the first one has their map and x under its index too.
    """
    arrays = {"speed": np.array([p.speed for p in points])}
    if any(point.deterministic is None for point in points):
        arrays |= _map_of(prepared, points[0])
    for i, point in enumerate(points):
        film, found = point.balance.film if point.balance else None, {}
        if point.deterministic is not None:
            result = point.deterministic.result
            found = {name: getattr(result, name) for name in OF_ONE_GAP} | {"spacing": np.array(result.spacing)}
        elif film is not None:
            found = {"film_x": film.x, "film_thickness": film.film_thickness, "film_pressure": film.pressure}
        if point.deterministic is None and point.shows_contact:
            found |= {"contact_pressure": point.pressure, "gap": point.gap}
            if point.heights is not None and point.heights.shape != arrays["heights"].shape:
                found |= _map_of(prepared, point)
        arrays |= {f"{name}_{i}": array for name, array in found.items()}
    return npz_bytes(arrays)


def _map_of(prepared: Prepared, point: FrictionResult) -> dict[str, np.ndarray]:
    """Heights, cells and x of the contact of ``point``; those that were solved first where it shows none."""
    if point.heights is None or not point.shows_contact or point.deterministic is not None:
        surface = prepared.surface
        return {"heights": surface.heights, "spacing": np.array(surface.spacing), "contact_x": prepared.contact.x}
    spacing = np.array([point.x[1] - point.x[0], point.y[1] - point.y[0]])
    return {"heights": point.heights, "spacing": spacing, "contact_x": point.x}


def vtk_bytes(prepared: Prepared, point: FrictionResult) -> bytes:
    """Height [m], contact pressure [Pa], gap [m]; constant along the line: film thickness [m], film pressure [Pa].

    At the cells of the contact, in the plane z = 0 (warp by "height" to see the surface). ``point`` needs fields
    (``fields=True``) and contact, or the deterministic model. What a point does not have is left out.
    """
    x, y, fields = point.x, point.y, {}
    heights = prepared.surface.heights if point.heights is None else point.heights
    if heights.shape == (x.size, y.size):
        fields["height"] = heights - np.nanmean(heights)
    fields |= {"contact_pressure": point.pressure, "gap": point.gap}
    film = point.balance.film if point.balance else None
    if film is not None:
        pressure = np.interp(x, film.x, film.pressure, left=0.0, right=0.0)
        for name, values in (("film_thickness", film.film_at(x)), ("film_pressure", pressure)):
            fields[name] = np.repeat(values[:, None], y.size, axis=1)
    return grid_bytes(x, y, fields, f"U = {point.speed:g} m/s")


def grid_bytes(x: np.ndarray, y: np.ndarray, fields: dict[str, np.ndarray], title: str) -> bytes:
    """Point data (nx, ny) on the grid ``x`` (nx,), ``y`` (ny,) [m]: legacy VTK format 3.0, big-endian binary."""
    points = np.zeros((y.size, x.size, 3))
    points[..., 0], points[..., 1] = x[None, :], y[:, None]
    parts = [
        f"# vtk DataFile Version 3.0\nlubfric, {title}, SI units\nBINARY\nDATASET STRUCTURED_GRID\n"
        f"DIMENSIONS {x.size} {y.size} 1\nPOINTS {x.size * y.size} double\n".encode(),
        _big_endian(points),
        f"\nPOINT_DATA {x.size * y.size}\n".encode(),
    ]
    for name, values in fields.items():
        parts += [f"SCALARS {name} double 1\nLOOKUP_TABLE default\n".encode(), _big_endian(values.T), b"\n"]
    return b"".join(parts)


def _big_endian(values: np.ndarray) -> bytes:
    return np.ascontiguousarray(values, dtype=">f8").tobytes()


def npz_bytes(arrays: dict[str, np.ndarray]) -> bytes:
    """``arrays`` as a compressed ``.npz`` file."""
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # NumPy types allow_pickle, not the arrays
    return file.getvalue()


def report_page(prepared, curve, record: dict, images: dict[str, bytes]) -> bytes:
    """The page of a curve. ``record``: what result.json holds; ``images``: PNG files by their captions."""
    scene, solved = prepared.scene, [p for p in curve.points if p is not None]
    decided = [(f"{p.speed:.4g} m/s", p.decision) for p in solved]
    notes = {note: speed for speed, decision in decided for note in decision.notes}
    sections = [
        f"<h1>{escape(scene.name)}: friction of a mixed-lubricated line contact</h1>",
        f"<p>{escape(_in_words(curve))}</p>",
        *(f"<figure>{_image(content, caption)}</figure>" for caption, content in images.items()),
        "<h2>Results</h2>",
        _points(curve),
        "<h2>What does not hold</h2>",
        _list(curve.validity, "Every assumption that is checked holds at every speed.", "warning"),
        "<h2>How sure the numbers are</h2>",
        _table([(f"{p.speed:.4g} m/s", p.uncertainty.text) for p in solved]),
        _list([curve.report.message, *(f"at {speed}: {note}" for note, speed in notes.items())]),
        "<h2>What was modelled</h2>",
        _table([(speed, decision.text) for speed, decision in decided]),
        "<h2>Inputs</h2>",
        scene._repr_html_(),
        "<h2>Height map</h2>",
        f"<p>{escape(prepared.surface.describe())}</p>",
        _list(prepared.surface.notes),
        "<h2>Provenance</h2>",
        _table([*record["versions"].items(), ("seconds", f"{record['seconds']:.3g}")]),
    ]
    title = f'<meta charset="utf-8"><title>{escape(scene.name)}</title><style>{STYLE}</style>'
    page = f'<!DOCTYPE html><html lang="en"><head>{title}</head><body>{"".join(sections)}</body></html>\n'
    return page.encode()


def _in_words(curve) -> str:
    f = curve.coefficient[np.isfinite(curve.coefficient)]
    if not f.size:
        return "No speed was solved."
    least = curve.speed[int(np.nanargmin(curve.coefficient))]
    return (
        f"{curve.speed.size} speeds, {f.size} solved. Friction coefficient {f.min():.4g} to {f.max():.4g}, least at "
        f"{least:.4g} m/s."
    )


def _image(content: bytes, caption: str) -> str:
    data = base64.b64encode(content).decode()
    return f'<img alt="{escape(caption)}" src="data:image/png;base64,{data}"><figcaption>{escape(caption)}</figcaption>'


def _points(curve) -> str:
    head = "".join(f"<th>{escape(text)}</th>" for text in (*map(short_label, COLUMNS), "status"))
    rows = []
    for i, point in enumerate(curve.points):
        cells = "".join(f'<td class="number">{getattr(curve, name)[i]:.4g}</td>' for name in COLUMNS)
        status = "solved" if point else f'<span class="warning">{escape(str(curve.errors[i]))}</span>'
        rows.append(f"<tr>{cells}<td>{status}</td></tr>")
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


def _table(rows) -> str:
    cells = "".join(f"<tr><th>{escape(a)}</th><td>{escape(b)}</td></tr>" for a, b in rows)
    return f"<table><tbody>{cells}</tbody></table>"


def _list(lines, otherwise: str = "", kind: str = "") -> str:
    if not lines:
        return f"<p>{escape(otherwise)}</p>" if otherwise else ""
    return f'<ul class="{kind}">{"".join(f"<li>{escape(line)}</li>" for line in lines)}</ul>'
