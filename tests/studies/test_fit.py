"""Fits: made-up data come back within their regions, what data cannot tell is said, files are read by name and unit."""

import html
import json
import math
import shlex
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cache
from importlib import import_module
from types import SimpleNamespace

import numpy as np
import pytest
import small_study
from scene_text import paper_scene
from scipy.stats import f as f_distribution
from small_study import slowness

import lubfric
from lubfric.models.shared import violations_by_numerical_error
from lubfric.output import fit_status, main

SCENE = small_study.SCENE.with_(lubricant={"eyring_stress": 5e6})
SPEEDS = np.geomspace(1e-3, 0.5, 7)
TRUTH = {"bodies.boundary_friction_coefficient": 0.12, "lubricant.viscosity": 0.2}
BOUNDS = {"bodies.boundary_friction_coefficient": (0.05, 0.2), "lubricant.viscosity": (0.05, 1.0)}


def in_joint_region(found, values):
    """Whether values lie in the joint 95 % region of a fit (F distribution of p and n - p)."""
    away = np.array([bounds.share(values[key]) for key, bounds in found.parameters.items()]) - found.unit
    p = away.size
    n = found.predicted.size
    return away @ np.linalg.solve(found.unit_covariance, away) / p <= f_distribution.ppf(0.95, p, n - p)


@cache
def true_coefficient(*speeds):
    """Return f of `TRUTH`."""
    return lubfric.stribeck(SCENE.with_keys(TRUTH), speeds, tolerance=2e-3).coefficient


def made_up(seed, speeds=SPEEDS, noise=0.05):
    true = true_coefficient(*speeds)
    return lubfric.Measured(speeds, true * (1 + noise * np.random.default_rng(seed).normal(size=speeds.size)))


@pytest.fixture(scope="module")
def fitted():
    """A fit from the scene's own values; `test_fit_minima.py` shows the search for other minima."""
    return lubfric.fit(SCENE, made_up(1), BOUNDS, starts=0)


@pytest.mark.slow
def test_the_time_of_a_fit_is_estimated_within_a_factor_of_three():
    """Its processor seconds, in those of the machine that forecasts are made for."""
    measured = made_up(1)
    before = slowness()
    begun = time.process_time()
    lubfric.fit(SCENE, measured, BOUNDS)
    ended = time.process_time()
    seconds = (ended - begun) / (0.5 * (before + slowness()))
    words = lubfric.explain_fit(SCENE, measured, BOUNDS)
    number, unit = words.split("time: about ")[1].split()[:2]
    assert unit == "s" and 1 / 3 < float(number) / seconds < 3, (number, seconds)
    assert "bodies.boundary_friction_coefficient: 0.05 to 0.2" in words and "searched on a logarithmic scale" in words
    with pytest.raises(lubfric.InputError, match="unknown key 'numerics' in parameters"):
        lubfric.explain_fit(SCENE, measured, {"numerics.tolerance": (0.01, 0.1)})


def test_a_viscosity_in_place_of_an_oil_is_refused_without_its_pressure_viscosity_coefficient():
    """The coefficient, an estimate from the oil, would stay that of another viscosity."""
    oil = SCENE.with_(lubricant={"viscosity": None, "nu40": 1e-4, "viscosity_index": 95, "temperature": 313.15})
    with pytest.raises(lubfric.InputError, match="the viscosity of the scene comes from an oil"):
        lubfric.fit(oil, lubfric.Measured(SPEEDS, np.full(SPEEDS.size, 0.1)), {"lubricant.viscosity": (0.05, 1.0)})


def hertz_and_eyring(slips, alpha, stress, viscosity=0.05, speed=2.0, radius=0.01, modulus=2.3e11, peak=1e9):
    """Traction of a Barus oil with the Eyring law under the pressure of Hertz, with the central film of Dowson and
    Toyoda: a closed form, but for an integral over the angle."""
    load = 2 * np.pi * radius * peak**2 / modulus
    half = 4 * radius * peak / modulus
    entrained = viscosity * speed / (modulus * radius)
    loaded = load / (modulus * radius)
    film = 3.06 * radius * (alpha * modulus) ** 0.56 * entrained**0.69 * loaded**-0.10
    angle = np.linspace(-np.pi / 2, np.pi / 2, 2001)
    p = peak * np.cos(angle)
    dx = half * np.cos(angle) * (angle[1] - angle[0])
    rates = np.array(slips)[:, None] * speed / film
    return (stress * np.arcsinh(viscosity * np.exp(alpha * p) * rates / stress) * dx).sum(axis=1) / load


def test_independent_data_of_eyring_are_found_within_their_intervals():
    """As of a rig that averages over both signs of slip: a closed form has no rolling part. Noise of 2 %."""
    alpha = "lubricant.pressure_viscosity_coefficient"
    stress = "lubricant.eyring_stress"
    scene = lubfric.load_scene("paper").with_(
        bodies={"radius": 0.01, "width": 0.01, "e_prime": 2.3e11, "load": 2 * np.pi * 0.01 * 1e18 / 2.3e11 * 0.01},
        lubricant={"viscosity": 0.05, "viscosity_law": "barus", "density_law": "dowson-higginson"}
        | {"pressure_viscosity_coefficient": 2.2e-8, "eyring_stress": 1e7},
        motion={"entrainment_speed": 2.0},
        surface={"sq": 0.0, "correlation_length": 3e-5},
        contact={"shape": (64, 64), "spacing": 1e-5},
    )
    slips = np.geomspace(2e-4, 0.02, 6)
    noise = 1 + 0.02 * np.random.default_rng(1).standard_normal(slips.size)
    f = hertz_and_eyring(slips, 1.8e-8, 5e6) * noise
    measured = lubfric.Measured(slips, f, over="slide_roll_ratio", rolling=False)
    result = lubfric.fit(scene, measured, {alpha: (1.2e-8, 2.8e-8), stress: (1e6, 2e7)}, starts=0)
    for key, true, share in ((alpha, 1.8e-8, 0.1), (stress, 5e6, 0.4)):
        low, high = result.intervals[key]
        assert low < true < high and (high - low) / true < share
    assert in_joint_region(result, {alpha: 1.8e-8, stress: 5e6})
    curve = lubfric.traction(result.scene, slips[::5])
    np.testing.assert_allclose(result.predicted[::5], curve.without_rolling, rtol=2e-3)
    assert np.all(result.predicted[::5] < curve.coefficient)
    assert "do not contain rolling friction" in lubfric.explain_fit(scene, measured, {alpha: (1.2e-8, 2.8e-8)})


def test_the_correlation_of_two_parameters_is_reported_in_a_sentence(fitted):
    (first, second) = fitted.parameters
    number = fitted.covariance[0, 1] / np.prod(list(fitted.deviations.values()))
    assert 0.01 < abs(number) < 0.9
    assert f"  {first} and {second} are correlated by {number:.2f}\n" in fitted.explain()


def test_the_tolerance_that_a_fit_sets_is_its_own(tmp_path, capsys):
    """A fifth of the stated 2.9876 % is 0.6 %: the fit says so, and the scene that it writes has the 3 % of the
    user."""
    f = made_up(1, SPEEDS[::3], noise=0.0).coefficient
    rows = [f"{u:.6g},{value:.6g},{0.029876 * value:.6g}" for u, value in zip(SPEEDS[::3], f)]
    (tmp_path / "rig.csv").write_text("\n".join(["U [m/s],mu,s", *rows]))
    (tmp_path / "scene.toml").write_text(SCENE.to_toml())
    command = ["fit", str(tmp_path / "scene.toml"), "--measured", str(tmp_path / "rig.csv"), "--speed", "U"]
    command += ["--coefficient", "mu", "--deviation", "s", "--parameter", f"{FRICTION}=0.05:0.2"]
    assert main([*command, "--out", str(tmp_path / "out")]) == 0
    words = "a tolerance of 0.6 %, which it set from the noise of the data (their stated deviations)"
    assert words in " ".join(capsys.readouterr().err.split())
    assert lubfric.load_scene(tmp_path / "out" / "fitted.toml").numerics.tolerance == 0.03
    page = (tmp_path / "out" / "report.html").read_text()
    assert "relative tolerance on f 0.6 %, set by the fit from the noise of the data (numerics.tolerance: 3 %)" in page
    assert "0.597" not in page and ">tolerance = 0.03<" in page
    assert json.loads((tmp_path / "out" / "fit.json").read_text())["tolerance"] == 0.006


def test_warnings_of_a_fit_do_not_call_its_tolerance_that_of_the_scene(fitted):
    """The tolerance of 1 %, a fifth of the usual scatter, is that of no key: the scene has 3 %."""
    solved = SCENE.with_(numerics={"tolerance": 0.01})
    (by_solve,) = violations_by_numerical_error(0.02, solved.numerics.tolerance, "")
    assert "numerics.tolerance" in by_solve.text
    (text,) = replace(fitted, violations=((by_solve,),) * SPEEDS.size).validity
    assert "The fit set this limit from the noise of the data" in text and "numerics.tolerance" not in text


def test_the_true_values_are_in_the_region(fitted):
    assert (
        in_joint_region(fitted, TRUTH) and fitted.report.converged and not fitted.undetermined and not fitted.at_bounds
    )
    # an interval wider than the steps of the differences is that of curves, also of f_b
    is_wide = fitted.student * np.sqrt(np.diag(fitted.unit_covariance)) > 0.04
    assert is_wide.any() and set(fitted.profiles) == set(np.array([*BOUNDS])[is_wide])
    for key, (low, high) in fitted.intervals.items():
        assert low < TRUTH[key] < high and high / low < 1.5
    assert not in_joint_region(fitted, {**TRUTH, "lubricant.viscosity": 0.4})
    assert fitted.scene.lubricant.viscosity == pytest.approx(fitted.values["lubricant.viscosity"])
    low, high = fitted.band
    assert np.all(low < fitted.predicted) and np.all(fitted.predicted < high)


def test_a_fit_prints_as_one_line_and_draws_its_residuals(fitted):
    from matplotlib.figure import Figure

    (low, high) = fitted.intervals["lubricant.viscosity"]
    value = fitted.values["lubricant.viscosity"]
    (_, drawn) = fitted.plot_residuals(Figure().add_subplot()).lines
    order = np.argsort(drawn.get_xdata())
    miss = 100 * (fitted.measured.coefficient - fitted.predicted) / fitted.measured.coefficient
    np.testing.assert_allclose(drawn.get_ydata()[order], miss[np.argsort(fitted.measured.x)])
    assert "\n" not in repr(fitted) and f"lubricant.viscosity {value:.4g}" in repr(fitted)
    assert f"{value:.4g}, 95 % interval {low:.4g} to {high:.4g}" in repr(fitted)


@pytest.mark.parametrize(
    "arguments, words",
    [
        (([0.1, 0.2], [0.1]), "1 values for 2 of x"),
        (([0.1, 0.2], [0.1, 0.1], [0.01, 0.0]), r"deviation\[1\] = 0; allowed: > 0"),
    ],
)
def test_measured_arrays_belong_together(arguments, words):
    with pytest.raises(lubfric.InputError, match=words):
        lubfric.Measured(*map(np.array, arguments))


def test_a_fit_takes_a_scene_a_measured_curve_and_known_starts():
    measured = lubfric.Measured(np.array([0.1, 0.2, 0.3]), np.array([0.1, 0.1, 0.1]))
    for call, words in (
        (lambda: lubfric.fit(lubfric.prepare(SCENE), measured, BOUNDS), "not lubfric.prepare"),
        (lambda: lubfric.fit(SCENE, 0.1, BOUNDS), "measured = 0.1"),
        (lambda: lubfric.fit(SCENE, measured, BOUNDS, start={"bodies.load": 3.0}), "not a parameter"),
        (lambda: lubfric.fit(SCENE, measured, BOUNDS, executor=1), "executor = 1"),
    ):
        with pytest.raises(lubfric.InputError, match=words):
            call()


@pytest.mark.slow
def test_the_fit_is_a_minimum(fitted):
    """No neighbour within the bounds comes closer to the data, judged by curves of another tolerance."""

    def squares(values):
        sections = {"bodies": {}, "lubricant": {}}
        for key, value in values.items():
            section, _, name = key.partition(".")
            sections[section][name] = value
        f = lubfric.stribeck(SCENE.with_(**sections), SPEEDS, tolerance=2e-3).coefficient
        return np.sum((f / fitted.measured.coefficient - 1) ** 2)

    least = squares(fitted.values)
    for key, deviation in fitted.deviations.items():
        for sign in (-1, 1):
            assert squares(fitted.values | {key: fitted.values[key] + sign * deviation}) > least


def test_covariance_is_that_of_the_slopes(fitted):
    """Against s² (JᵀJ)⁻¹ from central differences in the parameters' own units."""
    columns = []
    for key, width in (("bodies.boundary_friction_coefficient", 0.006), ("lubricant.viscosity", 0.01)):
        section, _, name = key.partition(".")
        ends = [
            lubfric.stribeck(
                fitted.scene.with_(**{section: {name: fitted.values[key] + sign * width}}), SPEEDS, tolerance=1e-3
            ).coefficient
            for sign in (-1, 1)
        ]
        columns.append((ends[1] - ends[0]) / (2 * width) / fitted.measured.coefficient)
    slopes = np.stack(columns, axis=1)
    residuals = fitted.predicted / fitted.measured.coefficient - 1
    expected = residuals @ residuals / (SPEEDS.size - 2) * np.linalg.inv(slopes.T @ slopes)
    np.testing.assert_allclose(np.sqrt(np.diag(fitted.covariance)), np.sqrt(np.diag(expected)), rtol=0.1)
    result = fitted.correlation[0, 1]
    assert result == pytest.approx(expected[0, 1] / np.sqrt(expected[0, 0] * expected[1, 1]), abs=0.1)


@pytest.mark.slow
@pytest.mark.parametrize("noise", [0.0, 1e-9])
def test_data_that_fit_exactly_tell_nothing_of_a_parameter_without_effect(noise):
    """No film of this scene comes near such a limiting stress. What is left of the scatter is no measure of that."""
    key = "lubricant.limiting_stress_coefficient"
    scene = SCENE.with_(lubricant={"limiting_stress_coefficient": 0.5})
    curve = lubfric.stribeck(scene.with_(lubricant={"limiting_stress_coefficient": 0.4}), SPEEDS[:5]).coefficient
    exact = lubfric.Measured(SPEEDS[:5], curve * (1 + noise * np.array([1, -1, 1, 0, -1])))
    result = lubfric.fit(scene, exact, {key: (0.3, 0.6), "bodies.boundary_friction_coefficient": (0.05, 0.2)})
    assert result.undetermined == (key,) and f"the data do not determine {key}" in result.explain()
    low, high = result.intervals[key]
    assert low < 0.4 < high
    low, high = result.intervals["bodies.boundary_friction_coefficient"]
    assert low < 0.09 < high and high / low - 1 < 0.02


@pytest.mark.slow
def test_ninety_of_a_hundred_regions_hold_the_truth():
    held = sum(in_joint_region(lubfric.fit(SCENE, made_up(seed), BOUNDS, starts=0), TRUTH) for seed in range(100))
    assert held >= 90


def test_a_file_is_read_by_the_names_of_its_columns(tmp_path):
    path = tmp_path / "m.csv"
    path.write_text("# rig 3\nU [mm/s],mu (-),s\n100,0.05,0.001\n1,0.1,0.002\n")
    result = lubfric.read_measured(path, coefficient="mu (-)", speed="U [mm/s]", deviation="s")
    np.testing.assert_allclose(result.x, [1e-3, 0.1])
    np.testing.assert_allclose(result.coefficient, [0.1, 0.05])
    np.testing.assert_allclose(result.deviation, [0.002, 0.001])
    path.write_text("Rig 3; test of 2026-11-20\noil A, 70\nU;mu;T\n100;0,05;70\n1;0,1;70\n")
    result = lubfric.read_measured(path, coefficient="mu", speed="U [mm/s]")  # titles above; the unit from the call
    np.testing.assert_allclose([result.x, result.coefficient], [[1e-3, 0.1], [0.1, 0.05]])
    path.write_text("SRR [%];mu\n50;0,05\n10;0,02\n")
    result = lubfric.read_measured(path, coefficient="mu", slide_roll_ratio="SRR [%]")
    np.testing.assert_allclose(result.x, [0.1, 0.5])
    np.testing.assert_allclose(result.coefficient, [0.02, 0.05])


PREAMBLE = "Test rig 7; operator: B. Smith\nDate;2026-11-20\n\nOil: A, 70 °C\n# remark\nStep 1 of 1\n"


@pytest.mark.parametrize("units", ["mm/s;-;N", "[mm/s];[-];[N]", "(mm/s);;N", "mm/s;-;kgf/furlong"])
def test_a_line_of_units_below_the_headings(tmp_path, units):
    """Below a preamble of other widths, with decimal commas; the units are used, and not read as numbers."""
    path = tmp_path / "rig.csv"
    path.write_text(f"{PREAMBLE}Speed;mu;Load\n{units}\n1;0,1;5\n100,5;0,05;5\n", encoding="utf-8")
    measured = lubfric.read_measured(path, speed="Speed", coefficient="mu")
    np.testing.assert_allclose([measured.x, measured.coefficient], [[1e-3, 0.1005], [0.1, 0.05]])
    path.write_text(path.read_text(encoding="utf-8").replace("Speed;", "Speed [m/s];"), encoding="utf-8")
    with pytest.raises(lubfric.InputError, match="is in 'm/s' and in 'mm/s'"):
        lubfric.read_measured(path, speed="Speed", coefficient="mu")
    path.write_text("Speed;mu\nrpm;-\n1;0.1\n")
    with pytest.raises(lubfric.InputError, match="unit 'rpm' is not known"):
        lubfric.read_measured(path, speed="Speed", coefficient="mu")
    path.write_text("Speed;mu\nfast;low\n1;0.1\n")
    with pytest.raises(lubfric.InputError, match="no unit|not a number"):
        lubfric.read_measured(path, speed="Speed", coefficient="mu")


def test_a_long_preamble_and_blanks_between_columns(tmp_path):
    path = tmp_path / "rig.txt"
    rows = "  1.0      0.10   5\n  10.0     0.05   5\n"
    path.write_text(
        "".join(f"Setting {i}: value {i}\n" for i in range(300)) + "Rolling speed (mm/s)   mu (-)  F (N)\n" + rows
    )
    measured = lubfric.read_measured(path, speed="Rolling speed", coefficient="mu")
    np.testing.assert_allclose([measured.x, measured.coefficient], [[1e-3, 1e-2], [0.1, 0.05]])


@pytest.mark.parametrize("turn", ["once", "twice"])
def test_ramps_up_and_down_are_branches(tmp_path, turn):
    """Speeds may stand twice in different ramps; a fit of one number has the mean of both ramps as its answer."""
    up = [10.0, 30.0, 100.0]
    down = up[::-1] if turn == "twice" else up[-2::-1]
    f = {u: value for u, value in zip(up, (0.09, 0.07, 0.05))}
    lines = [f"{u},{f[u]}" for u in up] + [f"{u},{f[u] * 1.1}" for u in down]
    (tmp_path / "rig.csv").write_text("\n".join(["U [mm/s],mu", *lines]))
    measured = lubfric.read_measured(tmp_path / "rig.csv", speed="U [mm/s]", coefficient="mu")
    assert measured.branches == (0, 1) and measured.x.size == 3 + len(down)
    first, second = (measured.of_branch(number) for number in (0, 1))
    np.testing.assert_allclose(first.x, [0.01, 0.03, 0.1])
    np.testing.assert_allclose(second.coefficient, [1.1 * f[u] for u in sorted(down)])
    assert measured.hysteresis == pytest.approx(0.1)
    bounds = {"bodies.boundary_friction_coefficient": (0.02, 0.4)}
    assert "2 ramps of rising and falling speed: their coefficients are 10 % apart" in lubfric.explain_fit(
        SCENE, measured, bounds
    )
    (tmp_path / "dwell.csv").write_text("U [mm/s],mu\n1,0.1\n1,0.11\n2,0.1\n2,0.12\n")
    with pytest.raises(lubfric.InputError, match="twice"):
        lubfric.read_measured(tmp_path / "dwell.csv", speed="U [mm/s]", coefficient="mu")
    shuffled = [lines[i] for i in (1, 0, 2)]
    (tmp_path / "any.csv").write_text("\n".join(["U [mm/s],mu", *shuffled]))
    assert lubfric.read_measured(tmp_path / "any.csv", speed="U [mm/s]", coefficient="mu").branch is None


def test_points_of_two_ramps_at_one_speed_are_solved_once():
    speeds = np.array([0.01, 0.01, 0.1, 0.1])
    branch = np.array([0, 1] * 2)
    truth = made_up(2, speeds[::2])
    measured = lubfric.Measured(speeds, np.repeat(truth.coefficient, 2), branch=branch)
    bounds = {"bodies.boundary_friction_coefficient": (0.05, 0.2)}
    doubled = lubfric.fit(SCENE, measured, bounds, starts=0)
    single = lubfric.fit(SCENE, lubfric.Measured(speeds[::2], truth.coefficient), bounds, starts=0)
    assert doubled.values == pytest.approx(single.values, rel=0.02)
    assert doubled.predicted.size == 4 and doubled.predicted[0] == doubled.predicted[1]


@pytest.mark.parametrize("heading", ["U" + " " * 3000, "(" * 3000, "a [" * 3000, "x " * 4000 + "[m/s]", "mm/s" * 2000])
def test_headings_of_any_length_are_read_in_no_time(tmp_path, heading):
    import time

    (tmp_path / "m.csv").write_text(f"{heading},mu\n1,0.1\n2,0.1\n")
    before = time.process_time()
    with pytest.raises(lubfric.InputError):
        lubfric.read_measured(tmp_path / "m.csv", speed="U [m/s]x", coefficient="mu")
    assert (time.process_time() - before) / slowness() < 0.5


@pytest.mark.parametrize(
    "text, names, words",
    [
        ("U [m/s],mu\n1,0.1\n", {"speed": "V [m/s]", "coefficient": "mu"}, "no column 'V .m/s.' .did you mean"),
        (
            "U,mu\n1,0.1\n",
            {"speed": "U", "coefficient": "mu"},
            "names no unit; write U .m/s. in the file or in the command",
        ),
        ("a title\nU,mu\n1,0.1\n", {"speed": "V [m/s]", "coefficient": "mu"}, "no column 'V .m/s.'"),
        ("slip %,mu\n1,0.1\n", {"slide_roll_ratio": "slip %", "coefficient": "mu"}, "names % without brackets"),
        ("U [rpm],mu\n1,0.1\n", {"speed": "U [rpm]", "coefficient": "mu"}, "'rpm' is not known"),
        ("U [m/s],mu\n1,x\n", {"speed": "U [m/s]", "coefficient": "mu"}, "not a number"),
        ("U [m/s],mu\n1,0.1,3\n", {"speed": "U [m/s]", "coefficient": "mu"}, "line 2: 3 values for 2 headings"),
        ("U [m/s],mu\n1,0.1\n1,0.2\n", {"speed": "U [m/s]", "coefficient": "mu"}, "twice"),
        ("U [m/s],mu\n1,-0.1\n", {"speed": "U [m/s]", "coefficient": "mu"}, "row 1 of .*above 0"),
        ("U [m/s],mu\n1,0.1\n", {"coefficient": "mu"}, "one axis"),
    ],
)
def test_bad_files(tmp_path, text, names, words):
    (tmp_path / "m.csv").write_text(text)
    with pytest.raises(lubfric.InputError, match=words):
        lubfric.read_measured(tmp_path / "m.csv", **names)


@pytest.mark.parametrize(
    "parameters, words",
    [
        ({}, "must be a dict"),
        ({"lubricant.viscosity": 0.1}, "a pair"),
        ({"numerics.tolerance": (0.1, 0.2)}, "unknown key 'numerics' in parameters"),
        ({"motion.entrainment_speed": (0.1, 0.2)}, "is the axis of a curve"),
        ({"bodies.load": (-1.0, 2.0)}, "bodies.load"),
        ({"lubricant.temperature": (300.0, 350.0)}, "does not change a viscosity"),
    ],
)
def test_what_cannot_be_fitted_is_said_before_any_work(parameters, words):
    measured = lubfric.Measured(np.array([0.1, 0.2]), np.array([0.1, 0.1]))
    with pytest.raises(lubfric.InputError, match=words):
        lubfric.fit(SCENE, measured, parameters)
    with pytest.raises(lubfric.InputError, match="more points"):
        lubfric.fit(SCENE, measured, BOUNDS)


def test_warnings_of_the_fitted_curve_are_reported():
    """A fit to points that are no answers (accepted: f of 1000) came out without a mark."""
    scene = SCENE.with_(bodies={"load": 60.0}, lubricant={"eyring_stress": None}, numerics={"accept": True})
    speeds = np.array([0.01, 0.1])
    curve = lubfric.stribeck(scene, speeds)
    measured = lubfric.Measured(speeds, np.minimum(curve.coefficient, 1.0))
    result = lubfric.fit(scene, measured, {"lubricant.viscosity": (0.3, 0.4)}, starts=0)
    assert [bool(stated) for stated in result.violations] == [bool(curve.violations(i)) for i in range(2)]
    assert any(entry.severe for entry in result.violations[1]) and "not valid" in result.explain()


def test_a_parameter_given_twice_is_refused(capsys):
    twice = ["--parameter", "lubricant.viscosity=0.1:1", "--parameter", "lubricant.viscosity=0.1:2"]
    assert main(["fit", "paper", "--measured", "m.csv", "--coefficient", "f", "--speed", "U [m/s]", *twice]) == 2
    assert "once for each key" in capsys.readouterr().err


def test_a_short_form_is_fitted():
    """A film that clears all summits, so that f tells the slip alone: made with 50 %, found again."""
    smooth = SCENE.with_(surface={"sq": 1e-9})
    speeds = np.array([0.3, 0.5, 0.8])
    made = [lubfric.friction(smooth.with_(motion={"slip_percent": 50}), u).coefficient for u in speeds]
    result = lubfric.fit(smooth, lubfric.Measured(speeds, np.array(made)), {"motion.slip_percent": (10, 300)}, starts=0)
    assert result.values["motion.slip_percent"] == pytest.approx(50, rel=0.02)


def test_the_command_says_the_cost_first_and_writes_the_scene_that_an_executor_finds_too(
    tmp_path, capsys, monkeypatch, drawn
):
    """Progress tells misfit and values once a curve; the last are those that were found."""
    measured = made_up(3, SPEEDS[::3])
    stated = []
    lines = [f"{1e3 * u:.6g},{f:.6g}" for u, f in zip(measured.x, measured.coefficient)]
    (tmp_path / "rig.csv").write_text("\n".join(["U [mm/s],mu", *lines]))
    (tmp_path / "scene.toml").write_text(SCENE.to_toml())
    named = ["--measured", str(tmp_path / "rig.csv"), "--speed", "U [mm/s]", "--coefficient", "mu"]
    sought = ["--parameter", "lubricant.viscosity=0.05:1"]
    command = ["fit", str(tmp_path / "scene.toml"), *named, "--out", str(tmp_path / "out"), "--starts", "2"]
    assert main([*command, *sought]) == 0
    said = capsys.readouterr().err
    assert said.index("time: about") < said.index("curve 1 of about ") < said.index("95 % interval")
    assert "search by the load-sharing model, curve 1 of" in said and "by chance" not in said
    read = lubfric.read_measured(tmp_path / "rig.csv", speed="U [mm/s]", coefficient="mu")
    bounds = {"lubricant.viscosity": (0.05, 1.0)}
    with ThreadPoolExecutor(2) as executor:
        record_progress = {"on_progress": lambda *what: stated.append(what)}
        result = lubfric.fit(SCENE, read, bounds, starts=2, executor=executor, **record_progress)
    done, total, left, misfit, values = zip(*stated)
    assert done == tuple(range(1, len(stated) + 1)) and len(stated) >= 2
    assert all(n <= of for n, of in zip(done, total)) and all(
        (s > 0) == (n < of) for n, of, s in zip(done, total, left)
    )
    of_fit = np.array(misfit)[np.isfinite(misfit)]  # those of the search belong to another model and other points
    assert 0 < of_fit.size < len(misfit) and (np.diff(of_fit) <= 0).all()
    squares = result.report.residuals["sum of squares"]
    assert misfit[-1] == pytest.approx(
        np.sqrt(squares / read.x.size), rel=1e-3
    )  # what was found is the best that was shown
    assert values[-1] == pytest.approx(result.values, rel=0.02) and values[0] != values[-1]
    record = json.loads((tmp_path / "out" / "fit.json").read_text())
    fitted = lubfric.load_scene(tmp_path / "out" / "fitted.toml")
    assert record["values"] == result.values and record["starts"] == 2 and record["describes_data"]
    assert fitted.lubricant.viscosity == pytest.approx(list(result.values.values())[0])
    assert (tmp_path / "out" / "references.bib").read_text(encoding="utf-8") == f"{result.cite('bibtex')}\n"
    drawn = (tmp_path / "out" / "fit.png").read_bytes()
    assert main(["plot", str(tmp_path / "out")]) == 0 and (tmp_path / "out" / "fit.png").read_bytes() == drawn
    assert main(["plot", str(tmp_path / "out"), "--width", "85 mm", "--format", "pdf"]) == 0
    assert (tmp_path / "out" / "fit.pdf").is_file() and main(["plot", str(tmp_path / "out"), "--panels", "film"]) == 2
    assert main([*command, "--parameter", "lubricant.viscosity"]) == 2
    assert "section.key=lowest:highest" in capsys.readouterr().err
    page = (tmp_path / "out" / "report.html").read_text()
    (_, high) = result.intervals["lubricant.viscosity"]
    assert "Converged: the fit describes the data." in page and "data:image/png;base64" in page
    assert f"at most {float(f'{1e3 * high:.2g}'):.3g} mPa s, with no lower end" in page and '"key">fitted</td>' in page
    assert all(f"{f:.3g}</td>" in page for f in read.coefficient) and "by chance" not in page
    monkeypatch.setattr("lubfric.studies.points.outcome_of", None)  # all points are kept: nothing is solved again
    again = html.unescape(page.partition("<code>")[2].partition("</code>")[0])
    assert main([*shlex.split(again)[1:], "--out", str(tmp_path / "out")]) == 0
    assert json.loads((tmp_path / "out" / "fit.json").read_text())["values"] == record["values"]


def test_what_another_piece_of_the_surface_would_move_is_reported_beside_the_intervals():
    """In boundary lubrication f goes with the boundary friction coefficient, and so do their relative errors."""
    key = "bodies.boundary_friction_coefficient"
    speeds = [1e-4, 2e-4, 4e-4]
    scene = paper_scene(numerics={"sampling_tolerance": 0.1})
    points = [lubfric.friction(scene, speed) for speed in speeds]
    measured = lubfric.Measured(speeds, [p.coefficient for p in points])
    result = lubfric.fit(scene, measured, {key: (0.05, 0.2)}, starts=0)
    expected = np.mean([p.uncertainty.sampling for p in points])
    assert result.moved_by_surface[key] / result.values[key] == pytest.approx(expected, rel=0.3)
    assert "not in the intervals: another sample of the surface" in result.explain()


@pytest.mark.parametrize("stated, told", [(1.0, False), (0.1, True)])
def test_points_farther_off_than_their_deviations_say_are_reported(stated, told):
    """Points 3 % above and below in turn: with a tenth of that stated, the fit lies ten times as far off."""
    key = "bodies.boundary_friction_coefficient"
    speeds = np.geomspace(1e-3, 5e-3, 6)
    f = lubfric.stribeck(SCENE, speeds).coefficient
    off = 0.03 * f * np.array([1, -1, -1, 1, 1, -1])
    measured = lubfric.Measured(speeds, f + off, deviation=stated * np.abs(off))
    result = lubfric.fit(SCENE, measured, {key: (0.05, 0.2)}, starts=0)
    assert ("times as large as the stated deviations" in result.explain()) == told
    assert not told or "are 11 times" in result.explain()  # sqrt(6/5) of ten, one parameter


EYRING = "lubricant.eyring_stress"


def test_bounds_that_are_in_another_unit_are_questioned():
    """1 to 20 Pa for an Eyring stress, as a scene would not take it; with its unit it is stated."""
    measured = lubfric.Measured([0.1, 0.2, 0.3], [0.1, 0.1, 0.1])
    with pytest.raises(lubfric.InputError, match=r"eyring_stress'\] = 1 is read as 1 Pa; did you mean 1 MPa .*usual"):
        lubfric.explain_fit(SCENE, measured, {EYRING: (1, 20)}, starts=0)
    assert "1 Pa to 20 Pa" in lubfric.explain_fit(SCENE, measured, {EYRING: ("1 Pa", "20 Pa")}, starts=0)


def test_what_is_wrong_with_a_measured_value_is_said_with_its_place(tmp_path):
    path = tmp_path / "rig.csv"
    path.write_text("rig 7\nSRR [%];mu [-];F\n5;0.03;12\n2;0;17\n1;0.02;35\n")
    with pytest.raises(
        lubfric.InputError, match="file rig.csv, column 'mu', row 2 of its numbers: coefficient = 0; .*above 0"
    ):
        lubfric.read_measured(path, coefficient="mu", slide_roll_ratio="SRR [%]")
    with pytest.raises(
        lubfric.InputError, match="column 'F', row 3 of .* = 35; allowed: above 0, up to 2; .*force over the load"
    ):
        lubfric.read_measured(path, coefficient="F", slide_roll_ratio="SRR")
    with pytest.raises(
        lubfric.InputError, match=r"unit '%' is not known here; .*goes into slide_roll_ratio \(--ratio\)"
    ):
        lubfric.read_measured(path, coefficient="mu", speed="SRR [%]")
    with pytest.raises(lubfric.InputError, match=r"coefficient\[1\] = 40; allowed: above 0, up to 2"):
        lubfric.Measured([0.1, 0.2], [0.5, 40])


def test_a_misspelt_parameter_of_the_command_is_named_before_its_unit(tmp_path, capsys):
    (tmp_path / "rig.csv").write_text("U [m/s];mu [-]\n1;0.03\n2;0.02\n3;0.02\n")
    command = ["fit", "paper", "--measured", str(tmp_path / "rig.csv"), "--speed", "U", "--coefficient", "mu"]
    command += ["--out", str(tmp_path / "out"), "--parameter"]
    assert main([*command, "lubricant.eyring=1 MPa:20 MPa"]) == 2
    assert "did you mean 'eyring_stress'?" in capsys.readouterr().err
    assert main([*command, f"{EYRING}=1:20"]) == 2
    assert "did you mean 1 MPa" in capsys.readouterr().err


def test_the_time_left_of_a_fit_corrects_the_estimates_by_the_clock(monkeypatch):
    """Curves of the search that took three times their estimate: those of the fit, of which none is solved yet, count
    three times too; after one that took less they count as that. A curve beyond the expected ones raises their
    number."""
    fit_module = import_module("lubfric.studies.fit")
    clock = [100.0]
    monkeypatch.setattr(fit_module, "processor_time", lambda: clock[0])
    facts = {"count": 0, "spent": 0.0, "changed": 1, "solved": [np.array([0.5])], "parameters": {}}
    facts |= {"solves_differences": False, "has_executor": False}
    calls = {"misfit": lambda _: 0.1, "lowest_over_boundary_friction": lambda unit: unit}
    (coarse, fine) = [SimpleNamespace(**facts, **calls) for _ in "12"]
    estimates = {id(coarse): 2.0, id(fine): 5.0}
    monkeypatch.setattr(fit_module, "_usual_seconds", lambda kind, _: estimates[id(kind)])
    stated = []
    totals = []

    def on_progress(*what):
        totals.append(what[1])
        stated.append(what[2])

    progress = fit_module._Progress(coarse, fine, np.array([0.5]), 4, on_progress)
    (searched, fitted) = (coarse.expected, fine.expected)
    for kind, seconds in ((coarse, 6.0), (coarse, 6.0), *[(fine, 10.0)] * (fitted + 1)):
        clock[0] += seconds
        kind.count += 1
        kind.spent += 0.9 * seconds
        progress.report(kind)
    of_fit = [10 * (fitted - n) for n in range(1, fitted + 1)]
    assert stated[:-1] == pytest.approx([6 * (searched - 1) + 15 * fitted, 6 * (searched - 2) + 15 * fitted, *of_fit])
    assert totals[-1] > totals[-2] == 2 + fitted and stated[-1] == pytest.approx(10.0)  # one more than expected


FRICTION = "bodies.boundary_friction_coefficient"
WARM = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 60, "eyring_stress": 5e6}


def counting_points(monkeypatch):
    """Return the list that receives the speed of every point that is solved from now on."""
    points = import_module("lubfric.studies.points")
    solve = points.outcome_of
    solved = []

    def outcome_of(prepared, speed, **options):
        solved.append(speed)
        return solve(prepared, speed, **options)

    monkeypatch.setattr(points, "outcome_of", outcome_of)
    return solved


@cache
def curve_of_scene():
    return lubfric.stribeck(SCENE, SPEEDS)


def least_squares_of_a_line(measured):
    """Return the f_b of f = f_b F_C/F_T + film with the least sum of squared relative deviations from ``measured``, and
    F_C/F_T."""
    balanced = curve_of_scene()
    share = balanced["contact_load"] / SCENE.bodies.load
    film = balanced.coefficient - SCENE.bodies.boundary_friction_coefficient * share
    relative = share / measured.coefficient
    left = 1 - film / measured.coefficient
    return float(relative @ left) / float(relative @ relative), share


@pytest.mark.parametrize("bounds, start", [((0.05, 0.2), 0.06), pytest.param((0.01, 0.9), 0.5, marks=pytest.mark.slow)])
def test_the_boundary_friction_alone_takes_no_further_balance(monkeypatch, bounds, start):
    """f = f_b F_C/F_T + film at each point: the least squares of a line. One curve has the balances, one is the
    answer."""
    measured = made_up(1)
    (expected, share) = least_squares_of_a_line(measured)
    solved = counting_points(monkeypatch)
    result = lubfric.fit(SCENE, measured, {FRICTION: bounds}, start={FRICTION: start})
    assert len(solved) == 2 * SPEEDS.size
    assert result.values[FRICTION] == pytest.approx(expected, rel=1e-3)
    np.testing.assert_array_equal(result.predicted, lubfric.stribeck(result.scene, SPEEDS, tolerance=0.01).coefficient)
    width = result.parameters[FRICTION].slope(result.unit[0])
    np.testing.assert_allclose(result.slopes[:, 0], share * width, rtol=0.02)


def test_the_search_takes_the_best_boundary_friction_of_each_curve():
    """After one curve, which is at the start, the f_b of the lowest sum is that of a line."""
    measured = made_up(1)
    (expected, _) = least_squares_of_a_line(measured)

    class Ended(Exception):
        pass

    def on_progress(done, total, left, misfit, values):
        assert np.isnan(misfit) and values[FRICTION] == pytest.approx(expected, rel=0.01)
        assert values["lubricant.viscosity"] == pytest.approx(SCENE.lubricant.viscosity)
        raise Ended

    with pytest.raises(Ended):
        lubfric.fit(SCENE, measured, BOUNDS, start={FRICTION: 0.06}, on_progress=on_progress)


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"motion": {"slide_roll_ratio": -0.3}},
        {"lubricant": WARM, "motion": {"entrainment_speed": 0.3}},
        {"numerics": {"model": "quick"}, "motion": {"entrainment_speed": 0.003}},
    ],
    ids=["sliding", "rolling", "warm", "quick"],
)
def test_f_at_another_boundary_friction_is_that_of_solving_again(changes):
    """The slope of a fit, which comes from one balance, spans the difference of two solved curves."""
    scene = SCENE.with_(**({"numerics": {"accept": True}} | changes))
    speed = scene.motion.entrainment_speed
    speeds = [0.5 * speed, speed]
    (low, high) = [lubfric.stribeck(scene.with_keys({FRICTION: f_b}), speeds, tolerance=0.01) for f_b in (0.08, 0.16)]
    middle = lubfric.Measured(speeds, 0.5 * (low.coefficient + high.coefficient))
    result = lubfric.fit(scene, middle, {FRICTION: (0.08, 0.16)}, start={FRICTION: 0.11})
    assert np.all(low["boundary_force"] > 0)
    np.testing.assert_allclose(result.slopes[:, 0], high.coefficient - low.coefficient, rtol=0.02)
    assert result.values[FRICTION] == pytest.approx(0.12, rel=0.01)


def test_the_report_of_a_fit_that_does_not_describe_the_data_states_no_interval(tmp_path, capsys):
    f = made_up(1, noise=0.005).coefficient * np.where(SPEEDS > 0.02, 1.5, 1.0)
    rows = [f"{u:.6g},{value:.6g},{0.005 * value:.6g}" for u, value in zip(SPEEDS, f)]
    (tmp_path / "rig.csv").write_text("\n".join(["U [m/s],mu,s", *rows]))
    (tmp_path / "scene.toml").write_text(SCENE.to_toml())
    command = ["fit", str(tmp_path / "scene.toml"), "--measured", str(tmp_path / "rig.csv"), "--speed", "U"]
    command += ["--coefficient", "mu", "--deviation", "s", "--parameter", f"{FRICTION}=0.05:0.2"]
    assert main([*command, "--out", str(tmp_path / "out")]) == 0
    assert "(not valid)" in capsys.readouterr().err
    page = (tmp_path / "out" / "report.html").read_text()
    (answer, _, rest) = page.partition("<h2>Answer</h2>")[2].partition("<h2>Warnings</h2>")
    assert 'class="status failed"' in page and "The fit converged, but does not describe the data" in page
    assert (
        "at 95 %)" not in answer and "not valid</td>" in answer and "times as large as the stated deviations" in answer
    )
    assert "95 % interval</th>" in rest and rest.count("not valid</td>") == SPEEDS.size


def test_the_status_of_a_fit_names_a_large_model_form_error():
    """No interval of a parameter has it: 80 % of f are no scatter of the data."""
    measured = made_up(1, noise=0.0)
    result = lubfric.fit(SCENE, measured, {FRICTION: (0.05, 0.2)}, starts=0)
    for error, expected in ((0.05, ""), (0.8, "inexact"), (math.nan, "")):
        (kind, text) = fit_status(replace(result, model_error=np.full(SPEEDS.size, error)))
        assert kind == expected and ("do not include the model-form error of f, up to 80 %" in text) == (
            kind == "inexact"
        )


@pytest.mark.parametrize("alpha", [None, [2e-8, 1.5e-8, 2.2e-8]])
def test_a_fit_names_the_error_of_an_estimated_pressure_viscosity_coefficient(alpha):
    """In status, answer and summary; where the coefficient is given as a range, that this is not in the intervals."""
    oil = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature": "60 °C", "viscosity": None}
    scene = SCENE.with_(lubricant=oil | {"pressure_viscosity_coefficient": alpha})
    speeds = np.array([0.003, 0.03, 0.3])
    measured = lubfric.Measured(speeds, lubfric.stribeck(scene, speeds).coefficient)
    result = lubfric.fit(scene, measured, {FRICTION: (0.05, 0.2)}, starts=0)
    (_, status) = fit_status(result)
    is_estimate = alpha is None
    assert (
        "coefficient is an estimate, and its error, which also affects the fitted parameters" in status
    ) == is_estimate
    assert (
        any("give lubricant.pressure_viscosity_coefficient" in text for text in result.not_in_intervals) == is_estimate
    )
    assert ("which is an estimate and moves the fitted parameters" in result.explain()) == is_estimate
    of_range = "not in the intervals: the ranges of lubricant.pressure_viscosity_coefficient"
    assert (of_range in result.not_in_intervals) != is_estimate
