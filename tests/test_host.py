"""Nothing depends on the state of the host (decimal context, NumPy's handling of errors, ``python -O``), and nothing
changes it; numbers of any kind are the number that they are."""

import contextlib
import decimal
import inspect
import subprocess
import sys
import threading
import tomllib
import warnings
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import lubfric
from lubfric import InputError
from lubfric._base import with_default_errors

PAPER = {"contact": {"shape": (96, 96)}, "numerics": {"model": "paper", "sampling": "patch", "tolerance": 0.05}}


@pytest.fixture
def rough():
    return lubfric.generate_surface((64, 48), 0.5e-6, sq=80e-9, correlation_length=3e-6, acf="gaussian", seed=1)


def test_the_decimal_context_of_the_host_changes_nothing():
    scene = lubfric.load_scene("paper")
    lengths = [scene.with_(bodies={"radius": text}).bodies.radius for text in ("12.345678 mm", "1.23e-2 m")]
    oil = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature": "81.25 °C"}
    warm = lubfric.load_scene(_with_oil(oil)).lubricant.temperature
    with decimal.localcontext(prec=3) as context:
        context.traps[decimal.Inexact] = True
        context.traps[decimal.Rounded] = True
        context.Emax = 5
        again = [scene.with_(bodies={"radius": text}).bodies.radius for text in ("12.345678 mm", "1.23e-2 m")]
        assert again == lengths == [0.012345678, 0.0123]
        assert lubfric.load_scene(_with_oil(oil)).lubricant.temperature == warm == 354.4
        assert decimal.getcontext().prec == 3


def answers(rough, folder):
    """Numbers of every public function that computes quickly."""
    scene = lubfric.load_scene("paper").with_(**PAPER)
    np.save(folder / "map.npy", rough.heights)
    read = lubfric.read_surface(folder / "map.npy", spacing=0.5e-6)
    worn = lubfric.run_in(scene, passes=1)
    contact = lubfric.solve_contact(-rough.heights, 0.5e-6, 1e11, mean_pressure=1e8)
    return [
        lubfric.friction(scene, 0.03).coefficient,
        *lubfric.stribeck(scene, [0.01, 0.1]).coefficient,
        *lubfric.traction(scene, [0.02, 0.2], speed=0.03).coefficient,
        read.sq,
        read.filtered(s=3e-6, l=15e-6).sq,
        read.without_outliers().sq,
        read.resampled(spacing=1e-6).sq,
        read.periodic().patch((40, 40)).combined(read.cropped((40, 40))).ssk,
        lubfric.generate_surface((64, 64), 1e-6, sq=1e-7, correlation_length=6e-6, seed=2).sq,
        worn.surface.sq,
        contact.pressure.max(),
        lubfric.oil.from_grade("ISO VG 68", 95).viscosity(343.15),
        lubfric.load_scene(
            _with_oil({"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 80})
        ).lubricant.viscosity,
    ]


def test_a_host_that_raises_at_every_underflow_gets_the_same_numbers(rough, tmp_path):
    expected = answers(rough, tmp_path)
    before = np.geterr()
    with np.errstate(all="raise"):
        assert answers(rough, tmp_path) == expected
    assert np.geterr() == before


def sets_numpys_errors(function):
    """Whether a function, or what it wraps, is one of `with_default_errors`."""
    while function is not None:
        code = getattr(function, "__code__", None)
        if code is not None and code is WRAPPER:
            return True
        function = getattr(function, "__wrapped__", None)
    return False


WRAPPER = with_default_errors(lambda: None).__code__


def test_every_public_function_sets_numpys_errors():
    """All doors of the package; and a door without the decorator is noticed."""
    functions = {name: getattr(lubfric, name) for name in lubfric.__all__}
    doors = {name: door for name, door in functions.items() if inspect.isfunction(door)}
    assert len(doors) > 15 and [name for name, door in doors.items() if not sets_numpys_errors(door)] == []
    assert not sets_numpys_errors(lubfric.friction.__wrapped__.__wrapped__)

    @with_default_errors
    def door():
        return np.geterr()["under"]

    with np.errstate(all="raise"):
        assert door() == "ignore" and door.__wrapped__() == "raise"


def test_all_attributes_of_results_bear_a_host_that_raises(rough):
    """Attributes and methods without arguments of whatever the doors return: an InputError at most."""
    scene = lubfric.load_scene("paper").with_(**PAPER)
    results = [
        lubfric.prepare(scene),
        lubfric.friction(scene, 0.03, fields=True),
        lubfric.stribeck(scene, [0.01, 0.03, 0.1]),
        lubfric.traction(scene, [0.02, 0.2], speed=0.03),
        lubfric.study(scene, {"bodies.load": [4.0, 5.0]}, [0.03, 0.1]),
        lubfric.run_in(scene, passes=1),
        lubfric.solve_contact(-rough.heights, 0.5e-6, 1e11, mean_pressure=1e8),
        lubfric.oil.from_grade("ISO VG 68", 95),
        rough,
        scene,
        scene.bodies,
        scene.lubricant,
    ]
    count = 0
    for result in results:
        for name in dir(type(result)):
            member = inspect.getattr_static(type(result), name)
            takes = list(inspect.signature(member).parameters.values())[1:] if inspect.isfunction(member) else []
            if name.startswith("__") or name == "plot" or any(p.default is p.empty for p in takes):
                continue
            with np.errstate(all="raise"), contextlib.suppress(InputError, AttributeError):
                value = getattr(result, name)
                if inspect.isfunction(member):
                    value()
            count += 1
    assert count > 100


def test_reading_maps_in_threads_leaves_the_filters_of_warnings(rough, tmp_path):
    np.save(tmp_path / "map.npy", rough.heights)
    np.savetxt(tmp_path / "map.txt", rough.heights)
    before = list(warnings.filters)

    def read():
        for _ in range(20):
            for name in ("map.npy", "map.txt"):
                lubfric.read_surface(tmp_path / name, spacing=0.5e-6)

    threads = [threading.Thread(target=read) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert list(warnings.filters) == before


def _with_oil(oil):
    """The tables of the built-in scene, with another oil."""
    return tomllib.loads(lubfric.load_scene("paper").to_toml()) | {"lubricant": oil}


KINDS = [Decimal, Fraction, np.longdouble, np.float32, np.float64, lambda v: np.array(v)]
WHOLE = [np.int8, np.int16, np.uint8, np.int64, np.uint64]


@pytest.mark.parametrize("kind", KINDS)
def test_a_number_of_any_kind_is_its_value(kind, rough):
    """Once converted where it enters: the answers are those of the float."""
    scene = lubfric.load_scene("paper").with_(**PAPER)
    load = kind(5.5)
    speed = kind(0.03125)
    value = float(speed)
    assert lubfric.friction(scene.with_(bodies={"load": load}), speed).coefficient == (
        lubfric.friction(scene.with_(bodies={"load": 5.5}), value).coefficient
    )
    changed = scene.with_(
        surface={"sq": kind(2.0**-23), "correlation_length": [kind(2.0**-17), kind(2.0**-17)]},
        numerics={"tolerance": kind(2.0**-10)},
        lubricant={"eyring_stress": kind(2.0**22)},
        motion={"slide_roll_ratio": kind(0.5)},
    )
    assert lubfric.load_scene(_tables(changed)) == changed
    for number in (changed.surface.sq, changed.numerics.tolerance, changed.lubricant.eyring_stress):
        assert type(number) is float
    curve = lubfric.stribeck(scene, [speed, kind(0.125)])
    assert curve.speed.tolist() == [value, 0.125]
    assert lubfric.traction(scene, [kind(0.25)], speed=speed).ratio.tolist() == [0.25]
    assert rough.scaled(sq=kind(2.0**-23)).sq == pytest.approx(2.0**-23)
    assert lubfric.Surface(rough.heights, kind(2.0**-20)).spacing == (2.0**-20, 2.0**-20)
    assert rough.filtered(s=kind(2.0**-18)).sq == rough.filtered(s=2.0**-18).sq
    given = lubfric.generate_surface(
        (64, 64), kind(2.0**-20), sq=kind(2.0**-23), correlation_length=kind(2.0**-18), seed=1
    )
    plain = lubfric.generate_surface((64, 64), 2.0**-20, sq=2.0**-23, correlation_length=2.0**-18, seed=1)
    assert np.array_equal(given.heights, plain.heights)
    with pytest.raises(InputError, match="load"):
        scene.with_(bodies={"load": kind(-1.0)})


def _tables(scene):
    return tomllib.loads(scene.to_toml())


@pytest.mark.parametrize("kind", WHOLE)
def test_a_whole_number_of_any_kind_is_its_value(kind, rough):
    scene = lubfric.load_scene("paper").with_(**PAPER)
    assert scene.with_(bodies={"load": kind(5)}) == scene.with_(bodies={"load": 5})
    made = lubfric.generate_surface((kind(64), kind(64)), 1e-6, sq=1e-7, correlation_length=4e-6, seed=kind(3))
    assert np.array_equal(
        made.heights, lubfric.generate_surface((64, 64), 1e-6, sq=1e-7, correlation_length=4e-6, seed=3).heights
    )
    assert scene.with_(contact={"shape": (kind(100), kind(100))}).contact.shape == (100, 100)
    assert rough.cropped((kind(20), kind(20))).shape == (20, 20)
    assert lubfric.friction(scene.with_(bodies={"load": kind(5)}), kind(1)).coefficient == (
        lubfric.friction(scene.with_(bodies={"load": 5}), 1).coefficient
    )


@pytest.mark.parametrize("value", [Decimal("1e999"), Decimal("NaN"), Decimal("sNaN"), Fraction(10**400), "1e999 mm"])
def test_a_number_that_no_float_holds_is_refused_with_its_name(value):
    with pytest.raises(InputError, match="bodies.radius"):
        lubfric.load_scene("paper").with_(bodies={"radius": value})


def test_a_decimal_comma_is_named():
    scene = lubfric.load_scene("paper")
    with pytest.raises(InputError, match="write a point in decimals"):
        scene.with_(bodies={"radius": "1,5 mm"})


def test_truth_values_are_no_range():
    for value in ([0.09, False, True], [False, True], [True, 0.1], [0.08, 0.07, True]):
        with pytest.raises(InputError, match="boundary_friction_coefficient"):
            lubfric.load_scene("paper").with_(bodies={"boundary_friction_coefficient": value})


@pytest.mark.slow
def test_optimised_python_computes_the_same(tmp_path):
    """``python -O`` leaves out what stands in an assert."""
    (tmp_path / "in_time.toml").write_text(
        lubfric.load_scene("paper").to_toml() + "\n[transient]\nduration = 0.1\n"
        "speed = {kind = 'ramp', start = 0.01, end = 0.02, until = 0.1}\n"
    )
    for scene in ("paper", str(tmp_path / "in_time.toml")):
        stated = [
            subprocess.run([sys.executable, *flags, "-m", "lubfric", "info", scene], capture_output=True, text=True)
            for flags in ([], ["-O"])
        ]
        assert [run.returncode for run in stated] == [0, 0], stated[1].stderr
        assert len(stated[0].stdout.splitlines()) == len(stated[1].stdout.splitlines())


def test_a_number_with_a_unit_of_any_length_is_read_in_no_time():
    import time

    scene = lubfric.load_scene("paper")
    for text in (
        "1 " + " " * 50000 + "mm x",
        "1" * 50000 + " mm.",
        "1e" + "1" * 50000,
        "1 " + "mm " * 20000,
        " " * 90000,
    ):
        before = time.process_time()
        with pytest.raises(InputError, match="bodies.radius"):
            scene.with_(bodies={"radius": text})
        assert time.process_time() - before < 0.3


def test_speeds_with_a_decimal_comma_are_refused(capsys):
    from lubfric.output import main

    assert main(["info", "paper", "--speeds", "1,5 mm/s"]) == 2
    assert "'1.5 mm/s', or for two values '1 mm/s, 5 mm/s'" in capsys.readouterr().err
    assert main(["info", "paper", "--speeds", "1 mm/s,5 mm/s"]) == 0
