"""Short forms of a scene: the same in a file and in `with_`, against closed forms and against the plain fields."""

import math

import pytest

import lubfric
from lubfric import oil
from lubfric.film import hertz

PAPER = lubfric.load_scene("paper")
INF = math.inf
OIL_KEYS = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70, "density": 870}


def scene(tmp_path, lubricant="viscosity = 0.02\npressure_viscosity_coefficient = 2e-8", **bodies):
    table = {"radius": "0.01", "width": "0.01", "load": "1000.0", "e_prime": "2.2e11"} | bodies
    path = tmp_path / "scene.toml"
    body = "\n".join(f"{k} = {v}" for k, v in table.items() if v is not None)
    path.write_text(
        f"[bodies]\nboundary_friction_coefficient = 0.1\n{body}\n[lubricant]\n{lubricant}\n"
        "[motion]\nentrainment_speed = 1.0\nslip_percent = 5\n[surface]\nsq = 1e-7\ncorrelation_length = 1e-5\n"
        "[contact]\nshape = [256, 64]\nspacing = 2e-6\n"
    )
    return lubfric.load_scene(path)


def test_oil_in_a_file_and_in_with(tmp_path):
    made = oil.from_grade("ISO VG 68", 95, density=870)
    text = "\n".join(f"{k} = {v!r}" for k, v in OIL_KEYS.items()).replace("'", '"')
    for result in (scene(tmp_path, text).lubricant, PAPER.with_(lubricant=OIL_KEYS).lubricant):
        assert result.viscosity == pytest.approx(made.viscosity(343.15))
        assert result.pressure_viscosity_coefficient == pytest.approx(made.pressure_viscosity_coefficient(343.15).value)
        assert result.temperature_coefficient == pytest.approx(made.temperature_coefficient(343.15))
        assert result.temperature == 343.15 and result.oil == made and result.heats
    assert scene(tmp_path, text).motion.slide_roll_ratio == 0.05


def test_every_key_of_an_oil_reaches_the_viscosity_or_its_coefficients():
    base = PAPER.with_(lubricant=OIL_KEYS)

    def changed(**keys):
        return base.with_(lubricant=keys).lubricant

    made = oil.from_grade("ISO VG 68", 95, density=870)
    assert changed(temperature=320.0).viscosity == pytest.approx(made.viscosity(320.0))
    assert changed(temperature_celsius=46.85).viscosity == pytest.approx(made.viscosity(320.0))
    assert changed(grade="VG 100").viscosity == pytest.approx(oil.from_grade(100, 95, density=870).viscosity(343.15))
    same = oil.from_grade(68, 140, density=870).viscosity(343.15)
    assert changed(viscosity_index=140).viscosity == pytest.approx(same)
    assert changed(nu40=68e-6, nu100=9e-6).viscosity == pytest.approx(
        oil.from_viscosities(68e-6, 9e-6, density=870).viscosity(343.15)
    )
    table = [[313.15, 68e-6], [333.15, 30e-6], [353.15, 15e-6]]
    assert changed(viscosity_table=table).viscosity == pytest.approx(
        oil.from_table(*zip(*table), density=870).viscosity(343.15)
    )
    assert changed(oil="pao-220").viscosity == pytest.approx(oil.named_oil("pao-220").viscosity(343.15))
    assert changed(density=900).viscosity == pytest.approx(made.with_(density=900).viscosity(343.15))
    assert changed(density_slope=0.0).viscosity == pytest.approx(made.kinematic_viscosity(343.15) * 870)
    nu = made.kinematic_viscosity(343.15)
    assert changed(alpha_estimate="gold").pressure_viscosity_coefficient == oil.gold(nu, "mineral").value
    assert changed(base="ester").pressure_viscosity_coefficient == oil.gold(nu, "ester").value
    assert changed(pressure_viscosity_coefficient=2.5e-8).pressure_viscosity_coefficient == 2.5e-8
    kept = base.with_(lubricant={"pressure_viscosity_coefficient": 2.5e-8}).with_(lubricant={"temperature": 320.0})
    assert kept.lubricant.pressure_viscosity_coefficient == 2.5e-8  # given: it stays
    assert changed(conductivity=0.2).conductivity == 0.2
    assert changed(eyring_stress=5e6).viscosity == base.lubricant.viscosity
    assert changed(viscosity=0.05).viscosity == 0.05 and changed(viscosity=0.05).oil is None


@pytest.mark.parametrize(
    "pair, radius", [((0.01, INF), 0.01), ((0.02, 0.02), 0.01), ((0.01, -0.02), 0.02), ((0.006, -0.05), 0.3 / 44)]
)
def test_two_radii(tmp_path, pair, radius):
    assert PAPER.with_(bodies={"radii": pair}).bodies.radius == pytest.approx(radius)
    text = "[" + ", ".join(str(r) for r in pair) + "]"
    assert scene(tmp_path, radius=None, radii=text).bodies.radius == pytest.approx(radius)


def test_materials_and_moduli(tmp_path):
    steel = 207e9 / (1 - 0.3**2)
    assert scene(tmp_path, e_prime=None, material='"steel"').bodies.e_prime == pytest.approx(steel)
    assert PAPER.with_(bodies={"material": "steel"}).bodies.e_prime == pytest.approx(steel)
    mixed = PAPER.with_(bodies={"material": ["steel", "silicon nitride"]}).bodies
    assert 2 / mixed.e_prime == pytest.approx((1 - 0.09) / 207e9 + (1 - 0.26**2) / 310e9)
    assert mixed.effusivity[0] == pytest.approx(math.sqrt(46 * 7850 * 460))
    pairs = PAPER.with_(bodies={"young_modulus": [2e11, 1e11], "poisson_ratio": [0.3, 0.2]}).bodies
    assert pairs.e_prime == pytest.approx(hertz.composite_modulus(2e11, 0.3, 1e11, 0.2))


def test_hertz_pressure_gives_the_load(tmp_path):
    for bodies in (
        scene(tmp_path, load=None, hertz_pressure="1e9").bodies,
        PAPER.with_(bodies={"hertz_pressure": 1e9}).bodies,
        PAPER.with_(bodies={"hertz_pressure": 1e9, "radius": 0.03, "material": "steel", "hardness": None}).bodies,
    ):
        peak = hertz.line_peak_pressure(bodies.load / bodies.width, bodies.radius, bodies.e_prime)
        assert peak == pytest.approx(1e9)


def test_vickers_hardness_is_load_over_projected_area():
    """A pyramid of 136 degrees between faces: HV = F/facets, hardness = F/projection = F/(facets sin 68 degrees)."""
    result = PAPER.with_(bodies={"hardness_hv": 700}).bodies.hardness
    assert result == pytest.approx(700 * 9.80665e6 / math.sin(math.radians(68)), rel=1e-4)


@pytest.mark.parametrize(
    "section, keys, words",
    [
        ("lubricant", OIL_KEYS | {"temperature": 340.0}, "one of temperature, temperature_celsius"),
        ("lubricant", OIL_KEYS | {"viscosity": 0.1}, "one of them"),
        ("lubricant", OIL_KEYS | {"nu40": 1e-4, "nu100": 1e-5}, "one of grade, nu40\\+nu100"),
        ("lubricant", {"nu40": 68e-6, "temperature": 340.0}, "needs nu100 or viscosity_index"),
        ("lubricant", {"base": "pao"}, "needs an oil"),
        ("bodies", {"radii": [0.01, -0.005]}, "negative for a hollow"),
        ("bodies", {"load": 10.0, "hertz_pressure": 1e9}, "one of load, hertz_pressure"),
        ("motion", {"slip_percent": 5, "slide_roll_ratio": 0.05}, "slip_percent"),
    ],
)
def test_contradictions_are_reported(section, keys, words):
    with pytest.raises(lubfric.InputError, match=words):
        PAPER.with_(**{section: keys})


@pytest.mark.parametrize("other", [{"nu40": 68e-6, "nu100": 8.7e-6}, {"oil": "mineral-100"}])
def test_a_viscosity_index_beside_what_gives_it_is_refused(other):
    """It would do nothing."""
    with pytest.raises(lubfric.InputError, match="viscosity_index and .*give the same quantity"):
        PAPER.with_(lubricant={"viscosity_index": 95, "temperature": 340.0} | other)


def test_another_viscosity_at_40_degrees_keeps_the_index_that_was_given():
    graded = PAPER.with_(lubricant={"grade": "ISO VG 68", "viscosity_index": 95, "temperature": 340.0})
    by_grade, by_nu40 = (graded.with_(lubricant=oil).lubricant for oil in ({"grade": "ISO VG 32"}, {"nu40": 32e-6}))
    assert by_nu40.viscosity == pytest.approx(by_grade.viscosity, rel=1e-9)
    with pytest.raises(lubfric.InputError, match="needs nu100 or viscosity_index"):
        graded.with_(lubricant={"nu40": 68e-6, "nu100": 8.7e-6}).with_(lubricant={"nu40": 32e-6})


def test_an_index_beside_the_viscosity_at_40_degrees_is_that_of_the_oil():
    by_index = lubfric.oil.from_index(73.3e-6, lubfric.oil.viscosity_index(73.3e-6, 8.86e-6))
    assert by_index.kinematic_viscosity(373.15) == pytest.approx(8.86e-6, rel=1e-9)
    scene = PAPER.with_(lubricant={"nu40": 73.3e-6, "viscosity_index": 92.43, "temperature": 373.15})
    assert scene.lubricant.viscosity == pytest.approx(8.86e-6 * scene.lubricant.oil.density_at(373.15), rel=1e-4)


def test_an_offset_without_a_limit_is_refused():
    scene = PAPER
    with pytest.raises(lubfric.InputError, match="does nothing without limiting_stress_coefficient"):
        scene.with_(lubricant={"limiting_stress_offset": 2e6})
    limited = scene.with_(lubricant={"limiting_stress_offset": 2e6, "limiting_stress_coefficient": 0.05})
    assert limited.with_(lubricant={"limiting_stress_offset": 3e6}).lubricant.limiting_stress_offset == 3e6
    free = limited.with_(lubricant={"limiting_stress_coefficient": None})
    assert "limiting_stress" not in free.to_toml() and "limiting_stress_offset = 2000000.0" in limited.to_toml()


def test_a_temperature_beside_a_viscosity_that_is_a_number_is_refused():
    """A loop over temperatures gave the same f at all of them, without a word."""
    scene = PAPER
    for given in ({"temperature_celsius": 90}, {"temperature": 350.0, "temperature_coefficient": None}):
        with pytest.raises(lubfric.InputError, match="temperature does not change a viscosity"):
            scene.with_(lubricant=given)
    warm = scene.with_(lubricant={"temperature": 330.0, "temperature_coefficient": 0.03})
    with pytest.raises(lubfric.InputError, match="temperature does not change a viscosity"):
        warm.with_(lubricant={"temperature": 350.0})
    assert warm.with_(lubricant={"temperature": 330.0, "eyring_stress": 5e6}).lubricant.heats
    assert warm.with_(lubricant={"temperature": 350.0, "viscosity": 0.2}).lubricant.temperature == 350.0
    vary = {"lubricant.oil": ["mineral-100", "mineral-220"], "lubricant.temperature": [330.0, 350.0]}
    assert lubfric.plan_study(warm, vary, [0.1]).points == 4


# --- coefficients given beside an oil ------------------------------------------------------------

GIVEN_OIL = {"nu40": 68e-6, "nu100": 8.4e-6, "eyring_stress": 5e6, "temperature_celsius": 70}
HOT = {"bodies": {"load": 200.0}, "motion": {"slide_roll_ratio": 0.5}, "numerics": {"sampling": "patch"}}


def lubricant(**given):
    return PAPER.with_(lubricant=GIVEN_OIL | given).lubricant


def test_a_given_temperature_coefficient_is_kept_through_changes_of_the_oil():
    assert lubricant().temperature_coefficient == pytest.approx(0.0345, rel=0.01)
    scene = PAPER.with_(lubricant=GIVEN_OIL | {"temperature_coefficient": 0.02})
    changes = ({"temperature_celsius": 60}, {"density": 900}, {"base": "pao"}, {"nu40": 60e-6, "nu100": 8e-6})
    for changed in ({}, *changes):
        assert scene.with_(lubricant=changed).lubricant.temperature_coefficient == 0.02
    assert scene.with_(lubricant={"temperature_coefficient": 0.04}).lubricant.temperature_coefficient == 0.04


def test_the_coefficient_of_the_oil_follows_its_temperature():
    scene = PAPER.with_(lubricant=GIVEN_OIL)
    moved = scene.with_(lubricant={"temperature_celsius": 60}).lubricant
    assert moved.temperature_coefficient == lubricant(temperature_celsius=60).temperature_coefficient


@pytest.mark.slow
def test_a_given_temperature_coefficient_reaches_the_friction_of_a_hot_film():
    base = PAPER.with_(**HOT)
    beside = base.with_(lubricant=GIVEN_OIL | {"temperature_coefficient": 0.01})
    keys = ("viscosity", "pressure_viscosity_coefficient", "temperature", "conductivity", "density_law")
    numbers = {key: getattr(lubricant(), key) for key in keys} | {"temperature_coefficient": 0.01, "eyring_stress": 5e6}
    f, of_numbers = (lubfric.friction(s, 5.0).coefficient for s in (beside, base.with_(lubricant=numbers)))
    assert f == pytest.approx(of_numbers, rel=1e-12)
    assert f > 1.05 * lubfric.friction(base.with_(lubricant=GIVEN_OIL), 5.0).coefficient


def test_a_conductivity_given_later_is_kept_as_well():
    scene = PAPER.with_(lubricant=GIVEN_OIL).with_(lubricant={"conductivity": 0.2})
    for changed in ({}, {"temperature_celsius": 60}, {"density": 900}):
        assert scene.with_(lubricant=changed).lubricant.conductivity == 0.2


@pytest.mark.parametrize("given", [["0.3 mm", "1 mm"], {"kind": "ramp", "start": 1e-4, "end": 1e-3}])
def test_one_inlet_length_serves_both_directions(given):
    with pytest.raises(lubfric.InputError, match="one number serves both directions of motion") as caught:
        lubfric.load_scene("paper").with_(lubricant={"inlet_length": given})
    assert caught.value.quantity == "lubricant.inlet_length"
