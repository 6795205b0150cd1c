"""A result cites what it used, and nothing else; the command tells its version."""

import importlib.metadata

import pytest

import lubfric
from lubfric.cli import main


def test_the_papers_are_those_of_what_was_used():
    scene = lubfric.load_scene("paper").with_(numerics={"sampling": "patch"})
    film, mixed = lubfric.friction(scene, 1.0).cite(), lubfric.friction(scene, 0.01, fields=True).cite()
    assert film.startswith("A. Akchurin") and "10.1007/s11249-015-0536-z" in film and "Polonsky" not in film
    assert "Polonsky" in mixed and "Gupta" not in mixed


def test_a_curve_cites_every_paper_once():
    scene = lubfric.load_scene("paper").with_(numerics={"sampling": "patch"})
    curve = lubfric.stribeck(scene, [0.01, 0.03, 1.0])
    lines = curve.cite().splitlines()
    assert len(lines) == len(set(lines)) and set(lines) == {
        line for point in curve.points for line in point.cite().splitlines()
    }


def test_johnson_is_cited_where_his_modulus_deflects_the_film():
    heavy = lubfric.load_scene("paper").with_(
        bodies={"load": 550.0, "hardness": None},
        contact={"spacing": 2.4e-6, "shape": (160, 80)},
        lubricant={"eyring_stress": 5e6, "limiting_stress_coefficient": 0.06},
        numerics={"sampling": "patch", "tolerance": 0.05, "accept": True, "film_deflection": "auto"},
    )
    assert "Johnson" in lubfric.friction(heavy, 0.01).cite()
    assert "Johnson" not in lubfric.friction(heavy.with_(numerics={"film_deflection": "hydrodynamic"}), 0.01).cite()
    assert "Martin" in lubfric.friction(lubfric.load_scene("paper"), 1.0, tolerance=0.1).cite()


def test_the_command_tells_its_version(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["--version"])
    assert ended.value.code == 0 and capsys.readouterr().out.strip() == f"lubfric {lubfric.__version__}"
    assert importlib.metadata.version("lubfric")
