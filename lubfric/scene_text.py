"""A scene as the TOML text that `lubfric.load_scene` reads back to the same numbers."""

from __future__ import annotations

import json
from dataclasses import fields
from pathlib import Path
from typing import Any

from .errors import InputError
from .history.kinds import History
from .history.read import KINDS
from .oil.oil import Oil
from .show.scene import SECTIONS

ROUGH = ("surface", "counterface")  # of which keys that do not apply are refused: defaults are left out


def scene_as_toml(scene) -> str:
    """The whole ``scene``, with its defaults except those of a roughness. What is None is left out.

    A ``surface.file`` is written with its whole path. An oil becomes the numbers that it has at its temperature. Raises
    `InputError` for a history that scene files do not have.
    """
    lines = [f"name = {json.dumps(scene.name)}"]
    for section in SECTIONS:
        part = getattr(scene, section)
        if part is None:
            continue
        lines += ["", f"[{section}]"]
        for field in fields(part):
            value = getattr(part, field.name)
            if value is None or value == () or (section in ROUGH and value == field.default):
                continue
            if isinstance(value, Oil):
                lines.append("# the oil's numbers at its temperature")
                continue
            if field.name == "file":
                value = str(Path(value).absolute())
            lines.append(f"{field.name} = {_text(value)}")
    return "\n".join(lines) + "\n"


def _text(value) -> str:
    if isinstance(value, History):
        return _history(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    return f"[{', '.join(_text(part) for part in value)}]"


def _history(value: History) -> str:
    shown: Any = value  # a dataclass, whatever kind it is
    for kind, known in KINDS.items():
        if type(value) is known:
            parts = {f.name: getattr(value, f.name) for f in fields(shown)}
            inner = ", ".join(f"{name} = {_text(part)}" for name, part in parts.items() if part is not None)
            return f'{{ kind = "{kind}", {inner} }}'
    raise InputError(
        f"a history of type {type(value).__name__} has no form in a scene file; allowed: {', '.join(KINDS)}"
    )
