"""The answer by levels: Eq. (8) on a long line, its difference from the deterministic model on a few strips, finer
cells on fewer. Oracles: strips of other seeds solved one by one, sums of forces, Student's t by scipy.stats, and a
Monte Carlo of the sum over levels on numbers of known scatter."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import scipy.stats

import lubfric
from lubfric.estimate import solve_to_tolerance
from lubfric.models import DeterministicModel, PaperModel
from lubfric.models.deterministic import (
    StripOnTwoGrids,
    change_by_flow,
    ladder,
    levels,
    moving_point_work,
    pieces,
    sample_coarsening_of,
    solve_strip,
    surface_and_map_coarsening,
)
from lubfric.models.deterministic import shorter_cells as shorter
from lubfric.models.deterministic.answer import shorter_cells_in_motion
from lubfric.models.deterministic.strip_on_two_grids import solve_pair
from lubfric.models.load_sharing import solve_balance
from lubfric.models.load_sharing.differences_of_strips import control_variate_of
from lubfric.models.shared import ControlVariate, StandardError, contact_on_strip

FINE = lubfric.load_scene("paper").with_(numerics={"film_deflection": "scaled"})
SCENE = FINE.with_(  # its cells are those of the second level; the limit of the oil is given, so that its range does not count
    contact={"shape": (40, 40), "spacing": 3.6e-6}, lubricant={"limiting_stress_coefficient": "f_b"}
)
PATCH = FINE.with_(contact={"shape": (40, 32), "spacing": 2.4e-6}, numerics={"sampling": "patch"})
ROLLING = {"slide_roll_ratio": 0.3}


@pytest.fixture(scope="module")
def prepared():
    return lubfric.prepare(SCENE)


@pytest.fixture(scope="module")
def found(prepared):
    return lubfric.friction(prepared, 0.01)


def half(result):
    return max(abs(end / result.coefficient - 1) for end in result.uncertainty.interval)


def test_parts_add_up_and_the_model_is_reported(found):
    load = SCENE.bodies.load
    assert found.decision.model == "deterministic" and "solved together with the contact" in found.decision.text
    assert found.boundary_force + found.shear_force == pytest.approx(found.coefficient * load, rel=1e-9)
    assert found.couette_force + found.rolling_force == pytest.approx(found.shear_force, rel=1e-9)
    assert found.contact_load + found.film_load == pytest.approx(load, rel=1e-9)
    assert 0 < found.contact_load < load and 1e-8 < found.mean_gap < 1e-6
    assert found.errors.contact_load > 0  # known from three strips; heat is found on one
    assert math.isnan(found.errors.inlet_film_factor) and found.errors.reasons["inlet_film_factor"]


def test_f_is_that_of_other_strips_one_by_one(prepared, found):
    """Eight strips of another seed, each by itself on the same cells."""
    strips = lubfric.prepare(SCENE.with_(surface={"seed": 77})).sample
    f = [solve_strip(SCENE, strips.strip(k), 0.01).result.coefficient for k in range(8)]
    error = np.std(f, ddof=1) / math.sqrt(8) / np.mean(f)
    assert abs(found.coefficient / np.mean(f) - 1) < math.hypot(half(found), 2 * error)


def test_a_map_whose_strips_are_all_solved_has_a_sampling_error_and_none_of_the_difference(tmp_path):
    """Eq. (8) says nothing of strips that are solved anyway, so what they scatter is chance. Oracle: their f one by
    one."""
    np.save(
        tmp_path / "map.npy",
        lubfric.generate_surface((100, 100), 3.6e-6, sq=2.4e-7, correlation_length=1.6e-5, seed=5).heights,
    )
    rough = {"file": str(tmp_path / "map.npy"), "spacing": 3.6e-6, "unit": "m", "motion_axis": "x"}
    scene = SCENE.with_(surface=rough, contact={"shape": None, "spacing": None})
    result = lubfric.friction(scene, 0.05)
    sample = lubfric.prepare(scene).sample
    f = [solve_strip(scene, sample.strip(k), 0.05).result.coefficient for k in range(sample.available_strips)]
    assert f"of a line of {len(f)}" in result.decision.text and f"on {len(f)} strips" in result.decision.text
    scatter = np.std(f, ddof=1) / math.sqrt(len(f)) / np.mean(f)
    assert result.uncertainty.sampling == pytest.approx(scatter, rel=0.5)
    assert result.uncertainty.model < 0.1 * result.uncertainty.sampling


@pytest.mark.slow
def test_the_effect_of_shorter_cells_is_that_on_other_strips():
    """Three strips of other seeds on cells of 3.6 and 1.8 µm at .1 m/s, beside what pieces of the scene add."""
    result = solve_to_tolerance(prepared := lubfric.prepare(FINE), 0.1, DeterministicModel()).levels
    alone = np.mean([pair.resolved.result.coefficient for pair in result.pairs])
    changes = []
    for k in range(3):
        surface = lubfric.prepare(FINE.with_(surface={"seed": 90 + k})).sample.strip(0)
        coarse, own = (solve_strip(FINE, surface, 0.1, map_coarsening=n).result.coefficient for n in ((2, 2), (1, 1)))
        changes.append(own / coarse - 1)
    shift = result.numbers["coefficient"] / alone - 1
    assert len(result.pieces) >= 1 and prepared.sample.cells.coarsening == (4, 4)
    assert shift == pytest.approx(np.mean(changes), abs=2 * np.std(changes, ddof=1) + 2 * result.sampling_error.value)
    assert result.numerical < FINE.numerics.tolerance


def test_cells_are_shortened_twice_where_once_leaves_too_much(monkeypatch):
    """f = .05 (1 + (dx/18 µm)^p) on every strip and piece, on cells from 7.2 to 0.9 µm; the scene's own are .45 µm."""
    prepared = lubfric.prepare(FINE)
    solved = solve_strip(FINE, prepared.sample.strip(0), 0.1, map_coarsening=(4, 4))
    pair = StripOnTwoGrids.on_one_grid(solved)
    for order, most in ((3.0, 0.01), (1.0, 0.06), (0.5, 0.13)):

        def on(dx, order=order):
            f = 0.05 * (1 + (dx / 18) ** order)
            return replace(solved, result=replace(solved.result, coefficient=f, spacing=(1e-6 * dx,) * 2))

        def refined(*_, times=2, **length):
            assert times == 2 or length["length"] < 42
            return pieces.Piece(on(7.2 / 2**k) for k in range(2 + round(math.log2(times))))

        def solver(*_, on=on):
            return lambda coarsening, start: on(0.45 * coarsening[0])

        monkeypatch.setattr(levels, "solve_pair", lambda *_, **__: replace(pair, resolved=on(3.6), longer=on(7.2)))
        monkeypatch.setattr(pieces, "_refined", refined)
        monkeypatch.setattr(shorter, "_solver_of_short_piece", solver)
        result = solve_to_tolerance(lubfric.prepare(FINE, like=prepared), 0.1, DeterministicModel()).levels
        truth = on(0.45).result.coefficient
        assert bool(result.shortest) == (order < 2)
        assert (len(result.shortest) > 4) == (order < 1)  # the short piece goes on to shorter cells where f needs them
        assert abs(result.numbers["coefficient"] / truth - 1) <= 1.1 * result.numerical <= 1.1 * most
    spent = sum(strip.work for piece in result.pieces for strip in piece) + sum(p.resolved.work for p in result.pairs)
    monkeypatch.setattr(ladder, "FINER_WORK", 1.0)
    monkeypatch.setattr(ladder, "STEPS_ON_FINER_CELLS", solved.result.report.iterations)
    monkeypatch.setattr(shorter, "MOST_WORK_OF_POINT", spent + 5.5 * solved.work)  # .64 and 1 of 3 + 4 solves
    for rows in (100, 25):  # a piece of 22 correlation lengths; of 6, which is no longer than the last one
        solved = replace(
            pair.resolved,
            result=replace(
                pair.resolved.result,
                load_at=pair.resolved.result.load_at[:rows],
                friction_at=pair.resolved.result.friction_at[:rows],
            ),
        )
        result = solve_to_tolerance(lubfric.prepare(FINE, like=prepared), 0.1, DeterministicModel()).levels
        assert bool(result.shortest) == (rows == 100)
    solved = pair.resolved
    monkeypatch.setattr(levels, "solve_pair", lambda *_, **__: replace(pair, resolved=on(3.6), longer=on(3.6)))
    for acf in ("gaussian", "exponential"):  # no change between cells is believed only where heights are smooth
        result = solve_to_tolerance(lubfric.prepare(FINE.with_(surface={"acf": acf})), 0.1, DeterministicModel()).levels
        assert bool(result.pieces) == (acf == "exponential")


def test_where_shorter_cells_lower_f_no_part_of_it_changes_its_sign(monkeypatch):
    """Where asperities carry the load, f of pieces falls by .6 % on cells of half the length and their loads do not;
    where the film does, its force has all of it."""
    prepared = lubfric.prepare(FINE)
    load = FINE.bodies.load
    f_b = FINE.bodies.boundary_friction_coefficient
    for speed, is_separated in ((3e-4, False), (0.3, True)):
        solved = solve_strip(FINE, prepared.sample.strip(0), speed, map_coarsening=(4, 4))
        f = solved.result.coefficient

        def on(dx, solved=solved, f=f):
            changed = f * (1 + (dx**2 - 3.6**2) / 40**2)
            return replace(solved, result=replace(solved.result, coefficient=changed, spacing=(1e-6 * dx,) * 2))

        pair = StripOnTwoGrids(resolved=solved, longer=on(7.2))
        monkeypatch.setattr(levels, "solve_pair", lambda *_, pair=pair, **__: pair)
        piece = pieces.Piece([on(7.2), on(3.6), on(1.8)])
        monkeypatch.setattr(pieces, "_refined", lambda *_, piece=piece, **__: piece)
        result = solve_to_tolerance(lubfric.prepare(FINE, like=prepared), speed, DeterministicModel()).levels
        numbers = result.numbers
        assert result.pieces and numbers["coefficient"] == pytest.approx(on(1.8).result.coefficient, rel=1e-9)
        parts = numbers["boundary_force"] + numbers["couette_force"] + numbers["rolling_force"]
        assert parts == pytest.approx(load * numbers["coefficient"], rel=1e-12)
        assert numbers["boundary_force"] == pytest.approx(f_b * numbers["contact_load"], rel=1e-12)
        assert numbers["contact_load"] + numbers["film_load"] == pytest.approx(load, rel=1e-12)
        assert numbers["couette_force"] > 0
        division = solved.result.rolling / solved.result.couette
        rolling = division * numbers["couette_force"] if is_separated else solved.result.rolling * FINE.bodies.width
        assert numbers["rolling_force"] == pytest.approx(rolling, rel=1e-9)
        assert (numbers["contact_load"] < 0.1 * load) == is_separated


def test_processes_change_no_bit(prepared, found):
    """Strips, and ends of input ranges, are solved by two processes as by one."""
    assert found.decision.strips > 2
    both = lubfric.friction(prepared, 0.01, workers=2)
    oil = {"eyring_stress": [5e6, 2e6, 1e7], "limiting_stress_coefficient": None}
    ranged = SCENE.with_(lubricant=oil, numerics={"model_tolerance": 0.3})
    one, two = (lubfric.friction(ranged, 0.01, workers=workers) for workers in (1, 2))
    for here, there in ((found, both), (one, two)):
        assert here.uncertainty.interval == there.uncertainty.interval
        assert all(getattr(here, name) == getattr(there, name) for name in ("coefficient", "contact_load", "mean_gap"))
    assert one.uncertainty.inputs > 0
    with pytest.raises(lubfric.InputError, match="workers"):
        lubfric.friction(prepared, 0.01, workers=0)


def test_eq_8_alone_states_its_error(prepared, found):
    shared = lubfric.friction(prepared, 0.01, model="paper")
    assert shared.decision.model == "paper"
    assert shared.uncertainty.model > abs(shared.coefficient / found.coefficient - 1) > 0.02
    assert half(shared) > shared.uncertainty.model * 0.999


def test_a_thick_film_needs_no_strips(prepared):
    thick = lubfric.friction(prepared, 0.6)
    assert thick.decision.model == "paper" and "less than the tolerance" in thick.decision.text
    assert 0 < thick.uncertainty.model < SCENE.numerics.model_tolerance
    assert thick.coefficient == lubfric.friction(prepared, 0.6, model="paper").coefficient


def test_without_entrainment_f_is_f_b(prepared):
    rest = lubfric.friction(prepared, 0.0)
    assert rest.coefficient == pytest.approx(0.09) and rest.uncertainty.model == 0.0


def test_rolling_roughness_moves_or_gets_load_sharing_and_the_reason(monkeypatch):
    """By the deterministic model where that is cheap; else by calibrated load sharing, which says what the other takes,
    and an error that holds."""
    small = SCENE.with_(motion=ROLLING, contact={"shape": (24, 12), "spacing": 90e-6 / 24})
    small = small.with_(numerics={"sampling": "patch", "tolerance": 0.05})
    moved, shared = (lubfric.friction(small, 0.01, model=model) for model in ("auto", "paper"))
    assert moved.decision.model == "deterministic" and "the roughness moves at 0.0085 m/s" in moved.decision.text
    assert abs(shared.coefficient / moved.coefficient - 1) < shared.uncertainty.model < 1.5
    monkeypatch.setattr("lubfric.models.deterministic.estimated_work.MOST_WORK_OF_POINT", 0.1)
    costly = lubfric.friction(small, 0.01)
    assert costly.decision.model == "quick"
    assert "s of counted work, more than 0.1 s" in costly.decision.text
    assert abs(moved.coefficient / costly.coefficient - 1) < costly.uncertainty.model < 1.5


@pytest.mark.parametrize(
    "work, advice",
    [
        (0.5, "numerics.grid = 'given' for shorter cells (some {} times the work of a strip)"),
        (10.0, "numerics.grid = 'given' and numerics.model = 'deterministic' for shorter cells"),
        (1e4, "accept the numerical error by a larger numerics.tolerance: a strip on the cells of this map"),
    ],
)
def test_advice_to_take_shorter_cells_says_what_they_take(work, advice):
    """Twice as many cells along x need twice as many steps, too: four times the work, and twice that for those along
    y."""
    prepared = lubfric.prepare(FINE.with_(motion=ROLLING))
    (fx, fy) = surface_and_map_coarsening(prepared, 0)[1]
    (cx, cy) = prepared.sample.cells.coarsening
    pair = SimpleNamespace(resolved=SimpleNamespace(work=work), has_halved_cells=False)
    times = (fx * cx) ** 2 * fy * cy
    assert times > 1 and advice.format(f"{float(f'{times:.2g}'):g}") in shorter_cells_in_motion(prepared, pair)


def test_advice_on_cells_that_are_those_of_the_map_along_x_gives_their_length():
    """Twice as many along y alone would leave the error of those along x, and the advice with it."""
    prepared = lubfric.prepare(SCENE.with_(motion=ROLLING))
    assert prepared.sample.cells.coarsening[0] * surface_and_map_coarsening(prepared, 0)[1][0] == 1
    pair = SimpleNamespace(resolved=SimpleNamespace(work=1.0), has_halved_cells=False)
    said = shorter_cells_in_motion(prepared, pair)
    assert said == "give a contact.spacing along x of at most 1.8 µm and numerics.grid = 'given' for shorter cells"


def test_a_given_grid_ends_at_the_cells_of_the_scene_and_the_advice_beyond_them_helps():
    """Strips on cells twice as long take the effect of the scene's own from pieces, whatever the tolerance; what is
    said where these are too long lowers the error."""
    numerics = {"model": "deterministic", "sampling_tolerance": 0.2}
    scene = lubfric.load_scene("paper").with_(contact={"spacing": 2e-6}, numerics=numerics)
    for grid, tolerance, expected_pieces in (("auto", 0.2, 0), ("given", 0.2, 1), ("auto", 0.01, 1)):
        there = lubfric.prepare(scene.with_(numerics={"grid": grid, "tolerance": tolerance}))
        result = solve_to_tolerance(there, 0.03, DeterministicModel()).levels
        assert len(result.pieces) == expected_pieces
        assert all(piece.on_shortest_cells.result.spacing == pytest.approx((2e-6, 2e-6)) for piece in result.pieces)
    point = lubfric.friction(scene, 0.03)
    (note,) = (each for each in point.validity if each.what == "estimated numerical error of f")
    assert note.recommendation == "give a contact.spacing of at most 1 µm"
    helped = lubfric.friction(scene.with_(contact={"spacing": 1e-6}), 0.03)
    assert helped.uncertainty.numerical < 0.5 * point.uncertainty.numerical


def test_where_roughness_moves_cells_along_the_motion_are_a_quarter_of_a_correlation_length():
    """On twice as long ones, the waves that the film carries die away: f was 34 % lower at film/Sq 1."""
    for motion, most in ((ROLLING, 0.25), ({}, 0.5)):
        prepared = lubfric.prepare(FINE.with_(motion=motion))
        strips = prepared.sample
        map_coarsening = surface_and_map_coarsening(prepared, 0)[1]
        along, across = (
            f * cell / one for f, cell, one in zip(map_coarsening, strips.cells.spacing, strips.correlation_lengths)
        )
        assert most / 2 < along <= most and 0.25 < across <= 0.5


def test_cells_along_y_are_twice_as_long_where_the_rows_of_a_strip_allow_it():
    """The nominal length of a strip may be an odd number of cells; the rows of which it is made are what counts."""
    for scene in (FINE, FINE.with_(contact={"spacing": 0.48e-6}), FINE.with_(contact={"spacing": 0.53e-6}), PATCH):
        strips = lubfric.prepare(scene).sample
        assert strips.rows == strips.strip(0).shape[1]
        assert not strips.represents_more or sample_coarsening_of(scene, strips)[1] == 2
    odd = lubfric.prepare(PATCH.with_(contact={"shape": (40, 33)})).sample
    assert odd.rows == odd.strip(0).shape[1] == 33 and sample_coarsening_of(PATCH, odd)[1] == 1


def test_a_tighter_tolerance_takes_more_strips(prepared, found):
    scene = SCENE.with_(numerics={"model_tolerance": 0.1, "sampling_tolerance": 0.1})
    loose = lubfric.friction(lubfric.prepare(scene, like=prepared), 0.01)
    assert found.decision.strips > loose.decision.strips and half(found) < half(loose)
    assert abs(found.coefficient / loose.coefficient - 1) < half(loose) + half(found)


def test_half_and_twice_a_boundary_film_that_is_not_given_are_a_part_of_the_budget_beside_the_model():
    scene = PATCH.with_(lubricant={"limiting_stress_coefficient": 0.045}, numerics={"tolerance": 0.05})
    films = (None, 20e-9, 10e-9, 40e-9)
    open_, given, *others = (lubfric.friction(scene.with_(bodies={"boundary_film": one}), 0.01) for one in films)
    assert open_.coefficient == pytest.approx(given.coefficient, rel=1e-12)
    changes = [other.coefficient / open_.coefficient - 1 for other in others]
    by_flow = given.uncertainty.model
    assert open_.uncertainty.model == pytest.approx(by_flow, rel=1e-9) and min(map(abs, changes)) > 0.01
    sides = -min(changes), max(changes)
    assert open_.uncertainty.not_given_sides == pytest.approx(sides, rel=0.05)
    assert open_.uncertainty.not_given == max(open_.uncertainty.not_given_sides)
    assert given.uncertainty.not_given == 0 and "not given" not in given.uncertainty.text
    assert "bodies.boundary_film not given" in open_.uncertainty.text
    assert 1e-4 < by_flow < 0.1 and "half the thinning" in given.decision.text
    newtonian = PATCH.with_(bodies={"boundary_film": 20e-9}, numerics={"tolerance": 0.05})
    assert lubfric.friction(newtonian, 0.01).uncertainty.model == 0.0


def test_the_interval_is_the_root_of_the_squares_of_its_parts_on_each_side(found):
    known = found.uncertainty
    of_sample = scipy.stats.t.ppf(0.975, known.freedom) * known.sampling
    sides = [math.hypot(known.numerical, of_sample, *pair) for pair in zip(known.model_sides, known.not_given_sides)]
    assert known.not_given > 1e-3 and known.sampling > 0
    assert 1 - known.interval[0] / found.coefficient == pytest.approx(sides[0], rel=1e-9)
    assert known.interval[1] / found.coefficient - 1 == pytest.approx(sides[1], rel=1e-9) and sides[1] < 0.1


def test_the_flow_of_a_limit_twice_as_high_by_hand():
    """The pressure and gap of an oil with twice the limit, sheared by the oil itself at the middle of the grid."""
    scene = PATCH.with_(lubricant={"limiting_stress_coefficient": 0.045}, bodies={"boundary_film": 20e-9})
    prepared = lubfric.prepare(scene)
    pair = solve_pair(prepared, 0.03, 0, find_slope=True)
    twice = {"limiting_stress_coefficient": 0.09, "limiting_stress_offset": 2 * scene.lubricant.limiting_stress_offset}
    surface, map_coarsening = surface_and_map_coarsening(prepared, 0)
    other = solve_strip(scene.with_(lubricant=twice), surface, 0.03, map_coarsening=map_coarsening).result
    dx = other.spacing[0]
    ny = other.pressure.shape[1]
    rate = 2 * 0.03 / other.gap
    law = lubfric.oil.shear_stress(scene.lubricant, other.pressure, rate)
    stress = np.where(other.gap < 20e-9, 0.09 * other.pressure, np.where(other.wet, law, 0.0))
    of_twice = lubfric.oil.shear_stress(scene.with_(lubricant=twice).lubricant, other.pressure, rate)
    before = np.where(other.gap < 20e-9, 0.09 * other.pressure, np.where(other.wet, of_twice, 0.0))
    f = other.coefficient + (stress - before).sum() * dx / ny / other.load
    assert change_by_flow(pair.resolved, scene.with_(lubricant=twice).lubricant) == pytest.approx(
        f / pair.resolved.result.coefficient - 1, abs=2e-3
    )
    assert change_by_flow(pair.resolved, scene.lubricant) == 0.0


def test_a_patch_has_one_answer_by_whatever_name_and_goes_to_its_own_cells():
    """By default, by name, and solved by hand on the map's own cells."""
    fine = PATCH.with_(contact={"shape": (80, 64), "spacing": 1.2e-6})
    patch = fine.with_(numerics={"tolerance": 1e-4})
    auto = lubfric.friction(patch, 0.01)
    named = lubfric.friction(patch, 0.01, model="deterministic")
    surface = lubfric.prepare(patch).surface
    own = solve_strip(patch, surface, 0.01).result
    assert auto.coefficient == named.coefficient == pytest.approx(own.coefficient, rel=3e-3)
    assert named.deterministic.pressure.shape == own.pressure.shape
    loose = lubfric.friction(fine.with_(numerics={"tolerance": 0.2}), 0.01)
    assert loose.deterministic.pressure.shape[1] < own.pressure.shape[1]


def test_a_patch_divides_load_and_friction_as_its_shortest_cells_do():
    """Solved by hand on the map's own cells, where asperities carry nearly all: on longer ones the rolling part is
    another, and what it leaves of f to the sliding film may be of the other sign."""
    patch = PATCH.with_(contact={"shape": (80, 64), "spacing": 1.2e-6}, numerics={"tolerance": 1e-4})
    for speed in (3e-4, 0.003):
        point = lubfric.friction(patch, speed, model="deterministic")
        own = solve_strip(patch, lubfric.prepare(patch).surface, speed).result
        width = patch.bodies.width
        assert point.contact_load == pytest.approx(own.split.rubbing * width, rel=3e-3)
        assert point.boundary_force == pytest.approx(own.boundary * width, rel=3e-3)
        assert point.rolling_force == pytest.approx(own.rolling * width, rel=3e-3)


def test_a_limit_of_zero_at_ambient_pressure_is_left_to_eq_8():
    oil = {"limiting_stress_coefficient": 0.045, "limiting_stress_offset": 0.0}
    result = lubfric.friction(SCENE.with_(lubricant=oil), 0.01)
    assert result.decision.model == "paper" and "limiting_stress_offset" in result.decision.text
    with pytest.raises(lubfric.InputError, match="limiting_stress_offset"):
        lubfric.friction(SCENE.with_(lubricant=oil), 0.01, model="deterministic")


def test_strips_that_fail_are_reported(prepared, monkeypatch):
    def fails(*_, **__):
        raise lubfric.ConvergenceError(
            "no film", lubfric.errors.Report("a strip", "diverged", iterations=3, residual=1.0, tolerance=1e-3)
        )

    monkeypatch.setattr(levels, "solve_pair", fails)
    result = lubfric.friction(prepared, 0.01)
    assert result.decision.model == "quick" and "not solved" in result.decision.text
    assert result.uncertainty.model > 0.05
    with pytest.raises(lubfric.ConvergenceError):
        lubfric.friction(prepared, 0.01, model="deterministic")


def synthetic(rng, strips, places=40, between=0.0):
    """Strips of the deterministic model and their line, of the same scatter but for a small part. Places are
    independent, and strips differ by ``between`` more than places tell, alike by both models."""
    common, own = 0.1 * rng.standard_normal((2, strips, places)) * np.array([1.0, 0.3])[:, None, None]
    common += between * rng.standard_normal((strips, 1))
    pairs = []
    for resolved in 1 + common + own:
        result = type("Result", (), {"coefficient": float(resolved.mean()), "load": 1.0})()
        problem = type("Problem", (), {"spacing": (18e-6, 18e-6)})()
        strip = type("Strip", (), {"result": result, "deviations": resolved - resolved.mean(), "problem": problem})()
        pairs.append(StripOnTwoGrids.on_one_grid(strip))
    differences = common - common.mean()
    of_strips = differences.mean(axis=1)
    error = StandardError(np.std(of_strips, ddof=1) / math.sqrt(strips), strips - 1)
    control = ControlVariate(by_place=differences, numbers={"coefficient": of_strips}, sampling_error=error)
    return pairs, control


@pytest.mark.parametrize(
    ("n", "between", "windows"), [(4, 0.0, False), (12, 0.0, False), (12, 0.03, False), (4, 0.3, True)]
)
def test_standard_error_of_the_sum_by_monte_carlo(prepared, monkeypatch, n, between, windows):
    """What is stated of the sum of the first two levels is its scatter; without a line, that of the mean (by 1.3 if
    places alone tell it). Windows of a measured map may differ by more than their places tell."""
    monkeypatch.setattr(levels, "numbers_of_strip", lambda _, result: {"coefficient": result.coefficient})
    sample = replace(prepared.sample, correlation_lengths=(8e-6, 8e-6))
    monkeypatch.setattr(type(sample), "is_homogeneous", not windows)
    model = replace(prepared, sample=sample)
    rng = np.random.default_rng(5)
    sums = []
    means = []
    stated = []
    alone = []
    for _ in range(200):
        pairs, of_line = synthetic(rng, 24, between=between)
        with_line, without = (levels._estimate_at_rest(model, pairs[:n], one) for one in (of_line, None))
        sums.append(with_line.numbers["coefficient"])
        stated.append(with_line.error_of_f.value)
        means.append(without.numbers["coefficient"])
        alone.append(without.error_of_f.value)
    assert math.sqrt(np.mean(np.square(stated))) == pytest.approx(np.std(sums), rel=0.15)
    assert 0.85 < math.sqrt(np.mean(np.square(alone))) / np.std(means) < 1.35


def test_a_line_knows_how_its_strips_differ_when_each_is_balanced_alone(prepared):
    """Every strip of the line, solved by Eq. (8) as a line of its own: to first order f, the loads, the forces and the
    gap differ from those of the line as `control_variate_of` says, and over the line the differences are zero in the
    mean."""
    prepared = lubfric.prepare(SCENE.with_(numerics={"model": "paper", "sampling_tolerance": 0.004}))
    result = solve_to_tolerance(prepared, 0.005, PaperModel())
    line = control_variate_of(result)
    rows = []
    scene = prepared.scene
    assert line.count > 6 and line.deviations(1, 24).mean() == pytest.approx(0.0, abs=1e-12)
    for index in range(line.count):
        strip = contact_on_strip(prepared, prepared.sample, index)
        one = solve_balance(scene, 0.005, strip, prepared.surface.sq)
        loads = one.contact_load, one.film_load
        rows.append((one.forces.coefficient, *loads, one.contact_state.mean_gap, one.forces.boundary))
    names = "coefficient", "contact_load", "film_load", "mean_gap", "boundary_force"
    for name, alone in zip(names, np.transpose(rows)):
        stated = line.numbers[name]
        assert abs(stated.mean()) < 0.02 * np.std(stated)
        assert np.std(alone - stated) < 0.4 * np.std(alone)
    assert set(line.numbers) == {*names, "shear_force", "couette_force", "rolling_force", "rolling_resistance"}
    total = line.numbers["boundary_force"] + line.numbers["couette_force"] + line.numbers["rolling_force"]
    assert total == pytest.approx(scene.bodies.load * line.numbers["coefficient"], rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("bodies, speed", [({}, 0.01), ({"hertz_pressure": 0.6e9}, 0.1)])
def test_the_work_of_moving_roughness_is_estimated_within_a_factor_of_two(bodies, speed):
    """Counted work, of one strip and the ends of a range, before and after it is solved; not a clock."""
    patch = {"shape": (48, 16), "spacing": 90e-6 / 32}
    scene = SCENE.with_(motion=ROLLING, contact=patch, bodies=bodies, numerics={"sampling": "patch"})
    oil = {"eyring_stress": 5e6, "limiting_stress_coefficient": None}
    prepared = lubfric.prepare(scene.with_(lubricant=oil))
    estimate = moving_point_work(
        prepared.scene,
        prepared.sample,
        prepared.surface,
        speed,
        sample_coarsening=sample_coarsening_of(prepared.scene, prepared.sample),
    )
    assert 0.5 < solve_pair(prepared, speed, 0, find_slope=True).resolved.work / estimate < 2
