"""Oils: viscosity index, viscosity over temperature, density, pressure-viscosity coefficient. SI units: m²/s, K, kg/m³,
1/Pa."""

from .lubricant import (
    AS_BOUNDARY,
    NO_LIQUID,
    ROELANDS_LOG_VISCOSITY,
    Lubricant,
    carried_stress,
    density_ratio,
    log_viscosity_ratio,
    shear_stress,
    viscosity,
)
from .make import (
    AT_40,
    OILS,
    estimate_in_words,
    from_grade,
    from_index,
    from_table,
    from_viscosities,
    grade_viscosity,
    list_oils,
    named_oil,
)
from .oil import Oil
from .pressure import BASES, Estimate, gold
from .shear_laws import FLOW_LAWS, LIMIT_LAWS, Eyring, ShearLaw
from .viscosity import CELSIUS, Walther, checked_temperature, viscosity_at_100, viscosity_index, walther
