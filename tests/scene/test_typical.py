"""Typical values: each has a range around its value that goes into the interval, and a source, also on the page."""

import re
from pathlib import Path

import pytest
from scene_text import paper_scene

import lubfric
from lubfric.oil import BASES
from lubfric.quantities import KEYS
from lubfric.scene import source_of, typical
from lubfric.units import converted

PAGE = Path(__file__).parents[2] / "docs" / "inputs.md"
TABLE = PAGE.read_text(encoding="utf-8").partition("## Typical values")[2].partition("SKF:")[0]
NAMED = {key: typical(key) for key in KEYS if typical(key)}
SHOWN = {"hardness": "HV", "eyring_stress": "MPa"}
QUICK = paper_scene(numerics={"sampling_tolerance": 0.1, "model": "paper"}, lubricant={"eyring_stress": 5e6})


def rows_of(key):
    """What the page says of a key: (first, second, third column) of the row that names it, and of those below it."""
    rows = [[cell.strip() for cell in row.strip("|").split("|")] for row in TABLE.splitlines() if row.startswith("| `")]
    first = next(i for i, row in enumerate(rows) if row[0].startswith(f"`{key}`"))
    later = (i for i, row in enumerate(rows) if i > first and re.match(r"`[a-z]", row[0]))
    return rows[first : next(later, None)]


@pytest.mark.parametrize("name, word", [(name, word) for name, known in NAMED.items() for word in known])
def test_each_has_its_range_and_its_source(name, word):
    section, key = name.split(".")
    scene = QUICK.with_keys({name: word})
    value, *ends = NAMED[name][word]
    assert ends[0] < value < ends[1] and (name, *ends) in scene.ranges
    assert re.search(r"\d", source_of(name, word).partition(": ")[2]), "the numbers that were seen"
    numbers = [converted(v, KEYS[name].unit, SHOWN.get(key, KEYS[name].unit)) for v in (value, *ends)]
    shown = "{:.3g} ({:.3g} to {:.3g})".format(*numbers)
    row = next(row for row in rows_of(key) if f'"{word}"' in row[0])
    assert row[1] == shown and re.search(r"\d", row[2])


def test_the_page_names_no_other():
    stated = {word for name in NAMED for row in rows_of(name.split(".")[1]) for word in re.findall('"([^"]+)"', row[0])}
    assert stated == {word for known in NAMED.values() for word in known}
    assert {"100Cr6", "16MnCr5", "42CrMo4"} <= set(NAMED["bodies.hardness"])


@pytest.mark.parametrize("base", BASES)
def test_the_page_has_the_conductivity_of_each_base(base):
    row = next(row for row in rows_of("conductivity") if f'"{base}"' in row[0])
    assert row[1] == f"{BASES[base]['conductivity']:g}, 25 %" and re.search(r"\d", row[2])


@pytest.mark.parametrize("name", NAMED)
def test_its_range_is_in_the_interval(name):
    """The same value without its range has an interval that is narrower on both sides or on one, and never wider."""
    word, (value, *_) = list(NAMED[name].items())[-1]  # of steels the softest
    loaded = QUICK.with_(bodies={"load": 400.0}, motion={"slide_roll_ratio": 0.5}, lubricant={"eyring_stress": 1e7})
    known = lubfric.friction(loaded.with_keys({name: word}), 0.03)
    plain = lubfric.friction(loaded.with_keys({name: value}), 0.03)
    (low, high) = plain.uncertainty.interval
    (least, most) = known.uncertainty.interval
    assert known.coefficient == plain.coefficient and plain.uncertainty.inputs == 0 < known.uncertainty.inputs
    assert least <= low and high <= most and most - least > high - low


def test_half_of_what_heat_does_is_more_than_the_range_of_the_conductivity():
    """A Nahme number that is a third larger or a fifth smaller moves f by less than the half of the heat that `model`
    has. At 3 m/s the heat takes a fifth of f."""
    oil = {"nu40": 68e-6, "nu100": 8.6e-6, "temperature_celsius": 70, "eyring_stress": 5e6}
    scene = QUICK.with_(
        lubricant=oil, motion={"slide_roll_ratio": 0.5}, bodies={"load": 400.0}, numerics={"sampling": "patch"}
    )
    k = scene.lubricant.conductivity
    hot, cold = (lubfric.friction(scene.with_(numerics={"heat": on}), 3.0).coefficient for on in ("auto", "off"))
    ends = [lubfric.friction(scene.with_(lubricant={"conductivity": k * by}), 3.0).coefficient for by in (0.75, 1.25)]
    assert 0.05 < 1 - hot / cold and 0 < max(abs(end - hot) for end in ends) < 0.5 * (cold - hot)


@pytest.mark.parametrize("key, word", [("eyring_stress", "ester"), ("limiting_stress_coefficient", "ester")])
def test_a_name_that_is_not_known_is_refused_with_what_to_give(key, word):
    with pytest.raises(lubfric.InputError, match=r"nor a known name.*\[low, high\].*mineral") as refused:
        QUICK.with_(lubricant={key: word})
    assert "number in -" not in str(refused.value)
