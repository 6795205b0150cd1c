"""The table of solved cases: parts in CSV, which a run extends."""

import csv
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from .case import MOTIONS, drawn
from .solve import solved

TABLES = Path(__file__).parent / "tables"
DIGITS = 6  # of a number in the table
SECONDS = {"rest": 25.0, "rolling": 25.0}  # processor time of a case, at most


def rows(motion: str, folder: Path = TABLES) -> Iterator[dict[str, str]]:
    """The rows of a ``motion`` as text, failed ones among them."""
    file = folder / f"{motion}.csv"
    if file.is_file():
        with file.open(newline="") as stream:
            yield from csv.DictReader(stream)


def extend(motion: str, count: int, budget: float, folder: Path = TABLES, first: int = 0) -> Iterator[dict[str, Any]]:
    """Solve the cases from ``first`` to below number ``count`` that are missing in the table of ``motion``, as long as
    the time of this process is below ``budget`` [s], and append each when it is solved."""
    assert motion in MOTIONS
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{motion}.csv"
    known = {int(row["seed"]) for row in rows(motion, folder)}
    names = list(COLUMNS)
    for seed in range(first, count):
        if seed in known:
            continue
        if time.process_time() > budget:
            return
        row = solved(drawn(motion, seed), SECONDS[motion])
        new = not file.is_file()
        with file.open("a", newline="") as stream:
            writer = csv.DictWriter(stream, names)
            if new:
                writer.writeheader()
            writer.writerow({name: as_text(row.get(name, "")) for name in names})
        yield row


def as_text(value: Any) -> Any:
    """A number with `DIGITS` digits; None as an empty cell."""
    if isinstance(value, float):
        return f"{value:.{DIGITS}g}"
    return "" if value is None else value


COLUMNS = (
    *("motion", "seed", "fluid", "lay", "acf", "radius", "e_prime", "pressure", "sq", "length_x", "length_y"),
    *("friction", "ratio", "slip", "rough", "hardness", "viscosity", "alpha", "eyring", "limit", "speed"),
    *("dx", "dy", "nx", "ny", "map_seed", "map_skewness", "map_kurtosis", "map_slope_x", "map_slope_y"),
    *("ls_f", "ls_contact", "ls_boundary", "ls_couette", "ls_rolling", "ls_lambda", "ls_film", "ls_min_film"),
    *("ls_gap", "ls_area", "ls_plastic", "ls_steepness", "ls_clearance", "ls_sampling", "ls_numerical", "ls_model"),
    *("det_f", "det_f_rest", "det_f_coarse", "det_half_film", "det_twice_film", "det_touching", "det_thin"),
    *("det_capped", "det_boundary", "det_couette", "det_rolling", "det_gap", "det_central", "det_min_gap"),
    *("det_top_pressure", "det_drawn", "det_work", "ls_seconds", "seconds", "failure"),
)
