"""Elastic shear of film and discs: closed forms of Maxwell's fluid, of Carter's dry contact, and their limits."""

import importlib

import numpy as np
import pytest

import lubfric
from lubfric import InputError, friction
from lubfric.film import ElasticContact, disc_compliance, elastic_shear
from lubfric.oil import Lubricant

B = 1e-4
E_PRIME = 230e9
U = 1.0
X = np.linspace(-B, B, 201)
FILM = np.full(X.size, 3e-7)
PRESSURE = np.zeros(X.size)
NO_ASPERITIES = ElasticContact(compliance=0.0, x=X, asperity_limit=np.zeros(X.size))


def stresses(lubricant, contact, slip, film=FILM, wet=1.0):
    wet = np.full(X.size - 1, wet)
    options = {"entrainment_speed": U, "sliding": slip, "wet": wet}
    return elastic_shear(lubricant, contact, X, PRESSURE, film, **options)


def test_a_newtonian_film_relaxes_as_maxwells_fluid():
    """tau = (eta Δu/h) less an exponential of length U eta/G, from the viscous stress at the first node on: with a film
    that thins at once to h, the stored strain decides; here it starts at the viscous stress and stays there."""
    viscous = stresses(Lubricant(100.0, viscosity_law="constant", shear_modulus=1e7), NO_ASPERITIES, 1e-3)
    np.testing.assert_allclose(viscous.film_share, 1.0, rtol=1e-9)
    film = np.where(X < -0.8 * B, 1e-2, 3e-7)  # nothing is stored upstream
    lubricant = Lubricant(100.0, viscosity_law="constant", shear_modulus=1e7)
    share = stresses(lubricant, NO_ASPERITIES, 1e-3, film).film_share
    inside = X > -0.8 * B + 2e-6
    begin = X[np.argmax(X >= -0.8 * B)]
    expected = 1 - np.exp(-(X - begin) * 1e7 / (100.0 * U))
    np.testing.assert_allclose(share[inside], expected[inside], atol=0.05)


def test_at_small_slip_the_film_has_the_traction_of_a_solid():
    """So stiff a fluid stores all shear: tau = G Δu (x + b)/(U h) from an entry without stress."""
    lubricant = Lubricant(1e12, viscosity_law="constant", shear_modulus=2e8)
    film = np.where(X < -0.99 * B, 1e6, 3e-7)
    share = stresses(lubricant, NO_ASPERITIES, 1e-6, film).film_share
    tau = share * 1e12 * 1e-6 / film
    np.testing.assert_allclose(
        tau[2:], 2e8 * 1e-6 * (X[2:] - X[1]) / (U * 3e-7), rtol=0.005, atol=200.0
    )  # within one step of the entry


def test_the_discs_alone_have_carters_traction_at_vanishing_creep():
    """Q = (π/4) b E' ξ; at large creep all of f_b F, and in between less than Carter's straight line."""
    pressure = 1e9 * np.sqrt(1 - (X / B) ** 2)
    contact = ElasticContact(compliance=disc_compliance(B, E_PRIME), x=X, asperity_limit=0.1 * pressure)
    dry = Lubricant(1e-9, viscosity_law="constant", shear_modulus=1e15)
    full = np.trapezoid(contact.asperity_limit, X)
    for creep in (1e-6, 1e-5):
        share = stresses(dry, contact, creep * U).asperity_share
        assert share * full == pytest.approx(np.pi / 4 * B * E_PRIME * creep, rel=0.04)
    shares = [stresses(dry, contact, creep).asperity_share for creep in (1e-5, 1e-4, 3e-4, 1e-3, 1e-2)]
    assert (np.diff(shares) > 0).all() and shares[-1] == pytest.approx(1.0, abs=0.02)


def test_film_and_discs_in_series_are_softer_than_either():
    stiff = Lubricant(1e12, viscosity_law="constant", shear_modulus=2e8)
    film = np.where(X < -0.99 * B, 1e6, 3e-7)
    discs = ElasticContact(compliance=disc_compliance(B, E_PRIME), x=X, asperity_limit=np.zeros(X.size))
    soft = stresses(stiff, discs, 1e-6, film).film_share[-1] * 1e12 * 1e-6 / 3e-7
    series = 1 / (3e-7 / 2e8 + disc_compliance(B, E_PRIME))
    assert soft == pytest.approx(1e-6 * 2 * B * series, rel=0.03)


def test_large_slip_and_a_stiff_film_leave_the_laws_alone():
    for law in ({"eyring_stress": 5e6}, {"limiting_stress_coefficient": 0.05, "limiting_stress_offset": 5e6}, {}):
        lubricant = Lubricant(50.0, viscosity_law="constant", shear_modulus=1e14, **law)
        share = stresses(lubricant, NO_ASPERITIES, 0.5).film_share
        np.testing.assert_allclose(share, 1.0, rtol=1e-3)


def test_more_substeps_move_the_force_little(monkeypatch):
    module = importlib.import_module("lubfric.film.elastic_shear")

    lubricant = Lubricant(1e3, viscosity_law="constant", shear_modulus=1e8, eyring_stress=4e6)
    film = np.where(X < -0.9 * B, 3e-4, 3e-7)
    contact = ElasticContact(compliance=disc_compliance(B, E_PRIME), x=X, asperity_limit=1e6 * np.ones(X.size))
    forces = {}
    for count in (4, 8):
        monkeypatch.setattr(module, "SUBSTEPS", count)
        result = stresses(lubricant, contact, 2e-3, film, wet=0.8)
        forces[count] = np.trapezoid(result.film_share, X), result.asperity_share
    np.testing.assert_allclose(forces[4], forces[8], rtol=5e-3)


SCENE = lubfric.load_scene("paper").with_(
    bodies={"load": 200.0},
    lubricant={"eyring_stress": 5e6},
    motion={"entrainment_speed": 0.3, "speeds": ()},
    surface={"sq": 3e-8},
    contact={"shape": (48, 32), "spacing": 1.5e-6},
    numerics={"sampling": "patch", "grid": "given", "model": "paper", "tolerance": 0.03, "heat": "off"},
)


def test_a_traction_curve_has_a_linear_branch_and_its_old_end():
    """Without rolling, f doubles with the slip at first; where the film flows it is as without elastic shear."""
    elastic = SCENE.with_(lubricant={"shear_modulus": 2e8})
    ratios = [0.0, 1e-6, 2e-6, -2e-6, 1e-2, 1.0]
    curve = lubfric.traction(elastic, ratios)
    f = curve.without_rolling
    old = lubfric.traction(SCENE, [1e-6, 1e-2, 1.0]).without_rolling
    assert f[0] == 0
    assert f[2] == pytest.approx(2 * f[1], rel=0.02) and f[3] == pytest.approx(f[2], rel=0.02)
    assert f[1] < 0.2 * old[0] and f[4] < old[1] and f[5] == pytest.approx(old[2], rel=0.02)
    softer = lubfric.traction(SCENE.with_(lubricant={"shear_modulus": 2e7}), [1e-6]).without_rolling
    assert softer[0] < f[1]
    parts = friction(elastic.with_(motion={"slide_roll_ratio": 1e-4}))
    total = parts.boundary_force + parts.couette_force + parts.rolling_force
    assert parts.coefficient == pytest.approx(total / 200.0, rel=1e-9)


def test_where_it_is_not_modelled_it_is_refused():
    elastic = SCENE.with_(lubricant={"shear_modulus": "0.2 GPa"})
    assert elastic.lubricant.shear_modulus == 2e8
    with pytest.raises(InputError, match="shear_modulus"):
        friction(elastic.with_(numerics={"model": "deterministic"}))
    with pytest.raises(InputError, match="shear_modulus"):
        elastic.with_(transient=lubfric.Transient(1e-4))
    with pytest.raises(InputError, match="shear_modulus"):
        SCENE.with_(lubricant={"shear_modulus": 0.0})
