"""Load sharing with a film in the gap of the rough contact: ``numerics.closure = "one-way"``
(docs/deterministic.md)."""
