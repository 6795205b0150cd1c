"""The ends of input ranges that estimates expect a point to solve: against the counted work of points with and without
a range."""

import pytest

import lubfric
from lubfric._base import limited_work
from lubfric.estimate import estimated_work_of_point

SPEED = 0.03
REST = lubfric.load_scene("paper").with_(
    bodies={"hardness": 20e9},
    lubricant={"eyring_stress": 5e6, "limiting_stress_coefficient": 0.06},
    contact={"shape": (24, 12), "spacing": 3.75e-6},
    numerics={"model": "quick", "accept": True, "sampling": "patch"},
)
MOVING = REST.with_(motion={"slide_roll_ratio": 0.1})
# Ranges that no point solves: of a hardness that no asperity reaches, and in motion of a limit that changes the flow
# little.
UNREACHED = {"bodies": {"hardness": [20e9, 19e9, 21e9]}}
OF_LIMIT = {"lubricant": {"limiting_stress_coefficient": [0.06, 0.055, 0.065]}}
OF_FLOW = {"lubricant": {"eyring_stress": [5e6, 2e6, 1e7]}}


def work(scene, speed=SPEED):
    with limited_work(1e3) as meter:
        lubfric.friction(scene, speed)
    return meter.spent


def estimated(scene, speed=SPEED):
    prepared = lubfric.prepare(scene)
    return estimated_work_of_point(prepared.scene, prepared.sample, prepared.surface, speed).seconds


def takes_no_more_work(scene, ranges):
    assert work(scene.with_(**ranges)) == pytest.approx(work(scene), rel=0.05)
    assert estimated(scene.with_(**ranges)) == estimated(scene)


def test_a_hardness_that_no_asperity_reaches_is_expected_to_take_no_work():
    takes_no_more_work(REST, UNREACHED)


def test_a_limit_that_changes_the_flow_little_is_expected_to_take_no_work_in_motion():
    takes_no_more_work(MOVING, UNREACHED | OF_LIMIT)


def test_each_stress_with_a_range_takes_two_further_solves_at_rest():
    alone, one, two = REST, REST.with_(**OF_LIMIT), REST.with_(**OF_LIMIT).with_(**OF_FLOW)
    for of in (work, estimated):
        assert of(one) > of(alone)
        assert 1.0 < (of(two) - of(alone)) / (of(one) - of(alone)) < 4.0
    assert estimated(two) - estimated(alone) == pytest.approx(2 * (estimated(one) - estimated(alone)))


def test_ends_of_a_flow_law_are_solved_where_sliding_thins_films_that_carry_load():
    """None in pure rolling, or where asperities carry all of it; the more, the faster the bodies slide."""

    def added(ratio, speed):
        scene = MOVING.with_(motion={"slide_roll_ratio": ratio})
        return estimated(scene.with_(**OF_FLOW), speed) / estimated(scene, speed) - 1

    assert added(0.0, SPEED) == 0.0
    assert added(1.0, 1e-5) < 0.01
    assert 0.1 < added(1.0, SPEED) < added(1.0, 0.1)
    assert added(0.02, SPEED) < 0.05


def test_ends_of_a_flow_law_take_the_counted_work_that_is_expected():
    """On a film of 1.7 Sq under .8 GPa: about half of that without a range."""
    thick = MOVING.with_(
        bodies={"radius": 1e-3, "hertz_pressure": 0.8e9},
        lubricant={"viscosity": 0.05, "pressure_viscosity_coefficient": 2e-8, "limiting_stress_coefficient": None},
        motion={"slide_roll_ratio": 1.0},
        surface={"sq": 5e-8},
        contact={"shape": (16, 12), "spacing": 3.75e-6},
    )
    (expected, counted) = (of(thick.with_(**OF_FLOW), 0.3) / of(thick, 0.3) - 1 for of in (estimated, work))
    assert 0.2 < counted and counted / 2 <= expected <= 2 * counted
