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
    "stribeck": (lambda u: lubfric.stribeck(PATCH, u).coefficient, ["1 m/s", 2.0], [1.0, 2.0], ["1 K"]),
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
        lambda b: lubfric.explain_fit(PATCH, lubfric.Measured([0.1, 1], [0.1, 0.05]), {FB: (b, 0.2)})[:100],
        "5 %",
        0.05,
        "5 N",
    ),
    "measured": (lambda u: lubfric.Measured(u, ["10 %", 0.05]).x, ["10 cm/s", "1 m/s"], [0.1, 1], ["1 N", 1]),
    "lubricant": (lambda eta: lubfric.Lubricant(eta, 2e-8), "80 mPa s", 0.08, "80 mm2/s"),
    "bodies": (lambda r: lubfric.Bodies(r, "6 mm", "5 N", "231 GPa", 0.1).radius, "2 mm", 0.002, "2 N"),
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
    "spacing": (lambda d: lubfric.Surface(MAP.heights, d).spacing, ["1 µm", 1e-6], [1e-6, 1e-6], ["1 N", 1e-6]),
    "filter": (lambda s: MAP.filtered(s=s).heights, "6 µm", 6e-6, "6 s"),
    "run_in": (
        lambda d: lubfric.run_in(PATCH.with_(bodies={"hardness": "2 GPa"}), MAP, passes=1, step=d).deepest,
        "4 µm",
        4e-6,
        "4 °",
    ),
    "oil": (lambda t: OIL.viscosity(t), "70 °C", 343.15, "70 m"),
    "oils": (lambda t: OIL.density_at(t), ["70 °C", 300.0], [343.15, 300.0], ["70 m"]),
    "density": (lambda d: oil.from_grade("ISO VG 68", 95, density=d).density, "870 kg/m3", 870.0, "870 kg"),
    "table": (lambda t: oil.from_table([t, "100 °C"], ["68 mm2/s", "8.6 mm2/s"]).slope(350.0), "40 °C", 313.15, "40 N"),
    "thinning": (lambda t: OIL.temperature_coefficient(t), "70 °C", 343.15, "70 s"),
}


@pytest.mark.parametrize("name", CALLS)
def test_a_call_takes_words_where_a_scene_does(name):
    call, words, plain, other = CALLS[name]
    found = call(words)
    known = call(plain)
    assert np.array_equal(found, known) if not isinstance(known, (str, lubfric.Lubricant)) else found == known
    with pytest.raises(lubfric.InputError, match="another kind|unknown unit"):
        call(other)


@pytest.mark.parametrize("word", ["fast", "1", "", "1 furlong/s", "m/s"])
def test_words_without_a_known_unit_are_refused(word):
    for call in (lambda: lubfric.friction(PATCH, word), lambda: lubfric.stribeck(PATCH, [word, 1.0])):
        with pytest.raises(lubfric.InputError, match="plain number in m/s, or one with a unit in quotes: '20 m/s'"):
            call()
