"""The interval of f: against other samples of the surface, how many strips it takes, and where there is none."""

import math
import re
from types import SimpleNamespace

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.estimate import estimated_work_of_point, solve_to_tolerance
from lubfric.models import DeterministicModel, PaperModel
from lubfric.models.load_sharing import error_of_share
from lubfric.output import describe_scene
from verification.campaigns.hostile.soak_force import friction_force

PAPER = paper_scene()
PATCH = PAPER.with_(numerics={"sampling": "patch"})
FLAT = lubfric.load_scene("flat").with_(contact={"shape": (48, 48), "spacing": 9e-6})


def seeds(scene, speed, numbers):
    """Points on as many surfaces: their f, and the standard errors that they tell."""
    points = [lubfric.friction(scene.with_(surface={"seed": seed}), speed) for seed in numbers]
    return points, np.array([p.coefficient for p in points]), np.array([p.uncertainty.sampling for p in points])


@pytest.mark.slow
def test_intervals_cover_a_line_many_times_as_long():
    truth = lubfric.friction(PAPER.with_(surface={"seed": 900}, numerics={"sampling_tolerance": 0.002}), 0.004)
    points, f, sampling = seeds(PAPER, 0.004, range(901, 909))
    assert truth.uncertainty.length > 6 * points[0].uncertainty.length
    assert f.std(ddof=1) / f.mean() == pytest.approx(math.sqrt(np.mean(sampling**2)), rel=0.5)
    covered = [p.uncertainty.interval[0] <= truth.coefficient <= p.uncertainty.interval[1] for p in points]
    assert sum(covered) >= 6
    apart = f.mean() - truth.coefficient
    assert abs(apart) <= 3 * truth.coefficient * math.hypot(truth.uncertainty.sampling, sampling.mean() / math.sqrt(8))


def test_a_place_moves_f_by_its_gap_and_by_where_it_touches():
    """Under 110 N with a limiting stress as large as the boundary friction: contact and film rub alike, so that f
    scatters by half a per cent, where the division of the load scatters by much more."""
    law = {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.09}
    scene = PAPER.with_(bodies={"load": 110.0}, lubricant=law, numerics={"film_deflection": "scaled"})
    points, f, sampling = seeds(scene, 0.03, range(1, 7))
    scatter = f.std(ddof=1) / f.mean()
    stated = math.sqrt(np.mean(sampling**2))
    assert 0.002 < stated < 0.012 and 0.5 < stated / scatter < 2
    assert points[0].errors.contact_load > 2 * stated


def test_the_requested_error_is_reached_and_more_strips_are_used():
    loose, tight = (lubfric.friction(PAPER.with_(numerics={"sampling_tolerance": s}), 0.02) for s in (0.1, 0.02))
    assert tight.uncertainty.sampling <= 0.02 < loose.uncertainty.sampling <= 0.1
    assert tight.decision.strips > loose.decision.strips == 2
    assert tight.uncertainty.length / loose.uncertainty.length == pytest.approx(tight.decision.strips / 2)
    assert "few asperity contacts" not in tight.uncertainty.text and tight.uncertainty.effective_contacts >= 10
    scatter = tight.uncertainty.sampling * math.sqrt(tight.uncertainty.length / PAPER.bodies.width)
    assert tight.uncertainty.line_scatter == pytest.approx(scatter)


def test_the_first_strips_are_doubted_and_the_next_are_not():
    pilot = lubfric.friction(PAPER.with_(numerics={"sampling_tolerance": 0.1}), 0.005).uncertainty
    just, well = (
        lubfric.friction(PAPER.with_(numerics={"sampling_tolerance": times * pilot.sampling}), 0.005).uncertainty
        for times in (1.05, 1.1 * (1 + pilot.freedom**-0.5))
    )
    assert just.length >= 1.2 * pilot.length and just.sampling < pilot.sampling
    assert well.length == pilot.length and well.sampling == pilot.sampling


def test_errors_belong_together():
    point = lubfric.friction(PAPER, 0.003)
    ratio = point.film_load / point.contact_load
    assert point.errors.contact_load == pytest.approx(ratio * point.errors.film_load, rel=0.02)
    known = point.uncertainty
    assert point.errors.coefficient == pytest.approx(math.hypot(known.sampling, known.numerical))
    assert 0 < point.errors.real_contact_area < 0.5 and "plastic_area_fraction" in point.errors.reasons
    dry = lubfric.friction(PAPER, 0.0)
    assert dry.uncertainty.sampling == dry.errors.coefficient == dry.errors.contact_load == 0
    assert 0 < dry.errors.real_contact_area < 0.2
    reasons = dry.errors.reasons
    assert math.isnan(dry.min_film) and "there is no film" in reasons["min_film"]
    assert dry.mean_gap > 0 and "there is no film" not in reasons["mean_gap"]


# Lambda ratio and asperity load ratio of the load-sharing model, and that of the deterministic model, of gear flanks that
# roll and slide, in an oil with a limiting stress of 0.05 p.
GEAR_FLANKS = [(0.05, 0.742, 0.699), (0.10, 0.709, 0.539), (0.14, 0.639, 0.585), (0.19, 0.592, 0.207)]
GEAR_FLANKS += [(0.28, 0.572, 0.100), (0.29, 0.661, 0.071), (0.37, 0.514, 0.049), (0.45, 0.443, 0.078)]
GEAR_FLANKS += [(0.56, 0.585, 0.058), (0.67, 0.515, 0.021), (0.91, 0.405, 0.029)]


@pytest.mark.parametrize(("ratio", "share", "solved"), GEAR_FLANKS)
def test_the_error_of_the_load_division_contains_that_of_solved_gear_flanks(ratio, share, solved):
    assert abs(share - solved) <= error_of_share(ratio, share, may_be_film=True) <= share
    assert error_of_share(ratio, 0.0, may_be_film=True) == error_of_share(ratio, 1.0) == 0.0


def test_loads_by_load_sharing_have_the_error_of_its_division_of_the_load():
    """Two standard errors lead to no asperity load where film at a limiting stress may carry all of it, and by 0.7
    sqrt(s (1 - s)) of the load away where the oil has no such stress."""
    law = {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.05}
    limited = lubfric.friction(PAPER.with_(lubricant=law), 0.01)
    newtonian = lubfric.friction(PAPER, 0.01)
    assert limited.film_to_roughness_ratio > 0.2
    assert 0.5 <= limited.errors.contact_load < 0.55
    share = newtonian.contact_load / PAPER.bodies.load
    half = 0.5 * 0.7 * math.sqrt(share * (1 - share))
    assert half <= newtonian.errors.contact_load * share < 1.1 * half
    for point in (limited, newtonian):
        of_asperities = point.errors.contact_load
        assert point.errors.boundary_force == pytest.approx(of_asperities, rel=0.02)
        assert point.errors.film_load * point.film_load == pytest.approx(of_asperities * point.contact_load, rel=0.02)


def test_contact_may_be_missed_where_the_film_just_clears_the_summits():
    near, far = (lubfric.friction(PAPER, speed) for speed in (0.15, 1.0))
    assert near.contact_load == far.contact_load == 0
    assert near.uncertainty.sampling > 100 * far.uncertainty.sampling > 0
    assert math.isnan(near.errors.contact_load) and "without asperity contact" in near.errors.reasons["contact_load"]


def test_the_film_rubs_beside_the_contacts_of_all_strips():
    """Its force summed anew, by code of its own, with the share in contact at each x."""
    scene = PAPER.with_(motion={"slide_roll_ratio": 0.0}, numerics={"sampling_tolerance": 0.04})
    result = lubfric.friction(scene, 0.03)
    contact = result.balance.contact_state
    sides = SimpleNamespace(film=result.balance.film, x=contact.x, touching=contact.contact_fraction)
    force = friction_force(scene, sides, result.contact_load, 0.03)[0]
    assert result.decision.strips >= 2 and result.shear_force == pytest.approx(force, rel=1e-3)


# measured and given maps


def on_map(folder, shape, **changed):
    """The paper's cylinder on a map of a file of ``shape`` cells of 0.9 um."""
    rough = {"sq": 1e-7, "correlation_length": 8e-6, "acf": "gaussian", "seed": 4}
    np.save(folder / "map.npy", lubfric.generate_surface(shape, 0.9e-6, **rough).heights)
    surface = {"file": str(folder / "map.npy"), "spacing": 0.9e-6} | changed
    return PAPER.with_(surface=surface, contact={"shape": None, "spacing": None})


def test_windows_of_a_measured_map_are_its_sample(tmp_path):
    scene = on_map(tmp_path, (900, 400))
    points = [lubfric.friction(scene.with_(numerics={"sampling_tolerance": s}), 0.01) for s in (0.1, 0.003)]
    few, all_of_it = (p.uncertainty for p in points)
    assert 3 <= points[0].decision.strips < points[1].decision.strips
    assert few.sampling > all_of_it.sampling > 0.003 and all_of_it.length > 2 * few.length
    assert few.area_needed == 1 < all_of_it.area_needed == pytest.approx((all_of_it.sampling / 0.003) ** 2)
    assert "the map is too small for the requested 0.3 %" in all_of_it.text
    low, high = few.interval
    assert low < lubfric.friction(PAPER.with_(surface={"acf": "gaussian", "seed": 8}), 0.01).coefficient < high


@pytest.mark.parametrize("model", ["deterministic", "quick"])
def test_strips_that_are_all_of_a_map_state_the_area_that_they_need(tmp_path, model):
    """The standard error falls with the root of the area: the closed form."""
    scene = on_map(tmp_path, (96, 512)).with_(numerics={"model": model, "sampling_tolerance": 0.002, "tolerance": 0.1})
    uncertainty = lubfric.friction(scene, 0.02).uncertainty
    assert uncertainty.sampling > 0.004
    assert uncertainty.area_needed == pytest.approx((uncertainty.sampling / 0.002) ** 2)
    assert "the map is too small for the requested 0.2 %" in uncertainty.text
    enough = scene.with_(numerics={"sampling_tolerance": 0.5})
    assert lubfric.friction(enough, 0.02).uncertainty.area_needed == 1


def test_the_note_on_windows_says_how_much_of_the_map_is_used_and_why(tmp_path):
    """The lengths are those of the joined map and of its windows, which have 400 cells along y each."""
    surface = lubfric.prepare(on_map(tmp_path, (900, 400))).surface
    note = next(note for note in surface.notes if "joined along y" in note)
    (count, used, measured) = re.match(r"(\d+) windows? .*; ([\d.]+) µm of their ([\d.]+) µm", note).groups()
    assert float(used) == pytest.approx(1e6 * surface.size[1], rel=1e-3)
    assert float(measured) == pytest.approx(int(count) * 400 * 0.9, rel=1e-3) and float(used) < 0.99 * float(measured)
    assert "each window passes smoothly into the next one" in note


def test_a_map_that_differs_from_place_to_place_is_less_sure(tmp_path):
    """Its left half is half as rough: the scatter between windows shows that, blocks of one window do not."""
    scene = on_map(tmp_path, (900, 400)).with_(numerics={"sampling_tolerance": 0.1})
    even = lubfric.friction(scene, 0.01)
    heights = np.load(tmp_path / "map.npy")
    heights[:450] *= 0.5
    np.save(tmp_path / "map.npy", heights)
    assert lubfric.friction(scene, 0.01).uncertainty.sampling > 3 * even.uncertainty.sampling


def test_a_given_map_is_a_sample_and_its_mirror_image_no_more_of_it():
    scene = PAPER.with_(contact={"shape": (64, 512), "spacing": 1.2e-6})
    rough = lubfric.generate_surface((64, 512), 1.2e-6, sq=1e-7, correlation_length=8e-6, acf="gaussian", seed=4)
    half = lubfric.Surface(rough.heights, rough.spacing, periodic_axes=(False, False))
    once, twice = (
        lubfric.friction(lubfric.prepare(scene, surface), 0.01).uncertainty
        for surface in (rough, half.periodic(axes=(False, True)))
    )
    assert 0.01 < once.sampling < 0.1 and once.length == pytest.approx(512 * 1.2e-6)
    assert twice.length == pytest.approx(once.length) and twice.sampling == pytest.approx(once.sampling, rel=0.3)


# where there is none


def test_one_patch_is_too_short_for_an_interval():
    known = lubfric.friction(PATCH, 0.03).uncertainty
    assert math.isnan(known.sampling) and all(math.isnan(end) for end in known.interval)
    low, high = known.interval_without_sampling  # by hand: what is known, on each side for itself
    f = known.coefficient
    towards, away = (math.hypot(known.numerical, known.model_sides[k], known.not_given) for k in (0, 1))
    assert (low, high) == pytest.approx((f * (1 - towards), f * (1 + away)), rel=1e-9)
    assert f"interval of f not known (without the sampling error {known.without_sampling_in_words})" in known.text
    assert known.without_sampling_in_words.startswith(f"{low:.2g}")
    assert (
        "correlation lengths of the solved surface along y are too few for an interval" in known.text
        and known.numerical > 0
    )
    cleared = lubfric.friction(PATCH.with_(contact={"shape": (200, 80)}), 0.08).uncertainty
    assert (
        "too short along y to estimate the undetected contact; give a contact.shape or a map that is longer along y"
        in cleared.text
    )


@pytest.mark.parametrize("scene", [PATCH.with_(contact={"model": "summits"}), FLAT], ids=["summits", "flat"])
def test_contacts_without_places_along_y_say_so(scene):
    known = lubfric.friction(scene, 0.02).uncertainty
    assert "no cells along y to compare" in known.text
    assert math.isnan(known.sampling) and all(math.isnan(end) for end in known.interval)


# what is told of it


def test_an_estimate_is_right_to_a_factor_of_four():
    """And it knows from where on the film is so thick that load sharing is enough, near pure rolling later."""
    prepared = lubfric.prepare(PAPER)
    for speed in (0.003, 0.01, 0.03):
        stated = estimated_work_of_point(PAPER, prepared.sample, prepared.surface, speed)
        result = lubfric.friction(prepared, speed).uncertainty
        assert 0.25 < stated.length / result.length < 4
        assert speed > 0.02 or 0.25 < stated.error / result.sampling < 4
    assert " 1.4 " in describe_scene(PAPER)  # mm
    for ratio, speed in ((0.02, 0.3), (0.02, 0.7), (1.0, 0.3), (1.0, 0.5), (2.0, 0.15), (2.0, 0.2)):
        scene = PAPER.with_(motion={"slide_roll_ratio": ratio}, numerics={"model": "auto"})
        error = lubfric.friction(scene, speed, model="paper").uncertainty.model
        assert (estimated_work_of_point(scene, prepared.sample, prepared.surface, speed).slow_strips > 0) == (
            error > 0.05
        )


@pytest.mark.slow
@pytest.mark.parametrize("sampling, speeds", [("strips", [0.003, 0.03]), ("patch", [0.01, 0.03])])
def test_the_work_of_the_deterministic_model_is_estimated_to_a_factor_of_two(sampling, speeds):
    """Of all points together, counted by the cells and steps of what they solve."""
    prepared = lubfric.prepare(PAPER.with_(numerics={"sampling": sampling, "model": "auto"}))
    cheaper = prepared.scene.with_(numerics={"model": "quick"})
    stated = counted = 0.0
    for speed in speeds:
        one = estimated_work_of_point(prepared.scene, prepared.sample, prepared.surface, speed)
        stated -= estimated_work_of_point(cheaper, prepared.sample, prepared.surface, speed).seconds
        control = solve_to_tolerance(prepared, speed, PaperModel()).control()
        levels = solve_to_tolerance(prepared, speed, DeterministicModel(), control=control).levels
        solved = [*(pair.resolved for pair in levels.pairs), *levels.shortest]
        counted += sum(strip.work for strip in [*solved, *(strip for piece in levels.pieces for strip in piece)])
        stated += one.seconds
        assert one.slow_strips
    assert 0.5 < stated / counted < 2


def test_ridges_that_yield_are_solved_though_no_contacts_can_be_counted(tmp_path):
    """A map that is constant along y is shorter than its correlation length: no block holds one spot."""
    x = (np.arange(200) - 100) * 0.45e-6
    np.save(tmp_path / "ridges.npy", np.repeat(1e-7 * np.cos(2 * np.pi * x / 6e-6)[:, None], 200, 1))
    surface = {"file": tmp_path / "ridges.npy", "spacing": 0.45e-6}
    scene = PAPER.with_(surface=surface, bodies={"hardness": 6e8}, numerics={"sampling": "patch"})
    point = lubfric.friction(scene, 0.003)
    assert point.plastic_area_fraction > 0 and point.uncertainty.effective_contacts == 0
    assert 0 <= point.errors.plastic_area_fraction < 1


def test_a_patch_that_the_film_clears_by_far_has_an_interval_however_short():
    """At a lambda ratio of 3.5 a summit that the patch does not show may touch; above 6 no summit of such heights is so
    high."""
    short = PATCH.with_(contact={"shape": (200, 80)})
    near, far = (lubfric.friction(short, speed) for speed in (0.08, 0.3))
    assert not math.isfinite(near.uncertainty.sampling) and near.contact_load == far.contact_load == 0.0
    assert 0 <= far.uncertainty.sampling < 1e-3 and np.isfinite(far.uncertainty.interval).all()
    long = lubfric.friction(PATCH.with_(contact={"shape": (200, 400)}), 0.3)
    assert far.coefficient == pytest.approx(long.coefficient, rel=1e-3)
