"""Likely slips: values far from what machines have, and the unit in which they may have been meant.

A value outside the usual range (keys.toml) is no error: it gets a sentence that names the unit in which it would be
usual.
"""

import math
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from typing import Any

from .._base import packaged
from ..errors import ConvergenceError, InputError
from ..quantities import KEYS
from ..units import converted, printed, without_unit
from .bodies import SLIDE_ROLL_RATIO_KEY, SLIP_KEY


@cache
def typical(name: str) -> dict[str, list[float]]:
    """Return words that represent a value of the key ``name`` (section.key): that value, and the lowest and highest
    that are usual, in the unit of the key."""
    return {word: without_unit(name, values, KEYS[name].unit) for word, (*values, _) in _rows(name).items()}


def source_of(name: str, word: str) -> str:
    """Return where the `typical` value of the key ``name`` for ``word`` was seen in print."""
    return _rows(name)[word][-1]


def _rows(name: str) -> dict[str, list[Any]]:
    section, _, key = name.partition(".")
    return packaged(__package__, "typical.toml").get(section, {}).get(key, {})


# A plain number in percent below this, or a plain ratio from `LARGE_RATIO` to `MOST_RATIO`, is as likely of the other
# convention of sliding: slips are 0.1 to 200 %, ratios 0.001 to 2. Not measured: a convention.
SMALL_PERCENT = 0.1
LARGE_RATIO = 1.0
MOST_RATIO = 2.0  # simple sliding, which is usual
# Sq [m] that follows from Ra or Rz, above which these were written without a unit: rough castings have some 5e-5 m. A
# smaller one may have been written with a unit, which must not be questioned.
NO_ROUGHNESS = 1e-3


@dataclass(frozen=True, kw_only=True)
class UnusualValue:
    """A value of a scene that is likely a slip.

    Attributes
    ----------
    key : section.key
    value, limit : the value, and the bound of the usual range that it exceeds (NaN: of a doubtful convention), in
        ``unit``
    question : what may have been meant, as a question; "" if nothing fits
    advice : what to write
    """

    key: str
    value: float
    limit: float
    unit: str
    question: str
    advice: str


def slip(name: str, value: Any) -> str | None:
    """Return the question what ``value`` of the key ``name`` (section.key) was meant to be. None: the value is usual; "":
    nothing fits."""
    q = KEYS.get(name)
    if q is None or not q.usual:
        return None
    low, high = q.usual
    numbers = value if isinstance(value, (list, tuple)) else (value,)
    numbers = [v for v in numbers if isinstance(v, (int, float)) and not isinstance(v, bool) and abs(v) < 1e300]
    v = next((v for v in numbers if not low <= abs(v) <= high), None)
    if v is None or v == 0 and q.zero:
        return None
    unit = likely_unit(name, v)
    if not unit:
        return ""
    advice = next((other[1] for other in q.meant if not isinstance(other, str) and other[0] == unit), "")
    in_si = f"{converted(v, unit, q.unit):.4g} {printed(q.unit)}".rstrip()
    text = f" {advice[0].upper()}{advice[1:]}." if advice else ""
    return f"did you mean {v:.4g} {printed(unit)} ({in_si})?{text}"


def likely_unit(name: str, value: float) -> str:
    """Return the unit in which a plain ``value`` of the key ``name`` (section.key) is usual, where it is not in that of
    the key; "" where it is, or where none fits."""
    q = KEYS.get(name)
    if q is None or not q.usual:
        return ""
    low, high = q.usual
    if low <= abs(value) <= high or value == 0 and q.zero:
        return ""
    units = (other if isinstance(other, str) else other[0] for other in q.meant)
    return next((unit for unit in units if low <= abs(converted(value, unit, q.unit)) <= high), "")


def unusual_values(scene: Any) -> tuple[UnusualValue, ...]:
    """Return the values of a scene that are outside their usual range, or of a doubtful convention."""
    unusual = [
        UnusualValue(
            key=key,
            value=value,
            limit=math.nan,
            unit=KEYS[key].unit,
            question=other_convention(key, [value]),
            advice="",
        )
        for key, value in scene.doubtful
    ]
    for name, q in KEYS.items():
        section, _, key = name.rpartition(".")
        value = _index(scene) if key == "viscosity_index" else getattr(getattr(scene, section, None), key, None)
        for number in value if isinstance(value, (list, tuple)) else (value,):
            question = None if number is None else slip(name, number)
            if question and name.endswith(".sq") and not _is_as_written(number):
                unit = printed(likely_unit(name, number))
                question = f"did you mean ra or rz in {unit}?" if number > NO_ROUGHNESS else ""
            if question is not None:
                unusual.append(
                    UnusualValue(
                        key=name,
                        value=float(number),
                        limit=q.usual[abs(number) > q.usual[1]],
                        unit=q.unit,
                        question=question,
                        advice="check the value and its unit",
                    )
                )
    return tuple(unusual)


def other_convention(key: str, values: Iterable[Any]) -> str:
    """Return the question whether plain ``values`` of the ``key`` of sliding, as the user wrote them, are in the other of
    its two conventions, percent or ratio; "" if they are not doubtful."""
    sizes = [abs(v) for v in values if isinstance(v, (int, float)) and not isinstance(v, bool) and v != 0]
    if not sizes or not math.isfinite(max(sizes)):
        return ""
    if key == SLIP_KEY and max(sizes) < SMALL_PERCENT:
        most = max(sizes)
        return (
            f"did you mean slide_roll_ratio = {most:g}, which is {100 * most:g} %? "
            f'If not, write slip_percent = "{most:g} %"'
        )
    if key == SLIDE_ROLL_RATIO_KEY and min(sizes) >= LARGE_RATIO and max(sizes) < MOST_RATIO:
        least = min(sizes)
        return f'did you mean slip_percent = {least:g}? If not, write slide_roll_ratio = "{100 * least:g} %"'
    return ""


def doubtful_values(section: str, given: Any) -> tuple[tuple[str, float], ...]:
    """Return (section.key, value) of the plain numbers ``given`` for a section that are of a doubtful convention."""
    if section != "motion" or not isinstance(given, dict):
        return ()
    names = {key: f"{section}.{key}" for key in given}
    return tuple((names[key], float(value)) for key, value in given.items() if other_convention(names[key], [value]))


def _index(scene: Any) -> float | None:
    """Viscosity index of the oil; None without one, or of an oil so thin that it has none."""
    try:
        return None if scene.lubricant.oil is None else round(scene.lubricant.oil.index, 6)
    except InputError:
        return None


@contextmanager
def naming_slips(section: str, values: dict[str, Any]) -> Iterator[None]:
    """Add the likely slip, if there is one, to an `InputError` about one of ``values``."""
    try:
        yield
    except InputError as error:
        named = [name.rpartition(".")[2].partition("[")[0] for name in (error.quantity, *error.also)]
        for key in dict.fromkeys([*named, *values]):
            question = None if error.hints or key not in values else slip(f"{section}.{key}", values[key])
            if question:
                unit = KEYS[f"{section}.{key}"].unit
                error.hint(f"{section}.{key} = {_read_as(values[key], unit)}; {question}")
        raise


@contextmanager
def warn_unusual_values(scene: Any) -> Iterator[None]:
    """Add the unusual values of a scene to an `InputError` or `ConvergenceError`: they are its likely cause."""
    try:
        yield
    except (InputError, ConvergenceError) as error:
        for slipped in unusual_values(scene):
            if slipped.question:
                error.hint(f"{slipped.key} = {_read_as(slipped.value, slipped.unit)}; {slipped.question}")
            else:
                error.hint(f"{slipped.key} = {slipped.value:g} {printed(slipped.unit)}".rstrip() + " is unusual.")
        raise


def _is_as_written(value: float) -> bool:
    """Return whether somebody wrote this number, as its few digits show; else it follows from others."""
    return float(f"{value:.4g}") == value


def _read_as(value: Any, unit: str) -> str:
    """Return a value as given, and how it is read: "12 is read as 12 m"; one that follows from others as it is."""
    if isinstance(value, (int, float)) and not _is_as_written(value):
        return f"{value:.3g} {printed(unit)}"
    shown = value if isinstance(value, str) else f"{value:.4g}" if isinstance(value, (int, float)) else f"{value}"
    return shown if unit == "-" else f"{shown} is read as {shown} {printed(unit)}"
