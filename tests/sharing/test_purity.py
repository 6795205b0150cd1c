"""A point is a function of its scene and speed alone: the same bits alone, in a sweep, in any order, after others, in
another process and in a study."""

import contextlib
import pickle
from concurrent.futures import ProcessPoolExecutor
from dataclasses import fields, is_dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scene_text import paper_scene

import lubfric

SPEEDS = (0.002, 0.05, 0.01)
OIL = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70, "density": 870}
LAW = {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.09}
LINE = paper_scene(contact={"shape": (48, 48), "spacing": 1.8e-6}, numerics={"sampling_tolerance": 0.1})
LOOSE = {"sampling_tolerance": 0.3, "model_tolerance": 0.3}
PATCH = LINE.with_(numerics={"sampling": "patch"})
FLAT = lubfric.load_scene("flat").with_(
    contact={"shape": (64, 64), "spacing": 8e-6}, surface={"correlation_length": 24e-6, "acf": "gaussian"}
)
SCENES = {
    "line": LINE,
    "patch": PATCH,
    "summits": PATCH.with_(contact={"model": "summits"}),
    "patches": FLAT.with_(contact={"model": "patches"}),
    "two rough bodies that yield": PATCH.with_(
        bodies={"load": 20.0, "hardness": 2e9},
        lubricant=LAW,
        surface={"acf": "exponential"},
        counterface={"sq": 5e-8, "correlation_length": 6e-6},
    ),
    "flat": FLAT,
    "heat": PATCH.with_(lubricant=OIL | LAW, numerics={"heat": "on"}),
    "rolling": PATCH.with_(motion={"slide_roll_ratio": 0.0}),
    "auto": LINE.with_(
        numerics={"model": "auto", "tolerance": 0.05} | LOOSE, contact={"shape": (48, 48), "spacing": 1.8e-6}
    ),
    "measured": None,
}
CHEAP = LINE.with_(numerics={"tolerance": 0.05, "sampling_tolerance": 0.3}, surface={"correlation_length": 4e-6})
QUICK = list(SCENES)[1:3]
ELSEWHERE = ("auto", "measured", "line")  # seconds: two in another process, the line in speeds in any order
REST = [name for name in SCENES if name not in ("patch", "summits")]


@pytest.fixture(scope="session")
def scene_of(tmp_path_factory):
    """The scene of a name; the measured one reads a file."""
    path = tmp_path_factory.mktemp("map") / "map.npy"
    np.save(path, lubfric.generate_surface((200, 120), 0.9e-6, sq=1e-7, correlation_length=4e-6, seed=5).heights)
    measured = paper_scene(surface={"file": str(path), "spacing": 0.9e-6}, contact={"shape": None, "spacing": None})
    return (SCENES | {"measured": measured}).get


def bits(outcome):
    """Every number of a point, its interval and errors, to the last bit; of a failure, its words."""
    if isinstance(outcome, Exception):
        return str(outcome)
    result = {f.name: getattr(outcome, f.name) for f in fields(outcome)}
    numbers = {name: value.hex() for name, value in result.items() if isinstance(value, float) and name != "seconds"}
    assert len(numbers) > 18
    return numbers, repr(outcome.uncertainty), repr(outcome.errors), outcome.decision.text, outcome.validity


def at(scene, speed):
    try:
        return bits(lubfric.friction(scene, speed))
    except lubfric.LubfricError as error:
        return bits(error)


def swept(scene, speeds, executor=None):
    curve = lubfric.stribeck(scene, speeds, executor, raise_on_failure=False)
    return {u: bits(curve.errors.get(i, point)) for i, (u, point) in enumerate(zip(speeds, curve.points))}


ALONE: dict = {}


def alone(name, scene, speeds=SPEEDS):
    """The points of a scene, each solved from nothing; once a session."""
    for speed in speeds:
        if (name, speed) not in ALONE:
            ALONE[name, speed] = at(scene, speed)
    return {speed: ALONE[name, speed] for speed in speeds}


def assert_pure(name, scene):
    """One after the other in one memory, forwards and backwards; in a sweep; by a copy that went by wire."""
    expected = alone(name, scene)
    assert sum(not isinstance(result, str) for result in expected.values()) >= 3
    prepared = lubfric.prepare(scene)
    assert {u: at(prepared, u) for u in SPEEDS} == expected
    assert at(prepared, SPEEDS[0]) == expected[SPEEDS[0]]
    copy = pickle.loads(pickle.dumps(prepared))
    assert swept(copy, SPEEDS[:0:-1]) == {u: expected[u] for u in SPEEDS[1:]}


@pytest.mark.parametrize("name", QUICK)
def test_no_other_speed_moves_a_bit(name, scene_of):
    assert_pure(name, scene_of(name))


@pytest.mark.parametrize("name", [pytest.param(name, marks=[pytest.mark.slow] * (name in ELSEWHERE)) for name in REST])
def test_no_other_speed_moves_a_bit_of_any_scene(name, scene_of):
    assert_pure(name, scene_of(name))


def test_another_process_moves_no_bit(scene_of):
    """Prepared here, and prepared there."""
    speeds = SPEEDS[1:3]
    with ProcessPoolExecutor(2) as pool:
        for name in ("patch", "auto", "measured"):
            expected = alone(name, scene_of(name), speeds)
            assert swept(lubfric.prepare(scene_of(name)), speeds[::-1], pool) == expected, name
        assert pool.submit(at, scene_of(name), speeds[0]).result() == expected[speeds[0]]


@settings(max_examples=3)
@given(st.lists(st.sampled_from([0.0, -0.01, *SPEEDS]), min_size=2, max_size=2, unique=True))
def test_speeds_in_any_order_and_number(order):
    prepared = lubfric.prepare(CHEAP)
    for speed in order:
        assert at(prepared, speed) == alone("cheap", CHEAP, (speed,))[speed]


def test_a_like_scene_is_prepared_as_if_alone(scene_of):
    """What is remembered of one lubricant, speed or tolerance is not taken for another."""
    prepared = lubfric.prepare(LINE)
    at(prepared, 0.01)
    changes = ("lubricant", "viscosity", 0.1), ("motion", "slide_roll_ratio", 0.5), ("bodies", "load", 9.0)
    for section, key, value in changes:
        scene = LINE.with_(**{section: {key: value}})
        assert at(lubfric.prepare(scene, like=prepared), 0.01) == at(scene, 0.01)
    tight = lubfric.friction(prepared, 0.01, tolerance=2e-3)
    assert bits(tight) == at(LINE.with_(numerics={"tolerance": 2e-3}), 0.01)


def test_fields_are_kept_and_change_no_number():
    shown = lubfric.friction(LINE, 0.01, fields=True)
    assert bits(shown) == alone("line", LINE, (0.01,))[0.01] and shown.pressure.shape == shown.heights.shape


@pytest.mark.parametrize("name", ["patch", "summits", "flat"])
def test_whoever_writes_into_a_result_changes_no_later_answer(name):
    """``result.fields.x *= 1e6``, for a picture in um, once changed f of the prepared scene from .0527 to .0180."""
    prepared = lubfric.prepare(SCENES[name])
    expected = lubfric.friction(prepared, 0.03).coefficient
    result = lubfric.friction(prepared, 0.03, fields=name != "flat")
    count = 0
    for array in arrays_in((result.fields, result.compared_fields, result.details)):
        with contextlib.suppress(ValueError):  # read-only
            array *= 1e6
        count += 1
    assert count > 5
    assert lubfric.friction(prepared, 0.03).coefficient == expected


def arrays_in(value):
    """Arrays of floats in dataclasses and collections."""
    if isinstance(value, np.ndarray):
        return [value] if value.dtype.kind == "f" else []
    parts = value.values() if isinstance(value, dict) else value if isinstance(value, (tuple, list)) else ()
    if is_dataclass(value):
        parts = [getattr(value, field.name) for field in fields(value)]
    return [array for part in parts for array in arrays_in(part)]
