"""Friction of a long line: its interval against other lines, its response against solving again, its patches."""

import dataclasses
import math
from types import SimpleNamespace

import numpy as np
import pytest
from lubfric.sampling.grid_pair import GridStep, gap_left, mean_error
from lubfric.sampling.influence import BlockError
from lubfric.sampling.response import Response, Slopes, touched_length
from lubfric.sharing.lines_outlook import foretold

import lubfric
from lubfric import Transient
from lubfric._base import read_table
from lubfric.contact import contact_map
from lubfric.output import main
from lubfric.output.describe import describe_scene
from lubfric.sampling import line_friction, mean_of
from lubfric.sampling import line_friction as lines_solved
from lubfric.sampling.missed import hidden_share
from lubfric.sampling.sample import response_of
from lubfric.sharing import on_halved_cells, solved
from verification.hostile.soak_force import friction_force

PAPER = lubfric.load_scene("paper")


def test_intervals_cover_a_line_many_times_as_long():
    truth = lubfric.friction(PAPER.with_(surface={"seed": 900}, numerics={"sampling_tolerance": 0.002}), 0.004)
    points = [lubfric.friction(PAPER.with_(surface={"seed": s}), 0.004) for s in range(901, 917)]
    f = np.array([p.coefficient for p in points])
    sampling = np.array([p.uncertainty.sampling for p in points])
    assert f.std(ddof=1) / f.mean() == pytest.approx(math.sqrt(np.mean(sampling**2)), rel=0.5)
    covered = [p.uncertainty.interval[0] <= truth.coefficient <= p.uncertainty.interval[1] for p in points]
    assert sum(covered) >= 13
    apart = f.mean() - truth.coefficient
    assert abs(apart) <= 3 * truth.coefficient * math.hypot(truth.uncertainty.sampling, sampling.mean() / 4)


def test_the_error_asked_is_reached_and_a_longer_line_is_used():
    loose, tight = (lubfric.friction(PAPER.with_(numerics={"sampling_tolerance": s}), 0.02) for s in (0.1, 0.02))
    assert tight.uncertainty.sampling <= 0.02 < loose.uncertainty.sampling <= 0.1
    assert tight.uncertainty.length > 2 * loose.uncertainty.length
    assert "few spots" not in tight.uncertainty.text and tight.uncertainty.participation >= 10
    scatter = tight.uncertainty.sampling * math.sqrt(tight.uncertainty.length / PAPER.bodies.width)
    assert tight.uncertainty.line_scatter == pytest.approx(scatter)


def test_the_first_line_is_doubted_and_the_next_are_not():
    pilot = lubfric.friction(PAPER.with_(numerics={"sampling_tolerance": 0.1}), 0.005).uncertainty
    just, well = (
        lubfric.friction(PAPER.with_(numerics={"sampling_tolerance": times * pilot.sampling}), 0.005).uncertainty
        for times in (1.05, 1.1 * (1 + pilot.freedom**-0.5))
    )
    assert just.length >= 1.2 * pilot.length and just.sampling < pilot.sampling
    assert well.length == pilot.length and well.sampling == pilot.sampling


def test_response_foretells_what_another_gap_does():
    model, speed = lubfric.prepare(PAPER.with_(numerics={"tolerance": 1e-3, "balance_tolerance": 1e-6})), 0.003
    point = solved(model, speed, given_grid=True)
    balance = point.balance
    response = response_of(model, speed, model.contact, balance)
    rougher = dataclasses.replace(model.contact, heights=1.01 * model.contact.heights)
    film = balance.film.film_at(model.contact.x)
    change = rougher.close(film, balance.contact_load, balance.contact).mean_gap - balance.contact.mean_gap
    again = solved(dataclasses.replace(model, contact=rougher), speed, balance, given_grid=True)
    moved = again.balance.split - balance.split
    assert response.split * change == pytest.approx(moved, rel=0.03)
    f = again.balance.forces.coefficient / balance.forces.coefficient - 1
    assert response.rates["coefficient"] * moved == pytest.approx(f, rel=0.05)
    assert response.rates["contact_load"] == pytest.approx(-balance.film_load / PAPER.bodies.load, rel=1e-2)


def test_loads_add_up_and_errors_belong_together():
    point = lubfric.friction(PAPER, 0.003)
    total = PAPER.bodies.load
    assert point.contact_load + point.film_load == pytest.approx(total, rel=1e-12)
    ratio = point.film_load / point.contact_load
    assert point.errors.contact_load == pytest.approx(ratio * point.errors.film_load, rel=0.02)
    assert point.mean_gap == pytest.approx(point.balance.contact.mean_film)
    assert point.errors.coefficient == pytest.approx(
        math.hypot(point.uncertainty.sampling, point.uncertainty.numerical)
    )
    assert 0 < point.errors.real_contact_area < 0.5 and "plastic_area_fraction" in point.errors.reasons


def test_one_patch_is_what_it_was():
    scene = PAPER.with_(numerics={"sampling": "patch"})
    point = lubfric.friction(scene, 0.03)
    assert point.coefficient == lubfric.friction(lubfric.prepare(scene, contact_map(scene)), 0.03).coefficient
    assert point.balance.contact.fields.pressure.shape[1] <= 200
    assert (
        math.isnan(point.uncertainty.sampling)
        and "an interval takes 25 (numerics.sampling = 'line'" in point.uncertainty.text
    )
    assert all(math.isnan(end) for end in point.uncertainty.interval)


def test_a_given_map_is_a_sample_and_its_mirror_image_no_more_of_it():
    surface = lubfric.generate_surface((64, 512), 1.2e-6, sq=1e-7, correlation_length=8e-6, acf="gaussian", seed=4)
    half = dataclasses.replace(surface, periodic_axes=(False, False))
    scene = PAPER.with_(contact={"shape": (64, 512), "spacing": 1.2e-6})
    once = lubfric.friction(lubfric.prepare(scene, surface), 0.01).uncertainty
    twice = lubfric.friction(lubfric.prepare(scene, half.periodic(axes=(False, True))), 0.01).uncertainty
    assert 0.01 < once.sampling < 0.1 and once.length == pytest.approx(512 * 1.2e-6)
    assert twice.length == pytest.approx(once.length) and twice.sampling == pytest.approx(once.sampling, rel=0.3)


def test_contact_may_be_missed_where_the_film_just_clears_the_summits():
    near, far = (lubfric.friction(PAPER, speed) for speed in (0.15, 1.0))
    assert near.contact_load == far.contact_load == 0
    assert near.uncertainty.sampling > 100 * far.uncertainty.sampling > 0
    assert math.isnan(near.errors.contact_load) and "no contact" in near.errors.reasons["contact_load"]


def test_a_model_is_used_again_or_made_again():
    model = lubfric.prepare(PAPER)
    same = lubfric.prepare(PAPER.with_(motion={"slide_roll_ratio": 1.0}), like=model)
    assert same.surface is model.surface and same.contact.operator is model.contact.operator
    patch = lubfric.prepare(PAPER.with_(numerics={"sampling": "patch"}), like=model)
    assert patch.lines is None and patch.contact.heights.shape == PAPER.contact.shape
    back = lubfric.prepare(PAPER, like=patch)
    np.testing.assert_array_equal(back.surface.heights, model.surface.heights)


def test_the_command_tells_the_interval(tmp_path, capsys):
    arguments = ["run", "paper", "--out", str(tmp_path), "--speeds", "0.002,0.5", "--sampling-tolerance", "0.05"]
    assert main(arguments) == 0
    assert "surface" in capsys.readouterr().err
    columns = read_table(tmp_path / "stribeck.csv")
    assert np.all(columns["interval_low"] <= columns["coefficient"])
    assert np.all(columns["coefficient"] <= columns["interval_high"]) and np.all(columns["sampling_error"] <= 0.05)


def test_a_run_in_time_tells_the_error_of_its_surface():
    scene = PAPER.with_(transient=Transient(1e-3, outputs=2), motion={"entrainment_speed": 0.02})
    scene = scene.with_(numerics={"tolerance": 0.05, "sampling_tolerance": 0.2})
    steady, held = lubfric.friction(scene), lubfric.transient(scene)
    np.testing.assert_allclose(held.coefficient, steady.coefficient, rtol=0.02)
    np.testing.assert_allclose(held.sampling_error, steady.uncertainty.sampling, rtol=0.4)
    assert np.all(held.uncertainty.interval[:, 0] < held.coefficient)
    assert "standard error" in " ".join(held.report.notes)


def test_info_foretells_the_length_within_a_factor_of_four():
    model = lubfric.prepare(PAPER)
    for speed in (0.003, 0.01, 0.03):
        error, length = foretold(PAPER, model.lines, PAPER.surface.sq, speed)
        found = lubfric.friction(model, speed).uncertainty
        assert 0.25 < length / found.length < 4
        assert speed > 0.02 or 0.3 < error / found.sampling < 3
    assert "the first is 1.4 mm long" in describe_scene(PAPER)


@pytest.mark.parametrize("speed, neighbour", [(0.0068, 0.01), (0.01, 0.03)])
def test_what_the_cells_change_is_known_at_a_neighbouring_speed(speed, neighbour):
    """Pieces taken at the load of another speed: what they say differs from that of pieces taken anew by less than is
    told, and they are taken anew where that is more than f allows."""
    model = lubfric.prepare(lubfric.load_scene("paper"))
    near = line_friction(model, neighbour)[1]
    alone, after = (line_friction(model, speed, start)[1] for start in (None, near.start))
    gaps = [mean_of(found.grid, "gap", np.nan) for found in (alone, after)]
    assert abs(gaps[1] - gaps[0]) <= gap_left(after.grid) + 1e-11  # m: balances are closed to their tolerance
    assert abs(after.grid[0].area - alone.grid[0].area) <= after.grid[0].area_left
    kept = after.grid[0].contact_load == near.grid[0].contact_load
    assert kept == (neighbour < 0.03) == (after.grid[0].moved > 0)
    assert after.response.relative("coefficient", gap_left(after.grid)) <= (0.002 if kept else 1e-6)
    if kept:  # on the same line
        coefficients = [found.point.balance.forces.coefficient for found in (alone, after)]
        assert coefficients[1] == pytest.approx(coefficients[0], rel=2e-3)


def test_a_contact_that_long_cells_hide_is_solved_on_shorter_ones(tmp_path):
    """Sharp summits of a measured map just below lift-off. On the cells of the line, 16 x 4 of the map's, few cells
    touch. What these change of the gap moves the load by e^2: more than can be corrected. The map's own cells are the
    judge; and no spot carries what steel cannot."""
    heights = lubfric.generate_surface(
        (320, 240), (0.32e-6, 0.16e-6), sq=77e-9, correlation_length=(20e-6, 2.2e-6), acf="exponential", seed=4
    ).heights
    np.save(tmp_path / "map.npy", heights)
    scene = lubfric.load_scene(
        {
            "bodies": {"radius": 6e-3, "width": 8e-3, "load": 1500.0, "material": "steel"}
            | {"boundary_friction_coefficient": 0.12},
            "lubricant": {"viscosity": 0.012, "pressure_viscosity_coefficient": 1.6e-8, "eyring_stress": 5e6}
            | {"limiting_stress_coefficient": 0.06},
            "motion": {"entrainment_speed": 3.5, "slip_percent": 4},
            "surface": {"file": str(tmp_path / "map.npy"), "spacing": [0.32e-6, 0.16e-6], "extension": "mirror"},
        }
    )
    model = lubfric.prepare(scene)
    first, (chosen, found) = lines_solved._on_cells(model, 3.5, None)[1], line_friction(model, 3.5)
    assert first.too_coarse and not found.too_coarse
    while chosen.lines.cells.factors != (1, 1):
        chosen = on_halved_cells(chosen)
    judge = line_friction(chosen, 3.5)[1]
    assert judge.grid == ()  # nothing to correct

    def of(line):
        area = touched_length(line.point.balance.contact) * scene.bodies.width
        return line.point.balance.forces.coefficient, line.point.balance.contact_load, area

    (f, load, area), (f_fine, load_fine, _), (_, load_coarse, area_coarse) = of(found), of(judge), of(first)
    assert f == pytest.approx(f_fine, rel=5e-3)
    assert load == pytest.approx(load_fine, rel=0.5)
    assert load / area < 6e9 < load_coarse / area_coarse  # Pa


@pytest.mark.parametrize("tolerance", [0.01, 0.2])
def test_a_correction_for_cells_is_exact_to_first_order_only(tolerance):
    """A film thinner than a tenth of the roughness: the cells of the line, twice the scene's own, change F_C by a
    third. Beyond first order that moves f by some per cent: too much at a tolerance of 1 %, told at one of 20 %."""
    scene = lubfric.load_scene(
        {
            "bodies": {"radius": 2.4e-3, "width": 0.01, "load": 776.0, "e_prime": 231e9}
            | {"boundary_friction_coefficient": 0.13},
            "lubricant": {"viscosity": 0.42, "pressure_viscosity_coefficient": 6.2e-9, "viscosity_law": "constant"}
            | {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.06},
            "motion": {"entrainment_speed": 1.5e-4, "slide_roll_ratio": 0.09},
            "surface": {"sq": 1e-8, "correlation_length": 5e-5, "seed": 290287043},
            "contact": {"shape": [48, 48], "spacing": 5.7e-6},
            "numerics": {"tolerance": tolerance, "sampling_tolerance": 0.2},
        }
    )
    model = lubfric.prepare(scene)
    assert model.lines.cells.factors == (2, 2)
    found = lubfric.friction(model)
    own = lubfric.friction(on_halved_cells(model))
    off = abs(found.coefficient / own.coefficient - 1)
    assert off <= found.uncertainty.numerical
    assert found.line.cells.factors == ((2, 2) if tolerance == 0.2 else (1, 1))
    assert found.uncertainty.numerical < 0.4 * tolerance


def test_cells_change_the_mean_film_and_the_area_under_a_load():
    """Pure rolling with nine tenths of the strip in contact: what friction there is acts on the rest. The film rises
    steeply at the ends of the strip, where longer columns hold another mean of it. Judge: the scene's own cells."""
    scene = lubfric.load_scene(
        {
            "bodies": {"radius": 5.76e-3, "width": 0.01, "load": 483.0, "e_prime": 231e9, "hardness": 1.83e9}
            | {"boundary_friction_coefficient": 0.108},
            "lubricant": {"viscosity": 0.0416603, "pressure_viscosity_coefficient": 1.2538e-8, "eyring_stress": 5e6},
            "motion": {"entrainment_speed": -2.6042e-5, "slide_roll_ratio": 0.0},
            "surface": {"sq": 3.3174e-8, "correlation_length": 5.87872e-5, "acf": "gaussian", "seed": 13236662},
            "contact": {"shape": [48, 48], "spacing": 6.9241e-6},
            "numerics": {"tolerance": 0.01, "sampling_tolerance": 0.2},
        }
    )
    model = lubfric.prepare(scene)
    coarse, own = lubfric.friction(model), lubfric.friction(on_halved_cells(model))
    assert model.lines.cells.factors == (2, 2) and own.line.grid == ()
    assert coarse.coefficient == pytest.approx(own.coefficient, rel=0.01)
    assert coarse.contact_load == pytest.approx(own.contact_load, rel=0.01)
    assert coarse.uncertainty.sampling > 5 * abs(coarse.contact_load / own.contact_load - 1)


def test_a_heavier_line_beside_one_that_hardly_touches():
    """The first line carries 0.0002 of the load. The next one, much shorter, carries a hundred times as much, which the
    response of the first cannot foretell. Many long lines are the judge."""
    scene = lubfric.load_scene(
        {
            "bodies": {"radius": 3.846963518245387e-3, "width": 0.01, "load": 10.099738211958645, "e_prime": 231e9}
            | {"boundary_friction_coefficient": 0.1158, "hardness": 7.66e9},
            "lubricant": {"viscosity": 0.18791353974723812, "pressure_viscosity_coefficient": 9.648931557368267e-9}
            | {"density_law": "dowson-higginson", "limiting_stress_coefficient": 0.06}
            | {"limiting_stress_offset": 2e6},
            "motion": {"entrainment_speed": -0.007651616926494489, "slide_roll_ratio": 1.264692380833466},
            "surface": {"sq": 1.229592676736491e-8, "correlation_length": 3.153854461261238e-6, "seed": 178932683},
            "contact": {"shape": [28, 28], "spacing": 1.40239830633039e-6},
            "numerics": {"tolerance": 0.01, "sampling_tolerance": 0.2},
        }
    )
    found = lubfric.friction(scene)
    first = found.line.first
    assert 0 < first.contact_load < 5e-4 * scene.bodies.load and len(found.line.used) > 0
    judge = lubfric.friction(scene.with_(numerics={"sampling_tolerance": 0.03}))
    low, high = found.uncertainty.interval
    assert low < judge.coefficient < high


@pytest.mark.parametrize("odds", [0.3, 1.0, 30.0])
def test_an_error_of_the_gap_counts_as_it_moves_a_light_contact(odds):
    """F_C = F/(1 + e^s) in closed form, s moved by the error of the gap; to first order where little changes."""
    rate = -odds / (1 + odds)  # d ln F_C/ds
    response = Response(Slopes(0.0, 0.0, 0.0), 1.0, {"contact_load": rate}, odds)
    for moved in (1e-3, 0.5, 3.0):
        exact = (1 + odds) / (1 + odds * np.exp(-moved)) - 1
        assert response.relative("contact_load", moved) == pytest.approx(max(exact, -rate * moved), rel=1e-9)
    assert response.per_gap("contact_load") == -rate


def test_contact_that_cells_hide_matters_most_where_there_is_no_friction():
    """Its share of f falls as 1/f; of no friction at all it is everything."""
    model = lubfric.prepare(PAPER)
    shares = [hidden_share(model, SimpleNamespace(coefficient=f), model.surface, 1e-9) for f in (0.02, 0.01, 0.0)]
    assert shares[1] == pytest.approx(2 * shares[0], rel=1e-12) and 0 < shares[0] < shares[2] == math.inf


def test_contact_that_is_missed_rubs_only_where_the_surfaces_slide():
    """In pure rolling it is felt by the load that the film loses, and no more than that."""
    sliding, rolling = (lubfric.prepare(PAPER.with_(motion={"slide_roll_ratio": ratio})) for ratio in (-0.5, 0.0))
    friction = 0.2 * PAPER.bodies.boundary_friction_coefficient
    shares = [
        hidden_share(model, SimpleNamespace(coefficient=friction), model.surface, 1e-9) for model in (sliding, rolling)
    ]
    assert shares[0] == pytest.approx(5 * shares[1], rel=1e-12) and shares[1] > 0


def test_no_piece_of_a_map_is_compared_twice(tmp_path):
    """A map of a single window, ground along x: the same piece again would say that its scatter is none."""
    heights = lubfric.generate_surface(
        (128, 512), (0.5e-6, 0.5e-6), sq=80e-9, correlation_length=(2.2e-6, 40e-6), seed=2
    ).heights
    np.save(tmp_path / "map.npy", heights[:40, :200])
    rough = {"file": str(tmp_path / "map.npy"), "spacing": 0.5e-6, "extension": "mirror"}
    scene = lubfric.load_scene(
        {
            "bodies": {"radius": 2e-3, "width": 6e-3, "load": 20.0, "e_prime": 231e9}
            | {"boundary_friction_coefficient": 0.1},
            "lubricant": {"viscosity": 0.36, "pressure_viscosity_coefficient": 2.5e-8, "eyring_stress": 5e6},
            "motion": {"entrainment_speed": 0.01, "slide_roll_ratio": 1.0},
            "surface": rough,
        }
    )
    model = lubfric.prepare(scene)
    windows = model.lines.pieces
    pieces = {model.lines.pair(i, 1e-3).heights.tobytes() for i in range(windows)}
    grid = line_friction(model, 0.01)[1].grid
    assert len(pieces) == windows and len(grid) <= windows
    with pytest.raises(IndexError):
        model.lines.pair(windows, 1e-3)
    unsure = lubfric.friction(model, 0.01).uncertainty
    assert np.isnan([unsure.sampling, unsure.area_needed, *unsure.interval]).all()  # not "no more is needed"


def test_few_short_pieces_scatter_by_as_much_as_they_change():
    def piece(gap):
        return GridStep(gap, BlockError(np.inf, 0), 0.0, np.nan, 1.0, 0.0, 0.0, 1.0)

    assert mean_error([piece(-3e-9)]) == BlockError(pytest.approx(3e-9), 1)
    assert mean_error([piece(3e-9), piece(4e-9)]) == BlockError(pytest.approx(2.5e-9), 2)
    assert mean_error([piece(1e-9), piece(2e-9), piece(3e-9)]) == BlockError(pytest.approx(1e-9 / 3**0.5), 2)


def test_the_film_rubs_beside_the_contacts_of_all_lines():
    """Summed anew, by code of its own, with the mean share in contact at each x: not that of the first line."""
    scene = PAPER.with_(motion={"slide_roll_ratio": 0.0}, numerics={"sampling_tolerance": 0.04, "film_level": "ehl"})
    model, found = line_friction(lubfric.prepare(scene), 0.03)
    balance = found.point.balance.lubricated
    states = [found.first.contact, *(line.state for line in found.used)]
    cells = [contact.heights.shape[1] for contact in (model.contact, *(line.contact for line in found.used))]
    mean = np.average([state.contact_fraction for state in states], axis=0, weights=cells)
    shown = balance.contact.contact_fraction
    assert len(states) > 1 and np.abs(mean - states[0].contact_fraction).max() > 0.1 * mean.max()
    assert shown == pytest.approx(mean * shown.sum() / mean.sum(), rel=1e-9)
    sides = SimpleNamespace(film=balance.film, x=balance.contact.x, touching=shown)
    force = friction_force(scene, sides, balance.contact_load, 0.03)[0]
    assert balance.forces.shear.total == pytest.approx(force, rel=1e-3)
