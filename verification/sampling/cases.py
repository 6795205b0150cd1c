"""What is asked: the built-in scene at four speeds, and other surfaces and loads."""

from __future__ import annotations

from dataclasses import dataclass, field

import lubfric

SEED = 240_000


@dataclass(frozen=True)
class Case:
    """A scene, its speed [m/s], the relative standard error asked, and the bounds of the coverage."""

    name: str
    speed: float
    asked: float = 0.02
    low: float = 0.92
    high: float = 0.98
    changes: dict = field(default_factory=dict)

    def scene(self, seed: int):
        """The scene with a surface of its own ``seed``."""
        base = lubfric.load_scene("paper")
        changes = {section: dict(values) for section, values in self.changes.items()}
        changes["surface"] = {**changes.get("surface", {}), "seed": seed}
        return base.with_(**changes)


SPEEDS = (
    Case("0.003 m/s", 0.003),
    Case("0.01 m/s", 0.01, 0.01),
    Case("0.03 m/s", 0.03),
    Case("0.046 m/s", 0.046),
)


def _other(name: str, speed: float = 0.01, **changes) -> Case:
    return Case(name, speed, 0.02, 0.88, 0.99, changes)


CASES = (
    *SPEEDS,
    _other("exponential ACF", surface={"acf": "exponential"}),
    _other("4 µm", surface={"correlation_length": 4e-6}),
    _other("16 µm", surface={"correlation_length": 16e-6}, contact={"shape": (320, 200)}),
    _other("55 N", bodies={"load": 55.0}),
    _other("plastic", bodies={"hardness": 2e9}),
    _other("2.2 x 40 µm", surface={"correlation_length": (2.2e-6, 40e-6)}, contact={"shape": (200, 600)}),
)
