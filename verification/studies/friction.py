"""The whole job of `lubfric`: what grid, patch, area A, tolerance and direction do to the coefficient of
friction.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

import lubfric
from lubfric.prepared import Prepared, prepare

from .. import plotting
from ..check import AT_LEAST, AT_MOST, Check, Table
from ..exact import Parabola
from ..rates import fitted_order

SPEEDS = (0.003, 0.01, 0.03)  # m/s, mixed lubrication
PATCH = 90e-6  # m, the paper's
LENGTH = 8e-6  # m, correlation length at 1/e
FINEST = {"quick": 128, "default": 256, "full": 512}
WIDTHS = (45e-6, 60e-6, 90e-6, 120e-6, 180e-6)
TOLERANCES = (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4)
TIGHT = {
    "tolerance": 1e-3,
    "film_tolerance": 1e-4,
    "balance_tolerance": 1e-6,
    "contact_tolerance": 1e-6,
    "model": "full",
}


def friction(level: str):
    """`lubfric.friction` on the paper's cylinder (Tables 1 and 2; generated Gaussian roughness of 100 nm, 8
    µm at 1/e).

    Full film has a closed form for its friction. Running backwards over the mirrored surface must change nothing: a
    film or a strip off by half a cell would. A sweep starts each speed from its neighbour, and has to give what each
    speed gives alone. Then come the numerical choices: the tolerance of the whole job, the cells per correlation
    length, and the area A of the volume balance, Eq. (8), in a box ever wider.
    """
    yield from full_film()
    yield from mirrored()
    yield from sweep()
    yield from contact_cells(FINEST[level])
    if level != "quick":
        yield from tolerance_of_the_job()
        yield from area_of_the_balance()
        yield from patch_size()


def scene(region: str, **numerics) -> lubfric.Scene:
    """The paper's cylinder, everything modelled tightly on the grid given, unless ``numerics`` say otherwise."""
    return lubfric.load_scene("paper").with_(contact={"region": region}, numerics=TIGHT | numerics)


def surface(shape: tuple[int, int], spacing: float, seed: int = 1, acf: str = "gaussian") -> np.ndarray:
    """Heights with the roughness of the scene, m."""
    return lubfric.generate_surface(shape, spacing, sq=100e-9, correlation_length=LENGTH, acf=acf, seed=seed).heights


def model(heights: np.ndarray, spacing: float, region: str = "hertz", **numerics) -> Prepared:
    """The scene made ready for given heights."""
    return prepare(scene(region, **numerics), lubfric.Surface(heights, (spacing, spacing)))


def blocks(heights: np.ndarray, cells: int) -> np.ndarray:
    """Means of the heights in square blocks, so many along x."""
    k = heights.shape[0] // cells
    return heights.reshape(cells, k, -1, k).mean(axis=(1, 3))


def full_film():
    """Constant viscosity at high speed: a rigid isoviscous film, whose friction has a closed form."""
    made = model(np.zeros((16, 16)), 1e-6)
    made = replace(made, scene=made.scene.with_(lubricant={"viscosity_law": "constant"}))
    point = lubfric.friction(made, 20.0, fields=True)
    b = made.scene.bodies
    exact = Parabola(made.scene.lubricant.viscosity, 20.0, b.radius, point.min_film, -1e6)
    source = "closed form, Martin 1916"
    yield Check("full film: F_H", point.film_load, exact.load * b.width, 2e-3, source, unit="N")
    yield Check("full film: Couette force", point.couette_force, exact.couette * 40.0 * b.width, 2e-3, source, unit="N")
    yield Check("full film: rolling force", point.rolling_force, exact.rolling * b.width, 2e-3, source, unit="N")


def mirrored():
    """Backwards over the mirrored surface."""
    heights = blocks(surface((64, 64), PATCH / 64), 32)
    there = lubfric.friction(model(heights, PATCH / 32), 0.01)
    back = lubfric.friction(model(heights[::-1], PATCH / 32), -0.01)
    for name in ("film_load", "coefficient"):
        yield Check(
            f"backwards over the mirrored surface: {name.replace('_', ' ')}",
            getattr(back, name),
            getattr(there, name),
            1e-4,
            "mirror symmetry of the problem",
            unit="N" if name == "film_load" else "1",
        )


def sweep():
    """A Stribeck curve against its points solved one by one."""
    made = model(blocks(surface((64, 64), PATCH / 64), 32), PATCH / 32)
    curve = lubfric.stribeck(made, SPEEDS)
    for speed, f, load in zip(SPEEDS, curve.coefficient, curve.film_load, strict=True):
        alone = lubfric.friction(made, speed)
        yield Check(
            f"sweep at {speed:g} m/s: F_H",
            load,
            alone.film_load,
            1e-3,
            "the same speed alone, from a cold start",
            unit="N",
        )
        yield Check(
            f"sweep at {speed:g} m/s: coefficient", f, alone.coefficient, 1e-3, "the same speed alone", unit="1"
        )


def contact_cells(finest: int):
    """One surface averaged in ever larger blocks: errors against the finest grid, by cells per correlation length."""
    heights = surface((finest, finest), PATCH / finest)
    grids = [n for n in (32, 64, 128, 256) if n < finest]
    reference = [lubfric.friction(model(heights, PATCH / finest), speed) for speed in SPEEDS]
    names = ("coefficient", "film_load", "mean_gap", "real_contact_area")
    errors, rows = [], []
    for n in grids:
        made = model(blocks(heights, n), PATCH / n)
        points = [lubfric.friction(made, speed) for speed in SPEEDS]
        errors.append(
            [
                max(abs(getattr(p, name) / getattr(r, name) - 1) for p, r in zip(points, reference, strict=True))
                for name in names
            ]
        )
        rows.append((n, LENGTH / PATCH * n, *errors[-1]))
    columns = np.array(errors).T
    cells = [LENGTH / PATCH * n for n in grids]
    labels = ("f", "F_H", "mean gap", "contact area")
    bounds = {128: (1.5e-2, 2e-2, 2e-2, 0.3)}.get(finest, (3e-3, 4e-3, 4e-3, 0.15))
    for label, column, bound in zip(labels, columns, bounds, strict=True):
        yield Check(
            f"contact grid: {label}, {cells[-1]:.1f} cells per correlation length",
            column[-1],
            0.0,
            bound,
            f"{finest} x {finest} cells of the same surface",
            AT_MOST,
        )
    if len(grids) > 2:
        yield Check(
            "contact grid: order of f",
            fitted_order([1 / c for c in cells], columns[0]),
            1.0,
            0.2,
            "area of contact spots, first order",
            AT_LEAST,
        )
    yield Table(
        "contact_cells",
        f"Errors against {finest} x {finest} cells, largest over {SPEEDS} m/s.",
        ("cells", "per correlation length", *labels),
        tuple(rows),
    )
    yield plotting.convergence(
        "contact_cells",
        "The whole job on ever finer contact grids, the same Gaussian surface averaged in "
        "blocks; largest error over three speeds.",
        {label: ([1 / c for c in cells], column, None) for label, column in zip(labels, columns, strict=True)},
        "1 / cells per correlation length",
        "relative error",
    )


def tolerance_of_the_job():
    """Error of f against the tolerance asked, when `lubfric` chooses levels, grids and inner tolerances by it."""
    heights, spacing = surface((256, 256), PATCH / 256), PATCH / 256
    reference = [lubfric.friction(model(heights, spacing), speed).coefficient for speed in SPEEDS]
    free: dict[str, Any] = dict.fromkeys(("film_tolerance", "balance_tolerance", "contact_tolerance"))
    errors, seconds = [], []
    for tolerance in TOLERANCES:
        made = model(heights, spacing, **free | {"tolerance": tolerance, "model": "auto"})
        points = [lubfric.friction(made, speed) for speed in SPEEDS]
        errors.append(max(abs(p.coefficient / r - 1) for p, r in zip(points, reference, strict=True)))
        seconds.append(sum(p.seconds for p in points))
        yield Check(
            f"tolerance {tolerance:g}: error of f",
            errors[-1],
            0.0,
            tolerance,
            "everything modelled on the whole grid, tight tolerances",
            AT_MOST,
        )
    canvas, ax = plotting.axes(height=3.6)
    ax.loglog(TOLERANCES, errors, "o-", label="found")
    ax.loglog(TOLERANCES, TOLERANCES, "k:", label="asked")
    ax.set(xlabel="tolerance asked", ylabel="relative error of f")
    ax.legend()
    yield plotting.finish(
        "job_tolerance",
        canvas,
        "Error of the coefficient of friction (largest over three speeds) when lubfric models no more than the "
        f"tolerance needs; three speeds take {seconds[0]:.2f} s at {TOLERANCES[0]:g}, {seconds[-1]:.2f} s at "
        f"{TOLERANCES[-1]:g}.",
    )


def area_of_the_balance():
    """Strip or box: F_H at the paper's speed against the width of the patch. One surface is cut to all widths."""
    spacing, cells = 0.9375e-6, 192
    heights = surface((cells, cells), spacing)[:, :96]
    heights = lubfric.Surface(heights, (spacing, spacing)).periodic("mirror", axes=(False, True)).heights
    loads: dict[str, list[float]] = {"hertz": [], "box": []}
    for region, found in loads.items():
        for width in WIDTHS:
            n = round(width / spacing)
            cut = heights[(cells - n) // 2 : (cells + n) // 2]
            found.append(lubfric.friction(model(cut, spacing, region), 0.001).film_load)
    strip, box = (np.array(loads[k]) for k in ("hertz", "box"))
    source = "the mean of a deflection that grows like ln|x| depends on the box, not over a fixed strip"
    yield Check(
        "area A = strip: change of F_H from 45 to 180 µm", float(np.ptp(strip) / strip[-1]), 0.0, 1e-6, source, AT_MOST
    )
    yield Check(
        "area A = box: change of F_H from 45 to 180 µm", float(np.ptp(box) / box[-1]), 0.02, 0.0, source, AT_LEAST
    )
    yield Table(
        "area",
        "F_H in N at 0.001 m/s.",
        ("width (µm)", "strip |x| <= b", "whole box"),
        tuple((w * 1e6, s, x) for w, s, x in zip(WIDTHS, strip, box, strict=True)),
    )
    canvas, ax = plotting.axes(height=3.4)
    for line, label in ((strip, "A: Hertz strip of the total load"), (box, "A: the whole box")):
        ax.plot(np.array(WIDTHS) * 1e6, line, "o-", label=label)
    ax.set(xlabel="width of the patch (µm)", ylabel="$F_H$ (N)", ylim=(0, 1.2 * max(*strip, *box)))
    ax.legend(loc="lower right")
    yield plotting.finish(
        "area",
        canvas,
        "Film load at 0.001 m/s against the width of the patch, for the two readings of the area "
        "A in Eq. (8): over the Hertz strip it does not depend on how wide a box was drawn.",
    )


def patch_size():
    """Mean and scatter of f over realisations against the length of the patch along the line."""
    spacing, lengths = 0.9375e-6, (45e-6, 90e-6, 180e-6, 360e-6)
    found = []
    for seed in range(12):
        heights = surface((384, 384), spacing, seed)[:96]
        found.append(
            [
                lubfric.friction(model(heights[:, : round(length / spacing)], spacing), 0.01).coefficient
                for length in lengths
            ]
        )
    mean, scatter = np.mean(found, axis=0), np.std(found, axis=0, ddof=1)
    yield Check(
        "patch along the line: scatter of f at 360 µm over that at 45 µm",
        scatter[-1] / scatter[0],
        8**-0.5,
        0.45,
        "independent stretches average out, one over the root of their number; 12 surfaces",
        AT_MOST,
    )
    yield Table(
        "patch_size",
        "Coefficient at 0.01 m/s over 12 surfaces, patch 90 µm along the motion, one period long.",
        ("along the line (µm)", "mean f", "standard deviation"),
        tuple((length * 1e6, float(m), float(s)) for length, m, s in zip(lengths, mean, scatter, strict=True)),
    )
