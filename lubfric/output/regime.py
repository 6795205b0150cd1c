"""The lubrication regime in words: boundary, mixed or full-film lubrication."""

import math
from collections.abc import Iterable
from enum import StrEnum

from ..models.shared import numbers_in_words

# Asperity load ratio up to which the film carries the load: full-film lubrication. A convention.
FULL_FILM_PART = 0.01

# Asperity load ratio from which the film carries next to nothing: boundary lubrication. A convention.
BOUNDARY_PART = 0.9

# Lambda ratio below which a film near the height of the highest summit does not exclude that asperities carry load: the
# usual limit of full-film lubrication (Hamrock, Schmid, Jacobson: Fundamentals of Fluid Film Lubrication, 2004).
FULL_FILM_LAMBDA = 3.0

# Lambda ratio below which lubrication is usually called boundary lubrication (Hamrock, Schmid, Jacobson 2004).
BOUNDARY_LAMBDA = 1.0

# What f leaves out where asperities touch.
NO_WEAR = "Wear and scuffing, which may occur there, are not modelled."


class Regime(StrEnum):
    """A lubrication regime, by what it is called."""

    BOUNDARY = "boundary lubrication"
    MIXED = "mixed lubrication"
    FULL_FILM = "full-film lubrication"


def regime_of(asperity_load_ratio: float) -> Regime | None:
    """Return the lubrication regime at an asperity load ratio; None where that is not known."""
    if math.isnan(asperity_load_ratio):
        return None
    if asperity_load_ratio >= BOUNDARY_PART:
        return Regime.BOUNDARY
    return Regime.FULL_FILM if asperity_load_ratio <= FULL_FILM_PART else Regime.MIXED


def regime_of_lambda(lambda_ratio: float) -> Regime | None:
    """Return the regime that a lambda ratio is usually taken for; None where that is not known."""
    if math.isnan(lambda_ratio):
        return None
    if lambda_ratio < BOUNDARY_LAMBDA:
        return Regime.BOUNDARY
    return Regime.FULL_FILM if lambda_ratio >= FULL_FILM_LAMBDA else Regime.MIXED


def regime_in_words(asperity_load_ratio: float, lambda_ratio: float) -> list[str]:
    """Return the lubrication regime of a point in sentences, what its lambda ratio alone would say if that differs, and
    that wear is not modelled; none where the loads are not known."""
    regime = regime_of(asperity_load_ratio)
    if regime is None:
        return []
    usual = regime_of_lambda(lambda_ratio)
    by_lambda = f", the lambda ratio {lambda_ratio:.3g}" if usual is not None else ""
    if usual not in (None, regime):
        by_lambda = f"; its lambda ratio of {lambda_ratio:.3g} alone would be taken for {usual}"
    text = f"This is {regime}: the asperity load ratio is {asperity_load_ratio:.2g}{by_lambda}."
    return [text if regime is Regime.FULL_FILM else f"{text} {NO_WEAR}"]


def regimes_in_words(asperity_load_ratios: Iterable[float]) -> list[str]:
    """Return at which points of a table there is which regime in sentences, by their asperity load ratios (NaN: not
    solved); none where none is known."""
    numbers: dict[Regime, list[int]] = {}
    ratios = list(asperity_load_ratios)
    for number, ratio in enumerate(ratios, 1):
        if (regime := regime_of(ratio)) is not None:
            numbers.setdefault(regime, []).append(number)
    if not numbers:
        return []
    total = sum(map(len, numbers.values()))
    places = "; ".join(
        f"{regime} a{numbers_in_words(of_regime, total).removeprefix('A')}" for regime, of_regime in numbers.items()
    )
    known = [ratio for ratio in ratios if not math.isnan(ratio)]
    span = " to ".join(dict.fromkeys(f"{end:.2g}" for end in (min(known), max(known))))
    text = f"By its asperity load ratio of {span} there is {places}."
    return [text if list(numbers) == [Regime.FULL_FILM] else f"{text} {NO_WEAR}"]
