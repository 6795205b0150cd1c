"""All points of a study, laid out before the first is solved: from arguments, or from a study file, which is read
strictly."""

import json
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, is_dataclass, replace
from functools import cached_property
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .._base import FieldsOnly, validate, with_default_errors
from ..errors import InputError
from ..quantities import KEYS
from ..samples import is_measured, whole_maps
from ..scene import Scene, builtin_scenes, given_tables, load_scene, read_toml, speeds_of_range
from ..units import printed
from .choose import EXPECTED_SPEEDS, MOST_CHOSEN_SPEEDS, requested_speeds
from .distributions import DEVIATION, Normal, unit_in
from .explain import explain, warnings_of
from .operating_points import ENTRAINMENT, POINT, operating_points
from .points import SPEED, scene_key
from .store import digest
from .study_file import DRAWN_BEFORE, study_toml
from .vary import (
    VARIED_SLIDING,
    Axis,
    Between,
    axes_of,
    check_viscosity,
    names_varied,
    notes_of_coefficient,
    notes_of_sliding,
    sample,
    unit_of,
)

STUDY_KEYS = ("scene", "speeds", "speed_range", "points", "vary", "together", "sample", DRAWN_BEFORE)
# Sections by which a scene is told from a study file.
SCENE_SECTIONS = {"bodies", "lubricant", "motion", "surface"}
SAMPLE_KEYS = ("count", "sampler", "seed")
OF_SAMPLED = {"low", "mean"}  # of which a table of [sample] has one


@dataclass(frozen=True, kw_only=True)
class StudyPlan(FieldsOnly):
    """The plan of a study: curves over the speed, or operating points, for each combination of the varied values.
    ``print(plan.explain())`` says what it is and will cost; `lubfric.study` carries it out.

    Attributes
    ----------
    scene : that is varied
    axes : dimensions of the study; the last of them, "point", is that of operating points if there are any
    speeds : of all curves [m/s]; none if every curve chooses its own, or of operating points
    point_speeds : of the operating points [m/s], one for each value of the last axis; none of curves
    coordinates : of the operating points, by name: numbers that say where they lie, such as the position or the time
    notes : how columns of the table without a unit were read, and doubts about plain numbers, in sentences
    drawn : how [sample] of a study file drew its points, as text; "": it did not
    keys : of the curves, the last axis fastest: hashes of all that their points depend on in addition to the speed
    """

    scene: Scene
    axes: tuple[Axis, ...]
    speeds: tuple[float, ...]
    keys: tuple[str, ...]
    point_speeds: tuple[float, ...] = ()
    coordinates: dict[str, tuple[float, ...]] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    drawn: str = ""

    @cached_property
    def scenes(self) -> tuple[Scene, ...]:
        """The scenes of the curves, in the order of their ``keys``."""
        return tuple(scenes_of(self.scene, self.axes))

    @property
    def paired(self) -> bool:
        """Whether the study has operating points, each with its own speed, instead of curves."""
        return bool(self.point_speeds)

    @property
    def chooses_speeds(self) -> bool:
        """Whether every curve chooses its own speeds."""
        return not self.speeds and not self.paired

    @property
    def curve_shape(self) -> tuple[int, ...]:
        """Number of values along each axis."""
        return tuple(len(axis.values) for axis in self.axes)

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the results: the axes, then, of curves, the number of speeds, or the largest number that a curve may
        choose."""
        return self.curve_shape if self.paired else (*self.curve_shape, len(self.speeds) or MOST_CHOSEN_SPEEDS)

    @property
    def points(self) -> int:
        """Number of points. Where speeds are chosen it is an estimate."""
        return len(self.keys) * (1 if self.paired else len(self.speeds) or EXPECTED_SPEEDS)

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the axes of the results."""
        axes = tuple(axis.name for axis in self.axes)
        return axes if self.paired else (*axes, POINT if self.chooses_speeds else SPEED)

    @cached_property
    def coords(self) -> dict[str, tuple[str, np.ndarray]]:
        """{key: (dimension, values along it)} of every varied key and, unless curves choose it, the speed [m/s]."""
        varied = {}
        for axis in self.axes:
            for key, values in zip(axis.keys, zip(*axis.values)):
                numbers = all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in values)
                varied[key] = axis.name, np.array(values, dtype=float) if numbers else np.array(_in_words(values))
        if self.paired:
            coordinates = {name: (POINT, np.array(values)) for name, values in self.coordinates.items()}
            return coordinates | varied | {SPEED: (POINT, np.array(self.point_speeds))}
        return varied if self.chooses_speeds else varied | {SPEED: (SPEED, np.array(self.speeds))}

    def point_speed(self, index: tuple[int, ...]) -> float:
        """Return the speed [m/s] of the point at ``index`` of the results; of curves that do not choose it."""
        return (self.point_speeds if self.paired else self.speeds)[index[-1]]

    def speeds_at(self, curve: int) -> tuple[float, ...]:
        """Return the speeds [m/s] that are requested of the curve at place ``curve`` of ``keys``; none if it chooses
        them."""
        return (self.point_speeds[curve % len(self.point_speeds)],) if self.paired else self.speeds

    @cached_property
    def requested(self) -> dict[str, tuple[float, ...]]:
        """The speeds [m/s] that are requested of each key, each once; none where a curve chooses them."""
        if not self.paired:
            return dict.fromkeys(self.keys, self.speeds)
        speeds_of: dict[str, dict[float, None]] = {}
        for curve, key in enumerate(self.keys):
            speeds_of.setdefault(key, {}).update(dict.fromkeys(self.speeds_at(curve)))
        return {key: tuple(speeds) for key, speeds in speeds_of.items()}

    explain = explain
    warnings = warnings_of
    to_toml = study_toml


def _in_words(values: tuple[Any, ...]) -> list[str]:
    """Return ``values`` of a key as the words of a coordinate."""
    words = []
    for value in values:
        if isinstance(value, str):
            words.append(value)
        else:
            words.append(repr(value) if is_dataclass(value) else json.dumps(value))
    return words


def scenes_of(scene: Scene, axes: tuple[Axis, ...]) -> Iterator[Scene]:
    """Yield the scenes of all combinations of the values of ``axes``, the last one fastest."""
    for row in product(*(range(len(axis.values)) for axis in axes)):
        values = {key: value for axis, i in zip(axes, row) for key, value in axis.at(i).items()}
        varied = replace(scene.with_keys(values), transient=None)
        # whether a varied sliding is doubtful is known of the values as they were given (`StudyPlan.notes`)
        if not VARIED_SLIDING.isdisjoint(values):
            others = [row for row in varied.doubtful if not row[0].startswith("motion.")]
            varied = replace(varied, doubtful=tuple(others))
        yield varied


@with_default_errors
def plan_study(
    scene: Scene,
    vary: Mapping[Any, Any] | None = None,
    speeds: str | ArrayLike | None = None,
    points: Any = None,
) -> StudyPlan:
    """Plan a study without solving anything.

    Parameters
    ----------
    scene, vary, speeds, points : as in `lubfric.study`

    Returns
    -------
    StudyPlan : ``print(plan.explain())`` says what it is; `lubfric.study` carries it out

    Raises
    ------
    InputError : a key or a value is not one that a scene can have
    """
    validate.instance("scene", scene, Scene, "a scene to vary: what lubfric.load_scene returned, not lubfric.prepare")
    axes = axes_of(scene, {} if vary is None else vary)
    notes = tuple(notes_of_sliding({} if vary is None else vary))
    if points is None:
        check_viscosity(scene, names_varied(axes))
        return StudyPlan(
            scene=scene,
            axes=axes,
            speeds=requested_speeds(scene, speeds),
            keys=tuple(_scene_keys(scene, axes)),
            notes=(*notes, *notes_of_coefficient(scene, axes)),
        )
    if speeds is not None:
        raise InputError("points and speeds both give speeds; omit speeds, and give a column speed in points")
    table = operating_points(scene, points)
    varied = {key for axis in axes for key in axis.keys}
    twice = varied.intersection(table.axis.keys)
    if twice:
        raise InputError(f"points and vary both give {', '.join(sorted(twice))}; give it in one of them")
    most = math.prod(len(axis.values) for axis in (*axes, table.axis))
    validate.integer("points of the study", most, minimum=1, maximum=1_000_000)
    axes = (*axes, table.axis)
    check_viscosity(scene, names_varied(axes))
    return StudyPlan(
        scene=scene,
        axes=axes,
        speeds=(),
        point_speeds=table.speeds,
        coordinates=table.coordinates,
        notes=(*notes, *table.notes, *notes_of_coefficient(scene, axes)),
        keys=tuple(_scene_keys(scene, axes)),
    )


def _scene_keys(scene: Scene, axes: tuple[Axis, ...]) -> Iterator[str]:
    """Yield the keys of the scenes of ``axes``. A file is read once, however many scenes it serves."""
    digests: dict[str, str] = {}
    for varied in scenes_of(scene, axes):
        maps = None
        if is_measured(varied):
            rough = repr((varied.surface, varied.counterface, varied.contact))
            if rough not in digests:
                digests[rough] = _digest_of_maps(varied)
            maps = digests[rough]
        yield scene_key(varied, maps)


def _digest_of_maps(scene: Scene) -> str:
    """Return the digest of the maps that are read for ``scene``, or why there are none: its points then fail with that
    reason, and the others are solved."""
    try:
        return digest(whole_maps(scene))
    except InputError as error:
        return str(error)


def _scene_for_study(name: str) -> InputError:
    """Return the error of a scene ``name`` where a study is expected."""
    recommendation = f"give a study file with scene = {name!r}, or --points with a table of operating points"
    return InputError(f"{name} is a scene, not a study", recommendation=recommendation)


def load_study(path: str | Path, points: Path | None = None) -> StudyPlan:
    """Return the plan in a study file.

    - ``scene``: a file relative to this one, or a built-in scene.
    - ``speeds`` or ``speed_range``: in m/s.
    - ``points``: a table of operating points: a text file relative to this one, or [[points]] with a table for each.
    - [vary]: keys with lists of values.
    - [[together]]: keys whose lists go together.
    - ``drawn``: how its values were drawn before, a text for its methods.
    - [sample]: keys with {low, high, scale} or {mean, standard_deviation, low, high, scale}, and count, sampler, seed;
      with "speed" among the keys its points are operating points.

    ``points``: a file of operating points, instead of those of the study file; then ``path`` may also be a scene.

    Raises `InputError` for anything else, naming the nearest valid key.
    """
    path = Path(path)
    if points is not None and (not path.is_file() or "scene" not in read_toml(path, "study")):
        return plan_study(load_scene(path if path.is_file() else str(path)), points=points)
    if not path.is_file() and str(path) in builtin_scenes():
        raise _scene_for_study(str(path))
    try:
        table = read_toml(path, "study")
    except InputError as error:
        if path.suffix.lower() != ".csv":
            raise
        recommendation = f"give a scene, and the table by --points {path.name}"
        raise InputError(f"{path.name} is a table, not a study", recommendation=recommendation) from error
    if "scene" not in table and not SCENE_SECTIONS.isdisjoint(table):
        raise _scene_for_study(path.name)
    validate.keys(path.name, table, STUDY_KEYS)
    name: Any = table.get("scene")
    validate.instance(f"scene of {path.name}", name, str, "a file or a built-in scene")
    beside = path.parent / name
    scene = load_scene(beside if beside.is_file() else name)
    vary: dict[Any, list[Any]] = _lists(table.get("vary", {}), "vary", path.parent)
    together = table.get("together", [])
    for group in together if isinstance(together, list) else [together]:
        lists = _lists(group, "together", path.parent)
        if len({len(values) for values in lists.values()}) != 1:
            lengths = ", ".join(f"{key} with {len(values)}" for key, values in lists.items()) or "none"
            raise InputError(f"[[together]] of {path.name} needs lists of one length; found {lengths}")
        _add(vary, tuple(lists), list(zip(*lists.values())))
    speeds = table.get("speeds")
    operating_points: Any = points
    how_drawn: Any = table.get(DRAWN_BEFORE, "")
    validate.instance(f"{DRAWN_BEFORE} of {path.name}", how_drawn, str, "a text")
    if "sample" in table:
        if DRAWN_BEFORE in table:
            message = f"{path.name} has {DRAWN_BEFORE}, how its values were drawn, and [sample], which draws others"
            raise InputError(message, recommendation="give one of the two")
        options = table["sample"]
        (keys, drawn) = _sampled(dict(options) if isinstance(options, dict) else options, path.name)
        how_drawn = _drawn_in_words(options)
        if SPEED in keys:
            if points is not None or "points" in table:
                message = f"[sample] of {path.name} has speeds, and points has them too"
                raise InputError(message, recommendation="give them in one of the two")
            operating_points = {key: list(column) for key, column in zip(keys, zip(*drawn))}
        else:
            _add(vary, keys if len(keys) > 1 else keys[0], drawn)
    if "speed_range" in table:
        if speeds is not None:
            raise InputError(f"{path.name} has speeds and speed_range, which give the same quantity; give one of them")
        speeds = speeds_of_range("speed_range", table["speed_range"])
    if "points" in table and points is None:
        rows = table["points"]
        operating_points = path.parent / rows if isinstance(rows, str) else _flat_rows(rows)
    return replace(plan_study(scene, vary, speeds, operating_points), drawn=how_drawn)


def given_tables_of_study(path: str | Path) -> dict[str, Any]:
    """Return the tables of the scene of a study as they are written; ``path``: the study file, or the scene."""
    path = Path(path)
    table = given_tables(str(path))
    name = table.get("scene")
    if not isinstance(name, str):
        return table
    beside = path.parent / name
    return given_tables(str(beside) if beside.is_file() else name)


def _drawn_in_words(table: Any) -> str:
    """Return how [sample] of a study file draws its points, as text."""
    given = table if isinstance(table, dict) else {}
    how = "independent random points" if given.get("sampler") == "random" else "a scrambled Sobol sequence"
    seeded = f"{given.get('count')} sets of values drawn as {how} with the seed {given.get('seed', 0)}"
    ranges = _flat({key: part for key, part in given.items() if key not in SAMPLE_KEYS}, _is_value)
    return "; ".join((seeded, *(_distribution_in_words(key, part) for key, part in ranges.items())))


def _distribution_in_words(key: str, given: dict[str, Any]) -> str:
    """Return the distribution that [sample] has ``given`` for a ``key``, as text."""
    unit = printed("m/s" if key == SPEED else unit_of(key))
    words = {name: value if isinstance(value, str) else f"{value:g} {unit}".strip() for name, value in given.items()}
    limits = " ".join(f"{word} {words[end]}" for end, word in (("low", "from"), ("high", "to")) if end in words)
    is_log = given.get("scale") == "log"
    if "mean" not in words:
        return f"{key} of a uniform distribution{' of its logarithm' if is_log else ''} {limits}"
    kind = "lognormal" if is_log else "normal"
    text = f"{key} of a {kind} distribution with the mean {words['mean']} and the standard deviation {words[DEVIATION]}"
    return f"{text}, cut off {limits}" if limits else text


def _flat_rows(rows: Any) -> Any:
    """Return rows of a study file with dotted keys in place of tables within them."""
    if isinstance(rows, list):
        return [_flat(row, lambda value: not isinstance(value, dict)) if isinstance(row, dict) else row for row in rows]
    return _flat(rows, lambda value: not isinstance(value, dict)) if isinstance(rows, dict) else rows


def _add(known: dict[Any, Any], key: str | tuple[str, ...], values: Any) -> None:
    """Put ``values`` into ``known``. Raises `InputError` for a key that is there already, whose values would be
    lost."""
    if key in known:
        raise InputError(f"vary: {', '.join(key) if isinstance(key, tuple) else key} is given twice; give it once")
    known[key] = values


def _flat(table: dict[str, Any], is_value: Callable[[Any], bool]) -> dict[str, Any]:
    """Return {"section.key": value} from ``"section.key" = value`` or ``section.key = value``."""
    flat: dict[str, Any] = {}
    for key, value in table.items():
        inner = {key: value} if is_value(value) else {f"{key}.{name}": part for name, part in value.items()}
        for name, part in inner.items():
            _add(flat, name, part)
    return flat


def _lists(table: Any, where: str, folder: Path) -> dict[str, list[Any]]:
    """Return the lists of values by their keys. Files are relative to ``folder``."""
    validate.instance(f"[{where}]", table, dict, "keys of a scene with lists of values")
    lists = _flat(table, lambda value: not isinstance(value, dict))
    for key, values in lists.items():
        validate.instance(f"[{where}] {key}", values, list, "a list of values")

    def path_from_folder(key: str, name: str) -> str:
        path = (folder / str(name)).resolve()
        if not path.is_file():
            raise InputError(f"{key} = {name!r}: no such file in {folder}")
        return str(path)

    for key in ("surface.file", "counterface.file"):
        if key in lists:
            lists[key] = [path_from_folder(key, name) for name in lists[key]]
        for part in lists.get(key.removesuffix(".file"), []):
            if isinstance(part, dict) and "file" in part:
                part["file"] = path_from_folder(key, part["file"])
    return lists


def _sampled(table: Any, file: str) -> tuple[tuple[str, ...], list[Any]]:
    """Return the keys of [sample], and what is drawn: their values at each point, of one key the value."""
    validate.instance("[sample]", table, dict, "a table")
    options: dict[str, Any] = {key: table.pop(key) for key in SAMPLE_KEYS if key in table}
    if "count" not in options:
        raise InputError(f"[sample] of {file} needs count, the number of points")
    ranges = _flat(table, _is_value)
    if ENTRAINMENT in ranges:
        _add(ranges, SPEED, ranges.pop(ENTRAINMENT))
    distributions = {key: _distribution(key, given) for key, given in ranges.items()}
    drawn = sample(distributions.values(), **options)
    for (key, distribution), column in zip(distributions.items(), zip(*drawn)):
        name = ENTRAINMENT if key == SPEED else key
        if isinstance(distribution, Normal) and name in KEYS:
            for value in (min(column), max(column)):
                _check_drawn(key, name, value)
    return (*ranges,), drawn


def _is_value(part: Any) -> bool:
    """Return whether a ``part`` of [sample] is what it has for a key, not a table of keys of a section."""
    return not isinstance(part, dict) or not OF_SAMPLED.isdisjoint(part)


def _distribution(key: str, given: Any) -> Between | Normal:
    """Return the range or the normal distribution that [sample] has ``given`` for a ``key``."""
    is_normal = isinstance(given, dict) and "mean" in given
    needed = {"mean", DEVIATION} if is_normal else {"low", "high"}
    if not isinstance(given, dict) or not needed <= set(given) <= {*needed, "low", "high", "scale"}:
        raise InputError(
            f"[sample] {key} = {given!r}; allowed: {{ low = , high = , scale = 'linear' or 'log' }}, "
            f"or {{ mean = , {DEVIATION} = , low = , high = , scale = }}, a normal distribution"
        )
    unit = "m/s" if key == SPEED else unit_of(key)
    ends = {end for end in given if end != "scale"}
    numbers = given | {end: validate.in_plain(f"[sample] {key} {end}", given[end], unit) for end in ends}
    if not is_normal:
        return Between(**numbers)
    if isinstance(given[DEVIATION], str):
        numbers[DEVIATION] -= validate.in_plain(key, f"0 {unit_in(given[DEVIATION])}", unit)
    return Normal(**numbers)


def _check_drawn(key: str, name: str, value: float) -> None:
    """Raise `InputError` where a ``value`` that was drawn is none that the key ``name``, ``key`` in [sample], can
    have."""
    try:
        validate.of_key(name, value)
    except InputError as error:
        ways = "give low and high in [sample], the limits of the normal distribution, or scale = 'log'"
        raise InputError(f"[sample] {key}: {error}", recommendation=ways) from None
