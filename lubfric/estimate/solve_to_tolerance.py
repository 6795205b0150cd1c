"""How many strips a point takes, and on which cells: as a model's solution requires, until it needs no more."""

from __future__ import annotations

from ..models import Model, SampleSolution
from ..models.shared import ControlVariate, Prepared
from ..samples import Sample


def solve_to_tolerance(
    prepared: Prepared,
    speed: float,
    model: Model,
    *,
    for_fields: bool = False,
    control: ControlVariate | None = None,
) -> SampleSolution:
    """Solve ``prepared`` by ``model`` at ``speed`` [m/s] on as many strips, of cells as short, as its tolerances need.

    More strips follow until the standard error of f is within ``numerics.sampling_tolerance``; shorter cells, each time
    half as long, until their effect can be corrected for, where the model takes them. ``for_fields``: on the cells on
    which a sample shows its fields (`Sample.on_field_cells`); ``control``: what a cheaper model knows of these strips.
    What the answer needs beyond these strips is not solved (`SampleSolution.completed`). Raises `ConvergenceError`.
    """
    sample = prepared.sample
    if for_fields and model.takes_cells_of_sample:
        sample = sample.on_field_cells()
    while True:
        solution = _on_enough_strips(prepared, sample, speed, model, control)
        if not _needs_shorter_cells(model, sample, solution):
            return solution.corrected()
        sample = sample.halved()


def _needs_shorter_cells(model: Model, sample: Sample, solution: SampleSolution) -> bool:
    """Return whether ``solution`` by ``model`` has to be solved on shorter cells of ``sample``."""
    return model.takes_cells_of_sample and not sample.cells.is_native and solution.is_too_coarse()


def _on_enough_strips(
    prepared: Prepared, sample: Sample, speed: float, model: Model, control: ControlVariate | None
) -> SampleSolution:
    """Return the solution on as many strips as it needs, or on fewer where the cells are too long for it anyway."""
    count = model.strips_to_begin_with(sample)
    solution = model.solve(prepared, sample, count, speed, control=control)
    while True:
        count = solution.required_strips()
        if count <= solution.count:
            return solution
        if not solution.takes_more_strips_first() and _needs_shorter_cells(model, sample, solution):
            return solution
        solution = model.solve(prepared, sample, count, speed, start=solution, control=control)
