"""Effect of grid, patch, area A, tolerance and direction on the friction coefficient of `lubfric`."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

import lubfric
from lubfric.models import prepare
from lubfric.models.shared import Prepared

from ... import plotting
from ...check import AT_LEAST, AT_MOST, Check, Item, Table, bound, compared
from ...types import Keywords, Option
from ..convergence import Series, picture
from ..exact import Parabola

SPEEDS = (0.003, 0.01, 0.03)  # m/s, mixed lubrication
PATCH = 90e-6  # m, the paper's
LENGTH = 8e-6  # m, correlation length at 1/e
FINEST = {"quick": 128, "default": 256, "full": 512}
WIDTHS = (45e-6, 60e-6, 90e-6, 120e-6, 180e-6)
TOLERANCES = (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4)
TIGHT = {
    "model": "paper",
    "tolerance": 1e-4,
    "film_tolerance": 1e-4,
    "balance_tolerance": 1e-6,
    "contact_tolerance": 1e-6,
    "sampling": "patch",
    "grid": "given",
}


def friction(level: str) -> Iterator[Item]:
    """`lubfric.friction` on the paper's cylinder (Tables 1 and 2; generated Gaussian roughness of 100 nm, 8 µm at 1/e).

    The friction of a full film has a closed form. The reversed motion over the mirrored surface must give the same
    result; a shift of film or strip by half a cell would change it. Then follow the numerical choices: the cells per
    correlation length, the tolerance of f, the area A of the volume balance, Eq. (8), in wider and wider boxes, and
    the length of the patch.
    """
    yield from full_film()
    yield from mirrored()
    yield from contact_cells(FINEST[level])
    if level != "quick":
        yield from tolerance_of_the_job()
        yield from area_of_the_balance()
        yield from patch_size()


def surface(shape: tuple[int, int], spacing: float, seed: int = 1) -> np.ndarray:
    """Return heights with the roughness of the scene, m."""
    made: Keywords = {"sq": 100e-9, "correlation_length": LENGTH, "acf": "gaussian", "seed": seed}
    return lubfric.generate_surface(shape, spacing, **made).heights


def model(heights: np.ndarray, spacing: float, region: str = "hertz", **numerics: Option) -> Prepared:
    """Return the paper's cylinder made ready for given heights, tightly solved unless ``numerics`` say otherwise."""
    scene = lubfric.load_scene("paper").with_(contact={"region": region}, numerics=TIGHT | numerics)
    return prepare(scene, lubfric.Surface(heights, (spacing, spacing)))


def blocks(heights: np.ndarray, cells: int) -> np.ndarray:
    """Return means of the heights in square blocks, so many along x."""
    k = heights.shape[0] // cells
    return heights.reshape(cells, k, -1, k).mean(axis=(1, 3))


def full_film() -> Iterator[Item]:
    """Constant viscosity at high speed: a rigid isoviscous film, whose friction has a closed form."""
    made = model(np.zeros((16, 16)), 1e-6)
    made = prepare(made.scene.with_(lubricant={"viscosity_law": "constant"}), like=made)
    point = lubfric.friction(made, 20.0)
    b = made.scene.bodies
    exact = Parabola(
        viscosity=made.scene.lubricant.viscosity, speed=20.0, radius=b.radius, film_thickness=point.min_film, inlet=-1e6
    )
    rows = [
        ("F_H", "N", point.film_load, exact.load * b.width, 2e-3),
        ("Couette force", "N", point.couette_force, exact.couette * 40.0 * b.width, 2e-3),
        ("rolling force", "N", point.rolling_force, exact.rolling * b.width, 2e-3),
    ]
    yield from compared("full film", rows, "closed form, Martin 1916")


def mirrored() -> Iterator[Item]:
    """Backwards over the mirrored surface."""
    heights = blocks(surface((64, 64), PATCH / 64), 32)
    there = lubfric.friction(model(heights, PATCH / 32), 0.01)
    back = lubfric.friction(model(heights[::-1], PATCH / 32), -0.01)
    rows = [
        ("film load", "N", back.film_load, there.film_load, 1e-4),
        ("coefficient", "1", back.coefficient, there.coefficient, 1e-4),
    ]
    yield from compared("backwards over the mirrored surface", rows, "mirror symmetry of the problem")


def contact_cells(finest: int) -> Iterator[Item]:
    """One surface averaged in ever larger blocks: errors against the finest grid, by cells per correlation length."""
    heights = surface((finest, finest), PATCH / finest)
    grids = [n for n in (32, 64, 128, 256) if n < finest]
    labels = {"film_load": "F_H", "mean_gap": "mean gap", "real_contact_area": "contact area"}
    labels = {"coefficient": "f"} | labels

    def solved(n: int) -> np.ndarray:
        made = model(blocks(heights, n), PATCH / n)
        points = [lubfric.friction(made, speed) for speed in SPEEDS]
        return np.array([[getattr(p, name) for name in labels] for p in points])

    reference = solved(finest)
    errors = np.array([np.abs(solved(n) / reference - 1).max(axis=0) for n in grids])
    cells = np.array([LENGTH / PATCH * n for n in grids])
    bounds = {128: (1.5e-2, 2e-2, 2e-2, 0.3)}.get(finest, (3e-3, 4e-3, 4e-3, 0.15))
    source = f"{finest} x {finest} cells of the same surface"
    for label, error, allowed in zip(labels.values(), errors[-1], bounds, strict=True):
        yield bound(f"contact grid: {label}, {cells[-1]:.1f} cells per correlation length", error, allowed, source)
    series = [Series(label, 1 / cells, errors=column) for label, column in zip(labels.values(), errors.T)]
    if len(grids) > 2:
        why = "area of asperity contacts, first order"
        order = replace(series[0], order=1.0, check="contact grid: order of f", tolerance=0.2, source=why)
        yield replace(order, kind=AT_LEAST).check_order()
    caption = f"Errors against {finest} x {finest} cells, largest over {SPEEDS} m/s."
    rows = [(n, c, *row) for n, c, row in zip(grids, cells.tolist(), errors.tolist())]
    yield Table("contact_cells", caption, ("cells", "per correlation length", *labels.values()), rows)
    caption = "Friction on finer and finer contact grids, the same Gaussian surface averaged in blocks; largest error "
    caption += "over three speeds."
    yield picture("contact_cells", caption, series, "1 / cells per correlation length", "relative error")


def tolerance_of_the_job() -> Iterator[Item]:
    """Show the error of f over the requested tolerance, from which `lubfric` chooses grids and inner tolerances."""
    heights = surface((256, 256), PATCH / 256)
    spacing = PATCH / 256
    reference = [lubfric.friction(model(heights, spacing), speed).coefficient for speed in SPEEDS]
    free: Keywords = dict.fromkeys(("film_tolerance", "balance_tolerance", "contact_tolerance"))
    free["grid"] = "auto"
    for tolerance in TOLERANCES:
        made = model(heights, spacing, **free | {"tolerance": tolerance})
        points = [lubfric.friction(made, speed) for speed in SPEEDS]
        error = max(abs(p.coefficient / r - 1) for p, r in zip(points, reference, strict=True))
        source = "the complete grid, tight tolerances"
        yield bound(f"tolerance {tolerance:g}: error of f", error, tolerance, source)


def area_of_the_balance() -> Iterator[Item]:
    """Strip or box: F_H at the paper's speed against the width of the patch. One surface is cut to all widths."""
    spacing = 0.9375e-6
    cells = 192
    heights = surface((cells, cells), spacing)[:, :96]
    heights = lubfric.Surface(heights, (spacing, spacing)).periodic(axes=(False, True)).heights

    def film_load(region: str, width: float) -> float:
        n = round(width / spacing)
        cut = heights[(cells - n) // 2 : (cells + n) // 2]
        return lubfric.friction(model(cut, spacing, region), 0.001).film_load

    strip, box = (np.array([film_load(region, width) for width in WIDTHS]) for region in ("hertz", "box"))
    source = "the mean of a deflection that grows like ln|x| depends on the box, not over a fixed strip"
    name = "change of F_H from 45 to 180 µm"
    yield bound(f"area A = strip: {name}", float(np.ptp(strip) / strip[-1]), 1e-6, source)
    yield Check(
        f"area A = box: {name}",
        float(np.ptp(box) / box[-1]),
        expected=0.02,
        tolerance=0.0,
        source=source,
        kind=AT_LEAST,
    )
    widths = np.array(WIDTHS) * 1e6
    columns = ("width (µm)", "strip |x| <= b", "complete box")
    rows = zip(widths.tolist(), strip.tolist(), box.tolist())
    yield Table("area", "F_H in N at 0.001 m/s.", columns, tuple(rows))
    caption = "Film load at 0.001 m/s against the width of the patch, for the two readings of the area A in Eq. (8): "
    caption += "over the Hertz strip it does not depend on how wide a box was drawn."
    curves = [(widths, strip, "o-", "A: Hertz strip of the total load"), (widths, box, "o-", "A: the complete box")]
    labels: Keywords = {
        "xlabel": "width of the patch (µm)",
        "ylabel": "$F_H$ (N)",
        "ylim": (0, 1.2 * max(*strip, *box)),
    }
    yield plotting.chart("area", caption, curves, **labels)


def patch_size() -> Iterator[Item]:
    """Mean and scatter of f over realisations against the length of the patch along the line."""
    spacing = 0.9375e-6
    lengths = (45e-6, 90e-6, 180e-6, 360e-6)
    values = []
    for seed in range(12):
        heights = surface((384, 384), spacing, seed)[:96]
        cut = [model(heights[:, : round(length / spacing)], spacing) for length in lengths]
        values.append([lubfric.friction(made, 0.01).coefficient for made in cut])
    mean = np.mean(values, axis=0)
    scatter = np.std(values, axis=0, ddof=1)
    name = "patch along the line: scatter of f at 360 µm over that at 45 µm"
    source = "independent stretches average out, one over the root of their number; 12 surfaces"
    yield Check(name, scatter[-1] / scatter[0], expected=8**-0.5, tolerance=0.45, source=source, kind=AT_MOST)
    caption = "Coefficient at 0.01 m/s over 12 surfaces, patch 90 µm along the motion, one period long."
    rows = [(length * 1e6, float(m), float(s)) for length, m, s in zip(lengths, mean, scatter, strict=True)]
    yield Table("patch_size", caption, ("along the line (µm)", "mean f", "standard deviation"), rows)
