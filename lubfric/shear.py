"""Tangential force of the film on the upper surface (paper, Eqs. 10-12)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .lubricant import shear_stress


@dataclass(frozen=True)
class ShearForce:
    """Forces [N] on the upper surface, in the direction in which it slides over the lower one.

    couette: from the difference of the surface speeds; rolling: from the pressure gradient;
    total: their sum, F_sh of Eq. (10).
    """

    couette: float
    rolling: float

    @property
    def total(self) -> float:
        """F_sh [N]."""
        return self.couette + self.rolling


def shear_force(film, lubricant, *, entrainment_speed, slide_roll_ratio, radius, width, contact_fraction,
                cavitated="none") -> ShearForce:
    """F_sh = B ∫ tau dx over the lubricated area, tau = (h/2) dp/dx + eta (u2 - u1)/h at the upper surface.

    ``film`` is an `EHLResult` (x, pressure, film_thickness); ``contact_fraction(x)`` is the
    share of the width at x that is in contact and carries no fluid shear. The Couette term reaches from
    far upstream (the parabola is followed to -infinity in closed form) to the rupture of the film;
    cavitated="striated" adds the streamers behind it, which fill the fraction h_rupture/h of the
    width. The lubricant's shear law (Newtonian by default) acts on the Couette term.
    """
    direction = math.copysign(1.0, entrainment_speed)
    sliding = slide_roll_ratio * abs(entrainment_speed)
    x = film.x * direction                                    # run downstream
    order = np.argsort(x)
    x, p, h = (a[order] for a in (x, film.pressure, film.film_thickness))
    wet = 1.0 - contact_fraction(x * direction)
    face_wet = 0.5 * (wet[1:] + wet[:-1])

    rolling = np.sum(0.25 * (h[1:] + h[:-1]) * np.diff(p) * face_wet)
    tau = shear_stress(lubricant, p, sliding / h) * wet
    face_tau = 0.5 * (tau[1:] + tau[:-1]) * np.diff(x)
    full = p[1:] > 0
    couette = np.sum(face_tau[full])
    couette += lubricant.viscosity * sliding * _upstream(h[0], -x[0], radius)
    if cavitated == "striated":
        last = int(np.flatnonzero(p > 0)[-1])
        share = 0.5 * (h[last] / h[1:] + h[last] / h[:-1])
        couette += np.sum((face_tau * share)[~full & (x[1:] > x[last])])
    sense = math.copysign(1.0, slide_roll_ratio)
    return ShearForce(couette=float(width * sense * couette), rolling=float(width * sense * rolling))


def _upstream(h_inlet, distance, radius) -> float:
    """∫ dx/h [-] upstream of the first node, where the gap is parabolic."""
    floor = h_inlet - distance**2 / (2 * radius)
    if abs(floor) < 1e-12 * h_inlet:
        return 2 * radius / distance
    scale = math.sqrt(2 * radius * abs(floor))
    if floor < 0:
        return radius / scale * math.log((distance + scale) / (distance - scale))
    return scale / floor * math.atan2(scale, distance)
