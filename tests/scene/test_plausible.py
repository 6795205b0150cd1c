"""Likely slips: every usual range holds the built-in scenes, and a value in a mistaken unit is told with the right
one."""

import pickle

import pytest

import lubfric
from lubfric.quantities import KEYS
from lubfric.scene import unusual_values
from lubfric.scene.plausible import slip
from lubfric.units import converted

OIL = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature": 343.15}


@pytest.mark.parametrize("name", ["paper", "flat"])
def test_built_in_scenes_are_usual(name):
    assert unusual_values(lubfric.load_scene(name)) == ()


@pytest.mark.parametrize("name", [name for name, q in KEYS.items() if q.meant])
def test_a_usual_value_in_each_mistaken_unit_is_found_out(name):
    (low, high) = KEYS[name].usual
    unit = KEYS[name].unit
    middle = (max(low, high / 1e6) * high) ** 0.5
    assert slip(name, middle) is None
    for other in KEYS[name].meant:
        given = converted(middle, unit, other if isinstance(other, str) else other[0])
        if not low <= given <= high:
            meant = slip(name, given)
            assert meant and unit in meant
    assert slip(name, [middle, middle]) is None


def test_a_value_that_no_unit_explains_is_still_told():
    ((name, value, limit, unit, _),) = unusual_values(lubfric.load_scene("paper").with_(bodies={"radius": 900.0}))
    assert (name, value, limit, unit) == ("bodies.radius", 900.0, 1.0, "m")


def test_an_error_carries_what_it_says():
    """Quantity, range and hints are data, and words only in its text; they survive a process."""
    with pytest.raises(lubfric.InputError) as caught:
        lubfric.load_scene("paper").with_(counterface={"sq": 5.0, "correlation_length": 1e-5})
    error = pickle.loads(pickle.dumps(caught.value))
    assert error.quantity == "counterface.sq" and error.allowed == "a finite number in [0, 1] m" and not error.hints
    error.hint("um meant?")
    error.hint("um meant?")
    assert str(error) == f"{error.quantity}{error.said}; allowed: {error.allowed}; um meant?"
