"""A run as one HTML page that needs no other file: inputs, decision, validity, uncertainty, curve, maps, provenance."""

from __future__ import annotations

import base64
from dataclasses import fields, is_dataclass
from html import escape

import numpy as np

from ..quantities import key_unit

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2rem; border-bottom: 1px solid #ccc; }
table { border-collapse: collapse; font-size: 0.85rem; }
td, th { padding: 0.15rem 0.7rem; text-align: left; vertical-align: top; }
tbody tr:nth-child(odd) { background: #f4f4f4; } td.number { text-align: right; font-variant-numeric: tabular-nums; }
img { max-width: 100%; } .warning { color: #b3392f; } .inputs { display: flex; flex-wrap: wrap; gap: 0 2rem; }
"""
COLUMNS = {
    "speed": "U (m/s)",
    "coefficient": "f",
    "contact_load": "F_C (N)",
    "film_load": "F_H (N)",
    "central_film": "central film (m)",
    "film_to_roughness_ratio": "lambda",
    "real_contact_area_fraction": "real contact area",
}


def report_page(prepared, curve, record: dict, images: dict[str, bytes]) -> bytes:
    """The page of a curve. ``record``: what result.json holds; ``images``: PNG files by their captions."""
    scene = prepared.scene
    sections = [
        f"<h1>{escape(scene.name)}: friction of a mixed-lubricated line contact</h1>",
        f"<p>{escape(_in_words(curve))}</p>",
        *(f"<figure>{_image(content, caption)}</figure>" for caption, content in images.items()),
        "<h2>Results</h2>",
        _points(curve),
        "<h2>What does not hold</h2>",
        _list(curve.validity, "Every assumption that is checked holds at every speed.", "warning"),
        "<h2>How sure the numbers are</h2>",
        _sure(curve),
        "<h2>What was modelled</h2>",
        _decisions(curve),
        "<h2>Inputs</h2>",
        f'<div class="inputs">{"".join(_inputs(scene))}</div>',
        "<h2>Height map</h2>",
        f"<p>{escape(prepared.surface.describe())}</p>",
        _list(prepared.surface.notes, "", ""),
        "<h2>Provenance</h2>",
        _table([*record["versions"].items(), ("seconds", f"{record['seconds']:.3g}")]),
    ]
    title = f'<meta charset="utf-8"><title>{escape(scene.name)}</title><style>{STYLE}</style>'
    page = f'<!DOCTYPE html><html lang="en"><head>{title}</head><body>{"".join(sections)}</body></html>\n'
    return page.encode()


def _in_words(curve) -> str:
    good = np.isfinite(curve.coefficient)
    if not good.any():
        return "No speed was solved."
    f, least = curve.coefficient[good], curve.speed[int(np.nanargmin(curve.coefficient))]
    return (
        f"{curve.speed.size} speeds, {f.size} solved. Friction coefficient {f.min():.4g} to {f.max():.4g}, least at "
        f"{least:.4g} m/s."
    )


def _image(content: bytes, caption: str) -> str:
    data = base64.b64encode(content).decode()
    return f'<img alt="{escape(caption)}" src="data:image/png;base64,{data}"><figcaption>{escape(caption)}</figcaption>'


def _points(curve) -> str:
    head = "".join(f"<th>{escape(text)}</th>" for text in (*COLUMNS.values(), "status"))
    rows = []
    for i in range(curve.speed.size):
        cells = "".join(f'<td class="number">{getattr(curve, name)[i]:.4g}</td>' for name in COLUMNS)
        failed = curve.points[i] is None
        status = f'<span class="warning">{escape(str(curve.errors[i]))}</span>' if failed else "solved"
        rows.append(f"<tr>{cells}<td>{status}</td></tr>")
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


def _sure(curve) -> str:
    lines = [curve.report.message]
    errors = [p.decision.grid_error for p in curve.points if p is not None and p.decision and p.decision.grid_error]
    if errors:
        lines.append(f"The contact grid leaves an estimated error of at most {100 * max(errors):.2g} % of f.")
    told = {n: p.speed for p in curve.points if p is not None and p.decision for n in p.decision.notes}
    rows = [(f"{p.speed:.4g} m/s", p.uncertainty.text) for p in curve.points if p is not None]
    return _table(rows) + _list([*lines, *(f"at {speed:.4g} m/s: {note}" for note, speed in told.items())], "", "")


def _decisions(curve) -> str:
    rows = [(f"{p.speed:.4g} m/s", p.decision.text) for p in curve.points if p is not None and p.decision is not None]
    return _table(rows)


def _inputs(scene) -> list[str]:
    tables = []
    for field in fields(scene):
        part = getattr(scene, field.name)
        if not is_dataclass(part):
            continue
        rows = []
        for inner in fields(part):
            value = getattr(part, inner.name)
            if value is None or value == ():
                continue
            text = f"{value:.6g}" if isinstance(value, float) else str(value)
            rows.append((inner.name, f"{text} {key_unit(field.name, inner.name)}".strip()))
        tables.append(f"<div><h3>{escape(field.name)}</h3>{_table(rows)}</div>")
    return tables


def _table(rows: list[tuple[str, str]]) -> str:
    cells = "".join(f"<tr><th>{escape(a)}</th><td>{escape(b)}</td></tr>" for a, b in rows)
    return f"<table><tbody>{cells}</tbody></table>"


def _list(lines, otherwise: str, kind: str) -> str:
    if not lines:
        return f"<p>{escape(otherwise)}</p>" if otherwise else ""
    return f'<ul class="{kind}">{"".join(f"<li>{escape(line)}</li>" for line in lines)}</ul>'
