"""Studies as TOML: strict reading."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from .._base import validate
from ..errors import InputError
from ..scene import load_scene, read_toml, speeds_of_range
from .plan import StudyPlan, plan_study
from .vary import Between, sample

KEYS = ("scene", "speeds", "speed_range", "vary", "together", "sample")
SAMPLE_KEYS = ("count", "sampler", "seed")


def load_study(path) -> StudyPlan:
    """The plan in a study file.

    - ``scene``: a file relative to this one, or a built-in scene.
    - ``speeds`` or ``speed_range``: in m/s.
    - [vary]: keys with lists of values.
    - [[together]]: keys whose lists go together.
    - [sample]: keys with {low, high, scale}, and count, sampler, seed.

    Raises `InputError` for anything else, naming the nearest valid key.
    """
    path = Path(path)
    table = read_toml(path, "study")
    validate.keys(path.name, table, KEYS)
    name = table.get("scene")
    if not isinstance(name, str):
        raise InputError(f'{path.name} needs scene = "a file or a built-in scene", found {name!r}')
    beside = path.parent / name
    scene = load_scene(beside if beside.is_file() else name)
    vary: dict[Any, list] = _lists(table.get("vary", {}), "vary", path.parent)
    together = table.get("together", [])
    for group in together if isinstance(together, list) else [together]:
        lists = _lists(group, "together", path.parent)
        if len({len(values) for values in lists.values()}) != 1:
            found = ", ".join(f"{key} with {len(values)}" for key, values in lists.items()) or "none"
            raise InputError(f"[[together]] of {path.name} needs lists of one length; found {found}")
        _add(vary, tuple(lists), list(zip(*lists.values())))
    if "sample" in table:
        _add(vary, *_sampled(table["sample"], path.name))
    speeds = table.get("speeds")
    if "speed_range" in table:
        if speeds is not None:
            raise InputError("a study takes speeds or speed_range, not both")
        speeds = speeds_of_range("speed_range", table["speed_range"])
    return plan_study(scene, vary, speeds)


def _add(known: dict, key, values) -> None:
    """Put ``values`` into ``known``. Raises `InputError` for a key that is there already, whose values would be
    lost."""
    if key in known:
        raise InputError(f"vary: {', '.join(key) if isinstance(key, tuple) else key} is given twice; give it once")
    known[key] = values


def _flat(table: dict, is_value: Callable[[Any], bool]) -> dict[str, Any]:
    """{"section.key": value} from ``"section.key" = value`` or ``section.key = value``."""
    found: dict[str, Any] = {}
    for key, value in table.items():
        inner = {key: value} if is_value(value) else {f"{key}.{name}": part for name, part in value.items()}
        for name, part in inner.items():
            _add(found, name, part)
    return found


def _lists(table, where: str, folder: Path) -> dict[str, list]:
    """The lists of values by their keys. Files are relative to ``folder``."""
    if not isinstance(table, dict):
        raise InputError(f"[{where}] = {table!r}; allowed: keys of a scene with lists of values")
    found = _flat(table, lambda value: not isinstance(value, dict))
    for key, values in found.items():
        if not isinstance(values, list):
            raise InputError(f"[{where}] {key} = {values!r}; allowed: a list of values")
    for section in ("surface", "counterface"):
        key = f"{section}.file"
        if key in found:
            found[key] = [_beside(folder, key, name) for name in found[key]]
        for part in found.get(section, []):
            if isinstance(part, dict) and "file" in part:
                part["file"] = _beside(folder, key, part["file"])
    return found


def _beside(folder: Path, key: str, name) -> str:
    path = (folder / str(name)).resolve()
    if not path.is_file():
        raise InputError(f"{key} = {name!r}: no such file in {folder}")
    return str(path)


def _sampled(table, file: str) -> tuple:
    """The key, or the keys, of [sample], and their values."""
    if not isinstance(table, dict):
        raise InputError("[sample] must be a table")
    options = {key: table.pop(key) for key in SAMPLE_KEYS if key in table}
    if "count" not in options:
        raise InputError(f"[sample] of {file} needs count, the number of points")
    ranges = _flat(table, lambda value: not isinstance(value, dict) or "low" in value)
    for key, given in ranges.items():
        if not isinstance(given, dict) or not {"low", "high"} <= set(given) <= {"low", "high", "scale"}:
            raise InputError(f"[sample] {key} = {given!r}; allowed: {{ low = , high = , scale = 'linear' or 'log' }}")
    drawn = sample([Between(**given) for given in ranges.values()], **options)
    return (*ranges,) if len(ranges) > 1 else [*ranges][0], drawn
