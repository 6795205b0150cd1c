"""Waves of small height in the elastic film, at rest and moving: the deterministic film compared with finite elements.

Reynolds' equation has two waves as solutions in a film of uniform thickness (C. J. Hooke, Proc. IMechE J 220 (2006)
259-271, doi:10.1243/13506501JET146; `verification.fem.references.hooke`). One moves with the surface and has a part of
its height. The other forms in the inlet and moves with the flow. Its wavenumber is that of the surface times the speed
of the waves over the entrainment speed: for waves at rest it is a uniform change of the film. Both parts are fitted
here to the film over the middle of the contact. They are compared with the linear response of full-system finite
elements (`fem.ripple`). A wave of finite height is compared in time (`fem.moving`).
"""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lubfric.film import LineContact

from ...check import ABSOLUTE, Check, Item, Table
from ...types import PlainRow
from ..parts import line_contact
from ..solvers import ehl
from ..solvers.moving import march
from ..solvers.ripple import ripple
from ..waves import history, laid_out, response

CELLS = 40  # in a wave
HEIGHT = 0.002  # of a wave over the film
NEAR = 0.5  # half-widths: where both parts are fitted
SOURCE = "linear response of full-system finite elements"
ALLOWED = 0.02  # of the height of the waves: difference at rest
MOVING = 0.1  # of the height of the waves: difference in motion
COLUMNS = ("case", "speed/U", "wavelength/b", "surface: lubfric", "elements", "inlet: lubfric", "elements", "rms")


@dataclass(frozen=True)
class WavinessCase:
    """A smooth line contact by the arguments of `solve_ehl`, and its Eyring stress [Pa] (None: Newtonian)."""

    name: str
    values: PlainRow

    @property
    def line(self) -> LineContact:
        """For lubfric."""
        return line_contact(self.values)

    def elements(self, speed: float = 0.0) -> ehl.LineContact:
        """Return the same for the finite elements, with waves of this ``speed`` over the entrainment speed."""
        return ehl.LineContact.of(self.values, 2 * abs(speed - 1) * self.values["entrainment_speed"])

    def but(self, name: str = "", **values: float) -> "WavinessCase":
        """Return the case with other ``values``."""
        return WavinessCase(name or self.name, self.values | values)


SOFT = WavinessCase(
    "soft, isoviscous",
    {"load_per_width": 2e4, "radius": 1e-2, "e_prime": 2e9, "entrainment_speed": 0.5, "viscosity": 0.05}
    | {"viscosity_law": "constant"},
)
STEEL = WavinessCase(
    "steel, Roelands",
    {"load_per_width": 2e5, "radius": 1e-2, "e_prime": 2.3e11, "entrainment_speed": 1.0, "viscosity": 0.04}
    | {"pressure_viscosity_coefficient": 18e-9},
)
SHEARED = STEEL.but("steel, Eyring 5 MPa", eyring_stress=5e6)
# By level: case, speed of the waves, wavelength in half-widths.
CASES: dict[str, tuple[tuple[WavinessCase, float, float], ...]] = {
    "quick": ((STEEL, 1.0, 1.0),),
    "default": (
        (SOFT, 0.0, 0.5),
        (STEEL, 0.0, 0.5),
        (SOFT, 1.5, 0.5),
        (STEEL, 1.5, 0.5),
        *((SHEARED, speed, 0.5) for speed in (0.5, 1.5)),
        (STEEL, 1.0, 1.0),
    ),
}
CASES["full"] = (
    *CASES["default"],
    *((case, 0.0, length) for case in (SOFT, STEEL) for length in (1.0, 0.25)),
    *((case, 0.5, 0.5) for case in (SOFT, STEEL)),
    *((SHEARED, speed, length) for speed in (0.5, 1.5) for length in (1.0, 0.25)),
)


def waviness(level: str) -> Iterator[Item]:
    """Both films over |x| < b/2, and their two parts; a wave of finite height in time."""
    rows = []
    for case, speed, length in CASES[level]:
        row = compared(case, speed, length)
        rows.append((case.name, f"{speed:g}", length, *row))
        name = f"{case.name}: waves of {length:g} b at {speed:g} U"
        allowed = MOVING if speed else ALLOWED
        yield Check(
            f"{name}, rms of the film",
            row[-1],
            expected=0.0,
            tolerance=allowed,
            source=SOURCE,
            kind=ABSOLUTE,
            note="of their height",
        )
        for part, mine, judge in (("of the surface", *row[:2]), ("from the inlet", *row[2:4])):
            yield Check(
                f"{name}, part {part}",
                mine,
                expected=judge,
                tolerance=max(0.1 * judge, 0.003),
                source=SOURCE,
                kind=ABSOLUTE,
            )
    yield Table("waviness", "Waves of small height: what the film has of them", COLUMNS, tuple(rows))
    if level != "quick":
        yield from in_time()


def compared(
    case: WavinessCase, speed: float, length: float, reference_case: WavinessCase | None = None
) -> tuple[float, float, float, float, float]:
    """Return the part that goes with the surface by lubfric and by finite elements, the part from the inlet by both (0
    in pure rolling, where they are one), and the rms difference of the films. ``reference_case``: what the elements
    solve."""
    smooth = laid_out(case.line, speed, CELLS * (max(1.0, speed) if speed else 2.5) / length)
    b = smooth.half_width
    x = smooth.film.x
    near = np.flatnonzero(np.abs(x) < NEAR * b)
    mine, _ = response(smooth, 2 * np.pi / (length * b), HEIGHT * smooth.film.central_gap)
    solution = ehl.solve_ehl(
        (reference_case or case).elements(speed),
        refinements=0,
        fineness=1.0,
        between=0.1 * min(length, 1.0) / max(speed, 1.0),
    )[-1]
    judge = solution.body.line.probes(x[None, near] / b) @ ripple(solution, length * b, speed)
    rms = float(np.sqrt(np.mean(np.abs(mine[near] - judge) ** 2)))
    (ours, other), (theirs, their_other) = (parts(film, x[near] / b, length, speed) for film in (mine[near], judge))
    return ours, theirs, other, their_other, rms


def parts(film: np.ndarray, x: np.ndarray, length: float, speed: float) -> tuple[float, float]:
    """Return amplitudes of the wave of the surface and of that from the inlet; the second may fall along x."""
    surface = np.exp(2j * np.pi * x / length)
    inlet = np.exp(2j * np.pi * x * speed / length)
    if speed == 1:
        return float(np.abs(np.vdot(surface, film)) / x.size), 0.0
    columns = np.stack([surface, inlet, inlet * x], axis=1)
    coefficients = np.linalg.lstsq(columns, film, rcond=None)[0]
    return float(abs(coefficients[0])), float(abs(coefficients[1]))


def in_time() -> Iterator[Item]:
    """A wave of a fifth of the film, one half-width long, in pure rolling: gap over a period by both."""
    smooth = laid_out(STEEL.line, 1.0, 2.4 * CELLS)
    height = 0.2 * smooth.film.central_gap
    times, gaps, _ = history(smooth, 2 * np.pi / smooth.half_width, height)
    at = ehl.solve_ehl(STEEL.elements(1.0), refinements=0, fineness=1.0, between=0.03)[-1]
    b = smooth.half_width
    unit = at.contact.film_unit
    count = 64

    def waves(x: np.ndarray, time: float) -> np.ndarray:
        phase = min(time, 1.0)
        return height / unit * phase**2 * (3 - 2 * phase) * np.cos(2 * np.pi * (x - time))

    near = np.abs(smooth.film.x) < NEAR * b
    pick = at.body.line.probes(smooth.film.x[None, near] / b)
    mine = gaps[:, near]
    marched = list(itertools.islice(march(at, waves, 1 / count), 5 * count))[-count:]
    judge = np.array([pick @ m.H for m in marched]) * unit
    turns = (
        np.exp(2j * np.pi * times * STEEL.line.entrainment_speed / b),
        np.exp(2j * np.pi * np.array([m.time for m in marched])),
    )
    ours, theirs = (2 / turn.size / height * turn @ film for turn, film in zip(turns, (mine, judge)))
    source = "full-system finite elements in time"
    size = float(np.sqrt(np.mean(np.abs(theirs) ** 2)))
    rms = float(np.sqrt(np.mean(np.abs(ours - theirs) ** 2)))
    yield Check(
        "a wave in time: amplitude in the film",
        np.sqrt(np.mean(np.abs(ours) ** 2)),
        expected=size,
        tolerance=0.02,
        source=source,
    )
    yield Check(
        "a wave in time: rms of the film",
        rms,
        expected=0.0,
        tolerance=0.02,
        source=source,
        kind=ABSOLUTE,
        note="of its height",
    )
    yield Check(
        "a wave in time: mean film", mine.mean(), expected=judge.mean(), tolerance=0.005, source=source, unit="m"
    )
