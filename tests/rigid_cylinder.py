"""A rigid cylinder near a plane, ``h = h0 + x^2/(2R)``, flooded inlet: the oracle of thick films. It shares no code
with the library.

With ``x = sqrt(2 R h0) tan(theta)`` Reynolds' equation integrates in closed form up to the rupture angle, the root of
one scalar equation (p = dp/dx = 0 there: Swift-Stieber). Valid for h0 << R, a Newtonian lubricant and rigid surfaces.
Sources: H. M. Martin, Engineering 102 (1916) 119; P. L. Kapitza, Zh. Tekh. Fiz. 25 (1955) 747.
"""

import math
from functools import cache
from types import SimpleNamespace

import numpy as np
from scipy.optimize import brentq


def _reduced(theta, rupture):
    """Integral of cos^2 t - cos^4 t / cos^2(rupture) over -pi/2 < t < theta: the pressure."""
    second = (theta + np.pi / 2) / 2 + np.sin(2 * theta) / 4
    fourth = 3 * (theta + np.pi / 2) / 8 + np.sin(2 * theta) / 4 + np.sin(4 * theta) / 32
    return second - fourth / np.cos(rupture) ** 2


@cache
def rigid_constants() -> SimpleNamespace:
    """Pure numbers of the rigid cylinder, from the root of the rupture equation (u_s = 2 U the sum of the surface
    speeds, L, M of Moes).

    rupture : x_e / sqrt(2 R h0), where the film ruptures
    load : w = load * eta U R / h0
    flow_film_ratio : h where dp/dx = 0, over h0
    couette : force per width = couette * eta (u2 - u1) sqrt(R/h0), up to rupture
    rolling : force per width, half the integral of h dp, = rolling * eta u_s sqrt(R/h0)
    min_film, flow_film : H M in Moes units
    """
    angle = brentq(lambda t: _reduced(t, t), 0.1, 1.0, xtol=1e-15, rtol=1e-15)
    ratio = 1 / math.cos(angle) ** 2
    swept = angle + math.pi / 2
    load = 6 / ratio
    rolling = 3 * math.sqrt(2) * (swept - ratio * (swept / 2 + math.sin(2 * angle) / 4))
    return SimpleNamespace(
        rupture=math.tan(angle),
        load=load,
        flow_film_ratio=ratio,
        couette=math.sqrt(2) * swept,
        rolling=rolling,
        min_film=load / 2,
        flow_film=load * ratio / 2,
    )


def pressure(x, min_film, *, radius, entrainment_speed, viscosity):
    """p(x) [Pa] of the isoviscous film, 0 beyond rupture; x [m] from the thinnest film (outlet
    side positive), min_film h0 [m], radius [m], entrainment_speed U [m/s], viscosity [Pa s]."""
    scale = math.sqrt(2 * radius * min_film)
    rupture = math.atan(rigid_constants().rupture)
    theta = np.minimum(np.arctan(np.asarray(x) / scale), rupture)
    peak_scale = 12 * viscosity * entrainment_speed * scale / min_film**2
    return np.maximum(peak_scale * _reduced(theta, rupture), 0.0)


def isoviscous_min_film(*, load_per_width, radius, entrainment_speed, viscosity):
    """h0 [m] = 4.895 eta U R / w. Valid where p stays far below E' h0/b and 1/alpha."""
    return rigid_constants().load * viscosity * entrainment_speed * radius / load_per_width


def couette_friction(min_film, *, radius, speed_difference, viscosity):
    """Force per width [N/m] of shearing the unbroken film at u2 - u1 = speed_difference [m/s]."""
    return rigid_constants().couette * viscosity * speed_difference * np.sqrt(radius / min_film)


def rolling_friction(min_film, *, radius, entrainment_speed, viscosity):
    """Force per width [N/m], half the integral of h dp over the film; on either surface."""
    return rigid_constants().rolling * viscosity * 2 * entrainment_speed * np.sqrt(radius / min_film)
