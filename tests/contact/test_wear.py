"""Wear by Archard's law: closed forms of constant pressure, a sinusoid, a smooth cylinder; and what a run keeps."""

from dataclasses import replace

import numpy as np
import pytest

import lubfric
from lubfric import InputError, run_in, solve_contact
from lubfric.contact import LoadedCylinder, archard_compliance, half_space, operator_under, passage
from lubfric.running_in import wear as steps

E_PRIME = 230e9
HARDNESS = 6e9
K = 1e-5
ROUGH = lubfric.load_scene("paper").with_(
    bodies={"hardness": 2e9, "load": 20.0},
    surface={"sq": 200e-9, "correlation_length": 5e-6},
    motion={"entrainment_speed": 0.1},
    contact={"shape": (128, 48), "spacing": 0.9e-6},
    numerics={"model": "paper"},
)


# What several tests begin with, on a smaller map.
SHORT = ROUGH.with_(contact={"shape": (64, 32)})
SLIDING = {"distance": 0.3, "wear_coefficient": 1e-6}


@pytest.fixture(scope="module")
def worn():
    """Distances at which a lift-off speed is sought take most of the time."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(steps, "RECORDS", 3)
        return run_in(ROUGH, distance=0.5, wear_coefficient=1e-6)


@pytest.fixture(scope="module")
def shortly_worn():
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(steps, "RECORDS", 2)
        return run_in(SHORT, **SLIDING)


def test_constant_pressure_wears_linearly():
    """A flat body in full contact: the depth is K p s/H after every step."""
    flat = np.zeros((8, 12))
    operator = half_space(flat.shape, 1e-6, E_PRIME)
    depth = flat
    for step in (0.1, 0.3, 1.1):
        compliance = archard_compliance(K, step, HARDNESS)
        layered = operator.with_layer(compliance)
        pressure = solve_contact(depth, 1e-6, E_PRIME, mean_pressure=4e8, operator=layered).pressure
        depth = depth + compliance * pressure
    np.testing.assert_allclose(depth, K * 4e8 * 1.5 / HARDNESS, rtol=1e-9)


def test_a_sinusoid_in_full_contact_wears_flat_exponentially():
    """Its pressure amplitude is E' k A/4 (Westergaard), so A falls as exp(-K E' k s/(4 H)); a step of the implicit
    method divides A by 1 + K E' k ds/(4 H)."""
    length = 10e-6
    n = 32
    height = 5e-9
    wave = height * np.cos(2 * np.pi * np.arange(n) / n)[:, None] * np.ones(8)
    operator = half_space(wave.shape, length / n, E_PRIME)
    rate = K * E_PRIME * 2 * np.pi / length / 4 / HARDNESS
    amplitudes = {}
    for count in (20, 40):
        left = wave
        compliance = archard_compliance(K, 1.0 / rate / count, HARDNESS)
        for _ in range(count):
            layered = operator.with_layer(compliance)
            contact = solve_contact(-left, length / n, E_PRIME, mean_pressure=1e9, operator=layered, tolerance=1e-10)
            left = left - compliance * contact.pressure
        amplitudes[count] = np.ptp(left) / 2 / height
        assert amplitudes[count] == pytest.approx((1 + 1 / count) ** -count, rel=1e-4)
    assert 2 * amplitudes[40] - amplitudes[20] == pytest.approx(np.exp(-1), rel=2e-3)


def test_a_deep_scar_of_a_cylinder_at_rest_is_flat():
    """Far below the Hertz depth the wear volume 2 a³/(3 R) is K w s/H, with the half-width a (a flat on a parabola)."""
    radius = 1e-3
    load = 2e4  # N/m
    n = 240
    dx = 0.8e-6
    x = (np.arange(n) - (n - 1) / 2) * dx
    gap = (x**2 / (2 * radius))[:, None] * np.ones(2)
    operator = half_space(gap.shape, dx, E_PRIME, ("free", "periodic"))
    options = {"boundary": ("free", "periodic"), "mean_pressure": load / (n * dx), "tolerance": 1e-8}
    scar = 75e-6  # half-width to reach; Hertz: 15 µm
    compliance = 2 * scar**3 / (3 * radius) / load / 40
    for _ in range(40):
        contact = solve_contact(gap, dx, E_PRIME, operator=operator.with_layer(compliance), **options)
        gap = gap + compliance * contact.pressure
    assert (contact.pressure[:, 0] > 0).sum() * dx / 2 == pytest.approx(scar, rel=0.03)
    inside = np.abs(x) < 0.7 * scar
    np.testing.assert_allclose(contact.pressure[inside, 0], load / (2 * scar), rtol=0.06)


def test_a_smooth_dry_cylinder_wears_its_counterpart_evenly():
    """Every point passes under the mean Hertz pressure p for the same sliding: K p s/H, whatever the pressure's
    form."""
    cylinder = LoadedCylinder(radius=0.01, width=1e-3, load=100.0, e_prime=E_PRIME)
    spacing = (cylinder.half_width / 15, 1e-5)
    heights = np.zeros((97, 2))
    under = operator_under(heights + np.array([0.0, 1e-7]), spacing, cylinder)
    count = 34
    compliance = archard_compliance(K, 1.0 / count, HARDNESS)
    left = heights
    for turn in range(count):
        windows = passage(heights.shape, cylinder, under, periodic=True, turn=turn)
        stacked = windows.stacked(left)
        x = (np.arange(stacked.shape[0]) - stacked.shape[0] // 2) * spacing[0]
        operator = half_space(stacked.shape, spacing, E_PRIME, ("free", "periodic"))
        contact = solve_contact(
            x[:, None] ** 2 / (2 * cylinder.radius) - stacked,
            spacing,
            E_PRIME,
            operator=operator.with_layer(windows.dose * compliance),
            boundary=("free", "periodic"),
            mean_pressure=cylinder.load / (cylinder.width * x.size * spacing[0]),
        )
        left = windows.worn(left, contact.pressure, compliance)
    expected = K * cylinder.load / cylinder.hertz_area / HARDNESS
    assert -left.mean() == pytest.approx(expected, rel=1e-6)
    np.testing.assert_allclose(-left, expected, rtol=0.05)  # the windows shift from step to step


def test_windows_pass_over_every_column_and_keep_the_volume():
    cylinder = LoadedCylinder(radius=0.01, width=1e-3, load=100.0, e_prime=E_PRIME)
    heights = np.random.default_rng(2).normal(0, 2e-7, (150, 16))
    spacing = (2e-6, 2e-6)
    operator = operator_under(heights, spacing, cylinder)
    for periodic in (True, False):
        for turn in range(3):
            windows = passage(heights.shape, cylinder, operator, periodic=periodic, turn=turn)
            stacked = windows.stacked(heights)
            pressure = np.random.default_rng(turn).uniform(0, 1e9, stacked.shape)
            worn = windows.worn(heights, pressure, 1e-17)
            lost = (heights - worn).sum()
            assert lost == pytest.approx(windows.dose * 1e-17 * pressure.sum(), rel=1e-9)
            # the load of every window, for the sliding of one passage: V = K F s/H on the strip under it
            windows_length = len(windows.columns) * windows.dose * 2 * cylinder.half_width
            assert windows_length == pytest.approx(heights.shape[0] * spacing[0], rel=1e-12)
    counts = np.zeros(150, int)
    for turn in range(30):
        near = passage(heights.shape, cylinder, operator, periodic=True, turn=turn).columns
        middle = near.shape[1] // 2
        reach = round(cylinder.half_width / spacing[0])
        np.add.at(counts, near[:, middle - reach : middle + reach + 1], 1)
    assert counts.min() > 0.75 * counts.mean() and counts.max() < 1.25 * counts.mean()


def test_no_wear_leaves_the_dents_alone(shortly_worn):
    today = run_in(SHORT)
    assert today.wear is None
    np.testing.assert_array_equal(today.surface.heights, shortly_worn.dented.heights)
    for options in ({"distance": 1.0}, {"wear_coefficient": 1e-6}, {"distance": 1.0, "wear_coefficient": 0.0}):
        np.testing.assert_array_equal(run_in(SHORT, **options).surface.heights, today.surface.heights)


def test_asperities_wear_off_and_lift_off_comes_at_a_lower_speed(worn):
    wear = worn.wear
    for falling in (wear.sq, wear.asperity_load_ratio, wear.coefficient, wear.lift_off_speed):
        assert (np.diff(falling) < 0).all()
    assert wear.lift_off_speed[-1] < 0.6 * wear.lift_off_speed[0] and wear.sq[-1] > 0.8 * wear.sq[0]
    assert (np.diff(wear.distance) > 0).all() and wear.distance[-1] == 0.5 and "reached" in wear.stopped
    low, high = wear.interval.T
    assert ((low < wear.coefficient) & (wear.coefficient < high)).all()
    low, high = wear.lift_off_interval.T
    assert ((low < wear.lift_off_speed) & (wear.lift_off_speed < high)).all()
    assert worn.surface.ssk < worn.dented.ssk and "worn" in repr(worn) and "lift-off" in repr(wear)
    assert wear.sq[-1] == pytest.approx(worn.surface.sq) and wear.spk[0] == pytest.approx(worn.dented.spk)


def test_the_worn_volume_is_that_of_archard(worn):
    """∫ K F_C ds/H over the recorded distances, on the area of the map over that of the Hertz strip."""
    wear = worn.wear
    bodies = ROUGH.bodies
    load = np.trapezoid(wear.asperity_load_ratio, wear.distance) * bodies.load
    over = np.prod(worn.surface.size) / (2 * bodies.half_width * bodies.width)
    volume = 1e-6 * load / bodies.hardness * over
    assert wear.volume[-1] == pytest.approx(volume, rel=0.05)
    lost = (worn.dented.heights - worn.surface.heights).mean()
    assert wear.depth[-1] == pytest.approx(lost, rel=1e-9) and 0 < wear.volume_error < 0.1


def test_only_k_times_s_over_h_counts_and_the_other_body_wears_by_its_own_hardness(shortly_worn, monkeypatch):
    monkeypatch.setattr(steps, "RECORDS", 2)
    same = run_in(SHORT, **(SLIDING | {"distance": 0.6}), hardness=(4e9, 1e9))
    np.testing.assert_allclose(same.surface.heights, shortly_worn.surface.heights, atol=1e-13)
    np.testing.assert_allclose(same.wear.counterface_volume, 4 * same.wear.volume)


@pytest.mark.slow
def test_shorter_steps_change_the_depth_by_less_than_is_stated(shortly_worn, monkeypatch):
    coarse = shortly_worn.wear
    monkeypatch.setattr(steps, "CHANGE", 0.04)
    monkeypatch.setattr(steps, "RECORDS", 2)
    finer = run_in(SHORT, **SLIDING).wear
    assert finer.steps > 1.5 * coarse.steps and finer.volume_error < coarse.volume_error
    assert abs(finer.depth[-1] / coarse.depth[-1] - 1) < coarse.volume_error


@pytest.mark.slow
def test_it_stops_where_the_asperity_load_has_vanished(monkeypatch):
    monkeypatch.setattr(steps, "RECORDS", 4)
    fast = ROUGH.with_(motion={"entrainment_speed": 0.2})
    wear = run_in(fast, distance=100.0, wear_coefficient=1e-6).wear
    assert "less than 0.1 %" in wear.stopped and wear.distance[-1] < 100
    assert wear.asperity_load_ratio[-1] < 0.01 and wear.lift_off_speed[-1] < 0.25
    assert wear.notes == ()


def test_without_asperity_load_nothing_wears(monkeypatch):
    monkeypatch.setattr(steps, "RECORDS", 2)
    lifted = run_in(SHORT.with_(motion={"entrainment_speed": 2.0}), distance=1.0, wear_coefficient=1e-6)
    np.testing.assert_array_equal(lifted.surface.heights, lifted.dented.heights)
    assert "less than 0.1 %" in lifted.wear.stopped
    labels = [line.get_label() for line in lifted.wear.plot().lines]
    assert labels == ["Sq", "lift-off speed"]  # no ratio to a first value of 0


def test_a_flat_contact_wears_too(monkeypatch):
    monkeypatch.setattr(steps, "RECORDS", 2)
    scene = ROUGH.with_(
        contact={"geometry": "flat", "shape": (48, 32)},
        motion={"entrainment_speed": 0.05},
        numerics={"tolerance": 0.05},
    )
    wear = run_in(scene, distance=0.1, wear_coefficient=1e-6, passes=3).wear
    assert wear.sq[-1] < wear.sq[0] and wear.coefficient[-1] < wear.coefficient[0]
    bodies = scene.bodies
    load = np.trapezoid(wear.asperity_load_ratio, wear.distance) * bodies.load
    assert wear.depth[-1] == pytest.approx(1e-6 * load / (2 * bodies.half_width * bodies.width) / 2e9, rel=0.1)


@pytest.mark.parametrize(
    "changes, options, said",
    [
        ({}, {"distance": -1.0}, "distance"),
        ({}, {"wear_coefficient": 2.0}, "wear_coefficient"),
        ({}, {"wear_coefficient": "1e-6 m"}, "wear_coefficient"),
        ({}, {"hardness": 2e9}, "pair"),
        ({}, {"hardness": (2e9, 0.0)}, "hardness"),
        ({"motion": {"slide_roll_ratio": 0.0}}, {}, "rolling"),
        ({"motion": {"entrainment_speed": 0.0}}, {}, "entrainment_speed"),
        ({"contact": {"model": "summits"}}, {}, "half-space"),
        ({"numerics": {"model": "deterministic"}}, {}, "paper"),
    ],
)
def test_bad_wear_is_refused(changes, options, said):
    with pytest.raises(InputError, match=said):
        run_in(ROUGH.with_(**changes), **({"distance": 1.0, "wear_coefficient": 1e-6} | options))


def test_the_history_is_drawn(worn):
    axes = worn.wear.plot()
    np.testing.assert_allclose(axes.lines[1].get_ydata(), worn.wear.lift_off_speed / worn.wear.lift_off_speed[0])
    assert replace(worn.wear, steps=3).steps == 3
    far = replace(worn.wear, distance=worn.wear.distance * 10.0 / worn.wear.distance[-1]).plot()
    assert far.get_xlabel() == "sliding distance in the contact (m)" and far.lines[0].get_xdata()[-1] == 10.0
