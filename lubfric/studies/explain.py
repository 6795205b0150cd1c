"""What a study will cost, before anything is solved."""

from __future__ import annotations

import time

import numpy as np
from scipy import fft

from ..errors import InputError
from ..rough.height_map import contact_map

FILM = 4e-3  # s for the films of a point, of which no grid is larger than some hundred nodes
WARM, COLD = 40, 120  # transforms of the patch for a point started from its neighbour, and for the first of a chain
RECORD = 3000  # bytes of a point on disk
FIELD = 8 * 4  # bytes a cell of the state of a chain under way


def explain(plan) -> str:
    """Points, what they share, predicted cost and disk of a `StudyPlan`, in words; one map of each size is made, none
    solved."""
    curves = [curve for batch in plan.batches for curve in batch.curves]
    chains = sum(len(curve.chains) for curve in curves)
    maps = {repr((batch.leader.surface, batch.leader.counterface)): batch.leader for batch in plan.batches}
    lines = [f"study of {plan.scene.name}: {plan.points} points"]
    for axis in plan.axes:
        first, last = axis.values[0], axis.values[-1]
        shown = ", ".join(f"{key} from {_short(a)} to {_short(b)}" for key, a, b in zip(axis.keys, first, last))
        lines.append(f"  {len(axis.values):6d} x {shown}")
    lines.append(f"  {len(plan.speeds):6d} speeds, {min(plan.speeds):g} to {max(plan.speeds):g} m/s")
    cells, seconds, failed = _costs(plan, maps)
    lines += [
        f"  shared         {len(maps)} height maps ({cells} cells the largest), {len(plan.batches)} batches that "
        f"share map and operator, {chains} warm-started chains of at most "
        f"{max(len(c.speeds) for k in curves for c in k.chains)} points",
        f"  time           about {_time(seconds)} on one core (within a factor of 3), divided by the number of "
        "processes "
        f"up to {len(plan.batches)}",
        f"  disk           about {_size(plan.points * RECORD)}, and {_size(FIELD * cells)} for each process "
        "while it runs",
        *(f"  cannot be solved: {reason}" for reason in failed),
    ]
    return "\n".join(lines)


def _costs(plan, maps) -> tuple[int, float, list[str]]:
    """(cells of the largest map, seconds, reasons of maps that cannot be made)."""
    seconds, largest, failed, transform = 0.0, 0, [], {}
    for batch in plan.batches:
        name = repr((batch.leader.surface, batch.leader.counterface, batch.leader.contact))
        if name not in transform:
            try:
                shape = contact_map(batch.leader).shape
                transform[name] = _transform(shape)
                largest = max(largest, int(np.prod(shape)))
            except InputError as error:
                transform[name] = 0.0
                failed.append(str(error))
        for curve in batch.curves:
            points, chains = sum(len(c.speeds) for c in curve.chains), len(curve.chains)
            seconds += points * (FILM + WARM * transform[name]) + chains * COLD * transform[name]
    return largest, seconds, failed


def _transform(shape) -> float:
    """Seconds of one Fourier transform there and back of a patch twice as long, on a grid about half as fine."""
    values = np.zeros((max(2, shape[0]), max(2, shape[1] // 2)))
    best = np.inf
    for _ in range(3):
        begun = time.perf_counter()
        fft.irfft2(fft.rfft2(values), values.shape)
        best = min(best, time.perf_counter() - begun)
    return best


def _short(value) -> str:
    text = f"{value:.4g}" if isinstance(value, float) else str(value)
    return text if len(text) < 50 else text[:47] + "..."


def _time(seconds: float) -> str:
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds > 2 * size:
            return f"{seconds / size:.2g} {unit}"
    return f"{seconds:.2g} s"


def _size(count: float) -> str:
    for unit, size in (("GB", 1e9), ("MB", 1e6)):
        if count >= size:
            return f"{count / size:.2g} {unit}"
    return f"{count / 1e3:.2g} kB"
