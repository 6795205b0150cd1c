"""Where the steps of a run end: at the corners of a history, and at one of two times that only rounding parts."""

import math

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.scene import Table
from lubfric.scene.history import corners
from lubfric.time import plan_of

PULSE = Table(times=(0.0, 0.33, 0.331, 0.398, 0.399, 1.0), values=(0.01, 0.01, 0.1, 0.1, 0.01, 0.01))


def test_a_pulse_and_a_jump_have_their_corners():
    assert PULSE.stops(1.0) == (0.33, 0.331, 0.398, 0.399)
    assert corners(np.array([0.0, 1.0, 1.0, 2.0, 3.0]), np.array([1.0, 1.0, 4.0, 4.0, 2.0])) == [2.0]


@pytest.mark.parametrize("period", [0.1, 0.07, 1 / 3, 0.02, 0.7])
def test_a_square_wave_jumps_in_every_period(period):
    wave = Table(times=(0.0, period / 2, period / 2, period), values=(1.0, 1.0, 3.0, 3.0), repeat=True)
    for n in (*range(1, 20), 99, 399):
        after = (1.0, 3.0)[n % 2]
        for time in (n * period / 2, math.nextafter(n * period / 2, 0), math.nextafter(n * period / 2, 1e9)):
            assert (wave.before(time), wave.at(time)) == pytest.approx((4.0 - after, after), rel=1e-9)


@pytest.mark.parametrize("jump", [0.3, 0.6, 0.7])
def test_an_output_and_a_jump_at_one_time_are_one_stop(jump):
    times = np.linspace(0.0, 1.0, 11)  # 0.30000000000000004 is among them
    step = Table(times=(0.0, jump, jump, 1.0), values=(1.0, 1.0, 2.0, 2.0))
    other = Table(times=(0.0, jump * (1 + 3e-16), jump * (1 + 3e-16), 1.0), values=(5.0, 5.0, 2.0, 2.0))
    plan = plan_of(times, [step, other], 1e-3, 1e-3)
    assert plan.stops == tuple(times.tolist()) and plan.jumps <= set(plan.stops) and len(plan.jumps) == 1
    assert step.before(*plan.jumps) == 1.0 and step.at(*plan.jumps) == 2.0


def test_a_run_sees_a_pulse_between_its_outputs_and_a_jump_at_one():
    scene = paper_scene(
        contact={"shape": (64, 64), "spacing": 0.8e-6},
        surface={"correlation_length": 5e-6},
        numerics={"sampling": "patch", "accept": True, "tolerance": 0.03},
    )

    def run(speed, outputs):
        plan = lubfric.Transient(duration=1.0, outputs=outputs, speed=speed, tolerance=1e-5)
        return lubfric.transient(scene.with_(transient=plan))

    few = run(PULSE, 5)
    many = run(PULSE, 25)
    assert few.coefficient[2] == pytest.approx(many.coefficient[10], rel=2e-4)
    assert few.coefficient[2] < 0.994 * few.coefficient[1]  # 1 ms after the pulse the film still remembers it
    jump = run(Table(times=(0.0, 0.3, 0.3, 1.0), values=(0.01, 0.01, 0.02, 0.02)), 10)
    assert jump.coefficient[3] == pytest.approx(jump.coefficient[0], rel=1e-4)
    assert jump.coefficient[4] < 0.9 * jump.coefficient[3]
