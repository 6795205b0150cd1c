"""Load sharing in the contact's own gap: ``numerics.closure = "one-way"``."""
