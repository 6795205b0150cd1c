"""What one input of a study changes between two points that differ in it alone, in sentences."""

import numpy as np

from ..models.shared import percent
from ..quantities import COLUMNS, worded_value
from ..studies import (
    SPEED,
    Difference,
    SingleChange,
    StudyResult,
    columns_of_study,
    differences,
    name_of,
    single_changes,
)
from ..units import beside_interval, interval_in_words, plain_number
from .best_designs import condition_in_words

# Pairs of points whose changes are stated, at most. A choice: more makes a table of a text.
MOST_CHANGES = 6

# Relative change of the full-load film below which it is not stated. A choice: rounding.
SAME_FILM = 1e-3

# Numbers whose changes are stated with their errors, as a sentence names them.
CHANGED = {"coefficient": "f", "power_loss": "the power loss"}


def listed_changes(result: StudyResult) -> list[SingleChange]:
    """Return the pairs of points of a study that differ in one input alone; none where only the speed changes."""
    changes = single_changes(result)
    return changes if any(set(change.before) != {SPEED} for change in changes) else []


def single_change_lines(result: StudyResult, changes: list[SingleChange]) -> list[str]:
    """Return what f, the power loss and the full-load film do at each of the ``changes``, in a sentence or two each, and
    how many are not listed."""
    shown = changes[:MOST_CHANGES]
    pairs = [change.rows for change in shown]
    numbers = {name: differences(result, name, pairs) for name in CHANGED}
    columns = columns_of_study(result)
    lines = []
    for place, change in enumerate(shown):
        at_pair = {name: of_name[place] for name, of_name in numbers.items() if np.isfinite(of_name[place].value)}
        film = columns["full_load_film"][list(change.rows)]
        parts = [_change_in_words(name, difference) for name, difference in at_pair.items()]
        parts += (
            [_film_in_words(*film.tolist())] if (film > 0).all() and abs(film[1] / film[0] - 1.0) > SAME_FILM else []
        )
        if parts:
            lines.append(f"{_input_in_words(change)}, {_joined(parts)}.{_alike_in_words(at_pair)}")
    others = len(changes) - len(shown)
    if others:
        lines.append(
            f"{others} other pairs of points that differ in one input alone are not listed; study.csv has them."
        )
    return lines


def _input_in_words(change: SingleChange) -> str:
    """Return what changes between two points, at which other values, and their numbers, as text."""
    words = []
    for key, before in change.before.items():
        ends = [worded_value(key, value) for value in (before, change.after[key])]
        words.append(f"{name_of(key)} {_between(*ends)}")
    at = f", at {condition_in_words(change.common)}" if change.common else ""
    (one, other) = (row + 1 for row in change.rows)
    return f"From {' and '.join(words)}{at} (points {one} and {other})"


def _between(first: str, last: str) -> str:
    """Return the ``first`` and the ``last`` value as one text, which names a unit of both once."""
    (number, _, unit) = first.rpartition(" ")
    is_common = number and unit == last.rpartition(" ")[2] and not unit.isdigit()
    return f"{number if is_common else first} to {last}"


def _change_in_words(name: str, difference: Difference) -> str:
    """Return how a number changes with its interval, f in percent, as text."""
    is_relative = name == "coefficient"
    unit = "-" if is_relative else COLUMNS[name].unit
    scale = 100.0 / difference.before if is_relative else 1.0
    (value, low, high) = (scale * number for number in (difference.value, *difference.interval))
    after = " %" if is_relative else ""
    sign = "+" if value > 0 else ""
    ends = f"{interval_in_words(low, high, unit, value)}{after} at 95 %" if np.isfinite(low) else "interval not known"
    return f"{CHANGED[name]} by {sign}{beside_interval(value, low, high, unit)}{after} ({ends})"


def _film_in_words(before: float, after: float) -> str:
    """Return how the full-load film [m] changes, as text."""
    change = after / before - 1.0
    sign = "+" if change > 0 else ""
    ends = _between(plain_number(before, "m"), plain_number(after, "m"))
    return f"the full-load film by {sign}{percent(change)} ({ends})"


def _joined(parts: list[str]) -> str:
    """Return ``parts`` of a sentence as one, with the verb in the first."""
    parts = [parts[0].replace(" by ", " changes by ", 1), *parts[1:]]
    return " and ".join(filter(None, (", ".join(parts[:-1]), parts[-1])))


def _alike_in_words(numbers: dict[str, Difference]) -> str:
    """Return which changes cannot be distinguished from 0, as a sentence to be appended; "" where none."""
    names = [CHANGED[name] for name, difference in numbers.items() if not difference.is_distinct]
    if not names:
        return ""
    changes = "These changes" if len(names) > 1 else f"The change of {names[0]}"
    which = f" of {' and '.join(names)}" if len(names) > 1 else ""
    return f" {changes}{which} cannot be distinguished from 0."
