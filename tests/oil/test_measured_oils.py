"""Oils with printed data, steels by name, and what a misspelt name or a wrong unit is told."""

import math

import pytest

import lubfric
from lubfric import InputError, oil

PAPER = lubfric.load_scene("paper")
# mm²/s at 40 and 100 °C, kg/m³ at 15.6 °C, alpha at 40, 60, 80, 100 °C in 1/GPa (Arana et al. 2019), typed again
PRINTED = {
    "FVA 3": (96.0, 10.6, 882.0, (20.9, 19.1, 17.5, 16.3)),
    "naphthenic-98": (97.9, 8.61, 900.0, (27.3, 22.9, 19.8, 17.4)),
    "pao-94": (94.1, 14.0, 840.0, (15.4, 13.8, 12.4, 11.3)),
}


@pytest.mark.parametrize("name", PRINTED)
def test_an_oil_has_its_printed_data(name):
    at_40, at_100, density, alpha = PRINTED[name]
    made = oil.named_oil(name)
    assert made.kinematic_viscosity(313.15) == pytest.approx(at_40 * 1e-6, rel=1e-6)
    assert made.kinematic_viscosity(373.15) == pytest.approx(at_100 * 1e-6, rel=1e-6)
    assert made.density_at(288.75) == pytest.approx(density, rel=1e-4)
    for celsius, value in zip((40, 60, 80, 100), alpha):
        result = made.pressure_viscosity_coefficient(celsius + 273.15)
        assert result.value == pytest.approx(value * 1e-9, rel=1e-9)
        assert result.high / result.low == pytest.approx(1.04 / 0.96) and "Arana" in result.text
    between = made.pressure_viscosity_coefficient(323.15).value
    assert between == pytest.approx(1e-9 * math.sqrt(alpha[0] * alpha[1]), rel=1e-9)
    gold = oil.gold(at_40 * 1e-6, made.base).value  # printed oils lie 1.1 to 1.45 times above it
    assert 1.05 < made.pressure_viscosity_coefficient(313.15).value / gold < 1.5


def test_a_scene_takes_it_and_writes_it_back():
    scene = PAPER.with_(lubricant={"oil": "FVA 3", "temperature_celsius": 60})
    assert scene.lubricant.pressure_viscosity_coefficient == pytest.approx(19.1e-9)
    warmer = scene.with_(lubricant={"temperature_celsius": 90})
    assert warmer.lubricant.pressure_viscosity_coefficient == pytest.approx(1e-9 * math.sqrt(17.5 * 16.3))
    import tomllib

    assert lubfric.load_scene(tomllib.loads(scene.to_toml())).lubricant == scene.lubricant
    given = scene.with_(lubricant={"pressure_viscosity_coefficient": 2e-8})
    assert given.with_(lubricant={"temperature_celsius": 80}).lubricant.pressure_viscosity_coefficient == 2e-8
    with pytest.raises(InputError, match="more than 25 K outside"):
        scene.with_(lubricant={"temperature_celsius": 0})
    assert "FVA 3" in oil.list_oils()


def test_a_misspelt_name_gives_the_nearest():
    with pytest.raises(InputError, match=r"lubricant.oil = 'FVA-33' is not known \(did you mean 'fva-3'\?\)"):
        PAPER.with_(lubricant={"oil": "FVA-33", "temperature_celsius": 60})
    with pytest.raises(InputError, match="did you mean 'C45'"):
        PAPER.with_(bodies={"material": "C 45"})


def test_steels_by_name():
    scene = PAPER.with_(bodies={"material": ["C45", "42CrMo4"]})
    assert scene.bodies.e_prime == pytest.approx(2 / ((1 - 0.29**2) / 206e9 + (1 - 0.3**2) / 210e9))
    assert scene.bodies.conductivity == (50.0, 42.0)


@pytest.mark.parametrize("value", ["68 cSt", "68 mm²/s", "6.8e-5 m²/s"])
def test_a_kinematic_viscosity_is_reported_where_it_belongs(value):
    with pytest.raises(InputError, match="nu40"):
        PAPER.with_(lubricant={"viscosity": value})


def test_a_wrong_file_name_does_not_give_a_built_in_scene(tmp_path, monkeypatch):
    (tmp_path / "gear_flank.toml").write_text("")
    monkeypatch.chdir(tmp_path)
    for name in ("flt.toml", "folder/flat.toml", "float.toml"):
        with pytest.raises(InputError, match="neither a file nor a built-in scene") as caught:
            lubfric.load_scene(name)
        assert "did you mean 'flat'" not in str(caught.value)
    with pytest.raises(InputError, match="did you mean 'gear_flank.toml'"):
        lubfric.load_scene("gear-flank.toml")
    with pytest.raises(InputError, match="did you mean 'paper'"):
        lubfric.load_scene("papre")
