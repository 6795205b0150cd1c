"""The answer by levels: Eq. (8) on a long line, its difference from the deterministic model on a few strips, finer
cells on fewer. Oracles: strips of other seeds solved one by one, sums of forces, Student's t by scipy.stats, and a
Monte Carlo of the sum over levels on numbers of known scatter."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scipy.stats

import lubfric
from lubfric.deterministic import solve_strip
from lubfric.sampling import levels
from lubfric.sampling.pair import Pair

SCENE = lubfric.load_scene("paper").with_(numerics={"film_deflection": "scaled"})
ROLLING = {"slide_roll_ratio": 0.3}


@pytest.fixture(scope="module")
def prepared():
    return lubfric.prepare(SCENE)


@pytest.fixture(scope="module")
def found(prepared):
    return lubfric.friction(prepared, 0.01)


def half(result):
    low, high = result.uncertainty.interval
    return 0.5 * (high - low) / result.coefficient


def test_parts_add_up_and_the_model_is_told(found):
    load = SCENE.bodies.load
    assert found.decision.model == "deterministic" and "one pressure" in found.decision.text
    assert found.boundary_force + found.shear_force == pytest.approx(found.coefficient * load, rel=1e-9)
    assert found.couette_force + found.rolling_force == pytest.approx(found.shear_force, rel=1e-9)
    assert found.contact_load + found.film_load == pytest.approx(load, rel=1e-9)
    assert 0 < found.contact_load < load and 1e-8 < found.mean_gap < 1e-6


def test_interval_holds_numerical_sampling_and_model(found):
    known = found.uncertainty
    t = scipy.stats.t.ppf(0.975, known.freedom)
    assert known.model > 0 and known.sampling > 0
    assert half(found) == pytest.approx(math.sqrt(known.numerical**2 + (t * known.sampling) ** 2 + known.model**2))
    assert half(found) < 0.065


def test_f_is_that_of_other_strips_one_by_one(prepared, found):
    """Eight strips of another seed, each by itself on the cells of the last level."""
    other = lubfric.prepare(SCENE.with_(surface={"seed": 77}))
    strips = [replace(other.surface, heights=other.strips.strip(k).heights, mask=None) for k in range(8)]
    f = [solve_strip(SCENE, replace(s, spacing=other.strips.cells.coarse), 0.01, factors=(2, 2)).result for s in strips]
    values = np.array([one.coefficient for one in f])
    error = math.hypot(values.std(ddof=1) / math.sqrt(8) / values.mean(), 0.012)  # by strips, by cells
    assert abs(found.coefficient / values.mean() - 1) < math.hypot(half(found), 2 * error)


def test_eq_8_alone_states_its_error(prepared, found):
    shared = lubfric.friction(prepared, 0.01, model="load-sharing")
    assert shared.decision.model == "load sharing"
    assert shared.uncertainty.model > abs(shared.coefficient / found.coefficient - 1) > 0.02
    assert half(shared) > shared.uncertainty.model * 0.999


def test_a_thick_film_needs_no_strips(prepared):
    thick = lubfric.friction(prepared, 0.6)
    assert thick.decision.model == "load sharing" and "hardly matters" in thick.decision.text
    assert 0 < thick.uncertainty.model < SCENE.numerics.model_tolerance
    assert thick.coefficient == lubfric.friction(prepared, 0.6, model="load-sharing").coefficient


def test_without_entrainment_f_is_f_b(prepared):
    rest = lubfric.friction(prepared, 0.0)
    assert rest.coefficient == pytest.approx(0.09) and rest.uncertainty.model == 0.0


def test_rolling_roughness_moves_or_gets_eq_8_and_the_sentence(monkeypatch):
    """By one gap where that is cheap; else by Eq. (8), which does not know its error, and says what the other takes."""
    small = SCENE.with_(motion=ROLLING, contact={"shape": (32, 32), "spacing": 90e-6 / 32})
    small = small.with_(numerics={"sampling": "patch"})
    moved, shared = (lubfric.friction(small, 0.01, model=model) for model in ("auto", "load-sharing"))
    assert moved.decision.model == "deterministic" and "moved at 0.0085 m/s" in moved.decision.text
    assert math.isnan(shared.uncertainty.model) and "here it moves" in shared.uncertainty.text
    monkeypatch.setattr("lubfric.sampling.moving.MOST_WORK", 0.1)
    costly = lubfric.friction(small, 0.01)
    assert costly.decision.model == "load sharing" and "s of processor time, more than 0.1 s" in costly.decision.text


def test_a_tighter_tolerance_takes_more_strips(prepared, found):
    scene = SCENE.with_(numerics={"model_tolerance": 0.1, "sampling_tolerance": 0.1})
    loose = lubfric.friction(lubfric.prepare(scene, like=prepared), 0.01)
    assert found.decision.strips > loose.decision.strips and half(found) < half(loose)
    assert abs(found.coefficient / loose.coefficient - 1) < half(loose) + half(found)


def test_half_and_twice_the_boundary_film_are_part_of_the_model_unless_it_is_given():
    scene = SCENE.with_(numerics={"sampling": "patch"}, lubricant={"limiting_stress_coefficient": 0.045})
    open_, given, half_of_it, twice = (
        lubfric.friction(scene.with_(bodies={"boundary_film": film}), 0.01) for film in (None, 20e-9, 10e-9, 40e-9)
    )
    assert open_.coefficient == pytest.approx(given.coefficient, rel=1e-12) and given.uncertainty.model == 0.0
    changes = [abs(other.coefficient / open_.coefficient - 1) for other in (half_of_it, twice)]
    assert open_.uncertainty.model == pytest.approx(max(changes), rel=0.05) and min(changes) > 0.01


def test_a_limit_of_zero_at_ambient_pressure_is_left_to_eq_8():
    oil = {"limiting_stress_coefficient": 0.045, "limiting_stress_offset": 0.0}
    found = lubfric.friction(SCENE.with_(lubricant=oil), 0.01)
    assert found.decision.model == "load sharing" and "limiting_stress_offset" in found.decision.text
    with pytest.raises(lubfric.InputError, match="limiting_stress_offset"):
        lubfric.friction(SCENE.with_(lubricant=oil), 0.01, model="deterministic")


def test_strips_that_fail_are_told(prepared, monkeypatch):
    def fails(*_):
        raise lubfric.ConvergenceError("no film", lubfric.errors.Report("a strip", "diverged", 3, 1.0, 1e-3))

    monkeypatch.setattr(levels, "solve_pair", fails)
    found = lubfric.friction(prepared, 0.01)
    assert found.decision.model == "load sharing" and "not solved" in found.decision.text
    assert found.uncertainty.model > 0.05
    with pytest.raises(lubfric.ConvergenceError):
        lubfric.friction(prepared, 0.01, model="deterministic")


def synthetic(rng, strips, places=40):
    """Pairs whose two models have the same scatter but for a small part, places independent."""
    common, own = 0.1 * rng.standard_normal((2, strips, places)) * np.array([1.0, 0.3])[:, None, None]
    both = []
    for index in range(strips):
        resolved, shared = 1 + common[index] + own[index], 1.1 + common[index]
        result = type("Result", (), {"coefficient": float(resolved.mean()), "load": 1.0})()
        strip = type("Strip", (), {"result": result, "deviations": resolved - resolved.mean()})()
        both.append(Pair(index, strip, math.nan, {"coefficient": float(shared.mean())}, shared - shared.mean()))
    return both


def test_standard_error_of_the_difference_by_monte_carlo(prepared):
    """What `_scatter` states, with what the rest of the line adds, is the scatter of the sum over levels."""
    rng, line, n = np.random.default_rng(5), 12, 4
    strips = replace(prepared.strips, lengths=(8e-6, prepared.strips.length / 90))
    sums, stated = [], []
    for _ in range(400):
        pairs = synthetic(rng, line)
        shared = [p.shared["coefficient"] for p in pairs]
        few = pairs[:n]
        sums.append(np.mean(shared) + np.mean([p.resolved.result.coefficient - p.shared["coefficient"] for p in few]))
        rest = (1 - n / line) * np.var(shared, ddof=1) / line
        stated.append(levels._scatter(few, strips, line).error ** 2 + rest)
    assert math.sqrt(np.mean(stated)) == pytest.approx(np.std(sums), rel=0.15)
