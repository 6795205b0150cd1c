"""Dry contact: what must hold for any surface, load and boundary; edges; faults; certification."""

import math
import pickle

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from lubfric import ConvergenceError, InputError, solve_contact
from lubfric.contact import half_space, length_scale

E_PRIME = 231e9
BOUNDARIES = [(a, b) for a in ("periodic", "free") for b in ("periodic", "free")]
DX = 2e-6


def rough(shape, seed=0, sq=240e-9, smooth=6.0):
    """Gaussian gap [m] with a Gaussian spectrum, periodic."""
    noise = np.random.default_rng(seed).standard_normal(shape)
    k2 = np.fft.fftfreq(shape[0])[:, None] ** 2 + np.fft.rfftfreq(shape[1]) ** 2
    z = np.fft.irfft2(np.fft.rfft2(noise) * np.exp(-0.5 * k2 * (2 * np.pi * smooth / 2) ** 2), s=shape)
    return sq * (z - z.mean()) / max(z.std(), 1e-30)


def certify(result, gap0, operator, hardness=np.inf, tolerance=1e-6):
    """The statement itself, from pressure and approach alone."""
    u = operator.apply(result.pressure)
    gap = gap0 - result.approach + u
    rounding = 4e-16 * np.abs(gap0).max()
    scale = length_scale(result.pressure, u, gap0, operator)
    assert result.gap == pytest.approx(gap, abs=1e-12 * np.abs(gap0).max() + 1e-13 * np.abs(u).max())
    assert result.pressure.min() >= 0 and result.pressure.max() <= hardness
    assert gap[result.pressure < hardness].min(initial=0.0) >= -1.01 * tolerance * scale - rounding
    loaded = (result.pressure > 0) & (result.pressure < hardness)
    most = (1.01 * tolerance * scale + rounding) * result.pressure.sum()
    assert (result.pressure * np.abs(gap))[loaded].sum() <= most
    assert result.report.converged and result.report.residual <= tolerance


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("hardness", [None, 4e9])
def test_every_boundary_and_law(boundary, hardness):
    gap0 = rough((48, 40))
    operator = half_space(gap0.shape, DX, E_PRIME, boundary)
    kind = {"hardness": hardness, "boundary": boundary, "operator": operator}
    result = solve_contact(gap0, DX, E_PRIME, mean_pressure=5e8, **kind)
    certify(result, gap0, operator, np.inf if hardness is None else hardness)
    assert result.pressure.mean() == pytest.approx(5e8, rel=1e-12)
    assert (result.plastic_area_fraction > 0) == (hardness is not None)
    assert result.mean_gap == pytest.approx(np.maximum(result.gap, 0).mean(), rel=1e-12)


@settings(max_examples=60)
@given(
    shape=st.tuples(st.integers(1, 37), st.integers(1, 37)),
    boundary=st.sampled_from(BOUNDARIES),
    spacing=st.tuples(st.floats(0.2, 5), st.floats(0.2, 5)),
    exponent=st.floats(-12, -0.5),
    cap=st.one_of(st.none(), st.floats(0.01, 10)),
    seed=st.integers(0, 9),
)
@example(shape=(15, 28), boundary=BOUNDARIES[2], spacing=(1.0, 1.0), exponent=-1.5, cap=0.75, seed=4)
@example(shape=(3, 10), boundary=BOUNDARIES[0], spacing=(1.0, 1.0), exponent=-7.0, cap=0.2, seed=0)
def test_any_problem_is_solved_or_said_not_to_be(shape, boundary, spacing, exponent, cap, seed):
    """All are solved but one kind: a load of which a whole number of cells bears exactly its capacity, and nothing is
    left for the others. Rounding alone tells who bears the rest, and nearly rigid ones then are said to stagnate."""
    gap0 = np.random.default_rng(seed).random(shape)
    pressure = 10.0**exponent
    hardness = None if cap is None else pressure * (1 + cap)
    operator = half_space(shape, spacing, 1.0, boundary)
    full = math.inf if cap is None else gap0.size / (1 + cap)  # cells that could bear the load
    try:
        result = solve_contact(
            gap0, spacing, 1.0, mean_pressure=pressure, hardness=hardness, boundary=boundary, operator=operator
        )
    except ConvergenceError as error:
        assert abs(full - round(full)) < 1e-12 * full and error.report.status == "stagnated"
        return
    certify(result, gap0, operator, np.inf if hardness is None else hardness)


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("hardness", [None, 4e9])
@pytest.mark.parametrize("pressure", [1e6, 2.5e9])
def test_gap_control_returns_the_load(boundary, hardness, pressure):
    gap0 = rough((40, 32), seed=5)
    options = {"hardness": hardness, "boundary": boundary}
    by_load = solve_contact(gap0, DX, E_PRIME, mean_pressure=pressure, tolerance=1e-8, **options)
    by_gap = solve_contact(gap0, DX, E_PRIME, mean_gap=by_load.mean_gap, tolerance=1e-8, **options)
    assert by_gap.mean_pressure == pytest.approx(pressure, rel=2e-5)
    assert by_gap.mean_gap == pytest.approx(by_load.mean_gap, rel=1e-5)
    assert by_gap.pressure == pytest.approx(by_load.pressure, abs=1e-4 * by_load.pressure.max())


def test_a_tiny_gap_of_a_contact_that_yields_is_found_and_given_back_by_its_load():
    gap0 = rough((32, 32), seed=4)
    wanted = 1e-3 * float(gap0.mean() - gap0.min())
    result = solve_contact(gap0, DX, E_PRIME, mean_gap=wanted, hardness=0.02 * E_PRIME)
    assert result.mean_gap == pytest.approx(wanted, rel=1e-5)
    loaded = solve_contact(gap0, DX, E_PRIME, mean_pressure=result.mean_pressure, hardness=0.02 * E_PRIME)
    assert loaded.mean_gap == pytest.approx(wanted, rel=1e-2)


def test_separated_bodies_carry_nothing_and_touch_without_load():
    gap0 = rough((20, 20))
    for factor in (1.0, 1.5):
        wanted = factor * (gap0.mean() - gap0.min())
        result = solve_contact(gap0, DX, E_PRIME, mean_gap=wanted)
        assert not result.pressure.any() and result.mean_pressure == 0 and result.contact_area_fraction == 0
        assert result.gap.mean() == pytest.approx(wanted) and result.mean_gap == pytest.approx(wanted)
        assert result.report.converged and result.gap.min() >= -1e-20
    result = solve_contact(gap0, DX, E_PRIME, mean_pressure=0.0)
    assert result.gap.min() == 0 and not result.pressure.any() and result.approach == gap0.min()
    assert result.report.converged and result.report.residuals["load"] == 0


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("hardness", [None, 4e9])
def test_warm_start_gives_the_same_answer_sooner(boundary, hardness):
    gap0 = rough((64, 60), seed=7)
    options = {"boundary": boundary, "hardness": hardness}
    near = solve_contact(gap0, DX, E_PRIME, mean_pressure=4.8e8, **options)
    cold = solve_contact(gap0, DX, E_PRIME, mean_pressure=5e8, **options)
    for start in (near, near.pressure):
        warm = solve_contact(gap0, DX, E_PRIME, mean_pressure=5e8, start=start, **options)
        assert warm.pressure == pytest.approx(cold.pressure, abs=2e-4 * cold.pressure.max())
        assert warm.report.evaluations < cold.report.evaluations
    before = near.pressure.copy()
    assert solve_contact(gap0, DX, E_PRIME, mean_pressure=4.8e8, start=near, **options).report.iterations <= 2
    assert np.array_equal(near.pressure, before)


@pytest.mark.parametrize("start", [0.0, 1.0, 1e17])
def test_any_start_will_do(start):
    gap0 = rough((32, 32), seed=8)
    for control in ({"mean_pressure": 5e8}, {"mean_gap": 2e-7}, {"mean_pressure": 5e8, "hardness": 3e9}):
        far = solve_contact(gap0, DX, E_PRIME, start=np.full((32, 32), start), **control)
        cold = solve_contact(gap0, DX, E_PRIME, **control)
        assert far.pressure == pytest.approx(cold.pressure, abs=2e-4 * cold.pressure.max())


@pytest.mark.parametrize("hardness", [None, 2e6])
def test_flat_on_flat(hardness):
    result = solve_contact(np.full((24, 18), 5e-7), DX, E_PRIME, mean_pressure=1e6, hardness=hardness)
    assert result.pressure == pytest.approx(1e6) and result.gap == pytest.approx(0, abs=1e-18)
    assert result.contact_area_fraction == 1 and result.plastic_area_fraction == 0


def test_one_high_cell_carries_what_it_can():
    """A single touching cell is no solution while its neighbours overlap."""
    gap0 = np.full((40, 40), 1e-6)
    gap0[20, 20] = 0.0
    light = solve_contact(gap0, DX, E_PRIME, mean_pressure=1e2)
    assert np.count_nonzero(light.pressure) == 1 and light.gap.min() >= 0
    heavy = solve_contact(gap0, DX, E_PRIME, mean_pressure=5e9)
    assert np.count_nonzero(heavy.pressure) > 1000 and heavy.report.converged


@pytest.mark.parametrize("share", [0.3, 0.999, 1.0])
@pytest.mark.parametrize("boundary", [("periodic", "periodic"), ("free", "periodic")])
def test_yielding_up_to_the_whole_area(share, boundary):
    gap0 = rough((40, 40), seed=11)
    hardness = 2e8
    result = solve_contact(gap0, DX, E_PRIME, mean_pressure=share * hardness, hardness=hardness, boundary=boundary)
    assert result.pressure.max() == hardness and result.pressure.mean() == pytest.approx(share * hardness)
    assert share - 0.05 < result.plastic_area_fraction <= share + 1e-12


def test_iteration_limit_raises_with_everything():
    gap0 = rough((64, 64), seed=12)
    with pytest.raises(ConvergenceError) as caught:
        solve_contact(gap0, DX, E_PRIME, mean_pressure=5e8, max_iterations=2)
    error = pickle.loads(pickle.dumps(caught.value))
    assert error.report.status == "iteration_limit" and error.report.iterations == 2
    assert error.report.residual > 1e-6 and error.result.pressure.shape == (64, 64)
    quiet = solve_contact(gap0, DX, E_PRIME, mean_pressure=5e8, max_iterations=2, raise_on_failure=False)
    assert not quiet.report.converged and quiet.pressure.mean() == pytest.approx(5e8)


def test_certification_does_not_believe_the_iteration(monkeypatch):
    """A search that claims success with a wrong field is found out."""
    from lubfric.contact.search import CandidateSearch

    honest = CandidateSearch.new_pressure
    monkeypatch.setattr(CandidateSearch, "new_pressure", lambda *given: np.roll(honest(*given), 1, axis=0))
    with pytest.raises(ConvergenceError) as caught:
        solve_contact(rough((32, 32)), DX, E_PRIME, mean_pressure=5e8)
    assert caught.value.report.residuals["penetration"] > 1e-3


GOOD = {"gap0": np.zeros((4, 4)), "spacing": 1.0, "e_prime": 1.0, "mean_pressure": 1.0}


@pytest.mark.parametrize(
    "change, word",
    [({"mean_gap": 1.0}, "exactly one"), ({"mean_pressure": None}, "exactly one")]
    + [({"mean_pressure": None, "mean_gap": 0.0}, "mean_gap"), ({"hardness": 0.5}, "hardness")]
    + [({"boundary": ("free", "open")}, "boundary"), ({"start": np.zeros((3, 3))}, "start")]
    + [({"start": np.full((4, 4), -1.0)}, "start"), ({"operator": half_space((4, 5), 1.0, 1.0)}, "operator")]
    + [({"operator": half_space((4, 4), 2.0, 1.0)}, "spacing")]
    + [({"operator": half_space((4, 4), 1.0, 1.0, "free")}, "boundary")],
)
def test_bad_input_is_refused_before_any_work(change, word):
    with pytest.raises(InputError, match=word):
        solve_contact(**(GOOD | change))
