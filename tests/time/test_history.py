"""Time functions: values, jumps, ranges, files; bad ones are refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import lubfric
from lubfric.scene import Constant, Harmonic, Ramp, Table, Transient
from lubfric.scene.transient import history

STEP = Table(times=(0.0, 1.0, 1.0, 3.0), values=(2.0, 2.0, 5.0, 6.0))


def test_each_kind_has_its_values():
    assert Constant(3.0).at(7.0) == 3.0
    ramp = Ramp(start=1.0, end=3.0, begin=1.0, until=2.0)
    assert [ramp.at(t) for t in (0.0, 1.0, 1.5, 2.0, 9.0)] == [1.0, 1.0, 2.0, 3.0, 3.0]
    wave = Harmonic(mean=1.0, amplitude=2.0, frequency=0.5, phase=np.pi / 2)
    assert wave.at(0.0) == pytest.approx(3.0) and wave.at(1.0) == pytest.approx(-1.0)
    assert STEP.before(1.0) == 2.0 and STEP.at(1.0) == 5.0 and STEP.at(2.0) == 5.5 and STEP.jumps(3.0) == (1.0,)


def test_a_repeated_table_jumps_every_period():
    saw = Table(times=(0.0, 2.0), values=(0.0, 1.0), repeat=True)
    assert saw.at(3.0) == pytest.approx(0.5) and saw.before(4.0) == 1.0 and saw.at(4.0) == 0.0
    assert saw.jumps(7.0) == (2.0, 4.0, 6.0) and saw.range(7.0) == (0.0, 1.0)


KINDS = st.one_of(
    st.builds(
        Harmonic,
        mean=st.floats(-3, 3),
        amplitude=st.floats(-3, 3),
        frequency=st.floats(0.05, 5),
        phase=st.floats(-20, 20),
    ),
    st.builds(Ramp, start=st.floats(-3, 3), end=st.floats(-3, 3), begin=st.just(0.3), until=st.floats(0.4, 9)),
    st.lists(st.floats(-3, 3), min_size=2, max_size=6).map(
        lambda v: Table(times=tuple(np.linspace(0, 4, len(v))), values=tuple(v), repeat=True)
    ),
)


@given(KINDS, st.floats(0.1, 4.0), st.floats(0, 1))
def test_the_range_bounds_the_values(given_history, duration, share):
    low, high = given_history.range(duration)
    assert low - 1e-9 <= given_history.before(share * duration) <= high + 1e-9


@given(st.floats(0.2, 3), st.floats(0, 20), st.floats(0.05, 0.9))
def test_the_range_of_a_part_of_a_wave_is_reached(amplitude, phase, duration):
    wave = Harmonic(amplitude=amplitude, frequency=1.0, phase=phase)
    values = [wave.at(t) for t in np.linspace(0, duration, 2001)]
    assert wave.range(duration) == pytest.approx((min(values), max(values)), abs=1e-4 * amplitude)


@pytest.mark.parametrize(
    "table, words",
    [
        ({"kind": "table", "times": [0, 2, 1], "values": [1, 2, 3]}, "not sorted"),
        ({"kind": "table", "times": [0, 1], "values": [1, float("nan")]}, "NaN"),
        ({"kind": "table", "times": [0, 1, 2], "values": [1, 2]}, "as many"),
        ({"kind": "table", "times": [1, 2], "values": [1, 2]}, "from 0 s"),
        ({"kind": "table", "times": [0, 1, 1, 1, 2], "values": [1, 2, 3, 4, 5]}, "three times"),
        ({"kind": "harmonic", "amplitude": 1, "frequency": 0}, "frequency"),
        ({"kind": "ramp", "start": 0, "end": 1, "until": 0}, "until"),
    ],
)
def test_bad_histories_are_refused(table, words):
    with pytest.raises(lubfric.InputError, match=words):
        history("speed", table)


@pytest.mark.parametrize(
    "values, words",
    [
        ({"load": Ramp(start=5.0, end=-1.0, until=1.0)}, "-1 N"),
        ({"viscosity": Harmonic(mean=0.1, amplitude=0.2)}, "viscosity during the run = -0.1 Pa s"),
        ({"speed": Table(times=(0.0, 0.5), values=(1.0, 0.0))}, "table ends at 0.5 s"),
        ({"duration": 0.0}, "duration"),
        ({"outputs": 0}, "outputs"),
        ({"first_output": 1.0}, "first_output"),
        ({"first_output": -0.1}, "first_output"),
    ],
)
def test_bad_runs_are_refused(values, words):
    with pytest.raises(lubfric.InputError, match=words):
        Transient(**{"duration": 1.0, **values})


SCENE = """
[bodies]
radius = 2e-3
width = 6e-3
e_prime = 231e9
boundary_friction_coefficient = 0.1
load = { kind = "ramp", start = 2.0, end = 5.0, until = 0.5 }
[lubricant]
viscosity = 0.1
viscosity_law = "constant"
[motion]
entrainment_speed = { kind = "harmonic", amplitude = 0.2, frequency = 2.0, phase = 0.5 }
sliding_speed = 0.01
[surface]
sq = 0.0
correlation_length = 1e-6
[contact]
shape = [8, 8]
spacing = 1e-6
[transient]
duration = 1.0
outputs = 5
"""


def test_histories_in_a_scene_file(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SCENE)
    scene = lubfric.load_scene(path)
    assert scene.bodies.load == 5.0 and scene.transient.load.at(0.25) == 3.5
    assert scene.motion.entrainment_speed == pytest.approx(0.2 * np.sin(0.5))
    assert scene.transient.sliding == Constant(0.01) and scene.transient.outputs == 5
    path.write_text(SCENE.replace("duration = 1.0\n", ""))
    with pytest.raises(lubfric.InputError, match="duration"):
        lubfric.load_scene(path)
    path.write_text(SCENE.replace("outputs", "output"))
    with pytest.raises(lubfric.InputError, match="'outputs'"):
        lubfric.load_scene(path)
    path.write_text(SCENE + "load = 3.0\n")
    with pytest.raises(lubfric.InputError, match="both"):
        lubfric.load_scene(path)
    path.write_text(SCENE.replace("start = 2.0", "start = -2.0"))
    with pytest.raises(lubfric.InputError, match="-2 N"):
        lubfric.load_scene(path)
