"""The error model of the quick model, fitted to the tables: calibration.toml of lubfric."""

import math
import multiprocessing
import time
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np

import lubfric
from lubfric.models.deterministic import CellsInMotion
from lubfric.models.quick import THIN_BY_FILM, features

from ...types import PlainRow
from .. import table_file
from .case import drawn
from .features import PER_LENGTH, quick
from .solve import limited
from .table import DIGITS as TABLE_DIGITS
from .table import TABLES, rows

HOME = Path(lubfric.__path__[0]) / "models/quick/calibration.toml"
MOTIONS = ("rest", "rolling")
COLUMNS_OF_CASE = ("seed", "repeat", "per_length")  # of the table of numbers: what a row is of

# Features of the bias, the mean of ln of the ratio of both sliding parts of f, by motion. Chosen by the half-width on
# kinds of cases that were left out; of features that did equally well the fewer.
BIAS = {"rest": ("one", "cells"), "rolling": ("one", "narrowed", "summits")}

# Features of ln of its standard deviation.
SPREAD = {"rest": ("one", "ln cells", "ln film", "ln below"), "rolling": ("one", "ln film", "ln rolling", "ln near")}

# What cells shorter than those of a reference at rest would still change of ln f, over what these have changed from the
# long ones: ln f moves by .17 of its change before when the cells are halved (276 cases on three lengths), .2 in all.
REMAINING = 0.2

# Slide-roll ratio up to which the mass along x is followed along the lubricant, by third order.
FAST = 1.0
# Of Student's t in the likelihood: nearly normal. Chosen by the half-width on kinds that were left out, where f hangs
# on the boundary film: 6, 12, 40 and 1000 give 21, 20, 18 and 17 %, and as many of these cases are inside (97 %).
FREEDOM = 100.0
PRIOR = 2.0  # inverse variance of the normal prior of the coefficients of the bias, about 0
SPREAD_PRIOR = 0.25  # the same of the coefficients of ln σ, but the first
FREE_PRIOR = 1e-3  # the same of the first, which is free
START = math.log(0.1)  # of ln σ
LONGEST = 0.7  # step of a coefficient of ln σ
STEPS = 40  # of Newton's method for ln σ
ROUNDS = 40  # of bias and σ in turn
CLOSE = 1e-6  # change of a coefficient after which the fit ends
CONFIDENCE = 0.95  # of the interval that the fit is made for
QUARTERS = 4  # kinds of load, and of slide-roll ratio
EDGES = (0.005, 0.995)  # quantiles of the cases: the range of the campaign
USUAL = 0.9  # quantile of the half-widths: an error that nine cases in ten do not exceed. A convention
ROLLING = 0.95  # quantile of the error of the part of f by the gradient of the pressure
DIGITS = 10  # of the numbers of `quick` in their table
LONGEST_CASE = 60.0  # s: processor time of a case on long cells, at most


@dataclass(frozen=True)
class Solved:
    """One case: its row as text, the numbers of `quick`, and ln of the sliding part of f over that on long cells;
    ``left``: the part of it that the cells of the reference leave."""

    row: dict[str, str]
    numbers: dict[str, float]
    error: float
    left: float

    @property
    def reference_error(self) -> float:
        """The error of ln f of the reference by its cells, at 95 %; 0 where roughness rests, where ``left`` tells
        it."""
        return cells_of_reference(self.row).error if self.row["motion"] == "rolling" else 0.0

    @property
    def features(self) -> dict[str, float]:
        """What bias and σ may depend on."""
        return features(self.numbers, float(self.row["friction"]))


def numbers_file(motion: str, folder: Path = TABLES) -> Path:
    """Return the file with the numbers of `quick` of the cases of a ``motion``."""
    return folder / f"{motion}-long-cells.csv"


def key(row: Mapping[str, object]) -> tuple[int, int]:
    """Return what a case has for itself in the tables of its motion."""
    return int(str(row["seed"])), int(str(row["repeat"]))


def cases(motion: str, folder: Path = TABLES) -> list[Solved]:
    """Return the solved cases of the table of a ``motion``, with the numbers of `quick` from their table."""
    known: dict[tuple[int, int], list[dict[str, float]]] = {}
    for row in table_file.rows(numbers_file(motion, folder)):
        numbers = {name: float(text) for name, text in row.items() if name not in ("seed", "repeat")}
        known.setdefault(key(row), []).append(numbers)
    solved = (solved_case(row, known[key(row)]) for row in usable(motion, folder) if key(row) in known)
    return [case for case in solved if case is not None]


def usable(motion: str, folder: Path = TABLES) -> Iterator[dict[str, str]]:
    """Yield the rows of a ``motion`` that were solved."""
    yield from (row for row in rows(motion, folder) if not row["failure"])


def solved_case(row: dict[str, str], known: Sequence[dict[str, float]]) -> Solved | None:
    """Return the case of a ``row`` with the numbers of `quick` on the cells that the model takes, of those that are
    ``known``; None where it is not among them, or a sliding part of f is not positive.

    What the cells of the reference would still change is taken of its change from the longest cells, where the
    roughness rests, and where it moves that which the deterministic model expects (`CellsInMotion`).
    """
    by_cells = {numbers["per_length"]: numbers for numbers in known}
    lengths = PER_LENGTH[row["motion"]]
    longest = by_cells.get(lengths[0])
    if longest is None:
        return None
    numbers = by_cells.get(lengths[-1]) if longest["film_at_rest"] > THIN_BY_FILM else longest
    if numbers is None:
        return None
    reference = float(row["det_f"]) - float(row["det_rolling"])
    before, sliding = (each["coefficient"] - each["rolling"] for each in (longest, numbers))
    if not min(reference, before, sliding) > 0:
        return None
    if row["motion"] == "rolling":
        left = math.log1p(cells_of_reference(row).change)
    else:
        left = REMAINING * math.log(reference / before)
    return Solved(row, numbers, math.log(reference / sliding) + left, left)


def cells_of_reference(row: dict[str, str]) -> CellsInMotion:
    """Return what is known of the cells of the reference of a ``row`` whose roughness moves."""
    (half, twice) = (float(row[f"det_{name}_film"]) for name in ("half", "twice"))
    half_width = 4 * float(row["radius"]) * float(row["pressure"]) / float(row["e_prime"])
    return CellsInMotion.on_cells(
        (float(row["dx"]), float(row["dy"])),
        lengths=(float(row["length_x"]), float(row["length_y"])),
        half_width=half_width,
        film_ratio=twice / half,
        follows_lubricant=abs(float(row["slip"])) <= FAST,
        is_smooth=row["acf"] == "gaussian",
    )


def solve_numbers(file: Path, motion: str, *, workers: int = 1, seconds: float = math.inf) -> None:
    """Solve the usable cases of a ``motion`` that are missing in the table of numbers in ``file`` on long cells by
    today's model, on so many ``workers``, and append each when it is solved; after so many ``seconds`` none is
    begun."""
    begun = time.monotonic()
    known = {(*key(row), float(row["per_length"])) for row in table_file.rows(file)}
    cases = [(*key(row), cells) for row in usable(motion) for cells in PER_LENGTH[motion]]
    missing = iter([case for case in cases if case not in known])
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, mp_context=context) as pool:
        running = {pool.submit(numbers_of_case, motion, case) for case in islice(missing, workers)}
        while running:
            ended, running = wait(running, return_when=FIRST_COMPLETED)
            for future in ended:
                if row := future.result():
                    table_file.append(file, list(row), row, DIGITS)
                if time.monotonic() - begun < seconds and (case := next(missing, None)):
                    running.add(pool.submit(numbers_of_case, motion, case))


def numbers_of_case(motion: str, case: tuple[int, int, float]) -> PlainRow:
    """Return the row of a ``case``: its seed, its repeat, and the cells along x in a correlation length; {} where it
    has no solution."""
    (seed, repeat, per_length) = case
    try:
        with limited(LONGEST_CASE):
            numbers = quick(drawn(motion, seed, repeat), per_length)
    except (lubfric.LubfricError, FloatingPointError):
        return {}
    return dict(zip(COLUMNS_OF_CASE, case)) | numbers


def kinds(solved: Sequence[Solved]) -> Iterator[tuple[str, np.ndarray]]:
    """Yield the name of each kind of case, and which of ``solved`` are of it."""
    names = ["fluid", "lay"]
    for name in names:
        words = np.array([case.row[name] for case in solved])
        yield from ((f"{name} {word}", words == word) for word in sorted(set(words)))
    numbers = {"pressure": "load"}
    if solved[0].row["motion"] == "rolling":
        numbers["slip"] = "slide-roll ratio"
    for name, label in numbers.items():
        values = np.array([float(case.row[name]) for case in solved])
        edges = np.quantile(values, np.linspace(0, 1, QUARTERS + 1))
        place = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, QUARTERS - 1)
        yield from ((f"{label}, quarter {k + 1}", place == k) for k in range(QUARTERS))


@dataclass(frozen=True)
class Fit:
    """Coefficients of the bias with their ``covariance``, and of ln σ."""

    bias: np.ndarray
    covariance: np.ndarray
    spread: np.ndarray

    def sigma(self, of_bias: np.ndarray, of_spread: np.ndarray) -> np.ndarray:
        """Return the standard deviation of new cases with these features, that of the bias included."""
        of_coefficients = np.einsum("ij,jk,ik->i", of_bias, self.covariance, of_bias)
        return np.sqrt(np.exp(2 * of_spread @ self.spread) + of_coefficients)


def fitted(errors: np.ndarray, of_bias: np.ndarray, of_spread: np.ndarray) -> Fit:
    """Return the fit to ``errors`` with these features, by the likelihood of Student's t: bias and σ in turn."""
    bias = np.zeros(of_bias.shape[1])
    spread = np.zeros(of_spread.shape[1])
    spread[0] = START
    prior = PRIOR * np.eye(bias.size)
    for _ in range(ROUNDS):
        spread = _spread(errors - of_bias @ bias, of_spread, spread)
        sigma = np.exp(of_spread @ spread)
        standard = (errors - of_bias @ bias) / sigma
        weight = (FREEDOM + 1) / (FREEDOM + standard**2) / sigma**2
        new = np.linalg.solve(of_bias.T @ (of_bias * weight[:, None]) + prior, of_bias.T @ (weight * errors))
        change = float(np.abs(new - bias).max())
        bias = new
        if change < CLOSE:
            break
    information = (FREEDOM + 1) / (FREEDOM + 3) / sigma**2  # of the mean of Student's t
    covariance = np.linalg.inv(of_bias.T @ (of_bias * information[:, None]) + prior)
    return Fit(bias, covariance, spread)


def _spread(residuals: np.ndarray, of_spread: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Return the coefficients of ln σ by Newton's method."""
    prior = np.full(start.size, SPREAD_PRIOR)
    prior[0] = FREE_PRIOR
    centre = np.zeros(start.size)
    centre[0] = START
    spread = start
    for _ in range(STEPS):
        square = (residuals * np.exp(-of_spread @ spread)) ** 2
        slope = 1 - (FREEDOM + 1) * square / (FREEDOM + square)
        curvature = 2 * FREEDOM * (FREEDOM + 1) * square / (FREEDOM + square) ** 2
        gradient = of_spread.T @ slope + prior * (spread - centre)
        hessian = of_spread.T @ (of_spread * curvature[:, None]) + np.diag(prior)
        step = np.clip(np.linalg.solve(hessian, gradient), -LONGEST, LONGEST)
        spread = spread - step
        if float(np.abs(step).max()) < CLOSE:
            break
    return spread


@dataclass(frozen=True)
class Design:
    """The ``errors`` of cases and their features, of the bias and of ln σ."""

    errors: np.ndarray
    of_bias: np.ndarray
    of_spread: np.ndarray

    def fit(self, chosen: np.ndarray | slice = slice(None)) -> Fit:
        """Return the fit to the ``chosen`` cases."""
        return fitted(self.errors[chosen], self.of_bias[chosen], self.of_spread[chosen])


def design(solved: Sequence[Solved]) -> Design:
    """Return what the error model of ``solved``, cases of one motion, is fitted to."""
    motion = solved[0].row["motion"]
    values = [case.features for case in solved]
    of_bias, of_spread = (np.array([[x[name] for name in names[motion]] for x in values]) for names in (BIAS, SPREAD))
    return Design(np.array([case.error for case in solved]), of_bias, of_spread)


@dataclass(frozen=True)
class HeldOut:
    """A kind of case that was left out of the fit: its errors over σ, σ, and the errors of their references by
    cells."""

    kind: str
    standard: np.ndarray
    sigma: np.ndarray
    references: np.ndarray

    def half_widths(self, quantile: float) -> np.ndarray:
        """Return the half-widths of the bounds of f, relative, with this ``quantile`` of the errors over σ."""
        return np.sinh(np.hypot(quantile * self.sigma, self.references))


def held_out(solved: Sequence[Solved], known: Design) -> list[HeldOut]:
    """Return every kind of ``solved``, each by the fit to all others."""
    results = []
    references = np.array([case.reference_error for case in solved])
    for kind, chosen in kinds(solved):
        fit = known.fit(~chosen)
        sigma = fit.sigma(known.of_bias[chosen], known.of_spread[chosen])
        standard = (known.errors[chosen] - known.of_bias[chosen] @ fit.bias) / sigma
        results.append(HeldOut(kind, standard, sigma, references[chosen]))
    return results


def quantile_of(parts: Sequence[HeldOut]) -> float:
    """Return the quantile of the error over σ on kinds that were left out, with the finite-sample correction of split
    conformal prediction."""
    values = np.sort(np.abs(np.concatenate([part.standard for part in parts])))
    place = math.ceil(CONFIDENCE * (values.size + 1)) - 1
    return float(values[min(place, values.size - 1)])


def usual_error(parts: Sequence[HeldOut], quantile: float) -> float:
    """Return the half-width of the bounds of f that `USUAL` of the cases do not exceed, with this ``quantile`` of the
    errors over σ."""
    return float(np.quantile(np.concatenate([part.half_widths(quantile) for part in parts]), USUAL))


def lines(motion: str, solved: Sequence[Solved]) -> Iterator[str]:
    """Yield the section of calibration.toml of a ``motion``."""
    known = design(solved)
    fit = known.fit()
    covariance = ", ".join("[" + ", ".join(f"{value:.3e}" for value in row) + "]" for row in fit.covariance)
    yield f"[{motion}]"
    yield f"cases = {len(solved)}"
    parts = held_out(solved, known)
    quantile = quantile_of(parts)
    yield f"quantile = {quantile:.3f}"
    yield f"usual_error = {usual_error(parts, quantile):.2f}"
    yield f"rolling = {np.quantile(rolling_errors(solved), ROLLING):.3f}"
    yield f"bias = {_table(BIAS[motion], fit.bias)}"
    yield f"covariance = [{covariance}]"
    yield f"spread = {_table(SPREAD[motion], fit.spread)}"
    yield f"[{motion}.range]"
    for name, values in ranges(solved).items():
        low, high = (values.min(), values.max()) if name == "slip" else np.quantile(values, EDGES)
        yield f"{name} = [{float(low):.{TABLE_DIGITS}g}, {float(high):.{TABLE_DIGITS}g}]"


def rolling_errors(solved: Sequence[Solved]) -> np.ndarray:
    """Return the errors of the part of f by the gradient of the pressure, over the square root of that part times the
    sum of both parts."""
    parts = [
        (float(case.row["det_rolling"]), case.numbers["rolling"], case.numbers["coefficient"] - case.numbers["rolling"])
        for case in solved
    ]
    (reference, rolling, sliding) = np.array(parts).T
    return np.abs(reference - rolling) / np.sqrt(np.abs(rolling) * (np.abs(rolling) + np.abs(sliding)))


def _table(names: Sequence[str], factors: np.ndarray) -> str:
    return "{ " + ", ".join(f'"{name}" = {factor:.4f}' for name, factor in zip(names, factors)) + " }"


def ranges(solved: Sequence[Solved]) -> dict[str, np.ndarray]:
    """Return the values of the numbers whose range the result states."""
    table = {name: np.array([float(case.row[name]) for case in solved]) for name in ("pressure", "ratio", "slip")}
    modulus = np.array([float(case.row["e_prime"]) for case in solved])
    radius = np.array([float(case.row["radius"]) for case in solved])
    load = 2 * np.pi * radius * table["pressure"] ** 2 / modulus
    return {"pressure": table["pressure"], "moes_ratio": table["ratio"], "load": load, "slip": np.abs(table["slip"])}


HEAD = """# The error of f on long cells, fitted to the tables of verification/campaigns/calibration by
# python -m verification.campaigns.calibration fit: ln of the ratio of the sliding parts of f has the mean `bias` times
# features, whose coefficients have the `covariance`, and the standard deviation exp(`spread` times features);
# `quantile` times both together is the half-width of 95 % (lubfric/models/quick/calibrated_error.py). `usual_error`:
# that of f which nine cases in ten do not exceed. `rolling`: the relative error of the other part of f, at 95 %. Do not
# edit by hand.
"""


def text_of(folder: Path = TABLES) -> str:
    """Return calibration.toml by the tables in ``folder``."""
    return HEAD + "\n" + "\n".join(line for motion in MOTIONS for line in (*lines(motion, cases(motion, folder)), ""))


def write(folder: Path = TABLES, file: Path = HOME) -> None:
    """Fit both motions and write calibration.toml."""
    file.write_text(text_of(folder), encoding="utf-8")
