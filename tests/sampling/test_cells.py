"""Friction on coarse cells, corrected, against the map's own cells; what those hide; which cells are chosen."""

import math

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.output import main

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
    stated = coarse.uncertainty.numerical + own.uncertainty.numerical
    assert abs(coarse.coefficient / own.coefficient - 1) <= stated < 0.01
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


@pytest.mark.parametrize("speed", [pytest.param(0.003, marks=pytest.mark.slow), 0.03])
def test_windows_on_coarse_cells_have_the_friction_of_their_own(windows, speed):
    """Within what the pieces that are compared scatter by, which is part of the standard error."""
    coarse, own = both(windows, speed)
    assert coarse.decision.coarsening == (4, 4) and coarse.decision.strips == own.decision.strips > 1
    by_pieces = math.sqrt(coarse.uncertainty.sampling**2 - own.uncertainty.sampling**2)
    stated = math.hypot(2.5 * by_pieces, coarse.uncertainty.numerical + own.uncertainty.numerical)
    assert abs(coarse.coefficient / own.coefficient - 1) <= stated


@pytest.fixture
def sharp(tmp_path):
    """Sharp summits of a measured map just below lift-off."""
    rough = {"sq": 77e-9, "correlation_length": (20e-6, 2.2e-6), "acf": "exponential", "seed": 5}
    np.save(tmp_path / "map.npy", lubfric.generate_surface((320, 240), (0.32e-6, 0.16e-6), **rough).heights)
    return lubfric.load_scene(
        {
            "bodies": {"radius": 6e-3, "width": 8e-3, "load": 1500.0, "material": "steel"}
            | {"boundary_friction_coefficient": 0.12},
            "lubricant": {"viscosity": 0.012, "pressure_viscosity_coefficient": 1.6e-8, "eyring_stress": 5e6}
            | {"limiting_stress_coefficient": 0.06},
            "motion": {"entrainment_speed": 3.6, "slip_percent": 4},
            "surface": {"file": str(tmp_path / "map.npy"), "spacing": [0.32e-6, 0.16e-6], "extension": "mirror"},
            "numerics": {"model": "paper"},
        }
    )


def test_summits_that_long_cells_hide_are_found_on_shorter_ones(sharp):
    """On the cells chosen first, 8 x 2 of the map's, few cells touch, under pressures that no steel bears."""
    result, own = both(sharp)
    assert lubfric.prepare(sharp).sample.cells.coarsening == (8, 2) and result.decision.coarsening == (4, 1)
    assert result.coefficient == pytest.approx(own.coefficient, rel=1e-3)
    assert 0 < result.contact_load == pytest.approx(own.contact_load, rel=0.05)


def test_the_fields_of_a_speed_are_those_of_its_own_cells(sharp, tmp_path, draws):
    """Kept on the cells that its contact was solved on, shorter than those of the line."""
    draws("contact.png")
    (tmp_path / "sharp.toml").write_text(sharp.to_toml())
    out = tmp_path / "out"
    assert main(["run", str(tmp_path / "sharp.toml"), "--speeds", "3.6", "--out", str(out)]) == 0
    assert (out / "contact.png").stat().st_size > 10_000
    with np.load(out / "fields.npz") as fields:
        pressure, gap, heights, x = (fields[n] for n in ("pressure_0", "gap_0", "heights_0", "x_0"))
        assert pressure.shape == gap.shape == heights.shape == (x.size, fields["y_0"].size)
        assert np.diff(x)[0] < lubfric.prepare(sharp).surface.spacing[0]
        assert np.allclose(np.diff(x), np.diff(x)[0])
        touched = pressure > 0  # summits carry: the map is that of the contact
        assert touched.any() and heights[touched].min() > np.median(heights)
        assert np.abs(gap[touched]).max() < 1e-3 * heights.std()


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
    numerics = {"model": "paper", "sampling": "patch", "tolerance": 0.2}
    scene = lubfric.load_scene(scene | {"numerics": numerics})
    assert lubfric.prepare(scene).sample.cells.coarsening == (2, 2)
    coarse, own = both(scene)
    assert coarse.coefficient == pytest.approx(own.coefficient, rel=1e-6)
    assert coarse.contact_load == pytest.approx(own.contact_load, rel=1e-6)


@pytest.mark.parametrize("speed", [0.08796, 0.08859])
def test_where_summits_graze_shorter_cells_are_not_sought(speed):
    """Their spots make less than a tenth of the tolerance of f, whatever the cells do to them: 19 s became 0.5."""
    result = lubfric.friction(PAPER, speed)
    assert result.decision.coarsening == (4, 4) and result.decision.strips < 120
    assert 0 < result.boundary_force < 1e-3 * result.coefficient * PAPER.bodies.load


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
    strips = lubfric.prepare(scene).sample
    pieces = {strips.piece(index).heights.tobytes() for index in range(strips.available_pieces)}
    assert len(pieces) == strips.available_pieces
    with pytest.raises(IndexError):
        strips.piece(strips.available_pieces)
    unsure = lubfric.friction(scene, 0.01).uncertainty
    assert np.isnan([unsure.sampling, unsure.area_needed, *unsure.interval]).all()  # not "no more is needed"
    assert "correlation lengths of the solved surface along y are too few" in unsure.text


@pytest.mark.parametrize("columns", [60, 100, 140])
def test_no_asperity_counts_twice_where_a_map_is_continued_by_its_mirror_image(tmp_path, columns):
    """The columns under the Hertz strips of all windows, numbered by the first row of the map, are of different
    places."""
    heights = lubfric.generate_surface((columns, 200), 0.5e-6, sq=80e-9, correlation_length=1.5e-6, seed=2).heights
    np.save(tmp_path / "map.npy", heights)
    scene = PAPER.with_(
        bodies={"load": 20.0},
        surface={"file": str(tmp_path / "map.npy"), "spacing": 0.5e-6, "extension": "mirror"},
        contact={"shape": None, "spacing": None},
    )
    strips = lubfric.prepare(scene).sample
    assert strips.cells.coarsening == (1, 1)
    half = math.floor(scene.bodies.half_width / 0.5e-6)
    whole = strips.surface.heights[:columns, 50]
    places = []
    for index in range(strips.available_strips):
        column = strips.strip(index).heights[:, 50]
        middle = column.size // 2
        under = column[middle - half : middle + half]
        places.append({int(k) for k in np.argmin(np.abs(np.subtract.outer(under, whole)), axis=1)})
    assert sum(len(place) for place in places) == len(set().union(*places))
