"""Stribeck curves: shape, order, executors, and nothing lost to a failing point."""

import os
import pickle
import signal
import threading
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

import lubfric
from lubfric.sharing import prepare
from lubfric.studies import QUANTITIES, trail
from lubfric.studies.fingerprint import digest

SCENE = (
    lubfric.load_scene("paper")
    .with_(numerics={"sampling": "patch"})
    .with_(contact={"shape": (64, 64), "spacing": 0.9e-6}, surface={"correlation_length": 4e-6})
)
SPEEDS = np.geomspace(1e-4, 1.0, 9)


@pytest.fixture(scope="module")
def curve():
    return lubfric.stribeck(prepare(SCENE), SPEEDS)


def test_lift_off_has_the_direction_of_the_curve(curve):
    """Forwards and backwards f is the same but for the finite patch; `at` takes what `lift_off` gives."""
    back = lubfric.stribeck(prepare(SCENE), -SPEEDS)
    assert back.lift_off == pytest.approx(-curve.lift_off, rel=0.02)
    assert back.at(back.lift_off) == pytest.approx(curve.at(curve.lift_off), rel=0.02)
    with pytest.raises(lubfric.InputError, match="runs forwards"):
        lubfric.stribeck(SCENE.with_(motion={"speeds": (-1.0, -0.01)}), "auto")


@pytest.mark.parametrize("model", ["half-space", "summits"])
def test_a_point_at_rest_is_no_start_and_does_no_harm(model):
    """Its film, of no load, was 1e10 m thick: an error about gap0, or a `ValueError`."""
    prepared = prepare(SCENE.with_(contact={"model": model}))
    rest = lubfric.friction(prepared, 0.0, fields=True)
    assert lubfric.friction(prepared, 0.02, start=rest).coefficient == lubfric.friction(prepared, 0.02).coefficient


def test_what_is_out_of_range_is_refused_before_any_work():
    """A slide-roll ratio beyond its range lost the ratios before it; a speed ended as a failed point."""
    done = []
    for call in (
        lambda told: lubfric.stribeck(SCENE, [0.01, 1e7], on_point=told),
        lambda told: lubfric.traction(SCENE, [0.5], speed=1e7, on_point=told),
        lambda told: lubfric.traction(SCENE, [0.5, 1e7], on_point=told),
        lambda told: lubfric.traction(SCENE.with_(numerics={"closure": "one-way"}), [2.0, 0.5], on_point=told),
        lambda told: lubfric.study(SCENE, {}, [0.01, 1e7], on_progress=told),
    ):
        with pytest.raises(lubfric.InputError, match="1e.07|slide_roll_ratio = 0.5"):
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
        assert point.decision.sensitivity * abs(point.volume_residual) <= 0.1 * SCENE.numerics.tolerance
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
    same(spread, curve)


def test_where_a_curve_begins_moves_it_within_the_tolerance(curve):
    cold = [lubfric.friction(curve_model(), speed).coefficient for speed in SPEEDS]
    np.testing.assert_allclose(curve.coefficient, cold, rtol=SCENE.numerics.tolerance)


def curve_model():
    return prepare(SCENE)


def test_points_in_a_store_are_told_while_others_are_solved(tmp_path, monkeypatch):
    """Also those of another process, before the piece of work that they belong to has ended."""
    gate, told = threading.Event(), []

    def waiting(model, speed, **options):
        assert speed != SPEEDS[0] or gate.wait(60)  # the last of all
        return FRICTION(model, speed, **options)

    def seen(done, total, speed, outcome):
        told.append(speed)
        if done == SPEEDS.size - 1:
            gate.set()

    monkeypatch.setattr(trail, "friction", waiting)
    with ThreadPoolExecutor(2) as executor:
        lubfric.stribeck(SCENE, SPEEDS, executor, store=tmp_path, on_point=seen)
    assert sorted(told) == sorted(SPEEDS) and told[-1] == SPEEDS[0]


def test_a_failing_point_loses_nothing(monkeypatch, curve):
    real, bad = trail.friction, SPEEDS[4]

    def failing(model, speed, **kw):
        if speed == bad:
            raise lubfric.ConvergenceError("injected", lubfric.Report("x", "diverged", 1, 1.0, 0.1))
        return real(model, speed, **kw)

    monkeypatch.setattr(trail, "friction", failing)
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


def test_what_a_lost_worker_left_is_solved_again(curve):
    with LosingExecutor(1) as executor:
        whole = lubfric.stribeck(SCENE, SPEEDS, executor)
    assert not whole.errors
    np.testing.assert_allclose(whole.coefficient, curve.coefficient, rtol=SCENE.numerics.tolerance)


def die(*_, **__):
    os.kill(os.getpid(), signal.SIGKILL)


def killed_in_a_worker(model, speed, **options):
    if speed < 1e-2 and os.getpid() != PARENT:
        die()
    return FRICTION(model, speed, **options)


PARENT, FRICTION = os.getpid(), lubfric.friction


@pytest.mark.parametrize("stored", [False, True])
def test_killed_workers_lose_nothing_and_change_nothing(monkeypatch, tmp_path, stored):
    with ProcessPoolExecutor(2) as executor:
        whole = lubfric.stribeck(SCENE, SPEEDS, executor)
    monkeypatch.setattr(trail, "friction", killed_in_a_worker)
    with ProcessPoolExecutor(2) as executor:
        again = lubfric.stribeck(SCENE, SPEEDS, executor, store=tmp_path if stored else None)
    same(again, whole)


def same(one, other):
    for name in set(QUANTITIES) - {"seconds"}:
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), err_msg=name)


def test_a_fault_of_the_program_is_no_failed_point(monkeypatch):
    def faulty(model, speed, **options):
        if speed == SPEEDS[4]:
            raise TypeError("a fault of the program")
        return FRICTION(model, speed, **options)

    monkeypatch.setattr(trail, "friction", faulty)
    with pytest.raises(TypeError, match="a fault of the program") as caught:
        lubfric.stribeck(prepare(SCENE), SPEEDS, raise_on_failure=False)
    solved = np.isfinite(caught.value.result.coefficient)  # the first, and the faster ones, which came before it
    assert 0 < solved.sum() < SPEEDS.size and not solved[4] and solved[5:].all()


@pytest.mark.parametrize("cut", [1, 4, 8])
@pytest.mark.parametrize("fields", [False, [SPEEDS[5]], True])
def test_a_cut_sweep_goes_on_to_the_same_bits(tmp_path, monkeypatch, cut, fields):
    model = prepare(SCENE)
    whole = lubfric.stribeck(model, SPEEDS, fields=fields)
    count = [0]

    class Cut(Exception):
        pass

    def cutting(*_):
        count[0] += 1
        if count[0] == cut:
            raise Cut

    with pytest.raises(Cut) as caught:
        lubfric.stribeck(model, SPEEDS, fields=fields, store=tmp_path, on_point=cutting)
    assert np.isfinite(caught.value.result.coefficient).sum() == cut
    solved = []
    monkeypatch.setattr(trail, "friction", lambda *a, **k: solved.append(a) or FRICTION(*a, **k))
    again = lubfric.stribeck(model, SPEEDS, fields=fields, store=tmp_path)
    assert len(solved) == SPEEDS.size - cut
    same(again, whole)
    for here, there in zip(again.points, whole.points):
        assert digest(replace(here, seconds=0.0)) == digest(replace(there, seconds=0.0))


def test_fields_of_a_speed_that_is_not_solved_are_refused():
    with pytest.raises(lubfric.InputError, match="not all among the speeds"):
        lubfric.stribeck(SCENE, SPEEDS, fields=[SPEEDS[1], 1.1 * SPEEDS[2]])


def test_a_curve_outlives_the_shell_that_began_it(monkeypatch, curve):
    """As behind nohup: the parent of this process changes while it solves. Only a worker ends with its parent."""
    parents = iter(range(10**6))
    monkeypatch.setattr(os, "getppid", lambda: next(parents))
    same(lubfric.stribeck(prepare(SCENE), SPEEDS), curve)


def test_progress_counts_every_point():
    seen = []
    lubfric.stribeck(
        prepare(SCENE), SPEEDS[:3], on_point=lambda done, total, speed, point: seen.append((done, total, speed))
    )
    assert seen == [(1, 3, SPEEDS[2]), (2, 3, SPEEDS[1]), (3, 3, SPEEDS[0])]


def test_a_curve_goes_outwards_from_mixed_lubrication():
    seen = []
    lubfric.stribeck(prepare(SCENE), SPEEDS, on_point=lambda *told: seen.append(told[2]))
    first = int(np.flatnonzero(SPEEDS == seen[0])[0])
    assert 0 < first < SPEEDS.size - 1
    assert seen[1:] == [*SPEEDS[first + 1 :], *SPEEDS[:first][::-1]]


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
