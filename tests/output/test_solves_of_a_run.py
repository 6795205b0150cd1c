"""`lubfric run` solves its points once: the fields that it draws are those of the same solve, at rest and in motion."""

import numpy as np
import pytest

import lubfric
from lubfric.models import MODELS
from lubfric.output import main

SMALL = lubfric.load_scene("paper").with_(contact={"shape": (16, 12), "spacing": 90e-6 / 24})
SPEED = 0.03


@pytest.fixture
def solves(monkeypatch) -> list[str]:
    """The name of its model for every solve of strips, from here on."""
    names: list[str] = []
    for model in MODELS:
        solve = type(model).solve

        def counted(self, *arguments, _solve=solve, **options):
            names.append(self.name)
            return _solve(self, *arguments, **options)

        monkeypatch.setattr(type(model), "solve", counted)
    return names


PATCH = {"model": "deterministic", "sampling": "patch", "grid": "given"}


@pytest.mark.parametrize(
    ("numerics", "ratio"),
    [({"model": "paper"}, 2.0), (PATCH, 2.0), (PATCH, 0.5)],
    ids=["strips", "patch at rest", "moving patch"],
)
def test_a_drawn_point_is_solved_once(numerics, ratio, solves, tmp_path):
    scene = SMALL.with_(numerics=numerics, motion={"slide_roll_ratio": ratio, "entrainment_speed": SPEED})
    lubfric.friction(scene, SPEED)
    once = list(solves)
    solves.clear()
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    command = ["run", str(tmp_path / "scene.toml"), "--out", str(tmp_path / "out"), "--workers", "1"]
    assert main([*command, "--speeds", f"{SPEED}"]) == 0
    assert solves == once and once
    with np.load(tmp_path / "out" / "fields.npz") as fields:
        assert fields["pressure_0"].max() > 0
