"""Stribeck curves: shape, and nothing lost to a failing point or job; any order: test_purity; executors: test_study."""

import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from small_study import SCENE

import lubfric
from lubfric.quantities import NUMBERS
from lubfric.studies import digest, points

STRIATED = {"model": "deterministic", "cavitated_shear": "striated"}
SPEEDS = np.geomspace(1e-4, 1.0, 9)
FRICTION = lubfric.friction


@pytest.fixture(scope="module")
def model():
    return lubfric.prepare(SCENE)


@pytest.fixture(scope="module")
def curve(model):
    return lubfric.stribeck(model, SPEEDS)


def same(one, other):
    for name in set(NUMBERS) - {"seconds"}:
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), err_msg=name)


def test_lift_off_has_the_direction_of_the_curve(model, curve):
    """Forwards and backwards f is the same but for the finite patch. These speeds are too far apart for lift-off
    itself."""
    back = lubfric.stribeck(model, -SPEEDS)
    (low, high) = curve.lift_off_range
    assert back.lift_off_range == pytest.approx((-high, -low)) and high / low == pytest.approx(10**0.5)
    assert np.isnan(curve.lift_off) and np.isnan(back.lift_off)
    assert back.at(-np.sqrt(low * high)) == pytest.approx(curve.at(np.sqrt(low * high)), rel=0.05)
    with pytest.raises(lubfric.InputError, match="chooses speeds above 0"):
        lubfric.stribeck(SCENE.with_(motion={"speeds": (-1.0, -0.01)}), "auto")


def test_what_is_out_of_range_is_refused_before_any_work():
    done = []
    for call in (
        lambda told: lubfric.stribeck(SCENE, [0.01, 1e7], on_point=told),
        lambda told: lubfric.traction(SCENE, [0.5], speed=1e7, on_point=told),
        lambda told: lubfric.traction(SCENE, [0.5, 1e7], on_point=told),
        lambda told: lubfric.traction(SCENE.with_(numerics=STRIATED), [2.0, 0.5], on_point=told),
        lambda told: lubfric.study(SCENE, {}, [0.01, 1e7], on_progress=told),
    ):
        with pytest.raises(lubfric.InputError, match="1e.07|cavitated_shear"):
            call(lambda *point: done.append(point))
    assert not done


def test_the_curve_has_the_shape_of_stribeck(curve):
    f = curve.coefficient
    low = int(np.argmin(f))
    assert f[0] == pytest.approx(0.09, rel=0.01) and 0 < low < SPEEDS.size - 1
    assert np.all(np.diff(f[: low + 1]) < 0) and np.all(np.diff(f[low:]) > 0)
    assert np.all(np.diff(curve.contact_load) <= 0) and curve.contact_load[-1] == 0
    assert np.all(np.abs(curve.load_residual) < 1e-12)
    for point in curve.points:  # closed as far as f feels it
        assert abs(point.volume_residual) <= point.report.tolerance
    assert curve.report.converged and not curve.errors and curve.report.residual <= curve.report.tolerance
    separated = curve.contact_load == 0
    assert np.all(curve.volume_residual[separated] == 0)
    np.testing.assert_allclose(curve.mean_gap[separated], curve.central_film[separated], rtol=0.02)


def test_a_failing_point_loses_nothing(monkeypatch, model, curve):
    def failing(model, speed, **options):
        if speed == SPEEDS[4]:
            raise lubfric.ConvergenceError(
                "injected", lubfric.Report("x", "diverged", iterations=1, residual=1.0, tolerance=0.1)
            )
        return FRICTION(model, speed, **options)

    monkeypatch.setattr(points, "friction", failing)
    with pytest.raises(lubfric.ConvergenceError, match="injected") as caught:
        lubfric.stribeck(model, SPEEDS)
    kept = pickle.loads(pickle.dumps(caught.value)).result
    assert list(kept.errors) == [4] and np.isnan(kept.coefficient[4]) and kept.points[4] is None
    others = np.delete(np.arange(9), 4)
    np.testing.assert_array_equal(kept.coefficient[others], curve.coefficient[others])
    quiet = lubfric.stribeck(model, SPEEDS, raise_on_failure=False)
    assert not quiet.report.converged and "injected" in quiet.report.notes[0]


class LosingExecutor(ThreadPoolExecutor):
    """Loses its second job, as a killed worker would."""

    jobs = 0

    def submit(self, *args):
        self.jobs += 1
        if self.jobs == 2:
            return super().submit(lambda: 1 / 0)
        return super().submit(*args)


def test_a_lost_job_loses_nothing_and_changes_nothing(curve):
    with LosingExecutor(1) as executor:
        same(lubfric.stribeck(SCENE, SPEEDS, executor), curve)


def test_a_fault_of_the_program_is_no_failed_point(monkeypatch, model):
    def faulty(model, speed, **options):
        if speed == SPEEDS[4]:
            raise TypeError("a fault of the program")
        return FRICTION(model, speed, **options)

    monkeypatch.setattr(points, "friction", faulty)
    with pytest.raises(TypeError, match="a fault of the program") as caught:
        lubfric.stribeck(model, SPEEDS, raise_on_failure=False)
    np.testing.assert_array_equal(np.isfinite(caught.value.result.coefficient), np.arange(9) < 4)


@pytest.mark.parametrize("cut, fields", [(1, True), (8, [SPEEDS[5]]), (1, False)])
def test_a_cut_sweep_goes_on_to_the_same_bits(model, tmp_path, monkeypatch, cut, fields):
    whole = lubfric.stribeck(model, SPEEDS, fields=fields)

    class Cut(Exception):
        pass

    def cutting(done, *_):
        if done == cut:
            raise Cut

    with pytest.raises(Cut) as caught:
        lubfric.stribeck(model, SPEEDS, fields=fields, store=tmp_path, on_point=cutting)
    assert np.isfinite(caught.value.result.coefficient).sum() == cut
    solved = []
    monkeypatch.setattr(points, "friction", lambda *a, **k: solved.append(a) or FRICTION(*a, **k))
    again = lubfric.stribeck(model, SPEEDS, fields=fields, store=tmp_path)
    assert len(solved) == SPEEDS.size - cut
    for here, there in zip(again.points, whole.points):
        assert digest(replace(here, seconds=0.0)) == digest(replace(there, seconds=0.0))


def test_fields_of_a_speed_that_is_not_solved_are_refused():
    with pytest.raises(lubfric.InputError, match="not all among the speeds"):
        lubfric.stribeck(SCENE, SPEEDS, fields=[SPEEDS[1], 1.1 * SPEEDS[2]])
