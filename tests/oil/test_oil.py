"""Oils against the standards' numbers and an independent package's; measured oils are a part of the verification."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

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


@pytest.mark.parametrize("nu40, nu100, index", INDICES)
def test_viscosity_index_both_ways(nu40, nu100, index):
    assert oil.viscosity_index(nu40 * MM2, nu100 * MM2) == pytest.approx(index, abs=1e-9)
    assert oil.viscosity_at_100(nu40 * MM2, index) == pytest.approx(nu100 * MM2, rel=1e-9)


def test_viscosity_index_above_the_table():
    nu100 = 80.0
    low = 0.8353 * nu100**2 + 14.67 * nu100 - 216
    high = 0.1684 * nu100**2 + 11.85 * nu100 - 97
    assert oil.viscosity_index(low * MM2, nu100 * MM2) == pytest.approx(0, abs=1e-9)
    assert oil.viscosity_index(high * MM2, nu100 * MM2) == pytest.approx(100, abs=1e-9)
    assert oil.viscosity_index(0.5 * (low + high) * MM2, nu100 * MM2) == pytest.approx(50, abs=1e-9)
    below, above = (oil.viscosity_index(2500 * MM2, nu * MM2) for nu in (70, 70.0001))
    assert above == pytest.approx(below, abs=0.1)  # formulas and table meet


def test_d341_has_the_constant_0_7():
    result = oil.from_viscosities(68 * MM2, 8.6 * MM2)
    assert result.kinematic_viscosity(333.15) == pytest.approx(28.49e-6, abs=0.005e-6)


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


def test_given_coefficient_is_used_and_has_no_estimate():
    made = oil.from_grade("VG 100", 95, alpha=2.2e-8)
    result = made.pressure_viscosity_coefficient(340.0)
    assert result.value == result.low == result.high == 2.2e-8
    assert made.other_estimate(340.0) is None
    both = oil.from_grade("VG 100", 95)
    assert both.other_estimate(313.15).value / both.pressure_viscosity_coefficient(313.15).value == pytest.approx(
        0.67, abs=0.02
    )


def test_named_oils_are_those_of_their_title():
    for name in oil.OILS:
        made = oil.named_oil(name)
        assert f"VI {made.index:.0f}" in made.name
        grade = made.name.split("ISO VG ")[1].split(",")[0] if "ISO VG" in made.name else "100"
        assert oil.grade_viscosity(grade) == pytest.approx(made.kinematic_viscosity(313.15), rel=0.1)


@pytest.mark.parametrize(
    "call, words",
    [
        (lambda: oil.viscosity_index(68, 8.6), "did you mean .*mm²/s"),
        (lambda: oil.viscosity_index(8.6e-6, 68e-6), "swapped"),
        (lambda: oil.viscosity_index(5e-6, 1.5e-6), "not defined"),
        (lambda: oil.from_viscosities(68, 8.6), "did you mean .*mm²/s"),
        (lambda: oil.from_viscosities(8.6e-6, 68e-6), "swapped"),
        (lambda: oil.from_grade("SAE 30", 95), "SAE grade is not .* give nu40 and nu100"),
        (lambda: oil.from_grade("5W-30", 160), "SAE grade is not .* give nu40 and nu100"),
        (lambda: oil.named_oil("75w90"), "is not known; .* SAE grade is not .* give nu40 and nu100"),
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
