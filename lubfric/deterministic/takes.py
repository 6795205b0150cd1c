"""Which scenes a deterministic film takes."""

from __future__ import annotations

from ..errors import InputError
from ..scene import Scene

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
    "film_deflection": " (one pressure deflects film and contact)",
    "closure": " (nothing is shared: one pressure carries the load)",
}


HEAT = ("auto", "off")


def check_scene(scene: Scene) -> None:
    """Raise `InputError` for what a deterministic film does not take."""
    for section, key, allowed in TAKEN:
        value = getattr(getattr(scene, section), key)
        if value not in (allowed, "auto"):
            raise InputError(
                f"{section}.{key} = {value!r} does not go with numerics.model = 'deterministic'; "
                f"allowed: {allowed!r}{WHY.get(key, '')}, or numerics.model = 'auto'"
            )
    if scene.numerics.heat not in HEAT:
        raise InputError(
            f"numerics.heat = {scene.numerics.heat!r} does not go with numerics.model = 'deterministic', which "
            "is isothermal; "
            f"allowed: {', '.join(map(repr, HEAT))}"
        )
