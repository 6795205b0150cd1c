"""The table: f of narrow strips on the cells of an answer and on shorter ones along x or along y, over the same way,
with the same roughness at the same places; and what the answer states as its error by them."""

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

import lubfric
from lubfric.models.deterministic import CellsInMotion, effort_of, solve_moving_strip
from lubfric.models.deterministic.moving import film_half_width

from ...types import PlainRow
from .. import extending, table_file
from ..calibration.solve import limited
from ..moving_coverage.contacts import RollingContact, contact_named, contacts
from ..moving_coverage.table import MOST_SECONDS, narrow_strip

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
    "coarse_y",
)

# Halvings of the cells along x and y on which the maps are made, by the axis along which cells are halved.
HALVINGS = {"x": (2, 0), "y": (0, 1), "xy": (1, 1)}

# Half-widths of the film whose moments count.
WAY = 1.5

SPEEDS = (0.05, 5.0)  # m/s, of the needle roller beside its own
SLIDING = 1.6  # slide-roll ratio at which no mass is followed along the lubricant

DIGITS = 6  # of a number in the table


def cases() -> dict[str, RollingContact]:
    """Return the contacts of `moving_coverage`, the needle roller at other speeds, and the light contact sliding
    more."""
    every = {contact.name: contact for contact in contacts()}
    needle = every["needle roller"]
    others = [replace(needle, name=f"needle roller, {speed:g} m/s", speed=speed) for speed in SPEEDS]
    light = every["light contact"]
    scene = light.scene.with_(motion={"slide_roll_ratio": SLIDING})
    sliding = replace(light, name="light contact, sliding", scene=scene)
    return {contact.name: contact for contact in (*every.values(), *others, sliding)}


def followed(contact: RollingContact, seed: int, axis: str, halvings: int) -> PlainRow:
    """Return the row of ``contact`` on the surface ``seed`` and cells halved so often along ``axis``, "x", "y" or "xy"
    for both; for -1 doubled along y."""
    prepared, bodies, (fx, fy) = narrow_strip(contact, seed, HALVINGS[axis])
    scene = prepared.scene
    along_x = max(halvings, 0) if "x" in axis else 0
    along_y = halvings if "y" in axis else 0
    map_coarsening = (round(fx / 2**along_x), round(fy / 2**along_y))
    cell = map_coarsening[0] * bodies[0].surface.spacing[0]
    (lx, ly) = prepared.sample.correlation_lengths
    coarse_y = map_coarsening[1] * bodies[0].surface.spacing[1] / ly
    steps = round(WAY * film_half_width(scene.line_contact(contact.speed)) / cell)
    effort = effort_of(scene, bodies, contact.speed, (fx, fy))  # that of the answer
    strip = solve_moving_strip(
        scene, bodies, contact.speed, map_coarsening=map_coarsening, effort=effort, most_steps=steps
    )
    result = strip.result
    return {
        "f": result.coefficient,
        "half": result.at_half_film,
        "twice": result.at_twice_film,
        "share": result.split.rubbing / result.load,
        "mean_gap": result.mean_gap,
        "min_gap": result.min_gap,
        "coarse": coarse_y if axis == "y" else cell / lx,
        "coarse_y": coarse_y,
        "follows": int(strip.follows_lubricant),
    }


@dataclass(frozen=True)
class CellJob:
    """One row of the table."""

    name: str
    seed: int
    axis: str
    halvings: int

    def row(self) -> PlainRow:
        """Return the row, solved."""
        contact = contact_of(self.name)
        row: PlainRow = {"contact": self.name, "seed": self.seed, "axis": self.axis, "halvings": self.halvings}
        begun = time.process_time()
        try:
            with limited(MOST_SECONDS):
                row |= followed(contact, self.seed, self.axis, self.halvings) | {"failure": ""}
        except (lubfric.LubfricError, FloatingPointError, np.linalg.LinAlgError) as error:
            row["failure"] = f"{type(error).__name__}: {error}".replace("\n", " ")[:120]
        return row | {"seconds": time.process_time() - begun}


def jobs_left(halvings: int, seeds: int, numbers: Sequence[int], file: Path) -> list[CellJob]:
    """Return what the table has not, the longest cells first: so many ``halvings`` of the cells of `cases`, and one of
    both axes of the random contacts of these ``numbers``. Along y the longest cells are twice those of an answer."""
    known = {(row["contact"], row["seed"], row["axis"], row["halvings"]) for row in table_file.rows(file)}
    levels = [
        ("y", -1),
        *((axis, count) for count in range(halvings + 1) for axis in "xy" if count <= HALVINGS[axis]["xy".index(axis)]),
    ]
    jobs = [CellJob(name, seed, *level) for seed in range(seeds) for level in levels for name in cases()]
    jobs += [CellJob(f"random {number}", 0, "xy", count) for number in numbers for count in (-1, 0, 1)]
    return [job for job in jobs if (job.name, str(job.seed), job.axis, str(job.halvings)) not in known]


def extend(jobs: Sequence[CellJob], seconds: float, file: Path = TABLE, workers: int = 1) -> Iterator[PlainRow]:
    """Solve ``jobs`` in so many processes for so many ``seconds``, and append each row as it is solved."""
    for row in extending.solved_in_processes(jobs, seconds, workers):
        table_file.append(file, COLUMNS, row, DIGITS)
        yield row


def errors(file: Path = TABLE) -> Iterator[PlainRow]:
    """Yield of each strip and axis the error of f on the cells of an answer, relative, the ``expected`` one, by which f
    is corrected, what this has ``left``, and what the answer states for it.

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
        cells = cells_of(rows, axis)
        yield {
            "contact": contact,
            "seed": seed,
            "axis": axis,
            "lengths": len(f),
            "f": f[0],
            "limit": limit,
            "error": f[0] / limit - 1,
            "order": math.log2(seen) if seen > 0 else math.nan,
            "expected": -cells.change,
            "left": 1 - limit / (f[0] * (1 + cells.change)),
            "stated": cells.error,
        }


def cells_of(rows: dict[int, dict[str, str]], axis: str) -> CellsInMotion:
    """Return the cells of an answer along ``axis``, of the ``rows`` of one strip by their halvings; as if those along
    the other one were short."""
    row = rows[0]
    f = float(row["f"])
    contact = contact_of(row["contact"])
    length = contact.scene.surface.correlation_length
    assert isinstance(length, float)  # the contacts of this campaign are isotropic
    cell = float(row["coarse"]) * length
    return CellsInMotion(
        film_ratio=float(row["twice"]) / float(row["half"]),
        coarse_x=float(row["coarse"]) if "x" in axis else 0.0,
        coarse_y=float(row["coarse_y"] or row["coarse"]) if "y" in axis else 0.0,
        coarse_b=cell / film_half_width(contact.scene.line_contact(contact.speed)) if "x" in axis else 0.0,
        by_longer=abs(1.0 - float(rows[-1]["f"]) / f) if -1 in rows else 0.0,
        follows_lubricant=row["follows"] == "1",
        is_smooth=contact.scene.surface.acf != "exponential",
    )


def contact_of(name: str) -> RollingContact:
    """Return the contact of this ``name``: one of `cases`, or a random one."""
    return cases()[name] if name in cases() else contact_named(name)
