"""The march in time by equations whose solutions are known, and the limiter of Newton's method."""

from dataclasses import dataclass

import numpy as np

from lubfric.scene import Table
from lubfric.time import CreepingEnds, Progress, Step, plan_of, report_of, steps
from lubfric.time.march import grid_residual


@dataclass
class Relaxation:
    """y' = target(t) - y for every node, y and an idle last unknown: exp(-t) where the target is constant."""

    target: Table
    fails_after: float = 1e9

    def solve(self, time, memory, z, payload):
        y = (memory.rate * memory.film + self.target.before(time)) / (memory.rate + 1.0)
        status = "converged" if time < self.fails_after else "diverged"
        return Step(status=status, film=y, z=np.append(y, -1.0), payload=(payload or 0) + 1)

    def error_of(self, solution, difference):
        return float(np.max(np.abs(difference / solution.film)))


CONSTANT = Table(times=(0.0, 9.0), values=(0.0, 0.0))
JUMP = Table(times=(0.0, 1.0, 1.0, 9.0), values=(0.0, 0.0, 3.0, 3.0))


def begun(step=1e-3):
    return Progress(last_steps=(Step(film=np.array([1.0, 2.0]), z=np.array([1.0, 2.0, -1.0])),), next_step=step)


def outputs(solver, plan, now):
    return [now for now in steps(solver, plan, now) if now.at_output]


def test_decay_is_followed_to_every_output():
    times = np.array([0.0, 0.5, 2.0, 3.0])
    tolerance = 1e-5
    plan = plan_of(times, (CONSTANT,), 1e-3, tolerance)
    result = outputs(Relaxation(CONSTANT), plan, begun())
    assert [now.time for now in result] == times[1:].tolist()
    for now in result:  # each step adds at most the tolerance
        exact = np.array([1.0, 2.0]) * np.exp(-now.time)
        np.testing.assert_allclose(now.solution.film, exact, rtol=now.steps * tolerance)
    assert 0 < result[-1].worst <= 1


def test_error_falls_with_the_tolerance():
    plans = [plan_of(np.array([2.0]), (CONSTANT,), 1e-3, tolerance) for tolerance in (1e-4, 1e-5, 1e-6)]
    ends = [outputs(Relaxation(CONSTANT), plan, begun())[-1] for plan in plans]
    errors = [abs(now.solution.film[0] / np.exp(-2.0) - 1) for now in ends]
    assert errors[0] > 3 * errors[1] > 9 * errors[2]
    assert ends[0].steps < ends[1].steps < ends[2].steps


def test_a_jump_of_a_history_ends_a_step_and_forgets_the_past():
    """y decays to e^-1, then rises to 3: what BDF2 would carry over the jump is not there."""
    plan = plan_of(np.array([3.0]), (JUMP,), 1e-3, 1e-6)
    assert plan.jumps == {1.0} and plan.stops == (1.0, 3.0)
    marched = list(steps(Relaxation(JUMP), plan, begun()))
    at = next(now for now in marched if now.time == 1.0)
    assert len(at.last_steps) == 1 and at.next_step == 1e-3 and not at.at_output
    exact = 3.0 + (np.array([1.0, 2.0]) * np.exp(-1.0) - 3.0) * np.exp(-2.0)
    np.testing.assert_allclose(marched[-1].solution.film, exact, rtol=1e-4)


def test_a_run_goes_on_from_any_progress_bit_by_bit():
    plan = plan_of(np.linspace(0.0, 3.0, 7), (JUMP,), 1e-3, 1e-5)
    whole = list(steps(Relaxation(JUMP), plan, begun()))
    for k in (0, 3, len(whole) // 2, len(whole) - 2):
        rest = list(steps(Relaxation(JUMP), plan, whole[k]))
        assert len(rest) == len(whole) - k - 1
        assert rest[-1].steps == whole[-1].steps and rest[-1].worst == whole[-1].worst
        assert np.array_equal(rest[-1].solution.film, whole[-1].solution.film)
        assert rest[-1].payload == whole[-1].payload


def test_a_step_that_fails_is_tried_shorter_and_then_reported():
    plan = plan_of(np.array([0.5, 2.0]), (CONSTANT,), 1e-3, 1e-5)
    *_, last = steps(Relaxation(CONSTANT, fails_after=1.0), plan, begun())
    assert 0.99 < last.time < 1.0 and last.rejected > 3
    report = report_of("relaxation", plan, last, "2 nodes", {})
    assert report.status == "stagnated"
    assert "stopped at t = 1 s of 2 s, 1 of 2 outputs are solved" in report.message
    whole = outputs(Relaxation(CONSTANT), plan, begun())[-1]
    assert report_of("relaxation", plan, whole, "2 nodes", {}).converged
    poor = report_of("relaxation", plan, whole, "2 nodes", {"grid": grid_residual(1.5)})
    assert (
        poor.status == "iteration_limit"
        and poor.residual == 1.5
        and "1.5 times its tolerance at the start" in poor.message
    )


def test_an_end_of_the_film_that_creeps_is_sent_ahead_and_one_in_excess_is_not():
    """Each step fills one more node on the left: the fourth fills two more, the next four. Emptied nodes end that; the
    right end stays."""
    dry = np.zeros(100, bool)
    dry[20] = True
    ends = CreepingEnds()
    first = 50
    firsts = []
    for _ in range(5):
        cavitated = np.ones(100, bool)
        cavitated[first:60] = False
        filled = np.flatnonzero(~ends.sent_ahead(cavitated, dry, 55))
        firsts.append(int(filled[0]))
        assert filled[-1] == 59 and np.array_equal(filled, np.arange(filled[0], 60))
        first = int(filled[0]) - 1
    assert firsts == [50, 49, 48, 47, 44]
    too_many = np.ones(100, bool)
    too_many[first + 3 : 60] = False
    assert np.flatnonzero(~ends.sent_ahead(too_many, dry, 55))[0] == first + 3 and ends.steps == (0, 0)
