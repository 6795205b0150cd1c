"""Numbers and arrays of NumPy in a scene are those of Python."""

import tomllib
from pathlib import Path

import numpy as np
import pytest
from scene_text import paper_scene

from lubfric.scene import scene_from_table
from lubfric.studies import fingerprint

SCENE = paper_scene(numerics={"sampling": "patch"})


@pytest.mark.parametrize(
    "section, given, plain",
    [
        ("surface", {"correlation_length": np.array([8e-6, 6e-6])}, {"correlation_length": (8e-6, 6e-6)}),
        ("contact", {"spacing": np.array([1e-6, 2e-6])}, {"spacing": (1e-6, 2e-6)}),
        ("contact", {"shape": np.array([96, 128])}, {"shape": (96, 128)}),
        ("bodies", {"conductivity": np.array([46.0, 30.0])}, {"conductivity": (46.0, 30.0)}),
        ("bodies", {"radii": np.array([0.1, 0.2])}, {"radii": (0.1, 0.2)}),
        ("bodies", {"load": np.float64(5.0), "hardness": np.int64(10**9)}, {"load": 5.0, "hardness": 10**9}),
        ("bodies", {"radius": np.float32(2e-3)}, {"radius": float(np.float32(2e-3))}),
        (
            "lubricant",
            {"viscosity": np.float64(0.3), "eyring_stress": np.array(5e6)},
            {"viscosity": 0.3, "eyring_stress": 5e6},
        ),
        ("numerics", {"tolerance": np.float64(0.02), "workers": np.int64(2)}, {"tolerance": 0.02, "workers": 2}),
    ],
)
def test_a_scene_holds_the_numbers_of_python(section, given, plain):
    scene = SCENE.with_(**{section: given})
    same = SCENE.with_(**{section: plain})
    assert scene == same and fingerprint(scene) == fingerprint(same)
    assert scene_from_table(tomllib.loads(scene.to_toml()), Path(), "paper") == same
    if not set(given) & {"radii"}:
        kind = type(getattr(SCENE, section))
        values = vars(getattr(SCENE, section))
        assert kind(**values | given) == kind(**values | plain)
