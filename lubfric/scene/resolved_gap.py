"""Which scenes the models that resolve the rough gap can solve."""

from __future__ import annotations

from ..errors import InputError
from .scene import Scene

TAKEN = (
    ("contact", "geometry", "cylinder"),
    ("contact", "model", "half-space"),
    ("contact", "region", "hertz"),
    ("motion", "slide_roll_ratio", 2.0),
    ("numerics", "closure", "load"),
    ("numerics", "film_deflection", "hydrodynamic"),
    ("numerics", "film_level", "auto"),
    ("numerics", "contact_level", "auto"),
    ("numerics", "cavitated_shear", "none"),
)
WHY = {
    "slide_roll_ratio": " (the rough body, surface 1, at rest: else the film is not steady)",
    "region": " (there is no volume balance; means are over the Hertz strip)",
    "film_deflection": " (no smooth film is deflected)",
    "closure": " (nothing is shared: one pressure carries the load)",
}


HEAT = ("auto", "off")


def resolves_gap(scene: Scene) -> bool:
    """Whether the rough gap is resolved: the deterministic model, or one-way load sharing."""
    return scene.numerics.model == "deterministic" or scene.numerics.closure == "one-way"


def check_resolved_gap(scene: Scene) -> None:
    """Raise `InputError` for keys that a model with a resolved gap does not take."""
    one_way = scene.numerics.model != "deterministic"
    asked = "numerics.closure = 'one-way'" if one_way else "numerics.model = 'deterministic'"
    instead = "numerics.closure = 'load'" if one_way else "numerics.model = 'auto'"
    for section, key, allowed in TAKEN:
        value = getattr(getattr(scene, section), key)
        if value not in (allowed, "auto") and not (one_way and key == "closure"):
            raise InputError(
                f"{section}.{key} = {value!r} does not go with {asked}; allowed: {allowed!r}{WHY.get(key, '')}, "
                f"or {instead}"
            )
    if scene.numerics.heat not in HEAT:
        raise InputError(
            f"numerics.heat = {scene.numerics.heat!r} does not go with {asked}, which is isothermal; "
            f"allowed: {', '.join(map(repr, HEAT))}"
        )
