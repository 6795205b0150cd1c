"""Thirty typical slips of a user: each is answered by words that recommend what to do, none gives a number without a
word.

A slip is a scene file with one mistake. It is answered by an error, by a refusal (`ValidityError`), or by a warning on
the result that names the mistaken value. Other units of other keys: tests/scene/test_plausible.py.
"""

import re

import numpy as np
import pytest

import lubfric

GOOD = {
    "bodies": {"radius": "8e-3", "width": "10e-3", "load": "200.0", "material": '"steel"'}
    | {"boundary_friction_coefficient": "0.12"},
    "lubricant": {"grade": '"ISO VG 68"', "viscosity_index": "95", "temperature_celsius": "70", "density": "870"}
    | {"eyring_stress": "5e6", "limiting_stress_coefficient": "0.06"},
    "motion": {"entrainment_speed": "0.05", "slip_percent": "5"},
    "surface": {"sq": "0.1e-6", "correlation_length": "12e-6", "acf": '"gaussian"'},
    "contact": {"shape": "[96, 48]", "spacing": "3.2e-6"},
    "numerics": {"model": '"paper"'},
}
NUMBERS = {"viscosity": "0.0166", "pressure_viscosity_coefficient": "20e-9"}  # instead of the oil
OIL = ("grade", "viscosity_index", "temperature_celsius", "density")
MEASURED = ("sq", "correlation_length", "acf")

SLIPS = {  # name: (changes to GOOD by section; None removes a key, words of the answer)
    "radius in mm": ({"bodies": {"radius": "8.0"}}, "8 mm .0.008 m."),
    "modulus in GPa": ({"bodies": {"material": None, "e_prime": "226"}}, "226 GPa"),
    "modulus twice": ({"bodies": {"e_prime": "2.2e11"}}, "one of e_prime, material"),
    "only Young's modulus": ({"bodies": {"material": None, "young_modulus": "[2e11, 2e11]"}}, "poisson_ratio"),
    "unknown material": ({"bodies": {"material": '"stal"'}}, "'steel'"),
    "hardness in HV": ({"bodies": {"hardness": "700"}}, "hardness_hv"),
    "no load": ({"bodies": {"load": None}}, "hertz_pressure"),
    "viscosity in mm²/s": (
        {"lubricant": dict.fromkeys(OIL) | NUMBERS | {"viscosity": "68"}},
        "For mm²/s give grade, or nu40 and nu100",
    ),
    "alpha in 1/GPa": (
        {"lubricant": dict.fromkeys(OIL) | NUMBERS | {"pressure_viscosity_coefficient": "20"}},
        "20 1/GPa .2e-08 1/Pa.",
    ),
    "no alpha": (
        {"lubricant": dict.fromkeys(OIL) | NUMBERS | {"pressure_viscosity_coefficient": None}},
        "viscosity_law = 'constant'",
    ),
    "SAE grade": ({"lubricant": {"grade": '"SAE 30"'}}, "nu40 and nu100"),
    "grade without index": ({"lubricant": {"viscosity_index": None}}, "viscosity_index"),
    "no temperature": ({"lubricant": {"temperature_celsius": None}}, "temperature"),
    "temperature in °C as K": ({"lubricant": {"temperature_celsius": None, "temperature": "70"}}, "343.15 K"),
    "temperature in K as °C": ({"lubricant": {"temperature_celsius": "343.15"}}, "did you mean temperature = 343.15 K"),
    "no shear law": (
        {
            "bodies": {"load": None, "hertz_pressure": "0.8e9"},
            "lubricant": {"eyring_stress": None, "limiting_stress_coefficient": None},
            "motion": {"entrainment_speed": "1.0", "slip_percent": "20"},
        },
        "eyring_stress",
    ),
    "slip in percent as a ratio": ({"motion": {"slip_percent": None, "slide_roll_ratio": "5"}}, "slip_percent"),
    "speed in mm/s": ({"motion": {"entrainment_speed": "150.0"}}, "150 mm/s .0.15 m/s."),
    "misspelt key": ({"motion": {"entrainment_speed": None, "entrainement_speed": "1.0"}}, "entrainment_speed"),
    "misspelt section": ({"lubrikant": {"viscosity": "0.1"}}, "lubricant"),
    "Sq in micrometres": ({"surface": {"sq": "0.1"}}, "0.1 µm .1e-07 m."),
    "no such file": ({"surface": dict.fromkeys(MEASURED) | {"file": '"map.x3p"'}}, "did you mean.*'map.npy'"),
    "speeds in mm/s": (
        {"motion": {"speeds": "[1, 1000]"}},
        "motion.speeds is 1000 m/s, above 100 m/s. Did you mean 1000 mm/s .1 m/s.. Recommendation: check the value",
    ),
    "size of the patch for its cells": ({"contact": {"shape": "[300e-6, 150e-6]"}}, "cells of contact.spacing"),
    "no boundary friction": ({"bodies": {"boundary_friction_coefficient": None}}, "some 0.1"),
    "a picture for a map": ({"surface": dict.fromkeys(MEASURED) | {"file": '"map.png"'}}, "allowed"),
    "a map without its grid": ({"surface": dict.fromkeys(MEASURED) | {"file": '"map.npy"'}}, "spacing"),
    "a map shorter than the strip": (
        {
            "surface": dict.fromkeys(MEASURED) | {"file": '"map.npy"', "spacing": "1e-6"},
            "contact": dict.fromkeys(GOOD["contact"]),
        },
        "mirror",
    ),
    "unit behind a number": ({"bodies": {"load": "200 N"}}, "numbers with a unit in quotes"),
    "decimal comma": ({"bodies": {"width": "0,01"}}, "decimal point"),
}


def written(folder, changes):
    tables = {section: dict(keys) for section, keys in GOOD.items()}
    for section, keys in changes.items():
        tables[section] = {k: v for k, v in (tables.get(section, {}) | keys).items() if v is not None}
    lines = [f"[{s}]\n" + "\n".join(f"{k} = {v}" for k, v in keys.items()) for s, keys in tables.items() if keys]
    (folder / "scene.toml").write_text("\n".join(lines))
    np.save(folder / "map.npy", np.random.default_rng(0).normal(0, 1e-7, (24, 24)))
    (folder / "map.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(64))
    return folder / "scene.toml"


def answer(path) -> str:
    """What the user is told: an error, or what does not hold of the result."""
    try:
        result = lubfric.friction(lubfric.load_scene(path))
    except lubfric.LubfricError as error:
        return str(error)
    return " | ".join(entry.text for entry in result.validity)


def test_without_a_slip_there_is_an_answer_and_no_word_about_a_value(tmp_path):
    result = lubfric.friction(lubfric.load_scene(written(tmp_path, {})))
    assert 0 < result.coefficient <= 0.12
    assert not any("unusual" in entry.text or entry.severe for entry in result.validity)


@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_is_answered_with_the_recommendation(slip, tmp_path):
    changes, words = SLIPS[slip]
    stated = answer(written(tmp_path, changes))
    assert re.search(words, stated), stated or "a number without a word"
