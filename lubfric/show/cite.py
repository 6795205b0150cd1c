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


def cited(*, contact: bool, heated: bool, sampled: bool) -> tuple[str, ...]:
    """The papers, the model's first: of a rough half-space in contact, a heated inlet, an interval."""
    parts = ((True, MODEL), (contact, CONTACT), (heated, INLET), (sampled, FREEDOM))
    return tuple(text for used, text in parts if used)
