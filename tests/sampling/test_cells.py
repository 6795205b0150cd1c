"""Friction on coarse cells, corrected, against the map's own cells; what those hide; which cells are chosen."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.sampling.cells import CellStep, half_again, mean_error, remaining
from lubfric.sampling.missed import hidden_share
from lubfric.sampling.scatter import BlockError

PAPER = paper_scene()
PATCH = PAPER.with_(numerics={"sampling": "patch"})


def both(scene, speed=None):
    """On the cells chosen, and on the map's own."""
    return lubfric.friction(scene, speed), lubfric.friction(scene.with_(numerics={"grid": "given"}), speed)


@pytest.mark.parametrize("bodies", [{}, {"hardness": 1.5e9}, {"load": 110.0}], ids=["elastic", "hardness", "110 N"])
@pytest.mark.parametrize("acf", ["gaussian", "exponential"])
def test_a_patch_on_coarse_cells_has_the_friction_of_its_own(bodies, acf):
    law = {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.09}
    scene = PATCH.with_(bodies=bodies, surface={"acf": acf}, lubricant=law)
    coarse, own = both(scene, 0.01)
    assert min(coarse.decision.coarsening) >= 2 and own.decision.coarsening == (1, 1)
    told = coarse.uncertainty.numerical + own.uncertainty.numerical
    assert abs(coarse.coefficient / own.coefficient - 1) <= told < 0.01
    assert coarse.contact_load == pytest.approx(own.contact_load, rel=5e-3)
    assert coarse.contact_load + coarse.film_load == pytest.approx(scene.bodies.load, rel=1e-12)
    assert coarse.real_contact_area_fraction == pytest.approx(own.real_contact_area_fraction, rel=0.03)
    assert coarse.real_contact_area == pytest.approx(own.real_contact_area, rel=0.15)  # outside of A as inside it
    assert coarse.plastic_area_fraction == pytest.approx(own.plastic_area_fraction, rel=0.02)


def test_fields_of_a_patch_are_on_its_own_cells():
    shown = lubfric.friction(PATCH, 0.01, fields=True)
    assert shown.pressure.shape == PATCH.contact.shape and shown.decision.change_by_cells == 0


@pytest.fixture(scope="module")
def windows(tmp_path_factory):
    """A measured map of nine windows, which are the same on any cells."""
    path = tmp_path_factory.mktemp("map") / "map.npy"
    rough = {"sq": 1e-7, "correlation_length": 8e-6, "acf": "exponential", "seed": 4}
    np.save(path, lubfric.generate_surface((600, 400), 0.45e-6, **rough).heights)
    return PAPER.with_(
        surface={"file": str(path), "spacing": 0.45e-6},
        contact={"shape": None, "spacing": None},
        bodies={"hardness": 1.5e9},
        numerics={"sampling_tolerance": 0.3},
    )


@pytest.mark.parametrize("speed", [0.003, 0.03])
def test_windows_on_coarse_cells_have_the_friction_of_their_own(windows, speed):
    """Within what the pieces that are compared scatter by, which is part of the standard error."""
    coarse, own = both(windows, speed)
    assert coarse.decision.coarsening == (4, 4) and coarse.decision.strips == own.decision.strips > 1
    by_pieces = math.sqrt(coarse.uncertainty.sampling**2 - own.uncertainty.sampling**2)
    told = math.hypot(2.5 * by_pieces, coarse.uncertainty.numerical + own.uncertainty.numerical)
    assert abs(coarse.coefficient / own.coefficient - 1) <= told


def test_summits_that_long_cells_hide_are_found_on_shorter_ones(tmp_path):
    """Sharp summits of a measured map just below lift-off. On the cells chosen first, 8 x 2 of the map's, few cells
    touch, under pressures that no steel bears."""
    rough = {"sq": 77e-9, "correlation_length": (20e-6, 2.2e-6), "acf": "exponential", "seed": 4}
    np.save(tmp_path / "map.npy", lubfric.generate_surface((320, 240), (0.32e-6, 0.16e-6), **rough).heights)
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
    found, own = both(scene)
    assert lubfric.prepare(scene).strips.cells.factors == (8, 2) and found.decision.coarsening == (4, 1)
    assert found.coefficient == pytest.approx(own.coefficient, rel=1e-3)
    assert 0 < found.contact_load == pytest.approx(own.contact_load, rel=0.05)


SMOOTH = {  # a film thinner than a tenth of the roughness, whose contact follows the gap by a third
    "bodies": {"radius": 2.4e-3, "width": 0.01, "load": 776.0, "e_prime": 231e9, "boundary_friction_coefficient": 0.13},
    "lubricant": {"viscosity": 0.42, "pressure_viscosity_coefficient": 6.2e-9, "viscosity_law": "constant"}
    | {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.06},
    "motion": {"entrainment_speed": 1.5e-4, "slide_roll_ratio": 0.09},
    "surface": {"sq": 1e-8, "correlation_length": 5e-5, "seed": 290287043},
    "contact": {"shape": [48, 192], "spacing": 5.7e-6},
}
CLOSED = {  # pure rolling with most of the strip in contact, where the film is not a nanometre thick
    "bodies": {"radius": 5.76e-3, "width": 0.01, "load": 483.0, "e_prime": 231e9, "hardness": 1.83e9}
    | {"boundary_friction_coefficient": 0.108},
    "lubricant": {"viscosity": 0.0416603, "pressure_viscosity_coefficient": 1.2538e-8, "eyring_stress": 5e6},
    "motion": {"entrainment_speed": -2.6042e-5, "slide_roll_ratio": 0.0},
    "surface": {"sq": 3.3174e-8, "correlation_length": 5.87872e-5, "acf": "gaussian", "seed": 13236662},
    "contact": {"shape": [48, 192], "spacing": 6.9241e-6},
}


@pytest.mark.parametrize("scene", [SMOOTH, CLOSED], ids=["smooth", "closed"])
def test_where_cells_change_more_than_to_first_order_shorter_ones_are_solved(scene):
    """A correction to first order was off by 7 % of f, and by 16 % of F_C."""
    scene = lubfric.load_scene(scene | {"numerics": {"sampling": "patch", "tolerance": 0.2}})
    assert lubfric.prepare(scene).strips.cells.factors == (2, 2)
    coarse, own = both(scene)
    assert coarse.coefficient == pytest.approx(own.coefficient, rel=1e-6)
    assert coarse.contact_load == pytest.approx(own.contact_load, rel=1e-6)


def test_a_piece_of_strips_lies_on_the_columns_of_the_stack():
    strips = lubfric.prepare(PAPER).strips
    cells, piece = strips.cells, strips.piece(0)
    assert cells.factors == (4, 4) and cells.ladder() == [(4, 4), (2, 2), (1, 1)]
    coarse, fine = cells.axis(), cells.axis((1, 1))
    shared = np.isin(np.round(fine / 1e-9), np.round(coarse / 1e-9))
    np.testing.assert_allclose(fine[shared], coarse, atol=1e-15)
    thinned = cells.thinned(piece.heights, cells.factors)
    np.testing.assert_array_equal(piece.heights[shared][:, 2::4], thinned)
    assert piece.shape[1] * piece.spacing[1] == pytest.approx(42 * strips.lengths[1], rel=0.1)


def test_no_piece_of_a_map_is_compared_twice(tmp_path):
    """A map of a single window, ground along x: the same piece again would say that its scatter is none."""
    rough = {"sq": 80e-9, "correlation_length": (2.2e-6, 40e-6), "seed": 2}
    heights = lubfric.generate_surface((128, 512), 0.5e-6, **rough).heights
    np.save(tmp_path / "map.npy", heights[:40, :200])
    scene = PAPER.with_(
        bodies={"load": 20.0},
        surface={"file": str(tmp_path / "map.npy"), "spacing": 0.5e-6, "extension": "mirror"},
        contact={"shape": None, "spacing": None},
    )
    strips = lubfric.prepare(scene).strips
    pieces = {strips.piece(index).heights.tobytes() for index in range(strips.pieces)}
    assert len(pieces) == strips.pieces
    with pytest.raises(IndexError):
        strips.piece(strips.pieces)
    unsure = lubfric.friction(scene, 0.01).uncertainty
    assert np.isnan([unsure.sampling, unsure.area_needed, *unsure.interval]).all()  # not "no more is needed"
    assert "correlation lengths along y are too few" in unsure.text


def test_few_short_pieces_scatter_by_as_much_as_they_change():
    def piece(gap):
        return CellStep(gap, BlockError(np.inf, 0), 0.0, np.nan, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0)

    assert mean_error([piece(-3e-9)]) == BlockError(pytest.approx(3e-9), 1)
    assert mean_error([piece(3e-9), piece(4e-9)]) == BlockError(pytest.approx(12.5e-18**0.5 / 2**0.5), 2)
    assert mean_error([piece(1e-9), piece(2e-9), piece(3e-9)]) == BlockError(pytest.approx(1e-9 / 3**0.5), 2)


def test_what_is_still_to_come_follows_a_geometric_series():
    assert remaining([8.0, 4.0]) == pytest.approx(4.0) and remaining([8.0]) == 8.0
    assert remaining([1.0, 4.0]) == pytest.approx(12.0)  # no slower than 3/4
    assert half_again([4.0, 8.0]) == 2.0 and half_again([1.0, 16.0]) == 0.5 and half_again([-3.0]) == 1.5


def test_contact_that_cells_hide_matters_most_where_there_is_no_friction():
    """Its share of f falls as 1/f; of no friction at all it is everything. In pure rolling it is felt by the load that
    the film loses, and no more than that."""
    contact = lubfric.prepare(PAPER).contact
    rolling = PAPER.with_(motion={"slide_roll_ratio": 0.0})
    by_scene = [
        [hidden_share(scene, contact, SimpleNamespace(coefficient=f), 1e-9) for f in (0.018, 0.009, 0.0)]
        for scene in (PAPER, rolling)
    ]
    assert by_scene[0][1] == pytest.approx(2 * by_scene[0][0], rel=1e-12) and by_scene[0][2] == math.inf
    assert 0 < by_scene[1][0] == by_scene[1][1] == pytest.approx(by_scene[0][0] / 5, rel=1e-12)
