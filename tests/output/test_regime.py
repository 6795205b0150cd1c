"""The report names the lubrication regime, which of its films is the film, and forces that add up to f."""

import math
import re
from html import unescape

import pytest
from scene_text import paper_scene

import lubfric
from lubfric.oil import estimate_in_words, named_oil
from lubfric.output import details_of_points, inputs, lines_of_point, regime_in_words, regimes_in_words

SMALL = paper_scene(contact={"shape": (48, 48), "spacing": 1.8e-6}, numerics={"sampling": "patch", "tolerance": 0.05})


@pytest.fixture(scope="module")
def curve():
    return lubfric.stribeck(SMALL, [0.003, 0.1])


@pytest.mark.parametrize(
    "asperity_load_ratio, lambda_ratio, begin, is_of_wear",
    [
        (0.99, 0.08, "This is boundary lubrication: the asperity load ratio is 0.99, the lambda ratio", True),
        (0.27, 2.0, "This is mixed lubrication: the asperity load ratio is 0.27, the lambda ratio 2.", True),
        (
            0.27,
            0.25,
            "This is mixed lubrication: the asperity load ratio is 0.27; its lambda ratio of 0.25 alone",
            True,
        ),
        (0.0, 4.0, "This is full-film lubrication: the asperity load ratio is 0, the lambda ratio 4.", False),
        (1.0, math.nan, "This is boundary lubrication: the asperity load ratio is 1.", True),
    ],
)
def test_the_regime_is_that_of_the_load_and_states_where_lambda_differs(
    asperity_load_ratio, lambda_ratio, begin, is_of_wear
):
    (text,) = regime_in_words(asperity_load_ratio, lambda_ratio)
    assert text.startswith(begin) and ("Wear" in text) == is_of_wear


def test_no_regime_is_named_where_the_loads_are_not_known():
    assert regime_in_words(math.nan, 1.0) == regimes_in_words([math.nan]) == []


def test_each_point_of_a_study_is_in_one_regime():
    (text,) = regimes_in_words([0.95, math.nan, 0.3, 0.0, 0.99])
    assert (
        "boundary lubrication at points 1 and 5; mixed lubrication at point 3; full-film lubrication at point 4" in text
    )
    assert regimes_in_words([0.0, 0.0]) == [
        "By its asperity load ratio of 0 there is full-film lubrication at points 1 and 2."
    ]


def test_the_console_names_film_lambda_ratio_and_regime_of_a_point(curve):
    point = curve.points[0]
    text = "\n".join(lines_of_point(point))
    share = point.contact_load / SMALL.bodies.load
    regime = "boundary lubrication" if share >= 0.9 else "mixed lubrication"
    assert (
        f"{regime}; full-load film {1e9 * point.full_load_film:.3g} nm, lambda ratio {point.lambda_ratio:.3g}" in text
    )


def test_the_forces_of_the_details_add_up_to_f_times_the_load(curve):
    page = unescape(details_of_points(curve))
    heads = re.findall(r"<th[^>]*>(.*?)</th>", page)
    forces = [heads.index(name) for name in heads if name.endswith("[N]") and "load" not in name]
    assert len(forces) == 3
    for point, row in zip(curve.points, re.findall(r"<tr>(.*?)</tr>", page.partition("<tbody>")[2])):
        cells = re.findall(r"<td[^>]*>(.*?)</td>", row)
        total = sum(float(cells[index]) for index in forces)
        assert total == pytest.approx(point.coefficient * SMALL.bodies.load, rel=0.01)


def test_the_boundary_film_of_no_scene_key_is_an_input_by_default():
    """It is often the largest part of the error of f, so its value of 20 nm is listed; a given one is as given."""
    (row,) = (row for row in inputs(SMALL, "bodies") if row[2] == "bodies.boundary_film")
    assert row[1] == "20 nm" and "the default of lubfric" in row[3]
    given = SMALL.with_(bodies={"boundary_film": 5e-9})
    assert [row[1] for row in inputs(given, "bodies") if row[2] == "bodies.boundary_film"] == ["5 nm"]


def test_the_note_of_a_named_oil_stands_apart_from_its_viscosity():
    first, *others = estimate_in_words(named_oil("fva-3"), 353.15).split("; ")
    assert " at 80 °C: " in first and "used only" not in first and any("used only" in text for text in others)
