"""Numbers and laws of other people, each once, with its source. This is a leaf: it imports nothing of this project.

`lubfric` and the solvers of `verification` keep constants of their own, and do not import this. The checks of grade A
(`verification.published`) hold both against it. All units are SI unless a name says otherwise.

``error`` of a source is a relative 95 % bound of its numbers. A closed form has that of its printed digits. Of a fit,
or of an asymptote that is used at finite numbers, it is the accuracy that its authors state. Where they state none, or
their text could not be had, 5 % is taken for all alike (`UNSTATED`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import erf

UNSTATED = 0.05
PRINTED = "printed"
LAW = "a law that many books print"
TRANSCRIBED = "transcribed from the publication, not confirmed in a second place"
QUOTED = "as another publication quotes it, not confirmed in a second place"
DERIVED = "quadrature of the published equations"


@dataclass(frozen=True)
class Source:
    """A publication: ``words`` (who, where, when), ``place`` in it, how its numbers were ``got``, ``error`` (relative)
    and what else a reader has to know."""

    words: str
    place: str
    got: str
    error: float
    note: str = ""

    @property
    def text(self) -> str:
        """All in one line."""
        return "; ".join(filter(None, (f"{self.words}, {self.place}", self.got, self.note)))


SOURCES: dict[str, Source] = {
    "hertz": Source("H. Hertz, J. reine angew. Math. 92 (1882) 156", "line contact", LAW, 0.0),
    "westergaard": Source("H. M. Westergaard, J. Appl. Mech. 6 (1939) A49", "sinusoidal waves", LAW, 0.0),
    "jgh": Source(
        "K. L. Johnson, J. A. Greenwood, J. G. Higginson, Int. J. Mech. Sci. 27 (1985) 383",
        "asymptotes of the bisinusoid",
        LAW,
        UNSTATED,
    ),
    "bush": Source(
        "A. W. Bush, R. D. Gibson, T. R. Thomas, Wear 35 (1975) 87; B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840",
        "area over load, two theories",
        LAW,
        0.0,
        "sqrt(2 pi) and sqrt(8/pi) are taken as the ends of a band",
    ),
    "xu": Source(
        "Y. Xu, L. Zhu, F. Xiao, Y. Zhou, Tribol. Lett. 72 (2024), doi:10.1007/s11249-024-01838-4",
        "their data (github.com/xylcsi/PerssonModelFudgeFactor): self-affine surfaces, H = 0.8",
        TRANSCRIBED,
        UNSTATED,
        "patch and cells are not told; two sets of areas differ by 2 to 5 %: their mean is taken",
    ),
    "challenge": Source(
        "A. Wang, M. H. Müser, Tribol. Lett. 65 (2017) 103: surface of the contact-mechanics challenge, no adhesion",
        "pressures of Fig. 2 at 0.01 of E* times slope, integrated",
        "digitised by Y. Xu (as above), not confirmed in a second place",
        0.05,
        "the load read back from it is 3 % too high; the challenge's own numbers have adhesion, and were not had",
    ),
    "longuet": Source("M. S. Longuet-Higgins, Phil. Trans. A 249 (1957) 321", "density of maxima", LAW, 0.0),
    "martin": Source("H. M. Martin, Engineering 102 (1916) 119", "rigid cylinder, constant viscosity", DERIVED, 2e-6),
    "swift": Source("H. W. Swift, Proc. ICE 233 (1932) 267; W. Stieber 1933", "film rupture", DERIVED, 2e-6),
    "blok": Source("H. Blok, Proc. Int. Symp. Lubrication and Wear, Houston 1963", "rigid, Barus", LAW, UNSTATED),
    "moes": Source(
        "G. Nijenbanning, C. H. Venner, H. Moes, Wear 176 (1994) 217; H. Moes, Lubrication and Beyond, 2000",
        "film of line contacts",
        LAW,
        UNSTATED,
    ),
    "grubin": Source("A. N. Grubin, TsNIITMASh 30 (1949)", "film formula", LAW, UNSTATED),
    "dowson66": Source(
        "D. Dowson, G. R. Higginson, Elasto-Hydrodynamic Lubrication, 1966", "smallest film", LAW, UNSTATED
    ),
    "dowson78": Source(
        "D. Dowson, S. Toyoda, 5th Leeds-Lyon Symp. (1978) 60",
        "central film",
        LAW,
        UNSTATED,
        "an oil of constant density is assumed: only so is theirs 1.3 to 1.4 times the smallest film of 1966",
    ),
    "fowell": Source(
        "M. Fowell, A. V. Olver, A. D. Gosman, H. A. Spikes, I. Pegg, J. Tribol. 129 (2007) 336",
        "pad with a band across it in which the film ruptures",
        DERIVED,
        1e-6,
        "as in Study E4 of github.com/ErikHansenGit/EHL, without ambient pressure",
    ),
    "bertocchi": Source(
        "L. Bertocchi, D. Dini, M. Giacopini, M. T. Fowell, A. Baldini, Tribol. Int. 67 (2013) 61",
        "pressure behind a pocket, middle line",
        "digitised by E. Hansen (github.com/ErikHansenGit/EHL, public domain), not confirmed in a second place",
        0.02,
    ),
    "biboulet": Source(
        "N. Biboulet, L. Houpert, Proc. IMechE J 224 (2010) 765, doi:10.1243/13506501JET790",
        "eqs. 42 and 44: rolling force and its part in a starved inlet, M = 0.2 to 200, L = 4 to 16",
        TRANSCRIBED,
        UNSTATED,
        "Barus, density of Dowson and Higginson; 'few per cents' that depend on M and L are left out",
    ),
    "biboulet-rigid": Source("N. Biboulet, L. Houpert 2010", "eq. 40, the rigid limit", TRANSCRIBED, 0.036),
    "johnson": Source(
        "K. L. Johnson, J. L. Tevaarwerk, Proc. R. Soc. A 356 (1977) 215; C. R. Evans, K. L. Johnson 1986",
        "mean Eyring stress",
        LAW,
        UNSTATED,
    ),
    "nahme": Source("R. Nahme, Ing.-Arch. 11 (1940) 191, doi:10.1007/BF02086920", "sheared film", LAW, 1e-6),
    "blok-flash": Source("H. Blok, General Discussion on Lubrication, IMechE 2 (1937) 222", "Hertz band", LAW, 5e-3),
    "jaeger": Source("J. C. Jaeger, Proc. R. Soc. N.S.W. 76 (1942) 203", "uniform band, fast", LAW, 1e-4),
    "gupta": Source("P. K. Gupta et al., Tribol. Trans. 35 (1992) 269", "inlet heat, factor", LAW, 1e-3),
    "wilson": Source("A. V. Olver, H. A. Spikes, Proc. IMechE J 212 (1998) 321", "inlet heat, factor", LAW, 1e-3),
    "d2270": Source("ASTM D2270 / ISO 2909", "by the package chemicals too", LAW, 5e-4, "two sources"),
    "d341": Source("ASTM D341", "five oils by m and n", TRANSCRIBED, 1e-3),
    "roelands": Source("C. J. A. Roelands, thesis, Delft 1966", "viscosity under pressure", LAW, 1e-3),
    "density": Source("D. Dowson, G. R. Higginson 1966", "density under pressure", LAW, 1e-3),
    "so-klaus": Source("B. Y. C. So, E. E. Klaus, ASLE Trans. 23 (1980) 409", "mineral VG 100, VI 95", QUOTED, 0.02),
    "gold": Source("P. W. Gold et al., J. Synthetic Lubrication 18 (2001) 51", "alpha = s ν^t", TRANSCRIBED, 1e-3),
    "arana": Source(
        "A. Arana et al., Proc. IMechE J (2019)", "three oils of a twin-disc rig", TRANSCRIBED, 0.04, "their fits, 4 %"
    ),
    "stachowiak": Source(
        "G. W. Stachowiak, A. W. Batchelor, Engineering Tribology", "Table 2.3", TRANSCRIBED, UNSTATED
    ),
    "venner": Source(
        "C. H. Venner, F. Couhier, A. A. Lubrecht, J. A. Greenwood, Tribology Series 32 (1997) 103, "
        "doi:10.1016/s0167-8922(08)70440-1",
        "Table 1: amplitude reduction, line contact, pure rolling, M = 100, L = 11",
        TRANSCRIBED,
        UNSTATED,
        "another project's copy of the table has the same 18 numbers",
    ),
    "venner-fit": Source(
        "C. H. Venner, F. Couhier, A. A. Lubrecht, J. A. Greenwood 1997",
        "eq. 5, which is made for A_d/A_i up to 0.5",
        TRANSCRIBED,
        0.1,
    ),
    "greenwood": Source(
        "J. A. Greenwood, G. E. Morales-Espejel, Proc. IMechE J 208 (1994) 121",
        "Tables 1 and 2, a case of Kweh: waves at rest",
        TRANSCRIBED,
        0.01,
        "three digits, and linear in the height; their pressure is not told: at 1.016 GPa the density of Dowson and "
        "Higginson is as stiff as in both of their rows",
    ),
    "hooke": Source(
        "C. J. Hooke, Proc. IMechE J 220 (2006) 259, doi:10.1243/13506501JET146",
        "eqs. 12 and 19: waves that move through an even film, Eyring",
        TRANSCRIBED,
        0.0,
        "within 1 % of the roughness of his own solutions",
    ),
    "shares": Source(
        "a twin disc (contact resistance), Zhou and Hoeprich (raceways), Aihara, Doleschel",
        "load share of the asperities",
        QUOTED,
        0.0,
        "the band that four laws span",
    ),
    "paper": Source("the paper that lubfric implements", "Tables 1 and 2, Sec. 3.2, Fig. 9", PRINTED, 0.0),
}

# ---- dry contact


def hertz_line(load: float, radius: float, e_prime: float) -> tuple[float, float]:
    """Half-width [m] and peak pressure [Pa] of a line contact; load [N/m]."""
    half_width = math.sqrt(8 * load * radius / (math.pi * e_prime))
    return half_width, 2 * load / (math.pi * half_width)


def westergaard_area(share: float) -> float:
    """Share of the length in contact at a ``share`` p/p* of the pressure that closes a sinusoid; p* =
    pi E* amplitude/wavelength."""
    return 2 / math.pi * math.asin(math.sqrt(share))


def bisinusoid_area(share: float) -> float:
    """Contact area fraction of ``amplitude cos cos`` near either end of the share p/p*; p* = sqrt(2) pi E*
    amplitude/wavelength."""
    return math.pi * (3 * share / (8 * math.pi)) ** (2 / 3) if share < 0.5 else 1 - 3 / (2 * math.pi) * (1 - share)


AREA_OVER_LOAD = (math.sqrt(8 / math.pi), math.sqrt(2 * math.pi))  # of p/(E* rms slope): Persson; Bush et al.


# self-affine, waves from 1 to 100, by load over E* times slope: mean gap over Sq, area by both sets, mean square
# pressure over (E* times slope)² (None: not among their data)
SELF_AFFINE_SLOPE = 0.2765
SELF_AFFINE: dict[float, tuple[float | None, tuple[float, float] | None, float | None]] = {
    0.005 / SELF_AFFINE_SLOPE: (1.1806, (0.03791, 0.03994), None),
    0.025 / SELF_AFFINE_SLOPE: (0.4398, (0.17770, 0.18524), 0.004888 / SELF_AFFINE_SLOPE**2),
    0.113 / SELF_AFFINE_SLOPE: (0.03836, (0.64300, 0.65714), 0.02667 / SELF_AFFINE_SLOPE**2),
    0.24 / SELF_AFFINE_SLOPE: (None, None, 0.07607 / SELF_AFFINE_SLOPE**2),
}
CHALLENGE = {"load": 0.01, "area": 0.0208, "mean square pressure": 0.00688}
EDGE = (
    math.pi - 1 + math.log(2)
) / 24  # of the cells' edges around contacts, to be taken off their area: V. A. Yastrebov,
# G. Anciaux, J.-F. Molinari, J. Mech. Phys. Solids 107 (2017) 469; a second program has it too


def summit_density(length: float) -> float:
    """Maxima per area [1/m²] of a Gaussian surface with the autocorrelation exp(-(r/length)²): m4/(6 pi sqrt(3) m2),
    with m2 = 2 Sq²/length² and m4 = 12 Sq²/length⁴ of a profile."""
    return 1 / (math.pi * math.sqrt(3) * length**2)


# ---- films; h in units of Moes, sqrt(eta u_s/(E' R)) R; u is eta U/(E' R) with the mean speed

RIGID = {"smallest": 2.447484, "flow": 3.000000, "rupture": 0.4751299, "couette": 2.848722, "rolling": 2.300538}
BLOK = {"smallest": 1.049701, "flow": 1.286670}  # of L^(2/3)
ISOVISCOUS_ELASTIC, RIGID_PIEZOVISCOUS, ELASTIC_PIEZOVISCOUS = 2.621, 1.287, 1.311


def moes(m: float, l: float) -> float:
    """Film where dp/dx = 0, incompressible."""
    ri, ei, rp = 3 / m, ISOVISCOUS_ELASTIC * m**-0.2, RIGID_PIEZOVISCOUS * l ** (2 / 3)
    ep = ELASTIC_PIEZOVISCOUS * m ** (-1 / 8) * l ** (3 / 4)
    s = (7 + 8 * math.exp(-2 * ei / ri)) / 5
    soft, hard = (ri ** (7 / 3) + ei ** (7 / 3)) ** (3 / 7), (rp**-3.5 + ep**-3.5) ** (-2 / 7)
    return (soft**s + hard**s) ** (1 / s)


def grubin(u: float, g: float, w: float) -> float:
    """h/R."""
    return 1.95 * (g * u) ** (8 / 11) * w ** (-1 / 11)


def dowson_higginson(u: float, g: float, w: float) -> float:
    """Smallest h/R."""
    return 2.65 * u**0.70 * g**0.54 * w**-0.13


def dowson_toyoda(u: float, g: float, w: float) -> float:
    """Central h/R."""
    return 3.06 * u**0.69 * g**0.56 * w**-0.10


@dataclass(frozen=True)
class Pocket:
    """A pad of ``length`` and ``width`` over a plane of twice the ``speed``, its gap from ``start`` to ``end``, with a
    pocket of ``depth``: from ``begins`` to ``ends`` along the motion, ``across`` wide. ``pressures`` [MPa] behind it,
    at 0.6, 0.75 and 0.9 of the length; ``load`` [N/m], about. SI units."""

    length: float
    begins: float
    ends: float
    start: float
    end: float
    depth: float
    width: float = 1.0
    across: float = 2.0
    alpha: float = 0.0
    pressures: tuple[float, ...] = ()
    load: float = 0.0
    viscosity: float = 0.01
    speed: float = 0.5

    def wedge(self, x):
        """Gap of the pad without its pocket."""
        return self.start + (self.end - self.start) * x / self.length

    def inside(self, x):
        """Where the pocket is along the motion."""
        return (x >= self.begins) & (x < self.ends)


BANDS = tuple(Pocket(10e-3, 2e-3, 5e-3, 1.05e-6, 1e-6, depth) for depth in (1e-6, 0.4e-6))
_BERTOCCHI = (20e-3, 4e-3, 10e-3, 1.1e-6, 1e-6, 0.4e-6)
BERTOCCHI = {
    "narrow": Pocket(*_BERTOCCHI, 10e-3, 7e-3, 12e-9, (6.32, 4.11, 2.12), 3e4),
    "wide": Pocket(*_BERTOCCHI, 0.3, 0.6, 12e-9, (36.13, 24.79, 10.11), 2.6e5),  # here a band: 0.21 of 0.3 m in theirs
}


def refilled(pad: Pocket) -> tuple[float, float, float]:
    """Load [N/m], place of refilling [m] and highest pressure [Pa] of a pocket as wide as the pad, where the film
    ruptures at the edge of the pocket, at constant viscosity and density, with the pressure of rupture outside."""
    scale = 12 * pad.speed * pad.viscosity * pad.length / (pad.start - pad.end)
    first, last = pad.wedge(pad.begins), pad.wedge(pad.ends)
    flow = pad.start * first / (pad.start + first)  # half of it, over U

    def rise(gap, since):
        return scale * (1 / gap - 1 / since - flow * (1 / gap**2 - 1 / since**2))

    deep = last + pad.depth
    constant = rise(last, pad.end) / scale - 1 / deep + flow / deep**2
    full = 2 * flow / (1 - math.sqrt(1 + 4 * flow * constant))  # the gap where the pocket is full again
    x = np.linspace(0, pad.length, 200001)
    gap = pad.wedge(x)
    p = np.where(x < pad.begins, rise(gap, pad.start), rise(gap, pad.end))
    pocket = gap + pad.depth
    p = np.where(pad.inside(x), np.where(pocket < full, rise(np.minimum(pocket, full), full), 0.0), p)
    place = (pad.start + pad.depth - full) * pad.length / (pad.start - pad.end)
    return float(np.trapezoid(p, x)), place, float(p.max())


# ---- waves across the motion; their speed is that of their body over the entrainment speed

AMPLITUDES = {  # wavelength/b: A_d/A_i at A_i = .1, .2 and .5 of the film
    4: (0.030, 0.030, 0.029),
    2: (0.073, 0.073, 0.073),
    1: (0.183, 0.182, 0.195),
    0.5: (0.394, 0.393, 0.378),
    0.25: (0.660, 0.670, 0.679),
    0.125: (0.839, 0.838, 0.859),
}
STEADY = {  # temperature: alpha [1/Pa], film [m], amplitudes of pressure [Pa] and film [m]
    "50 °C": (14.8e-9, 1.341e-6, 0.388e9, 0.0331e-6),
    "80 °C": (12.3e-9, 0.698e-6, 0.413e9, 0.0185e-6),
}
STEADY_WAVE = {"e_prime": 227e9, "wavelength": 0.2e-3, "height": 0.25e-6, "pressure": 1.016e9}
WITHIN = 0.01  # of the roughness: how closely Hooke's formulas follow his solutions


def amplitude_fit(m: float, l: float, wavelength: float) -> float:
    """A_d/A_i in pure rolling; ``wavelength`` in half-widths."""
    n = wavelength * m**0.75 / l**0.5
    return 1 / (1 + 0.17 * n + 0.03 * n**2)


def hooke(
    k: float, speed: float, film: float, drag: float, stiffness: float, e_prime: float
) -> tuple[complex, complex]:
    """What an even ``film`` [m] keeps of a wave exp(i k x) of its surface, and the complex wavenumber of the wave from
    the inlet. ``drag``: effective viscosity times entrainment speed [N/m]; ``stiffness``: bulk modulus [Pa]."""
    q, c = 48 * drag * (speed - 1) / (e_prime * film**3 * k**2), film * e_prime * k / (4 * stiffness)
    kept = (1 - 1j * c * q) / (1 - 1j * (1 + c) * q)
    q_inlet, c_inlet = 48 * drag / (e_prime * film**3 * (k * speed) ** 2), c * speed
    roots = np.roots([1j / q_inlet, -c_inlet, c_inlet - 1, 1])
    return kept, k * speed * roots[np.argmin(np.abs(roots - 1))]


# ---- friction and heat

RIGID_TORQUE, ELASTIC_TORQUE = 1.4, 1.45  # of p_h b²/M and p_h b²/M^1.5, per length, on a roller


def rolling_torque(m: float) -> float:
    """Torque on a roller over p_h b²/M^1.5, per length: sqrt(M) times the rigid one, then constant."""
    rigid = RIGID_TORQUE * math.sqrt(m)
    return rigid / (1 + (rigid / ELASTIC_TORQUE) ** 10) ** 0.1


def starved_torque(s: float) -> float:
    """What of that torque is left where the inlet begins at a gap of ``s`` times the smallest flooded film."""
    return (s**2 + 162.8 * s) / (s**2 + 193.1 * s + 1257)


FLASH_HERTZ, FLASH_UNIFORM = 1.11, 1.128  # of q_mean sqrt(2 b)/(e1 sqrt(u1) + e2 sqrt(u2))


def eyring_force(stress: float, viscosity: float, alpha: float, rate: float, width: float, peak: float) -> float:
    """Traction [N/m] of a film of even thickness under Hertz pressure (``peak`` [Pa], half-``width`` [m]), Barus and
    Eyring, for large arguments of asinh: 2 b tau_E (ln(2 eta rate/tau_E) + alpha p_mean)."""
    return 2 * width * stress * (math.log(2 * viscosity * rate / stress) + alpha * peak * math.pi / 4)


def nahme(number: float) -> float:
    """Stress over the isothermal one of a film that heats itself; ``number`` = beta eta du²/k."""
    a = number / 8
    return math.asinh(math.sqrt(a)) / math.sqrt(a * (1 + a))


def gupta(number: float, slide_roll: float, pressure_ratio: float) -> float:
    """Film over the isothermal one; ``number`` = eta beta U²/k."""
    over = 1 + 0.213 * (1 + 2.23 * slide_roll**0.83) * number**0.64
    return (1 - 13.2 * pressure_ratio * number**0.42) / over


def olver_spikes(number: float, slide_roll: float) -> float:
    """The same by another fit."""
    return 1 / (1 + 0.1 * (1 + 14.8 * slide_roll**0.83) * number**0.64)


# ---- oils; kinematic viscosities in mm²/s, alpha in 1/GPa, temperatures in °C

GOLD = {  # s, t of alpha = s nu^t
    "mineral": (9.904, 0.1390),
    "pao": (7.382, 0.1335),
    "ester": (6.605, 0.1360),
    "polyglycol": (5.489, 0.1485),
}
VISCOSITY_INDEX = {(73.3, 8.86): 92.4, (22.83, 5.05): 156.4, (30, 4.24): -25.6, (70, 11.1): 150.2, (68, 8.6): 96.8}
D341 = {  # m, n: at 40, 70 and 100 °C
    (9.5259, 3.7449): (31.81, 11.14, 5.385),
    (9.2479, 3.5849): (99.14, 26.86, 10.954),
    (8.8178, 3.3852): (217.98, 51.38, 18.915),
    (7.4846, 2.8510): (218.06, 62.80, 25.577),
    (6.5834, 2.4898): (218.78, 72.49, 31.906),
}
SO_KLAUS = {40: 28.0, 70: 21.0}  # mineral, VG 100, VI 95
TWIN_DISC: dict[
    str, tuple[float, float, str, float, float, dict[int, float]]
] = {  # at 40 and 100 °C, base, density at 15.6 °C, limiting stress over pressure; alpha by temperature
    "naphthenic": (97.9, 8.61, "mineral", 900, 0.053, {40: 27.3, 60: 22.9, 80: 19.8, 100: 17.4}),
    "paraffinic (FVA 3)": (96.0, 10.6, "mineral", 882, 0.047, {40: 20.9, 60: 19.1, 80: 17.5, 100: 16.3}),
    "PAO": (94.1, 14.0, "pao", 840, 0.035, {40: 15.4, 60: 13.8, 80: 12.4, 100: 11.3}),
}
MACHINE_OILS: dict[str, dict[int, tuple[float, float]]] = {  # dynamic viscosity [mPa s], alpha at each temperature
    "heavy machine oil": {30: (153, 23.7), 60: (34, 20.5), 100: (9.1, 15.8)},
    "spindle oil": {30: (18.6, 20), 60: (6.3, 16), 100: (2.4, 13)},
    "cylinder oil": {30: (810, 34), 60: (135, 28), 100: (26.8, 22)},
}


def roelands(viscosity: float, alpha: float, pressure: float) -> float:
    """Viscosity [Pa s] under pressure [Pa]."""
    pole = math.log(viscosity) + 9.67
    return math.exp(pole * (1 + pressure / 1.96e8) ** (alpha * 1.96e8 / pole) - 9.67)


def density(pressure: float) -> float:
    """Density under pressure [Pa] over that without; printed as 1 + .6 p/(1 + 1.7 p) with p in GPa, and as (5.9e8 +
    1.34 p)/(5.9e8 + p): this is the second."""
    return (5.9e8 + 1.34 * pressure) / (5.9e8 + pressure)


# ---- mixed lubrication

LOAD_SHARES = {  # of the asperities, over film/Sq
    "1 - erf(Λ), twin disc": lambda ratio: 1 - erf(ratio),
    "exp(-2.32 Λ^.97), raceways (Zhou & Hoeprich)": lambda ratio: np.exp(-2.32 * ratio**0.97),
    "exp(-1.8 Λ^1.2) (Aihara)": lambda ratio: np.exp(-1.8 * ratio**1.2),
    "(1 - Λ/2)² (Doleschel)": lambda ratio: np.maximum(1 - ratio / 2, 0) ** 2,
}
PAPER = {"mean Hertz pressure": 102e6, "half-width": 4.5e-6, "film load at 0.001 m/s": 0.225}  # Pa, m, N


def load_share_band(ratios) -> tuple[np.ndarray, np.ndarray]:
    """The lowest and the highest of the `LOAD_SHARES` at each of the ``ratios``."""
    laws = np.array([law(np.asarray(ratios, dtype=float)) for law in LOAD_SHARES.values()])
    return laws.min(axis=0), laws.max(axis=0)
