"""How a scene is shown: its main numbers in a line, its keys with their units in a table."""

from __future__ import annotations

from html import escape
from typing import Any

from .._base import Shown, changed
from ..quantities import key_unit

SECTIONS = ("bodies", "lubricant", "motion", "surface", "counterface", "contact", "numerics", "transient")
MANY = 8  # values of a list that are shown


class SceneShown(Shown):
    """How a `lubfric.Scene` prints. Its fields are those of the scene."""

    name: str
    bodies: Any
    lubricant: Any
    motion: Any
    surface: Any

    def _facts(self) -> dict[str, str]:
        rough = self.surface
        sq = "" if rough.sq is None else f"Sq {rough.sq:.4g} m"
        return {
            "": self.name,
            "R": f"{self.bodies.radius:.4g} m",
            "load": f"{self.bodies.load:.4g} N on {self.bodies.width:.4g} m",
            "viscosity": f"{self.lubricant.viscosity:.4g} Pa s",
            "U": f"{self.motion.entrainment_speed:.4g} m/s",
            "surface": " ".join(part for part in (rough.file or "generated", sq) if part),
        }

    def _repr_html_(self) -> str:
        rows = []
        for section in SECTIONS:
            part = getattr(self, section)
            values = {} if part is None else changed(part)
            if values:
                rows.append(f'<tr><th colspan="3">{section}</th></tr>')
            rows += [_row(key, _in_words(value), key_unit(section, key)) for key, value in values.items()]
        head = "<thead><tr><th>key</th><th>value</th><th>unit</th></tr></thead>"
        return f"<table><caption>{escape(self.name)}</caption>{head}<tbody>{''.join(rows)}</tbody></table>"


def _row(*cells: str) -> str:
    return f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in cells)}</tr>"


def _in_words(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, (tuple, list)):
        shown = ", ".join(_in_words(part) for part in value[:MANY])
        return f"{shown}, ... ({len(value)} values)" if len(value) > MANY else shown
    return str(getattr(value, "name", value))  # an oil by its name
