"""Cautions on converged results: raised where the model leaves its range, silent on the paper's scene."""

from dataclasses import replace

import pytest

import lubfric
from lubfric.film.shear import ShearForce
from lubfric.point.cautions import cautions

PAPER = lubfric.load_scene("paper").with_(contact={"shape": (96, 96), "spacing": 0.9e-6})


@pytest.fixture(scope="module")
def balance():
    return lubfric.friction(PAPER, 0.003, fields=True).balance


def sheared(balance):
    """The same with a film that resists by 5 N."""
    return replace(balance, forces=replace(balance.forces, shear=ShearForce(5.0, 0.0)))


def test_the_paper_scene_needs_none(balance):
    assert cautions(PAPER, balance) == ()


@pytest.mark.parametrize(
    "words, scene, change",
    [
        ("extrapolation", PAPER, "heavy film"),
        ("eyring_stress", PAPER, "high shear"),
        ("does not tend to f_b", PAPER.with_(bodies={"load": 550.0}), None),
        ("not thin", PAPER.with_(bodies={"radius": 1e-6}), None),
    ],
)
def test_each_limit_is_told(balance, words, scene, change):
    if change == "heavy film":
        film = replace(balance.film, pressure=balance.film.pressure * (2e9 / balance.film.pressure.max()))
        balance = replace(balance, film=film)
    if change == "high shear":
        balance = sheared(balance)
    found = [caution for caution in cautions(scene, balance) if words in caution.text]
    assert len(found) == 1 and found[0].value > found[0].limit and found[0].unit


def test_a_non_newtonian_oil_is_not_cautioned(balance):
    scene = PAPER.with_(lubricant={"eyring_stress": 5e6})
    assert cautions(scene, sheared(balance)) == ()


def test_a_result_tells_them_by_value_and_in_its_notes():
    heavy = lubfric.friction(PAPER.with_(bodies={"load": 200.0, "hardness": None}), 0.01, tolerance=0.05)
    assert heavy.cautions and all(caution.text in heavy.report.notes for caution in heavy.cautions)
