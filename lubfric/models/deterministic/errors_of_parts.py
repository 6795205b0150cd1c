"""Errors of the numbers of a point beside f: by their scatter between strips or along them, and by their cells."""

import math
from collections.abc import Callable, Sequence

import numpy as np

from ..._base import FloatArray
from ..shared import Prepared
from .result import DeterministicResult
from .scatter import STRIP_OVER_BLOCKS, STRIPS_FOR_SCATTER, error_by_blocks, samples_over_time
from .shorter_cells import ShorterCells
from .strip import StripSolution, error_by_cells
from .strip_on_two_grids import StripOnTwoGrids, numbers_of_strip
from .time_and_place import mean_over_blocks


def _contact_load(result: DeterministicResult) -> FloatArray:
    return (result.pressure * result.rubbing).sum(axis=0) * result.spacing[0]


def _boundary_force(result: DeterministicResult) -> FloatArray:
    return (result.shear * result.rubbing).sum(axis=0) * result.spacing[0]


# Loads and forces [N/m] of every place along y (ny,) of a strip at rest.
AT_PLACES_OF_STRIP: dict[str, Callable[[DeterministicResult], FloatArray]] = {
    "contact_load": _contact_load,
    "film_load": lambda result: result.load_at - _contact_load(result),
    "boundary_force": _boundary_force,
    "couette_force": lambda result: result.couette_at,
    "shear_force": lambda result: result.friction_at - _boundary_force(result),
}

# Names of the fields of `TimeAndPlace` with the same numbers of moving roughness.
AT_PLACES_OVER_TIME = {"contact_load": "contact_load", "boundary_force": "contact_load", "couette_force": "couette"}


def errors_of_numbers(
    prepared: Prepared, pairs: Sequence[StripOnTwoGrids], shorter: ShorterCells, numbers: dict[str, float]
) -> dict[str, float]:
    """Return the relative standard errors of the ``numbers`` with those of their cells, by name, as far as they are
    known.

    The scatter is that between the strips; of fewer than `STRIPS_FOR_SCATTER` it is known of loads and forces alone, by
    blocks of places. The error by the cells is that of the geometric series of the changes of each number itself from
    cells to cells (`error_by_cells`), where roughness rests; where it moves it is that of f.
    """
    if len(pairs) >= STRIPS_FOR_SCATTER:
        scatter = _between_strips(prepared, pairs, numbers)
    else:
        scatter = _along_strips(prepared, pairs)
    if pairs[0].resolved.moves:
        return {name: math.hypot(error, shorter.error) for name, error in scatter.items()}
    load = prepared.scene.bodies.load
    by_cells = {
        name: load * error_by_cells(changes) / abs(numbers[name])
        for name, changes in _changes_by_cells(prepared, pairs, shorter).items()
        if numbers[name]
    }
    return {name: math.hypot(error, by_cells.get(name, shorter.error)) for name, error in scatter.items()}


def _between_strips(
    prepared: Prepared, pairs: Sequence[StripOnTwoGrids], numbers: dict[str, float]
) -> dict[str, float]:
    rows = [numbers_of_strip(prepared, pair.resolved.result) for pair in pairs]
    errors = {name: float(np.std([row[name] for row in rows], ddof=1)) / math.sqrt(len(rows)) for name in numbers}
    return {name: errors[name] / abs(value) for name, value in numbers.items() if value}


def _along_strips(prepared: Prepared, pairs: Sequence[StripOnTwoGrids]) -> dict[str, float]:
    width = prepared.sample.correlation_lengths[1]
    if pairs[0].resolved.moves:
        samples = samples_over_time(pairs)
        means = {name: mean_over_blocks(samples, field, width, None) for name, field in AT_PLACES_OVER_TIME.items()}
        return {name: mean.error.value / abs(mean.value) for name, mean in means.items() if mean.value}
    errors = {}
    for name, at_places in AT_PLACES_OF_STRIP.items():
        places = [_share_at_places(pair.resolved.result, at_places) for pair in pairs]
        share = float(np.mean(places))
        if share:
            deviations = [of_strip - of_strip.mean() for of_strip in places]
            of_blocks = error_by_blocks(deviations, prepared.sample, pairs[0]).value
            errors[name] = STRIP_OVER_BLOCKS * of_blocks / abs(share)
    return errors


def _share_at_places(result: DeterministicResult, at_places: Callable[[DeterministicResult], FloatArray]) -> FloatArray:
    """Return a load or force of every place along y (ny,) over the load, less what it has because its place carries
    more load than the mean."""
    values = at_places(result)
    share = values.mean() / result.load
    return share + (values - share * result.load_at) / result.load


def _changes_by_cells(
    prepared: Prepared, pairs: Sequence[StripOnTwoGrids], shorter: ShorterCells
) -> dict[str, list[float]]:
    """Return the changes of the loads and forces of `AT_PLACES_OF_STRIP` over the load from longer to shorter cells,
    without their sign: on the strips, then on the pieces."""
    levels = [[(pair.longer, pair.resolved) for pair in pairs]]
    levels += [[piece.last_two for piece in shorter.pieces]] if shorter.pieces else []
    levels += [[shorter.shortest.last_two]] if shorter.shortest else []
    changes: dict[str, list[float]] = {name: [] for name in AT_PLACES_OF_STRIP}
    for level in levels:
        (longer, finer) = (_means(prepared, strips) for strips in zip(*level))
        for name, of_name in changes.items():
            of_name.append(abs(finer[name] - longer[name]) / prepared.scene.bodies.load)
    return changes


def _means(prepared: Prepared, strips: Sequence[StripSolution]) -> dict[str, float]:
    rows = [numbers_of_strip(prepared, strip.result) for strip in strips]
    return {name: float(np.mean([row[name] for row in rows])) for name in AT_PLACES_OF_STRIP}
