"""Load sharing in time: the paper scene ramped, stopped, reversed; error of friction for step and grid."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import lubfric
from lubfric.history import Harmonic, Ramp
from lubfric.history import Table as History
from lubfric.history.plan import Transient
from lubfric.prepared import prepare

from .. import plotting
from ..check import AT_LEAST, AT_MOST, Check
from ..pace import paced

LARGEST = 0.05  # m/s
PERIODS = (2.5e-3, 1e-2, 0.2)
CELLS = {"quick": 64, "default": 128, "full": 200}
STEADY = "lubfric.friction, the steady solver"


def transient_mixed(level: str):
    """Film and rough contact share the load of the moment, while the film remembers its past.

    It is the paper's scene, for which a generated surface stands in for the measured one. Slow changes must follow the
    Stribeck curve, and a scene that is held its steady answer. Fast changes leave it: slowing down drags a thick film
    along, speeding up a thin one, so the friction loop opens with frequency. The error of friction against time is
    charted for the time tolerance and for the film's grid, against the finest of each. So is the cost of a cycle of 300
    steps.
    """
    n = CELLS[level]
    scene = lubfric.load_scene("paper").with_(
        contact={"shape": (n, n), "spacing": 90e-6 / n},
        motion={"entrainment_speed": LARGEST},
        numerics={"sampling": "patch"},
    )
    model = prepare(scene)
    yield from steady(model)
    yield from loops(model)
    yield from stop_and_start(model)
    yield from errors(model)
    yield from cost()


def run(model, plan: Transient, times=None, **numerics):
    """`lubfric.transient` of a prepared model with another plan (and numerics)."""
    scene = replace(model.scene, transient=plan)
    return lubfric.transient(replace(model, scene=scene.with_(numerics=numerics) if numerics else scene), times)


def steady(model):
    """The scene held, and ramped slowly through lift-off."""
    fine = replace(model, scene=model.scene.with_(numerics={"tolerance": 2e-3}))
    held = run(fine, Transient(1.0), [0.0, 0.1, 1.0])
    point = lubfric.friction(fine)
    yield Check("held in time: friction", held.coefficient[-1], point.coefficient, 2e-3, STEADY)
    yield Check(
        "held in time: drift", np.ptp(held.coefficient) / point.coefficient, 0.0, 5e-4, "a steady state", AT_MOST
    )
    ramp = Ramp(start=0.005, end=0.15, until=4.0)
    slow = run(model, Transient(4.0, speed=ramp), np.linspace(0, 4, 13))
    curve = lubfric.stribeck(model, slow.entrainment_speed)
    yield Check(
        "slow ramp: largest departure from the Stribeck curve",
        np.max(np.abs(slow.coefficient / curve.coefficient - 1)),
        0.0,
        0.01,
        STEADY,
        AT_MOST,
    )
    yield Check(
        "mass of the pressurised film: largest residual",
        np.max(slow.mass_residual),
        0.0,
        1e-3,
        "balance over the step",
        AT_MOST,
    )


def loops(model):
    """Friction loops at three frequencies of a speed that pulsates without reversing, and of one that reverses."""
    canvas, (left, right) = plotting.axes(1, 2, width=8.4, height=3.6)
    speeds = np.linspace(0.06, 1.94, 24) * LARGEST
    curve = lubfric.stribeck(model, speeds)
    left.plot(speeds, curve.coefficient, "k:", label="steady")
    opening = []
    for period in PERIODS:
        wave = Harmonic(mean=LARGEST, amplitude=0.94 * LARGEST, frequency=1 / period, phase=np.pi / 2)
        found = run(model, Transient(2 * period, speed=wave), period * np.linspace(0, 2, 81))
        left.plot(found.entrainment_speed[40:], found.coefficient[40:], label=f"period {1e3 * period:g} ms")
        opening.append(found.coefficient[70] - found.coefficient[50])  # up minus down at the mean speed
    left.set(xlabel="entrainment speed (m/s)", ylabel="friction coefficient (-)")
    left.legend()
    yield Check(
        "hysteresis: f speeding up above f slowing down (shortest period)",
        opening[0],
        1e-3,
        0.0,
        "the film lags behind the speed",
        AT_LEAST,
    )
    yield Check(
        "hysteresis: longest period against shortest",
        abs(opening[-1] / opening[0]),
        0.0,
        0.1,
        "slow loops close on the Stribeck curve",
        AT_MOST,
    )
    period = PERIODS[1]
    wave = Harmonic(amplitude=LARGEST, frequency=1 / period, phase=np.pi / 2)
    found = run(model, Transient(2.5 * period, speed=wave), period * np.linspace(0, 2.5, 101))
    f = found.coefficient
    yield Check(
        "reciprocating: third cycle against the second",
        np.max(np.abs(f[60:101] / f[20:61] - 1)),
        0.0,
        5e-3,
        "a periodic run becomes periodic",
        AT_MOST,
    )
    yield Check(
        "reciprocating: lubricant held at U = 0 carries load",
        found.film_load[90] / found.load[90],
        0.05,
        0.0,
        "squeeze",
        AT_LEAST,
    )
    right.plot(found.entrainment_speed[40:], found.friction_force[40:] / found.load[40:])
    right.set(
        xlabel="entrainment speed (m/s)", ylabel="friction force/load (-)", title=f"reversing, {1e3 * period:g} ms"
    )
    yield plotting.finish(
        "loops",
        canvas,
        "Left: friction loops of a pulsating speed; the faster it changes the wider they open about "
        "the steady curve. Right: a reversing contact.",
    )


def stop_and_start(model):
    """Shut-down, standstill and start-up."""
    plan = Transient(0.02, speed=History(times=(0, 5e-3, 1e-2, 1.5e-2, 0.02), values=(0.1, 0, 0, 0.1, 0.1)))
    found = run(model, plan, np.linspace(0, 0.02, 161))
    down, up = found.time <= 5e-3, (found.time >= 1e-2) & (found.time <= 1.5e-2)
    canvas, (left, right) = plotting.axes(1, 2, width=8.4, height=3.6)
    left.plot(found.time * 1e3, found.central_film * 1e9, label="central film")
    left.plot(found.time * 1e3, found.mean_gap * 1e9, "--", label="mean gap")
    left.set(xlabel="time (ms)", ylabel="nm", ylim=(0, None))
    left.legend()
    for name, part in (("shut-down", down), ("start-up", up)):
        moving = part & (found.sliding_speed > 0)
        right.plot(found.entrainment_speed[moving], found.coefficient[moving], label=name)
    right.set(xlabel="entrainment speed (m/s)", ylabel="friction coefficient (-)")
    right.legend()
    yield plotting.finish(
        "stop_and_start",
        canvas,
        "Shut-down and start-up within 5 ms each. While the contact stands still the film "
        "is squeezed out until the surfaces carry the load; starting up it has to be built again.",
    )
    at = 0.04
    low = np.interp(at, found.entrainment_speed[down][::-1], found.coefficient[down][::-1])
    high = np.interp(at, found.entrainment_speed[up], found.coefficient[up])
    yield Check(
        "start-up friction over shut-down friction at 0.04 m/s", high / low, 1.1, 0.0, "the film lags", AT_LEAST
    )
    rest = found.film_load[(found.time > 9e-3) & (found.time <= 1e-2)][-1] / found.load[0]
    yield Check(
        "after 5 ms of rest the contact carries the load: share left to the film",
        rest,
        0.0,
        5e-3,
        "squeeze decays against the contact",
        AT_MOST,
    )


def errors(model):
    """Error of friction against time for the time tolerance and the grid."""
    wave = Harmonic(amplitude=LARGEST, frequency=100.0, phase=np.pi / 2)
    times = np.linspace(0, 0.01, 26)
    tight = {"balance_tolerance": 1e-5, "contact_tolerance": 1e-5}

    def friction(film, step):
        found = run(model, Transient(0.01, speed=wave, tolerance=step), times, film_tolerance=film, **tight)
        return found.coefficient, found.report.iterations, int(found.report.notes[0].split()[0])

    best = friction(1e-3, 1e-6)[0]
    steps = [friction(1e-3, t) for t in (1e-3, 1e-4, 1e-5)]
    grids = [friction(t, 1e-6) for t in (2e-2, 1e-2, 3e-3)]
    canvas, (left, right) = plotting.axes(1, 2, width=8.0, height=3.4, sharey=True)
    in_time = [np.max(np.abs(f - best)) for f, *_ in steps]
    in_space = [np.max(np.abs(f - best)) for f, *_ in grids]
    left.loglog([count for _, count, _ in steps], in_time, "o-")
    left.set(xlabel="time steps in a cycle", ylabel="largest error of f (-)")
    right.loglog([cells for *_, cells in grids], in_space, "o-")
    right.set(xlabel="cells of the film's grid")
    yield plotting.finish(
        "errors",
        canvas,
        "Largest error of the friction coefficient over a reciprocating cycle of 10 ms against the "
        "finest step and grid (outputs force at least 26 steps).",
    )
    yield Check(
        "default step tolerance (3e-5): error of f",
        np.interp(np.log(3e-5), np.log([1e-5, 1e-4, 1e-3]), in_time[::-1]),
        0.0,
        1e-3,
        "tolerance 1e-6",
        AT_MOST,
    )
    yield Check("default film tolerance (3e-3): error of f", in_space[2], 0.0, 1e-3, "film tolerance 1e-3", AT_MOST)


def cost():
    """The paper's own grid, in 300 steps of a reciprocating cycle."""
    scene = lubfric.load_scene("paper").with_(
        transient=Transient(0.1, outputs=300, speed=Harmonic(amplitude=0.03, frequency=10.0, phase=np.pi / 2))
    )
    found, seconds = paced(lambda: lubfric.transient(scene))
    yield Check(
        f"paper scene, {found.report.iterations} steps of a cycle: processor time on the stated core",
        seconds,
        30.0,
        0.0,
        "asked for",
        AT_MOST,
        unit="s",
    )
