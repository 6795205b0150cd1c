"""Maps of load sharing: film over roughness, roughness from 1 nm to 2 µm, share of the contact, entrainment of any
sign.

The check solves the balance of load and volume again (`verification.campaigns.hostile.soak_judge`). The friction
coefficient and F_C/F_T may differ by twice the tolerance of the scene (1 %).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

import lubfric
from lubfric.models.shared import Prepared

from ...fem.parts import case_of_scene, halved
from ..hostile.soak_judge import verdict
from .cell import Cell


@dataclass(frozen=True, kw_only=True)
class SharingCell:
    """A built-in scene with roughness [m] on a small grid, at one speed [m/s]: the given one, that of a smooth film
    [m], or that at which the contact carries a share of the load (by so many halvings)."""

    scene: str
    sq: float
    shape: int
    speed: float = 0.0
    film: float = 0.0
    share: float = 0.0
    halvings: int = 0


@lru_cache(maxsize=4)
def model_of(name: str, sq: float, shape: int) -> Prepared:
    """Return the prepared scene. Any slope is accepted, because the solver is what is tried."""
    if name == "flat":
        roughness = {"sq": sq, "correlation_length": 0.08e-6 * shape}
        grid = {"shape": (shape, shape), "spacing": 1e-6}
    else:
        roughness = {"sq": sq, "correlation_length": 9e-6 * 32 / shape if shape < 48 else 4e-6}
        grid = {"shape": (shape, shape // 2), "spacing": 90e-6 / shape}
    numerics = {"model": "paper", "sampling": "patch", "accept": True}
    return lubfric.prepare(lubfric.load_scene(name).with_(surface=roughness, contact=grid, numerics=numerics))


def solve(cell: Cell[SharingCell]) -> tuple[Prepared, lubfric.FrictionResult]:
    """Return the prepared scene, and the result of `lubfric.friction` at the speed of the cell."""
    p = cell.problem
    model = model_of(p.scene, p.sq, p.shape)
    speed = p.speed
    if p.film:
        load = model.scene.bodies.load

        def below(u: float) -> bool:
            return lubfric.solve_ehl(**case_of_scene(model.scene, load, u), tolerance=0.05).central_film < p.film

        speed = halved(1e-12, 1e4, below, 14)
    elif p.share:
        carried = p.share * model.scene.bodies.load
        speed = halved(1e-14, 1e2, lambda u: lubfric.friction(model, u).contact_load > carried, p.halvings)
    return model, lubfric.friction(model, speed)


def deviations(cell: Cell[SharingCell], solved: tuple[Prepared, lubfric.FrictionResult]) -> dict[str, float]:
    """Return the imbalances of the result, and the deviations of friction and asperity load from the check, over the
    allowed ones."""
    return verdict(*solved)


def cells(*, quick: bool) -> Iterator[Cell[SharingCell]]:
    """All load-sharing cells: film over roughness from 0.01 to 10 by roughness; nearly all film, nearly all contact, no
    entrainment and reversed entrainment; F_C/F_T from 1e-6 to 1 - 1e-6."""
    for name in ("flat", "paper"):
        shape = 64 if name == "flat" else 48
        if quick:
            shape = 32
        for sq in [1e-7] if quick else np.geomspace(1e-9, 2e-6, 5).tolist():
            for ratio in np.geomspace(0.01, 10, 3 if quick else 10).tolist():
                problem = SharingCell(scene=name, sq=sq, shape=shape, film=ratio * sq)
                yield Cell(map=f"sharing: {name}", panel="lambda by roughness", x=ratio, y=sq, problem=problem)
    some = np.geomspace(1e-10, 30, 12).tolist()
    tiny = (1e-6, 1e-5, 1e-4, 1e-3, 1e-2)
    shares = (0.5,) if quick else (*tiny, 0.1, 0.5, 0.9, *(1 - t for t in reversed(tiny)))
    for column, name in enumerate(("flat", "paper")):
        shape = 32 if quick else 64
        for speed in (0.0, -0.01, 0.01) if quick else (0.0, *some, *(-u for u in some)):
            yield Cell(
                map="sharing: speed, either sign",
                panel=name,
                x=speed,
                y=column,
                problem=SharingCell(scene=name, sq=1e-7, shape=shape, speed=speed),
            )
        for share in shares:
            problem = SharingCell(scene=name, sq=1e-7, shape=shape, share=share, halvings=16 if quick else 40)
            yield Cell(map="sharing: share of the contact", panel=name, x=share, y=0.0, problem=problem)
