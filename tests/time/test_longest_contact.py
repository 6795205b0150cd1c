"""A run whose contact grows: the patch has to contain the longest contact of the run, which is known before any
solve."""

import re

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.output import describe_scene, estimate_scene
from lubfric.scene import Ramp, Table, Transient, longest_contact
from lubfric.time import make_deterministic

SQ = 1e-7
SCENE = paper_scene(
    numerics={"sampling": "patch"},
    surface={"sq": SQ, "correlation_length": 5e-6},
    contact={"shape": (128, 64), "spacing": 0.8e-6},
)
# The load is largest at 10 ms, the radius at 20 ms; the product, and with it the Hertz half-width, is so between.
SHARES = np.linspace(0.0, 1.0, 201)
LOAD = Table(times=(0.0, 0.01, 0.02), values=(1.0, 4.0, 2.0))
RADIUS = Ramp(start=0.01, end=0.02, until=0.02)


def cam(scene=SCENE, factor=1.0):
    plan = Transient(
        0.02, outputs=2, load=Table(times=LOAD.times, values=tuple(factor * v for v in LOAD.values)), radius=RADIUS
    )
    return scene.with_(bodies={"load": 4.0 * factor, "radius": 0.01}, transient=plan)


def lengths(scene, rise):
    """The length of the contact at many times, by Hertz and the parabola of the cylinder."""
    times = 0.02 * SHARES
    radius = 0.01 * (1 + SHARES)
    load = np.interp(times, LOAD.times, scene.transient.load.values)
    half_width_squared = 8 * load * radius / (np.pi * scene.bodies.e_prime * scene.bodies.width)
    return times, 2 * np.sqrt(half_width_squared + 2 * radius * rise)


@pytest.mark.parametrize("rise", [0.0, SQ, 4.5 * SQ])
def test_the_longest_contact_is_that_of_load_and_radius_together(rise):
    scene = cam()
    times, expected = lengths(scene, rise)
    found = longest_contact(scene, rise)
    bodies = found.bodies
    assert 2 * np.sqrt(bodies.half_width**2 + 2 * bodies.radius * rise) == pytest.approx(expected.max(), rel=1e-4)
    assert found.time == pytest.approx(times[expected.argmax()], abs=2e-4) and 0.005 < found.time
    assert longest_contact(SCENE).bodies == SCENE.bodies and longest_contact(SCENE).time is None


def of_length(scene, length):
    spacing = 0.8e-6
    return scene.with_(contact={"shape": (2 * round(length / spacing / 2), 64), "spacing": spacing})


def test_a_patch_shorter_than_the_longest_hertz_strip_is_refused_before_any_solve():
    """At the start, and at the values of ``bodies``, the strip is shorter than the patch."""
    scene = cam(factor=5.0)
    _, strip = lengths(scene, 0.0)
    start = 2 * scene.bodies.half_width
    assert start < 0.9 * strip.max()
    short = of_length(scene, 0.5 * (start + strip.max()))
    with pytest.raises(lubfric.InputError, match=r"at least the Hertz strip.* longest at t = 1") as caught:
        describe_scene(short)
    allowed = re.search(r"Hertz strip, ([\d.]+) µm", str(caught.value))
    assert float(allowed[1]) == pytest.approx(1e6 * strip.max(), rel=1e-3)
    lubfric.prepare(short.with_(transient=None))


def test_a_patch_that_may_cut_the_contact_off_is_named_before_the_run():
    scene = cam()
    times, expected = lengths(scene, SQ)
    cells = int(np.ceil(expected.max() / 0.8e-6))
    short = of_length(scene, 0.9 * expected.max())
    (line,) = [text for text in estimate_scene(short, *ready(short)).refusals if "length of the patch" in text]
    moment = re.search(r"longer than the patch at t = ([\d.]+) ms", line)
    assert float(moment[1]) == pytest.approx(1e3 * times[expected.argmax()], abs=0.2)
    assert f"at least {cells} cells along x" in line
    assert line in describe_scene(short)
    longer = of_length(scene, 1.1 * expected.max())
    assert not estimate_scene(longer, *ready(longer)).refusals


def ready(scene):
    prepared = lubfric.prepare(scene)
    return prepared.sample, prepared.surface


def test_generated_strips_contain_the_longest_contact():
    scene = cam().with_(numerics={"sampling": "strips"})
    surface = lubfric.prepare(scene).surface
    _, expected = lengths(scene, 4.5 * SQ)
    _, at_start = lengths(cam(), 4.5 * SQ)
    assert expected.max() <= surface.size[0] < 1.1 * expected.max() and at_start[0] < expected.max()


def test_the_film_of_a_deterministic_run_contains_the_longest_contact():
    """Its grid begins three Hertz half-widths upstream, at least."""
    scene = of_length(cam(factor=40.0), 2e-4).with_(numerics={"model": "deterministic"}, surface={"sq": 1e-9})
    x = make_deterministic(scene).x
    _, strip = lengths(scene, 0.0)
    assert x[0] <= -1.5 * strip.max() and x[-1] >= 0.9 * strip.max()
