"""The inputs of a scene in a report: the value used, how it was given, and what follows from it."""

import math
from collections.abc import Container, Sequence, Set
from itertools import cycle
from typing import Any

from ..models.shared import sentence
from ..quantities import KEYS
from ..scene import BOUNDARY_FILM_KEY, OIL_KEYS, SOURCES, Scene, fields_of_key, short_keys, toml_value
from ..units import range_in_words, worded
from .inputs import FACTS, inputs
from .markup import bullets, row_with_key, table

# A radius that is infinite: the one input that may be.
PLANE = "a plane"
# How an input was given that a fit found.
BY_FIT = "fitted"
# How Sq was given where the scene has the heights of a plateau-honed surface.
DERIVED_FROM_HONED = "derived from sk, spk, svk (nominal; that of a generated map deviates)"
# Key of an oil by its name, from which other inputs follow.
NAMED_OIL = "oil"
# Keys of an oil by its grade, beside which the index is given.
GRADE = "grade"
VISCOSITY_INDEX = "viscosity_index"
# Key of the bodies by their material, from which other inputs follow.
NAMED_MATERIAL = "material"
# Key of the sliding speed over a run, which a scene has in its [transient].
SLIDING_SPEED_KEY = "motion.sliding_speed"
# Keys whose default follows from no other input, also beside an oil with a name.
NEVER_DERIVED = frozenset({"lubricant.limiting_stress_offset", BOUNDARY_FILM_KEY})
# Characters of a value in the column of how an input was given. A choice: it holds the table of a duty cycle.
MOST_GIVEN = 400


def inputs_as_given(
    scene: Scene,
    section: str,
    given: dict[str, Any],
    fitted: Container[str] = (),
    *,
    others: Sequence[Scene] = (),
    varied: Set[str] = frozenset(),
) -> str:
    """Return the inputs of a section: each value used, how it was given, and what follows from them; ``fitted``: the
    keys that a fit found. Of a study only what the ``others`` of its scenes share, without the keys that are
    ``varied``."""
    shown = {name: value for name, value in given.items() if not _is_replaced(f"{section}.{name}", varied)}
    everywhere = [set(inputs(other, section)) for other in others]
    rows = []
    for row in inputs(scene, section):
        (label, text, key, note) = row
        name = key.partition(".")[2]
        value = shown.pop(name, None)
        if key in varied or any(row not in alike for alike in everywhere):
            continue
        source = "derived" if _is_derived(scene, section, name, given) else "default"
        if name == "sq" and "sk" in given:
            source = DERIVED_FROM_HONED
        source = source if value is None else _given(name, value)
        source = BY_FIT if key in fitted else source
        rows.append(row_with_key(label, text + note, source))
    for name, value in shown.items():
        label = KEYS[f"{section}.{name}"].label if f"{section}.{name}" in KEYS else name.replace("_", " ")
        if f"{section}.{name}" in fitted:
            continue
        used = _used_in_words(scene, f"{section}.{name}", value)
        rows.append(row_with_key(label, used, _given(name, value)))
    facts = bullets([sentence(text) for text in _facts_in_common((scene, *others), section, varied)])
    heads = ["quantity", "value used", "given as"]
    return (f"<h3>{section}</h3>{table(heads, rows)}" if rows else "") + facts


def _facts_in_common(scenes: Sequence[Scene], section: str, varied: Set[str]) -> list[str]:
    """Return what follows from the inputs of a section in all ``scenes``, one line each; nothing of speeds that are
    ``varied``, which scenes do not have."""
    if section not in FACTS or (section == "motion" and varied):
        return []
    first, *others = (FACTS[section](scene) for scene in scenes)
    return [text for text in first if all(text in facts for facts in others)]


def _is_replaced(key: str, varied: Set[str]) -> bool:
    """Return whether the value of a ``key`` is not used where keys are ``varied``: one of these is it, states one of the
    same fields, or is an oil."""
    section, _, name = key.partition(".")
    fields = {field for other in varied for field in fields_of_key(other)}
    if section == "lubricant" and name in OIL_KEYS:
        replacing = varied & {key, *(f"{section}.{other}" for other in ("viscosity", *SOURCES))}
        is_kept = name not in SOURCES or name == VISCOSITY_INDEX
        return bool(replacing - {f"{section}.{GRADE}"} if is_kept else replacing)
    return not fields.isdisjoint(fields_of_key(key))


def _used_in_words(scene: Scene, key: str, value: Any) -> str:
    """Return the ``value`` of a ``key`` as a user wrote it, its numbers with their unit; of a history its range over
    the run."""
    if key == SLIDING_SPEED_KEY and scene.transient is not None and scene.transient.sliding is not None:
        return range_in_words(*scene.transient.sliding.range(scene.transient.duration), "m/s")
    if isinstance(value, dict):
        return "a table"
    values = value if isinstance(value, list) else [value]
    units = (KEYS[key].unit if key in KEYS else "-").split(", ")
    numbers_with_units = zip(values, cycle(units))
    return ", ".join(PLANE if number == math.inf else worded(number, unit) for number, unit in numbers_with_units)


def _is_derived(scene: Scene, section: str, name: str, given: dict[str, Any]) -> bool:
    """Return whether a value that is not among the ``given`` keys of a section follows from one of these, and is not
    the default of its key; a material or an oil with a name has values that may be alike."""
    if not any(key in given for key in (*short_keys(section), NAMED_OIL)):
        return False
    used = getattr(scene, section)
    value = getattr(used, name)
    is_default = value is None or value == getattr(type(used), name, None)
    if f"{section}.{name}" in NEVER_DERIVED and is_default:
        return False
    return not is_default or any(key in given for key in (NAMED_MATERIAL, NAMED_OIL))


def _given(name: str, value: Any) -> str:
    text = f"{name} = {toml_value(value)}"
    return text if len(text) <= MOST_GIVEN else f"{text[: MOST_GIVEN - 4]} ..."
