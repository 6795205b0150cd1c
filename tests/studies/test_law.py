"""A curve and a study as a formula: as close as it says, smooth and odd through rest, and the same in C."""

import ctypes
import dataclasses
import json
import math
import shutil
import subprocess

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL
from small_study import SCENE

import lubfric
from lubfric.output import main
from lubfric.studies import law_of

OIL = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70}
QUICK = (
    BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.1\n[surface]\nsq = 1e-7\ncorrelation_length = 4e-6\n"
    '[contact]\nshape = [64, 64]\nspacing = 0.9e-6\n[numerics]\nsampling = "patch"\nmodel = "paper"\n'
)
# K, N
WARM = [333.15, 353.15]
LOADS = [4.0, 8.0]


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    vary = {"lubricant.temperature": WARM, "bodies.load": LOADS}
    folder = tmp_path_factory.mktemp("law")
    lubfric.study(SCENE.with_(lubricant=OIL), vary, np.geomspace(0.02, 3.0, 8), store=folder)
    return lubfric.open_study(folder)


@pytest.fixture(scope="module")
def law(study):
    return study.law()


def by_hand(n, U, eta, p):
    """The formula in words of one's own."""
    V = math.hypot(U, n["u0"])
    e = math.log(eta / n["eta0"])
    q = math.log(p / n["p0"])
    H = V / n["U1"] * math.exp(n["a"] * e + n["c"] * q)
    share = (1 + H ** n["n"] / n["m"]) ** -n["m"] / (1 + n["r"] * H)
    film = [n[f"C{i}"] * (V / n["U0"]) ** n[f"k{i}"] * math.exp(n[f"e{i}"] * e + n[f"d{i}"] * q) for i in (1, 2)]
    return U / V * (n["b"] * share + (1 - share) * film[0] * film[1] / sum(film))


def test_it_is_as_close_to_the_points_as_it_states(study, law):
    f = study["coefficient"]
    speeds = study.coords["speed"][1]
    off = []
    for i, temperature in enumerate(WARM):
        for j, load in enumerate(LOADS):
            pressure = study.plan.scenes[2 * i + j].bodies.mean_hertz_pressure
            half_width = math.sqrt(8 * load / 6e-3 * 2e-3 / (math.pi * 231e9))
            assert pressure == pytest.approx(load / 6e-3 / (2 * half_width), rel=1e-9)
            off.append(law(speeds, temperature, pressure) / f[i, j] - 1)
    assert np.abs(off).max() <= law.largest * (1 + 1e-9) and 0 < law.rms < law.largest < 0.06


def test_between_the_points_a_solve_agrees(study, law):
    scene = SCENE.with_(lubricant=OIL, bodies={"load": 6.0})
    for speed in (0.03, 0.3, 2.0):
        solved = lubfric.friction(scene, speed).coefficient
        assert law(speed, 343.15, scene.bodies.mean_hertz_pressure) == pytest.approx(solved, rel=2 * law.largest + 0.01)


def test_it_is_odd_and_smooth_through_rest(law):
    U = np.linspace(-1.0, 1.0, 2001) * 3 * law.numbers["u0"]
    f = law(U, 343.15)
    np.testing.assert_allclose(f, -f[::-1], rtol=0, atol=1e-15)
    assert f[1000] == 0.0 and np.isfinite(f).all() and (np.diff(f) > 0).all()
    assert np.abs(np.diff(f, 2)).max() < 0.01 * np.diff(f).max()  # a kink would be a leap of the slope


def test_text_json_and_formula_say_the_same(law):
    n = (stated := json.loads(law.json))["numbers"]
    assert stated["units"] == {"U": "m/s", "T": "K", "p": "Pa"} and stated["largest"] == law.largest
    assert stated["ranges"]["temperature"] == WARM
    for U, T, p in ((0.03, 335.0, 9e7), (-0.5, 350.0, 1.2e8)):
        nu = 10**10 ** (n["A"] - n["B"] * math.log10(T))
        assert law(U, T, p) == pytest.approx(by_hand(n, U, 1e-3 * (nu - 0.7), p), rel=1e-9)
    assert f"at most {100 * law.largest:.2g} %" in law.text and "333.15 to 353.15 K" in law.text


def test_outside_it_refuses_or_extrapolates_where_requested(law):
    for given in ((4.0,), (0.1, 300.0), (0.1, 343.0, 1e9)):
        with pytest.raises(lubfric.InputError, match="allowed: .* to .*; .*extrapolate=True"):
            law(*given)
        assert np.isfinite(law(*given, extrapolate=True))


@pytest.mark.skipif(shutil.which("gcc") is None, reason="no C compiler")
def test_the_c_function_is_the_same_to_the_last_digits(law, tmp_path):
    (tmp_path / "f.c").write_text(law.c)
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-O2", "-shared", "-fPIC"]
    subprocess.run(["gcc", *flags, "-o", tmp_path / "f.so", tmp_path / "f.c", "-lm"], check=True)
    friction = ctypes.CDLL(str(tmp_path / "f.so")).friction
    friction.restype = ctypes.c_double
    friction.argtypes = [ctypes.c_double] * 3 + [ctypes.POINTER(ctypes.c_int)]
    outside = ctypes.c_int(-1)
    for at in ((0.0, 343.0, 1e8, 0), (0.03, 335.0, 1e8, 0), (-2.0, 350.0, 1e8, 0), (9.0, 300.0, 1e9, 7)):
        result = friction(*at[:3], ctypes.byref(outside))
        assert result == pytest.approx(law(*at[:3], extrapolate=True), rel=1e-12) and outside.value == at[3]
    assert math.isfinite(friction(0.1, 343.0, 1e8, None))


def test_a_curve_has_a_law_at_its_own_temperature_and_pressure():
    curve = lubfric.stribeck(SCENE, np.geomspace(0.02, 3.0, 8))
    law = curve.law()
    assert np.abs(law(curve.speed) / curve.coefficient - 1).max() <= law.largest * (1 + 1e-9) < 0.06
    assert "T is not given and changes nothing" in law.text and law.ranges["pressure"][0] == law.ranges["pressure"][1]


def test_of_smooth_bodies_in_a_fluid_too_thin_for_the_law_of_its_viscosity():
    """At one temperature that law is not needed."""
    fluid = {"viscosity": 2e-4, "viscosity_law": "constant", "temperature": 300.0, "temperature_coefficient": 0.01}
    scene = SCENE.with_(lubricant=fluid, surface={"sq": 0.0}, numerics={"heat": "off", "accept": True})
    curve = lubfric.stribeck(scene, np.geomspace(0.1, 3.0, 12))
    law = curve.law()
    assert np.abs(law(curve.speed) / curve.coefficient - 1).max() <= law.largest * (1 + 1e-9) < 0.06
    both = [((T, 2e-4, 0.01, 1e8), curve._curve) for T in (300.0, 320.0)]
    with pytest.raises(lubfric.InputError, match="viscosity = 0.0002 Pa s is too thin"):
        law_of(scene, both, curve.coefficient, *curve.uncertainty.interval.T, curve.uncertainty.model)


def test_slower_than_its_points_it_has_no_more_friction_than_the_asperity_contacts():
    """From twelve speeds at which the film carries most, down to rest: the bodies alone would give f_b. It falls there
    as slowly as the curve that was solved at those speeds."""
    scene = SCENE.with_(bodies={"boundary_friction_coefficient": 0.12})
    curve = lubfric.stribeck(scene, np.geomspace(0.03, 0.3, 12))
    table = {"temperature": [300.0, 400.0], "values": [0.12, 0.9]}
    hot = scene.with_(bodies={"boundary_friction_coefficient": table}, lubricant={"viscosity": 0.1, "temperature": 400})
    known = curve.coefficient, *curve.uncertainty.interval.T, curve.uncertainty.model
    for law in (law_of(hot, [((300.0, 0.1, 0.01, 1e8), curve._curve)], *known), curve.law()):
        below = law(np.geomspace(1e-5, 0.03, 200))
        assert below.max() < 1.1 * 0.12 + 1e-9 and law(0.03) > 0.02
    assert law(0.01) == pytest.approx(lubfric.friction(scene, 0.01).coefficient, rel=0.3)


def test_what_it_cannot_hold_is_refused(study):
    with pytest.raises(lubfric.InputError, match="solve more speeds, or speeds='auto'"):
        lubfric.stribeck(SCENE, [0.02, 0.1, 3.0]).law()
    with pytest.raises(lubfric.InputError, match="varies surface.sq as well"):
        lubfric.study(SCENE, {"surface.sq": [1e-7, 2e-7]}, [1.0]).law()


def test_a_law_states_the_errors_of_its_points_and_refuses_points_without_a_digit():
    """Of 40 % below f and 20 % above it the larger, as the answer states; a numerical error of 30 % is too large."""
    curve = lubfric.stribeck(SCENE, np.geomspace(0.02, 3.0, 8))

    def with_errors(point, numerical):
        interval = (0.6 * point.coefficient, 1.2 * point.coefficient)
        known = dataclasses.replace(point.uncertainty, numerical=numerical, model=0.01, interval=interval)
        return dataclasses.replace(point, uncertainty=known)

    points = tuple(with_errors(point, 0.19) for point in curve.points)
    law = dataclasses.replace(curve, points=points).law()
    assert "95 % intervals of up to 40 %" in law.error_in_words and law.error_in_words in law.c.split("*/")[0]
    points = (*points[:3], with_errors(points[3], 0.3), *points[4:])
    with pytest.raises(lubfric.InputError, match="numerical error of f at .* is 30 %"):
        dataclasses.replace(curve, points=points).law()


def test_a_law_that_misses_its_own_points_has_a_warning_before_all_else(law):
    """In its text, in C and in JSON; one within the limit states its error without a warning."""
    poor = dataclasses.replace(law, largest=0.72)
    assert "warning" not in law.text and law.error_in_words in law.c.split("*/")[0] and law.warning == ""
    for limit, has_warning in ((0.1, False), (0.1001, True)):
        assert bool(dataclasses.replace(law, largest=limit).warning) == has_warning
    assert poor.warning.startswith("warning: the formula deviates by up to 72 % from the solved curves, above 10 %.")
    assert poor.c.splitlines()[2] == f" *   {poor.warning}" and json.loads(poor.json)["warning"] == poor.warning


def test_the_command_states_the_error_of_the_law_that_it_writes(law, tmp_path, monkeypatch, capsys):
    scene = tmp_path / "scene.toml"
    scene.write_text(QUICK)
    for largest, words in (
        (0.72, "warning: the formula deviates by up to 72 %"),
        (0.03, "at most 3 % from the solved"),
    ):
        written = dataclasses.replace(law, largest=largest)
        monkeypatch.setattr(lubfric.StribeckResult, "law", lambda _, written=written: written)
        assert main(["run", str(scene), "--speeds", "0.05,0.1,0.2", "--out", str(tmp_path / "out")]) == 0
        assert words in " ".join(capsys.readouterr().err.split("formula of the curve (law.json, law.c): ")[1].split())
        assert ("The formula deviates by up to 72 %" in (tmp_path / "out" / "report.html").read_text()) == (
            largest > 0.1
        )
