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


OIL = PAPER.with_(lubricant={"nu40": 46e-6, "viscosity_index": 95, "temperature": 333.15})
VISCOSITY = "lubricant.viscosity"
ALPHA = "lubricant.pressure_viscosity_coefficient"


@pytest.mark.parametrize(
    "study",
    [
        {"vary": {VISCOSITY: [0.01, 0.05]}},
        {"vary": {(VISCOSITY, "lubricant.temperature"): [(0.01, 353.15), (0.05, 313.15)]}},
        {"vary": {"lubricant": [{"viscosity": 0.01}, {"viscosity": 0.05}]}},
        {"points": {"speed": [0.1, 0.2], "viscosity [mPa s]": [10.0, 50.0]}},
    ],
)
def test_a_viscosity_in_place_of_an_oil_needs_its_pressure_viscosity_coefficient(study):
    """The coefficient of an oil is estimated from its viscosity: it would stay that of the oil that is replaced."""
    with pytest.raises(lubfric.InputError, match=f"{VISCOSITY} is varied, .* from an oil") as error:
        lubfric.plan_study(OIL, **study)
    for key in ("lubricant.nu40", "lubricant.grade", "lubricant.temperature", ALPHA):
        assert key in str(error.value)


def test_a_viscosity_is_varied_where_the_pressure_viscosity_coefficient_is_a_number():
    known = OIL.with_(lubricant={"pressure_viscosity_coefficient": 2e-8})
    of_known = lubfric.plan_study(known, {VISCOSITY: [0.01, 0.05]}, [0.1])
    of_both = lubfric.plan_study(OIL, {VISCOSITY: [0.01], ALPHA: [2e-8]}, [0.1])
    of_pairs = lubfric.plan_study(OIL, {(VISCOSITY, ALPHA): [(0.01, 2e-8), (0.05, 2e-8)]}, [0.1])
    for plan in (of_known, of_both, of_pairs):
        assert {scene.lubricant.pressure_viscosity_coefficient for scene in plan.scenes} == {2e-8}
        assert [scene.lubricant.viscosity for scene in plan.scenes] == [0.01, 0.05][: len(plan.scenes)]
    by_nu40 = lubfric.plan_study(OIL, {"lubricant.nu40": [30e-6, 60e-6]}, [0.1])
    (thin, thick) = (scene.lubricant for scene in by_nu40.scenes)
    assert thin.pressure_viscosity_coefficient < thick.pressure_viscosity_coefficient
