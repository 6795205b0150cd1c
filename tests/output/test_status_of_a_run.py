"""The status of a run in time names the errors of f that are above their tolerances."""

from dataclasses import replace

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.models.shared import Assumption, Violation
from lubfric.output.status import missed_by_run
from lubfric.scene import Harmonic, Transient

SPEED = Harmonic(mean=0.1, amplitude=0.02, frequency=1000.0)
RUN = paper_scene(
    contact={"shape": (48, 48), "spacing": 1.8e-6}, numerics={"accept": True, "sampling": "patch", "tolerance": 0.05}
).with_(transient=Transient(duration=1e-3, outputs=4, speed=SPEED))


@pytest.fixture(scope="module")
def run():
    return lubfric.transient(RUN)


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
