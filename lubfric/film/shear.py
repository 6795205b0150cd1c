"""Tangential force of the film on surface 2 (paper, Eqs. 10-12)."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .._base import FloatArray
from ..oil import Lubricant, carried_stress, shear_stress
from .ehl_result import EHLResult
from .elastic_shear import ElasticContact, elastic_shear


@dataclass(frozen=True, kw_only=True)
class ShearForce:
    """Forces [N] on surface 2, against its sliding over surface 1.

    - ``couette``: from the difference of the surface speeds; ``rolling``: from the pressure gradient; ``total``: their
      sum, F_sh of Eq. (10).
    - ``quadrature``: estimated error of these sums, from two rules. It is large if the nodes do not resolve a pressure
      spike, whatever the error of the film.
    - ``rolling_parts``: the sum of the two parts, without sign, of which the rolling force is the difference: that of
      the complete film, and the part that the asperity contacts take from it. An error of the film is that much larger
      in the force.
    - ``excess`` [N]: the part of couette, without sign, from stresses above what oils carry
      (`lubfric.oil.lubricant.carried_stress`); ``stress_ratio`` [-]: the largest stress over that.
    - ``asperity_share``: of the friction of the asperities, the part that elastic shear of the discs leaves.
    - ``sense``: 1, or -1 where surface 2 is the slower one, whose sliding the rolling part then helps.
    """

    couette: float
    rolling: float
    quadrature: float = 0.0
    rolling_parts: float = 0.0
    excess: float = 0.0
    stress_ratio: float = 0.0
    sense: float = 1.0
    asperity_share: float = 1.0

    @property
    def resistance(self) -> float:
        """Rolling resistance of both surfaces together [N], against the entrainment: the gradient of pressure pulls at
        both alike."""
        return 2.0 * self.sense * self.rolling

    @property
    def total(self) -> float:
        """F_sh [N]."""
        return self.couette + self.rolling

    @property
    def magnitude(self) -> float:
        """Sum of the absolute parts of the force [N], on which an error of the film acts."""
        return abs(self.couette) + max(abs(self.rolling), self.rolling_parts)


def shear_force(
    film: EHLResult,
    lubricant: Lubricant,
    *,
    slide_roll_ratio: float,
    width: float,
    contact_fraction: Callable[[np.ndarray], np.ndarray],
    cavitated: str = "none",
    warm: float | None = None,
    heated: Callable[..., Any] | None = None,
    elastic: ElasticContact | None = None,
) -> ShearForce:
    """Return F_sh = B ∫ tau dx over the lubricated area, tau = (h/2) dp/dx + eta (u2 - u1)/h at surface 2.

    ``width`` B [m]; ``contact_fraction(x)``: for nodes x (n,) [m], the share of the width in contact, which carries no
    fluid shear, averaged over each of the n - 1 cells between them. The Couette term reaches from where the lubricant
    begins, or from far upstream (the parabola is followed to -infinity in closed form, as much thinned by its own heat
    as the first node: at any h that is the same factor), to the rupture. cavitated="striated" adds the streamers
    behind it, which fill the fraction h_rupture/h of the width. The lubricant's shear law (Newtonian by default) acts
    on the Couette term. ``warm``: the viscosity [Pa s] that the film was solved with, and ``heated``: the stress of
    the heated film, both of `lubfric.models.shared.heat.point_heat`; None: isothermal. ∫ (h/2) dp is ``film.rolling``
    less the part that the asperity contacts take; it is summed over the nodes if the film does not know it (None).
    ``elastic``: the contact whose film and discs shear elastically (`elastic_shear`), for a lubricant with a shear
    modulus; None: neither does.
    """
    entrainment_speed = film.entrainment_speed
    radius = film.radius
    direction = math.copysign(1.0, entrainment_speed)
    sliding = slide_roll_ratio * abs(entrainment_speed)
    x = film.x * direction  # run downstream
    order = np.argsort(x)
    x, p, h = (a[order] for a in (x, film.pressure, film.film_thickness))
    wet = 1.0 - contact_fraction(x * direction)
    resistance, parts, error_of_rolling = _rolling(p, h, 1.0 - wet, film.rolling)

    def isothermal(at: FloatArray, pressure: FloatArray, thickness: FloatArray) -> FloatArray:
        return shear_stress(lubricant, pressure, sliding / thickness)

    stress = isothermal if heated is None else heated
    tau = stress(x, p, h)
    asperity_share = 1.0
    left = np.ones(x.size)
    if elastic is not None:
        shares = elastic_shear(
            lubricant, elastic, x, p, h, entrainment_speed=abs(entrainment_speed), sliding=sliding, wet=wet
        )
        left = shares.film_share
        asperity_share = shares.asperity_share
        tau = left * tau
    face_tau = 0.5 * (tau[1:] + tau[:-1]) * np.diff(x) * wet
    full = x[:-1] < film.rupture * direction  # the rupture point is a node
    couette = np.sum(face_tau[full])
    middle = stress(*(0.5 * (a[1:] + a[:-1]) for a in (x, p, h))) * np.diff(x) * wet * 0.5 * (left[1:] + left[:-1])
    quadrature = max(2 / 3 * abs(np.sum((middle - face_tau)[full])), spike_error(x[:-1][full], tau[:-1][full]))
    quadrature += error_of_rolling
    ratio, excess = above_carried(p, tau, np.diff(x) * wet * full)
    inlet, thin = _upstream(h[0], -x[0], radius) if film.inlet is None else (0.0, 0.0)  # nothing is sheared there
    couette += (lubricant.viscosity * sliding if warm is None and heated is None else tau[0] * h[0]) * inlet
    viscosity = lubricant.viscosity if warm is None else warm
    resistance += 6 * viscosity * abs(entrainment_speed) * (inlet - film.flow_film * thin)
    if cavitated == "striated":
        h_rupture = np.interp(film.rupture * direction, x, h)
        share = 0.5 * (h_rupture / h[1:] + h_rupture / h[:-1])
        couette += np.sum((face_tau * share)[~full])
    sense = math.copysign(1.0, slide_roll_ratio)
    return ShearForce(
        couette=float(width * (sense * couette)),
        rolling=float(width * (sense * resistance)),
        quadrature=float(width * quadrature),
        rolling_parts=float(width * parts),
        excess=float(width * excess),
        stress_ratio=ratio,
        sense=sense,
        asperity_share=asperity_share,
    )


def above_carried(pressure: np.ndarray, tau: np.ndarray, lengths: np.ndarray) -> tuple[float, float]:
    """Return the largest stress over what oils carry, and the force per width [N/m] of all stress above it, over the
    ``lengths`` [m] of the n - 1 cells that a film fills."""
    carried = carried_stress(pressure)
    above = np.maximum(np.abs(tau) - carried, 0.0)
    return float(np.max(np.abs(tau) / carried)), float(np.sum(0.5 * (above[1:] + above[:-1]) * lengths))


def spike_error(x: np.ndarray, tau: np.ndarray) -> float:
    """Return the possible error of a sum over nodes if a spike is between them.

    It is an eighth of the second-order error estimate from the sum over every second node. A spike makes that estimate
    at least eight times as large as the error.
    """
    second = (x[::2], tau[::2]), (x[: 2 * ((x.size + 1) // 2) - 1], tau[: 2 * ((x.size + 1) // 2) - 1])
    coarse, fine = (np.sum(0.5 * (t[1:] + t[:-1]) * np.diff(s)) for s, t in second)
    return abs(coarse - fine) / 24


def _rolling(
    p: FloatArray, h: FloatArray, touched: FloatArray, known: tuple[float, float] | None
) -> tuple[float, float, float]:
    """Return ∫ (h/2) dp [N/m] without the share of the width that is ``touched``, the parts on which an error of the
    film acts, and the error of the sum."""
    rolls = 0.25 * (h[1:] + h[:-1]) * np.diff(p)
    force, error = known or (np.sum(rolls), rolling_error(p, h, 1.0))
    taken = np.sum(rolls * touched)
    return force - taken, abs(force) + abs(taken), error + rolling_error(p, h, touched)


def rolling_error(p: np.ndarray, h: np.ndarray, share: ArrayLike) -> float:
    """Return a third of the change of ∫ (h/2) share dp when every second node is omitted: an error of second order.
    ``share``: of the width of each of the n - 1 cells."""
    last = 2 * ((p.size + 1) // 2) - 1  # an odd number of nodes, so that both sums end at the same one
    share = np.broadcast_to(share, p.size - 1)[: last - 1]
    shares = share, 0.5 * (share[::2] + share[1::2])
    grids = [(h[:last:n], p[:last:n], shares[n - 1]) for n in (1, 2)]
    fine, coarse = (np.sum(0.25 * (h[1:] + h[:-1]) * np.diff(p) * share) for h, p, share in grids)
    return float(abs(coarse - fine)) / 3


def _upstream(h_inlet: float, distance: float, radius: float) -> tuple[float, float]:
    """Return ∫ dx/h [-] and ∫ dx/h^2 [1/m] upstream of the first node, where the gap is parabolic: h = floor + x^2/2R.

    There Reynolds' equation gives (h/2) dp/dx = 6 eta0 U (1/h - h_flow/h^2).
    """
    floor = h_inlet - distance**2 / (2 * radius)
    if abs(floor) < 1e-9 * h_inlet:
        return 2 * radius / distance, 4 * radius**2 / (3 * distance**3)
    scale = math.sqrt(2 * radius * abs(floor))
    if floor > 0:
        first = scale / floor * math.atan2(scale, distance)
    else:
        first = radius / scale * math.log((distance + scale) / (distance - scale))
    return first, (first - distance / h_inlet) / (2 * floor)
