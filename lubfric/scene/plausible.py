"""Likely slips: values far from what machines have, and the unit in which they may have been meant.

A value outside the usual range (keys.toml) is no error: it gets a sentence that names the unit in which it would be
usual.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np

from .._base import packaged
from ..errors import ConvergenceError, InputError
from ..quantities import KEYS
from ..units import converted, number_and_unit, printed, spelled, without_unit, worded
from .bodies import SLIDE_ROLL_RATIO_KEY, SLIP_KEY
from .history import Harmonic, Table
from .short_forms import fields_of_key
from .transient import HISTORIES, Transient


@cache
def typical(name: str) -> dict[str, list[float]]:
    """Return words that represent a value of the key ``name`` (section.key): that value, and the lowest and highest
    that are usual, in the unit of the key."""
    return {word: without_unit(name, values, KEYS[name].unit) for word, (*values, _) in _rows(name).items()}


def source_of(name: str, word: str) -> str:
    """Return where the `typical` value of the key ``name`` for ``word`` was seen in print."""
    source: str = _rows(name)[word][-1]
    return source


def _rows(name: str) -> dict[str, list[Any]]:
    section, _, key = name.partition(".")
    rows: dict[str, list[Any]] = packaged(__package__, "typical.toml").get(section, {}).get(key, {})
    return rows


# A plain number in percent below this, or a plain ratio from `LARGE_RATIO` to `MOST_RATIO`, is as likely of the other
# convention of sliding: slips are 0.1 to 200 %, ratios 0.001 to 2. Not measured: a convention.
SMALL_PERCENT = 0.1
LARGE_RATIO = 1.0
# Digits of a slide-roll ratio that a user writes, at most: a quotient of two speeds has more. A choice.
DIGITS_OF_A_RATIO = 3
MOST_RATIO = 2.0  # simple sliding, which is usual
# Sq [m] that follows from Ra or Rz, above which these were written without a unit: rough castings have some 5e-5 m. A
# smaller one may have been written with a unit, which must not be questioned.
NO_ROUGHNESS = 1e-3
# Times the usual range above it, and below it, from which a plain number that is usual in another unit is refused,
# since it was meant in that. Not measured: a convention. Light loads of microscopic contacts are further below than
# others.
FAR_ABOVE = 10.0
FAR_BELOW = 1000.0
# Key of the radii of both bodies.
RADII_KEY = "bodies.radii"
# Times the usual range above it, from which a plain number of `RADII_KEY` is refused: of rollers of 6 to 30 mm it is
# less than `FAR_ABOVE` times the usual one in m. A convention.
FAR_ABOVE_OF_RADII = 2.0
# Part of a table or of a period that a run shows, below which a time is likely in another unit: ms for s are 1e-3. A
# convention.
LEAST_PART_OF_HISTORY = 0.02
# Periods in a run above which the same is likely. A convention: two show a periodic motion.
MOST_PERIODS_OF_RUN = 100.0
# Numbers from here on are refused where they are read, and are no slip of a unit. A choice, below the largest number.
MOST_READ = 1e300


@dataclass(frozen=True, kw_only=True)
class UnusualValue:
    """A value of a scene that is likely a slip.

    Attributes
    ----------
    key : section.key
    value, limit : the value, and the bound of the usual range that it exceeds (NaN: of a doubtful convention), in
        ``unit``
    written : the value as the user wrote it, "10 mm" or "10 is read as 10 m"; of one that follows from others, its size
    question : what may have been meant, as a question; "" if nothing fits
    advice : what to write
    is_refused : whether the result is refused: a plain number so far out that its unit was certainly another
    """

    key: str
    value: float
    limit: float
    unit: str
    written: str
    question: str
    advice: str
    is_refused: bool = False


def slip(name: str, value: Any) -> str | None:
    """Return the question what ``value`` of the key ``name`` (section.key), a number in its unit or text with a unit,
    was meant to be; of a list, of the first part that is unusual. None: the value is usual; "": nothing fits."""
    parts = value if isinstance(value, (list, tuple)) else (value,)
    return next((question for part in parts if (question := _question(name, part)) is not None), None)


def _question(name: str, written: Any) -> str | None:
    """Return what `slip` does, of one value."""
    q = KEYS.get(name)
    if q is None or not q.usual:
        return None
    v = _in_si(name, written)
    if v is None or q.usual[0] <= abs(v) <= q.usual[1] or v == 0 and q.zero:
        return None
    number = v
    if isinstance(written, str) and (parts := number_and_unit(written)):
        number = float(parts[0])
    unit = likely_unit(name, number, is_text=isinstance(written, str))
    if not unit:
        return ""
    advice = next((other[1] for other in q.meant if not isinstance(other, str) and other[0] == unit), "")
    in_si = f"{converted(number, unit, q.unit):.4g} {printed(q.unit)}".rstrip()
    text = f" {advice[0].upper()}{advice[1:]}." if advice else ""
    same = spelled(unit) == spelled(q.unit)
    return f"did you mean {number:.4g} {printed(unit)}{'' if same else f' ({in_si})'}?{text}"


def _in_si(name: str, written: Any) -> float | None:
    """Return a value of the key ``name`` in its unit; None for one that is no number of usual size."""
    value = written
    if isinstance(written, str):
        try:
            value = without_unit(name, written, KEYS[name].unit, typical(name))
        except InputError:
            return None
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return float(value) if is_number and abs(value) < MOST_READ else None


def likely_unit(name: str, value: float, *, is_text: bool = False) -> str:
    """Return the unit in which a plain ``value`` of the key ``name`` (section.key) is usual, where it is not in that of
    the key; "" where it is, or where none fits. ``is_text``: the value had another unit, so that that of the key fits
    too."""
    q = KEYS.get(name)
    if q is None or not q.usual:
        return ""
    low, high = q.usual
    if not is_text and (low <= abs(value) <= high or value == 0 and q.zero):
        return ""
    units = [other if isinstance(other, str) else other[0] for other in q.meant]
    units = [q.unit, *units] if is_text else units
    return next((unit for unit in units if low <= abs(converted(value, unit, q.unit)) <= high), "")


def unusual_values(scene: Any) -> tuple[UnusualValue, ...]:
    """Return the values of a scene that are outside their usual range, or of a doubtful convention: those that the user
    wrote by the keys that he wrote, then those that follow from others. A slide-roll ratio that follows from speeds is
    in no doubtful unit, whatever its value."""
    unusual = [_of_convention(key, written) or _unusual(key, written) for key, written in scene.doubtful]
    stated = {name for key, _ in scene.doubtful for name in fields_of_key(key)} | {SLIDE_ROLL_RATIO_KEY}
    for name in KEYS:
        section, _, key = name.rpartition(".")
        if name in stated:
            continue
        value = _index(scene) if key == "viscosity_index" else getattr(getattr(scene, section, None), key, None)
        for number in value if isinstance(value, (list, tuple)) else (value,):
            if number is not None:
                unusual.append(_unusual(name, number))
    unusual += _of_duration(scene.transient)
    return tuple(value for value in unusual if value is not None)


def _of_duration(plan: Transient | None) -> list[UnusualValue]:
    """Return that a run in time shows next to nothing of a table or period, or far more periods than are needed: a time
    is likely in another unit."""
    if plan is None:
        return []
    duration = worded(plan.duration, "s")
    unusual = []
    for name, key in HISTORIES.items():
        history = getattr(plan, name)
        length = history.times[-1] if isinstance(history, Table) else 0.0
        if isinstance(history, Harmonic):
            length = 1.0 / history.frequency
        parts = plan.duration / length if length else 1.0
        what = f"the table of {key} lasts {worded(length, 's')}"
        advice = "give the unit in the heading of the time column, as in 'time [ms]', and of transient.duration"
        if isinstance(history, Harmonic):
            what = f"the period of {key} is {worded(length, 's')}"
            advice = "give the units of frequency and transient.duration"
        question = ""
        if parts < LEAST_PART_OF_HISTORY:
            limit = LEAST_PART_OF_HISTORY * length
            question = f"{what}, {1.0 / parts:,.0f} times as long: is one of the two times in another unit?"
        elif parts > MOST_PERIODS_OF_RUN:
            limit = MOST_PERIODS_OF_RUN * length
            question = (
                f"{what}, and the run has {parts:,.0f} of them, where two show a periodic motion: is one of the two "
                "times in another unit?"
            )
        if question:
            unusual.append(
                UnusualValue(
                    key="transient.duration",
                    value=plan.duration,
                    limit=limit,
                    unit="s",
                    written=duration,
                    question=question,
                    advice=advice,
                )
            )
    return unusual[:1]  # columns of one file say the same


def _of_convention(key: str, written: Any) -> UnusualValue | None:
    """Return what is doubtful of the convention of a sliding ``written`` for a ``key``; None where nothing is."""
    unit = KEYS[key].unit
    question = other_convention(key, [written])
    if not question:
        return None
    return UnusualValue(
        key=key,
        value=written,
        limit=math.nan,
        unit=unit,
        written=_read_as(written, unit),
        question=question,
        advice="",
    )


def _unusual(key: str, written: Any) -> UnusualValue | None:
    """Return what is unusual of the value ``written`` for a ``key``; None where it is in its usual range. A tuple:
    plain numbers that were likely all meant in the unit of the first unusual one (`_are_in_one_unit`)."""
    q = KEYS[key]
    if isinstance(written, tuple):
        of_part = next(filter(None, (_unusual(key, part) for part in written)))
        unit = printed(likely_unit(key, of_part.value))
        read = " and ".join(f"{part:.4g} {printed(q.unit)}" for part in written)
        meant = " and ".join(f"{part:.4g} {unit}" for part in written)
        return replace(of_part, written=f"{[*written]} is read as {read}", question=f"did you mean {meant}?")
    question = slip(key, written)
    value = _in_si(key, written)
    if question is None or value is None:
        return None
    if question and key.endswith(".sq") and not isinstance(written, str) and not _is_as_written(value):
        unit = printed(likely_unit(key, value))
        question = f"did you mean ra or rz in {unit}?" if value > NO_ROUGHNESS else ""
    return UnusualValue(
        key=key,
        value=value,
        limit=math.copysign(q.usual[abs(value) > q.usual[1]], value),
        unit=q.unit,
        written=_read_as(written, q.unit),
        question=question,
        advice="check the value and its unit",
        is_refused=_is_far(value, q.usual, above=FAR_ABOVE_OF_RADII if key == RADII_KEY else FAR_ABOVE)
        and bool(question)
        and not isinstance(written, str)
        and _is_as_written(value),
    )


def refuse_far_value(name: str, key: str, written: Any) -> None:
    """Raise `InputError` for a plain number ``written`` for a ``key`` (section.key) whose unit was certainly another,
    as a scene with it is refused. ``name``: what the user calls it."""
    unusual = _unusual(key, written) if key in KEYS and not isinstance(written, str) else None
    if unusual is not None and unusual.is_refused:
        low, high = KEYS[key].usual
        ways = f"{low:g} to {high:g} {printed(unusual.unit)}".rstrip() + " is usual; write another value with its unit"
        raise InputError(f" = {unusual.written}; {unusual.question}", name, recommendation=ways)


def _is_far(value: float, usual: Sequence[float], *, above: float) -> bool:
    """Return whether a ``value`` is outside its ``usual`` range by orders of magnitude; so many times ``above`` it."""
    (low, high) = usual
    return not low / FAR_BELOW * (1 + 1e-9) < abs(value) < above * high * (1 - 1e-9)


def other_convention(key: str, values: Iterable[Any]) -> str:
    """Return the question whether plain ``values`` of the ``key`` of sliding, as the user wrote them, are in the other
    of its two conventions, percent or ratio; "" if they are not doubtful."""
    numbers = [v for v in values if isinstance(v, (int, float)) and not isinstance(v, bool) and v != 0]
    sizes = [abs(v) for v in numbers]
    if not sizes or not math.isfinite(max(sizes)):
        return ""
    if key == SLIP_KEY and max(sizes) < SMALL_PERCENT:
        most = max(numbers, key=abs)
        return (
            f"did you mean slide_roll_ratio = {most:g}, which is {100 * most:g} %? "
            f'Write slip_percent = "{most:g} %" if percent is meant.'
        )
    follows_from_speeds = any(float(f"{size:.{DIGITS_OF_A_RATIO}g}") != size for size in sizes)
    if follows_from_speeds:
        return ""
    if key == SLIDE_ROLL_RATIO_KEY and min(sizes) >= LARGE_RATIO and max(sizes) < MOST_RATIO:
        least = min(numbers, key=abs)
        return (
            f"did you mean slip_percent = {least:g}? "
            f'Write slide_roll_ratio = "{100 * least:g} %" if the ratio is meant.'
        )
    return ""


def check_ratios(name: str, ratios: Any) -> None:
    """Raise `InputError` where plain slide-roll ``ratios``, as the user wrote them, are as percentages are: one above
    2, where the surfaces move in opposite directions, and none below 1 but 0. ``name``: what they are called."""
    parts = ratios if isinstance(ratios, (list, tuple, np.ndarray)) else [ratios]
    sizes = [
        abs(float(v)) for v in parts if isinstance(v, (int, float, np.number)) and not isinstance(v, bool) and v != 0
    ]
    if not sizes or not max(sizes) > MOST_RATIO or min(sizes) < LARGE_RATIO or math.isinf(max(sizes)):
        return
    most = max(sizes)
    message = f": {most:g} is {100 * most:g} %, and above {MOST_RATIO:g} the surfaces move in opposite directions"
    stated = f'for {100 * most:g} % write "{100 * most:g} %"'
    raise InputError(message, name, recommendation=f"did you mean {most:g} %? Write {most / 100:g}; {stated}")


def doubtful_values(section: str, given: Any) -> tuple[tuple[str, Any], ...]:
    """Return (section.key, value as written) of what is ``given`` for a section and outside its usual range, or of a
    doubtful convention."""
    doubtful: list[tuple[str, Any]] = []
    for key, value in given.items() if isinstance(given, dict) else ():
        name = f"{section}.{key}"
        if name == RADII_KEY and _are_in_one_unit(name, value):
            doubtful.append((name, tuple(value)))
            continue
        for part in value if isinstance(value, (list, tuple)) else (value,):
            if other_convention(name, [part]) or slip(name, part) is not None:
                doubtful.append((name, part))
    return tuple(doubtful)


def _are_in_one_unit(name: str, value: Any) -> bool:
    """Return whether a ``value`` for the key ``name`` is a list of plain numbers, some unusual, that are all usual in
    the unit that was likely meant of the first such one."""
    if not isinstance(value, (list, tuple)):
        return False
    if not all(type(part) in (int, float) and math.isfinite(part) for part in value):
        return False
    unit = next(filter(None, (likely_unit(name, part) for part in value)), "")
    low, high = KEYS[name].usual
    return bool(unit) and all(low <= abs(converted(part, unit, KEYS[name].unit)) <= high for part in value)


def _index(scene: Any) -> float | None:
    """Return the viscosity index of the oil; None without one, or of an oil so thin that it has none."""
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
            name = f"{section}.{key}"
            question = None if error.hints or key not in values else slip(name, values[key])
            if question:
                error.hint(f"{name} = {_read_as(values[key], KEYS[name].unit)}; {question}", asks=True)
        raise


@contextmanager
def hint_unusual_values(scene: Any) -> Iterator[None]:
    """Hint at the unusual values of a scene in an `InputError` or `ConvergenceError`: they are its likely cause."""
    try:
        yield
    except (InputError, ConvergenceError) as error:
        for unusual in unusual_values(scene):
            ending = f"; {unusual.question}" if unusual.question else " is unusual."
            error.hint(f"{unusual.key} = {unusual.written}{ending}", asks=bool(unusual.question))
        raise


def _is_as_written(value: float) -> bool:
    """Return whether somebody wrote this number, as its few digits show; else it follows from others."""
    return float(f"{value:.4g}") == value


def _read_as(value: Any, unit: str) -> str:
    """Return a value as given, and how it is read: "12 is read as 12 m"; text with a unit and one that follows from
    others as they are."""
    if isinstance(value, str):
        return value
    if isinstance(value, (int, float)) and not _is_as_written(value):
        return f"{value:.3g} {printed(unit)}".rstrip()
    shown = f"{value:.4g}" if isinstance(value, (int, float)) else f"{value}"
    return shown if unit == "-" else f"{shown} is read as {shown} {printed(unit)}"
