"""The table: f of narrow strips on the cells of an answer and on shorter ones along x, over the same way, with the same
roughness at the same places; and what the answer states as its error by them."""

import math
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import lubfric
from lubfric.models.deterministic import effort_of, solve_moving_strip
from lubfric.models.deterministic.moving import half_width
from lubfric.models.deterministic.shorter_cells import error_by_motion

from ...types import PlainRow
from .. import table_file
from ..moving_coverage.table import RollingContact, contacts, narrow_strip

TABLE = Path(__file__).parent / "table.csv"
COLUMNS = (
    "contact",
    "seed",
    "halvings",
    "f",
    "half",
    "twice",
    "share",
    "mean_gap",
    "min_gap",
    "coarse",
    "follows",
    "seconds",
    "failure",
)

# Halvings of the cells along x on which the maps are made.
MOST_HALVINGS = 2

# Half-widths of the film whose moments count.
WAY = 1.5

SPEEDS = (0.05, 5.0)  # m/s, of the needle roller beside its own
SLIDING = 1.6  # slide-roll ratio at which no mass is followed along the lubricant

DIGITS = 6  # of a number in the table


def cases() -> tuple[RollingContact, ...]:
    """Return the contacts of `moving_coverage`, the needle roller at other speeds, and the light contact sliding more."""
    every = {contact.name: contact for contact in contacts()}
    needle = every["needle roller"]
    others = [replace(needle, name=f"needle roller, {speed:g} m/s", speed=speed) for speed in SPEEDS]
    light = every["light contact"]
    scene = light.scene.with_(motion={"slide_roll_ratio": SLIDING})
    return (*every.values(), *others, replace(light, name="light contact, sliding", scene=scene))


def followed(contact: RollingContact, seed: int, halvings: int) -> PlainRow:
    """Return the row of ``contact`` on the surface ``seed`` and cells halved so often along x."""
    prepared, bodies, (fx, fy) = narrow_strip(contact, seed, (MOST_HALVINGS, 0))
    scene = prepared.scene
    factors = (fx // 2**halvings, fy)
    cell = factors[0] * bodies[0].surface.spacing[0]
    steps = round(WAY * half_width(scene.line_contact(contact.speed)) / cell)
    effort = effort_of(scene, bodies, contact.speed, (fx, fy))  # that of the answer
    strip = solve_moving_strip(scene, bodies, contact.speed, factors=factors, effort=effort, most_steps=steps)
    result = strip.result
    return {
        "f": result.coefficient,
        "half": result.at_half_film,
        "twice": result.at_twice_film,
        "share": result.split.rubbing / result.load,
        "mean_gap": result.mean_gap,
        "min_gap": result.min_gap,
        "coarse": cell / prepared.sample.correlation_lengths[0],
        "follows": int(strip.follows_lubricant),
    }


def extend(halvings: int, seeds: int, budget: float, file: Path = TABLE) -> Iterator[PlainRow]:
    """Solve what the table has not, the longest cells first, as long as the processor time of this process is below
    ``budget`` [s], and append each row as it is solved."""
    known = {(row["contact"], row["seed"], row["halvings"]) for row in table_file.rows(file)}
    for count in range(halvings + 1):
        for seed in range(seeds):
            for contact in cases():
                if (contact.name, str(seed), str(count)) in known:
                    continue
                if time.process_time() > budget:
                    return
                begun = time.process_time()
                row: PlainRow = {"contact": contact.name, "seed": seed, "halvings": count}
                try:
                    row |= followed(contact, seed, count) | {"failure": ""}
                except lubfric.LubfricError as error:
                    row["failure"] = f"{type(error).__name__}: {error}".replace("\n", " ")[:120]
                row["seconds"] = time.process_time() - begun
                table_file.append(file, COLUMNS, row, DIGITS)
                yield row


def errors(file: Path = TABLE) -> Iterator[PlainRow]:
    """Yield of each strip the error of f on the cells of an answer, relative, and the ``stated`` one.

    The limit of f is that of second order from the two shortest cells, because the flow by the pressure is of second
    order; ``order`` [-]: the seen one (NaN: from fewer than three lengths of cells, or where they do not converge).
    """
    strips: dict[tuple[str, str], dict[int, dict[str, str]]] = {}
    for row in table_file.rows(file):
        if not row["failure"]:
            strips.setdefault((row["contact"], row["seed"]), {})[int(row["halvings"])] = row
    for (contact, seed), rows in strips.items():
        f = [float(rows[count]["f"]) for count in range(len(rows)) if count in rows]
        if len(f) < 2:
            continue
        limit = f[-1] + (f[-1] - f[-2]) / 3.0
        changes = [after - before for before, after in zip(f, f[1:])]
        seen = changes[0] / changes[1] if len(changes) > 1 and changes[1] else math.nan
        yield {
            "contact": contact,
            "seed": seed,
            "lengths": len(f),
            "f": f[0],
            "limit": limit,
            "error": f[0] / limit - 1,
            "order": math.log2(seen) if seen > 0 else math.nan,
            "stated": _stated(rows[0]),
        }


def _stated(row: dict[str, str]) -> float:
    """Return the error by the cells along x that an answer states, at least."""
    by_film = abs(float(row["twice"]) / float(row["f"]) - 1.0)
    follows = row["follows"] == "1"
    is_smooth = "exponential" not in row["contact"]
    return error_by_motion(by_film, float(row["coarse"]), follows_lubricant=follows, is_smooth=is_smooth)
