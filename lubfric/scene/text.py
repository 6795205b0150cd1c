"""A scene as the TOML that `lubfric.load_scene` reads back to the same numbers; a commented one to begin with."""

from __future__ import annotations

import json
import os
from dataclasses import fields
from importlib import resources
from pathlib import Path

from .._base import changed, write_whole
from ..errors import InputError
from .history import History
from .sections import ROUGH, SECTIONS
from .short_oil import fields_of
from .transient import KINDS


def scene_as_toml(scene) -> str:
    """The whole ``scene``, with its defaults except those of a roughness. What is None is left out.

    A ``surface.file`` is written with its whole path. An oil is written as it was given, instead of its numbers at the
    temperature. Raises `InputError` for a history that scene files do not have.
    """
    lines = [f"name = {_text(scene.name)}"]
    for section in SECTIONS:
        part = getattr(scene, section)
        if part is None:
            continue
        lines += ["", f"[{section}]"]
        keys = changed(part) if section in ROUGH else {f.name: getattr(part, f.name) for f in fields(part)}
        if keys.get("limiting_stress_coefficient", 0.0) is None:
            del keys["limiting_stress_offset"]  # refused where it does nothing
        if keys.get("oil") is not None:
            oil = keys.pop("oil")  # in place of the numbers that follow from it
            followed = fields_of(oil, keys["temperature"])
            own = {key: value for key, value in keys.items() if key == "temperature" or followed.get(key, ...) != value}
            keys = oil.said | own
        if "file" in keys:
            keys["file"] = str(Path(keys["file"]).absolute())
        lines += [f"{key} = {_text(value)}" for key, value in keys.items() if value is not None and value != ()]
    return "\n".join(lines) + "\n"


def _text(value) -> str:
    if isinstance(value, History):
        kind = next((kind for kind, known in KINDS.items() if type(value) is known), None)
        if kind is None:
            said = f"a history of type {type(value).__name__} has no form in a scene file"
            raise InputError(said, allowed=", ".join(KINDS))
        inner = ", ".join(f"{name} = {_text(part)}" for name, part in vars(value).items())
        return f'{{ kind = "{kind}", {inner} }}'
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return _quoted(value)
    return f"[{', '.join(_text(part) for part in value)}]"


def _quoted(text: str) -> str:
    """``text`` as a basic string of TOML, in which every control stands as an escape."""
    if any("\ud800" <= mark <= "\udfff" for mark in text):  # of a path that is not Unicode
        raise InputError(f"{ascii(text)} is not Unicode, and a scene file cannot hold it; rename it")
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def write_template(path: Path) -> None:
    """Write a scene that is complete, commented and ready to run to ``path``; raises `InputError` if something is there
    already."""
    if os.path.lexists(path):
        raise InputError(f"{path} exists; give another name, so that no scene is lost")
    if not path.parent.is_dir():
        raise InputError(f"{path.parent} is no folder; give a file in an existing one")
    write_whole(path, (resources.files(__package__) / "template.toml").read_bytes())
