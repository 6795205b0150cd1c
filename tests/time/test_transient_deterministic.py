"""Runs in time with one gap and one pressure: the steady limits, the smooth film, reversal, order, resume."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

import lubfric
from lubfric.models.deterministic import RoughBody, solve_moving_strip
from lubfric.scene import Harmonic, Ramp, Table, Transient
from lubfric.time import Memory, start_deterministic

CELL = 4e-6
SCENE = lubfric.load_scene("paper").with_(
    bodies={"radius": 5e-3, "load": 20.0, "width": 1e-3, "e_prime": 2.2e11, "hardness": None},
    lubricant={"viscosity": 0.05, "pressure_viscosity_coefficient": 15e-9, "eyring_stress": 5e6},
    motion={"slide_roll_ratio": 0.5, "entrainment_speed": 0.3},
    surface={"sq": 5e-8, "correlation_length": 12e-6, "seed": 3},
    contact={"shape": (24, 12), "spacing": CELL},
    numerics={"model": "deterministic", "sampling": "patch", "grid": "given", "accept": True},
)
OWN = 0.3 * 0.75  # m/s, of surface 1


def run(plan, times=None, **sections):
    return lubfric.transient(SCENE.with_(transient=plan, **sections), times)


def test_at_constant_speed_it_is_the_steady_answer_of_moving_roughness():
    """Of roughness slower than U/2, which moves by a cell in every step of both."""
    motion = {"slide_roll_ratio": 1.5}
    surface = lubfric.prepare(SCENE).surface
    steady = solve_moving_strip(SCENE.with_(motion=motion), [RoughBody(surface, 0.3 * 0.25)], 0.3)
    result = run(Transient(1.0, tolerance=0.1), steady.times[steady.discarded - 1 :], motion=motion)
    assert result.report.converged and result.mass_residual.max() <= 1e-3
    f = result.coefficient[1:]
    gap = result.mean_gap[1:]
    assert f.mean() == pytest.approx(steady.result.coefficient, rel=5e-3)
    np.testing.assert_allclose(gap, steady.series["mean_gap"][steady.discarded :], rtol=0.02)


FALLING = Transient(4e-4, speed=0.0, initial_film=5e-7)


SWINGING = Transient(4e-4, load=Harmonic(mean=15.0, amplitude=5.0, frequency=5e3))


@pytest.mark.parametrize("plan", [pytest.param(SWINGING, marks=pytest.mark.slow), FALLING])
def test_smooth_bodies_have_the_smooth_film_of_a_run(plan):
    """By another program: complementarity on a graded grid."""
    smooth = {"sq": 0.0}
    fine = {"shape": (64, 32), "spacing": 1.5e-6}
    result = run(plan, np.linspace(0, 4e-4, 9), surface=smooth, contact=fine)
    film = run(plan, result.time, surface=smooth, numerics={"model": "paper"})
    np.testing.assert_allclose(result.central_film[1:], film.central_film[1:], rtol=0.015)
    np.testing.assert_allclose(result.coefficient[1:], film.coefficient[1:], rtol=0.02, atol=2e-4)
    assert np.ptp(film.central_film) > 0.05 * film.central_film.mean()


def test_of_either_sense_of_sliding_the_film_rolls_the_same_way():
    there, back = (
        run(Transient(2e-5, outputs=1), surface={"sq": 0.0}, motion={"slide_roll_ratio": s}) for s in (0.02, -0.02)
    )
    np.testing.assert_allclose(back.couette_force, -there.couette_force, rtol=1e-6)
    np.testing.assert_allclose(back.rolling_force, there.rolling_force, rtol=1e-6)
    assert there.rolling_force.min() > 0


def test_heat_that_it_omits_is_reported_with_its_size():
    """That of the steady answer, which has it."""
    oil = {"temperature_celsius": 70, "temperature_coefficient": 0.04, "viscosity": 0.2}
    scene = {"surface": {"sq": 0.0}, "lubricant": oil, "motion": {"slide_roll_ratio": 1.0, "entrainment_speed": 2.0}}
    hot, cold = (
        run(Transient(1e-6, outputs=1), **scene, numerics={"accept": True, "heat": heat}) for heat in ("auto", "off")
    )
    stated = [e.value for entries in hot.violations for e in entries if e.what == "loss of film or f by heat"]
    steady = lubfric.friction(SCENE.with_(**scene, numerics={"heat": "on", "model": "paper"}))
    assert stated == pytest.approx(2 * [1 - steady.inlet_film_factor], rel=1e-9) and stated[0] > 0.2
    assert not any("by heat" in text for text in cold.validity)
    with pytest.raises(lubfric.InputError, match="numerics.heat = 'on'"):
        run(Transient(1e-6), **scene, numerics={"heat": "on"})


@pytest.mark.slow
def test_it_stops_squeezes_and_starts_again():
    speed = Table(times=(0.0, 1e-4, 1.5e-4, 6e-4, 7e-4, 1e-3), values=(0.3, 0.3, 0.0, 0.0, 0.3, 0.3))
    result = run(Transient(1e-3, speed=speed), [0.0, 1e-4, 1.5e-4, 6e-4, 1e-3], surface={"sq": 1.2e-7})
    assert result.report.converged
    assert result.contact_load[3] > 2 * result.contact_load[2]
    assert result.central_film[3] < 0.9 * result.central_film[2]
    assert result.entrainment_speed[3] == 0 and abs(result.coefficient[3]) < 1e-3
    assert result.contact_load[-1] < 0.3 * result.contact_load[3]


def test_motion_backwards_is_the_mirror_image():
    plan = Transient(2e-4, speed=Ramp(start=0.2, end=0.3, until=1e-4))
    surface = lubfric.prepare(SCENE).surface
    there = lubfric.transient(lubfric.prepare(SCENE.with_(transient=plan), surface), [0.0, 1e-4, 2e-4])
    turned, plan = (
        replace(surface, heights=surface.heights[::-1]),
        replace(plan, speed=Ramp(start=-0.2, end=-0.3, until=1e-4)),
    )
    back = lubfric.transient(lubfric.prepare(SCENE.with_(transient=plan), turned), [0.0, 1e-4, 2e-4])
    np.testing.assert_allclose(back.coefficient, there.coefficient, rtol=1e-3)
    np.testing.assert_allclose(back.friction_force, -there.friction_force, rtol=1e-3)
    mirrored = np.interp(-there.x, back.x, back.pressure[-1])
    np.testing.assert_allclose(mirrored, there.pressure[-1], atol=2e-3 * there.max_pressure[-1])
    assert np.abs(mirrored - mirrored[::-1]).max() > 0.1 * mirrored.max()


def test_each_surface_is_displaced_by_the_integral_of_its_own_speed():
    speed = Harmonic(amplitude=0.3, frequency=900.0)
    sliding = Ramp(start=0.0, end=0.4, until=1e-3)
    rough = {"sq": 5e-8, "correlation_length": 12e-6, "acf": "gaussian"}
    scene = SCENE.with_(
        surface=rough, counterface=rough, numerics={"sampling": "strips"}, contact={"shape": (24, 24)},
        transient=Transient(2e-3, speed=speed, sliding=sliding),
    )  # fmt: skip
    solver = start_deterministic(scene).model
    for name, side in (("surface", -0.5), ("counterface", 0.5)):
        way = quad(lambda t: speed.at(t) + side * sliding.at(t), 0, 1.7e-3, points=[1e-3], epsabs=1e-15)[0]
        assert way == pytest.approx(speed.integral(1.7e-3) + side * sliding.integral(1.7e-3), rel=1e-9)
        assert abs(way) > solver.base.spacing[0]
    at = solver.problem_at(1.7e-3)
    assert speed.at(1.7e-3) < 0 and np.allclose(at.upper, solver.heights["counterface"](way)[::-1])
    assert np.allclose(at.heights - at.upper, solver.heights["surface"](way - sliding.integral(1.7e-3))[::-1])


@pytest.mark.parametrize(
    "history",
    [
        Table(times=(0.0, 1.0, 1.0, 3.0), values=(1.0, 2.0, -1.0, 0.5), repeat=True),
        Table(times=(-1.0, 1.0, 9.0), values=(1.0, 2.0, -1.0)),
        Ramp(start=1.0, end=-2.0, begin=1.0, until=4.0),
        Harmonic(amplitude=2.0, mean=0.3, frequency=0.4, phase=0.7),
    ],
)
def test_integrals_of_histories(history):
    for time in (0.0, 0.5, 2.0, 7.4):
        corners = [c for c in (1.0, 3.0, 4.0, 6.0, 7.0) if c < time]
        expected = quad(history.at, 0, time, points=corners or None, limit=200)[0]
        assert history.integral(time) == pytest.approx(expected, abs=1e-9)


def test_steps_are_of_second_order(monkeypatch):
    """A rough body under a load that swings: BDF2 from its own memory, in steps of a half and a quarter."""
    monkeypatch.setattr("lubfric.time.transient_deterministic.RUN_STEP_RESIDUAL", 1e-9)
    plan = Transient(1.0, load=Harmonic(mean=15.0, amplitude=4.0, frequency=4e3))
    begin = start_deterministic(SCENE.with_(transient=plan, surface={"sq": 5e-9}))
    solver = begin.model
    start = begin.state

    def after(count):
        step = 1e-4 / count
        films = [start.film]
        now = start
        for k in range(1, count + 1):
            memory = Memory(1 / step, films[-1])
            if k > 1:
                memory = Memory(1.5 / step, (4 * films[-1] - films[-2]) / 3)
            now = solver.solve(k * step, memory, now.z, now.payload)
            assert now.status == "converged"
            films.append(now.film)
        return films[-1]

    films = [after(n) for n in (8, 16, 32)]
    errors = [np.abs(fine - coarse).mean() for coarse, fine in pairwise(films)]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.4)


def test_a_killed_run_goes_on_to_the_same_bits(tmp_path):
    plan = Transient(1e-4, outputs=3, speed=Harmonic(mean=0.1, amplitude=0.3, frequency=8e3))
    whole = run(plan)
    seen = []

    def stop(*now):
        seen.append(now)
        if len(seen) == 7:
            raise KeyboardInterrupt

    scene = SCENE.with_(transient=plan)
    with pytest.raises(KeyboardInterrupt):
        lubfric.transient(scene, checkpoint=tmp_path / "kept", on_step=stop)
    again = lubfric.transient(scene, checkpoint=tmp_path / "kept")
    for name, values in whole.columns.items():
        np.testing.assert_array_equal(again.columns[name], values)
    assert np.array_equal(again.pressure, whole.pressure) and whole.report.iterations > 9
    assert whole.x[0] == pytest.approx(-whole.x[-1], abs=2 * CELL)  # it turns round: an inlet on either side


def test_what_it_cannot_do_is_refused():
    with pytest.raises(lubfric.InputError, match="would move by"):
        run(Transient(1e3))
    with pytest.raises(lubfric.InputError, match="initial_film.*more than"):
        run(Transient(1e-4, initial_film=1e-9))
    with pytest.raises(lubfric.InputError, match="geometry"):
        run(Transient(1e-4), contact={"geometry": "flat"})
