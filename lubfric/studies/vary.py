"""What a study varies: lists of values, lists that go together, and ranges from which samples are drawn."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from .._base import FloatArray, validate, with_default_errors
from ..errors import InputError
from ..quantities import KEYS, worded_value
from ..scene import SOURCES, Roughness, Scene, other_convention, short_keys, typical
from ..units import check_all_have_units, in_si, without_unit
from .distributions import Normal

SAMPLERS = ("sobol", "random")
RANGE_SCALES = ("linear", "log")
MOST_COMBINATIONS = 1_000_000  # combinations of a study, and points of a sample; a choice, for memory
SPEED_KEYS = (
    "speed",
    "speeds",
    "motion.speeds",
    "motion.entrainment_speed",
    "motion.surface_speeds",
    "motion.speed_range",
)
TEMPERATURES = {"lubricant.temperature", "lubricant.temperature_celsius"}
VISCOSITY = "lubricant.viscosity"
PRESSURE_VISCOSITY = "lubricant.pressure_viscosity_coefficient"
VISCOSITIES = {f"lubricant.{key}" for key in (*SOURCES, "viscosity")} | {"lubricant"}
# Keys that change what the pressure-viscosity coefficient of an oil is, but a named oil, which brings its own.
OF_COEFFICIENT = TEMPERATURES | VISCOSITIES - {"lubricant", "lubricant.oil", VISCOSITY}
FITTED = ("bodies", "lubricant", "motion", "surface")  # sections that have what a measurement may tell
VARIED_SECTIONS = (*FITTED, "counterface", "contact", "numerics")
VARIED_SLIDING = {"motion", "motion.slide_roll_ratio", "motion.slip_percent"}  # keys of the sliding
CASE = "case"  # name of the dimension of keys that go together


@dataclass(frozen=True)
class Between:
    """A range [low, high] of a key, in the unit of the key, or both with a unit: "1 N". scale "linear": sampled evenly
    in its value; "log": in its logarithm. ``unit``: in SI, that of ends that have one."""

    low: float
    high: float
    scale: str = "linear"
    unit: str = field(default="", init=False)

    def __post_init__(self) -> None:
        if isinstance(self.low, str) and isinstance(self.high, str):
            (low, unit) = in_si("low", self.low)
            (high, other) = in_si("high", self.high)
            if unit != other:
                raise InputError(f" = {self.high!r} does not convert to {unit}, the unit of low", "high")
            for name, value in (("low", low), ("high", high), ("unit", unit)):
                object.__setattr__(self, name, value)
        validate.choice("scale", self.scale, RANGE_SCALES)
        low = validate.number("low", self.low, "(of the key)", above=0.0 if self.scale == "log" else -math.inf)
        high = validate.number("high", self.high, "(of the key)")
        if high <= low:
            ways = f"write the lower one first, Between({high:g}, {low:g})" if high < low else "give two different ends"
            raise InputError(f" = {low:g} is not below high = {high:g}", "low", recommendation=ways)

    def at(self, share: float) -> float | FloatArray:
        """Return values at ``share`` in [0, 1] of the range, a number or an array."""
        if self.scale == "linear":
            return self.low + share * (self.high - self.low)
        return np.exp(math.log(self.low) + share * math.log(self.high / self.low))

    def share(self, value: float) -> float:
        """Return where a value lies in the range: 0 at its low end, 1 at its high end."""
        if self.scale == "linear":
            return (value - self.low) / (self.high - self.low)
        return math.log(value / self.low) / math.log(self.high / self.low) if value > 0 else -math.inf

    def slope(self, share: float) -> float:
        """Return the change of the value over that of ``share``."""
        if self.scale == "linear":
            return self.high - self.low
        return float(self.at(share)) * math.log(self.high / self.low)


@dataclass(frozen=True)
class Axis:
    """One dimension of a study: ``values[i]`` holds the i-th value of each of ``keys``, which change together."""

    name: str
    keys: tuple[str, ...]
    values: tuple[tuple[Any, ...], ...]

    def at(self, index: int) -> dict[str, Any]:
        """Return the values of position ``index`` by their keys."""
        return dict(zip(self.keys, self.values[index]))


def axes_of(scene: Scene, vary: Mapping[Any, Any]) -> tuple[Axis, ...]:
    """Return the dimensions of ``vary`` (see `lubfric.study`), with each value put into the scene once as a check."""
    validate.instance("vary", vary, dict, 'a dict such as {"bodies.load": [5.0, 10.0]}')
    seen: set[str] = set()
    axes = []
    cases = 0
    points = math.prod(len(v) for v in vary.values() if hasattr(v, "__len__") and getattr(v, "ndim", 1) != 0)
    if points > MOST_COMBINATIONS:
        most = f"up to {MOST_COMBINATIONS:.0e} in a study (several studies, or lubfric.sample for points of the box)"
        raise InputError(f" has {float(points):.3g} combinations", "vary", most)
    for key, values in vary.items():
        keys = key if isinstance(key, tuple) else (key,)
        for name in keys:
            check_key("vary", scene, name, seen)
            seen.add(name)
        cases += len(keys) > 1
        name = keys[0]
        if len(keys) > 1:
            name = CASE if cases == 1 else f"{CASE}_{cases}"
        axis = _listed(name, keys, values)
        for index in range(0 if TEMPERATURES.intersection(keys) else len(axis.values)):
            scene.with_keys(axis.at(index))  # a temperature is checked together with the oil that may be varied too
        axes.append(axis)
    check_temperature("vary", scene, seen)
    return tuple(axes)


@with_default_errors
def sample(ranges: Iterable[Any], count: int, sampler: str = "sobol", seed: int = 0) -> list[tuple[float, ...]]:
    """Return points of a box, as values for keys that `lubfric.study` varies together.

    ``vary={("bodies.load", "lubricant.viscosity"): sample([Between("1 N", "10 N"), Between(0.01, 1, "log")], 64)}``

    Parameters
    ----------
    ranges : a list of `Between` or `Normal`, one for each key
    count : number of points; a power of two for "sobol"
    sampler : "sobol", a scrambled Sobol sequence (`scipy.stats.qmc.Sobol`), which fills the box evenly; or "random",
        independent points
    seed : equal seeds give equal points

    Returns
    -------
    list of tuples, one value for each range: a number, or text with the SI unit where the range has one

    Raises
    ------
    InputError : an argument out of range
    """
    from scipy.stats import qmc

    parts = list(ranges) if isinstance(ranges, Iterable) else []
    if not parts or not all(isinstance(part, (Between, Normal)) for part in parts):
        ways = "a list of lubfric.Between(low, high) or lubfric.studies.Normal"
        raise InputError(f"ranges = {validate.shown(ranges)}; allowed: {ways}")
    validate.choice("sampler", sampler, SAMPLERS)
    count = validate.integer("count", count, minimum=1, maximum=MOST_COMBINATIONS)
    seed = validate.integer("seed", seed, minimum=0)
    if sampler == "sobol":
        if count & (count - 1):
            above = 2 ** count.bit_length()
            message = f" = {count} of a Sobol sequence"
            recommendation = f"write {above // 2} or {above}, or sampler = 'random' for {count} points"
            raise InputError(message, "count", "powers of two", recommendation)
        shares = qmc.Sobol(len(parts), seed=seed).random(count)
    else:
        shares = np.random.default_rng(seed).random((count, len(parts)))
    columns = [part.at(share).tolist() for part, share in zip(parts, shares.T)]
    values = [[f"{v!r} {part.unit}" for v in column] if part.unit else column for part, column in zip(parts, columns)]
    return list(zip(*values))


def check_key(
    what: str, scene: Scene, key: str, seen: dict[str, Between] | set[str], sections: tuple[str, ...] = VARIED_SECTIONS
) -> None:
    """Raise `InputError` for a ``key`` of the argument ``what`` that is none in the ``sections`` of a scene, that is
    what a curve is over, or that was ``seen``."""
    section, _, field = str(key).partition(".")
    if isinstance(key, str) and section in Scene.__dataclass_fields__:
        validate.keys(what, [section], sections)
    if key == "motion" or key in SPEED_KEYS:
        ways = (
            "give speeds = [...] in m/s, or a column speed of operating points (a fit takes those of the measurement)"
        )
        message = f"{what}: {key!r} is the axis of a curve"
        raise InputError(message, recommendation=f"{ways}; motion.slide_roll_ratio is a key")
    if not isinstance(key, str) or section not in sections:
        _refuse_key(what, scene, key, sections)
    part = getattr(scene, section) or Roughness  # a body without roughness has its keys all the same
    allowed = (*part.__dataclass_fields__, *short_keys(section))
    if field not in allowed and any(
        field in (getattr(scene, other) or Roughness).__dataclass_fields__ for other in FITTED
    ):
        _refuse_key(what, scene, key, sections)
    validate.keys(f"{what}: [{section}]", [field] if field else [], allowed)
    if key in seen:
        raise InputError(f"{what}: {key!r} is given twice; give it once")


def _refuse_key(what: str, scene: Scene, key: Any, sections: Iterable[str]) -> NoReturn:
    """Raise `InputError` for a ``key`` whose section is none of ``sections``: with the keys of that name, or the
    nearest one, and the form that a key has."""
    names = [
        f"{section}.{name}"
        for section in sections
        for name in ((getattr(scene, section) or Roughness).__dataclass_fields__ | dict.fromkeys(short_keys(section)))
    ]
    word = str(key)
    last = word.rpartition(".")[2]
    alike = [name for name in names if name.rpartition(".")[2] == last and not name.startswith("counterface.")]
    nearest = get_close_matches(word, names, 1) or get_close_matches(f"{word.partition('.')[0]}.{last}", names, 1)
    near = [name for name in names if get_close_matches(last, [name.rpartition(".")[2]], 1)]
    candidates = alike or nearest or near[:1]
    meant = f" (did you mean {' or '.join(map(repr, candidates))}?)" if candidates else ""
    raise InputError(
        f"{what}: {validate.shown(key)} is not a key of a scene{meant}",
        recommendation="write a key as 'section.key', such as 'bodies.load'; keys that change together are a tuple of "
        "such names, ('bodies.load', 'bodies.radius'), with a tuple of values for each point",
    )


def notes_of_sliding(vary: Mapping[Any, Any]) -> Iterator[str]:
    """Yield where plain numbers of a varied sliding may be of the other convention, percent or ratio, in a sentence."""
    for key, values in vary.items():
        keys = key if isinstance(key, tuple) else (key,)
        rows = [row if isinstance(key, tuple) else (row,) for row in values]
        for name, column in zip(keys, zip(*rows)):
            question = other_convention(name, map(validate.python_value, column))
            if question:
                yield f"the values of {name} have no unit; {question}"


def check_temperature(what: str, scene: Scene, keys: set[str]) -> None:
    """Raise `InputError` for temperatures that leave the viscosity unchanged; ``what``: the argument that holds
    ``keys``."""
    given = keys & TEMPERATURES
    if given and scene.lubricant.oil is None and not keys.intersection(VISCOSITIES):
        oils = "an oil (grade, nu40 and nu100, oil, viscosity_table), or vary lubricant.viscosity together with it"
        raise InputError(
            f"{what}: {min(given)} does not change a viscosity that is given as a number; give the scene {oils}"
        )


def names_varied(axes: Iterable[Axis]) -> Iterator[set[str]]:
    """Yield the keys that each point of each of ``axes`` states, those in a whole section too, by "section.key"."""
    return (_names_in(axis.at(index)) for axis in axes for index in range(len(axis.values)))


def check_viscosity(scene: Scene, varied: Iterable[set[str]]) -> None:
    """Raise `InputError` for ``varied`` keys that put a viscosity in place of the oil of the scene while its
    pressure-viscosity coefficient, an estimate from that oil, would stay what it is."""
    oil = scene.lubricant.oil
    if oil is None or oil.alpha is not None:
        return
    rows = list(varied)
    has_coefficient = any(PRESSURE_VISCOSITY in names for names in rows)
    replaces_oil = any(VISCOSITY in names and "lubricant.oil" not in names for names in rows)
    if has_coefficient or not replaces_oil:
        return
    raise InputError(
        f"{VISCOSITY} is varied, but the viscosity of the scene comes from an oil, which also gives its "
        "pressure-viscosity coefficient",
        recommendation="vary lubricant.nu40, lubricant.grade or lubricant.temperature, or give "
        f"{VISCOSITY} and {PRESSURE_VISCOSITY} as numbers",
    )


def notes_of_coefficient(scene: Scene, axes: Sequence[Axis]) -> Iterator[str]:
    """Yield that a pressure-viscosity coefficient that the scene gives stays the same while ``axes`` vary its oil or the
    temperature, in a sentence. Another named oil brings its own coefficient."""
    oil = scene.lubricant.oil
    if oil is None or oil.alpha is None or any(PRESSURE_VISCOSITY in names for names in names_varied(axes)):
        return
    columns = {key: values for axis in axes for key, values in zip(axis.keys, zip(*axis.values))}
    varied = [key for key, values in columns.items() if key in OF_COEFFICIENT and len(set(map(repr, values))) > 1]
    if varied and "lubricant.oil" not in columns:
        keys = " and ".join(varied)
        yield (
            f"{PRESSURE_VISCOSITY} = {worded_value(PRESSURE_VISCOSITY, oil.alpha)} is used at all values of {keys}, but "
            "differs between oils and falls with the temperature; omit it, so that it is estimated at each of them, or "
            "give a value for each, in [[together]] with them or as a column of the operating points"
        )


def _names_in(values: dict[str, Any]) -> set[str]:
    """Return the keys of ``values``, and those in a whole section, by "section.key"."""
    parts = {f"{key}.{name}" for key, value in values.items() if isinstance(value, dict) for name in value}
    return {*values, *parts}


def _listed(name: str, keys: tuple[str, ...], values: Any) -> Axis:
    try:
        rows = [value for value in values] if not isinstance(values, (str, dict)) else None
    except TypeError:
        rows = None
    if not rows:
        shown = values if not isinstance(values, Between) else "a range: see lubfric.sample"
        raise InputError(f"vary: {', '.join(keys)} = {shown!r}; allowed: a list of values")
    if len(keys) == 1:
        rows = [row if isinstance(row, tuple) and len(row) == 1 else (row,) for row in rows]  # of `sample`: as it is
    for row in rows:
        if not isinstance(row, (tuple, list)) or len(row) != len(keys):
            raise InputError(f"vary: {', '.join(keys)} go together; give {len(keys)} values each time, not {row!r}")
    for key, column in zip(keys, zip(*rows)):
        _check_units(f"vary: {key}", key, column)
    return Axis(name, keys, tuple(tuple(map(_value, keys, row)) for row in rows))


def _check_units(name: str, key: str, values: Iterable[Any]) -> None:
    """Raise `InputError` where some numbers among the ``values`` of a ``key`` have a unit, and others none."""
    if key in KEYS:
        plain = [validate.python_value(value) for value in values]
        check_all_have_units(name, plain, [KEYS[key].unit] * len(plain))


def unit_of(key: str) -> str:
    """Return the unit of a ``key`` of a scene, for messages too."""
    return KEYS[key].unit if key in KEYS else "(of the key)"


def _value(key: str, value: Any) -> Any:
    """Return a value in Python's types and in the unit of the ``key``, a list as a tuple, a path as text."""
    value = str(value) if isinstance(value, Path) else validate.python_value(value)
    value = without_unit(f"vary: {key}", value, KEYS[key].unit, typical(key)) if key in KEYS else value
    if isinstance(value, dict):
        return {name: _value("", part) for name, part in value.items()}
    return tuple(_value(key, part) for part in value) if isinstance(value, list) else value
