"""The rough contacts of a scene: its keys become the numbers that `lubfric.contact` takes."""

from __future__ import annotations

import numpy as np

from ..contact import (
    AsperityContact,
    FlatContact,
    HalfSpace,
    HalfSpaceContact,
    LoadedCylinder,
    asperities_under_cylinder,
    flat_contact,
    half_space_contact,
)
from ..scene import Scene, budget


def cylinder_of(scene: Scene) -> LoadedCylinder:
    """Return the loaded cylinder of ``scene``."""
    bodies = scene.bodies
    return LoadedCylinder(
        radius=bodies.radius,
        width=bodies.width,
        load=bodies.load,
        e_prime=bodies.e_prime,
        hardness=bodies.hardness,
    )


def half_space_contact_of(
    scene: Scene,
    heights: np.ndarray,
    spacing: tuple[float, float],
    *,
    operator: HalfSpace | None = None,
    x: np.ndarray | None = None,
) -> HalfSpaceContact:
    """Return the half-space contact of ``scene`` on ``heights`` [m] (nx, ny) about their mean.

    operator : made before for this grid; x : cell centres [m] (nx,), None: evenly about the line of contact
    """
    return half_space_contact(
        heights,
        spacing,
        cylinder_of(scene),
        region=scene.contact.region,
        tolerance=scene.numerics.tolerance_of("contact"),
        workers=scene.numerics.workers,
        operator=operator,
        x=x,
    )


def flat_contact_of(scene: Scene, heights: np.ndarray, spacing: tuple[float, float]) -> FlatContact:
    """Return the flat contact of ``scene``, with a curve for periodic ``heights`` [m] (nx, ny) about their mean."""
    return flat_contact(
        heights,
        spacing,
        cylinder_of(scene),
        model=scene.contact.model,
        asperity_separation=scene.contact.asperity_separation,
        tolerance=scene.numerics.tolerance_of("contact"),
        accuracy=budget.CURVE * scene.numerics.tolerance,
        workers=scene.numerics.workers,
    )


def independent_asperities_of(scene: Scene, heights: np.ndarray, spacing: tuple[float, float]) -> AsperityContact:
    """Return the contact of ``scene`` by independent asperities on ``heights`` [m] (nx, ny) about their mean."""
    return asperities_under_cylinder(
        heights,
        spacing,
        cylinder_of(scene),
        region=scene.contact.region,
        definition=scene.contact.model,
        asperity_separation=scene.contact.asperity_separation,
        tolerance=scene.numerics.tolerance_of("contact"),
    )
