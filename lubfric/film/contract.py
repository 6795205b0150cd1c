"""What every film has, and what every level of film does: all that you need to know to write one.

A film is data (`Film`). A level (`FilmLevel`) solves for it and knows what it leaves out. `lubfric.prepare` takes the
levels to choose from, the simplest first (``film_levels``). A new level is a subclass, here or anywhere, with ``solve``
and, unless it is the last, ``left_out``. `EHLResult` and `RigidFilm` are films.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from ..errors import Report
from ..oil import Lubricant
from .imposed import LinePressure
from .line_contact import LineContact
from .rolling import Rolling
from .shear import ShearForce, shear_force


class Film(Protocol):
    """A steady film of a smooth line contact, in SI units. Arrays are (n,), x ascending, with the line of centres at 0.

    - ``rupture`` [m]: where the pressurised film ends, a node; ``flow_film`` [m]: mass flux/(rho0 |U|); ``load`` [N/m].
    - ``e_prime`` [Pa]: the one with which it was solved; ``cells``: of its grid (0: closed form).
    - ``imposed``: a pressure that deflects the film in addition to its own.
    """

    @property
    def x(self) -> np.ndarray: ...
    @property
    def pressure(self) -> np.ndarray: ...
    @property
    def film_thickness(self) -> np.ndarray: ...
    @property
    def min_film(self) -> float: ...
    @property
    def central_film(self) -> float: ...
    @property
    def flow_film(self) -> float: ...
    @property
    def rupture(self) -> float: ...
    @property
    def load(self) -> float: ...
    @property
    def radius(self) -> float: ...
    @property
    def e_prime(self) -> float: ...
    @property
    def entrainment_speed(self) -> float: ...
    @property
    def cells(self) -> int: ...
    @property
    def imposed(self) -> LinePressure | None: ...
    @property
    def report(self) -> Report: ...

    def film_at(self, x) -> np.ndarray:
        """Film thickness [m] at any positions ``x`` [m]."""

    def imposed_deflection(self, x) -> np.ndarray:
        """Part of the film [m] at ``x`` [m] that is due to ``imposed``, up to a constant; zero without one."""


@dataclass(frozen=True)
class LeftOut:
    """What a level leaves out: ``parts`` by name. Each is the relative change of the film or of its friction, whichever
    is larger."""

    parts: dict[str, float] = field(default_factory=dict)

    @property
    def total(self) -> float:
        """The sum."""
        total = 0.0
        for value in self.parts.values():
            total += value
        return total

    def of(self, names: Iterable[str]) -> LeftOut:
        """Only the parts called ``names``."""
        return LeftOut({name: value for name, value in self.parts.items() if name in names})


@dataclass(frozen=True)
class FilmLevel:
    """A way to find the film of a `LineContact`.

    name: as in ``numerics.film_level``; words: in `Decision.text`; neglects: names of the parts that it leaves out;
    numerical: whether it takes a tolerance and a number of cells (False: closed form).
    """

    name: str
    words: str
    neglects: tuple[str, ...] = ()
    numerical: bool = False

    def solve(
        self, line: LineContact, *, tolerance: float, cells: int = 0, imposed=None, start: Film | None = None
    ) -> Film:
        """The film that carries ``line.load_per_width``, to ``tolerance`` (relative), on at least ``cells`` cells.

        ``imposed``: a line pressure that also deflects the film (as in `lubfric.solve_ehl`); ``start``: the film of a
        neighbour, of any level.
        """
        raise NotImplementedError

    def left_out(self, film: Film, line: LineContact, allowed: float) -> LeftOut:
        """What ``film``, which this level found for ``line``, leaves out. Once a part is above ``allowed``, the others
        need not be found."""
        return LeftOut()

    def shear(
        self,
        film: Film,
        lubricant: Lubricant,
        *,
        slide_roll_ratio: float,
        width: float,
        contact_fraction: Callable,
        cavitated: str,
        warm=None,
        rolling: Rolling | None = None,
    ) -> ShearForce:
        """Force of ``film`` on the upper surface (`lubfric.film.shear.shear_force`); ``warm``: with its heat;
        ``rolling``: for a level whose films know their rolling force."""
        return shear_force(
            film,
            lubricant,
            slide_roll_ratio=slide_roll_ratio,
            width=width,
            contact_fraction=contact_fraction,
            cavitated=cavitated,
            warm=warm,
            rolling=rolling,
        )
