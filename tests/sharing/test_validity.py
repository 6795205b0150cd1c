"""Validity of converged results: told where the model leaves its range, silent on the paper's scene, refused where f is
none."""

import pickle
from dataclasses import replace

import pytest

import lubfric
from lubfric.film import ShearForce
from lubfric.sharing import Forces, forces, judged_validity

PAPER = (
    lubfric.load_scene("paper")
    .with_(numerics={"sampling": "patch"})
    .with_(contact={"shape": (96, 96), "spacing": 0.9e-6})
)


@pytest.fixture(scope="module")
def model():
    return lubfric.prepare(PAPER)


@pytest.fixture(scope="module")
def balance(model):
    return lubfric.friction(model, 0.003, fields=True).balance


def judged(model, balance, scene=PAPER, found=None, ends=0.0):
    changed = replace(model, scene=scene)
    found = found or forces(scene, balance.level, balance, balance.slope)
    return judged_validity(changed, 0.003, replace(balance, forces=found), ends)


def test_the_paper_scene_needs_none(model, balance):
    assert model.known == () and judged(model, balance) == ()


@pytest.mark.parametrize(
    "words, scene, change, shear",
    [
        ("extrapolation", PAPER, "heavy film", ShearForce(0.0, 0.0)),
        ("eyring_stress", PAPER, None, ShearForce(5.0, 0.0)),
        ("does not tend to f_b", PAPER.with_(bodies={"load": 550.0}), None, ShearForce(0.0, 0.0)),
        ("not thin", PAPER.with_(bodies={"radius": 1e-6}), None, ShearForce(0.0, 0.0)),
        ("against one another", PAPER.with_(motion={"slide_roll_ratio": 3.0}), None, ShearForce(0.0, 0.0)),
    ],
)
def test_each_limit_is_told(model, balance, words, scene, change, shear):
    if change:
        film = replace(balance.film, pressure=balance.film.pressure * (2e9 / balance.film.pressure.max()))
        balance = replace(balance, film=film)
    found = Forces(0.1, 0.0, shear, 1.0)
    entries = [entry for entry in judged(model, balance, scene, found) if words in entry.text]
    assert len(entries) == 1 and entries[0].value > entries[0].limit and entries[0].remedy
    assert entries[0].text.startswith("caution: ") and not entries[0].severe


@pytest.mark.parametrize("share, severe", [(0.005, None), (0.05, False), (0.5, True)])
def test_stress_that_no_oil_carries_by_its_share_of_f(model, balance, share, severe):
    shear = ShearForce(0.0, 0.0, excess=share * 0.1 * PAPER.bodies.load, stress_ratio=3.0)
    entries = judged(model, balance, PAPER, Forces(0.1, 0.0, shear, 1.0))
    if severe is None:
        assert entries == ()
    else:
        assert entries[0].severe is severe and "Newtonian" in entries[0].text


def heavy(**lubricant):
    """A steel roller at 0.9 GPa with an ordinary oil, in pure sliding."""
    return PAPER.with_(
        bodies={"radius": 0.01, "hertz_pressure": 0.9e9, "width": 0.01, "e_prime": 2.27e11},
        lubricant={"viscosity": 0.02, "pressure_viscosity_coefficient": 2e-8} | lubricant,
        contact={"shape": (128, 64), "spacing": 4e-6},
        surface={"sq": 5e-8, "correlation_length": 3e-5, "acf": "gaussian"},
    )


def test_the_ordinary_bearing_without_a_shear_law_is_refused():
    with pytest.raises(lubfric.ValidityError, match="eyring_stress") as caught:
        lubfric.friction(heavy(), 1.0)
    error = caught.value
    assert isinstance(error, lubfric.LubfricError)
    assert error.result.coefficient > 1 and error.result.report.converged
    assert error.entries[0].severe and error.entries[0] in error.result.validity
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and again.result.coefficient == error.result.coefficient
    accepted = lubfric.friction(heavy().with_(numerics={"accept": True}), 1.0)
    assert (
        accepted.coefficient == pytest.approx(error.result.coefficient) and accepted.validity == error.result.validity
    )
    assert any("not valid" in note for note in accepted.report.notes)


def test_a_shear_law_makes_it_an_answer():
    found = lubfric.friction(heavy(eyring_stress=5e6, limiting_stress_coefficient=0.08), 1.0)
    assert found.coefficient < 0.2 and not any(entry.severe for entry in found.validity)


def test_a_sweep_marks_the_point_and_keeps_the_rest():
    scene = heavy().with_(motion={"slide_roll_ratio": 1e-9})
    sliding = heavy()
    with pytest.raises(lubfric.ValidityError) as caught:
        lubfric.stribeck(sliding, [0.5, 1.0])
    curve = caught.value.result
    assert set(curve.errors) == {0, 1} and curve.coefficient[0] != curve.coefficient[0]
    assert curve.entries(0)[0].what and any("2 speeds, 0.5 to 1 m/s" in text for text in curve.validity)
    rolling = lubfric.stribeck(scene, [0.5, 1.0])
    assert not rolling.errors and not any("not valid" in text for text in rolling.validity)
    accepted = lubfric.stribeck(sliding.with_(numerics={"accept": True}), [0.5, 1.0])
    assert not accepted.errors and any("not valid" in text for text in accepted.validity)


@pytest.mark.parametrize(
    "bodies, words, severe",
    [
        ({"radius": 0.01, "load": 3e5, "e_prime": 1e8, "width": 0.1}, "no half-space", True),
        ({"width": 4e-6, "load": 0.01}, "wider than long", False),
        ({"hertz_pressure": 6e9, "hardness": None}, "steel yields", False),
    ],
)
def test_bodies_are_judged_before_anything_is_solved(bodies, words, severe):
    from lubfric.sharing.validity_beforehand import of_bodies

    entries = [e for e in of_bodies(PAPER.with_(bodies={"hardness": None} | bodies).bodies) if words in e.text]
    assert len(entries) == 1 and entries[0].severe is severe


def test_steep_maps_and_narrow_ones_are_told():
    from lubfric.sharing.validity_beforehand import of_map

    assert not list(of_map(0.3, 20))
    assert [e.severe for e in of_map(0.7, 20)] == [False]
    assert [e.severe for e in of_map(2.0, 20)] == [True]
    assert "few asperities" in next(of_map(0.1, 3)).text


def test_the_reynolds_number_is_that_of_the_film():
    from lubfric.sharing import of_motion

    scene = PAPER.with_(lubricant={"viscosity": 1e-4, "viscosity_law": "constant"})
    number = 870 * 100 * 30e-6 / 1e-4
    entry = next(of_motion(scene, 100.0, 30e-6))
    assert entry.value == pytest.approx(number) and entry.severe
    assert not list(of_motion(PAPER, 1.0, 1e-6))


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [0.0, 0.1])
def test_cold_and_warm_agree_at_4_5_gpa(ratio):
    """Pure rolling and slow sliding where the film is a spike's neighbour: from anywhere the same f."""
    scene = lubfric.load_scene("flat").with_(
        bodies={"hertz_pressure": 4.5e9, "radius": 5e-3, "width": 1e-2, "hardness": None},
        lubricant={"viscosity": 0.05, "pressure_viscosity_coefficient": 1.8e-8, "eyring_stress": 5e6},
        motion={"slide_roll_ratio": ratio, "speeds": ()},
        surface={"sq": 5e-8, "correlation_length": 1e-5, "acf": "gaussian"},
        contact={"shape": (32, 32), "spacing": 3e-6},
        numerics={"accept": True, "film_deflection": "hydrodynamic"},
    )
    prepared = lubfric.prepare(scene)
    cold = lubfric.friction(prepared, 0.3)
    for other in (0.5,):
        warm = lubfric.friction(prepared, 0.3, start=lubfric.friction(prepared, other))
        assert warm.coefficient == pytest.approx(cold.coefficient, rel=0.01)


@pytest.mark.parametrize(
    "numerics",
    [
        {"film_level": "isoviscous"},
        {"model": "deterministic", "grid": "given"},
        {"closure": "one-way", "grid": "given"},
    ],
    ids=["load sharing", "deterministic", "one-way"],
)
def test_an_error_above_the_tolerance_is_a_caution(numerics):
    """Settings that do not follow the tolerance: f and its error stay the same, above one tolerance and below
    another."""
    points = [lubfric.friction(PAPER.with_(numerics=numerics | {"tolerance": t}), 0.01) for t in (1e-4, 0.2)]
    told = [[entry for entry in p.validity if "estimated numerical error of f" in entry.what] for p in points]
    assert 1e-4 < points[0].uncertainty.numerical < 0.2 and told[1] == []
    assert told[0][0].value == pytest.approx(100 * points[0].uncertainty.numerical) and told[0][0].limit == 0.01
    assert told[0][0].text in points[0].report.notes
