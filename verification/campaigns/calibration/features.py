"""What the quick answer knows of a case: load sharing on its map, and the rough film on top of it."""

import time
from collections.abc import Iterator
from dataclasses import asdict

import numpy as np

import lubfric
from lubfric.estimate import sampled
from lubfric.models import PaperModel, prepare
from lubfric.models.load_sharing import RoughMap, rough_film

from .case import Case

SHIFTS = 4  # places of a moving map
QUICK = {"model": "paper", "grid": "given", "heat": "off"}


def quick(case: Case) -> dict[str, float]:
    """Means of the numbers of `rough_film` on the map of ``case``, of a moving one over its places, with f of Eq. (9) as
    ``ls_f`` and its share of the load on the contact as ``ls_contact``. ``seconds_balance`` is the processor time of Eq. (9)
    at a place, ``seconds`` that with the rough film."""
    scene = case.scene.with_(numerics=QUICK)
    nx = case.surface.shape[0]
    places = range(0, nx, nx // SHIFTS) if case.facts["motion"] == "rolling" else (0,)
    numbers = list(_places(case, scene, places))
    return {name: float(np.mean([row[name] for row in numbers])) for name in numbers[0]}


def _places(case: Case, scene: lubfric.Scene, places) -> Iterator[dict[str, float]]:
    for place in places:
        begun = time.process_time()
        prepared = prepare(scene, case.widened(place))
        solution = sampled(prepared, case.speed, PaperModel()).balanced  # type: ignore[attr-defined]
        in_balance = time.process_time() - begun
        contact = solution.contact
        times = contact.heights.shape[0] // case.surface.shape[0]
        maps = [
            RoughMap(np.tile(np.roll(body.surface.heights, place, axis=0), (times, 1)), body.speed)
            for body in case.bodies
        ]
        film = rough_film(scene, case.speed, contact, solution.solved, maps)
        balance = solution.balance
        yield asdict(film) | {
            "ls_f": balance.forces.coefficient,
            "ls_contact": balance.contact_load / scene.bodies.load,
            "ls_rolling": balance.forces.shear.rolling / scene.bodies.load,
            "seconds_balance": in_balance,
            "seconds": time.process_time() - begun,
        }
