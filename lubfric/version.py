"""The version, by itself: what it is asked for must not wait for the rest."""

__version__ = "0.2.0"
