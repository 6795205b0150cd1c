"""The strips of a run in time, and its averages."""

import dataclasses
import math

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.output import describe_scene, described_scene
from lubfric.scene import Harmonic, Ramp, Table, Transient, horizon_of, longest_contact
from lubfric.time import speeds_of_run, strip_of_run
from lubfric.time.moment import film_load_exponent

HELD = paper_scene(
    transient=Transient(2e-4, outputs=2), motion={"entrainment_speed": 0.03}, numerics={"sampling_tolerance": 0.035}
)


@pytest.fixture(scope="module")
def held():
    return lubfric.transient(HELD)


def test_the_line_is_as_long_as_the_tolerance_needs(held):
    steady = lubfric.friction(HELD)
    assert steady.uncertainty.sampling <= 0.035 and held.line_length > 2 * 180 * 8e-6
    assert held.line_length == pytest.approx(steady.uncertainty.length, rel=0.05)
    assert held.sampling_error.max() < 1.3 * 0.035
    assert held.uncertainty.length[0] == held.line_length


def test_a_run_held_at_one_speed_is_the_steady_point(held):
    steady = lubfric.friction(HELD)
    np.testing.assert_allclose(held.coefficient, steady.coefficient, rtol=0.03)
    np.testing.assert_allclose(held.sampling_error, steady.uncertainty.sampling, rtol=0.4)
    assert np.all(held.uncertainty.interval[:, 0] < held.coefficient)
    assert "sampling error of f at 95 % at most" in " ".join(held.report.notes)


def test_an_average_over_time_is_as_unsure_as_its_line(held):
    mean = held.average()
    assert mean.coefficient == pytest.approx(held.coefficient.mean(), rel=0.02)
    assert mean.sampling == pytest.approx(held.sampling_error.mean(), rel=0.05)
    assert mean.fixed_scatter == pytest.approx(mean.sampling * math.sqrt(held.line_length / 6e-3))
    assert mean.moving_scatter == pytest.approx(mean.fixed_scatter)  # it hardly moved
    far = dataclasses.replace(held, renewal=1e-8).average()
    assert far.sampling == mean.sampling
    assert far.moving_scatter == pytest.approx(mean.fixed_scatter / math.sqrt(0.03 * 2e-4 / 1e-8), rel=0.2)


def test_an_average_is_the_integral_over_time(held):
    """f rises, stays and falls along straight lines: 0.75 of its height, whatever the outputs."""
    held = dataclasses.replace(held, inputs=0.0)
    columns = {name: np.resize(values, 4) for name, values in held.columns.items()}
    columns |= {"time": np.array([0.0, 1.0, 3.0, 4.0]), "coefficient": np.array([0.0, 0.1, 0.1, 0.0])}
    columns |= {"sampling_error": np.full(4, 0.02), "entrainment_speed": np.full(4, 0.03), "sliding_speed": np.zeros(4)}
    mean = dataclasses.replace(held, columns=columns, renewal=1e-3).average()
    assert mean.coefficient == pytest.approx(0.075) and mean.sampling == pytest.approx(0.02)
    assert (
        mean.moving_scatter == pytest.approx(mean.fixed_scatter / math.sqrt(0.03 * 4.0 / 1e-3)) and mean.in_motion == 1
    )
    speed, error = np.array([[0.0, 0.03, 0.03, 0.0], [np.nan, 0.02, 0.02, np.nan]])
    still = {"entrainment_speed": speed, "sampling_error": error}
    mean = dataclasses.replace(
        held, columns=columns | still
    ).average()  # between a standstill and an output in motion the surfaces move
    assert (mean.coefficient, mean.sampling, mean.in_motion) == pytest.approx((0.1, 0.02, 1.0))


def test_a_run_in_time_takes_cells_that_do_not_move_its_friction():
    """It is not corrected for its cells, as steady friction is: on cells four times the scene's f was 2.6 % low."""
    scene = paper_scene(
        bodies={"load": 20.0, "width": 5e-3, "hardness": None},
        motion={"entrainment_speed": 0.1},
        lubricant={"viscosity": 0.1, "pressure_viscosity_coefficient": 1e-8},
        surface={"acf": "exponential", "correlation_length": 8e-6, "seed": 3},
        contact={"shape": (192, 192), "spacing": 0.4e-6},
        transient=Transient(1e-3, outputs=1),
    )
    coarse = lubfric.prepare(scene)
    fine = strip_of_run(coarse).prepared
    assert lubfric.friction(scene).decision.change_by_cells > 0.015
    assert lubfric.friction(fine).decision.change_by_cells <= scene.numerics.tolerance
    assert fine.surface.spacing[0] < coarse.surface.spacing[0]
    kept = strip_of_run(lubfric.prepare(scene.with_(numerics={"tolerance": 0.1}))).prepared
    assert kept.sample.cells == coarse.sample.cells


def test_contact_areas_of_a_run_are_those_on_the_cells_of_the_scene(held):
    """On the cells of the line, four times as long, the second was 1.9 times too large."""
    scene = HELD.with_(surface={"acf": "exponential"}, motion={"entrainment_speed": 1e-3}, numerics={"tolerance": 0.05})
    rough = lubfric.transient(scene)
    for run, steady in ((held, lubfric.friction(HELD)), (rough, lubfric.friction(scene))):
        result = run.real_contact_area_fraction[-1]
        assert result == pytest.approx(steady.real_contact_area_fraction, rel=0.12)


def test_a_film_that_bends_its_bodies_divides_the_load_as_softly_as_in_a_steady_contact():
    """A heavier load, where the film hardly feels its own: the error of a run held at one speed is that of
    `lubfric.friction`, whose response is solved for."""
    short = Transient(1e-5, outputs=2)
    scene = HELD.with_(bodies={"load": 27.5}, transient=short, numerics={"sampling_tolerance": 0.05})
    stated = lubfric.transient(scene).sampling_error[0]
    assert 0.75 < stated / lubfric.friction(scene).uncertainty.sampling < 1.35


@pytest.mark.parametrize(("load", "speed", "low", "high"), [(1e-3, 1.0, 0.97, 1.01), (1e3, 0.1, 0.02, 0.2)])
def test_a_film_thins_with_its_load_as_a_rigid_or_an_elastic_one(load, speed, low, high):
    """h ~ 1/w (Martin) where bodies are rigid, and about w^-0.1 (Dowson) where they bend."""
    scene = HELD.with_(motion={"entrainment_speed": speed}, bodies={"load": load})
    assert low < film_load_exponent(scene, load) < high
    assert film_load_exponent(scene, 0.0) == 1.0
    assert 0 < film_load_exponent(scene.with_(motion={"entrainment_speed": 0.0, "speeds": (1.0,)}), load) <= 1.0


def test_a_run_on_one_patch_takes_the_cells_of_the_patch():
    """Steady friction is solved on longer cells and corrected for them; a run in time is not corrected."""
    scene = HELD.with_(numerics={"sampling": "patch"})
    spacing = tuple(np.broadcast_to(scene.contact.spacing, 2).tolist())
    prepared = lubfric.prepare(scene)
    assert max(prepared.sample.cells.coarsening) > 1
    strip = strip_of_run(prepared).prepared
    assert strip.sample.cells.is_native and strip.surface.spacing == strip.rough_contact.spacing == pytest.approx(
        spacing
    )
    assert strip.surface.shape == strip.rough_contact.heights.shape == scene.contact.shape
    run = lubfric.transient(scene)
    own = scene.with_(numerics={"grid": "given", "film_deflection": "hydrodynamic"})
    assert run.coefficient[0] == pytest.approx(lubfric.friction(own).coefficient, rel=0.003)
    assert run.line_length == pytest.approx(scene.contact.shape[1] * spacing[1])


WAVE = Table(times=(0.0, 0.01, 0.02), values=(0.05, 0.2, 0.05), repeat=True)
PULSE = Table(times=(0.0, 0.01, 0.03), values=(2.0, 5.0, 3.0))


def test_a_longer_run_has_the_same_strips():
    """They follow from the histories, of which a run may see a part."""
    durations = (1e-3, 1.5e-2, 3e-2)
    runs = [HELD.with_(transient=Transient(duration, speed=WAVE, load=PULSE)) for duration in durations]
    assert len({tuple(speeds_of_run(run)) for run in runs}) == len({longest_contact(run) for run in runs}) == 1
    assert speeds_of_run(runs[0])[-1] == pytest.approx(0.2) and longest_contact(runs[0]).bodies.load == 5.0
    assert [history.range(1e-3)[1] for history in (WAVE, PULSE)] == pytest.approx([0.065, 2.3])
    for until in (WAVE.horizon, 0.03):
        assert WAVE.range(until) == pytest.approx((0.05, 0.2))
    other = Harmonic(frequency=30.0)
    assert horizon_of((WAVE, PULSE), 1.0) == 0.03 and horizon_of((WAVE, other), 1.0) == 1.0
    assert horizon_of((other, Ramp(until=0.1)), 1.0) == pytest.approx(0.1)


def test_info_states_the_strips_that_the_run_has():
    scene = HELD.with_(transient=Transient(1e-4, outputs=2), numerics={"sampling_tolerance": 0.02})
    strips = strip_of_run(lubfric.prepare(scene)).strips
    (by_info, by_text) = (
        " ".join(text.split()) for text in (described_scene(scene, measures=True)[0], describe_scene(scene))
    )
    assert strips > 1 and f"sample: {strips} strips of the roughness, at all times" in by_info
    assert "sample: about" in by_text
