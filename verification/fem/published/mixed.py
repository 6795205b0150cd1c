"""Mixed lubrication beside four laws of the load share, and the paper's own numbers."""

from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.models.deterministic import BOUNDARY_FILM

from ... import plotting
from ...campaigns.model.boundary_film import FILMS, RATIOS, SURFACES, shares
from ...check import Figure, Item
from .. import references
from . import against

PRESSURE = 0.5e9  # Pa, of Hertz


def mixed(level: str) -> Iterator[Item]:
    """The share of the load on gaps below the boundary film, and the paper's cylinder.

    Theirs is the band that four published laws span. Ours is the mean of three kinds of roughness on a roller, each a
    patch; the error is twice its standard error.
    """
    values = np.array([shares((kind, PRESSURE)) for kind in SURFACES])[:, :, FILMS.index(BOUNDARY_FILM)]
    ours = values.mean(axis=0)
    own = 2 * values.std(axis=0, ddof=1) / np.sqrt(len(values))
    low, high = references.load_share_band(RATIOS)
    for ratio, one, error, a, b in zip(RATIOS, ours, own, low, high):
        name = f"load share of the asperities, film/Sq = {ratio:g}"
        half = (b - a) / (a + b)
        note = "not independent: the boundary film of 20 nm is the candidate that lies nearest to these laws"
        if ratio * min(SURFACES.values()) <= BOUNDARY_FILM:
            note = "the film itself is 20 to 40 nm, so nearly all of it is below the boundary film; and ours is at rest"
        yield against("shares", name, one, (a + b) / 2, error / one, note=note, error=half)
    scene = lubfric.load_scene("paper")
    line = scene.line_contact(0.001)
    mean = scene.bodies.load / scene.bodies.width / (2 * line.half_width)
    yield against("paper", "mean Hertz pressure", mean, references.PAPER["mean Hertz pressure"], 0.0, "Pa", error=5e-3)
    yield against("paper", "half-width", line.half_width, references.PAPER["half-width"], 0.0, "m", error=0.012)
    yield drawn(ours, own)


def drawn(ours: np.ndarray, own: np.ndarray) -> Figure:
    """Shares over the ratio, in the band of the laws."""
    dense = np.geomspace(min(RATIOS), max(RATIOS), 100)
    curves: list[tuple] = [(dense, law(dense), "-", name) for name, law in references.LOAD_SHARES.items()]
    curves.append((RATIOS, ours, "ko", "lubfric, three kinds of roughness", own))
    caption = "Load share of the asperities beside four published laws"
    return plotting.chart("shares", caption, curves, xscale="log", xlabel="film/Sq", ylabel="share of the load")
