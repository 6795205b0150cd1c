"""The power loss against the energy that the film dissipates, and against closed forms of sliding and rolling."""

import dataclasses

import numpy as np
import pytest
from scene_text import paper_scene
from scipy.integrate import cumulative_trapezoid

import lubfric

SMOOTH = paper_scene(surface={"sq": 0.0, "correlation_length": 8e-6}, contact={"shape": (32, 32), "spacing": 4e-6})
ROUGH = paper_scene(
    contact={"shape": (48, 48), "spacing": 1.1e-6},
    surface={"correlation_length": 4e-6},
    numerics={"sampling": "patch", "model": "paper"},
)


def with_inlet(film):
    """x, p, h and the viscosity at the nodes of a film, with its parabolic inlet far upstream, where Reynolds' equation
    gives the gradient of pressure."""
    first = film.x[0]
    x = first * np.geomspace(300.0, 1.0, 4000)[:-1]
    h = film.film_thickness[0] + (x**2 - first**2) / (2 * film.radius)
    slope = 12 * film.viscosity[0] * film.entrainment_speed * (h - film.flow_film) / h**3
    p = cumulative_trapezoid(slope, x, initial=0.0)
    full = film.x <= film.rupture
    eta = np.append(np.full(x.size, film.viscosity[0]), film.viscosity[full])
    parts = (x, film.x[full]), (p, film.pressure[full]), (h, film.film_thickness[full])
    return *map(np.concatenate, parts), eta


def dissipated(film, width, sliding):
    """Viscous heat [W] of a Newtonian film: of the shear by sliding, and of the flow by the gradient of pressure."""
    x, p, h, eta = with_inlet(film)
    h = 0.5 * (h[1:] + h[:-1])
    eta = np.sqrt(eta[1:] * eta[:-1])
    per_area = eta * sliding**2 / h + h**3 * (np.diff(p) / np.diff(x)) ** 2 / (12 * eta)
    return width * float(np.sum(per_area * np.diff(x)))


@pytest.mark.parametrize("ratio", [0.0, 0.02, -0.02, 1.0])
def test_the_power_is_what_a_smooth_film_dissipates(ratio):
    """Surfaces do work on the film, and viscosity turns it into heat: two sums of different terms."""
    scene = SMOOTH.with_(
        motion={"slide_roll_ratio": ratio},
        lubricant={"viscosity_law": "constant", "pressure_viscosity_coefficient": 0.0},
    )
    result = lubfric.friction(scene, 1.0, fields=True)
    heat = dissipated(result.balance.film, scene.bodies.width, ratio * 1.0)
    assert result.power_loss == pytest.approx(heat, rel=0.02)
    low, high = result.power_loss_interval
    assert low <= result.power_loss <= high


def test_in_pure_rolling_the_power_is_the_moment_of_the_pressure_times_the_angular_speed():
    result = lubfric.friction(SMOOTH.with_(motion={"slide_roll_ratio": 0.0}), 1.0, fields=True)
    x, p, _, _ = with_inlet(result.balance.film)
    moment = -np.trapezoid(p * x, x) * SMOOTH.bodies.width  # N m; the load leans upstream
    assert result.power_loss == pytest.approx(moment * 1.0 / SMOOTH.bodies.radius, rel=0.02)
    assert result.rolling_resistance == pytest.approx(2 * result.rolling_force, rel=1e-12)


@pytest.mark.parametrize("ratio", [2.0, -2.0])
def test_where_one_surface_rests_the_power_is_the_force_on_the_other_times_its_speed(ratio):
    """At a ratio of 2 surface 1 rests and surface 2 moves at 2 U, and the force on it is f F_T."""
    scene = ROUGH.with_(motion={"slide_roll_ratio": ratio})
    result = lubfric.friction(scene, 0.01)
    sliding = result.boundary_force + result.couette_force
    of_rolling = result.rolling_resistance / 2  # on the surface that moves, smooth film
    assert result.power_loss == pytest.approx((sliding + of_rolling) * 0.02, rel=1e-9)


def test_dry_sliding_takes_the_boundary_friction_times_the_sliding_speed():
    scene = ROUGH.with_(motion={"slide_roll_ratio": 1.0}, lubricant={"viscosity": 1e-4})
    result = lubfric.friction(scene, 1e-5)
    assert result.film_load < 1e-3 * scene.bodies.load
    f_b = scene.bodies.boundary_friction_coefficient
    assert result.power_loss == pytest.approx(f_b * scene.bodies.load * 1e-5, rel=2e-3)


def test_backwards_and_with_the_bodies_exchanged_it_is_the_same_power():
    there = lubfric.friction(SMOOTH.with_(motion={"slide_roll_ratio": 0.4}), 0.5)
    for ratio, speed in ((0.4, -0.5), (-0.4, 0.5)):
        other = lubfric.friction(SMOOTH.with_(motion={"slide_roll_ratio": ratio}), speed)
        assert other.power_loss == pytest.approx(there.power_loss, rel=1e-6)


def test_the_interval_holds_that_of_f_times_the_sliding_speed():
    result = lubfric.friction(ROUGH.with_(motion={"slide_roll_ratio": 2.0}), 0.01)
    times = ROUGH.bodies.load * 0.02
    np.testing.assert_allclose(result.power_loss_interval, np.array(result.uncertainty.interval) * times, rtol=1e-9)


def test_curves_studies_and_tables_have_it(tmp_path):
    curve = lubfric.stribeck(ROUGH, [0.01, 0.1])
    points = [lubfric.friction(ROUGH, speed) for speed in (0.01, 0.1)]
    np.testing.assert_array_equal(curve.power_loss, [point.power_loss for point in points])
    np.testing.assert_array_equal(curve.power_loss_interval, [point.power_loss_interval for point in points])
    study = lubfric.study(ROUGH, {"bodies.boundary_friction_coefficient": [0.05, 0.1]}, [0.01])
    scene = ROUGH.with_(bodies={"boundary_friction_coefficient": 0.05})
    point = lubfric.friction(scene, 0.01)
    result = [study[name][0, 0] for name in ("power_loss", "power_loss_low", "power_loss_high")]
    np.testing.assert_array_equal(result, [point.power_loss, *point.power_loss_interval])
    study.to_csv(tmp_path / "study.csv")
    heading = (tmp_path / "study.csv").read_text().splitlines()[0]
    assert "power_loss [W]" in heading and "power_loss_high [W]" in heading


@pytest.mark.parametrize("model", ["paper", "deterministic"])
def test_in_time_at_a_steady_speed_it_is_that_of_the_steady_point(model):
    scene = SMOOTH.with_(motion={"slide_roll_ratio": 0.1, "entrainment_speed": 0.5}, numerics={"model": model})
    steady = lubfric.friction(scene.with_(numerics={"model": "paper"}), 0.5)
    history = lubfric.transient(dataclasses.replace(scene, transient=lubfric.Transient(2e-4, outputs=2)))
    assert history.power_loss[-1] == pytest.approx(steady.power_loss, rel=0.03)
    assert history.rolling_resistance[-1] == pytest.approx(steady.rolling_resistance, rel=0.05)


def test_where_roughness_moves_the_rolling_resistance_is_that_of_the_smooth_film():
    """The moment of its pressure over R, with Johnson's modulus; the moment on a strip is that of the summits
    passing."""
    scene = ROUGH.with_(motion={"slide_roll_ratio": 0.5}, numerics={"model": "quick"})
    result = lubfric.friction(scene, 0.1)
    assert result.decision.model == "quick"
    share = result.film_load / scene.bodies.load
    film = lubfric.solve_ehl(
        load_per_width=share * scene.bodies.load / scene.bodies.width,
        radius=scene.bodies.radius,
        e_prime=share * scene.bodies.e_prime,
        entrainment_speed=0.1,
        viscosity=scene.lubricant.viscosity,
        pressure_viscosity_coefficient=scene.lubricant.pressure_viscosity_coefficient,
    )
    x, p, _, _ = with_inlet(film)
    moment = -np.trapezoid(p * x, x) * scene.bodies.width
    assert result.rolling_resistance == pytest.approx(moment / scene.bodies.radius, rel=0.02)
    by_sliding = result.coefficient * scene.bodies.load * 0.05
    assert result.power_loss == pytest.approx(by_sliding + result.rolling_resistance * (0.1 - 0.025), rel=1e-9)
