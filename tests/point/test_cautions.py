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


def test_the_paper_scene_needs_none(balance):
    assert cautions(PAPER, balance, ShearForce(0.01, 0.01)) == ()


@pytest.mark.parametrize(
    "words, scene, change, shear",
    [
        ("extrapolation", PAPER, "heavy film", ShearForce(0.0, 0.0)),
        ("eyring_stress", PAPER, None, ShearForce(5.0, 0.0)),
        ("does not tend to f_b", PAPER.with_(bodies={"load": 550.0}), None, ShearForce(0.0, 0.0)),
        ("not thin", PAPER.with_(bodies={"radius": 1e-6}), None, ShearForce(0.0, 0.0)),
    ],
)
def test_each_limit_is_told(balance, words, scene, change, shear):
    if change:
        film = replace(balance.film, pressure=balance.film.pressure * (2e9 / balance.film.pressure.max()))
        balance = replace(balance, film=film)
    found = [caution for caution in cautions(scene, balance, shear) if words in caution.text]
    assert len(found) == 1 and found[0].value > found[0].limit and found[0].unit


def test_a_non_newtonian_oil_is_not_cautioned(balance):
    scene = PAPER.with_(lubricant={"eyring_stress": 5e6})
    assert cautions(scene, balance, ShearForce(5.0, 0.0)) == ()
