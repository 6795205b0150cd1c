"""What only the comparison with the paper needs (docs/figures.md)."""
