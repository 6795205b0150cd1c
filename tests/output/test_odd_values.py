"""Values of a kind that nobody foresaw, in every place that takes a list, a path or a switch: answered by an
`InputError` before any work, never by an error of Python or NumPy."""

from functools import partial

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric

RAGGED = [[1.0, 2.0], [3.0]]
PATHS = (True, 3, b"x", "a\0b", 300 * "x", 3000 * "../x")
SCENE = paper_scene(numerics={"sampling": "patch", "tolerance": 0.1}, contact={"shape": (24, 24), "spacing": 2e-6})
OIL = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 40}
HEIGHTS = lubfric.generate_surface((64, 64), 1e-6, sq=1e-7, correlation_length=3e-6, seed=1)


@pytest.fixture(scope="module")
def curve():
    return lubfric.stribeck(SCENE, "auto")


FLAT = lubfric.load_scene("flat").with_(
    contact={"shape": (48, 48), "spacing": 2e-6},
    surface={"sq": 1e-7, "correlation_length": 8e-6, "acf": "gaussian"},
    motion={"speeds": (), "entrainment_speed": 0.05},
)
WARM = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature": 343.0}
OILED = FLAT.with_(lubricant=WARM | {"eyring_stress": 5e6})
HOT = OILED.with_(numerics={"heat": "on"})
MANY = np.linspace(1, 2, 100_000)


def table(rows):
    return partial(FLAT.with_, lubricant={"viscosity_table": rows, "temperature": 343.0})


ODD = {
    "heat beyond any film": partial(lubfric.friction, HOT, 1e5),
    "absolute zero": partial(FLAT.with_, lubricant=OIL | {"temperature_celsius": -273.15}),
    "viscosity index not a number": partial(FLAT.with_, lubricant=WARM | {"viscosity_index": float("nan")}),
    "a grade in a list": partial(FLAT.with_, lubricant=WARM | {"grade": ["ISO VG 68"]}),
    "a table that falls": table([[373.0, 8e-6], [313.0, 68e-6]]),
    "a table that is a word": table("313"),
    "a coefficient that boils": partial(FLAT.with_, lubricant={"temperature": 300.0, "temperature_coefficient": 1e6}),
    "bodies that keep all heat": partial(FLAT.with_, bodies={"conductivity": (0.0, 46.0)}),
    "a map of 1e800 points": partial(lubfric.generate_surface, 10**400, 1e-6, sq=1e-7, correlation_length=8e-6, seed=1),
    "two planes": partial(FLAT.with_, bodies={"radii": (float("inf"), float("inf"))}),
    "a study of 1e10 points": partial(lubfric.study, FLAT, {"bodies.load": MANY, "bodies.radius": 1e-3 * MANY}),
    "a sample without end": partial(lubfric.sample, [lubfric.Between(1, 2)], 2**40),
    "speeds of a curve": partial(lubfric.stribeck, SCENE, RAGGED),
    "speeds of a study": partial(lubfric.study, SCENE, {"bodies.load": [1.0]}, RAGGED),
    "ratios": partial(lubfric.traction, SCENE, RAGGED),
    "fields in words": partial(lubfric.stribeck, SCENE, [0.01], fields="all"),
    "fields too large": partial(lubfric.stribeck, SCENE, [0.01], fields=10**400),
    "fields of an automatic curve": partial(lubfric.stribeck, SCENE, "auto", fields={}),
    "fields of a point": partial(lubfric.friction, SCENE, 0.01, fields=np.array([0.01, 0.02])),
    "table without rows": partial(SCENE.with_, lubricant={"viscosity_table": []}),
    "temperature": partial(SCENE.with_, lubricant=OIL | {"temperature_celsius": 10**400}),
    "masked speeds": partial(SCENE.with_, motion={"speeds": np.ma.masked}),
    "masked values": partial(lubfric.plan_study, SCENE, {"bodies.load": np.ma.masked}, [0.01]),
    "ranges": partial(lubfric.sample, None, 4),
    "other map": partial(HEIGHTS.combined, None),
    "periodic": partial(lubfric.asperity_contact, HEIGHTS.heights, 1e-6, 2e11, separation=1e-7, periodic=[]),
    "heading": partial(lubfric.read_measured, __file__, speed=np.array([1.0, 2.0]), coefficient="f"),
}


@pytest.mark.parametrize("name", ODD)
def test_an_odd_value_is_refused_in_words(name):
    with pytest.raises(lubfric.InputError):
        ODD[name]()


def test_odd_speeds_between_the_points_are_refused(curve):
    with pytest.raises(lubfric.InputError, match="speed"):
        curve.at(RAGGED)


@pytest.mark.parametrize("path", PATHS, ids=range(len(PATHS)))
def test_an_odd_path_is_refused_in_words(path):
    run = SCENE.with_(transient=lubfric.Transient(1e-5, outputs=1))
    for use in (
        partial(lubfric.load_scene, path),
        partial(lubfric.open_study, path),
        partial(lubfric.read_measured, path, speed="U", coefficient="f"),
        partial(lubfric.stribeck, SCENE, [0.01], store=path),
        partial(lubfric.study, SCENE, {"bodies.load": [1.0]}, [0.01], store=path),
        partial(lubfric.transient, run, checkpoint=path),
    ):
        with pytest.raises(lubfric.InputError):
            use()


def test_a_key_of_nothing_is_a_key_omitted():
    table = {
        "bodies": {"radius": 2e-3, "width": 6e-3, "load": 5.5, "e_prime": 231e9, "boundary_friction_coefficient": 0.1},
        "lubricant": {"viscosity": 0.36, "viscosity_law": "constant"},
        "motion": {"entrainment_speed": 0.01},
        "surface": {"sq": 1e-7, "correlation_length": 8e-6},
        "contact": {"shape": [32, 32], "spacing": 2e-6},
    }
    nothing = table | {"motion": {"entrainment_speed": 0.01, "sliding_speed": None}}
    assert lubfric.load_scene(nothing) == lubfric.load_scene(table)


@pytest.mark.parametrize("speed, ratio", [(1e-12, 2.0), (0.05, 0.0), (0.05, -4.0), (0.05, 1e4), (0.0, 1.0)])
def test_heat_at_the_ends_of_motion_is_finite_or_reported(speed, ratio):
    try:
        result = lubfric.friction(HOT.with_(motion={"slide_roll_ratio": ratio}), speed)
    except lubfric.ConvergenceError as error:
        assert f"slide_roll_ratio = {ratio:.3g}" in str(error) and ratio > 1e3
        return
    assert np.isfinite(result.coefficient)
    assert (abs(ratio) <= 2) == (not any("slide-roll ratio" in entry.what for entry in result.validity))


@pytest.mark.parametrize("value", [1.0, "f", [], {}])
def test_what_is_to_be_called_back_must_be_a_function(value):
    plan = lubfric.scene.Transient(duration=1e-4, outputs=2)
    measured = lubfric.Measured(x=[0.01, 0.03, 0.1, 0.3], coefficient=[0.09, 0.05, 0.03, 0.03])
    for name, call in (
        ("on_progress", lambda: lubfric.run_in(SCENE.with_(bodies={"hardness": 2e9}), on_progress=value)),
        ("on_step", lambda: lubfric.transient(SCENE.with_(transient=plan), on_step=value)),
        ("on_point", lambda: lubfric.stribeck(SCENE, [0.1], on_point=value)),
        ("on_point", lambda: lubfric.traction(SCENE, [0.1], speed=0.1, on_point=value)),
        ("on_progress", lambda: lubfric.study(SCENE, {"bodies.load": [5.0]}, [0.1], on_progress=value)),
        ("on_progress", lambda: lubfric.fit(SCENE, measured, {"surface.sq": (1e-8, 1e-7)}, on_progress=value)),
    ):
        with pytest.raises(lubfric.InputError, match=f"{name} = .*None, or a function of"):
            call()


def test_a_film_below_the_last_digit_of_the_load_carries_nothing():
    """It tends to rest, without a step and without a raw error (ln 0 before)."""
    scene = SCENE.with_(numerics={"model": "paper"})
    rest = lubfric.friction(scene, 0.0)
    for speed in (1e-12, 1e-17, 1e-30, 1e-90):
        result = lubfric.friction(scene, speed)
        assert result.coefficient == pytest.approx(rest.coefficient, rel=1e-9)
        assert result.contact_load == pytest.approx(rest.contact_load, rel=1e-9)
