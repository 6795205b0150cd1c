"""Many points: sweeps, studies, curves, fits, and the store that keeps them."""
