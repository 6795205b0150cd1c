"""Rough contacts under a film, interchangeable: each closes load and lubricant volume (`closure.Closure`).

cylinder: the half-space patch under the film's own shape (semi-periodic); flat: a nominally flat strip, looked up in a
contact_curve (periodic, computed once); asperities: independent asperities in place of the half-space, either way.
"""
