"""The dry rough contact: the elastic half-space, its kernels and solver, and independent asperities."""
