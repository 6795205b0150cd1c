"""Numbers as people write them: with units, as Ra or Rz of a drawing, as the name of a steel or an oil. Values on the
right are typed or measured on the map that is made, and share no code with what turns the words into numbers."""

import math
from pathlib import Path

import numpy as np
import pytest

import lubfric
from lubfric.output import parse_speeds
from lubfric.quantities import KEYS, NUMBERS, QUANTITIES
from lubfric.units import UNITS, kind_of

PAPER = lubfric.load_scene("paper")
OIL = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature": "70 °C"}
WORDS = {  # section: key: (as written, what it is in the unit of the key)
    "bodies": {
        "radius": ("12 mm", 0.012),
        "width": ("1.4 cm", 0.014),
        "load": ("2 kN", 2000.0),
        "e_prime": ("230 GPa", 230e9),
        "hardness": ("7400 N/mm²", 7.4e9),
        "boundary_friction_coefficient": ("9 %", 0.09),
        "boundary_film": ("20nm", 20e-9),
        "conductivity": (["46 W/(m·K)", "40 W/m K"], (46.0, 40.0)),
        "volumetric_heat": (["3.6 MJ/(m³ K)", "3.5 MJ/(m³ K)"], (3.6e6, 3.5e6)),
    },
    "lubricant": {
        "viscosity": ("80 mPa·s", 0.08),
        "pressure_viscosity_coefficient": ("20 1/GPa", 2e-8),
        "eyring_stress": ("5 MPa", 5e6),
        "limiting_stress_coefficient": ("6 %", 0.06),
        "limiting_stress_offset": ("10 bar", 1e6),
        "temperature": ("70 °C", 343.15),
        "temperature_coefficient": ("3.5 %/K", 0.035),
        "conductivity": ("130 mW/(m K)", 0.13),
    },
    "motion": {
        "entrainment_speed": ("18 km/h", 5.0),
        "slide_roll_ratio": ("3 %", 0.03),
        "speeds": (["1 mm/s", "0.01 m/s", "10 cm/s"], (0.001, 0.01, 0.1)),
    },
    "surface": {"sq": ("0.4 µm", 4e-7), "correlation_length": (["8 μm", "20 um"], (8e-6, 2e-5))},
    "contact": {"spacing": ("800 nm", 8e-7)},
    "numerics": {"tolerance": ("0.5 %", 0.005), "sampling_tolerance": ("1 %", 0.01), "model_tolerance": ("10 %", 0.1)},
    "transient": {"duration": ("20 ms", 0.02), "initial_film": ("0.2 um", 2e-7), "tolerance": ("0.01 %", 1e-4)},
}


def test_all_sections_with_units_are_those_with_plain_numbers(tmp_path):
    """By `with_`, by a dict and by a file; and a scene is stored with plain numbers."""
    written = {section: {key: pair[0] for key, pair in keys.items()} for section, keys in WORDS.items()}
    plan = written.pop("transient")
    scene = PAPER.with_(**written)
    for section, keys in written.items():
        for key in keys:
            assert getattr(getattr(scene, section), key) == WORDS[section][key][1], key
    ramp = {"kind": "ramp", "start": "1 kN", "end": 2000.0, "until": "10 ms"}
    tables = written | {"transient": plan | {"load": ramp}}
    tables["motion"] = tables["motion"] | {"sliding_speed": "100 mm/s"}
    scene = lubfric.load_scene(tables | {"contact": {"shape": [64, 64], "spacing": "800 nm"}})
    result = scene.transient
    assert (result.duration, result.initial_film, result.tolerance) == (0.02, 2e-7, 1e-4)
    assert (result.load.start, result.load.end, result.load.until, result.sliding.value) == (1000.0, 2000.0, 0.01, 0.1)
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    assert lubfric.load_scene(tmp_path / "scene.toml") == scene
    assert "mm" not in scene.to_toml() and "load = 2000.0" in scene.to_toml()


@pytest.mark.parametrize(
    "section, given, field, value",
    [
        ("bodies", {"radii": ["6 mm", "-24 mm"]}, "radius", 0.008),
        ("bodies", {"radii": ["6 mm", "inf"]}, "radius", 0.006),
        (
            "bodies",
            {"young_modulus": ["210 GPa", "210000 N/mm2"], "poisson_ratio": [0.3, 0.3]},
            "e_prime",
            210e9 / 0.91,
        ),
        ("bodies", {"hardness_hv": "7.4036 GPa"}, "hardness", 7.4036e9),
        ("bodies", {"hardness": "700 HV"}, "hardness", 700 * 9.80665e6 / math.sin(math.radians(68))),
        ("bodies", {"hardness": "100Cr6"}, "hardness", 740 * 9.80665e6 / math.sin(math.radians(68))),
        ("bodies", {"boundary_friction_coefficient": "MoDTC"}, "boundary_friction_coefficient", 0.05),
        ("lubricant", OIL | {"nu40": "68 mm2/s", "viscosity_index": 95, "grade": None}, "viscosity", 0.016775),
        ("lubricant", OIL | {"temperature": "343.15 K", "density": "0.88 g/cm³"}, "viscosity", 0.016775),
        ("lubricant", OIL, "temperature", 343.15),
        ("lubricant", {"pressure_viscosity_coefficient": "20 GPa^-1"}, "pressure_viscosity_coefficient", 2e-8),
        ("lubricant", {"eyring_stress": "mineral"}, "eyring_stress", 5e6),
        ("lubricant", {"limiting_stress_coefficient": "pao"}, "limiting_stress_coefficient", 0.045),
        ("motion", {"surface_speeds": ["0.9 m/s", "110 cm/s"]}, "slide_roll_ratio", 0.2),
        ("motion", {"slip_percent": "3 %"}, "slide_roll_ratio", 0.03),
        ("motion", {"speed_range": ["1 mm/s", "1 m/s", 4]}, "speeds", (0.001, 0.01, 0.1, 1.0)),
    ],
)
def test_short_forms_and_names_take_units(section, given, field, value):
    given = {key: one for key, one in given.items() if one is not None}
    assert getattr(getattr(PAPER.with_(**{section: given}), section), field) == pytest.approx(value, rel=1e-4)


def test_a_table_of_viscosities_takes_the_units_of_its_columns():
    lubricant = {
        "viscosity_table": [["40 °C", "68 cSt"], [373.15, "8.6 mm2/s"]],
        "temperature": "100 °C",
        "density": 870,
    }
    made = PAPER.with_(lubricant=lubricant).lubricant
    assert made.viscosity == pytest.approx(8.6e-6 * (870 - 0.64 * 85), rel=1e-9)


@pytest.mark.parametrize(
    "key, given, words",
    [
        ("bodies.width", "12 kN", r"bodies.width = '12 kN' is in kN, which does not convert to m.*'20 mm'"),
        ("bodies.width", "12 furlong", "unknown unit, 'furlong'.*a plain number in m"),
        ("bodies.hardness", "60 HRC", "give HV.*60: 697"),
        ("bodies.width", "60 HRC", "unknown unit, 'HRC'"),
        ("bodies.hardness", "100CrMo7", "no known name .did you mean '100Cr6'.*no number with a known unit"),
        ("bodies.width", "12", "no unit: omit the quotes"),
        ("bodies.width", "1,2 mm", "not a number with a unit"),
        ("bodies.load", "9e999999999999999999999 N", "bodies.load.*out of range"),
        ("bodies.load", "1e400 N", "bodies.load.*out of range"),
        ("bodies.radii", ["6 mm", "2 N"], "bodies.radii = '2 N'"),
        ("motion.speed_range", "1 m/s", "motion.speed_range = .1 m/s. must be"),
        ("bodies.hardness", "100Cr7", "or a name: 100Cr6, 16MnCr5"),
        ("counterface.ra", "0.1 s", "counterface.ra = '0.1 s'"),
        ("motion.speeds", ["1 mm/s", "1 mm"], "motion.speeds = '1 mm'"),
        ("transient.duration", "1 m", "transient.duration = '1 m'"),
        ("numerics.tolerance", "1 K", "numerics.tolerance"),
    ],
)
def test_what_is_no_such_number_is_reported_with_what_is(key, given, words):
    section, _, name = key.partition(".")
    table = {"correlation_length": 1e-5} if section == "counterface" else {}
    with pytest.raises(lubfric.InputError, match=words):
        if section == "transient":
            lubfric.load_scene({"transient": {name: given}})
        PAPER.with_(**{section: table | {name: given}})


def test_the_command_line_takes_units():
    assert parse_speeds("--speeds", "1 mm/s:1 m/s:4") == pytest.approx([0.001, 0.01, 0.1, 1.0])
    assert parse_speeds("--speeds", "1mm/s,2cm/s") == [0.001, 0.02]
    assert parse_speeds("--ratios", "1 %,10 %", "-") == [0.01, 0.1]
    for text, point, two in (
        ("0,1", "'0.1'", "'0, 1'"),
        ("0,2 m/s", "'0.2 m/s'", "'0 m/s, 2 m/s'"),
        ("1,5", "'1.5'", "'1, 5'"),
        ("1,5 mm/s", "'1.5 mm/s'", "'1 mm/s, 5 mm/s'"),
    ):
        with pytest.raises(lubfric.InputError, match=f"a comma separates values.*{point}.*{two}"):
            parse_speeds("--speeds", text)
        assert len(parse_speeds("--speeds", two.strip("'"))) == 2
    assert parse_speeds("--speeds", "1,2,3") == [1.0, 2.0, 3.0]
    assert parse_speeds("--speeds", "1,0.5") == [1.0, 0.5]
    assert parse_speeds("--speeds", "1:5 cm/s:3") == pytest.approx([0.01, 0.01 * math.sqrt(5), 0.05])
    for option, text, unit in (("--speeds", "0.001,2cm/s", "m/s"), ("--ratios", "1, 5 %", "-")):
        with pytest.raises(lubfric.InputError, match="without one"):
            parse_speeds(option, text, unit)
    with pytest.raises(lubfric.InputError, match="--speeds .*is in N"):
        parse_speeds("--speeds", "1 N")


def test_every_unit_of_the_table_of_quantities_is_known():
    units = {part for q in (*KEYS.values(), *QUANTITIES.values()) for part in q.unit.split(", ")}
    assert all(UNITS[kind_of(unit)] for unit in units)


def test_a_result_in_the_unit_requested():
    fields = dict.fromkeys(NUMBERS, 0.25) | {"min_film": np.array([1e-7, 2e-6])}
    result = lubfric.quantities.PointQuantities(**fields)
    assert result.in_unit("min_film", "nm") == pytest.approx([100.0, 2000.0])
    assert (result.in_unit("contact_load", "mN"), result.in_unit("coefficient", "%")) == (250.0, 25.0)
    for name, unit in (("min_film", "N"), ("film", "m"), ("min_film", "furlong")):
        with pytest.raises(lubfric.InputError):
            result.in_unit(name, unit)


# --- Ra and Rz -------------------------------------------------------------------------------------


def heights_of(**surface):
    """A long generated map, with ``surface`` in the place of its Sq: what a stylus would see."""
    scene = PAPER.with_(surface=surface | {"correlation_length": "10 um"})
    return lubfric.generate_surface(
        (4000, 400), 1e-6, sq=scene.surface.sq, correlation_length=1e-5, acf="gaussian", seed=5
    )


def test_a_map_made_for_an_ra_has_it_and_one_for_an_rz_about():
    z = heights_of(ra="0.2 um").heights
    assert np.abs(z - z.mean()).mean() == pytest.approx(2e-7, rel=0.01)
    profiles = heights_of(rz="1 um").heights.reshape(5, 800, 400)  # sampling lengths of 0.8 mm, along x
    assert np.mean(profiles.max(1) - profiles.min(1)) == pytest.approx(1e-6, rel=0.1)


def test_ra_and_rz_of_every_map_are_reported():
    """Rz is that along x, over sampling lengths of 0.8 mm, and of the measured points only."""
    made = heights_of(ra="0.2 um")
    z = made.heights
    seen = np.random.default_rng(0).random(made.shape) < 0.7
    for heights, mask in ((z, None), (np.where(seen, z, np.nan), seen)):
        lines = heights.reshape(5, 800, 400)
        rz = np.mean(np.nanmax(lines, 1) - np.nanmin(lines, 1))
        ra = np.nanmean(abs(heights - np.nanmean(heights)))
        stated = f"Ra {1e9 * ra:.4g} nm (whole map), Rz {1e9 * rz:.4g} nm (mean height within lengths of 0.8 mm)"
        surface = lubfric.Surface(heights, 1e-6, mask=mask)
        assert stated in repr(surface) and stated in surface.describe()


def test_a_wave_longer_than_the_sampling_length_is_in_ra_and_not_in_rz_and_the_line_says_so():
    """Of a map of one evaluation Rz is at least 2 Ra."""
    x = 1e-6 * np.arange(2000)
    wave = np.repeat(1e-8 * np.sin(2 * np.pi * x / 2e-3)[:, None], 4, axis=1)  # 2 mm; Ra 6.4 nm has lengths of 0.08 mm
    assert "without the longer waves that Sq and Ra contain)" in lubfric.Surface(wave, 1e-6).describe()
    ripple = np.repeat(1e-8 * np.sin(2 * np.pi * x / 2e-5)[:, None], 4, axis=1)
    assert "longer waves" not in lubfric.Surface(ripple, 1e-6).describe()


@pytest.mark.parametrize("section", ["surface", "counterface"])
def test_one_of_the_heights_is_given_and_only_of_a_generated_map(section, tmp_path):
    rough = {"correlation_length": 1e-5, "acf": "gaussian"}
    ra, rz = (getattr(PAPER.with_(**{section: rough | {key: 1e-7}}), section).sq for key in ("ra", "rz"))
    assert (ra, rz) == (pytest.approx(1e-7 * math.sqrt(math.pi / 2)), pytest.approx(2e-8))
    with pytest.raises(lubfric.InputError, match="one of sq, ra, rz"):
        PAPER.with_(**{section: rough | {"ra": 1e-7, "rz": 1e-6}})
    np.savetxt(tmp_path / "map.txt", heights_of(ra=1e-7).heights[:60, :60])
    mapped = {"file": str(tmp_path / "map.txt"), "spacing": "1 um"}
    with pytest.raises(lubfric.InputError, match=rf"{section}.ra is for generated maps"):
        PAPER.with_(**{section: mapped | {"ra": 1e-7}})


# --- the newcomer ----------------------------------------------------------------------------------

START = (Path(__file__).parents[2] / "docs" / "start.md").read_text(encoding="utf-8")
BEARING = next(block for block in START.split("```") if "anti-wear" in block).removeprefix("toml\n")


@pytest.mark.slow
def test_a_roller_bearing_in_the_words_of_its_drawing(tmp_path):
    """A roller of 12 mm on a ring of 60 mm, as docs/start.md has it: in 15 lines to an answer, interval and picture."""
    (tmp_path / "bearing.toml").write_text(BEARING, encoding="utf-8")
    scene = lubfric.load_scene(tmp_path / "bearing.toml")
    modulus = 210e9 / (1 - 0.3**2)
    assert len(BEARING.strip().splitlines()) <= 13  # and one command, which writes the interval and the picture
    assert scene.bodies.radius == pytest.approx(1 / (1 / 0.006 + 1 / 0.030))
    assert scene.bodies.half_width == pytest.approx(math.sqrt(8 * 2000 / 0.014 * 0.005 / (math.pi * modulus)))
    assert math.hypot(scene.surface.sq, scene.counterface.sq) == pytest.approx(math.sqrt(0.05 * math.pi / 2) * 1e-6)
    curve = lubfric.stribeck(scene, [3.0])
    low, high = curve.uncertainty.interval[0]
    # the roughness moves, and eyring_stress by its word is known to a factor: wide
    assert 0.008 < low < 0.02 < 0.033 < curve.coefficient[0] < 0.042 < 0.055 < high < 0.1
    assert curve.report.converged and abs(low - curve.coefficient[0]) < abs(high - curve.coefficient[0])
    assert 100 < curve.in_unit("central_film", "nm")[0] < 400
    assert curve.plot().lines
