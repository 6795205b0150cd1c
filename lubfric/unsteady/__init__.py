"""Friction of contacts whose speed, load, radius or viscosity change in time."""
