"""A strip of moving roughness whose first steps in time forecast too much work leaves its point to the quick model, by
itself."""

import re
from types import SimpleNamespace

import pytest

import lubfric
from lubfric._base import limited_work
from lubfric.estimate import estimated_work_of_point
from lubfric.models import DeterministicModel, MeasuredTime
from lubfric.models.deterministic import FORECAST_STEPS, STEPS_BEFORE, forecast_work

SCENE = lubfric.load_scene("paper").with_(
    motion={"slide_roll_ratio": 0.3},
    contact={"shape": (24, 12), "spacing": 3.75e-6},
    lubricant={"limiting_stress_coefficient": "f_b"},
    numerics={"model_tolerance": 0.01, "sampling_tolerance": 0.2, "tolerance": 0.2},
)
SPEED = 0.03


@pytest.fixture
def with_limit(monkeypatch):
    """A function of the most work [s] of a strip under "auto"."""

    def limit(most):
        monkeypatch.setattr(DeterministicModel, "most_strip_work_in_auto", most)

    return limit


def counted(model="auto"):
    """The result of the scene by ``model``, and the work [s] that was counted."""
    with limited_work(1e3) as meter:
        result = lubfric.friction(SCENE.with_(numerics={"model": model}), SPEED)
    return result, meter.spent


def test_steps_that_all_take_the_same_forecast_their_sum():
    """Oracle: the sum of all steps, of which the first three take ten times as long."""
    works = [1e-1] * STEPS_BEFORE + [1e-2] * 50
    complete = 0.5 + sum(works)
    enough = STEPS_BEFORE + FORECAST_STEPS
    assert forecast_work(works[: enough - 1], steps=len(works), rest=0.5) is None
    assert forecast_work(works[:enough], steps=len(works), rest=0.5) == pytest.approx(complete)
    slow = [1e3 * work for work in works]
    assert forecast_work(slow[:STEPS_BEFORE], steps=len(works), rest=0.5) is None
    assert forecast_work(slow[: STEPS_BEFORE + 1], steps=len(works), rest=0.5) == pytest.approx(0.5 + sum(slow))
    assert forecast_work(works[:enough], steps=5, rest=0.5) == pytest.approx(0.5 + sum(works[:enough]))


def test_auto_ends_a_strip_whose_first_steps_forecast_too_much_work(with_limit):
    with_limit(1.0)
    (quick, of_quick) = counted("quick")
    (ended, spent) = counted()
    assert ended.decision.model == "quick" and ended.coefficient == quick.coefficient
    assert "by its first 13 steps in time one strip would take at least" in ended.decision.text
    assert "set numerics.model = 'deterministic' to solve it" in ended.decision.text
    forecast = float(re.search(r"would take at least (\S+) s", ended.decision.text)[1])
    assert of_quick < spent < of_quick + 0.5 * forecast


@pytest.mark.slow
def test_all_steps_of_a_strip_take_the_forecast_work(with_limit):
    with_limit(1.0)
    (ended, _) = counted()
    forecast = float(re.search(r"would take at least (\S+) s", ended.decision.text)[1])
    (named, all_work) = counted("deterministic")
    assert named.decision.model == "deterministic"
    assert 0.8 * forecast < all_work


def test_what_info_measures_says_that_the_solve_ends(monkeypatch):
    prepared = lubfric.prepare(SCENE)
    at = (prepared.scene, prepared.sample, prepared.surface, SPEED)
    expected = estimated_work_of_point(*at)
    assert expected.model.name == "deterministic"
    measured = SimpleNamespace(speed=SPEED, over_expected=2.0, steps=10, seconds=3.0)
    limits = {2.1: "deterministic", 1.9: "quick"}
    for times, name in limits.items():
        time = MeasuredTime(**vars(measured), most_strip_seconds=times * expected.slow_strip_seconds)
        point = estimated_work_of_point(*at, {"deterministic": [time]})
        assert point.model.name == name
    assert point.seconds > 3.0 and point.slow_strips == 0
    found = DeterministicModel().measure_time(prepared, SPEED)
    named = DeterministicModel().measure_time(lubfric.prepare(SCENE.with_(numerics={"model": "deterministic"})), SPEED)
    assert named.most_strip_seconds == float("inf") and 0 < found.most_strip_seconds < float("inf")
