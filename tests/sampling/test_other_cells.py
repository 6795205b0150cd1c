"""What cells half as long would change, against those cells."""

import csv
import dataclasses
from pathlib import Path

import numpy as np
import pytest
from lubfric.sampling.other_cells import half_again, too_coarse

import lubfric
from lubfric.contact import half_space_contact
from lubfric.output import main

PAPER = lubfric.load_scene("paper").with_(numerics={"sampling": "patch", "film_deflection": "scaled"})
CELL, LENGTH = 0.8e-6, 8e-6


def on(surface, every, first=0, **numerics):
    """Every so-manieth cell of a map from the ``first`` on, solved as one patch."""
    kept = dataclasses.replace(
        surface,
        heights=surface.heights[first::every, ::every],
        spacing=tuple(every * d for d in surface.spacing),
    )
    scene = PAPER.with_(contact={"shape": kept.shape, "spacing": kept.spacing}, numerics=numerics)
    return lubfric.friction(lubfric.prepare(scene, kept), 0.01)


@pytest.mark.parametrize("acf", ["gaussian", "exponential"])
def test_the_caution_foretells_what_cells_half_as_long_change(acf):
    """The same surface on both, the mean over the two halves of its columns, which lie either side of them: within a
    factor of five in the middle of five patches."""
    ratios = []
    for seed in range(5):
        fine = lubfric.generate_surface((256, 256), CELL / 2, sq=1e-7, correlation_length=LENGTH, acf=acf, seed=seed)
        own = on(fine, 2, tolerance=1e-4)
        other = on(fine, 2, 1, tolerance=1e-4).coefficient
        truth = abs(2 * on(fine, 1, grid="given", tolerance=1e-4).coefficient / (own.coefficient + other) - 1)
        told = [entry.value / 100 for entry in own.validity if "half as long" in entry.what]
        assert own.decision.coarsening == (1, 1)
        ratios.append((told or [1e-4])[0] / truth)
    assert 0.2 < np.median(ratios) < 5


def test_changes_go_on_as_they_did():
    assert half_again([0.2]) == half_again([0.2, -0.4]) == half_again([0.2, 0.1]) == pytest.approx(0.1)
    assert half_again([0.1, 0.4]) == pytest.approx(0.025)
    assert half_again([0.001, 0.4]) == pytest.approx(0.0125)  # small by chance
    assert too_coarse(0.009, 0.01) == () == too_coarse(float("nan"), 0.01)
    assert "2 %, above 1 %" in too_coarse(0.02, 0.01)[0].text


def test_every_second_cell_is_the_contact_of_those_cells():
    scene = PAPER.with_(contact={"shape": (64, 64), "spacing": CELL})
    heights = lubfric.prepare(scene).surface.heights
    whole = half_space_contact(scene, heights, (CELL, CELL))
    x = whole.x[::2]
    alone = half_space_contact(scene, heights[::2, ::2], (2 * CELL, 2 * CELL), x=x)
    film = 1.2e-7 + x**2 / (2 * scene.bodies.radius)
    thinned = whole.thinned(2)
    np.testing.assert_array_equal(thinned.weight, alone.weight)
    assert thinned.close(film, 2.0).mean_gap == pytest.approx(alone.close(film, 2.0).mean_gap, rel=1e-4)
    assert whole.thinned(128) is None and whole.thinned(3) is None


def test_a_run_says_it_on_the_console_and_in_the_table(tmp_path, capsys):
    scene = tmp_path / "scene.toml"
    text = (Path(lubfric.__file__).parent / "scenes" / "paper.toml").read_text()
    for old, new in (
        ('"gaussian"', '"exponential"'),
        ("[200, 200]", "[96, 96]"),
        ("0.45e-6", "1.0e-6"),
        ("[numerics]", '[numerics]\nsampling = "patch"\ntolerance = 5e-4'),
    ):
        assert old in text
        text = text.replace(old, new)
    scene.write_text(text)
    assert main(["run", str(scene), "--out", str(tmp_path / "out"), "--speeds", "0.01"]) == 0
    said = capsys.readouterr().err
    with (tmp_path / "out" / "stribeck.csv").open() as file:
        row = next(row for row in csv.DictReader(file) if float(row["speed [m/s]"]) == 0.01)
    assert "half as long" in said and "half as long" in row["validity"]
    assert "an interval takes 25" in said and "an interval takes 25" in row["uncertainty"]
