"""Independent finite-element solvers, closed forms, and the studies that compare `lubfric` with them and with
published numbers."""
