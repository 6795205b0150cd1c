"""Which scenes the deterministic model, which resolves the rough gap, can solve."""

from __future__ import annotations

from ..errors import InputError
from .scene import Scene

TAKEN = (  # key, values that the model takes, why no other
    ("contact.geometry", ("cylinder",), ""),
    ("contact.model", ("half-space",), ""),
    ("contact.region", ("hertz",), " (there is no volume balance; means are over the Hertz strip)"),
    ("motion.slide_roll_ratio", (2.0,), " (the rough body, surface 1, at rest: else the film is not steady)"),
    ("numerics.film_deflection", ("scaled", "hydrodynamic"), " (no smooth film is deflected)"),
    ("numerics.cavitated_shear", ("none",), ""),
    ("numerics.heat", ("auto", "off"), " (the model is isothermal)"),
)


def resolves_gap(scene: Scene) -> bool:
    """Whether the rough gap is resolved: the deterministic model."""
    return scene.numerics.model == "deterministic"


def check_resolved_gap(scene: Scene) -> None:
    """Raise `InputError` for keys that the deterministic model does not take."""
    for name, allowed, why in TAKEN:
        section, _, key = name.partition(".")
        value = getattr(getattr(scene, section), key)
        if value not in allowed:
            raise InputError(
                f" = {value!r} does not go with numerics.model = 'deterministic'",
                name,
                f"{', '.join(map(repr, allowed))}{why}, or numerics.model = 'load-sharing'",
            )
