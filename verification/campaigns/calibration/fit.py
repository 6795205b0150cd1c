"""The error model of calibrated load sharing, fitted to the tables: calibration.toml of lubfric."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import minimize

import lubfric
from lubfric.models.load_sharing.calibrated import numbers_of

from .case import drawn
from .features import quick
from .table import TABLES, as_text, rows

HOME = Path(lubfric.__path__[0]) / "models/load_sharing/calibration.toml"
SPREAD = {"rest": ("one", "contrast", "contact"), "rolling": ("one", "contrast", "contact", "slight")}
FREEDOM = 6.0  # of Student's t in the likelihood, so that single cases far off count little
CONFIDENCE = 0.95
LEAST_SLIP = 0.003  # slide-roll ratio of a rolling case that counts: below, f is a small difference
QUARTERS = 4  # kinds of load, and of slide-roll ratio
EDGES = (0.01, 0.99)  # quantiles of the cases: the range of the campaign


@dataclass(frozen=True)
class Solved:
    """One case: its row as text, the numbers of `quick`, and ln(f deterministic/f)."""

    row: dict[str, str]
    numbers: dict[str, float]
    error: float

    @property
    def features(self) -> dict[str, float]:
        """What σ may depend on."""
        n = self.numbers
        rolling = n["rolling"] / n["coefficient"]
        return numbers_of(
            n["coefficient"], n["asperity"], float(self.row["friction"]), n["contact"], rolling, float(self.row["slip"])
        )


def cases(motion: str, folder: Path = TABLES) -> Iterator[Solved]:
    """Yield the solved cases of the table of a ``motion``, with the numbers of `quick` on today's code."""
    for row in rows(motion, folder):
        if row["failure"] or (motion == "rolling" and abs(float(row["slip"])) < LEAST_SLIP):
            continue
        try:
            numbers = quick(drawn(motion, int(row["seed"])))
        except lubfric.LubfricError:
            continue
        f = float(row["det_f"])
        if f > 0 < numbers["coefficient"]:
            yield Solved(row, numbers, math.log(f / numbers["coefficient"]))


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


def fitted(errors: np.ndarray, features: np.ndarray) -> tuple[float, np.ndarray, float]:
    """Return the bias, the factors of ln σ and the standard error of the bias, by the likelihood of Student's t."""
    count = features.shape[1]

    def negative(theta: np.ndarray) -> float:
        log_sigma = features @ theta[1:]
        standard = (errors - theta[0]) * np.exp(-log_sigma)
        likelihood = np.sum(log_sigma + (FREEDOM + 1) / 2 * np.log1p(standard**2 / FREEDOM))
        return float(likelihood + 0.5 * np.sum(theta[2:] ** 2))

    start = np.zeros(count + 1)
    start[1] = math.log(0.1)
    best = minimize(negative, start, method="BFGS")
    return float(best.x[0]), best.x[1:], math.sqrt(float(best.hess_inv[0, 0]))


@dataclass(frozen=True)
class HeldOut:
    """A kind of case that the fit excluded: its errors over σ, and σ."""

    kind: str
    standard: np.ndarray
    sigma: np.ndarray


def held_out(solved: Sequence[Solved], names: Sequence[str]) -> list[HeldOut]:
    """Return every kind of ``solved``, each by the fit to all others."""
    errors = np.array([case.error for case in solved])
    features = np.array([[case.features[name] for name in names] for case in solved])
    results = []
    for kind, chosen in kinds(solved):
        bias, factors, error = fitted(errors[~chosen], features[~chosen])
        sigma = np.hypot(np.exp(features[chosen] @ factors), error)
        results.append(HeldOut(kind, (errors[chosen] - bias) / sigma, sigma))
    return results


def quantile_of(parts: Sequence[HeldOut]) -> float:
    """Return the quantile of the error over σ on excluded kinds, with the finite-sample correction of split conformal
    prediction."""
    values = np.sort(np.abs(np.concatenate([part.standard for part in parts])))
    place = math.ceil(CONFIDENCE * (values.size + 1)) - 1
    return float(values[min(place, values.size - 1)])


def lines(motion: str, solved: Sequence[Solved]) -> Iterator[str]:
    """Yield the section of calibration.toml of a ``motion``."""
    names = SPREAD[motion]
    errors = np.array([case.error for case in solved])
    features = np.array([[case.features[name] for name in names] for case in solved])
    bias, factors, error = fitted(errors, features)
    yield f"[{motion}]"
    yield f"cases = {len(solved)}"
    yield f"bias = {bias:.4f}"
    yield f"bias_error = {error:.4f}"
    yield f"quantile = {quantile_of(held_out(solved, names)):.3f}"
    yield "spread = { " + ", ".join(f"{name} = {factor:.4f}" for name, factor in zip(names, factors)) + " }"
    yield f"[{motion}.range]"
    for name, values in ranges(solved).items():
        low, high = (values.min(), values.max()) if name == "slip" else np.quantile(values, EDGES)
        yield f"{name} = [{as_text(float(low))}, {as_text(float(high))}]"


def ranges(solved: Sequence[Solved]) -> dict[str, np.ndarray]:
    """Return the values of the numbers whose range the result states."""
    table = {name: np.array([float(case.row[name]) for case in solved]) for name in ("pressure", "ratio", "slip")}
    modulus = np.array([float(case.row["e_prime"]) for case in solved])
    radius = np.array([float(case.row["radius"]) for case in solved])
    load = 2 * np.pi * radius * table["pressure"] ** 2 / modulus
    return {"pressure": table["pressure"], "lambda": table["ratio"], "load": load, "slip": np.abs(table["slip"])}


HEAD = """# The error of calibrated load sharing, fitted to the tables of verification/campaigns/calibration by
# python -m verification.campaigns.calibration fit: ln(f deterministic/f) has the mean `bias` and the standard deviation
# exp(sum of `spread` times features); `quantile` times it is the half-width of 95 %. Do not edit by hand.
"""


def write(folder: Path = TABLES, file: Path = HOME) -> dict[str, list[Solved]]:
    """Fit both motions and write calibration.toml; return the cases."""
    solved = {motion: list(cases(motion, folder)) for motion in ("rest", "rolling")}
    text = "\n".join(line for motion, part in solved.items() for line in (*lines(motion, part), ""))
    file.write_text(HEAD + "\n" + text, encoding="utf-8")
    return solved
