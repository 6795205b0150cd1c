"""One gap and one pressure: the film between rough surfaces in its own gap (docs/deterministic.md)."""
