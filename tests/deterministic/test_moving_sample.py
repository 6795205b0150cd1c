"""The sample of moving roughness: its control, blocks of time and place, and when a march ends."""

import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter
from scipy.stats import norm

import lubfric
from lubfric.errors import ITERATION_LIMIT, ConvergenceError, Report, WorkLimitError
from lubfric.models.deterministic import (
    CellsInMotion,
    RoughBody,
    SampleTarget,
    SummitControl,
    TimeAndPlace,
    attenuated,
    cells_in_a_step,
    control_of,
    least_blocks,
    levels,
    mean_over_blocks,
    moved_downstream,
    sample_coarsening_of,
    solve_moving_strip,
    strip_on_two_grids,
    violations_by_correction,
)
from lubfric.models.shared import why_too_few_blocks
from lubfric.surface import Surface, generate_surface

LENGTH = 10e-6  # m: correlation length
WAVE = 40e-6  # m


def surface_of(heights, spacing=2e-6):
    return Surface(heights, (spacing, spacing), periodic_axes=(True, True))


@pytest.mark.parametrize("count", [1, 2, 5])
def test_a_wave_keeps_the_part_of_its_height_that_the_formula_says(count):
    x = np.arange(40) * 2e-6  # two of the wavelengths that keep half
    heights = np.cos(2 * np.pi * count * x / 80e-6)[:, None] * np.ones(8)
    ratio = (WAVE * count / 80e-6) ** 2
    assert attenuated(surface_of(heights), WAVE).heights == pytest.approx(heights * ratio / (1 + ratio), abs=1e-12)


def test_a_map_that_is_not_periodic_has_no_wave_from_its_step():
    ramp = np.linspace(-1, 1, 64)[:, None] * np.ones(8)
    open_map = Surface(ramp, (2e-6, 2e-6), periodic_axes=(False, True))
    assert (
        np.abs(attenuated(open_map, WAVE).heights).max()
        < 0.3 * np.abs(attenuated(surface_of(ramp), WAVE).heights).max()
    )


def test_the_control_of_a_gaussian_surface_is_that_of_the_normal_distribution():
    maps = [
        generate_surface((96, 256), 2e-6, sq=1e-7, correlation_length=LENGTH, acf="gaussian", seed=k) for k in range(9)
    ]
    control = control_of(maps, WAVE)
    expected = control.threshold * (norm.pdf(1) - norm.sf(1))
    assert control.is_known and control.mean == pytest.approx(expected, abs=3 * control.error)
    assert control.threshold < 0.9e-7 and not control_of(maps[:3], WAVE).is_known


def sample_of(seed, moments=120, places=128):
    """Friction that hangs on summits and load by 3 and 0.2, and on chance; each with its own way of 1 b and 10 µm."""
    rng = np.random.default_rng(seed)
    summits, load, chance = (
        gaussian_filter(field, (7, 2.5), mode="wrap") for field in rng.standard_normal((3, moments, places))
    )
    scale = summits.std()
    load = 1.0 + 0.1 * (load - load.mean(axis=1, keepdims=True)) / scale
    summits = summits / scale
    friction = 0.05 + 0.01 * summits + 0.2 * (load - 1) + 0.003 * chance / scale
    return TimeAndPlace(
        friction=friction,
        load=load,
        contact_load=load,
        couette=load,
        summits=summits,
        travelled=0.1,
        spacing=2e-6,
        mean_load=1.0,
    )


def test_blocks_tell_the_error_of_the_mean_with_and_without_the_control():
    """Over sixty samples the deviation from the truth is as large as reported, and the control takes most of it."""
    control = SummitControl(wave=WAVE, threshold=1.0, mean=0.0, scatter=0.0, count=48)
    means = [mean_over_blocks([sample_of(seed)], "friction", LENGTH, control) for seed in range(60)]
    plain = [mean_over_blocks([sample_of(seed)], "friction", LENGTH, None) for seed in range(60)]
    for answers in (means, plain):
        z = [(one.value - 0.05) / one.error.value for one in answers]
        assert 0.75 < math.sqrt(np.mean(np.square(z))) < 1.25
    assert np.std([one.value for one in means]) < 0.45 * np.std([one.value for one in plain])
    assert all(one.value == other.value + one.correction for one, other in zip(means, plain))


@pytest.mark.parametrize(
    "correction, sampling, f, limit",
    [
        (0.15, 0.3, 0.05, 5),
        (-0.15, 0.3, 0.05, 5),
        (0.03, 0.02, 0.05, 2),
        (0.03, 0.04, 0.05, None),
        (0.009, 0.001, 0.05, None),
        (0.06, math.nan, 0.05, 5),
        (0.47, 228.7, -8e-6, None),
    ],
)
def test_a_correction_of_f_above_its_sampling_error_or_five_percent_is_a_note(correction, sampling, f, limit):
    """Not of an f near 0, whose sampling error is far larger than it."""
    notes = list(violations_by_correction(correction, sampling, f))
    assert len(notes) == (limit is not None)
    for note in notes:
        assert note.is_note and f"is {100 * abs(correction):g} %, above {limit} %" in note.text
        assert f"contains a correction of {100 * correction:+g} %" in note.text


def test_a_short_sample_does_not_know_its_error():
    short = mean_over_blocks([sample_of(1, moments=10, places=24)], "friction", LENGTH, None)
    assert short.error.value == math.inf and short.error.freedom == 0


def test_a_march_ends_when_its_error_is_within_the_target():
    scene = lubfric.load_scene("paper").with_(
        bodies={"load": 400.0}, motion={"slide_roll_ratio": 0.1}, lubricant={"eyring_stress": 5e6}
    )
    half_width = scene.bodies.half_width
    surface, *others = (
        generate_surface((96, 48), half_width / 5, sq=4e-8, correlation_length=half_width / 2, acf="gaussian", seed=k)
        for k in range(8)
    )
    body = [RoughBody(surface, 0.3 * 1.05)]
    control = control_of([surface, *others], half_width)
    length = half_width / 2 / math.sqrt(math.log(10))

    def followed(error):
        target = SampleTarget(relative_error=error, correlation_length=length, control=control)
        return solve_moving_strip(scene, body, 0.3, target=target)

    long, short = (followed(error) for error in (1e-9, 0.5))
    counts = [strip.places.friction.shape[0] for strip in (long, short)]
    assert counts[0] == round(96 / 1.05) and counts[1] < 0.4 * counts[0]
    assert short.series["coefficient"] == pytest.approx(long.series["coefficient"][: short.times.size], rel=1e-12)
    reached = mean_over_blocks([short.places], "friction", length, control)
    assert reached.error.value < 0.5 * reached.value
    assert reached.value == pytest.approx(long.result.coefficient, rel=4 * reached.error.value / reached.value)


def test_two_rough_bodies_start_a_step_where_their_common_roughness_is():
    """In a step in which the film passes one cell: one body goes its own way, two equal ones that of the film, and one
    that is smooth has no weight. What moves against the film starts upstream."""
    rough = generate_surface((64, 64), 2e-6, sq=2e-7, correlation_length=LENGTH, acf="gaussian", seed=1)
    smooth = surface_of(np.zeros((64, 64)))

    def cells(*bodies):
        return cells_in_a_step([RoughBody(surface, speed) for surface, speed in bodies], 2e-6, 2e-6)

    assert [cells((rough, speed)) for speed in (0.4, 1.05, 2.0, -1.0)] == pytest.approx([0.4, 1.05, 2.0, -1.0])
    assert cells((rough, 0.36), (rough, 1.64)) == pytest.approx(1.0)
    assert cells((rough, 0.36), (smooth, 1.64)) == pytest.approx(0.36)
    assert cells((smooth, 0.36), (rough, 1.64)) == pytest.approx(1.64)


def test_roughness_that_moves_upstream_starts_a_step_upstream():
    """Where it came from enters at the end that it leaves, and parts of a cell are straight lines."""
    values = np.array([0.0, 1.0, 4.0, 9.0, 16.0])[:, None]
    assert moved_downstream(values, -2.0)[:, 0].tolist() == [4.0, 9.0, 16.0, 16.0, 16.0]
    assert moved_downstream(values, -0.25)[:, 0].tolist() == [0.25, 1.75, 5.25, 10.75, 16.0]
    assert moved_downstream(values, 2.0)[:, 0].tolist() == [0.0, 0.0, 0.0, 1.0, 4.0]


def cells_in_motion(film_ratio=1.0, times=1.0, by_longer=0.0, *, third=True, is_smooth=True):
    return CellsInMotion(
        film_ratio=film_ratio,
        coarse_x=0.25 * times,
        coarse_y=0.5 * times,
        coarse_b=0.1 * times,
        by_longer=by_longer,
        follows_lubricant=third,
        is_smooth=is_smooth,
    )


def test_the_effect_of_the_cells_of_moving_roughness_falls_by_second_order():
    """Half as long cells: a quarter. What remains of the change from longer cells does not change with them."""
    (long, short) = (cells_in_motion(1.5, times) for times in (1.0, 0.5))
    assert short.of_narrow_gaps == pytest.approx(long.of_narrow_gaps / 4)
    (long_fast, short_fast) = (cells_in_motion(1.5, times, third=False) for times in (1.0, 0.5))
    assert short_fast.error == pytest.approx(long_fast.error / 4)
    assert short.error < long.error / 4  # its part by the cells in the half-width is of third order
    assert cells_in_motion(times=1e-9, by_longer=0.03).error == pytest.approx(0.01)


def test_shorter_cells_act_as_a_thinner_boundary_film():
    """Where f = c delta^n, four times the film gives 4^n f, and a film thinner by the factor q gives q^n f: the
    expected change is a power law of the ratio, none where the film does not matter, and of the other sign where f
    falls with the film."""
    changes = [1 + cells_in_motion(4.0**n).change for n in (0.3, 0.6, -0.3, 0.0)]
    assert changes[0] < 1 and changes[1] == pytest.approx(changes[0] ** 2)
    assert changes[2] == pytest.approx(1 / changes[0]) and changes[3] == 1
    assert cells_in_motion(2.0, is_smooth=False).change == 0


def test_errors_of_cells_grow_where_less_is_known():
    """Steps of second order, heights that change from cell to cell, and a change from longer cells add to the error."""
    error = cells_in_motion(1.3).error
    others = [
        cells_in_motion(1.3, third=False),
        cells_in_motion(1.3, is_smooth=False),
        cells_in_motion(1.3, by_longer=0.1),
    ]
    assert all(other.error > error for other in (*others, cells_in_motion(1.6)))


MEASURED_ON_HALVED_CELLS = {1.07: 0.050, 1.23: 0.255, 1.24: 0.009, 1.35: 0.113, 1.42: 0.125, 1.52: 0.086, 2.71: 0.212}


@pytest.mark.parametrize(("film_ratio", "measured"), MEASURED_ON_HALVED_CELLS.items())
def test_the_error_of_cells_too_long_for_summits_contains_measured_changes_and_no_multiple_of_the_largest(
    film_ratio, measured
):
    """Rollers and gear flanks of exponential roughness on cells of these lengths and half of them: the change of f,
    extrapolated by second order."""
    assert measured <= cells_in_motion(film_ratio, is_smooth=False).error < 0.3


@pytest.mark.parametrize(
    ("film_ratio", "wanted", "work", "fails", "halves"),
    [
        (2.0, 1, 15.0, False, True),
        (1.0, 1, 15.0, False, False),  # no effect of the boundary film: the error is within the tolerance
        (2.0, 4, 15.0, False, False),  # all strips that the sample needs would take 150 s
        (2.0, 1, 50.0, False, False),
        (2.0, 1, 15.0, True, False),  # the error stays that of the longer cells
    ],
)
def test_cells_along_y_are_halved_where_their_error_is_large_and_the_work_is_not(
    monkeypatch, film_ratio, wanted, work, fails, halves
):
    scene = lubfric.load_scene("paper").with_(motion={"slide_roll_ratio": 0.1})
    pair = SimpleNamespace(resolved=SimpleNamespace(work=work, slope=0.0), change_by_cells=0.0, has_halved_cells=False)
    halved = SimpleNamespace(resolved=pair.resolved, change_by_cells=0.0, has_halved_cells=True)
    asked = []

    def solve_pair(*_, has_halved_cells=False, **__):
        asked.append(has_halved_cells)
        return pair

    def on_halved_cells(*_):
        if fails:
            Report("film", ITERATION_LIMIT, iterations=1, residual=1.0, tolerance=0.1).raise_if_failed()
        return halved

    monkeypatch.setattr(levels, "solve_pair", solve_pair)
    monkeypatch.setattr(levels, "on_halved_cells", on_halved_cells)
    monkeypatch.setattr(levels, "surface_and_map_coarsening", lambda *_: (None, (1, 2)))
    monkeypatch.setattr(levels, "cells_of_strips", lambda *_: cells_in_motion(film_ratio))
    monkeypatch.setattr(levels, "two_levels", lambda *_: (None, wanted))
    pairs = levels.solve_pairs(SimpleNamespace(scene=scene), 1.0, 2)
    assert pairs[0].has_halved_cells == halves and asked == [False, halves]


@dataclass(frozen=True)
class NoStrip:
    """A strip of moving roughness that was not solved."""

    slope: float = 0.0
    work: float = 0.0
    effort: object = None


def test_longer_cells_may_have_no_solution_but_a_limit_of_work_ends_the_point(monkeypatch):
    """The strip is solved; the comparison on longer cells does not converge, or passes the limit."""
    prepared = lubfric.prepare(lubfric.load_scene("paper").with_(motion={"slide_roll_ratio": 0.1}))
    at_rest = NoStrip()
    errors = []

    def solve(*_, most_steps=None, **__):
        if most_steps is not None:
            raise errors[-1]
        return NoStrip()

    for name, function in (
        ("bodies_of", lambda *_: None),
        ("strip_at_rest", lambda *_, **__: at_rest),
        ("sample_target", lambda *_: None),
        ("compared_moments", lambda _: 1),
        ("solve_moving_strip", solve),
    ):
        monkeypatch.setattr(strip_on_two_grids, name, function)
    errors.append(ConvergenceError("no solution"))
    assert strip_on_two_grids.solve_pair(prepared, 0.03, 0).longer is at_rest
    errors.append(WorkLimitError(1.0))
    with pytest.raises(WorkLimitError):
        strip_on_two_grids.solve_pair(prepared, 0.03, 0)


def test_a_given_grid_takes_the_cells_of_the_scene_where_roughness_moves():
    """Without it cells are as long as a quarter and half of a correlation length allow; at rest nothing changes."""
    scene = lubfric.load_scene("paper").with_(
        surface={"sq": 2e-7, "correlation_length": 16e-6, "acf": "gaussian"},
        motion={"slide_roll_ratio": 0.1},
        contact={"shape": (64, 64), "spacing": 2e-6},
    )

    def cell(scene):
        sample = lubfric.prepare(scene).sample
        return tuple(factor * step for factor, step in zip(sample_coarsening_of(scene, sample), sample.cells.spacing))

    given = scene.with_(numerics={"grid": "given"})
    assert cell(scene) == pytest.approx((4e-6, 8e-6)) and cell(given) == pytest.approx((2e-6, 2e-6))
    at_rest = given.with_(motion={"slide_roll_ratio": 2.0})
    assert cell(at_rest) == pytest.approx((4e-6, 4e-6))


@pytest.mark.parametrize("moments, places", [(62, 62), (62, 70), (85, 62), (92, 62), (120, 128), (25, 130), (25, 150)])
@pytest.mark.parametrize("has_control", [True, False])
def test_a_short_moving_sample_says_of_which_blocks_it_has_too_few(moments, places, has_control):
    """A block is 3 half-widths long, of 0.1 each moment, and 4 correlation lengths wide, of 5 cells each. Of so many as
    are stated the error is known, of fewer it is not."""
    known = SummitControl(wave=WAVE, threshold=1.0, mean=0.0, scatter=0.0, count=48)
    control = known if has_control else None
    sample = sample_of(0, moments, places)
    blocks = (max(moments // 30, 1), max(places // 20, 1))
    is_known = mean_over_blocks([sample], "friction", LENGTH, control).error.freedom > 0
    assert is_known == (math.prod(blocks) >= least_blocks(control))
    assert sample.block_counts(LENGTH) == blocks
    scene = lubfric.load_scene("paper").with_(numerics={"sampling": "patch"})
    words = why_too_few_blocks(
        scene,
        lubfric.prepare(scene).sample,
        blocks=blocks,
        needed=least_blocks(control),
        size=(0.1 * moments, places / 5),
        size_of_block=(3.0, 4.0),
    )
    number = math.prod(blocks)
    plural = "" if number == 1 else "s"
    count = f"{number} nearly independent block{plural} ({blocks[0]} along the motion x {blocks[1]} along y)"
    assert count in words and f"needs {7 if has_control else 6}" in words and "omit numerics.sampling, or give" in words
    assert f"{0.1 * moments:.3g} half-widths" in words and f"{places / 5:.3g} correlation lengths wide" in words


def test_where_nearly_all_of_the_load_rubs_the_cells_of_the_film_matter_little():
    """At the limits: all of the error where film carries a thirtieth of the load or more, that of the rolling part
    where it carries none."""
    of = {
        "film_ratio": 1.0,
        "coarse_x": 0.25,
        "coarse_y": 0.25,
        "coarse_b": 0.2,
        "follows_lubricant": True,
        "is_smooth": True,
    }
    complete = CellsInMotion(**of).error
    assert complete > 0.05
    errors = [CellsInMotion(**of, film_share=share).error for share in (0.0, 1e-3, 1e-2, 0.034, 0.5)]
    assert errors == sorted(errors) and errors[0] == 0.0 and errors[-1] == errors[-2] == complete
    assert errors[1] == pytest.approx(0.03 * complete)
    assert CellsInMotion(**of, film_share=0.0, sliding_share=0.7).error == pytest.approx(0.3 * complete)
    changing = of | {"film_ratio": 1.5}
    assert CellsInMotion(**changing, film_share=0.0).error > 0.0  # what the boundary film itself changes stays


def test_the_slopes_of_two_unlike_surfaces_set_the_length_by_which_cells_are_judged():
    """Sq and slopes of the generated map itself say the same; one body, or an exponential one, keeps its lengths."""
    rough = {"sq": 1e-7, "correlation_length": 1e-5, "acf": "gaussian"}
    broad = {"sq": 2e-7, "correlation_length": (4e-5, 2e-5), "acf": "gaussian"}
    scene = lubfric.load_scene("paper").with_(surface=rough, contact={"shape": (256, 256), "spacing": 1e-6})
    both = lubfric.prepare(scene.with_(counterface=broad))
    heights = both.surface.heights
    for axis, length in enumerate(both.sample.lengths_by_slopes):
        step = both.surface.spacing[axis]
        fall = np.mean(np.diff(heights, axis=axis) ** 2) / (2 * np.var(heights))
        assert length == pytest.approx(step / math.sqrt(-math.log(1 - fall)), rel=0.1)
        assert length < 0.8 * both.sample.correlation_lengths[axis]
    for one in (scene, scene.with_(counterface=broad | {"acf": "exponential"})):
        sample = lubfric.prepare(one).sample
        assert sample.lengths_by_slopes == pytest.approx(sample.correlation_lengths)


def test_the_error_by_the_cells_grows_with_the_unlikeness_of_the_bodies():
    of = {"film_ratio": 1.5, "coarse_x": 0.2, "coarse_y": 0.4, "coarse_b": 0.0, "follows_lubricant": True}
    alike, unlike = (CellsInMotion(**of, is_smooth=True, unlike=ratio) for ratio in (1.0, 2.0))
    assert alike.change == unlike.change
    assert unlike.error**2 - alike.error**2 == pytest.approx(3 * (0.7 * alike.of_narrow_gaps) ** 2)
