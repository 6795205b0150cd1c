"""Which pressure deflects the film, chosen by a number: its estimate bounds the change, the limits are right, and it is
told."""

import numpy as np
import pytest

import lubfric
from lubfric.sharing.deflection import own_pressure_error

HEAVY = (
    lubfric.load_scene("paper")
    .with_(numerics={"sampling": "patch"})
    .with_(
        bodies={
            "radius": 0.01,
            "hertz_pressure": 0.95e9,
            "width": 0.01,
            "e_prime": 2.27e11,
            "boundary_friction_coefficient": 0.12,
        },
        lubricant={"viscosity": 0.02, "pressure_viscosity_coefficient": 2e-8, "eyring_stress": 5e6}
        | {"limiting_stress_coefficient": 0.06},
        contact={"shape": (128, 64), "spacing": 4e-6},
        surface={"sq": 1e-7, "correlation_length": 3e-5, "acf": "gaussian"},
        numerics={"film_deflection": "auto"},
    )
)


def by(scene, option, speed, **like):
    return lubfric.friction(scene.with_(numerics={"film_deflection": option}), speed, **like)


def test_boundary_limit_at_heavy_load():
    curve = lubfric.stribeck(HEAVY, [1e-5, 1e-4, 1e-3])
    assert curve.coefficient[0] == pytest.approx(0.12, rel=0.01)
    assert by(HEAVY, "hydrodynamic", 1e-5).coefficient < 0.07  # what the film's own pressure alone leaves
    assert all("whole load" in p.decision.deflection for p in curve.points)
    assert not any("does not tend" in text for text in curve.validity)


def test_the_paper_keeps_its_own_pressure_and_its_numbers():
    paper = lubfric.load_scene("paper").with_(numerics={"sampling": "patch"})
    assert paper.numerics.film_deflection == "hydrodynamic"
    for speed in (0.003, 0.03, 0.3):
        auto = by(paper, "auto", speed)
        if "own pressure, at most" in auto.decision.deflection or auto.contact_load == 0:
            assert auto.coefficient == pytest.approx(lubfric.friction(paper, speed).coefficient, rel=2e-3)
        assert auto.coefficient == pytest.approx(lubfric.friction(paper, speed).coefficient, rel=0.01)


@pytest.mark.parametrize("seed", range(6))
def test_the_estimate_bounds_the_change(seed):
    rng = np.random.default_rng(seed)
    length = 10 ** rng.uniform(-5.2, -4.7)
    scene = HEAVY.with_(
        bodies={"hertz_pressure": 10 ** rng.uniform(7.8, 8.4), "radius": 3e-3, "hardness": None},
        surface={"sq": 10 ** rng.uniform(-7, -6.3), "correlation_length": length},
        contact={"shape": (96, 48), "spacing": 2.2e-6},
    )
    speed = 10 ** rng.uniform(-3, -1)
    own, scaled = by(scene, "hydrodynamic", speed), by(scene, "scaled", speed)
    if own.contact_load == 0:
        pytest.skip("separated")
    found = own_pressure_error(scene, own.balance)
    assert abs(own.coefficient / scaled.coefficient - 1) <= found + 0.006  # both are solved to 1 %
    auto = by(scene, "auto", speed)
    chosen = own if found <= 0.005 else scaled
    assert auto.coefficient == pytest.approx(chosen.coefficient, rel=2e-3)  # from another start


def test_a_tighter_tolerance_asks_for_the_whole_load_earlier():
    paper = (
        lubfric.load_scene("paper").with_(numerics={"sampling": "patch"}).with_(numerics={"film_deflection": "auto"})
    )
    loose, tight = (lubfric.friction(paper, 0.03, tolerance=t) for t in (0.1, 0.002))
    assert "own pressure, at most" in loose.decision.deflection and "whole load" in tight.decision.deflection


def test_films_in_time_keep_their_own_pressure():
    from lubfric.time.begin import begin

    small = (
        lubfric.load_scene("paper")
        .with_(numerics={"sampling": "patch"})
        .with_(contact={"shape": (64, 64), "spacing": 0.9e-6}, transient=lubfric.Transient(duration=1e-3))
    )
    (_, one, _), (_, other, _) = (
        begin(small.with_(numerics={"film_deflection": deflection})) for deflection in ("auto", "hydrodynamic")
    )
    assert np.array_equal(one.terms.P, other.terms.P)
    with pytest.raises(lubfric.InputError, match="auto"):
        begin(small.with_(numerics={"film_deflection": "scaled"}))


@pytest.mark.parametrize("error", [lubfric.ConvergenceError("no", None), lubfric.InputError("a range")])
def test_a_choice_that_fails_does_not_fail_the_point(monkeypatch, error):
    """The loose solve that chooses is broken; the point is the answer of the safer level, and says so."""
    from lubfric.sharing import deflection

    whole = deflection.solved

    def broken(prepared, *args, **keywords):
        if prepared.scene.numerics.tolerance == deflection.LOOSE["tolerance"]:
            raise error
        return whole(prepared, *args, **keywords)

    monkeypatch.setattr(deflection, "solved", broken)
    found = by(HEAVY, "auto", 1e-3)
    assert found.coefficient == by(HEAVY, "scaled", 1e-3).coefficient
    assert "the solve that was to choose failed" in found.decision.text


@pytest.mark.parametrize("pressure, speeds", [(0.95e9, [1e-3, 1e-2, 0.1]), (0.15e9, [1e-3, 5e-3, 0.02, 0.05, 0.1])])
def test_a_neighbour_does_not_change_the_choice(pressure, speeds):
    """Each speed of a curve, which starts from its neighbour's choice, is solved as it is alone: mostly by the whole
    load, and from one way to the other on the way down the lighter curve."""
    scene = HEAVY.with_(bodies={"hertz_pressure": pressure})
    curve = lubfric.stribeck(scene, speeds)
    ways = []
    for speed, found in zip(speeds, curve.points):
        alone = lubfric.friction(scene, speed)
        assert found.coefficient == pytest.approx(alone.coefficient, rel=2e-3)
        ways.append("whole load" in found.decision.deflection)
        assert ways[-1] == ("whole load" in alone.decision.deflection)
    assert all(ways) if pressure > 0.5e9 else 0 < sum(ways) < len(ways)


LEFT_OUT = HEAVY.with_(
    bodies={"hertz_pressure": 1.5e8, "radius": 3e-3, "hardness": None},
    surface={"sq": 2e-7, "correlation_length": 1.2e-5},
    contact={"shape": (96, 48), "spacing": 2.2e-6},
)


@pytest.mark.parametrize("sampling", ["patch", "line"])
def test_what_the_choice_leaves_out_is_part_of_every_error(sampling):
    scene, speed = LEFT_OUT.with_(numerics={"sampling": sampling}), 0.2
    own, whole, named = by(scene, "auto", speed), by(scene, "scaled", speed), by(scene, "hydrodynamic", speed)
    assert own.decision.deflected_by == "hydrodynamic"
    for name in ("coefficient", "contact_load", "film_load", "shear_force", "min_film", "central_film", "mean_gap"):
        change = abs(getattr(whole, name) / getattr(own, name) - 1)
        assert getattr(own.errors, name) >= change, name
    change = abs(whole.coefficient / own.coefficient - 1)
    assert own.uncertainty.numerical >= change > named.uncertainty.numerical  # named, it is not left out but asked for
