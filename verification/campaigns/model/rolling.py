"""Load sharing compared with moving roughness: f and the asperity load ratio over the slide-roll ratio and the film,
and the asperity load ratio over film/Sq compared with published laws.

Both models have the same periodic map, on cells of 0.4 correlation lengths, and half of that along x. Surface 1 is
rough, so slide-roll ratios s and -s are two cases.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

import lubfric
from lubfric.models.deterministic import BOUNDARY_FILM, RoughBody
from lubfric.models.load_sharing import load_sharing_error

from ... import plotting
from ...check import AT_LEAST, REPORTED, Check, Figure, Item, Table
from ...fem.references import load_share_band
from ...kept import Run
from ...types import Keywords, PlainRow
from .boundary_film import roller, speed_of
from .moved import FILMS, passed

RATIOS = (2.0, 1.0, 0.6, 0.3)  # smooth central film over Sq
SLIPS = (-1.0, 0.0, 0.1, 2.0)  # slide-roll ratios; at 2 surface 1 rests
CONTACTS: dict[str, tuple[float, Keywords, float, float]] = {  # pressure [Pa], bodies, Sq and correlation length [m]
    "roller, 1 GPa": (1e9, {}, 150e-9, 10e-6),
    "gear flank, 1.2 GPa": (1.2e9, {"radius": 10e-3}, 300e-9, 20e-6),
    "roller, 0.5 GPa": (0.5e9, {}, 150e-9, 10e-6),
    "light, 0.25 GPa": (0.25e9, {}, 100e-9, 8e-6),
}
SHAPE = (128, 16)  # cells of a map
PER_LENGTH = (5.0, 2.5)  # cells in a correlation length along and across; along, where the roughness moves, more
KINDS = "gaussian", "exponential", "plateau", "ridges across", "ridges along"
RIDGE = 4.0  # length of ridges over their width
CUT = 0.3  # height over Sq at which summits are cut off
HOLDS = 0.95  # share of points within the stated bound, at least
SURE = 0.99  # quantile of the errors that is reported


# contact, kind of surface, film/Sq, slide-roll ratio
RollingCase = tuple[str, str, float, float]


def cases(level: str) -> dict[str, RollingCase]:
    """The cases of ``level`` by name: (contact, kind of surface, film/Sq, slide-roll ratio). Two are mapped."""
    mapped = list(CONTACTS)[:2]
    others = list(CONTACTS)[2:]
    values = [(name, "gaussian", ratio, slip) for name in mapped for ratio in RATIOS for slip in SLIPS]
    if level == "quick":
        values = [case for case in values[: len(values) // 2] if case[2] >= 1 and abs(case[3]) == 0.1]
    else:
        more = [(name, "exponential") for name in (mapped[0], others[-1])] + [(name, "gaussian") for name in others]
        more += [(mapped[0], kind) for kind in KINDS[2:]]
        values = [(*case, ratio, slip) for case in more for ratio in RATIOS[1:2] for slip in (0.5,)] + values
    return {"; ".join(map(str, case)): case for case in values}


def solved(case: RollingCase) -> PlainRow:
    """Return both models at one case; or why there is no answer."""
    contact, kind, ratio, slip = case
    pressure, bodies, sq, length = CONTACTS[contact]
    scene = roller(pressure).with_(bodies=bodies, motion={"slide_roll_ratio": slip}, numerics={"accept": True})
    surface = rough(kind, sq, length)
    speed = speed_of(scene, ratio * sq)
    fast = lubfric.friction(lubfric.prepare(scene.with_(numerics={"model": "paper"}), surface), speed)
    load = scene.bodies.load
    numbers = {"f": fast.coefficient, "share": fast.contact_load / load, "ratio": fast.film_to_roughness_ratio}
    numbers |= {"boundary": fast.boundary_force / load, "shear": fast.shear_force / load}
    numbers["rolling"] = fast.rolling_force / load
    try:
        return {"speed": speed, "fast": numbers} | passed(scene, [RoughBody(surface, speed * (1 - slip / 2))], speed)
    except lubfric.ConvergenceError as error:
        return {"speed": speed, "fast": numbers, "failure": str(error)[:200]}


def rough(kind: str, sq: float, length: float) -> lubfric.Surface:
    """Return the map of one of `KINDS`, with this Sq and correlation length [m], of ridges across them."""
    lengths = {"ridges across": (length, RIDGE * length), "ridges along": (RIDGE * length, length)}.get(kind, length)
    acf = "exponential" if kind == "exponential" else "gaussian"
    (along, across) = (length / n for n in PER_LENGTH)
    cells = along, across * (RIDGE if kind == "ridges across" else 1.0)
    surface = lubfric.generate_surface(SHAPE, cells, sq=sq, correlation_length=lengths, acf=acf, seed=11)
    return (
        replace(surface, heights=np.minimum(surface.heights, CUT * sq)).scaled(sq=sq) if kind == "plateau" else surface
    )


def rolling(level: str, run: Run = Run()) -> Iterator[Item]:
    """Compare load sharing with moving roughness: f, its stated and its actual error, and the load ratio of thin gaps
    with four published laws."""
    rows = list(run.solved(cases(level), solved))
    values = [(case, row) for case, row in rows if "failure" not in row]
    off = np.array([row["f"] / row["fast"]["f"] - 1 for _, row in values])
    sides = np.array([stated(row["fast"]) for _, row in values])
    stated_error = np.where(off < 0, *sides.T)
    off = np.abs(off)
    yield Check(
        "moving points that were not solved",
        len(rows) - len(values),
        expected=0,
        tolerance=0.0,
        source="the solver's report",
        kind=REPORTED,
    )
    name = f"load sharing in rolling: share of {len(values)} points within its stated error"
    yield Check(
        name,
        float(np.mean(off <= stated_error)),
        expected=HOLDS,
        tolerance=0.0,
        source="moving roughness",
        kind=AT_LEAST,
    )
    quantile = float(np.quantile(off / stated_error, SURE))
    yield Check(
        "load sharing in rolling: error over the stated one, 99 % quantile",
        quantile,
        expected=1.0,
        tolerance=0.0,
        source="moving",
        kind=REPORTED,
    )
    columns = ("film/Sq", "f moving / paper", "f moving / at rest", "F_C/F_T: paper", "at rest", "moving")
    caption = "f of moving roughness, and the share of the load at 20 nm, lowest and highest of all that slide"
    yield Table("rolling", caption, columns, list(summary(values)))
    yield from shares(values)
    yield drawn(values)


def stated(fast: PlainRow) -> tuple[float, float]:
    """Return the error that load sharing states where roughness moves, below and above f."""
    return load_sharing_error(
        fast["ratio"], share=fast["share"], boundary=fast["boundary"], shear=fast["shear"], rolling=fast["rolling"]
    )


def summary(result: list[tuple[RollingCase, PlainRow]]) -> Iterator[list[str]]:
    """A row for every film."""
    film = FILMS.index(BOUNDARY_FILM)
    for ratio in RATIOS:
        rows = np.array(
            [
                (at["f"] / at["fast"]["f"], at["f"] / at["rest"]["f"])
                + (at["fast"]["share"], at["rest"]["shares"][film], at["shares"][film])
                for case, at in result
                if case[2] == ratio and case[3] != 0
            ]
        )
        if rows.size:
            yield [f"{ratio:g}", *(f"{low:.2f}–{high:.2f}" for low, high in zip(rows.min(axis=0), rows.max(axis=0)))]


def shares(result: list[tuple[RollingCase, PlainRow]]) -> Iterator[Item]:
    """How far the share of the load on gaps below each of `FILMS` is from the band of four laws, at most."""
    ratios = np.array([case[2] for case, _ in result])
    low, high = (side[:, None] for side in load_share_band(ratios))
    for name, rows in (("moving", [row for _, row in result]), ("rest", [row["rest"] for _, row in result])):
        at = np.array([row["shares"] for row in rows])
        off = np.maximum(np.maximum(at - high, low - at), 0).max(axis=0)
        for film, distance in zip(FILMS, off):
            what = f"{name}, h < {film * 1e9:g} nm: largest distance of the share from the band"
            yield Check(what, distance, expected=0.0, tolerance=1.0, source="four laws", kind=REPORTED)


def drawn(rows: list[tuple[RollingCase, PlainRow]]) -> Figure:
    """Return f and the share of the load over film/Sq at every slide-roll ratio, of the first two contacts."""
    names = list(CONTACTS)[:2]
    film = FILMS.index(BOUNDARY_FILM)
    canvas, grid = plotting.axes(2, 2, 8.5, 6.0, sharex=True)
    for column, name in zip(grid.T, names):
        for k, slip in enumerate(SLIPS):
            at = [(c[2], r) for c, r in rows if c[0] == name and c[1] == "gaussian" and c[3] == slip]
            ratios = [ratio for ratio, _ in at]
            for ax, moving, fast in (
                (column[0], [r["f"] for _, r in at], [r["fast"]["f"] for _, r in at]),
                (column[1], [r["shares"][film] for _, r in at], [r["fast"]["share"] for _, r in at]),
            ):
                ax.plot(ratios, moving, f"C{k}o-", label=f"{slip:g}")
                ax.plot(ratios, fast, f"C{k}--", lw=0.8)
        dense = np.geomspace(min(RATIOS), max(RATIOS), 60)
        column[1].fill_between(dense, *load_share_band(dense), color="0.85")
        column[0].set(title=name, xscale="log", ylabel="friction coefficient f (-)")
        column[1].set(xlabel="lambda ratio, film/Sq (-)", ylabel="asperity load ratio (h < 20 nm) (-)")
    grid[1, 1].legend(title="slide-roll ratio", fontsize=8, loc="upper right")
    return plotting.finish(
        "rolling",
        canvas,
        "Moving roughness (lines), load-sharing model of the paper (dashed), four published laws of the asperity load "
        "ratio (grey)",
    )
