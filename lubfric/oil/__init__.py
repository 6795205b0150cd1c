"""Oils: viscosity index, viscosity over temperature, density, pressure-viscosity coefficient. SI units: m²/s, K, kg/m³,
1/Pa."""

from .make import from_grade, from_index, from_table, from_viscosities, grade_viscosity, named_oil, oil_names
from .oil import Oil
from .pressure import Estimate, gold, so_klaus
from .temperature import ViscosityTable, Walther, walther
from .viscosity_index import viscosity_at_100, viscosity_index

__all__ = [
    "Estimate",
    "Oil",
    "ViscosityTable",
    "Walther",
    "from_grade",
    "from_index",
    "from_table",
    "from_viscosities",
    "gold",
    "grade_viscosity",
    "named_oil",
    "oil_names",
    "so_klaus",
    "viscosity_at_100",
    "viscosity_index",
    "walther",
]
