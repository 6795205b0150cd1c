"""Tables made from what longer commands kept in their folders, as far as those commands have come."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from .. import kept
from ..charts import data
from ..charts.growth import exponent
from ..check import Check
from ..levels import measure as levels
from ..levels.scenes import SEED
from ..sampling import cases, measure, quantities, verdict
from .measured import Cells

SAMPLING, LEVELS, CHARTS, MODEL, STABILITY = (
    Path("out", name) for name in ("sampling", "levels", "charts", "model", "stability")
)
METHODS_ERROR = 1e-5  # of the pressure


def coverage() -> Cells:
    """Every case of `python -m verification sampling` with trials and a truth."""
    found = [measure.found_before(case, cases.SEED, SAMPLING) for case in cases.CASES]
    rows = [verdict.row(result) for result in found if result is not None]
    if not rows:
        raise RuntimeError(f"{SAMPLING} is empty: run python -m verification sampling first")
    return verdict.COLUMNS, rows


def other_numbers() -> Cells:
    """How often every quantity of random scenes was within its stated error."""
    file = SAMPLING / f"quantities-{quantities.SEED}.jsonl"
    scenes = kept.read(file)
    rows = [
        [f"`{name}`", f"{told} of {len(scenes)}", f"{100 * held:.0f} %", f"{100 * median:.2g} %"]
        for name, told, held, median in quantities.counted(scenes)
    ]
    return ["quantity", "scenes that state an error", "within it", "median of it"], rows


def levels_saving() -> Cells:
    """Random scenes at every tolerance beside the full model, by `python -m verification levels`."""
    file = levels.file_of(LEVELS, SEED)
    found = [Check.from_dict(c) for line in kept.read(file) for c in line]
    if not found:
        raise RuntimeError(f"{file} is empty: run python -m verification levels first")
    rows = []
    for tolerance in levels.TOLERANCES:
        mine = [c for c in found if c.number("asked") == tolerance]
        good = [c for c in mine if not c.refused]
        within = sum(c.deviation <= tolerance for c in good)
        saved = levels.savings(mine)
        worst = max(c.deviation for c in good)
        times = [f"{saved[name]:.1f}" for name in ("reference", "everything at 1 %")]
        row = [f"{100 * tolerance:g} %", f"{within} of {len(mine)}", str(len(mine) - len(good)), f"{100 * worst:.2g} %"]
        rows.append([*row, *times])
    columns = ["tolerance", "within it", "refused", "largest error", "median time, reference : auto"]
    return [*columns, 'the same with `model="full"` at 1 % : auto'], rows


def contact_methods() -> Cells:
    """Contacts solved to a measured error of 1e-5: time of every method over that of the library, from the chart."""
    points = [p for p in data.load(CHARTS, "contact") if not p.at.get("apart") and p.measured <= METHODS_ERROR]
    names = [name for name in dict.fromkeys(p.word("method") for p in points) if name != "lubfric"]
    rows = []
    for panel in dict.fromkeys(p.word("panel") for p in points):
        own = [p for p in points if p.word("panel") == panel]
        best = {p.word("method"): min(q.duration for q in own if q.at["method"] == p.at["method"]) for p in own}
        ours = best["lubfric"]
        rows.append([panel, f"{1e3 * ours:.0f} ms", *(f"{best[n] / ours:.1f}" if n in best else "" for n in names)])
    return ["contact", "lubfric", *names], rows


def growth() -> Cells:
    """Cost against size, by `python -m verification charts --only growth`."""
    points = data.load(CHARTS, "growth")
    rows = []
    for panel in dict.fromkeys(p.word("panel") for p in points):
        own = [p for p in points if p.word("panel") == panel]
        told = [f"{1e3 * p.duration:.3g} ms" if p.duration < 1 else f"{p.duration:.3g} s" for p in own]
        power = f"N^{exponent(own, 'seconds'):.2f}"
        memory = f"{np.max([p.number('memory') for p in own]) / 1e6:.0f} MB"
        size, work = (f"{own[0].number(what):,.0f} to {own[-1].number(what):,.0f}" for what in ("size", "work"))
        rows.append([panel, size, ", ".join(told), power, memory, work])
    columns = ["job", "cells, nodes or points", "CPU time of each size", "larger half", "memory at most"]
    return [*columns, "convolutions, steps or points"], rows


def model_error() -> Cells:
    """Every model of load sharing beside one gap with one pressure, by `python -m verification model`. Points that it
    kept are not solved again."""
    from ..model.summary import deviations, table

    return table(deviations(_model_points()))


def model_cost() -> Cells:
    """Processor time of a point by every model, by `python -m verification model`."""
    from ..model.summary import cost

    return cost(_model_points())


def _model_points():
    from ..model import settings
    from ..model.measure import all_points

    return all_points(settings("default"), MODEL / "model-error-default" / "points.jsonl")


def measured_map() -> Cells:
    """Every model on a measured map, by `python -m verification model --only model-error --map SCENE`."""
    from ..model.measured import kept_points
    from ..model.summary import deviations, table

    points = kept_points(MODEL / "model-error-default")
    if not points:
        raise RuntimeError(f"{MODEL} holds no measured map: run python -m verification model --map SCENE first")
    return table(deviations(points))


def refinement() -> Cells:
    """The film on 128, 256 and 512 cells across, by `python -m verification model --only grids --full`."""
    found = [row for _, row in kept.read(MODEL / "grids-full" / "points.jsonl")]
    if not found:
        raise RuntimeError(f"{MODEL} holds no grids: run python -m verification model --only grids --full first")
    rows = []
    for speed in dict.fromkeys(row[0] for row in found):
        mine = [row for row in found if row[0] == speed]
        last, order, told = (np.abs([row[k] for row in mine]) for k in (5, 6, 7))
        row = [f"{speed:g}", str(len(mine)), f"{last.max():.2f} %", f"{order.min():.1f} to {order.max():.1f}"]
        row += [
            f"{told.max():.2f} %",
            f"{np.median([r[-2] for r in mine]):.0f} s",
            f"{max(r[-1] for r in mine):.1f} GB",
        ]
        rows.append(row)
    columns = ["U (m/s)", "surfaces", "largest change of f, 256 to 512", "order", "largest stated error at 512"]
    return [*columns, "processor time at 512, median", "memory"], rows


def heavy_loads() -> Cells:
    """The deterministic film at heavy loads, by `python -m verification model --only loads`."""
    found = [row for _, rows in kept.read(MODEL / "loads-default" / "surfaces.jsonl") for row in rows]
    if not found:
        raise RuntimeError(f"{MODEL} holds no loads: run python -m verification model --only loads first")
    rows = []
    for kind in dict.fromkeys(row[0] for row in found):
        mine = [row for row in found if row[0] == kind]
        seconds = [row[-2] for row in mine if not row[-1]]
        first = {row[1]: row[2] for row in reversed(mine) if row[-1]}  # of the speeds of a surface, fastest first
        failed = [
            f"from {speed:g} m/s down: " + ", ".join(str(seed) for seed in sorted(first) if first[seed] == speed)
            for speed in sorted(set(first.values()), reverse=True)
        ]
        row = [kind, str(len({row[1] for row in mine})), f"{len(seconds)} of {len(mine)}"]
        rows.append([*row, f"{np.median(seconds):.1f} s", f"{max(seconds):.1f} s", "; ".join(failed)])
    return ["load", "surfaces", "points solved", "median processor time", "longest", "surfaces not solved"], rows


def whole_map() -> Cells:
    """The deterministic film over 10 speeds and 4 heights of roughness, by `python -m verification stability --full
    --only whole`."""
    from ..stability.cell import FAILED, VERDICTS
    from ..stability.cell import verdict as verdict_of
    from ..stability.whole_map import LOADS, pressure

    found = [Check.from_dict(row) for _, row in kept.read(STABILITY / "whole-full" / "cells.jsonl")]
    if not found:
        raise RuntimeError(f"{STABILITY} holds no map: run python -m verification stability --full --only whole first")
    rows = []
    for load in LOADS["full"]:
        mine = [c for c in found if c.number("x") == load]
        verdicts = [verdict_of(c) for c in mine]
        worst = max((c.measured for c in mine if not c.refused), default=float("nan"))
        failed = [f"{c.word('map')[7:]} at {c.number('y'):.2g} m/s" for c in mine if verdict_of(c) == FAILED]
        row = [f"{load:g}", f"{1e-9 * pressure(load):.2g}", str(len(mine)), *(str(verdicts.count(v)) for v in VERDICTS)]
        rows.append([*row, f"{worst:.2f}", ", ".join(failed)])
    columns = ["load (N/m)", "Hertz pressure (GPa)", "cells", *VERDICTS, "largest deviation over the allowed one"]
    return [*columns, "where it failed"], rows


def held_out() -> Cells:
    """The told error of the model on surfaces it was not read off, by `python -m verification model`. Points that it
    kept are not solved again."""
    from ..model.held_out import COLUMNS, table

    rows, _ = table("default", MODEL / "model-error-default" / "held-out.jsonl")
    return COLUMNS, [[str(cell) for cell in row] for row in rows]


TABLES: dict[str, Callable[[], Cells]] = {
    "refinement": refinement,
    "heavy-loads": heavy_loads,
    "whole-map": whole_map,
    "held-out": held_out,
    "model-error": model_error,
    "measured-map": measured_map,
    "model-cost": model_cost,
    "sampling-coverage": coverage,
    "sampling-numbers": other_numbers,
    "levels-saving": levels_saving,
    "growth": growth,
    "contact-methods": contact_methods,
}
