"""The status of a run in time names the errors of f that are above their tolerances."""

from dataclasses import replace

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.models.shared import Assumption, Violation
from lubfric.output.status import StatusOfPoints, missed_by_run
from lubfric.scene import Harmonic, Transient

SPEED = Harmonic(mean=0.1, amplitude=0.02, frequency=1000.0)
RUN = paper_scene(
    contact={"shape": (48, 48), "spacing": 1.8e-6}, numerics={"accept": True, "sampling": "patch", "tolerance": 0.05}
).with_(transient=Transient(duration=1e-3, outputs=4, speed=SPEED))


@pytest.fixture(scope="module")
def run():
    return lubfric.transient(RUN)


@pytest.mark.parametrize(
    "numerics, is_missed", [({}, False), ({"model_tolerance": 0.06}, True), ({"model": "paper"}, True)]
)
def test_an_error_that_is_usual_for_the_quick_model_misses_no_default_tolerance(numerics, is_missed):
    """It is stated once, for all points; a tolerance of the user is named at each, as the error of another model is."""
    scene = RUN.with_(numerics={"model": "quick"} | numerics)
    note = replace(above(Assumption.MODEL_FORM_ERROR, 9.0, is_note=True), effect=0.09)
    columns = {"coefficient": [0.05, 0.06], "model_error": [0.12, 0.09], "limit_error": [0.0794, 0.0]}
    columns |= {"numerical_error": [0.0, 0.0], "interval_low": [0.04, 0.05]}
    status = StatusOfPoints(
        columns={name: np.array(values) for name, values in columns.items()},
        scenes=[scene] * 2,
        violations=[(note,), (replace(note, effect=0.0901),)],
    )
    text = status.in_words("speeds", str)
    assert ("numerics.model_tolerance" in text) == is_missed == (status.kind(failed=False) == "inexact")
    usual = "The model-form error of f is 9 %, as is usual for the quick model"
    assert (usual in text) == (not is_missed)
    mixed = replace(status, violations=[(note,), (replace(note, is_note=False),)])
    if not is_missed:
        text = mixed.in_words("speeds", str)
        assert "At 1 of 2 points the model-form error of f is 9 %, as is usual" in text
        assert "the model-form error of f is 9 %, above 5 % (numerics.model_tolerance)" in text


def above(assumption, value, *, is_note=False):
    return Violation(
        assumption=assumption,
        what="model-form error of f",
        value=value,
        limit=5.0,
        unit="%",
        consequence="the interval of f includes it",
        recommendation="use f with its interval",
        is_note=is_note,
    )


def test_the_worst_output_is_named_and_notes_are_left_out(run):
    count = run.time.size
    errors = [(above(Assumption.MODEL_FORM_ERROR, 6.0 + number),) for number in range(count)]
    (text,) = missed_by_run(RUN, replace(run, violations=tuple(errors)))
    assert "model-form error of f is above 5 %" in text and f"up to {6 + count - 1} %" in text
    notes = [(above(Assumption.MODEL_FORM_ERROR, 6.0, is_note=True),)] * count
    exact = run.columns | {f"model_error_{end}": np.zeros(count) for end in ("low", "high")}
    assert missed_by_run(RUN, replace(run, violations=tuple(notes), columns=exact)) == []


def test_an_error_by_the_model_of_the_run_is_named_with_its_largest_value(run):
    wide = run.columns | {"model_error_low": np.full(run.time.size, 0.3), "model_error_high": np.zeros(run.time.size)}
    (text,) = missed_by_run(RUN, replace(run, violations=(), columns=wide))
    assert "model-form error of f is above 5 %" in text and "up to 30 %" in text


def test_heat_that_f_omits_is_named_as_at_a_steady_point(run):
    exact = run.columns | {f"model_error_{end}": np.zeros(run.time.size) for end in ("low", "high")}
    heat = replace(above(Assumption.HEAT_INCLUDED, 20.0), effect=0.2)
    violations = ((), (heat,), (replace(heat, effect=0.3),), *((),) * (run.time.size - 3))
    (text,) = missed_by_run(RUN, replace(run, violations=violations, columns=exact))
    assert text.startswith("At 2 of 5 outputs f and its interval are without the heat of the film")
    assert text.endswith("by up to 30 % (at t = 500 µs).")


def test_an_error_of_next_to_no_friction_is_stated_in_f(run):
    """0.05 where f is 0.001 is no 5000 %."""
    count = run.time.size
    errors = {"model_error_low": np.full(count, 0.3), "model_error_high": np.r_[np.full(count - 1, 0.3), 50.0]}
    f = {"coefficient": np.r_[np.full(count - 1, 0.1), 1e-3]}
    (text,) = missed_by_run(RUN, replace(run, violations=(), columns=run.columns | errors | f))
    assert "up to 30 %, and up to 0.05 in f itself where f is below 0.005" in text


@pytest.mark.parametrize(
    "low, words", [(0.05, "the interval of f includes it."), (np.nan, "the interval of f, where it")]
)
def test_the_interval_is_called_unknown_only_where_one_is(low, words):
    note = replace(above(Assumption.MODEL_FORM_ERROR, 9.0, is_note=True), effect=0.09)
    columns = {"coefficient": [0.05, 0.06], "model_error": [0.12, 0.09], "limit_error": [0.0794, 0.0]}
    columns |= {"numerical_error": [0.0, 0.0], "interval_low": [0.04, low]}
    status = StatusOfPoints(
        columns={name: np.array(values) for name, values in columns.items()},
        scenes=[RUN.with_(numerics={"model": "quick"})] * 2,
        violations=[(note,), (note,)],
    )
    assert words in status.in_words("speeds", str)
