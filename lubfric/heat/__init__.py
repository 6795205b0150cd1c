"""Heat of the film: how shearing lowers its viscosity, in the inlet and between the bodies."""

from .conjunction import FilmHeat, Surroundings, heated_film
from .inlet import InletHeat, inlet_heat
from .stress import heated_stress, viscosity_at

__all__ = ["FilmHeat", "InletHeat", "Surroundings", "heated_film", "heated_stress", "inlet_heat", "viscosity_at"]
