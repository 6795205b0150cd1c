"""Thickness of the boundary film: the load on thinner gaps compared with published laws of the asperity load ratio."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

import lubfric
from lubfric.models.deterministic import BOUNDARY_FILM, solve_strip
from lubfric.scene import Scene

from ... import plotting
from ...check import REPORTED, Check, Figure, Item, Table
from ...fem.parts import case_of_scene
from ...fem.references import load_share_band
from ...kept import Run

RATIOS = (2.0, 1.4, 1.0, 0.7, 0.4, 0.2)  # smooth central film over Sq
FILMS = (5e-9, 10e-9, 20e-9, 30e-9, 40e-9)  # m
PRESSURES = (0.5e9, 0.75e9, 1e9)  # Pa, of Hertz
SURFACES = {"Gaussian": 150e-9, "exponential": 100e-9, "plateau": 200e-9}  # Sq [m]
LENGTH = 10e-6  # m, correlation length
CELL = 2e-6  # m, length of the cells
PATCH = (128, 64)  # their number along and across


def boundary_film(level: str, run: Run = Run()) -> Iterator[Item]:
    """The load on gaps below candidates of ``bodies.boundary_film``, on rollers of 0.5 to 1 GPa with roughness at rest,
    over the ratio of the smooth central film to Sq. Four published laws of the load share span a band. The best
    candidate has the smallest largest distance from that band."""
    kinds = list(SURFACES)[:1] if level == "quick" else list(SURFACES)
    pressures = PRESSURES[:1] if level == "quick" else PRESSURES
    cases = {f"{kind}; {pressure:g} Pa": (kind, pressure) for kind in kinds for pressure in pressures}
    solved = list(run.solved(cases, shares))
    values = np.array([row for _, row in solved], float)  # cases, ratios, films
    low, high = load_share_band(RATIOS)
    off = np.maximum(np.maximum(values - high[:, None], low[:, None] - values), 0.0)
    worst = np.nanmax(off, axis=(0, 1))
    for film, distance in zip(FILMS, worst):
        yield Check(
            f"{film * 1e9:g} nm: largest distance from the band",
            distance,
            expected=0.0,
            tolerance=1.0,
            source="four laws",
            kind=REPORTED,
        )
    chosen = FILMS[int(np.argmin(worst))]
    yield Check(
        "best boundary film",
        chosen,
        expected=BOUNDARY_FILM,
        tolerance=0.0,
        source="lubfric's default",
        unit="m",
        decisive=level != "quick",
    )
    columns = ("film/Sq", "four laws", *(f"h < {film * 1e9:g} nm" for film in FILMS))
    rows = [
        (f"{ratio:g}", f"{lo:.2f}–{hi:.2f}", *(f"{np.nanmin(s):.2f}–{np.nanmax(s):.2f}" for s in at.T))
        for ratio, lo, hi, at in zip(RATIOS, low, high, values.swapaxes(0, 1))
    ]
    rows.append(("largest distance", "", *(f"{distance:.2f}" for distance in worst)))
    yield Table("boundary-film", "Share of the load on thin gaps, lowest and highest of all cases", columns, rows)
    yield drawn([f"{kind}, {pressure / 1e9:g} GPa" for (kind, pressure), _ in solved], values)


def drawn(names: list[str], values: np.ndarray) -> Figure:
    """Return the shares (cases, ratios, films) of three films over the ratio, in the band of the laws."""
    chosen = (10e-9, 20e-9, 40e-9)
    canvas, grid = plotting.axes(1, len(chosen), 9.5, 3.6, sharey=True)
    dense = np.geomspace(min(RATIOS), max(RATIOS), 100)
    for ax, film in zip(grid, chosen):
        ax.fill_between(dense, *load_share_band(dense), color="0.8", label="four published laws")
        for k, (name, at_film) in enumerate(zip(names, values[:, :, FILMS.index(film)])):
            ax.plot(RATIOS, at_film, "osD"[k // len(PRESSURES)] + ("-", "--", ":")[k % len(PRESSURES)], label=name)
        ax.set(xscale="log", xlabel="lambda ratio (film/Sq)", title=f"h < {film * 1e9:g} nm")
    grid[0].set_ylabel("asperity load ratio")
    canvas.legend(*grid[-1].get_legend_handles_labels(), loc="outside right upper", fontsize=8, frameon=False)
    caption = "Load on gaps thinner than three candidates of the boundary film, roughness at rest"
    return plotting.finish("boundary-film", canvas, caption)


def shares(case: tuple[str, float]) -> list[list[float]]:
    """Return share of the load on gaps below each of `FILMS`, at each of `RATIOS`; NaN where it is not solved."""
    kind, pressure = case
    scene = roller(pressure)
    surface = rough(kind)
    rows = []
    start = None
    for ratio in RATIOS:
        try:
            solution = solve_strip(scene, surface, speed_of(scene, ratio * SURFACES[kind]), start=start)
        except lubfric.ConvergenceError:
            rows.append([math.nan] * len(FILMS))
            continue
        p = solution.result.pressure
        h = solution.result.gap
        rows.append([float(p[h < film].sum() / p.sum()) for film in FILMS])
        start = solution
    return rows


def roller(pressure: float) -> lubfric.Scene:
    """Return a steel roller of 6 mm with a thin oil at a Hertz ``pressure`` [Pa]."""
    return lubfric.load_scene("paper").with_(
        bodies={"radius": 6e-3, "width": 5e-3, "hertz_pressure": pressure, "boundary_friction_coefficient": 0.12},
        lubricant={
            "viscosity": 0.02,
            "pressure_viscosity_coefficient": 18e-9,
            "density_law": "dowson-higginson",
            "eyring_stress": 5e6,
            "limiting_stress_coefficient": 0.06,
        },
    )


def rough(kind: str) -> lubfric.Surface:
    """Return a surface of that kind; a plateau has its summits cut at 0.3 Sq."""
    acf = "exponential" if kind == "exponential" else "gaussian"
    made = lubfric.generate_surface(PATCH, CELL, sq=SURFACES[kind], correlation_length=LENGTH, acf=acf, seed=7)
    if kind == "plateau":
        made = replace(made, heights=np.minimum(made.heights, 0.3 * SURFACES[kind]), mask=None).scaled(
            sq=SURFACES[kind]
        )
    return made


def speed_of(scene: Scene, film: float) -> float:
    """Return U [m/s] at which the smooth central film is ``film`` [m] thick, by two films and a power law between
    them."""
    slow = 0.1
    fast = 1.0
    cases = (case_of_scene(scene, scene.bodies.load, speed) for speed in (slow, fast))
    first, last = (lubfric.solve_ehl(**case).central_film for case in cases)
    return float(fast * (film / last) ** (math.log(fast / slow) / math.log(last / first)))
