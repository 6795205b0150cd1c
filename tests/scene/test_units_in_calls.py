"""Units in the arguments of Python calls, as a scene takes them: each call with words gives what it gives with the
plain numbers beside it, and a unit of another kind is refused before any work."""

import numpy as np
import pytest
import scene_text

import lubfric
from lubfric import oil

PATCH = scene_text.paper_scene(numerics={"model": "paper", "sampling": "patch"})
MAP = lubfric.generate_surface((48, 48), 1e-6, sq=1e-7, correlation_length=4e-6, seed=1)
OIL = oil.from_viscosities(68e-6, 8.6e-6)
FILM = {"radius": 0.006, "e_prime": 2.2e11, "entrainment_speed": 1.0, "viscosity": 0.02}
FILM |= {"load_per_width": 1e4, "pressure_viscosity_coefficient": 1.8e-8, "inlet_length": 1e-3}
CURVE = lubfric.stribeck(PATCH, [0.01, 0.1, 1.0])
FB = "bodies.boundary_friction_coefficient"
CALLS = {  # name: (call of one value, that value in words, plain, words of another kind)
    "friction": (lambda u: lubfric.friction(PATCH, u).coefficient, "1 m/s", 1.0, "1 m"),
    "tolerance": (lambda t: lubfric.friction(PATCH, 1.0, tolerance=t).coefficient, "2 %", 0.02, "2 mm"),
    "stribeck": (lambda u: lubfric.stribeck(PATCH, u).coefficient, ["1 m/s", "200 cm/s"], [1.0, 2.0], ["1 K"]),
    "stribeck, one": (lambda u: lubfric.stribeck(PATCH, u).speed, "300 mm/s", 0.3, "3 N"),
    "traction": (lambda s: lubfric.traction(PATCH, s).coefficient, ["100 %"], [1.0], ["1 m/s"]),
    "at": (lambda u: CURVE.at(u), ["50 mm/s"], [0.05], ["50 mm"]),
    "study": (
        lambda w: lubfric.study(PATCH, {"bodies.load": w}, [1.0]).coords["bodies.load"][1],
        ["2 N"],
        [2.0],
        ["2 K"],
    ),
    "speeds": (lambda u: lubfric.plan_study(PATCH, {}, u).speeds, ["2 mm/s"], [0.002], ["2 mm"]),
    "fit": (
        lambda b: lubfric.explain_fit(PATCH, lubfric.Measured([0.1, 1], [0.1, 0.05]), {FB: b})[:100],
        ("5 %", "20 %"),
        (0.05, 0.2),
        ("5 N", "20 N"),
    ),
    "measured": (lambda u: lubfric.Measured(u, ["10 %", "5 %"]).x, ["10 cm/s", "1 m/s"], [0.1, 1], ["1 N", "1 N"]),
    "lubricant": (lambda eta: lubfric.Lubricant(eta, 2e-8), "80 mPa s", 0.08, "80 mm2/s"),
    "bodies": (
        lambda r: lubfric.Bodies(r, "6 mm", load="5 N", e_prime="231 GPa", boundary_friction_coefficient=0.1).radius,
        "2 mm",
        0.002,
        "2 N",
    ),
    "film": (lambda w: lubfric.solve_ehl(**FILM | {"load_per_width": w}).min_film, "10 N/mm", 1e4, "10 N"),
    "contact": (
        lambda p: lubfric.solve_contact(-MAP.heights, 1e-6, 2e11, mean_pressure=p).mean_gap,
        "5 MPa",
        5e6,
        "5 N",
    ),
    "gap": (
        lambda h: lubfric.solve_contact(-MAP.heights, 1e-6, 2e11, mean_gap=h).mean_pressure,
        "0.2 µm",
        2e-7,
        "1 Pa",
    ),
    "summits": (lambda d: lubfric.asperity_contact(MAP.heights, 1e-6, 2e11, separation=d).load, "100 nm", 1e-7, "1 N"),
    "modulus": (
        lambda e: lubfric.separation_for_load(MAP.heights, 1e-6, e, mean_pressure=1e6).load,
        "200 GPa",
        2e11,
        "2 m",
    ),
    "generated": (
        lambda sq: lubfric.generate_surface((48, 48), 1e-6, sq=sq, correlation_length=4e-6, seed=1).heights,
        "80 nm",
        8e-8,
        "80 °C",
    ),
    "spacing": (lambda d: lubfric.Surface(MAP.heights, d).spacing, ["1 µm", "1000 nm"], [1e-6, 1e-6], ["1 N", "1 N"]),
    "filter": (lambda s: MAP.filtered(s=s).heights, "6 µm", 6e-6, "6 s"),
    "run_in": (
        lambda d: lubfric.run_in(PATCH.with_(bodies={"hardness": "2 GPa"}), MAP, passes=1, step=d).deepest,
        "4 µm",
        4e-6,
        "4 °",
    ),
    "oil": (lambda t: OIL.viscosity(t), "70 °C", 343.15, "70 m"),
    "oils": (lambda t: OIL.density_at(t), ["70 °C", "300 K"], [343.15, 300.0], ["70 m"]),
    "density": (lambda d: oil.from_grade("ISO VG 68", 95, density=d).density, "870 kg/m3", 870.0, "870 kg"),
    "table": (
        lambda t: oil.from_table([t, "100 °C" if isinstance(t, str) else 373.15], ["68 mm2/s", "8.6 mm2/s"]).slope(
            350.0
        ),
        "40 °C",
        313.15,
        "40 N",
    ),
    "thinning": (lambda t: OIL.temperature_coefficient(t), "70 °C", 343.15, "70 s"),
}


@pytest.mark.parametrize("name", CALLS)
def test_a_call_takes_words_where_a_scene_does(name):
    call, words, plain, other = CALLS[name]
    result = call(words)
    known = call(plain)
    assert np.array_equal(result, known) if not isinstance(known, (str, lubfric.Lubricant)) else result == known
    with pytest.raises(lubfric.InputError, match="does not convert|unknown unit"):
        call(other)


@pytest.mark.parametrize("word", ["fast", "1", "", "1 furlong/s", "m/s"])
def test_words_without_a_known_unit_are_refused(word):
    for call in (lambda: lubfric.friction(PATCH, word), lambda: lubfric.stribeck(PATCH, [word, 1.0])):
        with pytest.raises(lubfric.InputError, match="plain number in m/s, or one with a unit in quotes: '20 m/s'"):
            call()


MIXED = {  # lists in which some numbers have a unit and others none
    "scene, pair": lambda: PATCH.with_(bodies={"conductivity": ["46 W/(m K)", 40]}),
    "scene, range": lambda: PATCH.with_(bodies={"boundary_friction_coefficient": [0.05, "12 %"]}),
    "scene, speeds": lambda: PATCH.with_(motion={"speeds": ["1 mm/s", 5]}),
    "scene, file": lambda: lubfric.load_scene(tables(motion={"speeds": ["1 mm/s", "5"]})),
    "scene, range of speeds": lambda: lubfric.load_scene(tables(motion={"speed_range": ["1 mm/s", 5.0, 7]})),
    "stribeck": lambda: lubfric.stribeck(PATCH, ["1 mm/s", 5]),
    "stribeck, text": lambda: lubfric.stribeck(PATCH, speeds=["1", "5 mm/s"]),
    "speeds of a study": lambda: lubfric.plan_study(PATCH, {}, ["1 mm/s", 5]),
    "traction": lambda: lubfric.traction(PATCH, ["10 %", 0.2], speed=0.03),
    "study": lambda: lubfric.study(PATCH, {"bodies.load": ["2 N", 3.0]}, [1.0]),
    "study, tuples": lambda: lubfric.study(
        PATCH, {("bodies.load", "bodies.radius"): [("2 N", 1e-3), (3.0, 2e-3)]}, [1.0]
    ),
    "points, rows": lambda: lubfric.study(PATCH, points=[{"load": "2 N", "speed": 0.1}, {"load": 3.0, "speed": 0.1}]),
    "points, columns": lambda: lubfric.study(PATCH, points={"speed": ["1 mm/s", 5.0]}),
    "fit": lambda: lubfric.explain_fit(PATCH, lubfric.Measured([0.1, 1], [0.1, 0.05]), {FB: ("5 %", 0.2)}),
    "measured": lambda: lubfric.Measured([0.1, "1 m/s"], [0.1, 0.05]),
    "spacing": lambda: lubfric.Surface(MAP.heights, ["1 µm", 1e-6]),
}


def tables(**changed):
    """The tables of a scene, some of them changed."""
    import tomllib

    given = tomllib.loads(PATCH.to_toml())
    given["motion"] = {"entrainment_speed": 0.03, "slide_roll_ratio": 2.0}
    return {**given, **{name: given[name] | table for name, table in changed.items()}}


@pytest.mark.parametrize("name", MIXED)
def test_units_on_some_members_only_are_refused(name):
    """["1 mm/s", 5] may mean 5 m/s or 5 mm/s. A zero needs none, and a decimal comma is named."""
    with pytest.raises(lubfric.InputError, match="with a unit and .* without one; give each its unit, or none"):
        MIXED[name]()


def test_a_zero_needs_no_unit_and_a_decimal_comma_is_named():
    assert list(lubfric.plan_study(PATCH, {}, [0, "2 mm/s"]).speeds) == [0.0, 0.002]
    for call in (
        lambda: lubfric.stribeck(PATCH, ["1,5 mm/s", "5 mm/s"]),
        lambda: lubfric.friction(PATCH, "1,5 mm/s"),
        lambda: PATCH.with_(motion={"speeds": ["1,5 mm/s"]}),
        lambda: lubfric.study(PATCH, {"bodies.load": ["2,5 N"]}, [1.0]),
        lambda: lubfric.study(PATCH, points=[{"load": "2,5 N", "speed": 0.1}]),
        lambda: lubfric.traction(PATCH, ["10,5 %"], speed=0.03),
    ):
        with pytest.raises(lubfric.InputError, match=r"write a point in decimals, \d+\.5"):
            call()
