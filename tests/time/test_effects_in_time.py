"""Effects that are not modelled in a run in time: each is reported at the moment at which it changes f the most."""

import math
import re

import pytest
from scene_text import paper_scene

import lubfric
from lubfric.models.shared import UnmodelledEffect, unmodelled_effects
from lubfric.output import describe_scene
from lubfric.scene import Harmonic, Table, Transient
from lubfric.time import (
    EffectsOfMoment,
    effects_of_run,
    expected_effects_of_run,
    first_largest,
    has_steady_film,
    largest_over_time,
    rolls,
    scene_at,
    without_steady_film,
)

# Slow under a heavy load, fast under a light one.
LOAD = Table(times=(0.0, 1e-2, 2e-2), values=(2.0, 5.5, 2.0))
SPEED = Table(times=(0.0, 1e-2, 2e-2), values=(0.3, 0.03, 0.3))
RUN = paper_scene(
    contact={"shape": (48, 48), "spacing": 1.8e-6},
    numerics={"sampling": "patch", "tolerance": 0.05},
).with_(transient=Transient(duration=2e-2, outputs=8, load=LOAD, speed=SPEED))


def effect(what, change):
    return UnmodelledEffect(what=what, change=change, recommendation="what to do")


def moment(time, friction, *effects, pressure=1e8):
    return EffectsOfMoment(time=time, peak_pressure=pressure, friction=friction, effects=effects)


def test_an_effect_is_stated_where_it_changes_f_the_most_and_not_where_f_is_near_zero():
    moments = [
        moment(1.0, 0.1, effect("additive", -0.2)),
        moment(2.0, 0.02, effect("additive", -0.9), effect("inlet", 0.5)),
        moment(3.0, 1e-3, effect("additive", -60.0)),
        moment(4.0, 5e-3, effect("inlet", 2.5)),  # 8 % of the mean f
    ]
    effects = largest_over_time(moments)
    assert [(each.effect.what, each.effect.change, each.time) for each in effects] == [
        ("additive", -0.2, 1.0),
        ("inlet", 0.5, 2.0),
    ]


def test_an_effect_with_the_numbers_of_its_moment_is_stated_once():
    """The density at the peak pressure is another one at each moment."""
    scene = paper_scene(bodies={"load": 600.0, "hardness": None}, lubricant={"density_law": "constant"})
    moments = [
        moment(1.0, 0.1, *unmodelled_effects(scene.with_(bodies={"load": load}), 1e-7, 0.1, (0.05, 0.1)))
        for load in (300.0, 600.0)
    ]
    named = [each.effect for each in largest_over_time(moments) if each.effect.kind == "compressibility"]
    whats = {each.what for one in moments for each in one.effects if each.kind == "compressibility"}
    assert len(named) == 1 and len(whats) == 2


def test_an_effect_that_is_not_estimated_is_that_of_the_highest_pressure():
    unknown = effect("cover", math.nan)
    moments = [moment(1.0, 0.1, unknown), moment(2.0, 0.1, unknown, pressure=2e8), moment(3.0, 0.1, unknown)]
    (stated,) = largest_over_time(moments)
    assert (stated.time, stated.moment_in_words) == (2.0, "t = 2 s (highest pressure)")
    (known,) = largest_over_time([*moments, moment(4.0, 0.1, effect("cover", 0.3))])
    assert (known.time, known.moment_in_words) == (4.0, "t = 4 s (not estimated at 3 other moments)")


@pytest.mark.parametrize(
    "values, index", [([1, 3, 5, 4, 5.001, 1], 2), ([1, 5, 5.001, 4, 5.002], 2), ([1, 2, 3], 2), ([7], 0)]
)
def test_the_largest_of_a_symmetrical_cycle_is_that_of_its_first_half(values, index):
    assert first_largest(values) == index


def test_an_additive_is_an_effect_of_a_run_only_where_the_boundary_friction_has_no_range():
    ranged = RUN.with_(bodies={"boundary_friction_coefficient": [0.08, 0.1]})
    named = [expected_effects_of_run(scene, 1e-7, [0.0, 1e-2]) for scene in (RUN, ranged)]
    assert ["additive" in " ".join(each.effect.what for each in effects) for effects in named] == [True, False]


def test_no_output_of_a_run_has_a_larger_change_than_the_one_stated():
    prepared = lubfric.prepare(RUN)
    run = lubfric.transient(prepared)
    stated = {each.effect.what: each for each in effects_of_run(prepared, run)}
    largest: dict[str, float] = {}
    for i in rolls(run.columns).nonzero()[0]:
        f = abs(run.coefficient[i])
        effects = unmodelled_effects(
            scene_at(RUN, run.time[i]),
            prepared.surface.sq,
            abs(run.entrainment_speed[i]) if has_steady_film(RUN, run.time[i]) else 0.0,
            (abs(run.boundary_force[i] / run.load[i]), f),
            run=RUN,
            includes_motion=False,
        )
        for each in effects:
            largest[each.what] = max(largest.get(each.what, 0.0), abs(each.change) * f)
    assert stated.keys() == largest.keys()
    known = {what: each for what, each in stated.items() if math.isfinite(each.effect.change)}  # NaN is not estimated
    for what, each in known.items():
        f = abs(run.coefficient[run.time == each.time][0])
        assert abs(each.effect.change) * f == pytest.approx(largest[what]), what
    assert len({each.time for each in known.values()}) > 1


def test_info_states_the_effects_of_the_slow_moment_of_high_pressure_too():
    """At the largest speed the film hides the roughness, and neither running-in nor an additive changes f."""
    text = " ".join(describe_scene(RUN).split("effects not modelled")[1].split())
    assert "at t = 10 ms: another additive" in text


def reversing():
    """A ring under 250 MPa that reverses at 2 ms with 2120 m/s²."""
    speed = Harmonic(amplitude=6.75, frequency=50.0, phase=math.pi - 2 * math.pi * 50.0 * 2e-3)
    scene = paper_scene(
        motion={"entrainment_speed": 6.0, "slide_roll_ratio": 2.0},
        lubricant={"oil": "mineral-100", "temperature_celsius": 80.0},
        contact={"shape": (48, 48), "spacing": 1.8e-6},
        numerics={"sampling": "patch"},
    )
    return scene.with_(transient=Transient(duration=4e-3, outputs=8, speed=speed))


def test_a_film_is_steady_where_the_speed_passes_the_contact_before_it_changes():
    """About a reversal the speed is a t: the contact of 2 b is passed where a t² / 2 > 2 b."""
    run = reversing()
    bodies = run.bodies
    half_width = lubfric.film.hertz.line_half_width(bodies.load / bodies.width, bodies.radius, bodies.e_prime)
    least = math.sqrt(2 * 2 * half_width / (6.75 * 2 * math.pi * 50.0))
    for part, is_steady in ((-1.1, True), (-0.9, False), (0.0, False), (0.9, False), (1.1, True)):
        assert has_steady_film(run, 2e-3 + part * least) == is_steady
    assert has_steady_film(RUN.with_(transient=Transient(duration=2e-3, outputs=8)), 1e-3)  # at one speed


def test_no_effect_of_the_film_is_stated_at_a_reversal():
    times = [0.0, 1e-3, 2e-3 + 1e-8, 3e-3]
    of_run = expected_effects_of_run(reversing(), 5e-7, times)
    (warmer,) = (each for each in of_run if "warmer" in each.effect.what)
    assert warmer.time != times[2] and warmer.effect.largest_change < 1.0
    assert any("additive" in each.effect.what and each.time == times[2] for each in of_run)
    text = " ".join(describe_scene(reversing()).split("effects not modelled")[1].split())
    assert re.search(r"At \d+ of \d+ moments, as at a reversal, no film is steady", text)
    assert without_steady_film(RUN.with_(transient=Transient(duration=2e-3, outputs=8)), times) == ""
