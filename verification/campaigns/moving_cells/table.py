"""The table: f of narrow strips on the cells of an answer and on shorter ones along x or along y, over the same way, with
the same roughness at the same places; and what the answer states as its error by them."""

import math
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import lubfric
from lubfric.models.deterministic import effort_of, error_along_x, error_along_y, solve_moving_strip
from lubfric.models.deterministic.moving import half_width
from lubfric.models.deterministic.strip import error_by_cells

from ...types import PlainRow
from .. import table_file
from ..moving_coverage.table import RollingContact, contacts, narrow_strip

TABLE = Path(__file__).parent / "table.csv"
COLUMNS = (
    "contact",
    "seed",
    "axis",
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

# Halvings of the cells along x and y on which the maps are made, by the axis along which cells are halved.
HALVINGS = {"x": (2, 0), "y": (0, 1)}

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


def followed(contact: RollingContact, seed: int, axis: str, halvings: int) -> PlainRow:
    """Return the row of ``contact`` on the surface ``seed`` and cells halved so often along ``axis``; doubled for -1."""
    prepared, bodies, (fx, fy) = narrow_strip(contact, seed, HALVINGS[axis])
    scene = prepared.scene
    factors = (round(fx / 2**halvings), fy) if axis == "x" else (fx, round(fy / 2**halvings))
    cell = factors[0] * bodies[0].surface.spacing[0]
    along = "xy".index(axis)
    length = factors[along] * bodies[0].surface.spacing[along]
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
        "coarse": length / prepared.sample.correlation_lengths[along],
        "follows": int(strip.follows_lubricant),
    }


def extend(halvings: int, seeds: int, budget: float, file: Path = TABLE) -> Iterator[PlainRow]:
    """Solve what the table has not, the longest cells first, as long as the processor time of this process is below
    ``budget`` [s], and append each row as it is solved. Along y the longest cells are twice those of an answer."""
    known = {(row["contact"], row["seed"], row["axis"], row["halvings"]) for row in table_file.rows(file)}
    levels = [
        ("y", -1),
        *((axis, count) for count in range(halvings + 1) for axis in "xy" if count <= HALVINGS[axis]["xy".index(axis)]),
    ]
    for seed in range(seeds):
        for axis, count in levels:
            for contact in cases():
                if (contact.name, str(seed), axis, str(count)) in known:
                    continue
                if time.process_time() > budget:
                    return
                begun = time.process_time()
                row: PlainRow = {"contact": contact.name, "seed": seed, "axis": axis, "halvings": count}
                try:
                    row |= followed(contact, seed, axis, count) | {"failure": ""}
                except lubfric.LubfricError as error:
                    row["failure"] = f"{type(error).__name__}: {error}".replace("\n", " ")[:120]
                row["seconds"] = time.process_time() - begun
                table_file.append(file, COLUMNS, row, DIGITS)
                yield row


def errors(file: Path = TABLE) -> Iterator[PlainRow]:
    """Yield of each strip and axis the error of f on the cells of an answer, relative, and the ``stated`` one.

    The limit of f is that of second order from the two shortest cells, because the flow by the pressure is of second
    order; ``order`` [-]: the seen one (NaN: from fewer than three lengths of cells, or where they do not converge).
    """
    strips: dict[tuple[str, str, str], dict[int, dict[str, str]]] = {}
    for row in table_file.rows(file):
        if not row["failure"]:
            strips.setdefault((row["contact"], row["seed"], row["axis"]), {})[int(row["halvings"])] = row
    for (contact, seed, axis), rows in strips.items():
        f = {count: float(rows[count]["f"]) for count in sorted(rows)}
        if 0 not in f or 1 not in f:
            continue
        shortest = max(f)
        limit = f[shortest] + (f[shortest] - f[shortest - 1]) / 3.0
        changes = [f[count] - f[count - 1] for count in f if count - 1 in f]
        seen = changes[-2] / changes[-1] if len(changes) > 1 and changes[-1] else math.nan
        yield {
            "contact": contact,
            "seed": seed,
            "axis": axis,
            "lengths": len(f),
            "f": f[0],
            "limit": limit,
            "error": f[0] / limit - 1,
            "order": math.log2(seen) if seen > 0 else math.nan,
            "stated": _stated(rows, axis),
        }


def _stated(rows: dict[int, dict[str, str]], axis: str) -> float:
    """Return the error by the cells along ``axis`` that an answer states, at least."""
    row = rows[0]
    f = float(row["f"])
    by_film = abs(float(row["twice"]) / f - 1.0)
    coarse = float(row["coarse"])
    if axis == "y":
        by_longer = abs(1.0 - float(rows[-1]["f"]) / f) if -1 in rows else 0.0
        return max(error_along_y(by_film, coarse), error_by_cells([by_longer]))
    follows = row["follows"] == "1"
    is_smooth = "exponential" not in row["contact"]
    return error_along_x(by_film, coarse, follows_lubricant=follows, is_smooth=is_smooth)
