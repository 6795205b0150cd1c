"""One strip on one grid: the same heights on longer cells, its sums by columns, its slope, starts and counted work."""

import pickle
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import lubfric
from lubfric.film import Effort, solve_line_contact
from lubfric.models.deterministic import changes_of, error_by_cells, solve_strip
from lubfric.models.shared import JoinedKey, Memo, numbers_of_fields
from lubfric.surface import Surface

SCENE = lubfric.load_scene("paper")
MAP = lubfric.generate_surface((96, 64), 0.9e-6, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=4)


def solved(speed=0.01, map_coarsening=(2, 2), scene=SCENE, surface=MAP, **more):
    return solve_strip(scene, surface, speed, map_coarsening=map_coarsening, **more)


FOUND = solved(find_slope=True)


def test_longer_cells_take_heights_where_they_are():
    thinned = MAP.heights[1::2, 1::2]
    x = (np.arange(96) - 47.5) * 0.9e-6
    on_map = np.isin(np.round(FOUND.problem.x * 1e9), np.round(x[1::2] * 1e9))
    assert on_map.sum() == 48 and FOUND.problem.spacing == (1.8e-6, 1.8e-6)
    assert FOUND.problem.heights[on_map] == pytest.approx(thinned - MAP.heights.mean(), abs=1e-15)
    with pytest.raises(lubfric.InputError, match="does not divide"):
        solved(map_coarsening=(2, 3))


def test_columns_add_up_and_deviations_are_what_a_heavier_load_does_not_explain():
    result = FOUND.result
    assert result.load_at.mean() == pytest.approx(result.load, rel=1e-3)
    assert result.friction_at.mean() == pytest.approx(result.coefficient * result.load, rel=1e-12)
    heavier = SCENE.with_(bodies={"load": 1.03 * SCENE.bodies.load})
    second = solve_strip(
        heavier,
        Surface(MAP.heights, MAP.spacing, periodic_axes=(True, True)),
        0.01,
        map_coarsening=(2, 2),
        tolerance=1e-6,
    ).result
    rise = (second.coefficient * second.load - result.coefficient * result.load) / (second.load - result.load)
    assert FOUND.slope == pytest.approx(rise, rel=0.1)
    deviations = (result.friction_at - FOUND.slope * result.load_at) / result.load
    assert FOUND.deviations == pytest.approx(deviations - deviations.mean(), abs=1e-12)


@pytest.mark.parametrize(
    "lubricant, closeness",
    [({}, 2e-3), ({"inlet_length": 5e-5}, 4e-3), ({"inlet_film": 1.5e-7}, 5e-3), ({"eyring_stress": 2e7}, 5e-3)]
    + [({"carreau": (2e7, 0.7)}, 5e-3)],
)
def test_a_smooth_strip_has_the_smooth_film(lubricant, closeness):
    """Flooded, starved by either key, and thinned by shear (where the pressure flow is slow beside the sliding)."""
    scene = SCENE.with_(bodies={"load": 200.0}, lubricant=lubricant, motion={"entrainment_speed": 0.3})
    smooth = Surface(np.zeros((90, 4)), (1.2e-6, 1.2e-6))
    strip = solved(0.3, (1, 1), scene, smooth, tolerance=1e-6).result
    film = solve_line_contact(scene.line_contact(0.3), Effort(1e-3))
    assert strip.flow_film == pytest.approx(film.flow_film, rel=closeness)
    assert strip.min_gap == pytest.approx(film.min_film, rel=closeness)
    assert strip.central_gap == pytest.approx(film.central_film, rel=closeness)


def test_a_start_saves_work_and_changes_nothing_but_what_the_tolerance_allows():
    assert solved(find_slope=True).result.coefficient == FOUND.result.coefficient
    faster = solved(0.015)
    again = solved(start=faster)
    finer = solved(map_coarsening=(1, 1), start=FOUND)
    cold = solved(map_coarsening=(1, 1))
    for warm, other in ((again, FOUND), (finer, cold)):
        assert warm.result.coefficient == pytest.approx(other.result.coefficient, rel=2e-3)
        assert 0 < warm.work < other.work


def test_a_strip_repeated_is_the_same_strip_and_a_shift_moves_its_columns():
    once, twice, moved = (
        solved(surface=replace(MAP, heights=heights, mask=None), tolerance=1e-4).result
        for heights in (MAP.heights, np.tile(MAP.heights, (1, 2)), np.roll(MAP.heights, 6, axis=1))
    )
    assert twice.coefficient == pytest.approx(once.coefficient, rel=1e-3)
    assert twice.friction_at[:32] == pytest.approx(once.friction_at, rel=2e-2)
    assert np.roll(once.friction_at, 3) == pytest.approx(moved.friction_at, rel=2e-2)


def test_the_estimate_tells_what_half_of_the_cells_change():
    """On three maps: no error is far above the estimate, whatever the mean change happens to be."""
    ratios = []
    for seed in range(3):
        kind = {"sq": 1e-7, "correlation_length": 8e-6, "acf": "gaussian"}
        fine = lubfric.generate_surface((192, 256), 0.45e-6, **kind, seed=seed)
        strips = [solved(0.02, (n, n), surface=fine) for n in (8, 4, 2)]
        stated = error_by_cells(changes_of(strips[:2]))
        ratios.append(abs(strips[2].result.coefficient / strips[1].result.coefficient - 1) / stated)
    assert max(ratios) < 2 and sum(ratio < 1 for ratio in ratios) >= 2
    cases = (0.5, 3, 0.015), (0.3, 2, 0.003 * 0.96), (0.7, 1, 0.0098), (1.5, 1, 0.03)
    for ratio, left, stated in cases:  # a series that ends
        assert error_by_cells((0.01, 0.01 * ratio), left) == pytest.approx(stated)


def test_problems_of_the_same_bodies_share_their_dry_contacts(monkeypatch):
    """A second speed on the same cells solves no dry contact again, with the same film to the bit; another load,
    hardness or elasticity is not taken for the same contact."""
    solve_contact = lubfric.models.deterministic.solve.solve_contact
    calls = []

    def counted(*arguments, **options):
        calls.append(options["mean_pressure"])
        return solve_contact(*arguments, **options)

    monkeypatch.setattr(lubfric.models.deterministic.solve, "solve_contact", counted)
    coarse = {"map_coarsening": (4, 4), "ends": (5e-5, 4e-5)}
    memo = Memo()
    solved(**coarse, memo=memo)
    assert len(calls) == 1
    shared = solved(speed=0.012, **coarse, memo=memo)
    assert len(calls) == 1
    alone = solved(speed=0.012, **coarse)
    assert len(calls) == 2
    assert np.array_equal(shared.result.pressure, alone.result.pressure)
    for change in ({"load": 1.2 * SCENE.bodies.load}, {"hardness": 2e9}, {"e_prime": 1.1 * SCENE.bodies.e_prime}):
        scene = SCENE.with_(bodies=change)
        known = len(calls)
        with_memo = solved(scene=scene, **coarse, memo=memo)
        assert len(calls) == known + 1
        assert np.array_equal(with_memo.result.pressure, solved(scene=scene, **coarse).result.pressure)


def test_what_is_remembered_is_not_pickled():
    memo = Memo()
    shared = solved(map_coarsening=(4, 4), memo=memo)
    before = len(pickle.dumps(shared))
    memo.put(JoinedKey((1, 1), 1), np.zeros(10_000), 10_000)
    assert len(pickle.dumps(shared)) == before


def test_what_is_remembered_counts_all_its_fields(monkeypatch):
    """Three fields of a contact: where there is room for those of two contacts beside the last one, a fourth takes the
    place of the first."""
    cells = 50
    monkeypatch.setattr(lubfric.models.shared.memo, "MOST_MEMO_CELLS", 6 * cells + 2)
    memo = Memo()
    contact = SimpleNamespace(**dict.fromkeys(("pressure", "gap", "displacement"), np.zeros(cells)))
    for number in range(4):
        memo.get(JoinedKey((1, 1), number), lambda: contact, numbers_of_fields)
    made = []
    for number in (3, 2, 1, 0):
        memo.get(JoinedKey((1, 1), number), lambda number=number: made.append(number))
    assert made == [0]
