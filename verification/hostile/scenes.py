"""Scenes that ask for something impossible: a good scene with one wrong value, key or table, or two."""

import dataclasses
import typing
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import lubfric

from .case import Case

Tables = dict[str, dict[str, str]]
GOOD: Tables = {  # key: its value as TOML text
    "bodies": {
        "radius": "2e-3", "width": "6e-3", "load": "5.5", "e_prime": "231e9", "boundary_friction_coefficient": "0.09",
    },
    "lubricant": {"viscosity": "0.36", "pressure_viscosity_coefficient": "25e-9"},
    "motion": {"entrainment_speed": "0.01"},
    "surface": {"sq": "1e-7", "correlation_length": "8e-6"},
    "contact": {"geometry": "'flat'", "shape": "[64, 64]", "spacing": "2e-6"},
}  # fmt: skip
EVERY_KEY = ("1979-05-27", "{ a = 1 }", "[[1]]", "nan", "[nan, nan]", "9" * 400, "[1, 2, 3, true]", "'\\u0000'")
NUMBERS = ("'1'", "true", "inf", "-inf", "1e400", "[]", "07:32:00", "5e-324", "1e308", "-1e308")
NEGATIVE = ("-1.0", "-5e-9")
WORDS = ("'nonsense'", "3", "''", "true")
WHOLE = ("1.5", "-1", "99999999999999999999", "2e3")
SIGNED = {"entrainment_speed", "slide_roll_ratio", "sliding_speed", "sliding", "speed", "speeds", "surface_speeds"}
RIGHT = {("speeds", "[]"), ("seed", "99999999999999999999")}  # what the key takes all the same
FREE = {"name", "file"}  # words of any kind, or a path
SHORT = {"bodies": ("young_modulus", "poisson_ratio"), "motion": ("surface_speeds", "speed_range", "sliding_speed")}
IMPOSSIBLE = (  # section, key, value: each alone is in range
    ("bodies", "hardness", "1e7"),
    ("motion", "speed_range", "[1e-3, 1.0, 1000000000000]"),
    ("motion", "speed_range", "[1.0, 1e-3, 4]"),
    ("motion", "surface_speeds", "[0.1, -0.1]"),
    ("surface", "oversize", "1000000"),
    ("surface", "correlation_length", "1e-3"),
    ("surface", "correlation_length", "1e-7"),
    ("surface", "sq", "0.5"),
    ("surface", "file", "'nowhere.npy'"),
    ("surface", "file", "'.'"),
    ("contact", "shape", "[200000, 200000]"),
    ("contact", "shape", "[40]"),
    ("numerics", "workers", "1180591620717411303424"),
    ("transient", "duration", "0.0"),
    ("transient", "outputs", "1000000000000"),
    ("transient", "load", "{ kind = 'ramp', start = 5.0, end = -1.0, until = 1.0 }"),
    ("transient", "speed", "{ kind = 'table', times = [0, 0.5], values = [1, 2] }"),
    ("transient", "speed", "{ kind = 'file', file = 'nowhere.csv', column = 'u' }"),
)
UNUSED = tuple(  # keys that do not apply to a generated map
    ("surface", key, value)
    for key, value in {
        "spacing": "1e-6", "unit": "'um'", "motion_axis": "'y'", "decimal": "','", "form": "'quadratic'",
        "missing_value": "0.0", "outliers": "'mask'", "s_filter": "1e-5", "l_filter": "1e-5", "extension": "'mirror'",
    }.items()
)  # fmt: skip
BROKEN = (
    "", "[bodies", "bodies = 3", "[bodies]\nload = 5.5 N", "[bodies]\nload = 5,5",
    "[bodies]\nload = 5.5\nload = 6.0", "[bodies]\nload = 5.5\n[bodies]", "\x00", "a = " + "[" * 3000 + "]" * 3000,
    "a = " + "{b=" * 3000 + "1" + "}" * 3000, "a = " + "1" * 6000, ".".join("a" * 2000) + " = 1", "x = '''",
    "[bodies]\nload = 0x", "[[bodies]]\nload = 5.5", "\ufeff\ufeff[bodies]",
)  # fmt: skip


def text_of(tables: Tables) -> str:
    """TOML of the tables."""
    return "\n".join(f"[{name}]\n" + "\n".join(f"{k} = {v}" for k, v in keys.items()) for name, keys in tables.items())


def changed(tables: Tables, section: str, key: str, value: str | None) -> Tables:
    """A copy with one key set, or removed where ``value`` is None. What a [transient] needs beside it is added."""
    new = {name: dict(keys) for name, keys in tables.items()}
    if section == "transient":
        new.setdefault("transient", {"duration": "1.0"})
    new.setdefault(section, {}).pop(key, None)
    if value is not None:
        new[section][key] = value
    return new


def keys_of_scene() -> list[tuple[str, str, str]]:
    """(section, key, "word", "whole", "number" or "truth") of every key of a scene, from the annotations of its
    classes."""
    found = []
    for section, hint in typing.get_type_hints(lubfric.Scene).items():
        kinds = [k for k in (hint, *typing.get_args(hint)) if dataclasses.is_dataclass(k)]
        for kind in kinds[:1]:
            for field in dataclasses.fields(kind):
                found.append((section, field.name, _kind(str(field.type))))
    return found + [(section, key, "number") for section, keys in SHORT.items() for key in keys]


def _kind(annotation: str) -> str:
    for word, kind in (("str", "word"), ("bool", "truth"), ("float", "number"), ("int", "whole")):
        if word in annotation:
            return kind
    return "number"


def bad_values(key: str, kind: str) -> Iterator[str]:
    """Values, as TOML text, that no key of this kind can have."""
    yield from (v for v in EVERY_KEY if not (key in FREE and v == "9" * 400))
    if kind == "number":
        yield from NUMBERS
        yield from () if key in SIGNED else NEGATIVE
    elif kind == "word":
        yield from () if key in FREE else WORDS
    elif kind == "whole":
        yield from ("'1'", "true", *WHOLE)
    else:
        yield from ("'no'", "1", "0.0")


def mutations() -> list[tuple[str, str, str | None]]:
    """Every (section, key, value) that makes the good scene a bad one."""
    found: list[tuple[str, str, str | None]] = [
        (section, key, value)
        for section, key, kind in keys_of_scene()
        for value in bad_values(key, kind)
        if (key, value) not in RIGHT
    ]
    found += [(section, key, None) for section, keys in GOOD.items() for key in keys if _needed(section, key)]
    return found + list(IMPOSSIBLE) + list(UNUSED)


def _needed(section: str, key: str) -> bool:
    return (section, key) not in (("lubricant", "pressure_viscosity_coefficient"), ("contact", "geometry"))


def misspelt(rng: np.random.Generator, word: str, known: set[str]) -> str:
    """``word`` with one letter dropped, doubled or exchanged, such that it is no known word."""
    while True:
        i = int(rng.integers(len(word)))
        new = (word[:i] + word[i + 1 :], word[:i] + word[i] + word[i:], word[:i] + "q" + word[i + 1 :])[rng.integers(3)]
        if new and new not in known:
            return new


def cases(rng: np.random.Generator, count: int) -> Iterator[Case]:
    """At least ``count`` scenes: every single mutation, misspelt keys and tables, broken TOML, then random pairs."""
    single, keys = mutations(), keys_of_scene()
    known = {key for _, key, _ in keys} | set(GOOD)
    made = [
        case(f"[{section}] {key} = {str(value)[:40]}", text_of(changed(GOOD, section, key, value)))
        for section, key, value in single
    ]
    for section, key, _ in keys:
        word = misspelt(rng, key, known)
        made.append(case(f"[{section}] {word}", text_of(changed(GOOD, section, word, "1"))))
    for section in GOOD:
        word = misspelt(rng, section, known)
        made.append(case(f"[{word}]", text_of(GOOD).replace(f"[{section}]", f"[{word}]")))
    yield from made
    yield from (case(f"TOML {text[:30]!r}", text) for text in BROKEN)
    for _ in range(count - len(made) - len(BROKEN)):
        (s1, k1, v1), (s2, k2, v2) = (single[i] for i in rng.integers(len(single), size=2))
        tables = changed(changed(GOOD, s1, k1, v1), s2, k2, v2)
        yield case(f"[{s1}] {k1} = {str(v1)[:30]} and [{s2}] {k2} = {str(v2)[:30]}", text_of(tables))


def case(name: str, text: str) -> Case:
    """Load the scene ``text`` and solve it."""

    def run(folder: Path) -> object:
        path = folder / "scene.toml"
        path.write_text(text, encoding="utf-8")
        scene = lubfric.load_scene(path)
        return lubfric.transient(scene) if scene.transient is not None else lubfric.friction(scene)

    return Case("scene", name, run)
