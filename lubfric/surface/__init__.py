"""Height maps: read, prepared, generated, filtered and measured."""
