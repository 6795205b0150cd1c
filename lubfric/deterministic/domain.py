"""The grid under a cylinder that carries a rough patch, and how far it reaches up and down stream."""

from __future__ import annotations

import math

import numpy as np

from ..contact import half_space
from ..errors import InputError
from ..film import LineContact
from ..surface import Surface
from .problem import FLOOR, Problem

ROUGH_INLET, ROUGH_OUTLET = 14.0, 5.0  # the undeformed gap at the ends, in Sq
HERTZ_INLET, HERTZ_OUTLET = 3.0, 1.8  # the ends, at least, in Hertz half-widths
FILM_INLET, FILM_OUTLET = 1.5, 0.8  # and in sqrt(2 R h) of the smooth film
LARGEST = 2**20  # cells


def reach(contact: LineContact, sq: float) -> tuple[float, float]:
    """Lengths [m] of the grid upstream and downstream of the line of contact.

    The grid ends where the roughness is small compared with the gap (its effect on the flow, 6 (Sq/h)², is below some 3
    %) and where there is no pressure. Upstream of the grid the film continues in closed form.
    """
    radius, b = contact.radius, contact.half_width
    film = min(contact.moes_film, contact.rigid_film) if contact.L == 0 else contact.moes_film
    thick = math.sqrt(2 * radius * film)
    rough_in, rough_out = (math.sqrt(2 * radius * n * sq) for n in (ROUGH_INLET, ROUGH_OUTLET))
    return max(rough_in, HERTZ_INLET * b, FILM_INLET * thick), max(rough_out, HERTZ_OUTLET * b, FILM_OUTLET * thick)


def lay_out(
    surface: Surface,
    contact: LineContact,
    *,
    sliding: float,
    boundary_friction: float,
    hardness: float | None = None,
    ends: tuple[float, float] | None = None,
    floor: float = FLOOR,
) -> Problem:
    """The `Problem` of ``surface`` on its own cells, its middle under the line of contact.

    If the grid is longer than the map, the map is repeated, or mirrored if it is not periodic along x. ``ends`` [m]:
    lengths up and down stream (default: `reach`). Raises `InputError` for more cells than `LARGEST`.
    """
    (nx, ny), (dx, dy) = surface.shape, surface.spacing
    upstream, downstream = reach(contact, surface.sq) if ends is None else ends
    # the centres of the cells of the map are (i - (nx - 1)/2) dx
    first = math.floor((nx - 1) / 2 - upstream / dx)
    last = math.ceil((nx - 1) / 2 + downstream / dx)
    index = np.arange(first, last + 1)
    if index.size * ny > LARGEST:
        raise InputError(
            f"contact: a deterministic film needs {index.size} x {ny} cells of {dx:.3g} x {dy:.3g} m here; "
            f"allowed: up to {LARGEST:.3g} cells (larger contact.spacing, or a narrower patch)"
        )
    period = nx if surface.periodic_axes[0] else 2 * nx
    place = index % period
    place = np.where(place < nx, place, period - 1 - place)
    heights = surface.heights[place] - surface.heights.mean()
    operator = half_space(heights.shape, (dx, dy), contact.e_prime, ("free", "periodic"))
    x = (index - (nx - 1) / 2) * dx
    limit = math.inf if hardness is None else hardness
    return Problem(contact, sliding, x, heights, operator, boundary_friction, limit, floor)
