"""``with_``: None clears a key, whether it is there or not: the scene is that of a file without the key."""

from dataclasses import MISSING, fields, replace
from pathlib import Path

import numpy as np
import pytest

import lubfric

PAPER = lubfric.load_scene("paper")
SECTIONS = ("bodies", "lubricant", "motion", "surface", "contact", "numerics")
OPTIONAL = [
    (section, f.name)
    for section in SECTIONS
    for f in fields(getattr(PAPER, section))
    if f.default is not MISSING
    and f.name != "boundary_friction_table"  # no key: a form of boundary_friction_coefficient
]
# Of a generated map, though not of one in a file; and of the Roelands law.
NEEDED = {("surface", "sq"), ("surface", "correlation_length"), ("lubricant", "pressure_viscosity_coefficient")}
# Short forms, which are no fields.
SHORT = [
    ("bodies", "hardness_hv"),
    ("bodies", "material"),
    ("lubricant", "temperature_celsius"),
    ("lubricant", "grade"),
    ("lubricant", "viscosity_index"),
    ("lubricant", "density"),
    ("motion", "slip_percent"),
    ("motion", "speed_range"),
    ("surface", "ra"),
]
OIL = """name = "oil"
[bodies]
radius = 8e-3
width = 1e-2
load = 200.0
e_prime = 2.2e11
boundary_friction_coefficient = 0.1
[lubricant]
grade = "ISO VG 46"
viscosity_index = 95
temperature_celsius = 60
{key}
[motion]
entrainment_speed = 0.3
[surface]
sq = 1e-7
correlation_length = 1e-5
"""


@pytest.mark.parametrize(("section", "key"), [pair for pair in OPTIONAL if pair not in NEEDED])
def test_none_is_the_default(section: str, key: str) -> None:
    """The scene "paper" has some keys, and not the others: with both, the field has its default."""
    part = getattr(PAPER, section)
    default = next(f.default for f in fields(part) if f.name == key)
    assert getattr(PAPER.with_(**{section: {key: None}}), section) == replace(part, **{key: default})


@pytest.mark.parametrize(("section", "key"), [*sorted(NEEDED), ("bodies", "load"), ("motion", "entrainment_speed")])
def test_a_key_that_is_needed_is_named(section: str, key: str) -> None:
    with pytest.raises(lubfric.InputError, match=key):
        PAPER.with_(**{section: {key: None}})


@pytest.mark.parametrize(("section", "key"), SHORT)
def test_a_short_form_that_is_none_states_nothing(section: str, key: str) -> None:
    assert PAPER.with_(**{section: {key: None}}) == PAPER


@pytest.mark.parametrize("key", ["pressure_viscosity_coefficient = 2e-8", "density = 900", 'base = "pao"'])
def test_a_property_of_an_oil_is_estimated_again(key: str, tmp_path: Path) -> None:
    scenes = []
    for n, line in enumerate((key, "")):
        file = tmp_path / f"{n}.toml"
        file.write_text(OIL.format(key=line))
        scenes.append(lubfric.load_scene(file))
    cleared = scenes[0].with_(lubricant={key.partition(" ")[0]: None})
    assert cleared.lubricant == scenes[1].lubricant != scenes[0].lubricant
    assert scenes[1].with_(lubricant={"density_law": None}).lubricant == scenes[1].lubricant


def test_a_file_in_place_of_a_generated_map_and_back(tmp_path: Path) -> None:
    file = tmp_path / "map.csv"
    np.savetxt(file, 1e-7 * np.random.default_rng(1).standard_normal((40, 30)), delimiter=",")
    keys = {"file": str(file), "spacing": 1e-6, "unit": "m", "motion_axis": "y"}
    measured = PAPER.with_(surface=keys)
    cleared = PAPER.with_(surface=keys | {"acf": None, "seed": None, "sq": None, "correlation_length": None})
    assert cleared == measured
    assert measured.with_(surface={"motion_axis": None}) == PAPER.with_(surface={**keys, "motion_axis": "x"})
    generated = measured.with_(surface={"file": None, "sq": 2e-7, "correlation_length": 1e-5})
    assert generated.surface.file is None and generated.surface.spacing is None
    assert generated.surface.motion_axis == "x"


def test_an_oil_takes_the_place_of_a_viscosity_that_is_none():
    scene = lubfric.load_scene("paper")
    oil = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 60}
    assert scene.with_(lubricant=oil | {"viscosity": None}) == scene.with_(lubricant=oil)
    with pytest.raises(lubfric.InputError, match="viscosity and an oil .* give one"):
        scene.with_(lubricant=oil | {"viscosity": 0.1})
