"""Load sharing beside roughness that moves: f and the share of the load over the slide-roll ratio and the film, and the
load share over film/Sq beside published laws.

Both models have the same periodic map, on cells of 0.4 correlation lengths. Surface 1 is rough, so slide-roll ratios s
and -s are two cases.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

import lubfric
from lubfric.deterministic import BOUNDARY_FILM, RoughBody
from lubfric.sampling import load_sharing_error

from .. import plotting
from ..check import AT_LEAST, TOLD, Check, Figure, Item, Table
from ..kept import Run
from ..references import load_share_band
from .boundary_film import roller, speed_of
from .moved import FILMS, passed

RATIOS = (2.0, 1.0, 0.6, 0.3)  # smooth central film over Sq
SLIPS = (-1.0, -0.1, 0.1, 0.5, 1.5)  # slide-roll ratios
CONTACTS: dict[str, tuple[float, dict, float, float]] = {  # pressure [Pa], bodies, Sq and correlation length [m]
    "roller, 1 GPa": (1e9, {}, 150e-9, 10e-6),
    "gear flank, 1.2 GPa": (1.2e9, {"radius": 10e-3}, 300e-9, 20e-6),
    "roller, 0.5 GPa": (0.5e9, {}, 150e-9, 10e-6),
    "light, 0.25 GPa": (0.25e9, {}, 100e-9, 8e-6),
}
SHAPE, PER_LENGTH = (64, 16), 2.5  # cells of a map, and in a correlation length
HOLDS, SURE = 0.95, 0.99  # share of points within the stated bound; and the quantile that is told


def cases(level: str) -> dict[str, tuple]:
    """The cases of ``level`` by name: (contact, acf, film/Sq, slide-roll ratio). Two contacts are mapped."""
    mapped, others = list(CONTACTS)[:2], list(CONTACTS)[2:]
    found = [(name, "gaussian", ratio, slip) for name in mapped for ratio in RATIOS for slip in SLIPS]
    if level == "quick":
        found = [one for one in found[: len(found) // 2] if one[2] >= 1 and abs(one[3]) == 0.1]
    else:
        more = [(name, "exponential") for name in (mapped[0], others[-1])] + [(name, "gaussian") for name in others]
        found += [(*one, ratio, slip) for one in more for ratio in RATIOS[1::2] for slip in (-0.1, 0.5)]
    return {"; ".join(map(str, one)): one for one in found}


def solved(case: tuple) -> dict[str, Any]:
    """Both models at one case; or why there is no answer."""
    contact, acf, ratio, slip = case
    pressure, bodies, sq, length = CONTACTS[contact]
    scene = roller(pressure).with_(bodies=bodies, motion={"slide_roll_ratio": slip}, numerics={"accept": True})
    surface = lubfric.generate_surface(SHAPE, length / PER_LENGTH, sq=sq, correlation_length=length, acf=acf, seed=11)
    speed = speed_of(scene, ratio * sq)
    fast = lubfric.friction(lubfric.prepare(scene.with_(numerics={"model": "load-sharing"}), surface), speed)
    load = scene.bodies.load
    numbers = {"f": fast.coefficient, "share": fast.contact_load / load, "ratio": fast.film_to_roughness_ratio}
    numbers |= {"boundary": fast.boundary_force / load, "shear": fast.shear_force / load}
    try:
        return {"speed": speed, "fast": numbers} | passed(scene, [RoughBody(surface, speed * (1 - slip / 2))], speed)
    except lubfric.ConvergenceError as error:
        return {"speed": speed, "fast": numbers, "failure": str(error)[:200]}


def rolling(level: str, run: Run = Run()) -> Iterator[Item]:
    """Eq. (8) beside moving roughness, its stated error beside the one found, and the share of the load on thin gaps
    beside four published laws."""
    rows = list(run.solved(cases(level), solved))
    found = [(case, row) for case, row in rows if "failure" not in row]
    off = np.array([abs(row["f"] / row["fast"]["f"] - 1) for _, row in found])
    told = np.array([stated(row["fast"]) for _, row in found])
    yield Check("moving points that were not solved", len(rows) - len(found), 0, 0.0, "the solver's report", TOLD)
    name = f"Eq. (8) in rolling: share of {len(found)} points within its stated error"
    yield Check(name, float(np.mean(off <= told)), HOLDS, 0.0, "moving roughness", AT_LEAST)
    quantile = float(np.quantile(off / told, SURE))
    yield Check("Eq. (8) in rolling: error over the stated one, 99 % quantile", quantile, 1.0, 0.0, "moving", TOLD)
    columns = ("contact", "film/Sq", "share: Eq. (8)", "rest", "moving", *(f"f at {slip:g}" for slip in SLIPS))
    caption = "Share of the load at 20 nm, and f of moving roughness over f by Eq. (8), at five slide-roll ratios"
    yield Table("rolling", caption, columns, list(summary(found)))
    yield from shares(found)
    yield drawn(found)


def stated(fast: dict) -> float:
    """The error that Eq. (8) states of itself at rest."""
    return load_sharing_error(fast["ratio"], fast["share"], fast["boundary"], fast["shear"])


def summary(found: list) -> Iterator[list[str]]:
    """A row for every contact, surface and film."""
    film = FILMS.index(BOUNDARY_FILM)
    for contact, acf, ratio in dict.fromkeys(case[:3] for case, _ in found):
        at = {case[3]: row for case, row in found if case[:3] == (contact, acf, ratio)}
        sets = ([one["fast"]["share"] for one in at.values()], [one["rest"]["shares"][film] for one in at.values()])
        sets = (*sets, [one["shares"][film] for one in at.values()])
        cells = [f"{min(one):.2f}–{max(one):.2f}" for one in sets]
        over = [f"{at[slip]['f'] / at[slip]['fast']['f']:.2f}" if slip in at else "-" for slip in SLIPS]
        yield [contact if acf == "gaussian" else f"{contact}, {acf}", f"{ratio:g}", *cells, *over]


def shares(found: list) -> Iterator[Item]:
    """The share of the load on gaps below each of `FILMS`, at rest and moving, beside four laws."""
    ratios = sorted({case[2] for case, _ in found}, reverse=True)
    low, high = load_share_band(ratios)
    worst, table = {}, {}
    for name, part in (("moving", lambda row: row), ("at rest", lambda row: row["rest"])):
        at = [np.array([part(row)["shares"] for case, row in found if case[2] == ratio]) for ratio in ratios]
        off = [np.maximum(np.maximum(s - h, l - s), 0).max(axis=0) for s, l, h in zip(at, low, high)]
        worst[name], table[name] = np.max(off, axis=0), at
    rows = [
        (f"{ratio:g}", f"{l:.2f}–{h:.2f}", *(f"{s.min():.2f}–{s.max():.2f}" for s in at.T))
        for ratio, l, h, at in zip(ratios, low, high, table["moving"])
    ]
    rows += [(f"largest distance, {name}", "", *(f"{d:.2f}" for d in worst[name])) for name in worst]
    columns = ("film/Sq", "four laws", *(f"h < {film * 1e9:g} nm" for film in FILMS))
    yield Table("boundary-film-moving", "Share of the load on thin gaps under moving roughness", columns, rows)
    best = FILMS[int(np.argmin(worst["moving"]))]
    yield Check("best boundary film under moving roughness", best, BOUNDARY_FILM, 0.0, "default", TOLD, unit="m")


def drawn(found: list) -> Figure:
    """f and the share of the load over film/Sq at every slide-roll ratio, of the first two contacts."""
    names, film = list(CONTACTS)[:2], FILMS.index(BOUNDARY_FILM)
    canvas, grid = plotting.axes(2, 2, 8.5, 6.0, sharex=True)
    for column, name in zip(grid.T, names):
        for k, slip in enumerate(SLIPS):
            at = [(c[2], r) for c, r in found if c[0] == name and c[1] == "gaussian" and c[3] == slip]
            ratios = [ratio for ratio, _ in at]
            for ax, moving, fast in (
                (column[0], [r["f"] for _, r in at], [r["fast"]["f"] for _, r in at]),
                (column[1], [r["shares"][film] for _, r in at], [r["fast"]["share"] for _, r in at]),
            ):
                ax.plot(ratios, moving, f"C{k}o-", label=f"{slip:g}")
                ax.plot(ratios, fast, f"C{k}--", lw=0.8)
        dense = np.geomspace(min(RATIOS), max(RATIOS), 60)
        column[1].fill_between(dense, *load_share_band(dense), color="0.85")
        column[0].set(title=name, xscale="log", ylabel="f")
        column[1].set(xlabel="film/Sq", ylabel="share of the load at 20 nm")
    grid[0, 0].legend(title="slide-roll ratio", fontsize=8)
    return plotting.finish("rolling", canvas, "Moving roughness (lines), Eq. (8) (dashed), four published laws (grey)")
