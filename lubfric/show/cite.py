"""The papers behind a result: what was used is what is cited."""

from __future__ import annotations

MODEL = (
    "A. Akchurin, R. Bosman, P. M. Lugt, M. van Drogen, Tribology Letters 59:19 (2015), "
    "doi:10.1007/s11249-015-0536-z: load sharing between film and rough contact"
)
CONTACT = (
    "I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206-219, doi:10.1016/S0043-1648(99)00113-1: contact of rough surfaces "
    "by conjugate gradients"
)
INLET = (
    "P. K. Gupta, H. S. Cheng, D. Zhu, N. H. Forster, J. B. Schrand, Tribology Transactions 35 (1992) 269-274, "
    "doi:10.1080/10402009208982117: heating of the inlet"
)
FREEDOM = (
    "F. E. Satterthwaite, Biometrics Bulletin 2 (1946) 110-114, doi:10.2307/3002019: degrees of freedom of the interval"
)


RIGID = "H. M. Martin, Engineering 102 (1916) 119-121: film between rigid cylinders"
MODULUS = (
    "K. L. Johnson, J. A. Greenwood, S. Y. Poon, Wear 19 (1972) 91-108, doi:10.1016/0043-1648(72)90445-0: "
    "film deflected by the whole load"
)
SHEARED = (
    "T. F. Conry, S. Wang, C. Cusano, Journal of Tribology 109 (1987) 648-654, doi:10.1115/1.3261526: "
    "Reynolds' equation of an Eyring fluid"
)


def cited(**used: bool) -> tuple[str, ...]:
    """The papers, the model's first: of a rough half-space in ``contact``, a ``heated`` inlet, an interval
    (``sampled``), a ``rigid`` film, Johnson's ``modulus``, a film whose flow is ``sheared``."""
    papers = {
        "contact": CONTACT,
        "rigid": RIGID,
        "modulus": MODULUS,
        "sheared": SHEARED,
        "heated": INLET,
        "sampled": FREEDOM,
    }
    return (MODEL, *(paper for name, paper in papers.items() if used.get(name)))


def together(points) -> str:
    """The papers of several results, each once, one a line."""
    return "\n".join(dict.fromkeys(line for point in points for line in point.cite().splitlines()))
