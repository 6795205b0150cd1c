"""The surface that has run in: closed forms of the model, what it never does, and what it changes of f."""

import pickle

import numpy as np
import pytest

import lubfric
from lubfric import InputError, Surface, run_in, solve_contact

E_PRIME = 200e9  # E' = 2 E*
PAPER = lubfric.load_scene("paper")
ROUGH = PAPER.with_(
    bodies={"hardness": 2e9, "load": 20.0},
    surface={"sq": 200e-9, "correlation_length": 5e-6},
    contact={"shape": (128, 48), "spacing": 0.9e-6},
    numerics={"model": "paper"},
)


def sphere(hardness_over_p0: float):
    """A cap of radius r under a much flatter cylinder, which bears the whole load: scene, map, and its Hertz radius."""
    r = 50e-6
    radius = 1e-3
    height = 100e-9
    d = 0.2e-6
    (nx, ny) = (200, 60)
    x, y = ((np.arange(n) - n / 2 + 0.5) * d for n in (nx, ny))
    cap = Surface(np.maximum(height - (x[:, None] ** 2 + y**2) / (2 * r), 0.0), d)
    a = 1e-6
    mean_radius = r / np.sqrt(1 + r / radius)
    load = 4 / 3 * (E_PRIME / 2) * a**3 / mean_radius
    p0 = 1.5 * load / (np.pi * a**2)
    scene = PAPER.with_(bodies=under(radius, ny * d, load, hardness_over_p0 * p0))
    return scene, cap


def ripple(hardness: float, p0: float, p_star: float):
    """Ridges along the motion, cos(2 pi y/L), under a line contact of Hertz pressure p0 that is far wider than L.
    p_star = pi E* A/L closes them."""
    radius = 0.05
    length = 4e-6
    ny = 96
    nx = 60
    b = 4 * radius * p0 / E_PRIME
    amplitude = p_star * length / (np.pi * E_PRIME / 2)
    ridges = np.tile(amplitude * np.cos(2 * np.pi * (np.arange(ny) + 0.5) / ny), (nx, 1))
    load = np.pi / 2 * p0 * b * length
    return PAPER.with_(bodies=under(radius, length, load, hardness)), Surface(ridges, (b / 10, length / ny))


def under(radius, width, load, hardness) -> dict[str, float]:
    return {"radius": radius, "width": width, "load": load, "e_prime": E_PRIME, "hardness": hardness}


def reloaded(scene, surface) -> tuple[lubfric.ContactResult, float]:
    """The dry contact about the middle of ``surface``, and its area [m²]."""
    bodies = scene.bodies
    (nx, ny) = surface.shape
    (dx, dy) = surface.spacing
    x = (np.arange(nx) - nx / 2 + 0.5) * dx
    mean = bodies.load / (bodies.width * nx * dx)
    options = {"hardness": bodies.hardness, "boundary": ("free", "periodic"), "mean_pressure": mean}
    gap = x[:, None] ** 2 / (2 * bodies.radius) - surface.heights
    result = solve_contact(gap, (dx, dy), bodies.e_prime, **options)
    return result, result.contact_area_fraction * nx * ny * dx * dy


@pytest.fixture(scope="module")
def rough():
    return run_in(ROUGH)


@pytest.mark.parametrize("over, yields", [(1.03, False), (0.97, True)])
def test_it_yields_first_where_the_elastic_pressure_reaches_the_hardness(over, yields):
    """A sphere at Hertz's p0; a ripple at 2 sqrt(p p*), its peak in partial contact under a mean pressure p (Johnson,
    Contact Mechanics, Sec. 13.2)."""
    assert bool(run_in(*sphere(over), tolerance=1e-11).dents.any()) is yields
    peak = 2 * np.sqrt(0.25e9 * 1e9)
    assert bool(run_in(*ripple(over * peak, 0.25e9, 1e9), tolerance=1e-11).dents.any()) is yields


def test_a_plastic_contact_has_the_area_of_load_over_hardness():
    """So a deep ripple gets plateaus of the share p0/P_u, which then bear the load without new dents."""
    scene, ridges = ripple(1e9, 0.3e9, 5e9)
    result = run_in(scene, ridges, tolerance=1e-11)
    assert (result.dents > 1e-11).mean() == pytest.approx(0.3, rel=0.04)
    scene, cap = sphere(0.1)
    area = scene.bodies.load / scene.bodies.hardness
    assert reloaded(scene, cap)[1] == pytest.approx(area, rel=0.02)
    result = run_in(scene, cap)
    again, bearing = reloaded(scene, result.surface)
    assert bearing > area and again.gap.min() > -1e-10 and result.deepest[1] < 0.5 * result.deepest[0]


def test_dents_stay_and_a_second_call_changes_nothing(rough):
    assert rough.shaken_down and rough.deepest[-1] <= 1e-10 < rough.deepest[0]
    assert (rough.dents >= 0).all() and rough.sinking[0] > 0.01
    again = run_in(ROUGH, rough.surface)
    assert again.shaken_down and again.deepest.size == 1
    np.testing.assert_array_equal(again.surface.heights, rough.surface.heights)
    lighter = run_in(ROUGH.with_(bodies={"load": 10.0}), rough.surface)
    assert not lighter.dents.any()


def test_summits_become_plateaus(rough):
    assert rough.surface.sq < rough.before.sq and rough.surface.ssk < min(rough.before.ssk, -0.05)
    share, before, after = rough.bearing()
    assert (after <= before + 1e-15).all() and np.mean(before - after) == pytest.approx(rough.dents.mean())
    assert (before - after)[share < 0.01].mean() > 20 * (before - after)[share > 0.5].mean()
    axes = rough.plot()
    np.testing.assert_allclose(axes.lines[1].get_ydata(), after * 1e9)
    assert "shaken down" in repr(rough) and "run in" in rough.surface.notes[-1]


def test_the_range_of_a_hardness_gives_both_surfaces(rough):
    """Each as if that hardness were given; and none where it is a number."""
    result = run_in(ROUGH.with_(bodies={"hardness": [2e9, 1.5e9, 3e9]}), passes=1)
    for hardness, end in zip((1.5e9, 3e9), result.ends, strict=True):
        alone = run_in(ROUGH.with_(bodies={"hardness": hardness}), passes=1)
        assert np.array_equal(alone.surface.heights, end.heights) and alone.ends == ()
    assert result.ends[0].sq < result.surface.sq < result.ends[1].sq and "range" in repr(result)


def test_above_the_hardness_the_strip_itself_keeps_yielding():
    p0 = PAPER.bodies.mean_hertz_pressure * 4 / np.pi
    flat = Surface(np.zeros((120, 8)), 0.45e-6)
    ends = [run_in(PAPER.with_(bodies={"hardness": over * p0}), flat, passes=4) for over in (0.9, 1.02)]
    assert not ends[0].shaken_down and ends[0].deepest[-1] > 0.8 * ends[0].deepest[0]
    assert "still yielding" in repr(ends[0])
    assert ends[1].shaken_down and not ends[1].dents.any()


def test_the_direction_of_motion_is_that_of_the_speed(rough):
    """A turned map that moves the other way runs in as the first does."""
    given = Surface(rough.before.heights[:57] * 1.5, rough.before.spacing, periodic_axes=(False, True))
    turned = Surface(given.heights[::-1], given.spacing, periodic_axes=(False, True))
    assert ROUGH.motion.entrainment_speed > 0
    back = ROUGH.with_(motion={"entrainment_speed": -ROUGH.motion.entrainment_speed})
    there, other, same_way = (run_in(s, m, step=7 * 0.9e-6) for s, m in ((ROUGH, given), (back, turned), (back, given)))
    np.testing.assert_allclose(other.dents[::-1], there.dents, atol=1e-11)
    assert abs(same_way.dents - there.dents).max() > 1e-10


@pytest.mark.parametrize("speed", [0.003, 0.1, 1.0])
def test_friction_before_and_after(rough, speed):
    """Where summits touch it falls by more than the numerical errors of both; a full film knows no summits."""
    before, after = (lubfric.friction(lubfric.prepare(ROUGH, s), speed) for s in (rough.before, rough.surface))
    assert (before.contact_load > 0) == (speed < 1)
    fall = before.coefficient - after.coefficient
    if speed == 1:
        assert abs(fall) < 1e-3 * before.coefficient
    else:
        assert after.contact_load < before.contact_load and fall > 0
    if speed == 0.1:
        assert fall > 0.05 * before.coefficient > before.uncertainty.numerical + after.uncertainty.numerical


def test_it_is_stored_and_read_as_any_map(rough, tmp_path):
    np.save(tmp_path / "run_in.npy", rough.surface.heights)
    kept = lubfric.read_surface(tmp_path / "run_in.npy", spacing=0.9e-6, level=False)
    np.testing.assert_array_equal(kept.heights, rough.surface.heights)
    copy = pickle.loads(pickle.dumps(rough))
    assert copy.surface.notes == rough.surface.notes and not copy.deepest.flags.writeable
    measured = ROUGH.with_(
        surface={"file": str(tmp_path / "run_in.npy"), "spacing": 0.9e-6, "sq": None, "correlation_length": None},
        contact={"shape": None, "spacing": None},
    )
    whole = run_in(measured, passes=1).before
    assert whole.shape == (128, 96) and whole.periodic_axes == (False, True)


@pytest.mark.parametrize(
    "changes, options, said",
    [
        ({"bodies": {"hardness": None}}, {}, "bodies.hardness"),
        ({"counterface": {"sq": 1e-7, "correlation_length": 5e-6}}, {}, "counterface"),
        ({}, {"passes": 0}, "passes"),
        ({}, {"tolerance": 0.0}, "tolerance"),
        ({}, {"step": 1e-3}, "step"),
        ({"contact": {"geometry": "flat", "spacing": 20e-6}, "surface": {"correlation_length": 80e-6}}, {}, "resolve"),
    ],
)
def test_what_it_cannot_run_in_is_refused(changes, options, said):
    with pytest.raises(InputError, match=said):
        run_in(ROUGH.with_(**changes), **options)
