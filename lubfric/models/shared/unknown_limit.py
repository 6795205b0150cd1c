"""The limiting shear stress of an oil that nobody gave, and what it does to f.

At the pressure of asperities a Newtonian film, or one by Carreau's law, would carry any stress. The deterministic
model, on long cells too, cuts it at f_b p, which is no property of the oil. Where such films carry load, f is therefore
known only as far as the limit of oils is.
"""

from ...scene import Scene

# limiting stress over pressure: mineral oils from .047 (Höglund 1999, in Arana et al. 2019), traction fluids to .1
# (SKF, Rolling bearings; Bair and Winer 1989 .088); typical.toml has them by name
LIMIT_RANGE = (0.05, 0.10)
GIVE_LIMIT = 'give lubricant.limiting_stress_coefficient, or "f_b" if f_b p is meant'
SATURATED = 0.05  # share of the load on saturated films from which on f is held to depend on that


def limit_bounds(scene: Scene, saturated: float, coefficient: float, ends: tuple[float, float]) -> tuple[float, float]:
    """Return by how much f may be lower and higher, relative, because the limiting stress of the oil is not known.

    Zeros where the stress of the oil is limited, where the scene states f_b as the limit, and where the share
    ``saturated`` of the load is at most `SATURATED`. ``ends``: f with the limit at the ends of `LIMIT_RANGE`, of which
    ``coefficient`` is f.
    """
    oil = scene.lubricant
    if not oil.has_unlimited_stress or oil.is_limited_by_boundary_friction or saturated <= SATURATED or not coefficient:
        return 0.0, 0.0
    low, high = sorted((1 - end / coefficient for end in ends), reverse=True)
    return max(low, 0.0), max(-high, 0.0)


def limit_in_words(bounds: tuple[float, float]) -> str:
    """Return what the unknown limit does to f, as text; "" where that is nothing."""
    if not any(bounds):
        return ""
    low, high = LIMIT_RANGE
    return (
        "the shear stress of the film between the asperities is limited to f_b p, because the limiting stress of the "
        f"oil is not given: a limit of {low:g} p to {high:g} p changes f by {-100 * bounds[0]:+.2g} to "
        f"{100 * bounds[1]:+.2g} %; {GIVE_LIMIT}"
    )
