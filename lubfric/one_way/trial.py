"""One trial on the way to an operating point: a load of the contact, a film in its lifted gap, and what both carry."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..contact import ContactResult
from ..deterministic import Problem, dry_contact
from ..film import true_pressure
from .film import RIGHT, GapFilm, Kept, gap_film
from .lift import GUESS, Lifted, lifted, spots_of, surplus
from .limit import pressure_limit

NEAR = 0.01  # of the conditions, from which on a film is settled


@dataclass(frozen=True)
class Trial:
    """A gap, the load of the contact in it, and its film."""

    contact_load: float
    contact: ContactResult | None
    gap: np.ndarray
    closed: np.ndarray
    film: GapFilm
    pressure: np.ndarray
    film_load: float
    spot_film: float

    @property
    def kept(self) -> Kept:
        """What its film leaves for the next."""
        return self.film.kept


@dataclass(frozen=True)
class Before:
    """What the first trial takes over from a neighbour."""

    kept: Kept
    spot_film: float
    contact: None = None


def both_conditions(problem: Problem, unknowns, last: Trial | Before):
    """The values of both conditions at the film's share ``unknowns[0]`` and ln(film on the spots) ``unknowns[1]``."""
    split, height = float(unknowns[0]), math.exp(float(unknowns[1]))
    contact_load, dry, gap = _dry(problem, split, last)
    spots = spots_of(dry.pressure)

    def with_film(film: GapFilm):
        trial = _filled(problem, Lifted(gap + height, film, height), dry.pressure > 0, contact_load, dry)
        unmet = math.log((problem.load - contact_load) / trial.film_load)
        return np.array([unmet, surplus(problem, spots, height, film)]), trial

    return _nearer(problem, gap + height, last.kept, with_film)


def _nearer(problem: Problem, gap, kept: Kept, with_film):
    """The result of ``with_film`` for the film of ``gap``: values of the conditions, and a trial. Near the solution the
    film is solved more exactly."""
    values, trial = with_film(gap_film(problem, gap, kept, RIGHT))
    if np.abs(values).max() > NEAR:
        return values, trial
    return with_film(gap_film(problem, gap, trial.film.kept))


def too_much_film(problem: Problem, split: float, last: Trial | Before):
    """ln of the load that the film should carry beside the contact, over its load; increases with the film's share."""
    contact_load, dry, gap = _dry(problem, split, last)
    spots = spots_of(dry.pressure)
    raised = lifted(problem, gap, spots, last.spot_film or None, last.kept)
    trial = _filled(problem, raised, dry.pressure > 0, contact_load, dry)
    return math.log((problem.load - contact_load) / trial.film_load), trial


def _dry(problem: Problem, split: float, last: Trial | Before) -> tuple[float, ContactResult, np.ndarray]:
    """Load of the contact [N/m] beside a film whose share is ``split``, the contact, and its gap [m]."""
    contact_load = problem.load / (1 + math.exp(split))
    lighter = replace(problem, contact=replace(problem.contact, load_per_width=contact_load))
    dry = dry_contact(lighter, start=last.contact)
    return contact_load, dry, np.where(dry.pressure > 0, 0.0, np.maximum(dry.gap, 0.0))


def too_thick(problem: Problem, log_lift: float, last: Trial | Before) -> tuple[float, Trial]:
    """ln of the load over the load that the film carries between bodies that are apart, against the ln of their lift;
    increases with the lift."""
    scale = max(float(problem.heights.std()), problem.contact.moes_film)
    gap = _apart(problem, scale * math.exp(log_lift))

    def with_film(film: GapFilm):
        trial = _filled(problem, Lifted(gap, film, 0.0), np.zeros(gap.shape, bool), 0.0, None)
        return math.log(problem.load / trial.film_load), trial

    return _nearer(problem, gap, last.kept, with_film)


def _apart(problem: Problem, lift: float) -> np.ndarray:
    """Gap [m] of undeformed bodies whose highest summit is at ``lift``."""
    return np.maximum(problem.rigid_gap - problem.rigid_gap.min() + lift, problem.floor)


def touching_film(problem: Problem) -> Trial:
    """The just touching bodies, lifted by the film that the first summit is taken to keep."""
    gap = _apart(problem, max(GUESS * problem.contact.moes_film, problem.floor))
    return _filled(problem, Lifted(gap, gap_film(problem, gap), 0.0), np.zeros(gap.shape, bool), 0.0, None)


def presses(problem: Problem, trial: Trial) -> bool:
    """Whether the highest summit of bodies that are apart should carry load: its film is too thin for its flow."""
    height = float(trial.gap.min())
    return surplus(problem, spots_of(trial.gap == height), height, trial.film) < 0


def _filled(problem: Problem, raised: Lifted, closed, contact_load: float, dry) -> Trial:
    lubricant, gap, film = problem.lubricant, raised.gap, raised.film
    limit = pressure_limit(lubricant, gap, problem.sliding, problem.boundary_friction)
    pressure = np.where(closed, 0.0, np.minimum(true_pressure(lubricant)(film.reduced), limit))
    carried = float(pressure.sum()) * problem.spacing[0] / gap.shape[1] + film.inlet.load
    return Trial(contact_load, dry, gap, closed, film, pressure, carried, raised.height)
