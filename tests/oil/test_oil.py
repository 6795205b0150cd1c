"""Oils against the standards' numbers, an independent package's and measured oils."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import lubfric
from lubfric import oil
from lubfric.errors import InputError

MM2 = 1e-6
# nu40, nu100 [mm²/s], index unrounded by the package chemicals 1.5.2 (ASTM D2270)
INDICES = [
    (73.3, 8.86, 92.42964724534282),
    (22.83, 5.05, 156.423482932578),
    (30, 4.24, -25.579322638146085),
    (30, 5.23, 104.70013349595683),
    (120, 8, -49.504950495049506),
    (70, 11.1, 150.18753158026385),
    (68, 8.6, 96.79460143399413),
]
# D341: m, n -> nu [mm²/s] at 40, 70, 100 °C
LAWS = [
    (9.5259, 3.7449, 31.81, 11.14, 5.385),
    (9.2479, 3.5849, 99.14, 26.86, 10.954),
    (8.8178, 3.3852, 217.98, 51.38, 18.915),
    (7.4846, 2.8510, 218.06, 62.80, 25.577),
    (6.5834, 2.4898, 218.78, 72.49, 31.906),
]
# Stachowiak & Batchelor, Engineering Tribology, Table 2.3: eta [mPa s] and alpha [1/GPa] at 30, 60, 100 °C
MEASURED = {
    "light machine oil, high index": ((38, 12.1, 5.3), (None, 18.4, 13.4)),
    "heavy machine oil, high index": ((153, 34, 9.1), (23.7, 20.5, 15.8)),
    "heavier machine oil, high index": ((250, 50.5, 12.6), (25.0, 21.3, 17.6)),
    "cylinder oil, high index": ((810, 135, 26.8), (34, 28, 22)),
    "spindle oil, medium index": ((18.6, 6.3, 2.4), (20, 16, 13)),
    "light machine oil, medium index": ((45, 12, 3.9), (28, 20, 16)),
    "white oil, medium index": ((107, 23.3, 6.4), (29.6, 22.8, 17.8)),
    "heavy machine oil, medium index": ((122, 26.3, 7.3), (27.0, 21.6, 17.5)),
    "heavier machine oil, medium index": ((171, 31, 7.5), (28, 23, 18)),
    "spindle oil, low index": ((30.7, 8.6, 3.1), (25.7, 20.3, 15.4)),
    "heavy machine oil, low index": ((165, 30.0, 6.8), (33.0, 23.8, 16.0)),
    "heavier machine oil, low index": ((310, 44.2, 9.4), (34.6, 26.3, 19.5)),
    "cylinder oil, low index": ((2000, 180, 24), (41.5, 29.4, 25.0)),
}
MEASURED_AT = (303.15, 333.15, 373.15)


@pytest.mark.parametrize("nu40, nu100, index", INDICES)
def test_viscosity_index_both_ways(nu40, nu100, index):
    assert oil.viscosity_index(nu40 * MM2, nu100 * MM2) == pytest.approx(index, abs=1e-9)
    assert oil.viscosity_at_100(nu40 * MM2, index) == pytest.approx(nu100 * MM2, rel=1e-9)


def test_viscosity_index_above_the_table():
    nu100 = 80.0
    low, high = 0.8353 * nu100**2 + 14.67 * nu100 - 216, 0.1684 * nu100**2 + 11.85 * nu100 - 97
    assert oil.viscosity_index(low * MM2, nu100 * MM2) == pytest.approx(0, abs=1e-9)
    assert oil.viscosity_index(high * MM2, nu100 * MM2) == pytest.approx(100, abs=1e-9)
    assert oil.viscosity_index(0.5 * (low + high) * MM2, nu100 * MM2) == pytest.approx(50, abs=1e-9)
    below, above = (oil.viscosity_index(2500 * MM2, nu * MM2) for nu in (70, 70.0001))
    assert above == pytest.approx(below, abs=0.1)  # formulas and table meet


def test_viscosity_index_by_another_package():
    chemicals = pytest.importorskip("chemicals")
    rng = np.random.default_rng(3)
    for nu100 in np.exp(rng.uniform(math.log(2), math.log(200), 300)):
        nu40 = nu100 * rng.uniform(2, 20)
        expected = chemicals.viscosity_index(nu40 * MM2, nu100 * MM2)
        assert oil.viscosity_index(nu40 * MM2, nu100 * MM2) == pytest.approx(expected, rel=1e-9, abs=1e-9)


@given(st.floats(2.1, 60), st.floats(3, 15))
def test_viscosity_at_100_inverts_the_index(nu100, ratio):
    index = oil.viscosity_index(nu100 * ratio * MM2, nu100 * MM2)
    if -200 < index < 400:
        assert oil.viscosity_at_100(nu100 * ratio * MM2, index) == pytest.approx(nu100 * MM2, rel=1e-8)


@pytest.mark.parametrize("m, n, at_40, at_70, at_100", LAWS)
def test_d341(m, n, at_40, at_70, at_100):
    law = oil.Walther(m, n)
    for celsius, nu in ((40, at_40), (70, at_70), (100, at_100)):  # the numbers are rounded to 4 digits
        assert law(celsius + 273.15) == pytest.approx(nu * MM2, rel=6e-4)
    made = oil.from_viscosities(at_40 * MM2, at_100 * MM2)
    assert made.kinematic_viscosity(313.15) == pytest.approx(at_40 * MM2, rel=1e-12)
    assert made.kinematic_viscosity(343.15) == pytest.approx(at_70 * MM2, rel=3e-4)


def test_d341_has_the_constant_0_7():
    assert oil.from_viscosities(68 * MM2, 8.6 * MM2).kinematic_viscosity(333.15) == pytest.approx(
        28.49e-6, abs=0.005e-6
    )


@given(st.floats(0.3, 50), st.floats(1.05, 8), st.floats(320, 400))
def test_d341_passes_its_points(nu, ratio, warm):
    law = oil.walther((300.0, nu * ratio * MM2), (warm, nu * MM2))
    assert law(300.0) == pytest.approx(nu * ratio * MM2, rel=1e-9)
    assert law(warm) == pytest.approx(nu * MM2, rel=1e-9)


def test_table_is_d341_between_its_points_and_ends_there():
    whole = oil.from_viscosities(100 * MM2, 11 * MM2)
    temperatures = [290.0, 313.15, 350.0, 373.15]
    table = oil.from_table(temperatures, [whole.kinematic_viscosity(t) for t in temperatures])
    for t in (290.0, 300.0, 333.0, 373.15):
        assert table.kinematic_viscosity(t) == pytest.approx(whole.kinematic_viscosity(t), rel=1e-10)
        assert table.temperature_coefficient(t) == pytest.approx(whole.temperature_coefficient(t), rel=1e-3)
    with pytest.raises(InputError, match="290"):
        table.kinematic_viscosity(280.0)


def test_density_and_dynamic_viscosity():
    made = oil.from_grade("ISO VG 68", 95, density=870)
    assert made.density_at(288.15) == 870
    assert made.density_at(343.15) == pytest.approx(870 - 55 * 0.64)
    assert made.viscosity(343.15) == made.kinematic_viscosity(343.15) * made.density_at(343.15)
    assert made.with_(density_slope=0.0).density_at(343.15) == 870
    assert made.index == pytest.approx(95, abs=1e-6)
    slope = (math.log(made.viscosity(343.15)) - math.log(made.viscosity(342.15))) / -1.0
    assert made.temperature_coefficient(342.65) == pytest.approx(slope, rel=1e-4)


def test_published_coefficients():
    law = oil.Walther(9.2479, 3.5849)
    for temperature, so, gold, density in ((313.15, 28.0, 18.8, 870), (343.15, 21.0, 15.65, 851)):
        nu = law(temperature)
        assert oil.so_klaus(nu, 3.5849, density).value * 1e9 == pytest.approx(so, abs=0.06)
        assert oil.gold(nu, "mineral").value * 1e9 == pytest.approx(gold, abs=0.06)
    assert oil.gold(51.38 * MM2, "mineral").value * 1e9 == pytest.approx(17.1, abs=0.05)
    assert oil.gold(100 * MM2, "pao").value * 1e9 == pytest.approx(7.382 * 100**0.1335)
    assert oil.gold(100 * MM2, "ester").value * 1e9 == pytest.approx(6.605 * 100**0.1360)
    assert oil.gold(204 * MM2, "polyglycol").low * 1e9 <= 17.6 <= oil.gold(204 * MM2, "polyglycol").high * 1e9


@pytest.mark.parametrize("name", MEASURED)
@pytest.mark.parametrize("estimate", ["so-klaus", "gold"])
def test_measured_oils_lie_within_the_stated_uncertainty(name, estimate):
    eta, alpha = MEASURED[name]
    density = [875 - 0.64 * (t - 288.15) for t in MEASURED_AT]
    made = oil.from_table(MEASURED_AT, [e / 1000 / r for e, r in zip(eta, density)], density=875, estimate=estimate)
    for temperature, measured in zip(MEASURED_AT, alpha):
        found = made.pressure_viscosity_coefficient(temperature)
        if measured is not None:
            assert found.low <= measured * 1e-9 <= found.high, found.text


def test_given_coefficient_is_used_and_has_no_estimate():
    made = oil.from_grade("VG 100", 95, alpha=2.2e-8)
    found = made.pressure_viscosity_coefficient(340.0)
    assert found.value == found.low == found.high == 2.2e-8
    assert made.other_estimate(340.0) is None
    both = oil.from_grade("VG 100", 95)
    assert both.other_estimate(313.15).value / both.pressure_viscosity_coefficient(313.15).value == pytest.approx(
        0.67, abs=0.02
    )


def test_named_oils_are_those_of_their_title():
    for name in oil.OILS:
        made = oil.named_oil(name)
        assert f"VI {made.index:.0f}" in made.name
        assert oil.grade_viscosity(made.name.split("ISO VG ")[1].split(",")[0]) == pytest.approx(
            made.kinematic_viscosity(313.15), rel=0.1
        )


@pytest.mark.parametrize(
    "call, words",
    [
        (lambda: oil.viscosity_index(68, 8.6), "mm²/s were meant"),
        (lambda: oil.viscosity_index(8.6e-6, 68e-6), "swapped"),
        (lambda: oil.viscosity_index(5e-6, 1.5e-6), "not defined"),
        (lambda: oil.from_viscosities(68, 8.6), "mm²/s were meant"),
        (lambda: oil.from_viscosities(8.6e-6, 68e-6), "swapped"),
        (lambda: oil.from_grade("SAE 30", 95), "SAE grade"),
        (lambda: oil.from_grade("ISO VG 70", 95), "46, 68, 100"),
        (lambda: oil.from_grade("ISO VG 5", 95), "kinematic viscosities at 40 and 100"),
        (lambda: oil.from_grade("ISO VG 68", 95).viscosity(70), "343.15 K"),
        (lambda: oil.from_grade("ISO VG 68", 95, density=0.87), "kg/m³"),
        (lambda: oil.from_grade("ISO VG 68", 95, base="mineralic"), "'mineral'"),
        (lambda: oil.from_grade("ISO VG 68", 95, base="pao", estimate="so-klaus"), "'gold'"),
        (lambda: oil.named_oil("mineral-101"), "mineral-100"),
        (lambda: oil.from_table([300, 310], [1e-5]), "as many"),
    ],
)
def test_slips_are_answered(call, words):
    with pytest.raises(InputError, match=words):
        call()


def test_reached_from_the_package():
    import subprocess
    import sys

    code = (
        "import lubfric, sys; assert 'scipy' not in sys.modules; print(lubfric.oil.viscosity_index(73.3e-6, 8.86e-6))"
    )
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert float(shown) == pytest.approx(92.43, abs=0.01)
    assert "oil" in dir(lubfric)


def test_the_command_lists_them(capsys):
    from lubfric.output import main

    assert main(["oils"]) == 0
    listed = capsys.readouterr().out
    assert all(name in listed for name in oil.OILS)


def test_an_array_of_temperatures_gives_the_values_of_each():
    sample = oil.from_viscosities(68e-6, 8.6e-6)
    temperatures = np.array([[313.15, 343.15], [353.15, 373.15]])
    for quantity in (sample.kinematic_viscosity, sample.density_at, sample.viscosity):
        assert quantity(temperatures).tolist() == [[quantity(t) for t in row] for row in temperatures.tolist()]
    assert sample.kinematic_viscosity([313.15, 373.15]) == pytest.approx([68e-6, 8.6e-6], rel=1e-9)


@pytest.mark.parametrize("bad", ([313.15, 40.0], [], [np.nan], ["300"]))
def test_an_array_with_one_bad_temperature_is_refused(bad):
    with pytest.raises(InputError, match="temperature"):
        oil.from_viscosities(68e-6, 8.6e-6).kinematic_viscosity(bad)
