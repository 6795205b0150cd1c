"""One case solved by load sharing and by the deterministic model: a row of the table."""

import math
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType

import numpy as np

import lubfric
from lubfric.models.deterministic import DeterministicResult, StripSolution, solve_moving_strip, solve_strip

from ...types import PlainRow
from .case import Case

SHIFTS = 4  # places of a moving map at which load sharing is solved
COARSE = 2  # cells of the first deterministic solution at rest over those of the second


class TooLong(lubfric.LubfricError):
    """A case takes more processor time than it may."""


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise `TooLong` in the block after so many ``seconds`` of processor time."""

    def stop(number: int, frame: FrameType | None) -> None:
        raise TooLong(f"more than {seconds:g} s of processor time")

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


def solved(case: Case, seconds: float) -> PlainRow:
    """Return the row of ``case``; where a model has no answer within so many ``seconds`` of processor time, ``failure``
    says why."""
    row = case.facts | {f"map_{name}": value for name, value in map_facts(case).items()}
    begun = time.process_time()
    try:
        with limited(seconds):
            row |= {f"ls_{name}": value for name, value in load_sharing(case).items()}
            row["ls_seconds"] = time.process_time() - begun
            row |= {f"det_{name}": value for name, value in deterministic(case).items()}
            row["failure"] = ""
    except (lubfric.LubfricError, FloatingPointError, ValueError, np.linalg.LinAlgError) as error:
        row["failure"] = f"{type(error).__name__}: {error}".replace("\n", " ")[:160]
    return row | {"seconds": time.process_time() - begun}


def map_facts(case: Case) -> dict[str, float]:
    """Return statistics of the sum of the maps: skewness, kurtosis, and root-mean-square slopes along x and y."""
    surface = case.surface
    z = surface.heights - surface.heights.mean()
    sq = z.std()
    (dx, dy) = surface.spacing
    along, across = (float(np.sqrt(np.mean((np.roll(z, -1, k) - z) ** 2))) / d for k, d in enumerate((dx, dy)))
    skew = float(np.mean(z**3) / sq**3)
    return {"skewness": skew, "kurtosis": float(np.mean(z**4) / sq**4), "slope_x": along, "slope_y": across}


def load_sharing(case: Case) -> dict[str, float]:
    """Return means of the numbers of load sharing, of a moving map over its places."""
    scene = case.scene.with_(numerics={"model": "paper"})
    nx = case.surface.shape[0]
    shifts = range(0, nx, nx // SHIFTS) if case.facts["motion"] == "rolling" else (0,)
    rows = []
    for shift in shifts:
        result = lubfric.friction(lubfric.prepare(scene, case.widened(shift)), case.speed, raise_on_failure=False)
        load = scene.bodies.load
        rows.append(
            {
                "f": result.coefficient,
                "contact": result.contact_load / load,
                "boundary": result.boundary_force / load,
                "couette": result.couette_force / load,
                "rolling": result.rolling_force / load,
                "lambda": result.film_to_roughness_ratio,
                "film": result.central_film,
                "min_film": result.min_film,
                "gap": result.mean_gap,
                "area": result.real_contact_area_fraction,
                "plastic": result.plastic_area_fraction,
                "steepness": result.steepness,
                "clearance": result.clearance,
                "sampling": result.uncertainty.sampling,
                "numerical": result.uncertainty.numerical,
                "model": result.uncertainty.model,
            }
        )
    return {name: float(np.mean([row[name] for row in rows])) for name in rows[0]}


def deterministic(case: Case) -> dict[str, float]:
    """Return the numbers of the deterministic model on the same map."""
    scene = case.scene
    if case.facts["motion"] == "rolling":
        moving = solve_moving_strip(scene, case.bodies, case.speed)
        at_rest = moving.rest.result.coefficient
        return numbers(moving.result) | {"f_rest": at_rest, "f_coarse": math.nan, "work": moving.work}
    first: StripSolution | None = None
    with suppress(lubfric.ConvergenceError):
        first = solve_strip(scene, case.surface, case.speed, map_coarsening=(COARSE, COARSE))
    strip = solve_strip(scene, case.surface, case.speed, start=first)
    coarse = math.nan if first is None else first.result.coefficient
    work = strip.work + (0.0 if first is None else first.work)
    return numbers(strip.result) | {"f_rest": strip.result.coefficient, "f_coarse": coarse, "work": work}


def numbers(result: DeterministicResult) -> dict[str, float]:
    """Return the numbers of one solution that the table keeps."""
    load = result.load
    return {
        "f": result.coefficient,
        "half_film": result.at_half_film,
        "twice_film": result.at_twice_film,
        "touching": result.split.touching / load,
        "thin": result.split.thin / load,
        "capped": result.split.capped / load,
        "boundary": result.boundary / load,
        "couette": result.couette / load,
        "rolling": result.rolling / load,
        "gap": result.mean_gap,
        "central": result.central_gap,
        "min_gap": result.min_gap,
        "top_pressure": result.top_pressure,
        "drawn": result.share_given_off,
    }
