"""What a reader of a converged result must know about its limits: one sentence each, measured on the result."""

from __future__ import annotations

ROELANDS_LIMIT = 1e9  # Pa, about the pressure to which the law was fitted
FLUID_FRICTION = 0.15  # F_sh/F_H above which a Newtonian oil is beyond what any lubricant carries
STRIP_SHARE = 0.2  # of the mean gap that the undeformed cylinder may rise over the strip
STEEP_SLOPES = 0.5  # rms


def cautions(scene, balance, shear) -> tuple[str, ...]:
    """Notes on a `Balance` and its `ShearForce` that leave the range in which the model is meant to hold."""
    notes, bodies, lubricant, film = [], scene.bodies, scene.lubricant, balance.film
    if film is None:
        return ()
    peak = film.pressure.max()
    if peak > ROELANDS_LIMIT and lubricant.viscosity_law != "constant":
        notes.append(f"caution: film pressure {peak / 1e9:.2g} GPa, where the viscosity law is an extrapolation")
    newtonian = lubricant.eyring_stress is None and lubricant.limiting_stress_coefficient is None
    if newtonian and shear.couette > FLUID_FRICTION * balance.film_load:
        notes.append(
            f"caution: Newtonian shear gives the film a friction coefficient of "
            f"{shear.couette / balance.film_load:.2g}; choose lubricant.eyring_stress or a limiting stress"
        )
    rise = bodies.half_width**2 / (6 * bodies.radius)
    if (
        balance.contact_load > 0
        and scene.numerics.film_deflection == "hydrodynamic"
        and rise > STRIP_SHARE * balance.closure.mean_gap
    ):
        notes.append(
            f"caution: over the Hertz strip the undeformed cylinder rises {rise:.2g} m on average, not small against "
            f"the mean gap {balance.closure.mean_gap:.2g} m; a film flattened by its own pressure alone then takes too "
            "much of the load (f does not tend to f_b): see numerics.film_deflection = 'scaled' or 'total'"
        )
    if film.central_film > 0.1 * bodies.radius:
        notes.append(f"caution: film {film.central_film:.2g} m is not thin against the radius {bodies.radius:.2g} m")
    return tuple(notes)
