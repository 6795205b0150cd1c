"""Stribeck curves: shape, order, executors, and nothing lost to a failing point."""

import pickle
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest

import lubfric
from lubfric import sweep
from lubfric.model import prepare

SCENE = lubfric.load_scene("paper").with_(
    contact={"shape": (64, 64), "spacing": 0.9e-6}, surface={"correlation_length": 4e-6}
)
SPEEDS = np.geomspace(1e-4, 1.0, 9)


@pytest.fixture(scope="module")
def curve():
    return lubfric.stribeck(prepare(SCENE), SPEEDS)


def test_the_curve_has_the_shape_of_stribeck(curve):
    f = curve.coefficient
    low = int(np.argmin(f))
    assert f[0] == pytest.approx(0.09, rel=0.01) and 0 < low < SPEEDS.size - 1
    assert np.all(np.diff(f[: low + 1]) < 0) and np.all(np.diff(f[low:]) > 0)
    assert np.all(np.diff(curve.contact_load) <= 0) and curve.contact_load[-1] == 0
    assert np.all(np.abs(curve.load_residual) < 1e-12)
    assert np.all(np.abs(curve.volume_residual[curve.contact_load > 0]) <= SCENE.numerics.volume_tolerance)
    assert curve.report.converged and not curve.errors


def test_results_come_in_the_order_asked_for(curve):
    order = np.random.default_rng(3).permutation(SPEEDS.size)
    shuffled = lubfric.stribeck(prepare(SCENE), SPEEDS[order])
    np.testing.assert_array_equal(shuffled.speed, SPEEDS[order])
    np.testing.assert_allclose(shuffled.coefficient, curve.coefficient[order], rtol=1e-12)


@pytest.mark.parametrize("pool", [ThreadPoolExecutor, ProcessPoolExecutor])
def test_any_executor_gives_the_same_curve(curve, pool):
    with pool(2) as executor:
        spread = lubfric.stribeck(SCENE, SPEEDS, executor)
    np.testing.assert_allclose(spread.coefficient, curve.coefficient, rtol=SCENE.numerics.tolerance)


def test_a_failing_point_loses_nothing(monkeypatch, curve):
    real, bad = sweep.friction, SPEEDS[4]

    def failing(model, speed, **kw):
        if speed == bad:
            raise lubfric.ConvergenceError("injected", lubfric.Report("x", "diverged", 1, 1.0, 0.1))
        return real(model, speed, **kw)

    monkeypatch.setattr(sweep, "friction", failing)
    with pytest.raises(lubfric.ConvergenceError, match="injected") as caught:
        lubfric.stribeck(prepare(SCENE), SPEEDS)
    kept = pickle.loads(pickle.dumps(caught.value)).result
    assert list(kept.errors) == [4] and np.isnan(kept.coefficient[4]) and kept.points[4] is None
    others = np.delete(np.arange(9), 4)
    np.testing.assert_allclose(kept.coefficient[others], curve.coefficient[others], rtol=SCENE.numerics.tolerance)
    quiet = lubfric.stribeck(prepare(SCENE), SPEEDS, raise_on_failure=False)
    assert not quiet.report.converged and "injected" in quiet.report.notes[0]


class LosingExecutor(ThreadPoolExecutor):
    """Loses its second job, as a killed worker would."""

    jobs = 0

    def submit(self, *args):
        self.jobs += 1
        if self.jobs == 2:
            return super().submit(lambda: 1 / 0)
        return super().submit(*args)


def test_a_lost_worker_loses_only_its_own_speeds():
    with LosingExecutor(1) as executor:
        kept = lubfric.stribeck(SCENE, SPEEDS, executor, raise_on_failure=False)
    assert 0 < len(kept.errors) < SPEEDS.size
    assert all(isinstance(e, ZeroDivisionError) for e in kept.errors.values())
    assert np.isfinite(kept.coefficient).sum() == SPEEDS.size - len(kept.errors)


def test_progress_counts_every_point():
    seen = []
    lubfric.stribeck(
        prepare(SCENE), SPEEDS[:3], on_point=lambda done, total, speed, point: seen.append((done, total, speed))
    )
    assert seen == [(1, 3, SPEEDS[2]), (2, 3, SPEEDS[1]), (3, 3, SPEEDS[0])]


def test_zero_speed_belongs_to_a_sweep():
    curve = lubfric.stribeck(prepare(SCENE), [0.0, 1e-3, -1e-3])
    assert curve.coefficient[0] == pytest.approx(0.09) and curve.coefficient[2] < 0.09


@pytest.mark.parametrize("speeds", [[], [[0.1]], [np.nan], "abc", [0.1, "x"]])
def test_bad_speeds_are_errors_before_any_work(speeds):
    with pytest.raises(lubfric.InputError, match="speeds"):
        lubfric.stribeck(SCENE, speeds)


def test_a_bad_executor_or_scene_is_an_error():
    with pytest.raises(lubfric.InputError, match="Executor"):
        lubfric.stribeck(SCENE, SPEEDS, "process")
    with pytest.raises(lubfric.InputError, match="load_scene"):
        lubfric.stribeck("paper")
    with pytest.raises(lubfric.InputError, match="load_scene"):
        lubfric.friction("paper")


def test_separated_points_are_in_balance(curve):
    separated = curve.contact_load == 0
    assert separated.any() and np.all(curve.volume_residual[separated] == 0)
    np.testing.assert_allclose(curve.mean_gap[separated], curve.central_film[separated], rtol=0.02)
    assert curve.report.residual <= curve.report.tolerance
