"""A forecast of what a point will cost, from closed forms and two timings on this machine.

The time of a point is that of its films and of the transforms of its contact. Their number depends on Moes' film of the
whole load over Sq; the counts come from the built-in scenes. On a long line the transforms grow with the length that
`lubfric.sharing.lines_outlook` predicts.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy import fft

from ..contact import contact_map
from ..film import solve_line_contact
from ..scene import Scene
from ..sharing import PILOT, Lines, lines_of, piece_cells, pilot_length, takes_line
from ..sharing.lines_outlook import foretold
from .span import film_ratio

LIFTED, LIFTED_LINE = 3.5, 5.0  # Moes' film over Sq beyond which a patch, and a line, mostly do not touch
CLEAR = 0.4  # films of a point that is clear of contact, in those solved from nothing
FILMS, MORE_FILMS = 1.0, 2.0  # of a point in contact: a + b times Moes' film over Sq
TRANSFORMS, MORE_TRANSFORMS = 4.0, 4.0  # the same of the patch
PILOT_TRANSFORMS, LINE_TRANSFORMS = 60.0, 25.0  # of the first line, and of as much length again
PIECE_TRANSFORMS = 12.0  # of a piece on the scene's own cells
CURVE_FILMS, MORE_CURVE_FILMS = 0.4, 0.6  # of a point that is read from a contact curve
CURVE = 75.0  # transforms of a contact curve
REPEATS = 3


@dataclass(frozen=True)
class Ground:
    """What the curves on one map share.

    ``sq`` [m]; ``shape`` of the grid; ``transform`` [s]: one Fourier transform there and back on it; ``lines``: where
    the map is a long line; ``curve``: whether contacts are read from one curve; ``piece``: cells of a piece on
    the scene's own cells over those of the grid.
    """

    sq: float
    shape: tuple[int, int]
    transform: float
    lines: Lines | None = None
    curve: bool = False
    piece: float = 0.0

    @property
    def making(self) -> float:
        """Seconds for what all its points share."""
        return CURVE * self.transform if self.curve else 10.0 * self.transform


def by_curve(scene: Scene) -> bool:
    """Whether its contact is read from one periodic contact curve."""
    return scene.contact.geometry == "flat" or scene.numerics.contact_level == "flat"


def ground_of(scene: Scene, curve: bool) -> Ground:
    """The `Ground` of ``scene``, whose map is made for it. Raises `InputError` if that is not possible."""
    surface = contact_map(scene)
    if not takes_line(scene):
        return Ground(surface.sq, surface.shape, _transform(surface.shape), curve=curve)
    lines = lines_of(scene)
    shape = lines.cells.count, max(2, round(pilot_length(lines) / lines.cells.coarse[1]))
    return Ground(surface.sq, shape, _transform(shape), lines, piece=piece_cells(lines) / math.prod(shape))


def mean_speed(speeds: Iterable[float]) -> float:
    """Geometric mean of the magnitudes of ``speeds`` [m/s] that are not 0; 0 where there are none."""
    known = [abs(u) for u in speeds if u]
    return math.exp(math.fsum(map(math.log, known)) / len(known)) if known else 0.0


def in_words(seconds: float) -> str:
    """A predicted time, in a suitable unit."""
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds > 2 * size:
            return f"{float(f'{seconds / size:.2g}'):g} {unit}"
    return f"{float(f'{seconds:.2g}'):g} s"


def film_clock(scene: Scene, speed: float) -> float:
    """Processor seconds of one film of ``scene``, which is solved for that."""
    contact = scene.line_contact(abs(speed))
    begun = time.process_time()
    for _ in range(REPEATS):
        solve_line_contact(contact, raise_on_failure=False)
    return (time.process_time() - begun) / REPEATS


def point_seconds(scene: Scene, ground: Ground, speed: float, film: float) -> float:
    """Processor seconds of ``scene`` at ``speed`` [m/s]; ``film``: `film_clock`."""
    if speed == 0 or ground.sq <= 0:
        return CLEAR * film
    ratio = film_ratio(scene, ground.sq, abs(speed))
    if ground.curve:
        return (CURVE_FILMS + MORE_CURVE_FILMS * min(ratio, 2.0)) * film
    if ground.lines is None:
        if ratio > LIFTED:
            return CLEAR * film
        return (FILMS + MORE_FILMS * ratio) * film + (TRANSFORMS + MORE_TRANSFORMS * ratio) * ground.transform
    if ratio > LIFTED_LINE:
        return CLEAR * film
    length = foretold(scene, ground.lines, ground.sq, speed)[1] / (PILOT * ground.lines.lengths[1])
    transforms = PILOT_TRANSFORMS + LINE_TRANSFORMS * max(length - 1.0, 0.0) + PIECE_TRANSFORMS * ground.piece
    return (FILMS + MORE_FILMS * ratio) * film + transforms * ground.transform


def _transform(shape) -> float:
    """Processor seconds of one Fourier transform there and back of a grid padded to twice its length along x."""
    values = np.zeros((2 * shape[0], max(2, shape[1])))
    best = math.inf
    for _ in range(REPEATS):
        begun = time.process_time()
        fft.irfft2(fft.rfft2(values), values.shape)
        best = min(best, time.process_time() - begun)
    return best
