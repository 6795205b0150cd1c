"""What is known of a run in time before it is solved: the limits that it exceeds, each at its moment, and advice that
it can follow."""

import pytest
from scene_text import paper_scene

import lubfric
from lubfric.models.shared import Assumption
from lubfric.output import describe_scene
from lubfric.scene import Table, Transient
from lubfric.time import expected_violations_of_run, way_to_motion_in_time

NOSE = Table(times=(0.0, 1e-3, 2e-3), values=(0.3, 0.1, 0.2))
SLIDING = Table(times=(0.0, 1e-3, 2e-3), values=(0.1, 0.4, 0.1))
LOAD = Table(times=(0.0, 2e-3), values=(2.0, 5.5))
RUN = paper_scene(
    contact={"shape": (48, 48), "spacing": 1.8e-6},
    numerics={"sampling": "patch", "tolerance": 0.05},
    lubricant={"inlet_length": 2.5e-5},
).with_(transient=Transient(duration=2e-3, outputs=8, load=LOAD, speed=NOSE, sliding=SLIDING))

MOVING = RUN.with_(transient=Transient(duration=1e-5, outputs=1, speed=0.1), motion={"slide_roll_ratio": 0.5})


def test_a_limit_that_follows_from_the_inputs_is_known_before_the_run_at_its_worst_moment():
    """The surfaces move in opposite directions at the end, and the inlet is starved at the begin."""
    run = lubfric.transient(RUN)
    expected = expected_violations_of_run(RUN)
    for assumption in (Assumption.ONE_DIRECTION, Assumption.FLOODED_INLET):
        solved = {
            time: violation.value
            for time, violations in zip(run.time, run.violations)
            for violation in violations
            if violation.assumption == assumption
        }
        before = {time: each.value for time, each in expected if each.assumption == assumption}
        assert solved
        for time, value in solved.items():
            moment = min(before, key=lambda known: abs(known - time))
            assert before[moment] == pytest.approx(value, rel=1e-3)


def test_info_advises_no_model_that_the_scene_is_refused_with():
    """The deterministic model in time takes no inlet length."""
    starved, flooded = (
        " ".join(describe_scene(scene).split()) for scene in (MOVING, MOVING.with_(lubricant={"inlet_length": None}))
    )
    with pytest.raises(lubfric.InputError, match="inlet_length"):
        lubfric.prepare(MOVING.with_(numerics={"model": "deterministic"}))
    assert "None" not in starved
    advice = "set numerics.model = 'deterministic' to model this motion"
    assert advice not in starved and "no model includes this motion with lubricant.inlet_length" in starved
    assert advice in flooded


@pytest.mark.parametrize(
    ("duration", "most_work", "stated"),
    [
        (1e-2, 1.0, "within numerics.max_work = 1 s"),
        (1.0, None, "within an hour"),
        (10.0, None, "refuses transient.duration"),
    ],
)
def test_a_deterministic_run_is_not_advised_where_it_takes_too_long_or_is_refused(duration, most_work, stated):
    scene = MOVING.with_(
        lubricant={"inlet_length": None},
        contact={"shape": (48, 384)},
        numerics={"max_work": most_work},
        transient=Transient(duration=duration, outputs=1, speed=0.1),
    )
    way = way_to_motion_in_time(scene)
    assert stated in way and "set numerics.model" not in way


@pytest.mark.parametrize("model, is_said", [("quick", True), ("paper", False), ("auto", False)])
def test_info_says_that_the_quick_model_has_no_run_in_time(model, is_said):
    assert ("has no run in time" in describe_scene(RUN.with_(numerics={"model": model}))) == is_said
