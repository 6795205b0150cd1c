"""f of the scene "paper" where the limiting stress of its oil, which the paper does not give, is at what oils have."""

from collections.abc import Iterator

import lubfric
from lubfric.models.shared import LIMIT_RANGE

from ...check import AT_MOST, Check, Item, Table
from ...kept import Run

SPEEDS = (0.01, 0.03, 0.1)  # m/s: the mixed regime of Fig. 8
MIDDLE = 0.07  # limiting stress over pressure of a usual mineral oil


def band(level: str, run: Run = Run()) -> Iterator[Item]:
    """Compare f with the unknown limit and its interval with f solved with limits."""
    scene = lubfric.load_scene("paper")
    limits = (LIMIT_RANGE[0], MIDDLE, LIMIT_RANGE[1])
    rows = []
    for speed in SPEEDS[1:2] if level == "quick" else SPEEDS:
        unknown = lubfric.friction(scene, speed)
        low, high = unknown.uncertainty.interval
        solved = []
        for limit in limits:
            with_limit = scene.with_(lubricant={"limiting_stress_coefficient": limit})
            solved.append(lubfric.friction(with_limit, speed).coefficient)
        outside = max(0.0, low - min(solved), max(solved) - high)
        yield Check(
            f"{speed:g} m/s: f with a limit, outside the interval",
            outside,
            expected=0.0,
            tolerance=1e-9,
            source="solved",
            kind=AT_MOST,
        )
        saturated = unknown.saturated_film_load / scene.bodies.load
        numbers = (f"{unknown.coefficient:.4f}", f"{low:.3f} to {high:.3f}", f"{100 * saturated:.0f} %")
        rows.append((f"{speed:g}", *numbers, *(f"{f:.4f}" for f in solved)))
    columns = (
        *("U [m/s]", "f, limit not known", "95 % interval", "load on saturated films"),
        *(f"f, limit {limit:g} p" for limit in limits),
    )
    yield Table("paper-limit", "The scene paper, with an unknown and with a known limiting stress", columns, rows)
