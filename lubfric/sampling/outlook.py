"""A forecast of what a point will take, from closed forms: whether the summits touch, how many strips are solved and
how long that takes. Nothing is solved."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..contact import Strips
from ..scene import Scene
from .sample import SAFETY

CELL_SECONDS = 2.5e-6  # processor time of a cell of the strips in balance, about
PIECE_SECONDS = 1.3e-6  # of a cell of a piece on finer and finer cells, of the finest
FILM_SECONDS = 0.02  # of a point without contact
GAP = 1.6  # Sq: mean gap of a contact that carries most of the load, about
RISE = 0.4  # of the film of the whole load, by which it is wider, about
FLOOR = 0.25  # of f_b: friction where the film carries most, about
CLEAR = 3.5  # Sq: a film that thick hardly meets a summit
SURE = 2.0  # factor between Moes' film and any film: outside of it contact or separation is certain


@dataclass(frozen=True)
class Forecast:
    """To an order of magnitude, at one ``speed`` [m/s]: in words, whether the summits touch; ``clearance`` [Sq] between
    Moes' film of the whole load and the highest summit; ``error``: relative standard error of f after the first strips;
    ``strips`` that ``numerics.sampling_tolerance`` needs, their ``length`` [m], and the processor time [s]."""

    speed: float
    touching: str
    clearance: float
    error: float
    strips: int
    length: float
    seconds: float


def forecast(scene: Scene, strips: Strips | None, sq: float, summit: float, speed: float) -> Forecast:
    """What a point at ``speed`` [m/s] will take. ``sq``, ``summit`` [m]: of the surface that is solved first, its
    standard deviation and its highest height over the mean; ``strips``: None for a contact without cells.

    The mean gap over a line of length L and half-width b scatters as a mean of L (2b + sqrt(pi) lx)/(pi lx ly)
    independent heights. The effect on f follows from the share of the load that the rigid film of the whole load would
    carry if it were as thick as the gap.
    """
    film = scene.line_contact(speed).moes_film if speed else 0.0
    touching = "touching" if SURE * film < summit else "none" if film > SURE * summit else "none or a few summits"
    clearance = (film - summit) / max(sq, 1e-12)
    if strips is None or strips.whole:
        return Forecast(speed, touching, clearance, math.nan, 1, math.nan, FILM_SECONDS)
    (lx, ly), first, asked = strips.lengths, strips.first * strips.length, scene.numerics.sampling_tolerance
    error = 0.0
    if speed and film <= CLEAR * sq:
        gap = GAP * sq + RISE * film
        share = min(film / gap, 1.0)
        scatter = sq * math.sqrt(math.pi * lx * ly / (first * (2 * scene.bodies.half_width + math.sqrt(math.pi) * lx)))
        error = scatter / gap * share / (1 - share + FLOOR)
    count = math.ceil(strips.first * max(1.0, SAFETY * (error / asked) ** 2 if error > asked else 1.0))
    count = min(count, strips.available)
    cells = strips.cells
    (fx, fy), (_, dy) = cells.factors, cells.coarse
    piece = 0.0 if cells.own else cells.count * fx * fy * strips.length / dy / 2
    seconds = FILM_SECONDS
    if touching != "none":
        seconds += CELL_SECONDS * cells.count * count * strips.length / dy + PIECE_SECONDS * piece
    return Forecast(speed, touching, clearance, error, count, count * strips.length, seconds)
