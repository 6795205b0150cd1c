"""The status of a run in time names the errors of f that are above their tolerances."""

from dataclasses import replace

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
    (text,) = missed_by_run(replace(run, violations=tuple(errors)))
    assert "model-form error of f is above 5 %" in text and f"up to {6 + count - 1} %" in text
    notes = [(above(Assumption.MODEL_FORM_ERROR, 6.0, is_note=True),)] * count
    assert missed_by_run(replace(run, violations=tuple(notes))) == []
