"""What a source of long lines must offer: `Lines`."""

from __future__ import annotations

from typing import Protocol

from ..scene import Scene
from ..surface import Surface
from .lines_cells import Cells


class Lines(Protocol):
    """Lines of one rough surface. Each is a `Surface` that is periodic along y. `generated` and `windows` make them.

    - ``scene``: the scene whose surface it is; ``cells``: those of every line; ``lengths``: correlation lengths [m] at
      1/e along x and y.
    - ``available`` [m]: length of the longest line (infinite where more can be generated); ``pieces``: number of
      different pieces (`pair`), likewise.
    - ``nested``: True where a longer line contains the shorter ones, and so replaces them. False where it is another
      place of the surface, and so adds to them.
    - ``exact_sq``: every line has exactly the Sq of the surface.
    """

    @property
    def scene(self) -> Scene: ...
    @property
    def cells(self) -> Cells: ...
    @property
    def lengths(self) -> tuple[float, float]: ...
    @property
    def available(self) -> float: ...
    @property
    def pieces(self) -> float: ...
    @property
    def nested(self) -> bool: ...
    @property
    def exact_sq(self) -> bool: ...

    def line(self, index: int, length: float) -> Surface:
        """Line number ``index``, about ``length`` [m] long."""

    def pair(self, index: int, length: float) -> Surface:
        """Piece number ``index`` on the scene's own cells, about ``length`` [m] long: a whole number of the cells of a
        line."""

    def windows(self, length: float) -> int:
        """Number of separate stretches of the surface in a line of ``length`` [m]."""

    def again(self, scene: Scene) -> Lines | None:
        """The same lines for ``scene``, with another load, motion or tolerance; None if that scene needs other
        cells."""

    def halved(self) -> Lines:
        """The same surface on cells half as long, no shorter than the scene's own."""
