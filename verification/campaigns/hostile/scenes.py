"""Scenes that ask for something impossible: a good scene with one wrong value, key or table, or two."""

import dataclasses
import typing
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import lubfric

from . import HAND
from .case import HostileCase

Tables = dict[str, dict[str, str]]
OWN = HAND["scenes"]
GOOD: Tables = OWN["good"]
EVERY_KEY = ("1979-05-27", "{ a = 1 }", "[[1]]", "nan", "[nan, nan]", "9" * 400, "[1, 2, 3, true]", "'\\u0000'")
SIGNED = {"entrainment_speed", "slide_roll_ratio", "sliding_speed", "sliding", "speed", "speeds", "surface_speeds"}
RIGHT = {  # what the key takes all the same, the last one with a warning
    ("speeds", "[]"),
    ("seed", "99999999999999999999"),
    ("limiting_stress_coefficient", "3"),
}
FREE = {"name", "file"}  # words of any kind, or a path
SHORT = {"bodies": ("young_modulus", "poisson_ratio"), "motion": ("surface_speeds", "speed_range", "sliding_speed")}
LONG = (  # documents that are broken by their size
    "a = " + "[" * 3000 + "]" * 3000, "a = " + "{b=" * 3000 + "1" + "}" * 3000, "a = " + "1" * 6000,
    ".".join("a" * 2000) + " = 1",
)  # fmt: skip


def text_of(tables: Tables) -> str:
    """Return TOML of the tables."""
    return "\n".join(f"[{name}]\n" + "\n".join(f"{k} = {v}" for k, v in keys.items()) for name, keys in tables.items())


def changed(tables: Tables, section: str, key: str, value: str | None) -> Tables:
    """Return a copy with one key set, or removed where ``value`` is None. Other keys that a [transient] needs are
    added."""
    new = {name: dict(keys) for name, keys in tables.items()}
    if section == "transient":
        new.setdefault("transient", {"duration": "1.0"})
    new.setdefault(section, {}).pop(key, None)
    if value is not None:
        new[section][key] = value
    return new


def keys_of_scene() -> list[tuple[str, str, str]]:
    """Return (section, key, "word", "whole", "number" or "truth") of every key of a scene, from the annotations of its
    classes."""
    values = []
    for section, hint in typing.get_type_hints(lubfric.Scene).items():
        kinds = [k for k in (hint, *typing.get_args(hint)) if dataclasses.is_dataclass(k)]
        for kind in kinds[:1]:
            for field in dataclasses.fields(kind):
                values.append((section, field.name, _kind(str(field.type))))
    return values + [(section, key, "number") for section, keys in SHORT.items() for key in keys]


def _kind(annotation: str) -> str:
    for word, kind in (("str", "word"), ("bool", "truth"), ("float", "number"), ("int", "whole")):
        if word in annotation:
            return kind
    return "number"


def bad_values(key: str, kind: str) -> Iterator[str]:
    """Values, as TOML text, that no key of this kind can have."""
    yield from (v for v in EVERY_KEY if not (key in FREE and v == "9" * 400))
    if not (kind == "word" and key in FREE):
        yield from OWN[kind]
    if kind == "number" and key not in SIGNED:
        yield from OWN["unsigned"]


def mutations() -> list[tuple[str, str, str | None]]:
    """Return every (section, key, value) that makes the good scene a bad one."""
    values: list[tuple[str, str, str | None]] = [
        (section, key, value)
        for section, key, kind in keys_of_scene()
        for value in bad_values(key, kind)
        if (key, value) not in RIGHT
    ]
    values += [(section, key, None) for section, keys in GOOD.items() for key in keys if _needed(section, key)]
    return values + [tuple(row) for row in OWN["wrong"]]


def _needed(section: str, key: str) -> bool:
    return (section, key) not in (("lubricant", "pressure_viscosity_coefficient"), ("contact", "geometry"))


def misspelt(rng: np.random.Generator, word: str, known: set[str]) -> str:
    """Return ``word`` with one letter dropped, doubled or exchanged, such that it is no known word."""
    while True:
        i = int(rng.integers(len(word)))
        new = (word[:i] + word[i + 1 :], word[:i] + word[i] + word[i:], word[:i] + "q" + word[i + 1 :])[rng.integers(3)]
        if new and new not in known:
            return new


def cases(rng: np.random.Generator, count: int) -> Iterator[HostileCase]:
    """At least ``count`` scenes: every single mutation, misspelt keys and tables, broken TOML, then random pairs."""
    single = mutations()
    keys = keys_of_scene()
    broken = (*OWN["broken"], *LONG)
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
    yield from (case(f"TOML {text[:30]!r}", text) for text in broken)
    for _ in range(count - len(made) - len(broken)):
        (s1, k1, v1), (s2, k2, v2) = (single[i] for i in rng.integers(len(single), size=2))
        tables = changed(changed(GOOD, s1, k1, v1), s2, k2, v2)
        yield case(f"[{s1}] {k1} = {str(v1)[:30]} and [{s2}] {k2} = {str(v2)[:30]}", text_of(tables))


def case(name: str, text: str) -> HostileCase:
    """Load the scene ``text`` and solve it."""

    def run(folder: Path) -> object:
        path = folder / "scene.toml"
        path.write_text(text, encoding="utf-8")
        scene = lubfric.load_scene(path)
        return lubfric.transient(scene) if scene.transient is not None else lubfric.friction(scene)

    return HostileCase("scene", name, run)
