"""Stability maps: where methods work, where they say that they do not, and where they would fool their user."""
