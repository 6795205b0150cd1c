"""Calls of the public functions with one argument that they cannot take, or two."""

import datetime
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import numpy as np

import lubfric
from lubfric.scene import Constant, Harmonic, Ramp, Table

from ...types import TableRow
from .case import HostileCase

HEIGHTS = 1e-8 * np.random.default_rng(0).standard_normal((16, 12))
ANY = ("x", b"1", 1j, float("nan"), float("inf"), object(), [[1]], datetime.date(2020, 1, 1), np.ma.masked, 10**400)
LISTS: tuple[object, ...] = ([1.0, 2.0, 3.0], np.array([1.0]), np.datetime64("2020"), {})
NUMBER: tuple[object, ...] = (*ANY, True, -1.0, 1e308, 5e-324, *LISTS)
SIGNED_NUMBER = tuple(v for v in NUMBER if not (isinstance(v, float) and v in (-1.0, 5e-324)))
COUNT = (*ANY, True, -1, 1.5, "2")
WORD: tuple[object, ...] = (*ANY, "nonsense", 3, None, True, [])
AXES = tuple(v for v in WORD if v is not True)  # one truth is that of both axes
FIELD = (*(v for v in ANY if v != [[1]]), [], [[True, 1.0]], [["1", "2"]], HEIGHTS + 0j, HEIGHTS > 0, HEIGHTS[0])
FIELD += (HEIGHTS[:, :, None], np.full((4, 4), np.nan), np.full((4, 4), 1e308), np.ma.masked_greater(HEIGHTS, 0))
FIELD += (HEIGHTS.astype("M8[s]"), HEIGHTS.astype(str), np.array([[None, 1.0]]), {})
GRID = (*ANY, (0, 4), (4,), (4, 4, 4), (1.5, 4), (-4, 4), (10**7, 10**7), "44", None)
SCENES: tuple[object, ...] = (3, "paper", None, {}, HEIGHTS, object())
SPEEDS: tuple[object, ...] = ([], "0.1", [True], ["0.1"], [1j], [None], [[0.1]], [float("nan")], [10**400], {})
MASKS = (HEIGHTS, "no", np.zeros(HEIGHTS.shape, bool), np.ones((3, 3), bool), [[1]])
MAP = {"shape": (32, 32), "spacing": 1e-6, "sq": 1e-7, "correlation_length": 4e-6, "seed": 1}
CONTACT = {"gap0": HEIGHTS, "spacing": 1e-6, "e_prime": 2e11, "mean_pressure": 1e7}
FILM = {"load_per_width": 1e4, "radius": 1e-2, "e_prime": 2e11, "entrainment_speed": 0.1, "viscosity": 0.1}
FILM |= {"pressure_viscosity_coefficient": 2e-8}


@dataclass(frozen=True)
class Target:
    """A function, arguments that it takes, and for each of them values that it must refuse."""

    name: str
    call: Callable[..., object]
    good: Mapping[str, object]
    bad: Mapping[str, Sequence[object]] = field(default_factory=dict)


@cache
def scene() -> lubfric.Scene:
    """Return a scene that is solved in no time."""
    return lubfric.load_scene("flat").with_(contact={"shape": (64, 64)}, surface={"correlation_length": 8e-6})


@cache
def targets() -> tuple[Target, ...]:
    """Return the public functions and classes."""
    film = dict.fromkeys(FILM, NUMBER) | {"entrainment_speed": SIGNED_NUMBER}
    moving = scene().with_(transient=lubfric.Transient(1e-3, outputs=1))
    unmasked = tuple(v for v in FIELD if not np.ma.isMaskedArray(v) or v is np.ma.masked)
    map_keys = dict.fromkeys(("spacing", "correlation_length", "decay_level", "cutoff"), NUMBER)
    contact_keys = dict.fromkeys(("spacing", "mean_pressure", "tolerance", "hardness"), NUMBER)
    in_time = dict.fromkeys(("duration", "load", "radius", "viscosity", "tolerance", "initial_film"), NUMBER)
    section: dict[str, TableRow] = {"bodies": (3, None, [], {"x": 1}, {"load": "1"}), "nonsense": ({},)}
    section["motion"] = ({"speeds": [True]},)
    table = {"times": (0.0, 1.0), "values": (1.0, 2.0)}
    return (
        Target(
            "generate_surface",
            lubfric.generate_surface,
            MAP,
            map_keys | {"shape": GRID, "sq": NUMBER[:-4], "seed": COUNT, "acf": WORD},
        ),
        Target(
            "Surface",
            lubfric.Surface,
            {"heights": HEIGHTS, "spacing": 1e-6},
            {"heights": unmasked, "spacing": NUMBER, "mask": MASKS, "periodic_axes": AXES},
        ),
        Target(
            "solve_contact",
            lubfric.solve_contact,
            CONTACT,
            contact_keys | {"gap0": FIELD, "e_prime": NUMBER[:-4], "boundary": WORD[:-2], "start": FIELD},
        ),
        Target("solve_ehl", lubfric.solve_ehl, FILM, film),
        Target(
            "friction",
            lubfric.friction,
            {"scene": scene()},
            {"scene": SCENES, "speed": SIGNED_NUMBER, "tolerance": NUMBER},
        ),
        Target(
            "stribeck",
            lubfric.stribeck,
            {"scene": scene(), "speeds": [0.1]},
            {"scene": SCENES, "speeds": (*SPEEDS, object()), "executor": ("process", 2, object()), "tolerance": NUMBER},
        ),
        Target(
            "prepare",
            lubfric.prepare,
            {"scene": scene()},
            {"scene": SCENES, "surface": (HEIGHTS, "x", 3), "like": ("x", 3, scene())},
        ),
        Target("load_scene", lubfric.load_scene, {}, {"source": (3, None, "", b"flat", "a\0b", ".", [])}),
        Target("with_", lambda **sections: scene().with_(**sections), {}, section),
        Target("read_surface", lubfric.read_surface, {}, {"path": (3, None, b"x", "", "a\0b", ".", object())}),
        Target("transient", lubfric.transient, {"scene": moving}, {"scene": (*SCENES, scene())}),
        Target(
            "Transient",
            lubfric.Transient,
            {"duration": 1.0},
            in_time | {"outputs": (*COUNT, 10**12), "initial": WORD, "speed": SIGNED_NUMBER},
        ),
        Target("Constant", Constant, {"value": 1.0}, {"value": SIGNED_NUMBER}),
        Target("Ramp", Ramp, {"end": 1.0}, dict.fromkeys(("start", "end", "until", "begin"), SIGNED_NUMBER)),
        Target("Harmonic", Harmonic, {"mean": 1.0}, dict.fromkeys(("amplitude", "frequency", "phase"), SIGNED_NUMBER)),
        Target("Table", Table, table, {"times": FIELD, "values": FIELD, "repeat": ("no", 1, None)}),
    )


MAY_BE_LARGE = {("Constant", "value"), ("Ramp", "start"), ("Ramp", "end")}
MAY_BE_LARGE |= {("Harmonic", "amplitude"), ("Harmonic", "phase")}


def singles() -> list[tuple[Target, str, object]]:
    """Return every (function, argument, bad value)."""
    return [
        (target, name, value)
        for target in targets()
        for name, values in target.bad.items()
        for value in values
        if not (isinstance(value, float) and abs(value) == 1e308 and (target.name, name) in MAY_BE_LARGE)
    ]


def cases(rng: np.random.Generator, count: int) -> Iterator[HostileCase]:
    """At least ``count`` calls: every bad argument alone, and then random pairs of one function."""
    single = singles()
    for target, name, value in single:
        yield _case(target, {name: value})
    for _ in range(max(0, count - len(single))):
        target, name, value = single[int(rng.integers(len(single)))]
        others = [(n, v) for t, n, v in single if t is target]
        other, second = others[int(rng.integers(len(others)))]
        yield _case(target, {other: second, name: value})


def _case(target: Target, bad: dict[str, object]) -> HostileCase:
    def run(folder: Path) -> object:
        return target.call(**{**target.good, **bad})

    return HostileCase("call", f"{target.name}({', '.join(f'{k} = {_short(v)}' for k, v in bad.items())})", run)


def _short(value: object) -> str:
    return f"<{type(value).__name__}>" if isinstance(value, (np.ndarray, int)) else repr(value)[:40]
