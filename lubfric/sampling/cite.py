"""The papers behind a result: those of the methods that it used."""

from __future__ import annotations

from collections.abc import Iterable

PAPERS = {  # in the order in which they are cited, by what was used
    "load sharing": "A. Akchurin, R. Bosman, P. M. Lugt, M. van Drogen, Tribology Letters 59:19 (2015), "
    "doi:10.1007/s11249-015-0536-z: load sharing between film and rough contact",
    "one gap": "lubfric, docs/deterministic.md: one rough gap with one pressure, solved whole",
    "half-space contact": "I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206-219, doi:10.1016/S0043-1648(99)00113-1: "
    "contact of rough surfaces by conjugate gradients",
    "summits": "J. A. Greenwood, J. B. P. Williamson, Proceedings of the Royal Society A 295 (1966) 300-319, "
    "doi:10.1098/rspa.1966.0242: independent summits in contact",
    "patches": "M. A. Masen, M. B. de Rooij, D. J. Schipper, Wear 258 (2005) 339: contact patches as paraboloids",
    "rigid film": "H. M. Martin, Engineering 102 (1916) 119-121: film between rigid cylinders",
    "scaled modulus": "K. L. Johnson, J. A. Greenwood, S. Y. Poon, Wear 19 (1972) 91-108, "
    "doi:10.1016/0043-1648(72)90445-0: film deflected by the whole load",
    "kept mass": "B. Jakobsson, L. Floberg, Transactions of Chalmers University of Technology 190 (1957), and "
    "K.-O. Olsson, the same 308 (1965): rupture of a film that keeps its mass",
    "sheared flow": "T. F. Conry, S. Wang, C. Cusano, Journal of Tribology 109 (1987) 648-654, "
    "doi:10.1115/1.3261526: Reynolds' equation of a fluid that shear thins",
    "Roelands": "C. J. A. Roelands, thesis, Delft (1966): viscosity over pressure",
    "Barus": "C. Barus, American Journal of Science 45 (1893) 87-96: viscosity over pressure",
    "Dowson-Higginson": "D. Dowson, G. R. Higginson, Elasto-hydrodynamic Lubrication, Pergamon (1966): density over "
    "pressure",
    "Carreau": "P. J. Carreau, Transactions of the Society of Rheology 16 (1972) 99-127, doi:10.1122/1.549276: "
    "Carreau's law for the shear of a film",
    "Eyring stress": "K. L. Johnson, J. L. Tevaarwerk, Proceedings of the Royal Society A 356 (1977) 215-236, "
    "doi:10.1098/rspa.1977.0129: Eyring's law for the shear of a film",
    "limiting stress": "S. Bair, W. O. Winer, Journal of Lubrication Technology 101 (1979) 258-265, "
    "doi:10.1115/1.3453342: limiting shear stress",
    "viscosity over temperature": "ASTM D341: viscosity over temperature",
    "viscosity index": "ASTM D2270: viscosity index",
    "So and Klaus": "B. Y. C. So, E. E. Klaus, ASLE Transactions 23 (1980) 409-421, doi:10.1080/05698198008982986: "
    "estimate of the pressure-viscosity coefficient",
    "Gold": "P. W. Gold, A. Schmidt, H. Dicke, J. Loos, C. Assmann, Journal of Synthetic Lubrication 18 (2001) 51-79, "
    "doi:10.1002/jsl.3000180105: estimate of the pressure-viscosity coefficient",
    "inlet heat": "P. K. Gupta, H. S. Cheng, D. Zhu, N. H. Forster, J. B. Schrand, Tribology Transactions 35 (1992) "
    "269-274, doi:10.1080/10402009208982117: heating of the inlet",
    "film heat": "R. Nahme, Ingenieur-Archiv 11 (1940) 191-209, doi:10.1007/BF02086920: shear of a film that heats "
    "itself",
    "flash": "J. C. Jaeger, Proceedings of the Royal Society of New South Wales 76 (1942) 203-224: temperature of "
    "sliding surfaces",
    "hot Eyring stress": "H. Eyring, Journal of Chemical Physics 4 (1936) 283, doi:10.1063/1.1749836: Eyring stress "
    "over temperature",
    "hot limiting stress": "L. Houpert, L. Flamand, D. Berthe, Journal of Lubrication Technology 103 (1981) 526-532, "
    "doi:10.1115/1.3251731: limiting stress over temperature",
    "generated map": "Y. Z. Hu, K. Tonder, International Journal of Machine Tools and Manufacture 32 (1992) 83-90, "
    "doi:10.1016/0890-6955(92)90064-N: generated rough surface",
    "Gaussian filter": "ISO 16610-61: areal Gaussian filter",
    "interval": "F. E. Satterthwaite, Biometrics Bulletin 2 (1946) 110-114, doi:10.2307/3002019: degrees of freedom "
    "of the interval",
}


def cited(methods: Iterable[str]) -> str:
    """The papers of ``methods`` (keys of `PAPERS`), one a line, the model's first."""
    used = set(methods)
    return "\n".join(paper for name, paper in PAPERS.items() if name in used)


def together(points) -> str:
    """The papers of several results, each once, one a line."""
    return cited(name for point in points for name in point.methods)
