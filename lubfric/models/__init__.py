"""The two models of a mixed-lubricated contact: load sharing after the paper, and the deterministic model."""
