"""Someone who wants to break oils, heat, studies, traction, bodies and the resolved models: words every time."""

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric

FLAT = lubfric.load_scene("flat").with_(
    contact={"shape": (48, 48), "spacing": 2e-6},
    surface={"sq": 1e-7, "correlation_length": 8e-6, "acf": "gaussian"},
    motion={"speeds": (), "entrainment_speed": 0.05},
)
OIL = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature": 343.0}
OILED = FLAT.with_(lubricant=OIL | {"eyring_stress": 5e6})
HOT = OILED.with_(numerics={"heat": "on"})
ROLLER = paper_scene(
    lubricant=OIL | {"eyring_stress": 5e6},
    surface={"correlation_length": 8e-6, "acf": "gaussian"},
    contact={"shape": (32, 16), "spacing": 90e-6 / 32},
)
MANY = np.linspace(1, 2, 100_000)

REFUSED = {  # what is done, and a word of the answer
    "heat beyond any film": (lambda: lubfric.friction(HOT, 1e5), "numerics.heat"),
    "absolute zero": (lambda: FLAT.with_(lubricant={"grade": "68", "temperature_celsius": -273.15} | VI), "200, 600"),
    "viscosity index not a number": (lambda: FLAT.with_(lubricant=OIL | {"viscosity_index": float("nan")}), "index"),
    "a grade in a list": (lambda: FLAT.with_(lubricant=OIL | {"grade": ["ISO VG 68"]}), "ISO VG n"),
    "a table that falls": (lambda: table([[373.0, 8e-6], [313.0, 68e-6]]), "rising"),
    "a table that thickens": (lambda: table([[313.0, 8e-6], [373.0, 68e-6]]), "swapped"),
    "a table of one row": (lambda: table([[313.0, 8e-6]]), "at least two"),
    "a table that is a word": (lambda: table("313"), "pair"),
    "an unknown estimate": (lambda: FLAT.with_(lubricant=OIL | {"alpha_estimate": "barus"}), "so-klaus"),
    "a coefficient that boils": (
        lambda: FLAT.with_(lubricant={"temperature": 300.0, "temperature_coefficient": 1e6}),
        "1/K",
    ),
    "bodies that keep all heat": (lambda: FLAT.with_(bodies={"conductivity": (0.0, 46.0)}), "conductivity"),
    "a film of vacuum": (lambda: OILED.with_(lubricant={"conductivity": 1e-9}), "W/"),
    "two planes": (lambda: FLAT.with_(bodies={"radii": (float("inf"), float("inf"))}), "touch"),
    "a hollow too narrow": (lambda: FLAT.with_(bodies={"radii": (8e-3, -7e-3)}), "hollow"),
    "rubber that grows": (
        lambda: FLAT.with_(bodies={"young_modulus": (2e11, 2e11), "poisson_ratio": (0.7, 0.3)}),
        "0.5",
    ),
    "a pressure of stars": (lambda: FLAT.with_(bodies={"hertz_pressure": 1e13}), "hertz_pressure"),
    "a study of 1e10 points": (
        lambda: lubfric.study(FLAT, vary={"bodies.load": MANY, "bodies.radius": 1e-3 * MANY}),
        "1e\\+10 combinations",
    ),
    "a sample without end": (lambda: lubfric.sample([lubfric.Between(1, 2)], 2**40), "1000000"),
    "ratios in two rows": (lambda: lubfric.traction(OILED, [[0.1], [0.2]]), "exactly 1"),
    "ratios without end": (lambda: lubfric.traction(OILED, [1e300]), "ratio"),
    "a viscosity that vanishes": (lambda: in_time(OILED, viscosity=0.0), "viscosity"),
    "faster than any machine": (lambda: in_time(OILED, speed=1e7), "1e\\+06"),
}
VI = {"viscosity_index": 95}


def table(rows):
    return FLAT.with_(lubricant={"viscosity_table": rows, "temperature": 343.0})


def in_time(scene, **plan):
    return lubfric.transient(scene.with_(transient=lubfric.Transient(1e-4, outputs=1, **plan)))


@pytest.mark.parametrize("trial", REFUSED)
def test_it_is_refused_in_words(trial):
    act, word = REFUSED[trial]
    with pytest.raises(lubfric.InputError, match=word):
        act()


@pytest.mark.parametrize("speed, ratio", [(1e-12, 2.0), (0.05, 0.0), (0.05, -4.0), (0.05, 1e4), (0.0, 1.0)])
def test_heat_at_the_ends_of_motion_is_finite_or_told(speed, ratio):
    try:
        found = lubfric.friction(HOT.with_(motion={"slide_roll_ratio": ratio}), speed)
    except lubfric.ConvergenceError as error:
        assert f"slide_roll_ratio = {ratio:.3g}" in str(error) and ratio > 1e3
        return
    assert np.isfinite(found.coefficient)
    assert (abs(ratio) <= 2) == (not any("slide-roll ratio" in entry.what for entry in found.validity))
