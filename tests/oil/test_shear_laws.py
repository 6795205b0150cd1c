"""The parts of every shear law against each other; and a law that only stands here, which everything has to take."""

from dataclasses import replace

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.film import heated_stress
from lubfric.models.deterministic import solve_strip, thinning
from lubfric.oil import FLOW_LAWS, LIMIT_LAWS, Eyring, Lubricant, ShearLaw, lubricant
from lubfric.surface import Surface

LAWS = {"eyring_stress": 1e6, "carreau": (1e6, 0.6), "limiting_stress_coefficient": 0.002}  # values that matter
WARM = {"temperature": 350.0, "temperature_coefficient": 0.035, "conductivity": 0.15}
SCENE = paper_scene(
    bodies={"load": 20.0},
    lubricant={"eyring_stress": 1e6, "viscosity": 0.1},
    motion={"entrainment_speed": 0.3, "slide_roll_ratio": 1.0, "speeds": ()},
    surface={"sq": 1e-9, "correlation_length": 4e-6},
    contact={"shape": (64, 16), "spacing": 1.2e-6},
    numerics={"accept": True, "sampling": "patch", "grid": "given", "film_deflection": "hydrodynamic"},
)


def differences(function, at, step):
    return (function(at + step) - function(at - step)) / (2 * step)


@pytest.mark.parametrize("key", [law.key for law in (*FLOW_LAWS, *LIMIT_LAWS)])
def test_the_parts_of_a_law_agree(key):
    oil = Lubricant(0.04, 2e-8, **{key: LAWS[key]}, **WARM)
    p = 1e8
    s = np.geomspace(0.01, 100.0, 9)
    (law,) = oil.shear_laws

    def critical(p):
        return oil.shear_laws[0].critical(p)[0]

    assert law.critical(p)[1] == pytest.approx(differences(critical, p, 1e4), rel=1e-6)
    assert law.warmth(350.0) == 1
    stress = law.stress(s * critical(p), critical(p))
    borne = stress < critical(p) if oil.limit else s > 0
    assert law.newtonian(stress, critical(p))[borne] == pytest.approx(s[borne] * critical(p), rel=1e-9)
    assert np.isinf(law.newtonian(1.01 * stress, critical(p))[~borne]).all()
    for along in (True, False):
        factor, slope = law.thinning(s, along=along)
        assert slope == pytest.approx(s * differences(lambda s: law.thinning(s, along=along)[0], s, 1e-5 * s), rel=1e-5)
    if oil.limit:
        assert replace(oil, **law.twice()).limit.critical(p)[0] == pytest.approx(2 * critical(p))
    else:
        assert 1 / law.thinning(s, along=True)[0] == pytest.approx(differences(law.f, s, 1e-5 * s), rel=1e-6)
        exponent = float(differences(lambda t: np.log(law.f(np.exp(t))), 14.0, 1e-3))
        is_power = law.power_law_exponent is not None
        assert not is_power or exponent == pytest.approx(law.power_law_exponent, abs=1e-3)
        assert factor == pytest.approx(s / law.f(s), rel=1e-9) and not (law.thins and law.critical(p)[1])


def everywhere(scene):
    """f of a smooth film by load sharing, by the deterministic model and in time."""
    strip = solve_strip(scene, Surface(np.zeros((64, 4)), (1.2e-6, 1.2e-6)), 0.3, map_coarsening=(1, 1)).result
    run = lubfric.transient(scene.with_(transient=lubfric.Transient(1e-4, outputs=1)))
    return np.array([lubfric.friction(scene).coefficient, strip.coefficient, run.coefficient[-1]])


@pytest.mark.parametrize("key", LAWS)
def test_the_key_of_a_law_reaches_the_number_everywhere(key):
    plain = SCENE.with_(lubricant={"eyring_stress": None})
    result = everywhere(plain.with_(lubricant={key: LAWS[key]}))
    newtonian = everywhere(plain)
    assert result == pytest.approx(result[0], rel=0.06) and np.all(np.abs(result / newtonian - 1) > 0.08)


class Bare(ShearLaw):
    """tau + tau³/tau_c² = Newtonian stress, with what friction needs of it."""

    key = "eyring_stress"
    critical = Eyring.critical

    def f(self, s):
        return 2 / np.sqrt(3) * np.sinh(np.arcsinh(1.5 * np.sqrt(3) * s) / 3)


class Cubic(Bare):
    thins = True
    power_law_exponent = 1 / 3
    warmth = ShearLaw.as_temperature

    def tangent(self, s):
        x = self.f(s)
        return 1 + 3 * x**2, 6 * x * s / (1 + 3 * x**2)

    def inverse(self, x):
        return x + x**3


def test_friction_in_every_model_and_in_time_follows_a_law_of_ones_own(monkeypatch):
    """By quadrature over the film; a smooth strip and a run in time have its friction. Eyring's is another."""
    eyring = lubfric.friction(SCENE)
    monkeypatch.setattr(lubricant, "FLOW_LAWS", (Cubic,))
    result = lubfric.friction(SCENE)
    oil = SCENE.lubricant
    sliding = 0.3
    film = result.balance.film
    newtonian = lubricant.viscosity(oil, film.pressure) * sliding / film.film_thickness
    tau = np.array([np.roots([1e-12, 0, 1, -n])[-1].real for n in newtonian])
    assert np.allclose(tau + 1e-12 * tau**3, newtonian)
    inlet = oil.viscosity * sliding * 2 * SCENE.bodies.radius / abs(film.x[0])
    force = SCENE.bodies.width * (np.trapezoid(tau * (film.x <= film.rupture), film.x) + inlet)
    assert result.couette_force == pytest.approx(force, rel=0.01)
    assert film.flow_film / film.line.moes_film == pytest.approx(
        film.line.expected_film / film.line.moes_film, abs=0.15
    )
    assert film.line.expected_film < 0.95 * film.line.moes_film
    assert result.coefficient < 0.95 * eyring.coefficient and film.flow_film < 0.95 * eyring.balance.film.flow_film
    assert everywhere(SCENE) == pytest.approx(result.coefficient, rel=0.02)


def test_heat_and_the_deterministic_flow_follow_a_law_of_ones_own(monkeypatch):
    """A film that heats itself: the heat equation across it in closed form; the flow: tangent and secant."""
    monkeypatch.setattr(lubricant, "FLOW_LAWS", (Cubic,))
    oil = Lubricant(0.05, viscosity_law="constant", eyring_stress=2e5, **WARM)
    h = 4e-6
    sliding = 12.0
    (tau,), (rise,) = heated_stress(oil, np.zeros(1), np.array([h]), sliding, np.array([350.0]))
    rate = (tau + tau**3 / (2e5 * (350 + rise) / 350) ** 2) / 0.05
    a = 1 + 0.035 * tau * sliding**2 / (8 * 0.15 * rate)
    assert rise > 2 and np.arcsinh(np.sqrt(a - 1)) ** 2 == pytest.approx(a * 0.035 * tau * rate * h**2 / (8 * 0.15))
    x = np.array([0.0, 0.3, 4.0])
    for along, power in ((True, 3), (False, 1)):
        factor, exponent, _ = thinning(oil, 2e5 * (x + x**3), [2e5], along=along)
        assert factor == pytest.approx(1 + power * x**2, rel=1e-9)


@pytest.mark.parametrize("numerics, part", [({"heat": "on"}, "warmth"), ({"model": "deterministic"}, "tangent")])
def test_what_a_law_omits_is_refused_by_its_name(monkeypatch, numerics, part):
    monkeypatch.setattr(lubricant, "FLOW_LAWS", (Bare,))
    scene = SCENE.with_(numerics={"heat": "off"}, lubricant=WARM)
    assert lubfric.friction(scene).coefficient > 0
    with pytest.raises(lubfric.InputError, match=f"eyring_stress has a shear law without {part}"):
        lubfric.friction(scene.with_(numerics=numerics))
