"""The table of solved cases in CSV, which a run extends."""

import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from ...types import PlainRow
from .. import table_file
from .case import MOTIONS, drawn
from .solve import solved

TABLES = Path(__file__).parent / "tables"
DIGITS = 6  # of a number in the table
SECONDS = {"rest": 60.0, "rolling": 60.0}  # processor time of a case, at most


def table_of(motion: str, folder: Path = TABLES) -> Path:
    """Return the file with the solved cases of a ``motion``."""
    return folder / f"{motion}.csv"


def rows(motion: str, folder: Path = TABLES) -> list[dict[str, str]]:
    """Return the rows of a ``motion`` as text, failed ones among them."""
    return table_file.rows(table_of(motion, folder))


def to_repeat(motion: str, folder: Path = TABLES) -> list[int]:
    """Return the numbers of the solved cases of ``motion``, in a random order that is always the same: any first part
    of it is a random sample."""
    seeds = sorted(int(row["seed"]) for row in rows(motion, folder) if not row["failure"] and row["repeat"] == "0")
    return [int(seed) for seed in np.random.default_rng(46).permutation(seeds)]


def extend(
    motion: str, seeds: Sequence[int], budget: float, folder: Path = TABLES, repeat: int = 0
) -> Iterator[PlainRow]:
    """Solve the cases of these ``seeds``, or their ``repeat``, that are missing in the table of ``motion``, as long as
    the time of this process is below ``budget`` [s], and append each when it is solved."""
    assert motion in MOTIONS
    folder.mkdir(parents=True, exist_ok=True)
    known = {(int(row["seed"]), int(row["repeat"])) for row in rows(motion, folder)}
    for seed in seeds:
        if (seed, repeat) in known:
            continue
        if time.process_time() > budget:
            return
        row = solved(drawn(motion, seed, repeat), SECONDS[motion])
        table_file.append(table_of(motion, folder), COLUMNS, row, DIGITS)
        yield row


COLUMNS = (
    *("motion", "seed", "repeat", "fluid", "lay", "acf", "radius", "e_prime", "pressure", "sq", "length_x"),
    *("length_y", "friction", "ratio", "slip", "rough", "hardness", "viscosity", "alpha", "eyring", "limit", "speed"),
    *("dx", "dy", "nx", "ny", "map_seed", "map_skewness", "map_kurtosis", "map_slope_x", "map_slope_y"),
    *("ls_f", "ls_contact", "ls_boundary", "ls_couette", "ls_rolling", "ls_lambda", "ls_film", "ls_min_film"),
    *("ls_gap", "ls_area", "ls_plastic", "ls_steepness", "ls_clearance", "ls_sampling", "ls_numerical", "ls_model"),
    *("det_f", "det_f_rest", "det_f_coarse", "det_half_film", "det_twice_film", "det_touching", "det_thin"),
    *("det_capped", "det_boundary", "det_couette", "det_rolling", "det_gap", "det_central", "det_min_gap"),
    *("det_top_pressure", "det_drawn", "det_work", "ls_seconds", "seconds", "failure"),
)
