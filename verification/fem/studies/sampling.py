"""Surfaces as a sample: their statistics compared with the laws of Gaussian surfaces, and the scatter of f compared
with its stated error."""

from collections.abc import Iterator

import numpy as np

import lubfric

from ...check import ABSOLUTE, AT_MOST, Check, Item
from ...types import Keywords

SEEDS = {"quick": 30, "default": 60, "full": 100}
SPEED = 0.01  # m/s: of mixed lubrication
ASKED = 0.02  # target standard error, relative
SQ = 100e-9  # m
LENGTH = 10e-6  # m, correlation length
CELL = 0.5e-6  # m, length of the cells
CELLS = 1024  # in a side
STEPS = (4, 20, 40)  # cells
GAUSS = "Gaussian surface with the autocorrelation exp(-(r/length)²)"


def sampling(level: str) -> Iterator[Item]:
    """Check that generated surfaces have the slope and the structure function of the requested law, that f of many
    seeds scatters by the stated standard error, and that no error exceeds its target.

    The scatter of n seeds is known to one part in the square root of 2 (n - 1); twice that is allowed.
    """
    yield from statistics()
    base = lubfric.load_scene("paper").with_(numerics={"model": "paper", "sampling_tolerance": ASKED})
    count = SEEDS[level]
    values = [lubfric.friction(base.with_(surface={"seed": seed}), SPEED) for seed in range(1, count + 1)]
    f, stated = np.array([[p.coefficient, p.uncertainty.sampling] for p in values]).T
    ratio = float(f.std(ddof=1) / f.mean() / np.sqrt(np.mean(stated**2)))
    allowed = 2 / np.sqrt(2 * (count - 1))
    name = f"scatter of f over {count} seeds, over the error stated"
    source = "chi-square law of a standard error"
    yield Check(name, ratio, expected=1.0, tolerance=allowed, source=source, kind=ABSOLUTE, grade="B")
    worst = float(stated.max() / ASKED)
    yield Check(
        "largest sampling error of f over its target",
        worst,
        expected=1.0,
        tolerance=0.0,
        source="the target",
        kind=AT_MOST,
    )


def statistics() -> Iterator[Item]:
    """Slope and structure function of one large surface: m2 = 2 Sq²/length² along each axis, and 2 Sq² (1 - acf)."""
    keys: Keywords = {"sq": SQ, "correlation_length": LENGTH, "acf": "gaussian", "seed": 3}
    z = lubfric.generate_surface((CELLS, CELLS), CELL, **keys).heights
    for axis, name in enumerate("xy"):
        waves = np.fft.fftfreq(CELLS, CELL) * 2 * np.pi
        spectrum = np.abs(np.fft.fft(z, axis=axis)) ** 2
        power = spectrum.mean(axis=1 - axis) / CELLS**2
        slope = float(np.sqrt((waves**2) @ power))
        yield Check(
            f"rms slope along {name}", slope, expected=np.sqrt(2) * SQ / LENGTH, tolerance=0.05, source=GAUSS, grade="A"
        )
    for step in STEPS:
        pairs = [np.mean((z - np.roll(z, step, axis)) ** 2) for axis in (0, 1)]
        law = 2 * SQ**2 * (1 - np.exp(-((step * CELL / LENGTH) ** 2)))
        name = f"structure function at {step * CELL / LENGTH:g} correlation lengths"
        yield Check(name, float(np.mean(pairs)), expected=law, tolerance=0.05, source=GAUSS, unit="m²", grade="A")
