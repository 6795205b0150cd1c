"""Studies as TOML: strict reading."""

from __future__ import annotations

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
    vary: dict[Any, list] = {**_flat(table.get("vary", {}), "vary", path.parent)}
    together = table.get("together", [])
    for group in together if isinstance(together, list) else [together]:
        lists = _flat(group, "together", path.parent)
        if len({len(values) for values in lists.values()}) != 1:
            raise InputError(f"[[together]] of {path.name} needs lists of one length; found {_lengths(lists)}")
        _add(vary, {tuple(lists): list(zip(*lists.values()))})
    if "sample" in table:
        _add(vary, _sampled(table["sample"], path))
    return plan_study(scene, vary, _speeds(table))


def _flat(table, where: str, folder: Path) -> dict[str, list]:
    """{"section.key": list} from ``"section.key" = [...]`` or ``section.key = [...]``. Files are relative to
    ``folder``."""
    if not isinstance(table, dict):
        raise InputError(f"[{where}] = {table!r}; allowed: keys of a scene with lists of values")
    found: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, dict):
            _add(found, {f"{key}.{inner}": v for inner, v in value.items()})
        else:
            _add(found, {key: value})
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


def _add(known: dict, more: dict) -> None:
    """Put ``more`` into ``known``. Raises `InputError` for a key that is there already, whose values would be lost."""
    for key, value in more.items():
        if key in known:
            raise InputError(f"vary: {', '.join(key) if isinstance(key, tuple) else key} is given twice; give it once")
        known[key] = value


def _beside(folder: Path, key: str, name) -> str:
    path = (folder / str(name)).resolve()
    if not path.is_file():
        raise InputError(f"{key} = {name!r}: no such file in {folder}")
    return str(path)


def _lengths(lists: dict) -> str:
    return ", ".join(f"{key} with {len(values)}" for key, values in lists.items()) or "none"


def _sampled(table, path: Path) -> dict:
    if not isinstance(table, dict):
        raise InputError("[sample] must be a table")
    options = {key: table[key] for key in SAMPLE_KEYS if key in table}
    if "count" not in options:
        raise InputError(f"[sample] of {path.name} needs count, the number of points")
    ranges: dict[str, Between] = {}
    for key, value in table.items():
        if key in SAMPLE_KEYS:
            continue
        inner = value if isinstance(value, dict) and "low" not in value else {"": value}
        for field, given in inner.items():
            if not isinstance(given, dict) or not {"low", "high"} <= set(given) <= {"low", "high", "scale"}:
                raise InputError(
                    f"[sample] {key} = {given!r}; allowed: {{ low = , high = , scale = 'linear' or 'log' }}"
                )
            _add(ranges, {f"{key}.{field}" if field else key: Between(**given)})
    if len(ranges) == 1:
        ((key, only),) = ranges.items()
        return {key: [value for (value,) in sample([only], **options)]}
    return {tuple(ranges): sample(ranges.values(), **options)}


def _speeds(table: dict):
    if "speed_range" not in table:
        return table.get("speeds")
    if "speeds" in table:
        raise InputError("a study takes speeds or speed_range, not both")
    return speeds_of_range("speed_range", table["speed_range"])
