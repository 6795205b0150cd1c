"""All points of a study, laid out before the first is solved: from arguments, or from a study file, which is read
strictly."""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property
from itertools import product
from pathlib import Path
from typing import Any

from .._base import FieldsOnly, validate, with_default_errors
from ..errors import InputError
from ..scene import Scene, load_scene, read_toml, speeds_of_range
from .choose import CHOSEN, MOST, asked_speeds
from .explain import explain
from .store import fingerprint
from .vary import Axis, Between, axes_of, sample, unit_of

KEYS = ("scene", "speeds", "speed_range", "vary", "together", "sample")
SAMPLE_KEYS = ("count", "sampler", "seed")


@dataclass(frozen=True)
class StudyPlan(FieldsOnly):
    """The plan of a study: curves over the speed, one for each combination of the varied values.
    ``print(plan.explain())`` says what it is and will cost; `lubfric.study` carries it out.

    ``speeds`` [m/s]: none if every curve chooses its own; ``keys`` of the curves: hashes of all that their points
    depend on beside the speed, the last axis fastest.
    """

    scene: Scene
    axes: tuple[Axis, ...]
    speeds: tuple[float, ...]
    keys: tuple[str, ...]

    @cached_property
    def scenes(self) -> tuple[Scene, ...]:
        """Those of the curves, in the order of their ``keys``."""
        return scenes_of(self.scene, self.axes)

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the results: the axes, then the number of speeds, or the largest number that a curve may choose."""
        return (*(len(axis.values) for axis in self.axes), len(self.speeds) or MOST)

    @property
    def points(self) -> int:
        """Number of points. Where speeds are chosen it is an estimate."""
        return len(self.keys) * (len(self.speeds) or CHOSEN)

    explain = explain


def scenes_of(scene: Scene, axes: tuple[Axis, ...]) -> tuple[Scene, ...]:
    """The scenes of all combinations of the values of ``axes``, the last one fastest."""
    rows = product(*(range(len(axis.values)) for axis in axes))
    varied = ({k: v for axis, i in zip(axes, row) for k, v in axis.at(i).items()} for row in rows)
    return tuple(replace(scene.with_keys(values), transient=None) for values in varied)


@with_default_errors
def plan_study(scene: Scene, vary=None, speeds=None) -> StudyPlan:
    """Plan a study without solving anything.

    Parameters
    ----------
    scene, vary, speeds : as in `lubfric.study`

    Returns
    -------
    StudyPlan : ``print(plan.explain())`` tells what it is; `lubfric.study` carries it out

    Raises
    ------
    InputError : a key or a value is not one that a scene can have
    """
    validate.instance("scene", scene, Scene, "a scene to vary: what lubfric.load_scene returned, not lubfric.prepare")
    axes = axes_of(scene, {} if vary is None else vary)
    keys = []
    maps: dict[str, str] = {}  # a map is read once, however many scenes it serves
    for one in scenes_of(scene, axes):
        rough = repr((one.surface, one.counterface))
        if rough not in maps:
            maps[rough] = fingerprint(one.surface, one.counterface)
        others = [getattr(one, f.name) for f in fields(one) if f.name not in ("name", "surface", "counterface")]
        keys.append(fingerprint(maps[rough], *others))
    asked = asked_speeds(scene, speeds)
    if len(set(asked)) < len(asked):
        raise InputError("speeds hold a value twice; give each once, in m/s")
    return StudyPlan(scene, axes, tuple(asked), tuple(keys))


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
    validate.instance(f"scene of {path.name}", name, str, "a file or a built-in scene")
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
            raise InputError(f"{path.name} has speeds and speed_range, which say the same thing; give one of them")
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
    validate.instance(f"[{where}]", table, dict, "keys of a scene with lists of values")
    found = _flat(table, lambda value: not isinstance(value, dict))
    for key, values in found.items():
        validate.instance(f"[{where}] {key}", values, list, "a list of values")

    def beside(key: str, name) -> str:
        path = (folder / str(name)).resolve()
        if not path.is_file():
            raise InputError(f"{key} = {name!r}: no such file in {folder}")
        return str(path)

    for key in ("surface.file", "counterface.file"):
        if key in found:
            found[key] = [beside(key, name) for name in found[key]]
        for part in found.get(key.removesuffix(".file"), []):
            if isinstance(part, dict) and "file" in part:
                part["file"] = beside(key, part["file"])
    return found


def _sampled(table, file: str) -> tuple:
    """The key, or the keys, of [sample], and their values."""
    validate.instance("[sample]", table, dict, "a table")
    options = {key: table.pop(key) for key in SAMPLE_KEYS if key in table}
    if "count" not in options:
        raise InputError(f"[sample] of {file} needs count, the number of points")
    ranges = _flat(table, lambda value: not isinstance(value, dict) or "low" in value)
    for key, given in ranges.items():
        if not isinstance(given, dict) or not {"low", "high"} <= set(given) <= {"low", "high", "scale"}:
            raise InputError(f"[sample] {key} = {given!r}; allowed: {{ low = , high = , scale = 'linear' or 'log' }}")
        ends = {end: validate.in_plain(f"[sample] {key} {end}", given[end], unit_of(key)) for end in ("low", "high")}
        ranges[key] = given | ends
    drawn = sample([Between(**given) for given in ranges.values()], **options)
    return (*ranges,) if len(ranges) > 1 else [*ranges][0], drawn
