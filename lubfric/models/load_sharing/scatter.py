"""The scatter of a long contact from place to place, read off one solution of it.

At a given film and approach, each place y along the line has its own mean gap G(y) of the strip, and its own line load
P(y). A place that carries more than its share leaves less load for the others, and their gap grows. So a place changes
the mean gap at the *given mean load* by its influence ``I(y) = G(y) - beta (P(y) - mean P)``, with ``beta = dG/dP`` at
a given film. Means of I over blocks longer than its correlation are nearly independent. Their scatter gives the
standard error of the mean gap.
"""

import math
from dataclasses import dataclass

import numpy as np

from ..._base import FloatArray
from ...contact import ContactState, HalfSpaceContact
from ...film import EHLResult
from ...oil import shear_stress
from ...samples import Sample
from ...scene import Scene
from ..shared import StandardError, block_error, means_of_blocks
from .balance import Balance
from .response import MomentResponse

# Windows of a measured map whose scatter states an error. A choice: two degrees of freedom.
FEWEST_WINDOWS = 3

# Correlation lengths along y in a block that counts as one asperity contact. Half and twice as many change the width
# of an interval by less than 1 % (`python -m verification.campaigns.constants`).
SPOT = 1.75


def hertz_mean_gap(rough_contact: HalfSpaceContact, contact_state: ContactState) -> np.ndarray:
    """Return G(y) [m] (ny,), the gap at every place along the line, averaged over the nominal area A. ``contact_state``
    has fields."""
    assert contact_state.fields is not None
    return rough_contact.weight @ np.maximum(contact_state.fields.gap, 0.0) / rough_contact.weight.sum()


def line_load(rough_contact: HalfSpaceContact, contact_state: ContactState) -> np.ndarray:
    """Return P(y) [N/m] (ny,), the load per length at every place along the line. ``contact_state`` has fields."""
    assert contact_state.fields is not None
    return contact_state.fields.pressure.sum(axis=0) * rough_contact.spacing[0]


def gap_influence(gap: FloatArray, load: FloatArray, slope: float) -> np.ndarray:
    """Return I(y) [m] (ny,) for a ``gap`` G(y) [m], a ``load`` P(y) [N/m] and a ``slope`` dG/dP [m²/N] at a given
    film."""
    return gap - slope * (load - load.mean())


def effective_contacts(line_load: FloatArray, step: float, correlation_length: float) -> float:
    """Return (sum P)²/sum P² over short blocks, about one asperity contact each: how many equally loaded asperity
    contacts would carry the load as unevenly as these."""
    size = max(1, round(SPOT * correlation_length / step))
    loads = line_load[: line_load.size // size * size].reshape(-1, size).sum(axis=1)
    square = float(np.sum(np.square(loads)))
    return float(np.sum(loads)) ** 2 / square if square > 0 else 0.0


@dataclass(frozen=True, kw_only=True)
class Scatter:
    """How far the means over a sample may be off those of the infinite line contact.

    Attributes
    ----------
    length : of the sample [m]
    gap : standard error of the mean gap at given load [m]
    area : of the contact area fraction of A at given load [-]
    contact_length : of the contact area per length at given load [m]
    coefficient : of f in balance, relative
    effective_contacts : what `effective_contacts` gives
    """

    length: float
    gap: StandardError = StandardError(math.inf, 0)
    area: StandardError = StandardError(math.inf, 0)
    contact_length: StandardError = StandardError(math.inf, 0)
    coefficient: StandardError = StandardError(math.inf, 0)
    effective_contacts: float = 0.0


def scatter_of(scene: Scene, rough_contact: HalfSpaceContact, balance: Balance, sample: Sample, count: int) -> Scatter:
    """Return the `Scatter` of ``rough_contact``, ``count`` strips of ``sample`` joined, in ``balance``. Of a mirrored
    map only half counts."""
    state = balance.contact_state
    response = balance.response
    assert state.fields is not None and response is not None
    slopes = response.slopes
    rows = slice(0, sample.distinct_rows(rough_contact.heights))
    by_place = line_load(rough_contact, state)[rows]
    step = rough_contact.spacing[1]
    touching = state.fields.pressure[:, rows] > 0
    squares = np.square(rough_contact.heights[:, rows]).mean(axis=0) if sample.has_exact_sq else None

    def error(influence: FloatArray) -> StandardError:
        return place_error(influence, step, sample, count, squares)

    def at_given_load(values: FloatArray, slope: float) -> StandardError:
        return error(gap_influence(values, by_place, slope))

    of_coefficient = StandardError(0.0, 1)
    if balance.film is not None and response.rates and balance.forces.total:
        of_coefficient = error(friction_influence(scene, rough_contact, balance)[rows])
    return Scatter(
        length=by_place.size * step,
        gap=at_given_load(hertz_mean_gap(rough_contact, state)[rows], slopes.gap),
        area=at_given_load(rough_contact.weight @ touching / rough_contact.weight.sum(), slopes.area),
        contact_length=at_given_load(touching.sum(axis=0) * rough_contact.spacing[0], slopes.contact_length),
        coefficient=of_coefficient,
        effective_contacts=effective_contacts(by_place, step, sample.correlation_lengths[1]),
    )


def friction_influence(scene: Scene, rough_contact: HalfSpaceContact, balance: Balance) -> np.ndarray:
    """Return the influence of every place y of ``rough_contact`` on f (ny,), relative, in a ``balance`` of film and
    contact: by the gap, which divides the load, and by where the place touches, since the film has no shear there. 0
    without contact."""
    state = balance.contact_state
    response = balance.response
    film = balance.film
    if response is None or not response.rates or film is None or state.fields is None:
        return np.zeros(rough_contact.heights.shape[1])
    touching = state.fields.pressure > 0
    touching_length = max(float(touching.sum(axis=0).mean()) * rough_contact.spacing[0], 1e-300)
    lost = film_stress(scene, rough_contact, film) @ touching * rough_contact.spacing[0]
    by_load = response.rates["coefficient"] * response.log_load_ratio_per_gap
    force = balance.forces.total / scene.bodies.width
    slope = (
        by_load * response.slopes.gap - response.slopes.contact_length * float(lost.mean()) / touching_length / force
    )
    values = by_load * hertz_mean_gap(rough_contact, state) - lost / force
    return gap_influence(values, line_load(rough_contact, state), slope)


def place_error(
    influence: FloatArray, step: float, sample: Sample, count: int, exact: FloatArray | None = None
) -> StandardError:
    """Return the standard error of the mean of the ``influence`` of places along ``count`` strips, on cells of ``step``
    [m]: from blocks (`block_error`). If there are three windows of a measured map or more, it is the larger of that and
    the one from windows, which show whether a surface differs from place to place."""
    blocks = block_error(influence, step, sample.correlation_lengths[1], exact)
    if sample.is_homogeneous or count < FEWEST_WINDOWS:
        return blocks
    means = means_of_blocks(influence, count)
    windows = StandardError(float(means.std(ddof=1)) / math.sqrt(count), count - 1)
    return max((e for e in (blocks, windows) if math.isfinite(e.value)), key=lambda e: e.value)


def film_stress(scene: Scene, rough_contact: HalfSpaceContact, film: EHLResult) -> np.ndarray:
    """Return the shear stress [Pa] (nx,) of ``film`` at the columns of ``rough_contact``, signed as the friction."""
    sliding = scene.motion.slide_roll_ratio * film.entrainment_speed
    pressure = np.interp(rough_contact.x, film.x, film.pressure)
    stress = shear_stress(scene.lubricant, pressure, abs(sliding) / film.film_at(rough_contact.x))
    return np.where(pressure > 0, np.abs(stress), 0.0)


def moment_error(
    rough_contact: HalfSpaceContact,
    contact_state: ContactState,
    response: MomentResponse,
    *,
    width: float,
    correlation_length: float,
) -> float:
    """Return the relative standard error of f at one moment, from a ``contact_state`` with fields on ``rough_contact``:
    0 without contact, NaN if the line is too short.

    ``response``: that of the moment; ``width`` [m]: of the contact; ``correlation_length`` [m]: along the line.
    """
    if response.contact_load <= 0 or response.force == 0:
        return 0.0
    if contact_state.fields is None or not math.isfinite(correlation_length):
        return math.nan
    slope = -response.softness / (response.contact_load / width)
    values = gap_influence(hertz_mean_gap(rough_contact, contact_state), line_load(rough_contact, contact_state), slope)
    influence_error = block_error(values, rough_contact.spacing[1], correlation_length)
    return response.per_gap * influence_error.value if influence_error.freedom else math.nan
