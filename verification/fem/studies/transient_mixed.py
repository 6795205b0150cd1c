"""Load sharing in time: the paper scene ramped, stopped, reversed; error of friction for step and grid."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

import lubfric
from lubfric.models import prepare
from lubfric.models.shared import Prepared
from lubfric.scene import Harmonic, Ramp, Transient
from lubfric.scene import Table as History

from ...check import AT_LEAST, AT_MOST, Check, Item, bound
from ...pace import paced
from ...types import FloatArray, Option

LARGEST = 0.05  # m/s
PERIODS = (2.5e-3, 1e-2, 0.2)
CELLS = {"quick": 64, "default": 128, "full": 200}
STEADY = "lubfric.friction, the steady solver"


def transient_mixed(level: str) -> Iterator[Item]:
    """Film and rough contact share the load at each moment; the film depends on its history.

    The scene is that of the paper, with a generated surface instead of the measured one. Slow changes must follow the
    Stribeck curve, and a constant scene its steady answer. Fast changes deviate from it: the film is thicker during
    deceleration and thinner during acceleration, so the friction loop widens with the frequency. The error of friction
    over the time tolerance and over the film's grid is measured from the finest of each. Last comes the cost of a
    cycle of 300 steps.
    """
    n = CELLS[level]
    contact = {"shape": (n, n), "spacing": 90e-6 / n}
    motion = {"entrainment_speed": LARGEST}
    scene = lubfric.load_scene("paper").with_(
        contact=contact, motion=motion, numerics={"sampling": "patch", "model": "paper"}
    )
    model = prepare(scene)
    yield from steady(model)
    yield from loops(model)
    yield from stop_and_start(model)
    yield from errors(model)
    yield from cost()


def run(
    model: Prepared, plan: Transient, times: FloatArray | list[float] | None = None, **numerics: Option
) -> lubfric.TransientResult:
    """Return `lubfric.transient` of a prepared model with another plan (and numerics)."""
    scene = replace(model.scene, transient=plan).with_(numerics=numerics)
    return lubfric.transient(prepare(scene, like=model), times)


def wave(amplitude: float, frequency: float, mean: float = 0.0) -> Harmonic:
    """Return a speed that swings about ``mean`` from its largest value [m/s, Hz]."""
    return Harmonic(mean=mean, amplitude=amplitude, frequency=frequency, phase=np.pi / 2)


def steady(model: Prepared) -> Iterator[Item]:
    """The scene held, and ramped slowly through lift-off."""
    fine = prepare(model.scene.with_(numerics={"tolerance": 2e-3}), like=model)
    held = run(fine, Transient(1.0), [0.0, 0.1, 1.0])
    point = lubfric.friction(fine)
    yield Check(
        "held in time: friction", held.coefficient[-1], expected=point.coefficient, tolerance=2e-3, source=STEADY
    )
    yield bound("held in time: drift", float(np.ptp(held.coefficient)) / point.coefficient, 5e-4, "a steady state")
    ramp = Ramp(start=0.005, end=0.15, until=4.0)
    slow = run(model, Transient(4.0, speed=ramp), np.linspace(0, 4, 13))
    curve = lubfric.stribeck(model, slow.entrainment_speed)
    off = np.max(np.abs(slow.coefficient / curve.coefficient - 1))
    yield bound("slow ramp: largest departure from the Stribeck curve", float(off), 0.01, STEADY)
    lost = np.max(slow.mass_residual)
    yield bound("mass of the pressurised film: largest residual", float(lost), 1e-3, "balance over the step")


def loops(model: Prepared) -> Iterator[Item]:
    """Friction loops at three frequencies of a speed that pulsates without reversing, and of one that reverses."""
    opening = []
    for period in PERIODS:
        plan = Transient(2 * period, speed=wave(0.94 * LARGEST, 1 / period, LARGEST))
        history = run(model, plan, period * np.linspace(0, 2, 81))
        opening.append(history.coefficient[70] - history.coefficient[50])  # up minus down at the mean speed
    name = "hysteresis: f speeding up above f slowing down (shortest period)"
    source = "the film lags behind the speed"
    yield Check(name, opening[0], expected=1e-3, tolerance=0.0, source=source, kind=AT_LEAST)
    name = "hysteresis: longest period against shortest"
    closed = abs(opening[-1] / opening[0])
    yield bound(name, closed, 0.1, "slow loops close on the Stribeck curve")
    period = PERIODS[1]
    plan = Transient(2.5 * period, speed=wave(LARGEST, 1 / period))
    history = run(model, plan, period * np.linspace(0, 2.5, 101))
    change = np.max(np.abs(history.coefficient[60:101] / history.coefficient[20:61] - 1))
    yield bound("reciprocating: third cycle against the second", change, 5e-3, "a periodic run becomes periodic")
    share = history.film_load[90] / history.load[90]
    yield Check(
        "reciprocating: lubricant held at U = 0 carries load",
        share,
        expected=0.05,
        tolerance=0.0,
        source="squeeze",
        kind=AT_LEAST,
    )


def stop_and_start(model: Prepared) -> Iterator[Item]:
    """Shut-down, standstill and start-up."""
    plan = Transient(0.02, speed=History(times=(0, 5e-3, 1e-2, 1.5e-2, 0.02), values=(0.1, 0, 0, 0.1, 0.1)))
    history = run(model, plan, np.linspace(0, 0.02, 161))
    down = history.time <= 5e-3
    up = (history.time >= 1e-2) & (history.time <= 1.5e-2)
    low = np.interp(0.04, history.entrainment_speed[down][::-1], history.coefficient[down][::-1])
    high = np.interp(0.04, history.entrainment_speed[up], history.coefficient[up])
    name = "start-up friction over shut-down friction at 0.04 m/s"
    yield Check(name, high / low, expected=1.1, tolerance=0.0, source="the film lags", kind=AT_LEAST)
    remaining = history.film_load[(history.time > 9e-3) & (history.time <= 1e-2)][-1] / history.load[0]
    name = "after 5 ms of rest the contact carries the load: share left to the film"
    yield bound(name, remaining, 5e-3, "squeeze decays against the contact")


def errors(model: Prepared) -> Iterator[Item]:
    """Error of friction against time for the time tolerance and the grid."""
    times = np.linspace(0, 0.01, 26)
    speed = wave(LARGEST, 100.0)
    tight = {"balance_tolerance": 1e-5, "contact_tolerance": 1e-5}

    def solved(film: float, step: float) -> lubfric.TransientResult:
        return run(model, Transient(0.01, speed=speed, tolerance=step), times, film_tolerance=film, **tight)

    reference = solved(1e-3, 1e-6).coefficient
    for name, film, step, source in (
        ("step tolerance (3e-5)", 1e-3, 3e-5, "tolerance 1e-6"),
        ("film tolerance (3e-3)", 3e-3, 1e-6, "film tolerance 1e-3"),
    ):
        error = np.max(np.abs(solved(film, step).coefficient - reference))
        yield bound(f"default {name}: error of f", error, 1e-3, source)


def cost() -> Iterator[Item]:
    """The paper's own grid, in 300 steps of a reciprocating cycle."""
    scene = lubfric.load_scene("paper").with_(transient=Transient(0.1, outputs=300, speed=wave(0.03, 10.0)))
    history, seconds = paced(lambda: lubfric.transient(scene))
    name = f"paper scene, {history.report.iterations} steps of a cycle: processor time on the stated core"
    yield Check(name, seconds, expected=30.0, tolerance=0.0, source="target", kind=AT_MOST, unit="s")
