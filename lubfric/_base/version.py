"""The version, in a module of its own so that it loads without the rest."""

__version__ = "0.2.0"
