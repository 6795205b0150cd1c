"""A key that a study does not have is refused with the key that was meant, and the form that keys have."""

import pytest

import lubfric

PAPER = lubfric.load_scene("paper")


@pytest.mark.parametrize(
    "vary, meant",
    [
        ({("bodies", "load"): [(3, 6)]}, "'bodies.load'"),
        ({"load": [3, 6]}, "did you mean 'bodies.load'?"),
        ({"bodie.load": [3]}, "did you mean 'bodies.load'?"),
        ({"lubricant.load": [3]}, "did you mean 'bodies.load'?"),
        ({"bodies.laod": [3]}, "did you mean 'load'?"),
        ({"viscosity": [0.1]}, "did you mean 'lubricant.viscosity'?"),
        ({3: [1]}, "write a key as 'section.key'"),
    ],
)
def test_an_unknown_key_names_the_one_that_was_meant(vary, meant):
    with pytest.raises(lubfric.InputError) as error:
        lubfric.plan_study(PAPER, vary)
    assert meant in str(error.value)


def test_a_sobol_count_names_the_other_sampler():
    with pytest.raises(lubfric.InputError, match="write 128 or 256, or sampler = 'random' for 200 points"):
        lubfric.sample([lubfric.Between(1.0, 2.0)], 200)
