"""The table: each random rolling contact followed over the same first steps in time, with several efforts.

One change of the economical effort at a time, then all of them. Every variant starts from the film at rest and meets
the same roughness at the same times, so that differences are by the effort alone.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import lubfric
from lubfric.models.deterministic import ECONOMICAL, TIGHT, MovingEffort, solve_moving_strip

from ...types import PlainRow
from .. import table_file
from ..calibration.case import Case, drawn
from ..calibration.solve import limited

TABLE = Path(__file__).parent / "table.csv"
STEPS = 24  # moments in time, from the film at rest on
SECONDS = 60.0  # processor time of one variant of a case, at most
STARVED = 0.7  # of the smooth film: what arrives in every eighth case
DIGITS = 6  # of a number in the table

_TIGHT = replace(TIGHT, discarded=0.0)
_ECONOMICAL = replace(ECONOMICAL, discarded=0.0)
VARIANTS: dict[str, MovingEffort] = {
    "tight": _TIGHT,
    "grid": replace(_TIGHT, inlet=ECONOMICAL.inlet, outlet=ECONOMICAL.outlet),
    "residual": replace(_TIGHT, residual=ECONOMICAL.residual),
    "imbalance": replace(_TIGHT, residual=ECONOMICAL.residual, carries_imbalance=True),
    "linear": replace(_TIGHT, linear=ECONOMICAL.linear),
    "half": replace(_ECONOMICAL, residual=0.5 * ECONOMICAL.residual),
    "economical": _ECONOMICAL,
}
FACTS = ("fluid", "lay", "pressure", "ratio", "slip", "rough", "nx", "ny", "sq", "friction", "limit", "eyring")
COLUMNS = (
    *("seed", "variant", "starved", *FACTS, "half_width", "film"),
    *("f", "share", "f_rest", "steps", "columns", "work", "seconds", "version", "date", "failure"),
)


def case_of(seed: int) -> tuple[Case, bool]:
    """Return the random rolling contact number ``seed``, and whether it is starved: every eighth is."""
    case = drawn("rolling", seed)
    starved = seed % 8 == 5
    if starved:
        film = STARVED * case.scene.line_contact(case.speed).moes_film
        case = replace(case, scene=case.scene.with_(lubricant={"inlet_film": film}))
    return case, starved


def followed(seed: int, variant: str) -> PlainRow:
    """Return the row of contact number ``seed`` with the effort ``variant``."""
    case, starved = case_of(seed)
    line = case.scene.line_contact(case.speed)
    row = {name: case.facts.get(name, "") for name in FACTS}
    row |= {"seed": seed, "variant": variant, "starved": int(starved)}
    row |= {"half_width": line.half_width, "film": line.moes_film}
    row |= {"version": lubfric.__version__, "date": datetime.now(UTC).date().isoformat()}
    begun = time.process_time()
    try:
        with limited(SECONDS):
            strip = solve_moving_strip(case.scene, case.bodies, case.speed, effort=VARIANTS[variant], most_steps=STEPS)
        f = strip.series["coefficient"]
        row |= {
            "f": float(f.mean()),
            "share": float(strip.series["share"].mean()),
            "f_rest": strip.rest.result.coefficient,
            "steps": f.size,
            "columns": strip.problem.x.size,
            "work": strip.work,
            "failure": "",
        }
    except lubfric.LubfricError as error:
        row["failure"] = f"{type(error).__name__}: {error}".replace("\n", " ")[:120]
    return row | {"seconds": time.process_time() - begun}


def rows(file: Path = TABLE) -> list[dict[str, str]]:
    """Return the rows of the table as text."""
    return table_file.rows(file)


def extend(
    count: int, budget: float, variants: Sequence[str] = tuple(VARIANTS), file: Path = TABLE
) -> Iterator[PlainRow]:
    """Solve the missing ``variants`` of the contacts below number ``count``, as long as the processor time of this
    process is below ``budget`` [s], and append each row when it is solved."""
    known = {(int(row["seed"]), row["variant"]) for row in rows(file)}
    for seed in range(count):
        for variant in variants:
            if (seed, variant) in known:
                continue
            if time.process_time() > budget:
                return
            row = followed(seed, variant)
            table_file.append(file, COLUMNS, row, DIGITS)
            yield row


def differences(file: Path = TABLE) -> Iterator[PlainRow]:
    """Yield the difference of each variant from the tight one, of each contact that has both: of f relative, of the
    asperity load ratio absolute, and the ratio of their processor times."""
    table = {(row["seed"], row["variant"]): row for row in rows(file) if not row["failure"]}
    for (seed, variant), row in table.items():
        tight = table.get((seed, "tight"))
        if variant == "tight" or tight is None:
            continue
        yield {
            **{name: row[name] for name in ("seed", "variant", "starved", *FACTS, "half_width", "film")},
            "f": float(row["f"]) / float(tight["f"]) - 1,
            "share": float(row["share"]) - float(tight["share"]),
            "faster": float(tight["seconds"]) / float(row["seconds"]),
        }
