"""A run as one HTML page that needs no other file: inputs, validity, uncertainty, curve, pictures, versions."""

from __future__ import annotations

import base64
from html import escape

import numpy as np

from ..quantities import short_label

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
